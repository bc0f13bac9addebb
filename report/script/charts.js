/* Charts: axes, curves and labels, as SVG. */

import { hue, shape } from "./marks.js";
import { create, html, ROOT } from "./markup.js";
import { by, clamp, round, sum } from "./numbers.js";

/* The size of type as a multiple of the default: charts are laid out in default type, then scaled by this. */
export const zoomOf = () => parseFloat(getComputedStyle(ROOT).fontSize) / 16;

/* The width of a chart in pixels, before it is scaled. */
export const widthOf = el => Math.round(el.clientWidth / zoomOf());

/* The SVG of a chart: a group of controls if one can choose its marks, else an image. */
export const svg = (w, h, label, body, controls) =>
	html`
		<svg viewBox="0 0 ${w} ${h}" role="${controls ? "group" : "img"}" aria-label="${label}">
			${body}
		</svg>`;

/* Parts of charts, in pixels. */
export const text = (x, y, t, kind = "") =>
	html`<text x="${round(x)}" y="${round(y)}" class="${kind}">${t}</text>`;

export const line = (x1, y1, x2, y2, kind = "grid") =>
	html`
		<line x1="${round(x1)}" y1="${round(y1)}" x2="${round(x2)}" y2="${round(y2)}"
			class="${kind}"/>`;

export const curve = (points, kind = "") =>
	html`<path class="curve ${kind}" d="M${points.map(p => p.map(round).join(" ")).join("L")}"/>`;

/* The width of a text in a chart. */
export const textWidth = (() => {
	const pen = create("canvas").getContext("2d");
	let family;
	return (t, bold) => {
		family ??= getComputedStyle(document.body).fontFamily;
		pen.font = `${bold ? 650 : 400} 12.5px ${family}`;
		return pen.measureText(t).width;
	};
})();

/* The scale of an axis: from values `low` to `high` to pixels `from` to `to`. */
export function scale(log, low, high, from, to) {
	const f = log ? Math.log : v => v;
	const k = (to - from) / (f(high) - f(low) || 1);
	const at = v => from + (f(v) - f(low)) * k;
	return Object.assign(at, {
		low,
		high,
		from,
		to,
		ticks: gap => (log ? logTicks : linearTicks)(at, gap),
	});
}

/* A logarithmic scale of some values, with a margin. */
export const logScale = (values, margin, from, to) =>
	scale(true, Math.min(...values) / margin, Math.max(...values) * margin, from, to);

/* Round numbers on a scale, at least `gap` pixels apart. */
function linearTicks({ low, high, from, to }, gap) {
	const rough = ((high - low) / Math.abs(to - from)) * gap;
	const power = 10 ** Math.floor(Math.log10(rough));
	const step = [1, 2, 5, 10].map(s => s * power).find(s => s >= rough);
	const first = Math.ceil(low / step);
	return Array.from(
		{ length: Math.floor(high / step + 1e-6) - first + 1 },
		(_, i) => +((first + i) * step).toPrecision(6),
	);
}

/* Numbers of few digits on a logarithmic scale. The roundest come first, and later ones are left out where there is no room. */
function logTicks(at, gap) {
	const first = Math.floor(Math.log10(at.low));
	const powers = Array.from(
		{ length: Math.ceil(Math.log10(at.high)) - first + 1 },
		(_, i) => first + i,
	);
	const round = [1, 3, 2, 5, 1.5, 7]
		.flatMap(digit => powers.map(e => +(digit * 10 ** e).toPrecision(3)))
		.filter(t => t >= at.low * 0.999 && t <= at.high * 1.001);
	return round.reduce(
		(kept, t) => (kept.every(k => Math.abs(at(k) - at(t)) >= gap) ? [...kept, t] : kept),
		[],
	);
}

function tickText(v) {
	const size = Math.abs(v);
	if (size && size < 1e-3)
		return html`10<tspan dy="-4" font-size="9">${Math.round(Math.log10(size))}</tspan>`;
	return size >= 1e6
		? +(v / 1e6).toPrecision(2) + " M"
		: size >= 1e4
			? +(v / 1e3).toPrecision(3) + " k"
			: String(+v.toPrecision(3));
}

/* The numbers of the axis on the left, with grid lines, and of the axis below. */
export const axisY = (y, left, right, ticks, unit = "") =>
	ticks.map(t => [
		line(left, y(t), right, y(t)),
		text(left - 6, y(t) + 4, [tickText(t), unit], "tick end"),
	]);

export const axisX = (x, bottom, ticks) =>
	ticks.map(t => text(x(t), bottom + 17, tickText(t), "tick mid"));

/* Moves positions apart, until they are at least `gap` apart if there is room. */
function spread(wished, gap, low, high) {
	const list = wished.map((y, i) => ({ y, i })).sort(by(p => p.y));
	const room = (high - low) / Math.max(1, list.length - 1);
	gap = Math.min(gap, room);
	// Pushes positions up from the lower end, then back from the upper end.
	list.reduce((least, p) => (p.y = Math.max(p.y, least)) + gap, low);
	list.reduceRight((most, p) => (p.y = Math.min(p.y, most)) - gap, high);
	return list.sort(by(p => p.i)).map(p => p.y);
}

