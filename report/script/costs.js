/* Costs: how many operations each method needs for the picture of chapter 0, from the document's counts and the picture's trace. */

import { M } from "./data.js";
import { named, nameOf } from "./marks.js";
import { $$, fadeEnds, html, scrolling, table } from "./markup.js";
import { OPERATIONS } from "./methods.js";
import { grouped, sum } from "./numbers.js";
import { hasTraces, tracesOf } from "./traces.js";

/* The methods in the order of the course, and the kinds of operations in which they differ. */
const COURSE_METHODS = ["flat", "gouraud", "naive-phong", "fast-phong", "slerp-phong"];
const COST_KINDS = ["additions", "multiplications", "divisions", "roots", "sines, arctangents"];

let coursePicture;

/* Counts the vertices, edges, runs and pixels of the picture. Returns nothing if the page has no trace. */
async function pictureCounts() {
	if (!hasTraces()) return null;
	const [trace] = Object.values(await tracesOf());
	const count = of => sum(trace.lines.map(of));
	const pixels = count(l => sum(l.runs.map(r => r.pixels)));
	return {
		vertex: trace.vertices.length,
		polygon: trace.polygons.length,
		edge: count(l => l.entered.length),
		edge_step: count(l => l.stepped.length),
		span: count(l => l.runs.length),
		walk: pixels,
		shade: pixels,
	};
}

/* How many operations of each kind a method needs for the picture. */
function costOf(method, picture) {
	const [operations] = M[method].operations;
	return COST_KINDS.map(kind => {
		const at = OPERATIONS.indexOf(kind);
		return sum(Object.entries(picture).map(([rate, times]) => times * operations[rate][at]));
	});
}

/* The methods' operations side by side. */
function costTable(costs) {
	const rows = COURSE_METHODS.map((m, i) => [named(m), ...costs[i].map(grouped)]);
	return scrolling("Operations of each method", table(["for the picture", ...COST_KINDS], rows, "plain"));
}

/* The bars of a method. They start as long as those of the previous method, and then grow or shrink. */
function costBars(costs, at) {
	const most = COST_KINDS.map((_, k) => Math.max(...costs.map(c => c[k])));
	const row = (kind, k) => {
		const [now, before] = [costs[at][k], costs[Math.max(0, at - 1)][k]].map(n => (n / most[k]) * 100);
		return html`
			<span>${kind}</span>
			<b>${grouped(costs[at][k])}</b>
			<i aria-hidden="true"><b style="width:${before}%" data-width="${now}"></b><u style="left:${before}%"></u></i>`;
	};
	return html`<div class="bill">${COST_KINDS.map(row)}</div>`;
}

/* Adds what a picture costs to the sentence about it, and then calls `settled`. */
export async function costInto(el, method, settled) {
	if (el.dataset.filled || COURSE_METHODS.some(m => !M[m])) return;
	el.dataset.filled = "yes";
	const picture = await (coursePicture ??= pictureCounts());
	if (!picture) return;
	const costs = COURSE_METHODS.map(m => costOf(m, picture));
	const at = COURSE_METHODS.indexOf(method);
	const what = html`
		The picture of <a href="#course/0">chapter 0</a>: ${grouped(picture.walk)} pixels in ${grouped(picture.span)} runs.${
			at > 0 && html` Marks show ${nameOf(COURSE_METHODS[at - 1])}.`
		}`;
	el.insertAdjacentHTML(
		"beforeend",
		html`${at < 0 ? costTable(costs) : costBars(costs, at)}<p class="sub">${what}</p>`,
	);
	fadeEnds();
	settled();
}

/* Lets bars grow or shrink from the previous method's length to their own when the reader sees them. */
export function growCosts() {
	for (const b of $$("#course [data-width]")) {
		if (b.getBoundingClientRect().bottom > innerHeight) continue;
		b.style.width = `${b.dataset.width}%`;
		delete b.dataset.width;
	}
}
