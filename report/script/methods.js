/* View: methods. */

import { folded, unfolded } from "./controls.js";
import { CORNERS, ratioIn } from "./corners.js";
import {
	IDS, levelName, MANY, METHODS, ratioText, SCENES, STUDY, UNTOLD,
} from "./data.js";
import { formula } from "./formulas.js";
import { mark, nameOf } from "./marks.js";
import { $, $$, html, write } from "./markup.js";
import { num, plural, sum } from "./numbers.js";
import { crop } from "./pictures.js";

/* Kinds of operations, in the order of the document. */
export const OPERATIONS = [
	"additions",
	"multiplications",
	"comparisons",
	"divisions",
	"roots",
	"sines, arctangents",
	"powers",
	"reads of tables",
];

/* How often a method does operations, with a function that returns them. */
/** @type {[string, (operations: any) => number[]][]} */
const RATES = [
	["pixel", o => o.walk.map((n, i) => n + o.shade[i])],
	["span", o => o.span],
	["edge", o => o.edge],
	["edge, per scanline", o => o.edge_step],
	["vertex", o => o.vertex],
	["polygon", o => o.polygon],
];

/* A bar of the operations of each kind. Its length is their share of `most`. */
function stack(counts, most) {
	const list = counts.map((n, i) => [n, OPERATIONS[i], Math.min(i, 5)]).filter(([n]) => n);
	if (!list.length) return html`<div class="hint">none</div>`;
	const width = Math.max(4, (sum(counts) / most) * 100);
	const label = list.map(([n, what]) => `${n} ${what}`).join(", ");
	// Divisions, roots and other costly operations are few, so they get extra room for their count.
	const parts = list.map(([n, what, i]) => {
		const number = (n / most > 0.05 || i > 2) && n;
		const flex = `${n} 0 ${i > 2 ? 13 : 0}px`;
		return html`<i class="o${i}" style="flex:${flex}" title="${n} ${what}">${number}</i>`;
	});
	return html`
		<div class="stack" style="width:${width}%" role="img" aria-label="${label}">${parts}</div>`;
}

/* The card of a method. */
function article(m, most) {
	const { worst, scene: s } = m;
	const corner = CORNERS.find(c => c.work === "frame" && !c.scalar);
	const frame =
		corner &&
		ratioIn(
			STUDY.methods.find(q => q.method === m.name),
			corner,
		);
	const bad = worst?.max >= 1;
	const rates = RATES.map(([label, of]) => [label, of(m.operations[0])]).filter(
		([, counts], i) => !i || sum(counts),
	);
	const figures = [
		m.speed && [
			ratioText(m.speed),
			`${MANY ? `${plural(SCENES.length - UNTOLD, "scene")}, ` : ""}${levelName(SCENES[0].renderer)}`,
		],
		frame && [ratioText(frame), `whole picture of a sphere, ${levelName(corner)}`],
		worst && [num(worst.max), "worst error, levels", bad],
	].filter(Boolean);
	const link = s && `#scenes/${s.id}?left=${encodeURIComponent(m.name)}&right=reference`;
	const verdict = bad
		? html`<b>Fails</b> most in <a href="${link}">${s.title}</a>`
		: html`<b>No visible failure</b> ${MANY ? `in ${SCENES.length} scenes` : "in this scene"}`;
	const costs = rates.map(([label, counts]) => html`<span>${label}</span>${stack(counts, most)}`);
	const kpis = figures.map(
		([value, label, bad]) =>
			html`<div><b class="${bad ? "bad" : ""}">${value}</b>${label}</div>`,
	);
	const pair = ["reference", m.name].map(
		i => html`
			<div>
				<canvas data-method="${i}" role="img" aria-label="${nameOf(i)}"></canvas>
				${nameOf(i)}
			</div>`,
	);
	const pictures = html`
		<figure class="crop">
			<div class="pair">${pair}</div>
			<figcaption>${verdict}. In principle: ${m.fails || "nowhere known"}.</figcaption>
		</figure>`;
	return html`
		<article class="method" id="m-${m.name}">
			<div>
				<h2>${mark(m.name)}${m.label} <code>${m.name}</code></h2>
				<p class="idea">${m.title}</p>
				<div class="formula">${formula(m.formula)}</div>
				<p class="hint">${m.source} · ${m.perspective} · ${m.local}</p>
			</div>
			<div>
				<div class="ops">${costs}</div>
				<div class="kpi">${kpis}</div>
			</div>
			${s && pictures}
		</article>`;
}

/* #methods/METHOD */
export function methods([id]) {
	if (id) unfolded.add("methods");
	const el = $("#methodlist");
	const [shown, more] = folded(METHODS, innerWidth < 1200 ? 6 : 12, "methods");
	if ($$(".method", el).length < shown.length) {
		const most = Math.max(
			...METHODS.flatMap(m => RATES.map(([, of]) => sum(of(m.operations[0])))),
		);
		write({ "t-methods": `${plural(IDS.length, "way")} to one equation` });
		$("#light").innerHTML = html`${formula("I = Ia ka + Ip kd (L.N) + Ip ks (R.V)^n")}`;
		el.innerHTML = html`${shown.map(m => article(m, most))}${more}`;
		for (const { name, scene: s, worst } of shown)
			if (s && s.drawn)
				for (const c of $$("canvas", document.getElementById("m-" + name)))
					crop(c, s, c.dataset.method, worst.worst, 84, 84);
	}
}
