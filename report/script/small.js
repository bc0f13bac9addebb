/* Charts of the loops in integers, for processors without a floating-point unit. */

import {
	axisX, axisY, line, logScale, place, scale, svg, text, textWidth, widthOf,
} from "./charts.js";
import { D, M } from "./data.js";
import { hue, shape } from "./marks.js";
import { $, html } from "./markup.js";
import { num } from "./numbers.js";

/* The method that a loop belongs to, for its mark and colour. The names of loops begin with their method's name. */
function methodOfLoop(loop) {
	const printed = loop.endsWith("-as-printed");
	const method = `integer-${loop.split("-")[0]}${printed ? "-printed" : ""}`;
	return M[method] ? method : null;
}

/* What parts of the names of loops mean to a reader. */
const PARTS = { 1: "+ Newton", nh: "N·H", dull: "no highlight" };

const nameOfLoop = loop =>
	loop
		.split("-")
		.map(part => PARTS[part] ?? part)
		.join(" ");

/* Draws error at 15° against the cost of a pixel, which is the figure at index `column` of a loop. */
function costOfLoops(id, column, label) {
	const el = $(id);
	const W = widthOf(el);
	if (!W) return;
	/** @type {any[]} */
	const points = D.small.spans
		.filter(loop => loop.worst_error.length)
		.map(loop => ({
			m: methodOfLoop(loop.method),
			name: nameOfLoop(loop.method),
			cost: loop.at_32_pixels_15_degrees[column],
			error: loop.worst_error[1],
		}));
	const [l, r, t, b] = [44, W - 14, 24, 286];
	const x = logScale(
		points.map(p => p.cost),
		1.25,
		l,
		r,
	);
	const y = scale(false, 0, Math.ceil(Math.max(...points.map(p => p.error)) + 0.5), b, t);
	for (const p of points) {
		[p.x, p.y] = [x(p.cost), y(p.error)];
		p.w = textWidth(p.name) + 6;
		// Loops whose name is one word are the plain ones. They are labelled first.
		p.priority = +!p.name.includes(" ");
	}
	place(points, [l + 2, t, r, b - 1], []);
	el.innerHTML = svg(W, 330, `Error against ${label}`, [
		axisY(y, l, r, y.ticks(40)),
		axisX(x, b, x.ticks(45)),
		text(l - 38, t - 9, "worst error at 15°, grey levels", "axis"),
		text((l + r) / 2, 324, `← faster   ·   ${label}`, "axis mid"),
		points.map(
			p => html`
				<g style="color:${hue(p.m)}">
					<title>${p.name}: ${num(p.error)} levels, ${num(p.cost)} ${label}</title>
					${p.label?.end && line(p.x, p.y, ...p.label.end, "leader")}
					${shape(p.m, p.x, p.y, 5.2)}
					${p.label && text(p.label.x + 2, p.label.y + 4.3, p.name, "label halo")}
				</g>`,
		),
	]);
}

export function small() {
	costOfLoops("#small-m0", 1, "cycles of a Cortex-M0+ a pixel");
	costOfLoops("#small-rv", 2, "instructions of RV32IMC a pixel");
	const cycles = name =>
		D.small.spans.find(loop => loop.method === name)?.at_32_pixels_15_degrees[1];
	const [soft, fast, naive] = ["soft-naive", "fast", "naive"].map(cycles);
	const times = `${num(soft / naive, 2)} times as many as in integers`;
	$("#small-soft").innerHTML = html`
		<span>Naive Phong in emulated floats takes ${num(soft)} cycles a pixel there, ${times}.</span>
		<span> The lecture’s fast Phong takes ${num(fast / naive, 2)} of naive Phong’s cycles.</span>
		<span> Measured by <code>${D.small.command}</code>.</span>`;
}
