/* Error maps: differences from the reference, in colours. */

import { create } from "./markup.js";
import { memo } from "./numbers.js";
import { canvasOf, picture } from "./pictures.js";

/* Turns a stored sRGB value in 0..=1 into linear light (IEC 61966-2-1). */
const fromSrgb = c => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);

/* The error of each pixel: the largest difference of a channel from the reference, in linear levels. */
export const errors = (s, m) =>
	s.one?.(m).errors ??
	memo(`errors ${s.id} ${m}`, async () => {
		const [{ px: here }, { px: there }] = await Promise.all([
			picture(s, m),
			picture(s, "reference"),
		]);
		const grey = Float32Array.from({ length: 256 }, (_, c) =>
			s.encoding === "srgb" ? 255 * fromSrgb(c / 255) : c,
		);
		const apart = i => Math.abs(grey[here[i]] - grey[there[i]]);
		return new Float32Array(s.w * s.h).map((_, i) =>
			Math.max(apart(4 * i), apart(4 * i + 1), apart(4 * i + 2)),
		);
	});

/* The colours of the error map. Its scale is logarithmic if `top` is 0, else linear up to `top`. */
export const STOPS = [
	"#000004",
	"#1c1044",
	"#4f127b",
	"#812581",
	"#b5367a",
	"#e55064",
	"#fb8761",
	"#fec287",
	"#fcfdbf",
];

/* The scale in 256 colours, as pixels of a picture. */
const HEAT = (() => {
	const pen = create("canvas").getContext("2d");
	const ramp = pen.createLinearGradient(0, 0, 256, 0);
	STOPS.forEach((colour, i) => ramp.addColorStop(i / (STOPS.length - 1), colour));
	pen.fillStyle = ramp;
	pen.fillRect(0, 0, 256, 1);
	return new Uint32Array(pen.getImageData(0, 0, 256, 1).data.buffer);
})();

/* Where an error lies on the scale, in 0..=1. */
export const heat = (error, top) => (top ? Math.min(1, error / top) : Math.log2(1 + error) / 8);

/* The colours of errors in equal steps up to the end of the scale. A look-up is faster than a logarithm per pixel. */
export const HEAT_STEPS = 16384;
export const heatTable = top =>
	memo(`heat ${top}`, () =>
		Uint32Array.from({ length: HEAT_STEPS + 1 }, (_, i) => {
			const error = (i / HEAT_STEPS) * (top || 255);
			return HEAT[Math.round(heat(error, top) * 255)];
		}),
	);

export const errorMap = (s, m, top) =>
	s.map?.(m, top) ??
	memo(`map ${s.id} ${m} ${top}`, async () => {
		const map = await errors(s, m);
		return canvasOf(s, i => HEAT[Math.round(heat(map[i], top) * 255)]);
	});
