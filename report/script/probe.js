/* The probe: the pixel that the reader points at, by every method. */

import { unfolded } from "./controls.js";
import { errors } from "./errors.js";
import { keyOf, mark, MARKED, nameOf } from "./marks.js";
import { $, fill, html, write } from "./markup.js";
import { num } from "./numbers.js";
import { picture } from "./pictures.js";

/* Counts the calls. If several wait for pictures, only the last one draws. */
let probing = 0;

/* Shows every method at one pixel: where the reader points, else the held one, else the worst one. */
export async function probe(v) {
	const s = v.source;
	const turn = ++probing;
	const of = v.a === "reference" ? v.b : v.a;
	const rest = (v.rest = (!v.hover && !v.pin && s.rows[of]?.worst) || null);
	const pixel = v.hover ?? v.pin ?? rest;
	if ((!s.drawn && !s.own) || v.hand.moves) return;
	const list = ["reference", ...s.list];
	const at = pixel && pixel[1] * s.w + pixel[0];
	const found =
		pixel &&
		(await Promise.all(
			list.map(async m => {
				const [{ px }, map] = await Promise.all([picture(s, m), errors(s, m)]);
				return [m, { colour: px.slice(4 * at, 4 * at + 3), error: map[at] }];
			}),
		));
	if (turn !== probing) return;
	const here = Object.fromEntries(found ?? []);
	const shown = list.filter(
		m =>
			list.length < 17 ||
			unfolded.has("methods") ||
			m === v.a ||
			m === v.b ||
			keyOf(m) ||
			MARKED.has(m),
	);
	const value = m => {
		const { colour, error } = here[m] ?? {};
		if (!pixel || m === "reference") return pixel && [...colour].join(" ");
		return error ? (error % 1 ? num(error, 2) : error) : "·";
	};
	const why = rest ? ` · worst of ${nameOf(of)}` : v.pin && !v.hover ? " · held" : "";
	write({ "probe-where": pixel ? pixel.join(", ") + why : "point at the picture" });
	const entries = shown.map(
		m => html`
			<li><button data-key="${m}" class="${m === v.a ? "a" : m === v.b ? "b" : ""}">
				<kbd>${keyOf(m) ?? "·"}</kbd>
				${mark(m)}
				<span class="name">${nameOf(m)}</span>
				<i style="background:rgb(${here[m]?.colour ?? ""})"></i>
				<span class="value ${here[m]?.error > 1 ? "bad" : ""}">${value(m)}</span>
			</button></li>`,
	);
	const more =
		shown.length < list.length &&
		html`<li><button data-fold="methods">All ${list.length - 1} methods</button></li>`;
	fill($("#probe-list"), html`${entries}${more}`);
	if (!pixel) return;
	// Draws seven by seven pixels around it from the left and the right picture, ten times as large.
	const pen = $("#probe canvas").getContext("2d");
	const images = await Promise.all([picture(s, v.a), picture(s, v.b)]);
	pen.imageSmoothingEnabled = false;
	pen.strokeStyle = "#fff";
	images.forEach(({ canvas }, n) => {
		pen.drawImage(canvas, pixel[0] - 3, pixel[1] - 3, 7, 7, 72 * n, 0, 70, 70);
		pen.strokeRect(72 * n + 30.5, 30.5, 9, 9);
	});
}
