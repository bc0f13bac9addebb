/* Charts of the growth of cost. */

import { axisX, axisY, curves, logScale, svg, text, widthOf } from "./charts.js";
import { D, isTooBusy } from "./data.js";
import { hue, nameOf } from "./marks.js";
import { $ } from "./markup.js";
import { by } from "./numbers.js";

const curveName = c => (c.engine === "span" ? "lecture’s form" : nameOf(c.method));
const curveHue = c => (c.engine === "span" ? "var(--ink3)" : hue(c.method));

/* Draws times of whole frames against a count, of triangles or of pixels. */
export function grow(id, keep, count, label) {
	const el = $(id);
	const W = widthOf(el);
	const { points, curves: all } = D.scaling;
	const chosen = points
		.map((p, i) => ({ ...p, i, n: count(p) }))
		.filter(p => keep(p) && !isTooBusy(p))
		.sort(by(p => p.n));
	if (!W || chosen.length < 2) return;
	const series = all
		.map(c => ({
			method: c.method,
			name: curveName(c),
			colour: curveHue(c),
			kind: c.engine === "span" ? "dash1" : "",
			tip: curveName(c),
			points: chosen
				.filter(p => c.times[p.i])
				.map(p => [
					p.n,
					...["typical_ns", "low_ns", "high_ns"].map(k => c.times[p.i][k] / 1e6),
				]),
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
