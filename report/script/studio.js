/* The studio: fastphong itself, compiled to WebAssembly, which draws scenes and figures in the page. */

/* Inflates bytes that are written in base 64. */
async function inflate(text) {
	const packed = Uint8Array.from(atob(text), c => c.charCodeAt(0));
	const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
	return new Uint8Array(await new Response(stream).arrayBuffer());
}

/* The JSON of an element that may be missing. */
const jsonOf = id => JSON.parse($("#" + id)?.textContent ?? "null");

/* True if this page and this browser can draw; what fails later says so. */
const CAN_DRAW =
	!!$("#live-module") && "WebAssembly" in window && "DecompressionStream" in window;

let module;

/* Compiles the module, once: each instance of it is one studio. */
const compiled = () =>
	(module ??= inflate(jsonOf("live-module")).then(bytes => WebAssembly.compile(bytes)));

class Studio {
	static async make() {
		const studio = new Studio();
		const { exports } = await WebAssembly.instantiate(await compiled(), {});
		return Object.assign(studio, { exports });
	}

	/* Numbers in the module's memory, which moves when it grows: the address is computed first. */
	at(Kind, address, count) {
		return new Kind(this.exports.memory.buffer, address, count);
	}

	/* Writes a text, or bytes, for the next function. */
	put(text) {
		const bytes = typeof text === "string" ? new TextEncoder().encode(text) : text;
		this.at(Uint8Array, this.exports.text(bytes.length), bytes.length).set(bytes);
	}

	said(length) {
		return new TextDecoder().decode(this.at(Uint8Array, this.exports.said(), length));
	}

	/* What a function returned; less than 0 is an error. */
	ask(number) {
		if (number < 0) throw Error(this.said(-number));
		return number;
	}

	/* Takes a file: its name is a line before it. */
	file(name, bytes) {
		const head = new TextEncoder().encode(name + "\n");
		const all = new Uint8Array(head.length + bytes.length);
		all.set(head);
		all.set(bytes, head.length);
		this.put(all);
		this.exports.file();
	}

	/* Loads a scene, as text, or the name of a mesh file; returns how many polygons it has. */
	load(scene) {
		this.put(scene);
		return this.ask(this.exports.load());
	}

	/* What was odd about the scene. */
	warnings() {
		return this.said(this.exports.warnings());
	}

	/* Azimuth and elevation of the frame: no camera turns beyond the poles. */
	turned() {
		return [...this.at(Float64Array, this.exports.turned(), 2)];
	}

	/* The direction to the first light: to the right, upward, toward the eye. */
	light() {
		return [...this.at(Float64Array, this.exports.light(), 3)];
	}

	/* Makes the frame of a view, with the samples of the scene if none are given. */
	frame(w, h, { azimuth, elevation, size, light, exponent }, samples = 0) {
		const [x, y, z] = light ?? [0, 0, 0];
		this.ask(
			this.exports.frame(w, h, azimuth, elevation, size, x, y, z, exponent, samples),
		);
	}

	/* The scene as it is looked at, as a file. */
	scene() {
		return this.said(this.ask(this.exports.scene()));
	}

	/* Draws by a method, or as the exact picture; returns the milliseconds that it took. */
	draw(method, exact = 0) {
		this.put(method);
		const start = performance.now();
		this.ask(this.exports.draw(exact));
		return performance.now() - start;
	}

	/* The bytes of the picture, until the next function is called. */
	bytes(w, h) {
		return this.at(Uint8ClampedArray, this.exports.picture(), 4 * w * h);
	}

	/* Compares the picture with the exact one, in grey levels. */
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

	/* The parameters of a method. */
	parameters(method) {
		this.put(method);
		return JSON.parse(this.said(this.ask(this.exports.parameters())));
	}

	/* Traces the mesh of the figure that can be stopped, by a variant of a method, with its corners at x1 y1 x2 y2 …, in pixels. */
	trace(variant, corners) {
		this.put(`${variant}\n${corners.join(" ")}`);
		return JSON.parse(this.said(this.ask(this.exports.trace())));
	}

	/* Makes a figure for values of its handles: its content, and its pictures. */
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
