/* Scenes that the page draws itself, from any direction: the second source of pictures beside the stored ones. */

import { BASE, IDS, SCENES } from "./data.js";
import { HEAT_STEPS, heatTable } from "./errors.js";
import { nameOf } from "./marks.js";
import { $, create, paint } from "./markup.js";
import { sum } from "./numbers.js";
import { canvasOf } from "./pictures.js";
import { CAN_DRAW, inflate, jsonOf, Studio } from "./studio.js";
import { STILL } from "./viewer.js";

/* True if the page has the scene's files, and can draw them. */
export const canTurn = s => CAN_DRAW && (!!s.own || !!$(`#live-${s.number}`));

/* The name of a method with its chosen parameters. */
export const variantOf = (m, given = {}) =>
	[m, ...Object.entries(given).map(([k, v]) => `${k}=${v}`)].join(":");

/* How many of the latest drawings decide a method's time, and how many of the first do not count because they are slower. */
const SAMPLES = 24;
const WARM_UP = 2;

/* A scene that `picture` and `errors` accept in place of a stored one. It has the facts of the scene, but pictures and rows of the
   current view. */
export class LiveScene {
	w;
	h;
	list;
	polygons;
	firstLight;

	constructor(s, studio) {
		Object.assign(this, s);
		this.scene = s;
		this.studio = studio;
		this.times = {};
		/* The notes that were shown. */
		this.told = new Set();
	}

	static async make(s) {
		const live = new LiveScene(s, await Studio.make());
		const { scene, files } = s.own ?? jsonOf(`live-${s.number}`);
		for (const [name, bytes] of files)
			live.studio.file(name, typeof bytes === "string" ? await inflate(bytes) : bytes);
		live.polygons = live.studio.load(scene, live.w, live.h);
		live.list = s.list.filter(m => live.studio.knows(m));
		live.firstLight = live.studio.light();
		live.look(STILL, false);
		return live;
	}

	/* Changes the view. While something moves, a pixel has one sample, and errors are against naive Phong, because the reference is
   slower. They are then computed only in every third frame, since numbers need not change as fast as pictures, unless `maps` are
   shown. */
	look(view, moves, maps) {
		this.view = view;
		this.moves = moves;
		this.frames = moves ? (this.frames ?? -1) + 1 : -1;
		this.judges = !moves || maps || this.frames % 3 === 0;
		this.exact = moves && this.list.includes(BASE) ? BASE : "reference";
		this.studio.frame(this.w, this.h, view, moves ? 1 : 0);
		if (this.judges) {
			this.studio.draw(this.exact, 1);
			this.rows = {};
		}
		this.drawn = {};
		this.errors = {};
		this.count = {};
	}

	/* Returns the notes about the scene in this view that were not returned before. Figures change with the view: a note that differs in
   nothing else is not new. */
	news() {
		const isNew = note => {
			const kind = note.replace(/\d+/g, "");
			return !this.told.has(kind) && this.told.add(kind);
		};
		return this.studio.notes().filter(isNew);
	}

	variant(m) {
		return variantOf(m, this.view.given[m]);
	}

	/* Draws by a method, and notes its time and its errors. */
	draw(m) {
		if (m !== "reference" && !this.list.includes(m)) throw Error(`${nameOf(m)} is not known here`);
		const ms = this.time(m, this.studio.draw(m === "reference" ? m : this.variant(m)));
		if (this.judges) {
			const { errors, ...q } = this.studio.compare();
			this.errors[m] = errors;
			if (m !== "reference") this.rows[m] = q;
		}
		if (this.rows[m]) this.rows[m].ms = ms;
	}

	/* Returns the picture by a method, and draws it if need be. */
	one(m) {
		if (this.drawn[m]) return this.drawn[m];
		const { studio, w, h } = this;
		this.draw(m);
		const bytes = studio.bytes(w, h);
		// A picture that is kept must not lie in the module's memory, which the next drawing overwrites.
		const image = new ImageData(this.moves ? bytes : bytes.slice(), w, h);
		const canvas = paint(create("canvas"), image);
		return (this.drawn[m] = { canvas, px: image.data, errors: this.errors[m] });
	}

	/* Returns the mean time of the faster half of the latest drawings. */
	time(m, ms) {
		// Pixels have fewer samples while something moves, so these times are kept apart.
		const all = (this.times[`${this.variant(m)} ${this.exact}`] ??= []);
		all.push(ms);
		if (all.length > SAMPLES + WARM_UP) all.splice(WARM_UP, 1);
		const fast = all.slice(WARM_UP).sort((a, b) => a - b);
		const half = fast.slice(0, Math.ceil(fast.length / 2));
		return half.length > 1 ? sum(half) / half.length : null;
	}

	/* Draws the error map of a method, in the colours of the stored pictures' maps. */
	map(m, top) {
		if (!this.errors[m]) this.draw(m);
		const [errors, colours] = [this.errors[m], heatTable(top)];
		const scale = HEAT_STEPS / (top || 255);
		return canvasOf(this, i => colours[Math.min(HEAT_STEPS, errors[i] * scale) | 0]);
	}
}

/* Makes a scene of a mesh file of the reader, with the material libraries that come with it. */
export async function ownScene(list, s) {
	const file = list.find(f => /\.(obj|stl|ply|off)$/i.test(f.name));
	if (!file) throw Error(`${list[0].name}: expected a mesh file that ends in .obj, .stl, .ply or .off`);
	if (sum(list.map(f => f.size)) > 5e7) throw Error(`${file.name}: over 50 MB`);
	const read = async f => [f.name, new Uint8Array(await f.arrayBuffer())];
	const own = { scene: file.name, files: await Promise.all(list.map(read)) };
	const { w, h } = s;
	const methods = IDS.filter(m => SCENES[0].list.includes(m));
	return { id: "own", title: file.name, w, h, encoding: "srgb", list: methods, rows: {}, own };
}
