/* The plot of a row of the picture. */

import { remember } from "./address.js";
import { widthOf } from "./charts.js";
import { hue, named, nameOf } from "./marks.js";
import { $, fill, html, write } from "./markup.js";
import { by, clamp } from "./numbers.js";
import { picture } from "./pictures.js";
import { plot } from "./plot.js";

/* Opens or closes the plot of a row. */
export function toggleRow(v) {
	showRow(v, v.line == null ? (v.pin ?? v.rest ?? [0, v.scene.h >> 1])[1] : null);
}

/* Shows a row, or none for `null`. */
export function showRow(v, y) {
	v.line = y;
	$("#rowplot").hidden = y == null;
	$(".row", v.root).ariaPressed = y != null;
	v.draw();
	rowPlot(v);
	remember(v);
}

/* Draws the intensity of a row by each method, and its slope below. */
export async function rowPlot(v) {
	const el = $("#rowplot-chart");
	const s = v.source;
	if (v.line == null || (!s.drawn && !s.own)) return;
	const row = (v.line = clamp(v.pin ? v.pin[1] : v.line, 0, s.h - 1));
	const list = ["reference", ...s.list];
	const pixels = await Promise.all(list.map(m => picture(s, m)));
	const greys = pixels.map(({ px }) =>
		Array.from({ length: s.w }, (_, x) =>
			// Luminance, with the weights of ITU-R BT.709.
			[0.2126, 0.7152, 0.0722].reduce(
				(grey, k, c) => grey + k * px[4 * (row * s.w + x) + c],
				0,
			),
		),
	);
	const slopes = greys.map(g =>
		g.map((_, x) => (g[Math.min(s.w - 1, x + 2)] - g[Math.max(0, x - 2)]) / 4),
	);
	const bold = m => m === v.a || m === v.b;
	const drawn = [...list].sort(by(bold));
	const chart = (values, label, H) =>
		plot(
			{
				title: `Row ${row}`,
				x: ["pixel of the row"],
				y: [label],
				marks: v.pin ? [v.pin[0] + 0.5] : [],
				series: drawn.map(m => ({
					label: nameOf(m),
					colour: hue(m),
					kind: `${bold(m) ? "" : "thin"} ${m === "reference" ? "dash1" : ""}`,
					points: values[list.indexOf(m)].map((g, x) => [x + 0.5, g]),
				})),
			},
			widthOf(el) || 700,
			H,
		);
	write({ "rowplot-title": `Row ${row} of ${s.title}` });
	const names = list.map(
		m => html`<button data-key="${m}" aria-pressed="${bold(m)}">${named(m)}</button>`,
	);
	const charts = [chart(greys, "grey level", 230), chart(slopes, "slope, levels per pixel", 170)];
	fill(el, html`${charts}<div class="legend">${names}</div>`);
	v.draw();
}
