/* View: lectures. Shows the figures and their findings. */

import { go } from "./address.js";
import { widthOf } from "./charts.js";
import { folded, reveal, segments } from "./controls.js";
import { FIGURES, FINDINGS } from "./data.js";
import { handlesInto } from "./figure.js";
import { chip, counts, findingTable, topic } from "./findings.js";
import { $, $$, html, scrolling, table } from "./markup.js";
import { clamp } from "./numbers.js";
import { figurePictures } from "./pictures.js";
import { legend, plot, plotsInto } from "./plot.js";
import { stopInto } from "./stop.js";
import { CAN_DRAW } from "./studio.js";

/* Chips that count a figure's findings by verdict. */
function chips(f, named) {
	const all = counts(f.findings).map(([k, n]) => chip(k, n + (named ? " " + k : "")));
	return html`<span class="chips">${all}</span>`;
}

/* Returns a function that writes one block of pictures of a figure, and with each call the next. */
function pictureRows(f) {
	const files = [...figurePictures(f)];
	const picture = p => html`
		<figure>
			<img src="${files.shift()}" alt="${p.alt}">
			<figcaption>${p.caption}</figcaption>
		</figure>`;
	return ({ columns, shown }) => html`
		<div class="shown" style="--columns:${clamp(columns, 1, 6)}">${shown.map(picture)}</div>`;
}

/* The blocks of a figure. */
function figureBody(f) {
	const show = {
		text: b => html`<p>${b}</p>`,
		table: b => scrolling(f.title, table(b.head, b.rows, "plain")),
		plot: (b, at) => html`
			<figure class="plot">
				<h3>${b.title}</h3>
				<div class="chartbox" data-plot="${at}"></div>
				<figcaption>${b.caption}</figcaption>
			</figure>`,
		pictures: pictureRows(f),
		// Traces are drawn by the figure that can be stopped, which is above.
		trace: () => "",
	};
	return f.blocks.map((block, at) => {
		const [[kind, content]] = Object.entries(block);
		return show[kind](content, at);
	});
}

/* Draws the plots of a figure into their places between its texts. */
function drawPlots(f) {
	for (const el of $$("[data-plot]")) {
		const { plot: p } = f.blocks[el.dataset.plot];
		el.innerHTML = html`${plot(p, widthOf(el) || 460, 300)}${legend(p.series)}`;
	}
}

/* Puts a figure into an element: with handles if there is a query and the page can draw it, else its first pictures and plots.
   A link leads to the whole figure. */
export function figureInto(el, f, query, remember) {
	const isSeen = b => b.pictures ?? b.plot;
	const from = f.blocks.findIndex(isSeen);
	const end = f.blocks.findIndex((b, i) => i > from && b.text);
	const blocks = f.blocks.slice(from, end < 0 ? undefined : end).filter(isSeen);
	const row = pictureRows(f);
	el.innerHTML = html`
		<div></div>
		<a class="more" href="#lectures/${f.name}">The whole figure: ${f.title}</a>`;
	const [body] = el.children;
	if (query && stopInto(body, f, query, remember)) return;
	if (query && handlesInto(body, f, query, remember)) return;
	body.className = "fig";
	body.innerHTML = html`
		${blocks.map(b => (b.pictures ? row(b.pictures) : html`<figure class="plot"></figure>`))}`;
	const plots = blocks.flatMap(b => b.plot ?? []);
	plotsInto($$(".plot", body), plots, 300, true);
}

/* A figure's first pictures, or its first plot. */
function preview(f) {
	const first = f.blocks.find(b => b.plot)?.plot;
	const shown = f.blocks.flatMap(b => b.pictures?.shown ?? []);
	const files = figurePictures(f).slice(0, 3);
	return files.length
		? files.map((src, i) => html`<img src="${src}" alt="${shown[i].alt}">`)
		: first && plot(first, 260, 112);
}

/* A figure in the gallery. */
const card = f => html`
	<a class="fcard" href="#lectures/${f.name}">
		<span class="preview">${preview(f)}</span>
		<span class="tx"><b>${f.title}</b><small>${f.lecture}</small>${chips(f)}</span>
	</a>`;

/* Links to all figures, beside the one that is shown. */
function figureLinks(shown) {
	const wrong = html`<span class="chip contradicts" title="contradicts">✗</span>`;
	const links = FIGURES.map(
		f => html`
			<a href="#lectures/${f.name}" ${f === shown && html`aria-current="true"`}>
				<span>${topic(f)}</span>
				${f.findings.some(x => x.agreement === "contradicts") && wrong}
			</a>`,
	);
	return html`<nav class="list" aria-label="Figures">${links}</nav>`;
}

/* Keeps the address in step with the handles of a figure, as long as the address names this figure. */
const rememberFigure = f => query => {
	const [path] = location.hash.split("?");
	const text = String(query);
	if ([`#lectures/${f.name}`, FIGURES.length < 2 && "#lectures"].includes(path))
		history.replaceState(null, "", path + (text && "?" + text));
};

/* #lectures, #lectures/wrong, #lectures/all, #lectures/FIGURE */
export function lectures([part = ""], query) {
	const body = $("#lecture-body");
	const lists = { __proto__: null, wrong: FINDINGS.filter(x => x.agreement === "contradicts"), all: FINDINGS };
	const list = lists[part];
	const [shown, more] = folded(list ?? [], 40, "findings");
	segments(
		$("#lecture-tabs"),
		() => part,
		key => go(key ? "lectures/" + key : "lectures"),
	);
	const f = FIGURES.find(q => q.name === part) ?? (FIGURES.length === 1 ? FIGURES[0] : null);
	if (list) {
		const lead = html`
			<p class="lead">
				${list.length} measurements disagree with what is printed,
				most under conditions that the text does not name.
			</p>`;
		body.innerHTML = html`${part === "wrong" && lead}${findingTable(shown, true)}${more}`;
	} else if (f) {
		const several = FIGURES.length > 1;
		body.innerHTML = html`
			<div class="${several ? "detail" : ""}">
				${several && figureLinks(f)}
				<article class="fig">
					<h2>${f.title}</h2>
					<p class="facts">${f.lecture}</p>
					${chips(f, true)}
					<div class="hands"></div>
					${f.live && CAN_DRAW && html`<h3>As stored</h3>`}
					${figureBody(f)}
					<h3>Findings</h3>
					${findingTable(f.findings)}
				</article>
			</div>`;
		reveal($(".list [aria-current]", body));
		drawPlots(f);
		const hands = $(".hands", body);
		const remember = rememberFigure(f);
		stopInto(hands, f, query, remember) || handlesInto(hands, f, query, remember);
	} else {
		const [cards, rest] = folded(FIGURES, innerWidth < 700 ? 16 : 30, "figures");
		body.innerHTML = html`<div class="gallery">${cards.map(card)}</div>${rest}`;
	}
}
