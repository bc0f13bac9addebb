/* Plots of curves, for figures and for the rows of a picture. */

import { axisX, axisY, curve, line, scale, svg, text, widthOf } from "./charts.js";
import { html } from "./markup.js";
import { clamp } from "./numbers.js";

const PLOT_HUES = ["--base", "--h3", "--h2", "--h4", "--h1", "--h5"];

/* Draws several curves in one chart, with axes unless the chart is small. */
export function plot(p, W, H) {
	const small = H < 150;
	const series = p.series.map((s, i) => ({
		...keyed(s, i),
		points: s.points.filter(q => q.every(v => v != null && isFinite(v))),
	}));
	const [l, r, t, b] = small ? [4, W - 4, 6, H - 6] : [52, W - 12, 22, H - 42];
	const axis = (values, [, kind], from, to) => {
		const log = kind === "log";
		const list = values.filter(v => isFinite(v) && (!log || v > 0));
		const low = Math.min(...list);
		const high = Math.max(...list);
		return low < high
			? scale(log, low, high, from, to)
			: scale(log, low / 2 || -0.5, low * 2 || 0.5, from, to);
	};
	const points = series.flatMap(s => s.points);
	const x = axis([...points.map(q => q[0]), ...p.marks], p.x, l, r);
	const y = axis(
		points.map(q => q[1]),
		p.y,
		b,
		t,
	);
	const at = ([u, v]) => [x(clamp(u, x.low, x.high)), y(clamp(v, y.low, y.high))];
	const axes = small
		? []
		: [
				axisY(y, l, r, y.ticks(32)),
				axisX(x, b, x.ticks(60)),
				text((l + r) / 2, H - 6, p.x[0], "axis mid"),
				text(2, 12, p.y[0], "axis"),
			];
	return svg(W, H, `${p.title}: ${p.series.map(s => s.label).join(", ")}`, [
		axes,
		p.marks.map(m => line(x(m), t, x(m), b, "dots")),
		series.map(s => html`<g style="color:${s.colour}">${curve(s.points.map(at), s.kind)}</g>`),
	]);
}

/* Gives a series the colour and the dashes of its index, unless it has its own. */
const keyed = (s, i) => ({ colour: `var(${PLOT_HUES[i % 6]})`, kind: `dash${i % 6}`, ...s });

/* The legend: a piece of each curve, and its name. */
export function legend(series) {
	const piece = [
		[0, 4],
		[26, 4],
	];
	const entries = series.map(keyed).map(
		s => html`
			<span style="color:${s.colour}">
				<svg width="26" height="8" aria-hidden="true">${curve(piece, s.kind)}</svg>
				<span>${s.label}</span>
			</span>`,
	);
	return html`<div class="legend">${entries}</div>`;
}

/* Draws plots into boxes, each below its title and above its legend, with captions if asked. */
export function plotsInto(boxes, plots, H, hasCaptions) {
	boxes.forEach((box, i) => {
		const p = plots[i];
		box.innerHTML = html`
			<b>${p.title}</b>
			<div class="chartbox">${plot(p, widthOf(box) || 460, H)}</div>
			${legend(p.series)}
			${hasCaptions && html`<figcaption>${p.caption}</figcaption>`}`;
	});
}