/* Draws curves with marks and whiskers at their points, and names at their ends.
   A series has points [x, y, low, high], a method or a colour, and a name. It may have a value, a link
   and a tip. */
export function curves(x, y, series, { gap = 16, out = 9 } = {}) {
	const end = s => s.points[s.points.length - 1];
	const labels = spread(
		series.map(s => y(end(s)[1])),
		gap,
		y.to,
		y.from,
	);
	return series.map((s, n) => {
		const [ex, ey] = end(s);
		const at = x(ex) + out;
		const far = Math.abs(labels[n] - y(ey)) > 3 && out > 12;
		const marks = s.points.map(([px, py, low, high]) => [
			low && line(x(px), y(low), x(px), y(high), "whisker"),
			s.method && shape(s.method, x(px), y(py), 4.8),
		]);
		const value = s.value && html`<tspan dx="5" class="value">${s.value}</tspan>`;
		const label = [s.name, value];
		const drawn = s.points.map(p => [x(p[0]), y(p[1])]);
		const body = html`
			<title>${s.tip}</title>
			${curve(drawn, s.kind)}
			${marks}
			${far && line(x(ex) + 7, y(ey), at - 3, labels[n], "leader")}
			${text(at, labels[n] + 4, label, `label halo ${s.bold ? "bold" : ""}`)}`;
		const colour = `color:${s.colour ?? hue(s.method)}`;
		return s.href
			? html`<a class="hit" href="${s.href}" style="${colour}">${body}</a>`
			: html`<g style="${colour}">${body}</g>`;
	});
}

/* Places the labels of points so that they do not overlap. Tries positions on growing rings around each point and takes the
   cheapest. A label that is far from its point gets a leader, and one without room is left out. */
export function place(points, box, bars) {
	const done = [];
	const squares = points.map(o => [o.x - 9, o.y - 9, o.x + 9, o.y + 9]);
	const overlap = (a, b) =>
		Math.max(0, Math.min(a[2], b[2]) - Math.max(a[0], b[0])) *
		Math.max(0, Math.min(a[3], b[3]) - Math.max(a[1], b[1]));
	const hits = (d, list) =>
		list.filter(([x, y]) => x > d[0] && x < d[2] && y > d[1] && y < d[3]).length;
	for (const p of [...points].sort((a, b) => b.priority - a.priority || a.y - b.y)) {
		let best = null;
		// Ring 0 has four positions right beside the point, further rings have 16.
		for (let ring = 0; ring < 9; ring++)
			for (let turn = 0; turn < 16; turn += ring ? 1 : 4) {
				const angle = (turn * Math.PI) / 8;
				const r = 13 + ring * 11;
				const cos = Math.cos(angle);
				const cx = p.x + cos * (r + (Math.abs(cos) > 0.3 ? p.w / 2 : 0));
				const cy = p.y + Math.sin(angle) * (r + 7);
				const q = [cx - p.w / 2, cy - 8, cx + p.w / 2, cy + 8];
				if (
					q[0] < box[0] ||
					q[1] < box[1] ||
					q[2] > box[2] ||
					q[3] > box[3] ||
					done.some(d => overlap(q, d) > 0)
				)
					continue;
				const ex = clamp(p.x, q[0], q[2]);
				const ey = clamp(p.y, q[1] + 3, q[3] - 3);
				const apart = o =>
					Math.hypot(o.x - clamp(o.x, q[0], q[2]), o.y - clamp(o.y, q[1], q[3]));
				// Without a leader a label must be clearly nearest to its own point.
				const tied = ring || points.some(o => apart(o) < apart(p) + 8);
				const leader = tied
					? [0.2, 0.4, 0.6, 0.8].map(t => [p.x + t * (ex - p.x), p.y + t * (ey - p.y)])
					: [];
				// What the label or its leader would cover: other marks, the bars, and labels that are placed already.
				const crossed =
					sum(
						squares.map((d, i) =>
							points[i] === p ? 0 : 5 * overlap(q, d) + 30 * hits(d, leader),
						),
					) +
					sum(bars.map(d => 1.6 * overlap(q, d))) +
					sum(done.map(d => 40 * hits(d, leader)));
				const covers = points.filter(
					o => o !== p && o.x > q[0] - 2 && o.x < q[2] + 2 && o.y > q[1] - 2 && o.y < q[3] + 2,
				).length;
				// A label at the right of its point costs least.
				const cost = 1000 * covers + ring * 22 + (turn === 0 ? 0 : turn === 8 && !ring ? 3 : 5) + crossed;
				if (!best || cost < best.cost)
					best = { cost, x: q[0], y: cy, q, end: tied && [ex, ey], leader };
			}
		// A label that covers another point's mark would seem to name that point.
		p.label = best && best.cost < (p.priority ? 1000 : 420) ? best : null;
		if (p.label)
			done.push(best.q, ...best.leader.map(([x, y]) => [x - 2, y - 2, x + 2, y + 2]));
	}
}
