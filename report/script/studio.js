/* The studio: fastphong itself, compiled to WebAssembly, which draws scenes and figures in the page. */

import { $ } from "./markup.js";
import { clamp, sum } from "./numbers.js";

/* Inflates bytes that are encoded in base 64. */
export async function inflate(text) {
	const packed = Uint8Array.from(atob(text), c => c.charCodeAt(0));
	const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
	return new Uint8Array(await new Response(stream).arrayBuffer());
}

/* The JSON of an element that may be missing. */
export const jsonOf = id => JSON.parse($("#" + id)?.textContent ?? "null");

/* True if this page and this browser can draw. Drawing may still fail later, with a message. */
export const CAN_DRAW =
	!!$("#live-module") && "WebAssembly" in window && "DecompressionStream" in window;

/** @type {Promise<WebAssembly.Module>} */
let module;

/* Compiles the module once. Each instance of it is one studio. */
const compiled = () =>
	(module ??= inflate(jsonOf("live-module")).then(bytes => WebAssembly.compile(bytes)));

export class Studio {
	constructor({ exports }) {
		/** @type {LiveModule} */
		this.exports = exports;
	}

	static async make() {
		return new Studio(await WebAssembly.instantiate(await compiled(), {}));
	}

	/* Returns values in the module's memory. This memory moves when it grows, so a caller computes the address first. */
	at(Kind, address, count) {
		return new Kind(this.exports.memory.buffer, address, count);
	}

	/* Passes a text, or bytes, to the module's next function. */
	put(text) {
		const bytes = typeof text === "string" ? new TextEncoder().encode(text) : text;
		this.at(Uint8Array, this.exports.text(bytes.length), bytes.length).set(bytes);
	}

	said(length) {
		return new TextDecoder().decode(this.at(Uint8Array, this.exports.said(), length));
	}

	/* Checks what a function of the module returned: a negative value is the length of an error message. */
	ask(number) {
		if (number < 0) throw Error(this.said(-number));
		return number;
	}

	/* Passes a file to the module, after a line with its name. */
	file(name, bytes) {
		const head = new TextEncoder().encode(name + "\n");
		const all = new Uint8Array(head.length + bytes.length);
		all.set(head);
		all.set(bytes, head.length);
		this.put(all);
		this.exports.file();
	}

	/* Loads a scene from its text, or a mesh file by its name, for pictures of this size. Returns how many polygons it has. */
	load(scene, w, h) {
		this.put(scene);
		return this.ask(this.exports.load(w, h));
	}

	/* Returns what to know about the scene and its frame, a note per line, warnings first. Takes as long as drawing the reference. */
	notes() {
		return this.said(this.exports.notes()).split("\n").filter(Boolean);
	}

	/* Returns azimuth and elevation of the frame, which stop at the poles. */
	turned() {
		return [...this.at(Float64Array, this.exports.turned(), 2)];
	}

	/* Returns the direction to the first light: to the right, upward, toward the eye. */
	light() {
		return [...this.at(Float64Array, this.exports.light(), 3)];
	}

	/* Makes the frame of a view. Takes the scene's samples per pixel if `samples` is 0. */
	frame(w, h, { azimuth, elevation, size, light, exponent }, samples = 0) {
		const [x, y, z] = light ?? [0, 0, 0];
		this.ask(
			this.exports.frame(w, h, azimuth, elevation, size, x, y, z, exponent, samples),
		);
	}

	/* Returns the scene in its current view as the text of a scene file. */
	scene() {
		return this.said(this.ask(this.exports.scene()));
	}

	/* Draws by a method. With `exact` draws the picture that others are compared with. Returns how many milliseconds it took. */
	draw(method, exact = 0) {
		this.put(method);
		const start = performance.now();
		this.ask(this.exports.draw(exact));
		return performance.now() - start;
	}

	/* Returns the bytes of the picture, which are valid until the next function is called. */
	bytes(w, h) {
		return this.at(Uint8ClampedArray, this.exports.picture(), 4 * w * h);
	}

	/* Compares the picture with the exact one. Errors are in grey levels. */
	compare() {
		const [max, x, y, rms, count] = this.at(Float64Array, this.exports.compare(), 5);
		const errors = this.at(Float32Array, this.exports.errors(), count).slice();
		return { max, rms, worst: max > 0 ? [x, y] : null, errors };
	}

	/* True if there is such a method. */
	knows(method) {
		this.put(method);
		return this.exports.parameters() >= 0;
	}

	/* Returns the parameters of a method. */
	parameters(method) {
		this.put(method);
		return JSON.parse(this.said(this.ask(this.exports.parameters())));
	}

	/* Traces how a variant of a method draws the figure that can be stopped, with corners at x1 y1 x2 y2 …, in pixels. */
	trace(variant, corners) {
		this.put(`${variant}\n${corners.join(" ")}`);
		return JSON.parse(this.said(this.ask(this.exports.trace())));
	}

	/* Makes a figure for these values of its handles. Returns its content and its pictures. */
	/** @returns {{ content: FigureContent, pictures: ImageData[] }} */
	figure(name, values) {
		this.put(`${name}\n${values.join(" ")}`);
		const content = JSON.parse(this.said(this.ask(this.exports.figure())));
		const count = sum(content.blocks.map(b => b.pictures?.shown.length ?? 0));
		const pictures = Array.from({ length: count }, (_, i) => {
			const [w, h, address] = this.at(Uint32Array, this.exports.panel(i), 3);
			return new ImageData(this.at(Uint8ClampedArray, address, 4 * w * h).slice(), w, h);
		});
		return { content, pictures };
	}
}

let ofFigures;

/* The studio in which all figures are drawn, one after the other. It is made once. */
export const figureStudio = () => (ofFigures ??= Studio.make());

/* Reads the values of a figure's handles from an address. */
export const valuesOf = ({ handles }, query) =>
	handles.map(({ name, range: [low, high], step, start }) => {
		const given = query?.get(name);
		const value = given && isFinite(given) ? +given : start;
		return clamp(Math.round(value / step) * step, low, high);
	});
