/* Scenes that are drawn in the page, from wherever one looks: a second source of pictures. */

/* How a scene is looked at when nothing was moved. */
const STILL = { azimuth: 0, elevation: 0, size: 1, light: null, exponent: 0, given: {} };

/* True if a view is that of the stored pictures. */
const isStill = view =>
	!view.azimuth &&
	!view.elevation &&
	view.size === 1 &&
	!view.light &&
	!view.exponent &&
	!Object.keys(view.given).length;

/* True if the page has what the scene is made of, and can draw it. */
const canTurn = s => CAN_DRAW && (!!s.own || !!$(`#live-${s.number}`));

/* The name of a method with the parameters that were chosen. */
const variantOf = (m, given = {}) =>
	[m, ...Object.entries(given).map(([k, v]) => `${k}=${v}`)].join(":");

/* The drawings of a method that its time is taken from, and of those the first, which are slower. */
const SAMPLES = 24;
const WARM_UP = 2;

/* Stands for a scene where `picture` and `errors` are asked for one: what it says of the scene is the scene's own, its
   pictures and rows are of the view. */
class LiveScene {
	static async make(s) {
		const live = Object.assign(new LiveScene(), s, { scene: s, times: {} });
		live.studio = await Studio.make();
		const { scene, files } = s.own ?? jsonOf(`live-${s.number}`);
		for (const [name, bytes] of files)
			live.studio.file(name, typeof bytes === "string" ? await inflate(bytes) : bytes);
		live.polygons = live.studio.load(scene);
		live.list = s.list.filter(m => live.studio.knows(m));
		live.firstLight = live.studio.light();
		live.look(STILL, false);
		return live;
	}

	/* Looks from elsewhere. While something moves, pixels have one sample, and errors are from naive Phong, as the reference
	   takes longer: in every third frame, unless `maps` are shown, since numbers need not change as fast as pictures. */
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

	variant(m) {
		return variantOf(m, this.view.given[m]);
	}

	/* Draws by a method, and notes how that went. */
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

	/* The picture by a method, drawn unless it has been. */
	one(m) {
		if (this.drawn[m]) return this.drawn[m];
		const { studio, w, h } = this;
		this.draw(m);
		const bytes = studio.bytes(w, h);
		// What is kept must not lie in the module's memory.
		const image = new ImageData(this.moves ? bytes : bytes.slice(), w, h);
		const canvas = create("canvas");
		[canvas.width, canvas.height] = [w, h];
		canvas.getContext("2d").putImageData(image, 0, 0);
		return (this.drawn[m] = { canvas, px: image.data, errors: this.errors[m] });
	}

	/* The mean of the faster half of the latest drawings. */
	time(m, ms) {
		// Moving and at rest pixels have other samples.
		const all = (this.times[`${this.variant(m)} ${this.exact}`] ??= []);
		all.push(ms);
		if (all.length > SAMPLES + WARM_UP) all.splice(WARM_UP, 1);
		const fast = all.slice(WARM_UP).sort((a, b) => a - b);
		const half = fast.slice(0, Math.ceil(fast.length / 2));
		return half.length > 1 ? sum(half) / half.length : null;
	}

	/* The colours of errors, as of stored pictures. */
	map(m, top) {
		if (!this.errors[m]) this.draw(m);
		const [errors, colours] = [this.errors[m], heatTable(top)];
		const scale = HEAT_STEPS / (top || 255);
		return canvasOf(this, i => colours[Math.min(HEAT_STEPS, errors[i] * scale) | 0]);
	}
}

/* A mesh file of the reader's as a scene, with the material libraries that come with it. */
async function ownScene(list, s) {
	const file = list.find(f => /\.(obj|stl|ply|off)$/i.test(f.name));
	if (!file) throw Error(`${list[0].name}: expected a mesh file that ends in .obj, .stl, .ply or .off`);
	if (sum(list.map(f => f.size)) > 5e7) throw Error(`${file.name}: over 50 MB`);
	const read = async f => [f.name, new Uint8Array(await f.arrayBuffer())];
	const own = { scene: file.name, files: await Promise.all(list.map(read)) };
	const { w, h } = s;
	const methods = IDS.filter(m => SCENES[0].list.includes(m));
	return { id: "own", title: file.name, w, h, encoding: "linear", list: methods, rows: {}, own };
}
