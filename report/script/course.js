/* View: course. Shows the chapters that Rust made from report/course, one below the other, and fills in figures and findings when they come near. */

import { address } from "./address.js";
import { widthOf } from "./charts.js";
import { costInto, growCosts } from "./costs.js";
import { chip, figureNamed, findingOf, findingValue } from "./findings.js";
import { goalInto } from "./goals.js";
import { handsInto } from "./hands.js";
import { figureInto } from "./lectures.js";
import { $, $$, atNextFrame, delay, html, sentence } from "./markup.js";
import { askInto } from "./questions.js";
import { markTerms } from "./terms.js";

export const CHAPTERS = $$("#course article");
const chapterOf = part => CHAPTERS.find(c => c.dataset.part === (part === "stop" ? "0" : part));

/* The state of each chapter's handles that were moved, as the query of an address. */
const movedIn = new Map();

/* The address of a chapter, with the state of its figure. */
function addressOf(chapter) {
	const { part } = chapter.dataset;
	const query = movedIn.get(chapter);
	return query ? `#course/${part === "0" ? "stop" : part}?${query}` : `#course/${part}`;
}

/* The chapter that the reader is reading. */
let reading;

/* Makes the address name the chapter that is being read, without a new entry in the history. */
function keepChapter() {
	const to = addressOf(reading);
	if (address.view === "course" && location.hash !== to) history.replaceState(null, "", to);
}

/* Marks a chapter in the list. Only the list scrolls to it, not the page. */
function follow(chapter) {
	reading = chapter;
	CHAPTERS.forEach(c => c.classList.toggle("on", c === chapter));
	const list = $("#course .list");
	for (const a of $$("a", list)) {
		a.ariaCurrent = a.hash === `#course/${chapter.dataset.part}` ? "true" : null;
		if (!a.ariaCurrent) continue;
		list.scrollLeft = a.offsetLeft - (list.clientWidth - a.offsetWidth) / 2;
		list.scrollTop = a.offsetTop - (list.clientHeight - a.offsetHeight) / 2;
	}
}

/* Shows a finding: its value, and what follows from it. */
/**
 * @param {any} el
 * @param {any} finding
 */
function findingInto(el, { agreement, verdict, label, ...measured }) {
	el.classList.add(agreement);
	el.innerHTML = html`
		<p>${sentence(label)}: <b>${findingValue(measured)}</b></p>
		<p class="sub">${chip(agreement, agreement)} ${verdict}</p>`;
}

/* Fills a figure's place, unless it is filled for this width already. On paper figures have no handles. */
function fillFigure(el, onPaper) {
	const chapter = el.closest("article");
	const f = figureNamed(el.dataset.figure);
	const filled = `${onPaper ? "paper" : widthOf(el)}`;
	if (!f || el.dataset.filled === filled) return;
	if (onPaper && (el.dataset.filled || !f.blocks.some(b => b.pictures ?? b.plot))) return;
	el.dataset.filled = filled;
	const query = onPaper ? undefined : new URLSearchParams(movedIn.get(chapter));
	// What a figure reports first is its state before anything was moved.
	let start = movedIn.get(chapter) ? "" : null;
	figureInto(el, f, query, moved => {
		start ??= String(moved);
		const now = String(moved) === start ? "" : String(moved);
		if (now === (movedIn.get(chapter) ?? "")) return;
		movedIn.set(chapter, now);
		if (chapter === reading) keepChapter();
	});
}

/* Fills a place of a chapter. If the page does not have what belongs there, the place keeps its text. */
function fillPlace(el, onPaper = false) {
	const { figure, finding, hands, cost } = el.dataset;
	const found = finding && findingOf(figure, finding);
	if (found) findingInto(el, found);
	else if (figure && !finding) fillFigure(el, onPaper);
	else if (cost) costInto(el, cost, grown);
	else if (hands && !onPaper) handsInto(el, hands);
}

/* Fills all places of a chapter. */
const fillChapter = (chapter, onPaper) =>
	$$("[data-figure], [data-cost]", chapter).forEach(el => fillPlace(el, onPaper));

/* The places and chapters that have not come near yet. */
const farAway = new Set();

/* Fills the places that are less than a window's height away, and marks the terms of chapters that are. */
function fillNear() {
	for (const el of farAway) {
		const { top, bottom, width } = el.getBoundingClientRect();
		if (!width || top > 2 * innerHeight || bottom < -innerHeight) continue;
		farAway.delete(el);
		if (!el.matches("article")) fillPlace(el);
		else markTerms(el);
		settle();
	}
}

