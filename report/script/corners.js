/* Charts of the study of speed. */

import { axisY, curves, line, logScale, scale, svg, text, textWidth, widthOf } from "./charts.js";
import { isTooBusy, levelName, M, ratioText, STUDY } from "./data.js";
import { MARKED, shortName } from "./marks.js";
import { $, html } from "./markup.js";
import { by, num, plural } from "./numbers.js";

/* What the study timed: the shading loop and whole pictures, in scalar code and in SIMD. Empty if the times tell nothing. */
export const CORNERS =
	STUDY && !isTooBusy(STUDY) ? STUDY.corners.map((c, i) => ({ ...c, i })) : [];
export const oneLight = CORNERS.filter(c => c.lights === 1);

export let cornerMode = "same";

/* True if a method draws naive Phong's picture in all scenes; without scenes, on the sphere. */
const isSame = m => (M[m.method]?.max ?? m.levels_off) <= 1;
export const WORKS = { kernel: "loop", frame: "picture" };
export const ratioIn = (m, c) => m?.corners[c.i].ratio_to_naive;

/* The fastest methods of a corner that draw naive Phong's picture: the first, and those whose intervals are not apart from its interval. */
export function fastest(c) {
	const list = STUDY.methods.filter(m => isSame(m) && ratioIn(m, c));
	const [first] = list.sort(by(m => -ratioIn(m, c).typical));
	return list.filter(m => ratioIn(m, c).high >= ratioIn(first, c).low);
}

/* Draws a line for each method over some places. A place has a name, a note, and functions of a method: `values` returns [v, low, high],
   and `told` the value as text. */
function slopes(id, label, list, panes, gap = 20) {
	const el = $(id);
	const W = widthOf(el);
	const part = W < 460 ? W : W / panes.length;
	const l = 40;
	const t = 44;
	const b = Math.max(430, t + list.length * 16.5);
	if (!W || !list.length) return;
	const pane = places => {
		const values = list.flatMap(m => places.flatMap(p => p.values(m)));
		const last = m => places[places.length - 1].told(m);
		const valueAt = m => p => `${p.name} ${p.note} ${p.told(m)}`;
		const tip = m => `${shortName(m.method)}: ${places.map(valueAt(m)).join(", ")}`;
		const r =
			part -
			34 -
			Math.max(...list.map(m => textWidth(`${shortName(m.method)} ${last(m)}`, true)));
		const x = scale(false, 0, places.length - 1, l + 30, r);
		const y = logScale(values, 1.05, b, t);
		return svg(
			part,
			b + 10,
			label,
			[
				axisY(y, l, r, y.ticks(gap)),
				places.map((p, i) => [
					line(x(i), t, x(i), b),
					text(x(i), 14, p.name, "bold mid"),
					text(x(i), 30, p.note, "tick mid"),
				]),
				curves(
					x,
					y,
					list.map(m => ({
						method: m.method,
						name: shortName(m.method),
						value: last(m),
						bold: MARKED.has(m.method),
						kind: MARKED.has(m.method) ? "" : "thin",
						href: `#methods/${m.method}`,
						tip: tip(m),
						points: places.map((p, i) => [i, ...p.values(m)]),
					})),
					{ gap: 15.5, out: 22 },
				),
			],
			true,
		);
	};
	el.innerHTML = html`${panes.map(pane)}`;
}

/* Draws both charts, with all methods or only those that draw naive Phong's picture. */
export function corners(mode) {
	cornerMode = mode;
	const placeOf = c => ({
		name: WORKS[c.work],
		note: levelName(c),
		values: m => ["typical", "low", "high"].map(k => ratioIn(m, c)[k]),
		told: m => ratioText(ratioIn(m, c)),
	});
	const list = STUDY.methods.filter(m => cornerMode === "all" || isSame(m));
	slopes(
		"#corners",
		"Speed of methods in the shading loop and in whole pictures",
		list.filter(m => oneLight.every(c => ratioIn(m, c))),
		[oneLight.map(placeOf)],
	);
	const kernels = [true, false]
		.map(scalar => CORNERS.filter(c => c.work === "kernel" && c.scalar === scalar))
		.filter(pair => pair.length > 1);
	slopes(
		"#lights",
		"Nanoseconds per pixel with one and four lights",
		list.slice(0, 14),
		kernels.map(pair =>
			pair.map(c => ({
				name: levelName(c),
				note: plural(c.lights, "light"),
				values: m =>
					["typical_ns", "low_ns", "high_ns"].map(
						k => m.corners[c.i].timing[k] / STUDY.span,
					),
				told: m => num(m.corners[c.i].timing.typical_ns / STUDY.span, 2),
			})),
		),
		40,
	);
}
