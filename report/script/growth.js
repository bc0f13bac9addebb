/* Charts of the growth of cost, and the table of costs fitted to it. */

import { axisX, axisY, curves, logScale, svg, text, widthOf } from "./charts.js";
import { BASE, D } from "./data.js";
import { hue, nameOf } from "./marks.js";
import { $, bar, html, table, write } from "./markup.js";
import { by, num } from "./numbers.js";

const curveName = c => (c.engine === "span" ? "lecture’s form" : nameOf(c.method));
const curveHue = c => (c.engine === "span" ? "var(--ink3)" : hue(c.method));

/* Draws times of whole frames against a count, of triangles or of pixels. */
export function grow(id, keep, count, label) {
	const el = $(id);
	const W = widthOf(el);
	const { points, curves: all } = D.scaling;
	const chosen = points
		.map((p, i) => ({ ...p, i, n: count(p) }))
		.filter(p => !p.away && keep(p))
		.sort(by(p => p.n));
	if (!W || chosen.length < 2) return;
	const series = all
		.map(c => ({
			method: c.method,
			name: curveName(c),
			colour: curveHue(c),
			kind: c.engine === "span" ? "dash1" : "",
			tip: curveName(c),
			points: chosen.filter(p => c.times[p.i]).map(p => [p.n, c.times[p.i].min_ns / 1e6]),
		}))
		.filter(s => s.points.length);
	const ms = series.flatMap(s => s.points.map(p => p[1]));
	const l = 48;
	const r = W - (W < 480 ? 112 : 150);
	const b = 286;
	const x = logScale(
		chosen.map(p => p.n),
		1,
		l + 8,
		r,
	);
	const y = logScale(ms, 1.15, b, 14);
	el.innerHTML = svg(W, 330, `Time of a frame by ${label}`, [
		axisY(y, l, r + 8, y.ticks(40), " ms"),
		axisX(x, b, x.ticks(70)),
		text((l + r) / 2, 324, label, "axis mid"),
		curves(x, y, series),
	]);
}

const COSTS = [
	["vertex_ns", "vertex"],
	["triangle_ns", "triangle"],
	["span_ns", "span"],
	["pixel_ns", "pixel of a span"],
	["background_ns", "pixel of the picture"],
];

/* Fits with a larger misfit than this are not shown. */
const MISFIT = 0.5;

/* Draws the table of fitted costs. */
export function costs() {
	const all = D.scaling.curves.filter(c => c.costs);
	const list = all.filter(c => Math.abs(c.costs.worst) <= MISFIT);
	const most = k => Math.max(...list.map(c => c.costs[k])) || 1;
	const misfit = c => {
		const poor = !list.includes(c) && html` <span class="bad">poor fit</span>`;
		return html`${(Math.abs(c.costs.worst) * 100).toFixed(0)} %${poor}`;
	};
	// The length of a span from which less work per pixel makes up for more work per span.
	const even = c => {
		const base = list.find(o => o.method === BASE && o.engine === c.engine)?.costs;
		const more = c.costs.span_ns - base?.span_ns;
		const saved = base?.pixel_ns - c.costs.pixel_ns;
		return saved > 0 && list.includes(c) ? (more > 0 ? num(more / saved, 2) : "0") : "–";
	};
	$("#costs").innerHTML = table(
		["", ...COSTS.map(([, name]) => name), "break-even span, pixels", "largest misfit"],
		all.map(c => [
			curveName(c),
			...COSTS.map(([k]) =>
				list.includes(c)
					? bar(
							num(c.costs[k], 2),
							Math.max(1, (c.costs[k] / most(k)) * 100),
							curveHue(c),
						)
					: "–",
			),
			even(c),
			misfit(c),
		]),
	);
	write({ misfit: MISFIT * 100 });
}