let looks = false;

/* Fills, at the next frame, what has come near. The chapter at a third of the window's height counts as the one that is being
   read. */
function look() {
	if (looks || address.view !== "course") return;
	looks = true;
	atNextFrame(() => {
		looks = false;
		if (address.view !== "course") return;
		fillNear();
		growCosts();
		const at = CHAPTERS.findLast(c => c.getBoundingClientRect().top <= innerHeight / 3) ?? CHAPTERS[0];
		if (held || at === reading) return;
		follow(at);
		keepChapter();
	});
}

addEventListener("scroll", look, { passive: true });

/* The place where the reader starts to read. It keeps its place in the window while figures above it are filled, until the reader scrolls. */
let held = null;

function settle() {
	if (address.view !== "course" || !held) return;
	const { el, top } = held;
	if (top == null) el.scrollIntoView();
	else scrollBy(0, el.getBoundingClientRect().top - top);
}

/* The places where the reader followed links. The history holds indices into this list. */
const followed = [];

/* Keeps the reader's place when something above it has grown, and fills what has come near. */
function grown() {
	settle();
	look();
}

const holding = new ResizeObserver(grown);

addEventListener("drawn", settle);

for (const type of ["wheel", "touchmove", "keydown", "pointerdown"])
	addEventListener(type, () => (held = null), { passive: true });

/* Makes questions and goals, and starts to watch what comes near. Does so once. */
function startCourse() {
	if (reading) return;
	reading = CHAPTERS[0];
	for (const el of $$("#course .ask")) askInto(el, fillPlace);
	for (const el of $$("#course .toy")) goalInto(el);
	for (const el of $$("#course :is(article, [data-figure], [data-cost], [data-hands])")) farAway.add(el);
	holding.observe(CHAPTERS[0].parentElement);
	// Going back leads to the place where the link was followed, not to the start of the chapter.
	$("#course").addEventListener("click", e => {
		const link = e.target.closest("a[href^='#']");
		if (!link) return;
		const el = link.closest("article > *") ?? reading;
		const at = followed.push({ el, top: el.getBoundingClientRect().top }) - 1;
		history.replaceState({ at }, "", location.hash || "#course");
		const from = link.matches(".go-stop") && link.closest("article");
		if (from && from !== CHAPTERS[0]) offerBack(from);
	});
}

/* Puts a link above the figure that can be stopped. It leads back to the chapter that the reader came from. */
function offerBack(chapter) {
	const [{ state }, { hash }] = [history, location];
	$(".go-back")?.remove();
	$(".live", CHAPTERS[0]).insertAdjacentHTML(
		"beforebegin",
		html`<a class="go-back" href="${hash}">← Back to ${$("h2", chapter).textContent}</a>`,
	);
	$(".go-back").onclick = e => {
		e.preventDefault();
		e.stopPropagation();
		history.pushState(state, "", hash);
		dispatchEvent(new HashChangeEvent("hashchange", { newURL: location.href }));
	};
}

/* #course, #course/4.1, #course/4.2?angle=95, #course/stop?line=6. Returns the element to scroll to. */
export function course([part], query) {
	startCourse();
	const chapter = chapterOf(part);
	const place = chapter && $(".live", chapter);
	const asked = String(query);
	if (place && (part !== "0" || asked) && asked !== (movedIn.get(chapter) ?? "")) {
		movedIn.set(chapter, asked);
		delete place.dataset.filled;
	}
	follow(chapter ?? CHAPTERS[0]);
	if (place) fillPlace(place);
	// Figures that were filled at another width, or for paper, are filled again when they come near.
	for (const el of $$("#course .live[data-filled]")) farAway.add(el);
	look();
	if (part && !chapter) history.replaceState(null, "", "#course");
	if (part !== "stop") $(".go-back")?.remove();
	return part === "stop" ? ($(".go-back") ?? place) : chapter;
}

/* Scrolls to the link that the reader followed, if the reader comes back to it, else to a chapter, else to the top. */
export function startReading(chapter) {
	held = followed[history.state?.at] ?? (chapter && { el: chapter });
	if (held) settle();
	else scrollTo(0, 0);
	// Other means of scrolling send no event that lets go of the place, so it is let go after a while.
	delay("held", 4000, () => (held = null));
}

/* Fills all chapters before the page is printed. */
addEventListener("beforeprint", () => {
	if (CHAPTERS.length) CHAPTERS.forEach(c => fillChapter(c, true));
});
