/* View: course. Chapters that Rust made of docs/course, one below the other; figures and findings come when they are near. */

const CHAPTERS = $$("#course article");
const chapterOf = part => CHAPTERS.find(c => c.dataset.part === (part === "stop" ? "0" : part));

/* The handles that were moved, by chapter, as queries of addresses. */
const movedIn = new Map();

/* The address of a chapter, with the state of its figure. */
function addressOf(chapter) {
	const { part } = chapter.dataset;
	const query = movedIn.get(chapter);
	return query ? `#course/${part === "0" ? "stop" : part}?${query}` : `#course/${part}`;
}

/* The chapter that is being read. */
let reading;

/* Has the address say what is being read, without a new entry in the history. */
function keepChapter() {
	const to = addressOf(reading);
	if (view === "course" && location.hash !== to) history.replaceState(null, "", to);
}

/* Marks a chapter in the list. The list alone scrolls to it, and not the page. */
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

/* A finding: the value, and what follows from it. */
function findingInto(el, { agreement, verdict, label, ...measured }) {
	el.classList.add(agreement);
	el.innerHTML = html`
		<p>${sentence(label)}: <b>${findingValue(measured)}</b></p>
		<p class="sub">${chip(agreement, agreement)} ${verdict}</p>`;
}

const figureNamed = name => FIGURES.find(f => f.name === name);
const findingOf = (name, key) => figureNamed(name)?.findings.find(x => x.key === key);

/* Fills a figure's place, unless it is as its width asks for. On paper figures have no handles. */
function fillFigure(el, onPaper) {
	const chapter = el.closest("article");
	const f = figureNamed(el.dataset.figure);
	const filled = `${onPaper ? "paper" : widthOf(el)}`;
	if (!f || el.dataset.filled === filled) return;
	if (onPaper && (el.dataset.filled || !f.blocks.some(b => b.pictures ?? b.plot))) return;
	el.dataset.filled = filled;
	const query = onPaper ? undefined : new URLSearchParams(movedIn.get(chapter));
	// A figure that says at once how it stands was not moved yet.
	let start = movedIn.get(chapter) ? "" : null;
	figureInto(el, f, query, moved => {
		start ??= String(moved);
		const now = String(moved) === start ? "" : String(moved);
		if (now === (movedIn.get(chapter) ?? "")) return;
		movedIn.set(chapter, now);
		if (chapter === reading) keepChapter();
	});
}

/* Fills a place of a chapter; what a page does not have stays as it was written. */
function fillPlace(el, onPaper = false) {
	const { figure, finding, hands, cost } = el.dataset;
	const found = finding && findingOf(figure, finding);
	if (found) findingInto(el, found);
	else if (figure && !finding) fillFigure(el, onPaper);
	else if (cost) costInto(el, cost);
	else if (hands && !onPaper) handsInto(el, hands);
}

/* Fills the places of a chapter that are not folded. */
const fillChapter = (chapter, onPaper) =>
	$$("[data-figure], [data-cost]", chapter).forEach(el => fillPlace(el, onPaper));

/* Places and chapters that were not near yet. */
const farAway = new Set();

/* Fills places that are near: less than a window's height away. Terms of a chapter are marked with them. */
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

/* Looks, at the next frame, at what is near, and which chapter a third of the window's height lies in: it is the one that
   is read. */
function look() {
	if (looks || view !== "course") return;
	looks = true;
	atNextFrame(() => {
		looks = false;
		if (view !== "course") return;
		fillNear();
		growCosts();
		const at = CHAPTERS.findLast(c => c.getBoundingClientRect().top <= innerHeight / 3) ?? CHAPTERS[0];
		if (held || at === reading) return;
		follow(at);
		keepChapter();
	});
}

addEventListener("scroll", look, { passive: true });

/* Where one starts to read. It stays in its place while figures above it are filled, until the reader scrolls. */
let held = null;

function settle() {
	if (view !== "course" || !held) return;
	const { el, top } = held;
	if (top == null) el.scrollIntoView();
	else scrollBy(0, el.getBoundingClientRect().top - top);
}

/* Where links were followed; the history has their indices. */
const followed = [];

const holding = new ResizeObserver(() => {
	settle();
	look();
});

addEventListener("drawn", settle);

for (const type of ["wheel", "touchmove", "keydown", "pointerdown"])
	addEventListener(type, () => (held = null), { passive: true });

/* Makes questions and goals, and watches for what comes near; once. */
function startCourse() {
	if (reading) return;
	reading = CHAPTERS[0];
	for (const el of $$("#course .ask")) askInto(el);
	for (const el of $$("#course .toy")) goalInto(el);
	for (const el of $$("#course :is(article, [data-figure], [data-cost], [data-hands])")) farAway.add(el);
	holding.observe(CHAPTERS[0].parentElement);
	// A link back leads to where one read, and not to the start of the chapter.
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

/* Puts a link above the figure that stops, back to where one read about it. */
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

/* #course, #course/4.1, #course/4.2?angle=95, #course/stop?line=6: returns where one starts to read. */
function course([part], query) {
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
	// What was filled at another width, or for paper, is filled again when it is near.
	for (const el of $$("#course .live[data-filled]")) farAway.add(el);
	look();
	if (part && !chapter) history.replaceState(null, "", "#course");
	if (part !== "stop") $(".go-back")?.remove();
	return part === "stop" ? ($(".go-back") ?? place) : chapter;
}

/* Scrolls to where one reads: where a link was followed, if one comes back to it, or to a chapter, or to the start. */
function startReading(chapter) {
	held = followed[history.state?.at] ?? (chapter && { el: chapter });
	if (held) settle();
	else scrollTo(0, 0);
	// Whoever scrolls by other means is not held for long.
	delay("held", 4000, () => (held = null));
}

/* On paper are all chapters, with what is measured. */
addEventListener("beforeprint", () => {
	if (CHAPTERS.length) CHAPTERS.forEach(c => fillChapter(c, true));
});
