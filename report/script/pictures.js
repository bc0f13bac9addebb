/* Pictures: each is stored as three deflated planes of its difference from the picture most like it. */

import { FIGURES, S } from "./data.js";
import { $, $$, create, paint } from "./markup.js";
import { clamp, memo } from "./numbers.js";
import { inflate } from "./studio.js";

/* Unpacks three planes. Each byte is stored as its difference from the previous byte, modulo 256. */
async function unpack(text, { w, h }) {
	const bytes = await inflate(text);
	return [0, 1, 2].map(p => {
		const plane = bytes.subarray(p * w * h, (p + 1) * w * h);
		for (let i = 1; i < plane.length; i++) plane[i] += plane[i - 1];
		return plane;
	});
}

/* Adds the planes `base` to the planes `more`, modulo 256. */
function add(more, base) {
	more.forEach((plane, p) => {
		const under = base[p];
		for (let i = 0; i < plane.length; i++) plane[i] += under[i];
	});
	return more;
}

/* The planes of a method's picture: green, red − green and blue − green. */
const planes = (s, m) =>
	memo(`planes ${s.id} ${m}`, async () => {
		const data = memo(`json ${s.id}`, () => JSON.parse($(`#pictures-${s.number}`).textContent));
		// The reference is stored whole, and every other picture as its difference from one that is nearer to it.
		if (m === "reference") return unpack(data.reference, s);
		const { on = "reference", add: more } = data.rows[m];
		const base = await planes(s, on);
		return more ? add(await unpack(more, s), base) : base;
	});

/* A canvas of a scene's size, and its pixels; `word` gives alpha, blue, green, red. */
export function canvasOf(s, word) {
	const image = new ImageData(s.w, s.h);
	const words = new Uint32Array(image.data.buffer);
	for (let i = 0; i < words.length; i++) words[i] = word(i);
	return { canvas: paint(create("canvas"), image), px: image.data };
}

/* The picture in grey levels, linear or sRGB as the scene's encoding says. It is stored, or drawn in the page. */
export const picture = (s, m) =>
	s.one?.(m) ??
	memo(`picture ${s.id} ${m}`, async () => {
		const [green, red, blue] = await planes(s, m);
		return canvasOf(
			s,
			i =>
				(255 << 24) |
				(((blue[i] + green[i]) & 255) << 16) |
				(green[i] << 8) |
				((red[i] + green[i]) & 255),
		);
	});

/* A promise of everything that is still to be drawn. */
let queue = Promise.resolve();

/* Does something when everything before it is done. */
const later = what => {
	queue = queue
		.then(() => new Promise(done => setTimeout(done, 8)))
		.then(what)
		.catch(() => {});
};

/* Draws the part x, y, w, h of a picture into a canvas of some size. */
async function drawPart(canvas, s, m, part, size, smooth) {
	const { canvas: image } = await picture(s, m);
	[canvas.width, canvas.height] = size;
	const pen = canvas.getContext("2d");
	pen.imageSmoothingEnabled = smooth;
	pen.imageSmoothingQuality = "high";
	pen.drawImage(image, ...part, 0, 0, ...size);
}

/* Draws the pictures on the buttons that choose a scene. */
export const thumbs = root =>
	$$("button", root).forEach(b => {
		const s = S[b.dataset.key];
		if (s.drawn)
			later(() =>
				drawPart(
					$("canvas", b),
					s,
					"reference",
					[0, 0, s.w, s.h],
					[112, (112 * s.h) / s.w],
					true,
				),
			);
	});

/* Draws the part of a picture around a pixel, enlarged without smoothing. */
export function crop(canvas, s, m, worst, w, h) {
	[w, h] = [Math.min(w, s.w), Math.min(h, s.h)];
	const [cx, cy] = worst ?? [s.w / 2, s.h / 2];
	const x = Math.round(clamp(cx - w / 2, 0, s.w - w));
	const y = Math.round(clamp(cy - h / 2, 0, s.h - h));
	later(() => drawPart(canvas, s, m, [x, y, w, h], [w * 2, h * 2], false));
}

/* The pictures of a figure, as addresses of images. */
export const figurePictures = f =>
	memo("figures", () => JSON.parse($("#figure-pictures").textContent))[FIGURES.indexOf(f)] ?? [];
