"use strict";
/* Draws the page from one JSON document and packed pictures. */

/* -- markup */
const ROOT = document.documentElement;
const $ = (selector, root = document) => root.querySelector(selector);
const $$ = (selector, root = document) => [...root.querySelectorAll(selector)];
const create = tag => document.createElement(tag);
const ENTITIES = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&#39;" };
class Markup extends String {}
const put = v => v instanceof Markup ? v : Array.isArray(v) ? v.map(put).join("") : v == null || v === false ? "" : String(v).replace(/[&<>"']/g, c => ENTITIES[c]);
/* Tags a template of HTML or SVG: escapes values that are no markup, and joins lists. */
const html = (texts, ...values) => new Markup(texts.reduce((all, text, i) => all + put(values[i - 1]) + text));
/* Puts markup into an element, and gives the focus back to the control that had it. */
function fill(el, markup) {
	const key = el.contains(document.activeElement) ? document.activeElement.dataset.key : null;
	el.innerHTML = markup;
	if (key != null) $(`[data-key="${CSS.escape(key)}"]`, el)?.focus({ preventScroll: true });
	delay("fade", 30, fadeEnds);
}
/* Fades the end of a list or table that scrolls on. */
function fadeEnd(el) {
	el.classList.toggle("more-right", el.scrollLeft + el.clientWidth < el.scrollWidth - 2);
	el.classList.toggle("more-below", el.scrollTop + el.clientHeight < el.scrollHeight - 2);
}
const SCROLLED = ".scroll, .rail, .list, .choices", fadeEnds = () => $$(SCROLLED).forEach(fadeEnd);
addEventListener("scroll", e => e.target.matches?.(SCROLLED) && fadeEnd(e.target), true);
/* Calls `choose` with the key of the button, mark or row that is chosen. */
function onChoose(el, choose) {
	el.onclick = e => {
		const chosen = e.target.closest("[data-key]");
		if (chosen) choose(chosen.dataset.key, e);
	};
	el.onkeydown = e => {
		if (!e.target.matches("g") || e.key !== "Enter" && e.key !== " ") return;
		e.preventDefault();
		choose(e.target.dataset.key, e);
	};
}
const unfolded = new Set();
/* The first ones of a long list, and the button that shows the rest. */
function folded(list, most, what) {
	const all = unfolded.has(what) || list.length < 1.2 * most;
	return [all ? list : list.slice(0, most), !all && html`<button class="fold" data-fold="${what}">All ${list.length} ${what}</button>`];
}
addEventListener("click", e => {
	const what = e.target.dataset?.fold;
	if (!what) return;
	unfolded.add(what);
	route();
});
/* Wires buttons of which one is pressed; returns what marks that one. */
function segments(el, pressed, choose) {
	const update = () => $$("button", el).forEach(b => { b.ariaPressed = b.dataset.key === pressed(); });
	onChoose(el, key => {
		choose(key);
		update();
	});
	update();
	return update;
}
/* Scrolls a chosen entry into sight. */
const reveal = el => el?.scrollIntoView({ block: "nearest", inline: "center" });
/* Writes texts into elements, by their ids. */
function write(texts) { for (const id in texts) $("#" + id).textContent = texts[id]; }
/* A table: heads, and rows whose first cell names the row. */
const table = (heads, rows, kind = "") => html`<table class="data ${kind}"><thead><tr>${heads.map(h => html`<th scope="col">${h}</th>`)}</tr></thead><tbody>${rows.map(([name, ...cells]) => html`<tr><th scope="row">${name}</th>${cells.map(c => html`<td>${c}</td>`)}</tr>`)}</tbody></table>`;
const scrolling = (label, body) => html`<div class="scroll" tabindex="0" role="region" aria-label="${label}">${body}</div>`;
/* A number with a bar beside it. */
const bar = (value, percent, colour) => html`<span class="bar"><span>${value}</span><i><b style="width:${percent}%;background:${colour}"></b></i></span>`;
const timers = {};
/* Does something later, unless asked again before. */
function delay(what, ms, action) {
	clearTimeout(timers[what]);
	timers[what] = setTimeout(action, ms);
}
function toast(text) {
	write({ toast: text });
	$("#toast").classList.add("on");
	delay("toast", 1800, () => $("#toast").classList.remove("on"));
}
function save(name, content, type) {
	const a = create("a");
	a.download = name;
	a.href = URL.createObjectURL(new Blob([content], { type }));
	a.click();
	setTimeout(() => URL.revokeObjectURL(a.href), 1e4);
}

/* -- numbers */
const TIMES = "\u2009×";
const clamp = (v, low, high) => Math.max(low, Math.min(high, v));
const by = f => (a, b) => f(a) - f(b);
const grouped = n => n.toLocaleString("en");
const sum = list => list.reduce((x, y) => x + y, 0);
const mean = list => Math.exp(sum(list.map(Math.log)) / list.length); // geometric
/* A number with `digits` significant digits, never in scientific notation. */
function num(v, digits = 3) {
	if (v == null || !isFinite(v)) return "–";
	const size = Math.abs(v);
	if (size === 0) return "0";
	if (size >= 1000) return grouped(Math.round(v));
	if (size < .001) return "<\u20090.001";
	return v.toFixed(clamp(digits - 1 - Math.floor(Math.log10(size)), 0, 4));
}
const LEVELS = { sse2: "baseline x86-64", avx512: "AVX-512" };
/* The instructions that drew, as readers know them. */
const levelName = ({ level }) => level === "scalar" ? level : LEVELS[level] ?? level.toUpperCase();
const plural = (n, one) => `${grouped(n)} ${one}${n === 1 ? "" : "s"}`;
const ratioText = q => q ? `${q.tie && q.low !== q.high ? "= " : ""}${q.median.toFixed(2)}${TIMES}` : "–";
const csvCell = c => /[",\r\n]/.test(c ?? "") ? `"${String(c).replace(/"/g, '""')}"` : c ?? "";
/* Comma-separated values: a line an object, the names of its fields on top. */
const csv = list => [Object.keys(list[0]), ...list.map(Object.values)].map(row => row.map(csvCell).join(",") + "\r\n").join("");
const memory = new Map();
/* Keeps what `make` makes, and forgets what was not used for long. */
function memo(key, make) {
	const kept = memory.get(key) ?? make();
	memory.delete(key);
	memory.set(key, kept);
	if (memory.size > 220) memory.delete(memory.keys().next().value);
	return kept;
}

/* -- data */
const D = JSON.parse($("#fastphong-data").textContent), DOCS = [D, ...(D.beside ?? [])];
const BASE = D.baseline ?? "naive-phong", BARY = "barycentric";
/* A row of a comparison: errors in grey levels, times in ms. */
function rowOf(scene, { variant, engine, error, own, speed, within_bound: within, other_polygon: other }) {
	const time = key => speed && speed.timing[key] / 1e6;
	return {
		scene, variant, engine, bary: engine === BARY, within, other, max: error.max * 255, rms: error.rms * 255, p99: error.p99 * 255, own: own.max * 255,
		over1: error.over_one_level, psnr: error.psnr, ssim: error.ssim, worst: error.worst, ms: time("median_ns"), p25: time("p25_ns"), p75: time("p75_ns"),
		rounds: speed?.timing.rounds, ns: speed?.ns_per_covered_pixel, ratio: speed?.ratio_to_naive, barycentric: speed?.ratio_to_barycentric,
	};
}
const S = {};
const SCENES = (D.comparisons ?? []).map((c, number) => {
	const plain = c.name.replace(/[^A-Za-z0-9]+/g, "-").replace(/^-|-$/g, ""), id = plain && !S[plain] ? plain : `scene-${number + 1}`;
	const rows = Object.fromEntries([...c.rows, ...c.barycentric].map(r => [(r.engine === BARY ? "bary:" : "") + r.variant, rowOf(c.name, r)]));
	return S[id] = { ...c, id, number, rows, list: c.rows.map(r => r.variant), title: c.title || c.name, w: c.width, h: c.height, drawn: !!$(`#pictures-${number}`) };
});
const ROWS = SCENES.flatMap(s => Object.values(s.rows));
const METHODS = D.methods ?? [], IDS = METHODS.map(m => m.name), M = Object.fromEntries(METHODS.map(m => [m.name, m]));
const TIMED = ROWS.some(q => q.ratio), MANY = SCENES.length > 1;
const FIGURES = D.figures ?? [], FINDINGS = FIGURES.flatMap(f => f.findings.map(x => ({ ...x, figure: f })));
const STUDY = D.speedups;
const PICTURES = SCENES.some(s => s.drawn);
ROOT.classList.toggle("nopictures", !PICTURES);

/* Each family of methods has a hue and a shape, each member a filling; naive Phong is ink. */
const FAMILIES = [...new Set(METHODS.map(m => m.family))].filter(f => f !== M[BASE]?.family);
const SHAPES = $$("[id^=mark-]:not(#mark-diamond)").map(path => path.id.slice(5));
for (const m of METHODS) {
	const family = FAMILIES.indexOf(m.family), members = METHODS.filter(o => o.family === m.family);
	m.hue = family < 0 ? "var(--base)" : `var(--h${family % 11})`;
	m.shape = family < 0 ? "diamond" : SHAPES[family % SHAPES.length];
	m.filling = members.indexOf(m) % 3;
	m.head = members[0] === m;
	// Over all scenes: the worst error, and the geometric mean of speeds.
	const drawn = SCENES.filter(s => s.rows[m.name]), ratios = drawn.map(s => s.rows[m.name].ratio?.median).filter(Boolean);
	m.scene = [...drawn].sort(by(s => -s.rows[m.name].max))[0];
	m.worst = m.scene?.rows[m.name];
	m.max = m.worst?.max;
	m.speed = ratios.length && ratios.length === drawn.length ? mean(ratios) : null;
}
/* Keys 1 to 9: the first of each family, then the most exact others. */
const order = m => IDS.indexOf(m.name);
[...METHODS].sort(by(m => m.head ? order(m) : 1e6 + (m.max ?? 0))).slice(0, 9).sort(by(order)).forEach((m, i) => { m.key = String(i + 1); });
const nameOf = m => M[m]?.label ?? m, shortName = m => nameOf(m).replace(" Phong", ""), hue = m => M[m]?.hue ?? "var(--ink3)";
const keyOf = m => m === "reference" ? "0" : M[m].key;
const NAMED = $$(".answer .m").map(a => a.dataset.m), BEST = NAMED[0] ?? IDS[IDS.length - 1], MARKED = new Set([BASE, BEST, ...NAMED]);
/* A few methods: those that the answer names, then the fastest. */
const chosen = n => IDS.filter(m => m !== BASE && M[m].speed).sort(by(m => -M[m].speed)).sort(by(m => Math.max(1, M[m].max))).sort(by(m => !MARKED.has(m))).slice(0, n);

/* A method's mark around a point of an SVG. */
function shape(m, x, y, size = 5) {
	const { shape = "circle", filling = 1 } = M[m] ?? {};
	return html`<use href="#mark-${shape}" class="mark fill${filling}" style="color:${hue(m)}" transform="translate(${round(x)} ${round(y)}) scale(${size})"/>`;
}
const mark = m => html`<svg width="13" height="13" viewBox="-7 -7 14 14" aria-hidden="true">${shape(m, 0, 0)}</svg>`;

const named = m => html`${mark(m)}${nameOf(m)}`;

/* -- pictures: planes with the row filters of PNG, deflated; each adds to the one most like it */
/* Predicts a byte from its neighbours (PNG specification 9). */
function predict(filter, left, up, corner) {
	if (filter === 0) return 0;
	if (filter === 1) return left;
	if (filter === 2) return up;
	if (filter === 3) return left + up >> 1;
	const a = Math.abs(up - corner), b = Math.abs(left - corner), c = Math.abs(left + up - 2 * corner);
	return a <= b && a <= c ? left : b <= c ? up : corner;
}
async function unpack(text, { w, h }, count) {
	const packed = Uint8Array.from(atob(text), c => c.charCodeAt(0));
	const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
	const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
	let next = 0;
	return Array.from({ length: count }, () => {
		const plane = new Uint8Array(w * h);
		for (let y = 0, i = 0; y < h; y++) {
			const filter = bytes[next++];
			for (let x = 0; x < w; x++, i++) plane[i] = bytes[next++] + predict(filter, x ? plane[i - 1] : 0, y ? plane[i - w] : 0, x && y ? plane[i - w - 1] : 0);
		}
		return plane;
	});
}
/* Adds the planes of a picture to others, modulo 256. */
function add(more, base) {
	more.forEach((plane, p) => {
		const under = base[p];
		for (let i = 0; i < plane.length; i++) plane[i] += under[i];
	});
	return more;
}
const planes = (s, m) => memo(`planes ${s.id} ${m}`, async () => {
	const data = memo(`json ${s.id}`, () => JSON.parse($(`#pictures-${s.number}`).textContent));
	if (m === "reference") return unpack(data.reference, s, 3);
	const { on = "reference", add: more } = data.rows[m], base = await planes(s, on);
	return more ? add(await unpack(more, s, 3), base) : base;
});
/* A canvas of a scene's size, and its pixels; `word` gives alpha, blue, green, red. */
function canvasOf(s, word) {
	const canvas = create("canvas"), image = new ImageData(s.w, s.h), words = new Uint32Array(image.data.buffer);
	[canvas.width, canvas.height] = [s.w, s.h];
	for (let i = 0; i < words.length; i++) words[i] = word(i);
	canvas.getContext("2d").putImageData(image, 0, 0);
	return { canvas, px: image.data };
}
/* The picture as it is stored: grey levels, linear or sRGB as the scene says. */
const picture = (s, m) => memo(`picture ${s.id} ${m}`, async () => {
	const [green, red, blue] = await planes(s, m);
	return canvasOf(s, i => 255 << 24 | (blue[i] + green[i] & 255) << 16 | green[i] << 8 | red[i] + green[i] & 255);
});
const fromSrgb = c => c <= .04045 ? c / 12.92 : ((c + .055) / 1.055) ** 2.4;
/* Error of each pixel: its channels' largest difference from the reference, in linear grey levels. */
const errors = (s, m) => memo(`errors ${s.id} ${m}`, async () => {
	const [{ px: here }, { px: there }] = await Promise.all([picture(s, m), picture(s, "reference")]);
	const grey = Float32Array.from({ length: 256 }, (_, c) => s.encoding === "srgb" ? 255 * fromSrgb(c / 255) : c), apart = i => Math.abs(grey[here[i]] - grey[there[i]]);
	return new Float32Array(s.w * s.h).map((_, i) => Math.max(apart(4 * i), apart(4 * i + 1), apart(4 * i + 2)));
});
/* Colours of the error map; its scale is logarithmic for `top` 0, else linear up to `top`. */
const STOPS = ["#000004", "#1c1044", "#4f127b", "#812581", "#b5367a", "#e55064", "#fb8761", "#fec287", "#fcfdbf"];
const HEAT = (() => {
	const pen = create("canvas").getContext("2d"), ramp = pen.createLinearGradient(0, 0, 256, 0);
	STOPS.forEach((colour, i) => ramp.addColorStop(i / (STOPS.length - 1), colour));
	pen.fillStyle = ramp;
	pen.fillRect(0, 0, 256, 1);
	return new Uint32Array(pen.getImageData(0, 0, 256, 1).data.buffer);
})();
const heat = (error, top) => top ? Math.min(1, error / top) : Math.log2(1 + error) / 8;
const errorMap = (s, m, top) => memo(`map ${s.id} ${m} ${top}`, async () => {
	const map = await errors(s, m);
	return canvasOf(s, i => HEAT[Math.round(heat(map[i], top) * 255)]);
});
let queue = Promise.resolve();
/* Does something when all else is done. */
const later = what => { queue = queue.then(() => new Promise(done => setTimeout(done, 8))).then(what).catch(() => {}); };
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
const thumbs = root => $$("button", root).forEach(b => {
	const s = S[b.dataset.key];
	if (s.drawn) later(() => drawPart($("canvas", b), s, "reference", [0, 0, s.w, s.h], [112, 112 * s.h / s.w], true));
});
/* Draws a part of a picture around a pixel, its pixels as squares. */
function crop(canvas, s, m, worst, w, h) {
	[w, h] = [Math.min(w, s.w), Math.min(h, s.h)];
	const [cx, cy] = worst ?? [s.w / 2, s.h / 2], x = Math.round(clamp(cx - w / 2, 0, s.w - w)), y = Math.round(clamp(cy - h / 2, 0, s.h - h));
	later(() => drawPart(canvas, s, m, [x, y, w, h], [w * 2, h * 2], false));
}

/* -- the viewer */
const MODES = { s: "slide", f: "flip", d: "side", e: "error" };
const KEYS = {
	" ": v => v.flip(), x: v => v.set({ a: v.b, b: v.a }), "+": v => v.zoom(2), "=": v => v.zoom(2), "-": v => v.zoom(.5), z: v => v.zoom(0), w: v => v.worst(),
	r: v => v.row?.(v), png: v => v.save(), p: v => v.hold(v.pin ? null : v.hover ?? v.rest), arrowleft: (v, e) => v.slide(-1, e), arrowright: (v, e) => v.slide(1, e),
};
for (const key in MODES) KEYS[key] = v => v.set({ mode: MODES[key] });
/* Compares the pictures of methods `a` and `b`. */
class Viewer {
	constructor(root, options) {
		Object.assign(this, { root, mode: "slide", split: .5, z: 1, cx: .5, cy: .5, top: 0, side: "a", turn: 0 }, options);
		root.tabIndex = -1;
		root.append($("#viewer-parts").content.cloneNode(true));
		[this.canvas, this.stage, this.divider] = [".stage canvas", ".stage", ".divider"].map(part => $(part, root));
		this.markMode = segments($(".seg", root), () => this.mode, mode => this.set({ mode }));
		root.onchange = ({ target }) => this.set({ [target.name]: target.value });
		onChoose($(".vfoot", root), (key, e) => KEYS[key] ? KEYS[key](this, e) : this.set({ scene: S[key], pin: null }));
		$(".row", root).hidden = !this.row;
		if (this.choices) {
			$(".choices", root).innerHTML = html`${this.choices.map(s => html`<button data-key="${s.id}" title="${s.title}"><canvas aria-hidden="true"></canvas></button>`)}`;
			setTimeout(() => thumbs($(".choices", root)), 300);
		}
		this.listen();
		new ResizeObserver(() => this.draw()).observe(this.stage);
	}
	/* Changes scene, pictures or mode. */
	async set(change) {
		Object.assign(this, change);
		const { root, scene: s } = this, error = this.mode === "error", known = (m, otherwise) => m === "reference" || s.list.includes(m) ? m : otherwise;
		this.top = Number(this.top);
		this.a = known(this.a, s.list[0]);
		this.b = known(this.b, "reference");
		for (const name of ["a", "b"]) {
			const select = $(`[name=${name}]`, root);
			select.innerHTML = html`${["reference", ...s.list].map(i => html`<option value="${i}">${nameOf(i)}</option>`)}`;
			select.value = this[name];
			select.previousElementSibling.innerHTML = mark(this[name]);
		}
		this.markMode();
		$$(".choices button", root).forEach(b => { b.ariaPressed = b.dataset.key === s.id; });
		this.stage.style.aspectRatio = `${s.w}/${s.h}`;
		root.dataset.mode = this.mode;
		if (error) this.drawScale();
		if (!("side" in change) && ("mode" in change || "a" in change)) this.side = "a";
		this.change?.(this, change);
		this.A = this.B = null;
		if (!s.drawn) return;
		const turn = ++this.turn, image = m => error ? errorMap(s, m, this.top) : picture(s, m);
		try {
			const [A, B] = await Promise.all([image(this.a), image(error && this.b === "reference" ? this.a : this.b)]);
			if (turn !== this.turn) return;
			[this.A, this.B] = [A.canvas, B.canvas];
			this.draw();
			root.dataset.shown = [s.id, this.a, this.b, this.mode].join("|");
		} catch {
			$(".missing", root).hidden = false;
		}
	}
	get single() { return this.mode === "flip" || this.mode === "error" && this.b === "reference"; }
	get slides() { return !this.single && this.mode !== "side"; }
	/* The part of the picture that a pane shows: scale, corner, size. */
	view() {
		const w = this.stage.clientWidth / (this.mode === "side" ? 2 : 1), h = this.stage.clientHeight, { w: iw, h: ih } = this.scene;
		const k = Math.min(w / iw, h / ih) * this.z, corner = (centre, size, seen) => seen >= size ? (size - seen) / 2 : clamp(centre * size - seen / 2, 0, size - seen);
		return { k, x: corner(this.cx, iw, w / k), y: corner(this.cy, ih, h / k), w, h, iw, ih };
	}
	draw() {
		this.stage.style.maxHeight = `max(300px,100vh - ${scrollY + this.stage.getBoundingClientRect().top + $(".vfoot", this.root).offsetHeight + 9}px)`;
		const view = this.view(), { k, w, h } = view;
		if (!this.A || !w) return;
		const ratio = devicePixelRatio || 1, canvas = this.canvas, pen = canvas.getContext("2d"), side = this.mode === "side", error = this.mode === "error", panes = side ? 2 : 1;
		[canvas.width, canvas.height] = [w * ratio * panes, h * ratio];
		pen.scale(ratio, ratio);
		pen.imageSmoothingEnabled = k * ratio < 2.01 && this.z === 1;
		pen.imageSmoothingQuality = "high";
		const pane = (image, from, to, left = 0) => pen.drawImage(image, view.x + (from - left) / k, view.y, (to - from) / k, h / k, from, 0, to - from, h);
		const second = this.side === "b" && !error, from = side ? w + 1 : this.split * w;
		pane(this.single && second ? this.B : this.A, 0, this.single ? w : side ? w - 1 : from);
		if (!this.single) pane(this.B, from, w * panes, side ? w : 0);
		const pixel = this.hover ?? this.pin ?? this.rest;
		for (let n = 0; pixel && n < panes; n++) {
			const size = Math.max(k, 9), [x, y] = [(pixel[0] - view.x) * k + n * w, (pixel[1] - view.y) * k].map(v => v - (size - k) / 2);
			for (const [width, colour] of [[3, "#000a"], [1.4, "#fff"]]) {
				[pen.lineWidth, pen.strokeStyle] = [width, colour];
				pen.strokeRect(x, y, size, size);
			}
		}
		if (this.line != null) {
			pen.fillStyle = "#fff8";
			pen.fillRect(0, (this.line + .5 - view.y) * k - .5, w * panes, 1);
		}
		this.divider.hidden = !this.slides;
		this.divider.style.left = this.split * 100 + "%";
		this.divider.ariaValueNow = Math.round(this.split * 100);
		this.stage.classList.toggle("slides", this.slides);
		this.stage.classList.toggle("zoomed", this.z > 1);
		const label = (part, m, shown) => {
			const el = $(part, this.root), q = this.scene.rows[m];
			el.innerHTML = html`<b>${nameOf(m)}${error && " · error"}</b>${q ? `max ${num(q.max)} levels${q.ms ? ` · ${num(q.ms)} ms` : ""}` : "f64, closed form"}`;
			el.classList.toggle("faint", !shown);
		};
		label(".tag.a", this.single && second ? this.b : this.a, !this.slides || this.split > .16);
		label(".tag.b", this.b, side || this.slides && this.split < .84);
		canvas.ariaLabel = `${this.scene.title}: ${nameOf(this.a)}${this.single ? "" : ` left, ${nameOf(this.b)} right`}${error ? ", error map" : ""}`;
	}
	drawScale() {
		const bar = $(".heat", this.root), ticks = this.top ? [0, this.top / 2, this.top] : [0, 1, 3, 10, 30, 100, 255];
		bar.style.background = `linear-gradient(90deg, ${STOPS})`;
		bar.innerHTML = html`${ticks.map(t => html`<span style="left:${heat(t, this.top) * 100}%">${t}</span>`)}`;
	}
	/* Zooms by a factor, 0 for the whole picture, around a point of the stage. */
	zoom(factor, x, y) {
		const view = this.view(), z = clamp(this.z * factor, 1, 32), k = view.k / this.z * z;
		if (x == null) [x, y] = this.pin ? [(this.pin[0] + .5 - view.x) * view.k, (this.pin[1] + .5 - view.y) * view.k] : [view.w / 2, view.h / 2];
		this.cx = factor ? (view.x + x / view.k + (view.w / 2 - x) / k) / view.iw : .5;
		this.cy = factor ? (view.y + y / view.k + (view.h / 2 - y) / k) / view.ih : .5;
		this.z = z;
		this.moved();
	}
	moved() {
		this.draw();
		this.change?.(this, { view: true });
	}
	move(split) {
		this.split = clamp(split, 0, 1);
		this.draw();
	}
	slide(sign, { shiftKey }) { return this.slides && this.move(this.split + sign * (shiftKey ? .1 : .02)); }
	/* A point of the window on the stage: in its pane, and as a part of its width. */
	local({ clientX, clientY }) {
		const box = this.stage.getBoundingClientRect(), view = this.view(), x = clientX - box.left;
		return { x: this.mode === "side" ? x % view.w : x, y: clientY - box.top, part: x / box.width, view };
	}
	pixelAt(e) {
		const { x, y, view } = this.local(e), pixel = [Math.floor(view.x + x / view.k), Math.floor(view.y + y / view.k)];
		return pixel.every((v, i) => v >= 0 && v < [view.iw, view.ih][i]) ? pixel : null;
	}
	look(pixel) {
		this.hover = pixel;
		this.probe(this);
		this.draw();
	}
	hold(pixel) {
		this.pin = pixel;
		this.probe?.(this);
		this.draw();
		this.change?.(this, { pin: true });
	}
	/* One finger or the mouse moves the divider, or a zoomed picture; two fingers zoom. */
	listen() {
		const stage = this.stage, fingers = new Map();
		const pair = () => {
			const [p, q] = [...fingers.values()];
			return { apart: Math.hypot(p.clientX - q.clientX, p.clientY - q.clientY), clientX: (p.clientX + q.clientX) / 2, clientY: (p.clientY + q.clientY) / 2 };
		};
		let gesture = null;
		stage.onpointerdown = e => {
			if (e.button) return;
			fingers.set(e.pointerId, e);
			stage.setPointerCapture(e.pointerId);
			const { part } = this.local(e), near = Math.abs(part - this.split) * stage.clientWidth < 24;
			gesture = { kind: this.slides && (near || this.z === 1) ? "split" : "pan", from: e, cx: this.cx, cy: this.cy, far: 0 };
			if (fingers.size === 2) gesture = { kind: "pinch", apart: pair().apart, z: this.z, far: 99 };
		};
		stage.onpointermove = e => {
			if (fingers.has(e.pointerId)) fingers.set(e.pointerId, e);
			const { part, view } = this.local(e), kind = gesture?.kind;
			if (kind === "pinch") {
				if (fingers.size < 2) return;
				const { apart, ...middle } = pair(), { x, y } = this.local(middle);
				return this.zoom(gesture.z * apart / gesture.apart / this.z, x, y);
			}
			if (gesture) {
				const [dx, dy] = [e.clientX - gesture.from.clientX, e.clientY - gesture.from.clientY];
				gesture.far = Math.max(gesture.far, Math.hypot(dx, dy));
				if (kind === "split" && gesture.far > 2) this.move(part);
				if (kind === "pan" && this.z > 1) {
					[this.cx, this.cy] = [gesture.cx - dx / view.k / view.iw, gesture.cy - dy / view.k / view.ih];
					this.draw();
				}
			}
			if (this.probe && (kind !== "split" || gesture.far < 3)) this.look(this.pixelAt(e));
		};
		stage.onpointerup = e => {
			fingers.delete(e.pointerId);
			if (gesture?.far < 4) this.tap(e);
			else if (gesture && gesture.kind !== "split") this.moved();
			gesture = null;
		};
		stage.onpointercancel = e => {
			fingers.delete(e.pointerId);
			gesture = null;
		};
		stage.onpointerleave = () => { if (!gesture && this.probe) this.look(null); };
		stage.addEventListener("wheel", e => {
			if (!e.ctrlKey && !e.metaKey) return;
			e.preventDefault();
			const { x, y } = this.local(e);
			this.zoom(2 ** (-e.deltaY / 120), x, y);
		}, { passive: false });
		stage.ondblclick = e => {
			const { x, y } = this.local(e);
			if (!e.target.closest(".divider")) this.zoom(e.shiftKey ? .25 : 4, x, y);
		};
	}
	/* Holds the pixel, or lets it go; without a probe, flips or moves the divider. */
	tap(e) {
		if (this.probe) {
			const pixel = this.pixelAt(e), again = this.pin && pixel && Math.hypot(pixel[0] - this.pin[0], pixel[1] - this.pin[1]) < 4;
			this.hold(again ? null : pixel);
		} else if (this.mode === "flip") this.flip();
		else if (this.slides) this.move(this.local(e).part);
	}
	flip() {
		if (this.mode !== "flip") return this.set({ mode: "flip", side: "b" });
		this.side = this.side === "a" ? "b" : "a";
		this.draw();
	}
	/* Shows a method on the left or the right. */
	show(m, right) {
		if (!this.scene.list.includes(m) && m !== "reference") return;
		this.set(right ? { b: m } : this.mode === "flip" && m === this.b ? { side: "b" } : { a: m });
	}
	worst() {
		const m = this.a === "reference" ? this.b : this.a, q = this.scene.rows[m], { w, h } = this.scene;
		if (!q?.worst) return toast("No pixel differs");
		Object.assign(this, { z: 12, cx: (q.worst[0] + .5) / w, cy: (q.worst[1] + .5) / h, hover: null });
		this.hold([...q.worst]);
		toast(`${nameOf(m)}: worst pixel ${q.worst.join(", ")}, ${num(q.max)} levels`);
	}
	save() { this.canvas.toBlob(png => save(`${this.scene.id}-${this.a}-${this.b}-${this.mode}.png`.replace(/[^\w.-]/g, "_"), png, "image/png")); }
	/* True if the key was one of the viewer's. */
	key(e) {
		const digit = /^Digit(\d)$/.exec(e.code)?.[1], action = KEYS[e.key.toLowerCase()];
		if (!digit) return !!action && action(this, e) !== false;
		const m = ["reference", ...IDS].find(i => keyOf(i) === digit);
		if (m) this.show(m, e.shiftKey);
		return true;
	}
}

/* -- charts */
const round = v => Math.round(v * 10) / 10;
/* The size of type; charts are drawn smaller by it, and scaled. */
const zoomOf = () => parseFloat(getComputedStyle(ROOT).fontSize) / 16;
const widthOf = el => Math.round(el.clientWidth / zoomOf());
/* A picture of charts: a group of controls if its marks can be chosen, else an image. */
const svg = (w, h, label, body, controls) => html`<svg viewBox="0 0 ${w} ${h}" role="${controls ? "group" : "img"}" aria-label="${label}">${body}</svg>`;
const text = (x, y, t, kind = "") => html`<text x="${round(x)}" y="${round(y)}" class="${kind}">${t}</text>`;
const line = (x1, y1, x2, y2, kind = "grid") => html`<line x1="${round(x1)}" y1="${round(y1)}" x2="${round(x2)}" y2="${round(y2)}" class="${kind}"/>`;
const curve = (points, kind = "") => html`<path class="curve ${kind}" d="M${points.map(p => p.map(round).join(" ")).join("L")}"/>`;
/* The width of a text in a chart. */
const textWidth = (() => {
	const pen = create("canvas").getContext("2d");
	return (t, bold) => {
		pen.font = `${bold ? 650 : 400} 12.5px ${textWidth.family ??= getComputedStyle(document.body).fontFamily}`;
		return pen.measureText(t).width;
	};
})();
/* The scale of an axis: from values `low` to `high` to pixels `from` to `to`. */
function scale(log, low, high, from, to) {
	const f = log ? Math.log : v => v, k = (to - from) / (f(high) - f(low) || 1), at = v => from + (f(v) - f(low)) * k;
	return Object.assign(at, { low, high, from, to, ticks: gap => (log ? logTicks : linearTicks)(at, gap) });
}
/* A logarithmic scale of some values, with a margin. */
const logScale = (values, margin, from, to) => scale(true, Math.min(...values) / margin, Math.max(...values) * margin, from, to);
/* Round numbers on a scale, at least `gap` pixels apart. */
function linearTicks({ low, high, from, to }, gap) {
	const rough = (high - low) / Math.abs(to - from) * gap, power = 10 ** Math.floor(Math.log10(rough)), step = [1, 2, 5, 10].map(s => s * power).find(s => s >= rough), first = Math.ceil(low / step);
	return Array.from({ length: Math.floor(high / step + 1e-6) - first + 1 }, (_, i) => +((first + i) * step).toPrecision(6));
}
function logTicks(at, gap) {
	const first = Math.floor(Math.log10(at.low)), powers = Array.from({ length: Math.ceil(Math.log10(at.high)) - first + 1 }, (_, i) => first + i);
	const round = [1, 3, 2, 5, 1.5, 7].flatMap(digit => powers.map(e => +(digit * 10 ** e).toPrecision(3))).filter(t => t >= at.low * .999 && t <= at.high * 1.001);
	return round.reduce((kept, t) => kept.every(k => Math.abs(at(k) - at(t)) >= gap) ? [...kept, t] : kept, []);
}
function tickText(v) {
	const size = Math.abs(v);
	if (size && size < 1e-3) return html`10<tspan dy="-4" font-size="9">${Math.round(Math.log10(size))}</tspan>`;
	return size >= 1e6 ? +(v / 1e6).toPrecision(2) + " M" : size >= 1e4 ? +(v / 1e3).toPrecision(3) + " k" : String(+v.toPrecision(3));
}
/* Numbers of the axis on the left, with lines, and of the one below. */
const axisY = (y, left, right, ticks, unit = "") => ticks.map(t => [line(left, y(t), right, y(t)), text(left - 6, y(t) + 4, [tickText(t), unit], "tick end")]);
const axisX = (x, bottom, ticks) => ticks.map(t => text(x(t), bottom + 17, tickText(t), "tick mid"));
/* Positions near those wished for, at least `gap` apart if there is room. */
function spread(wished, gap, low, high) {
	const list = wished.map((y, i) => ({ y, i })).sort(by(p => p.y)), room = (high - low) / Math.max(1, list.length - 1);
	gap = Math.min(gap, room);
	list.reduce((least, p) => (p.y = Math.max(p.y, least)) + gap, low);
	list.reduceRight((most, p) => (p.y = Math.min(p.y, most)) - gap, high);
	return list.sort(by(p => p.i)).map(p => p.y);
}
/* Curves with marks and whiskers at their points and names at their ends.
   A series has points [x, y, low, high], a method or colour, a name, and may have a value, a link and a tip. */
function curves(x, y, series, { gap = 16, out = 9 } = {}) {
	const end = s => s.points[s.points.length - 1], labels = spread(series.map(s => y(end(s)[1])), gap, y.to, y.from);
	return series.map((s, n) => {
		const [ex, ey] = end(s), at = x(ex) + out, far = Math.abs(labels[n] - y(ey)) > 3 && out > 12;
		const body = html`<title>${s.tip}</title>${curve(s.points.map(p => [x(p[0]), y(p[1])]), s.kind)}
${s.points.map(([px, py, low, high]) => [low && line(x(px), y(low), x(px), y(high), "whisker"), s.method && shape(s.method, x(px), y(py), 4.8)])}
${far && line(x(ex) + 7, y(ey), at - 3, labels[n], "leader")}${text(at, labels[n] + 4, [s.name, s.value && html`<tspan dx="5" class="value">${s.value}</tspan>`], `label halo ${s.bold ? "bold" : ""}`)}`;
		const colour = `color:${s.colour ?? hue(s.method)}`;
		return s.href ? html`<a class="hit" href="${s.href}" style="${colour}">${body}</a>` : html`<g style="${colour}">${body}</g>`;
	});
}
/* Places labels of points side by side, with a leader if far away; one without room is left out. */
function place(points, box, bars) {
	const done = [], squares = points.map(o => [o.x - 9, o.y - 9, o.x + 9, o.y + 9]), overlap = (a, b) => Math.max(0, Math.min(a[2], b[2]) - Math.max(a[0], b[0])) * Math.max(0, Math.min(a[3], b[3]) - Math.max(a[1], b[1]));
	const hits = (d, list) => list.filter(([x, y]) => x > d[0] && x < d[2] && y > d[1] && y < d[3]).length;
	for (const p of [...points].sort((a, b) => b.priority - a.priority || a.y - b.y)) {
		let best = null;
		for (let ring = 0; ring < 9; ring++) for (let turn = 0; turn < 16; turn += ring ? 1 : 4) {
			const angle = turn * Math.PI / 8, r = 13 + ring * 11, cos = Math.cos(angle);
			const cx = p.x + cos * (r + (Math.abs(cos) > .3 ? p.w / 2 : 0)), cy = p.y + Math.sin(angle) * (r + 7), q = [cx - p.w / 2, cy - 8, cx + p.w / 2, cy + 8];
			if (q[0] < box[0] || q[1] < box[1] || q[2] > box[2] || q[3] > box[3] || done.some(d => overlap(q, d) > 0)) continue;
			const ex = clamp(p.x, q[0], q[2]), ey = clamp(p.y, q[1] + 3, q[3] - 3), apart = o => Math.hypot(o.x - clamp(o.x, q[0], q[2]), o.y - clamp(o.y, q[1], q[3])), tied = ring || points.some(o => apart(o) < apart(p) + 8), leader = tied ? [.2, .4, .6, .8].map(t => [p.x + t * (ex - p.x), p.y + t * (ey - p.y)]) : [];
			const crossed = sum(squares.map((d, i) => points[i] === p ? 0 : 5 * overlap(q, d) + 30 * hits(d, leader))) + sum(bars.map(d => 1.6 * overlap(q, d))) + sum(done.map(d => 40 * hits(d, leader)));
			const cost = ring * 22 + (turn === 0 ? 0 : turn === 8 && !ring ? 3 : 5) + crossed;
			if (!best || cost < best.cost) best = { cost, x: q[0], y: cy, q, end: tied && [ex, ey], leader };
		}
		p.label = best && (best.cost < 420 || p.priority) ? best : null;
		if (p.label) done.push(best.q, ...best.leader.map(([x, y]) => [x - 2, y - 2, x + 2, y + 2]));
	}
}

/* -- overview */
let basis = MANY ? "all" : "scene";
/* Error against time of every method, and the line of those that nothing beats. */
function pareto(v) {
	const el = $("#pareto"), s = v.scene, all = basis === "all";
	write({ "pareto-sub": all ? `Worst error in ${SCENES.length} scenes, mean time.` : `${s.title}, ${s.w} × ${s.h}.` });
	const W = widthOf(el), H = Math.max(340, el.clientHeight / zoomOf()), l = 46, r = W - 14, t = 24, b = H - 48;
	if (!W) return;
	const points = IDS.filter(m => all ? M[m].max != null : s.rows[m]).map(m => {
		const { max, speed } = M[m], q = s.rows[m];
		return all ? { m, error: max, time: speed && 1 / speed, ratio: speed } : { m, error: q.max, time: q.ms, ratio: q.ratio?.median, low: q.p25, high: q.p75 };
	});
	const timed = points.every(p => p.time);
	if (!timed) points.forEach((p, i) => { p.time = i + 1; });
	const x = logScale(points.flatMap(p => [p.time, p.low, p.high]).filter(Boolean), 1.2, l, r);
	const y = scale(true, clamp(Math.min(...points.map(p => p.error / 2.2)), .0005, .3), Math.max(2, ...points.map(p => p.error * 4)), b, t);
	for (const p of points) [p.x, p.y] = [x(p.time), y(Math.max(p.error, y.low * 1.1))];
	const one = clamp(y(1), t, b), base = points.find(p => p.m === BASE), shown = [];
	shown.push(html`<rect x="${l}" y="${one}" width="${r - l}" height="${b - one}" class="same"/>`, axisY(y, l, r, y.ticks(60).filter(e => Math.log10(e) % 1 === 0)), timed && axisX(x, b, x.ticks(40)));
	shown.push(text((l + r) / 2, H - 8, timed ? `← faster   ·   ${all ? "time as a multiple of naive Phong’s" : "ms a frame"}` : "no times were taken", "axis mid"), text(l - 38, t - 9, `${all ? "worst error in any scene" : "max error"}, grey levels`, "axis"));
	if (base && timed) shown.push(line(base.x, t, base.x, b, "dots"));
	// The line goes down at each method that is more exact than all faster ones.
	const steps = [];
	if (timed) for (const p of [...points].sort((p, q) => p.time - q.time || p.error - q.error)) {
		const last = steps[steps.length - 1];
		if (last && p.y <= last[1]) continue;
		steps.push([p.x, last?.[1] ?? t], [p.x, p.y]);
		p.front = true;
	}
	if (timed) {
		steps.push([r, steps[steps.length - 1][1]]);
		shown.push(curve(steps, "front"));
	}
	const same = "below one grey level: the same picture", taken = [l, one + 3, l + textWidth(same), one + 20];
	if (b - one > 24) shown.push(text(l + 8, one + 16, same, "tick halo washed"));
	for (const p of points) {
		[p.left, p.right] = [p.m === v.a, p.m === v.b];
		p.value = p.ratio && (p.left || p.right || p.front) ? p.ratio.toFixed(2) + TIMES : "";
		p.priority = 3 * p.left + 2 * p.right + !!p.front + MARKED.has(p.m);
		p.w = textWidth(`${nameOf(p.m)}  ${p.value}`, p.left) + 6;
	}
	place(points, [l + 2, t, r, b - 1], [taken, ...steps.slice(1).map(([px, py], i) => [steps[i][0] - 2, steps[i][1] - 2, px + 2, py + 2])]);
	for (const p of points) {
		const tip = `${nameOf(p.m)}: error ${num(p.error)} levels${timed ? `, ${num(p.time)} ${all ? "of naive Phong’s time" : "ms"}` : ""}`;
		shown.push(html`<g class="hit" tabindex="0" role="button" data-key="${p.m}" aria-pressed="${p.left}" style="color:${hue(p.m)}"><title>${tip}</title>
${p.label?.end && line(p.x, p.y, ...p.label.end, "leader")}${p.low && line(x(p.low), p.y, x(p.high), p.y, "whisker")}<circle class="ring ${p.left || p.right ? "on" : ""}" cx="${p.x}" cy="${p.y}" r="10.5"/>${shape(p.m, p.x, p.y, 5.8)}
${p.label && text(p.label.x + 2, p.label.y + 4.3, [nameOf(p.m), html`<tspan dx="4" class="value">${p.value}</tspan>`], `label halo ${p.left ? "bold" : ""}`)}</g>`);
	}
	fill(el, svg(W, H, "Error against time of every method", shown, true));
}
/* Speeds of a few methods in each scene, as a strip of marks. */
function strip() {
	const el = $("#strip"), W = widthOf(el), few = chosen(4), value = (s, m) => s.rows[m]?.ratio?.median;
	if (!W || !few.length) return;
	const timed = SCENES.filter(s => few.some(m => value(s, m))).sort(by(s => -(value(s, few[0]) ?? 0))), [rows, more] = folded(timed, 24, "scenes");
	const [most, l] = W < 520 ? [19, 132] : [34, 208], t = 8, high = 20.5, H = t + rows.length * high + 26, values = rows.flatMap(s => few.map(m => value(s, m)).filter(Boolean)).concat(1);
	const x = logScale(values, 1.06, l, W - 14), shown = [];
	for (const g of x.ticks(30)) shown.push(line(x(g), t - 6, x(g), H - 22, g === 1 ? "one" : "grid"), text(x(g), H - 7, g + (g === 1 ? TIMES : ""), "tick mid"));
	rows.forEach((s, i) => {
		const y = t + (i + .5) * high, here = few.filter(m => value(s, m)), at = here.map(m => x(value(s, m))), tip = `${s.title}: ${here.map(m => `${nameOf(m)} ${value(s, m).toFixed(2)} ×`).join(", ")}`;
		shown.push(html`<a class="hit" href="#scenes/${s.id}"><title>${tip}</title><rect x="0" y="${y - high / 2}" width="${W}" height="${high}" fill="transparent"/>
${text(l - 14, y + 4, s.title.length > most ? s.title.slice(0, most - 1) + "…" : s.title, "end")}${line(Math.min(...at), y, Math.max(...at), y, "range")}${here.map((m, n) => shape(m, at[n], y, s.rows[m].max > 1 ? 2.8 : 4.6))}</a>`);
	});
	el.innerHTML = html`<div class="legend">${few.map(m => html`<span>${named(m)}</span>`)}</div>${svg(W, H, `Speed of ${few.length} methods in ${rows.length} scenes`, shown, true)}${more}`;
}
const VERDICTS = { confirms: "✓", adds: "+", contradicts: "✗" };
const counts = list => Object.keys(VERDICTS).map(k => [k, list.filter(x => x.agreement === k).length]).filter(([, n]) => n);
const chip = (verdict, label) => html`<span class="chip ${verdict}">${VERDICTS[verdict]} ${label}</span>`;
function waffle() {
	write({ "waffle-sub": `${FINDINGS.length} statements, ${plural(FIGURES.length, "figure")}.`, ...Object.fromEntries(counts(FINDINGS)) });
}
/* Shows where the lecture's fast method is worst. */
function breakPair() {
	const m = "fast-phong", { scene: s, worst } = M[m] ?? {};
	$("#take-break").hidden = !worst || worst.max < 1 || !s.drawn;
	if ($("#take-break").hidden) return;
	write({ "break-title": `Where ${nameOf(m)} breaks`, "break-sub": `${s.title}: off by ${num(worst.max)} grey levels.`, "break-a": "reference", "break-b": nameOf(m) });
	$("#break-link").href = `#scenes/${s.id}?left=${m}&right=reference&mode=side`;
	$$("#break canvas").forEach((c, i) => crop(c, s, ["reference", m][i], worst.worst, s.w * .6, s.h * .6));
}
let v1, v2;
function startOverview() {
	const change = (v, changed) => {
		if (!changed.view) pareto(v);
		remember(v);
	};
	v1 = new Viewer($("#v1"), { scene: SCENES[0], a: "gouraud", b: BEST, choices: MANY && SCENES.filter(s => s.drawn).slice(0, 8), change });
	segments($("#pareto-basis"), () => basis, key => {
		basis = key;
		pareto(v1);
	});
	// Hovering shows a mark; choosing keeps it.
	const el = $("#pareto");
	onChoose(el, (m, e) => {
		if (!e.shiftKey) v1.kept = m;
		v1.show(m, e.shiftKey);
	});
	el.onpointerover = e => {
		const m = e.target.closest(".hit")?.dataset.key;
		if (!m || e.pointerType !== "mouse" || m === v1.a || m === v1.b) return;
		delay("hover", 140, () => {
			v1.kept ??= v1.a;
			v1.set({ a: m });
		});
	};
	el.onpointerleave = () => {
		clearTimeout(timers.hover);
		if (v1.kept && v1.kept !== v1.a) v1.set({ a: v1.kept });
		v1.kept = null;
	};
	setTimeout(breakPair, 350);
}
function overview(_, query) {
	if (FINDINGS.length) waffle();
	if (!SCENES.length) return;
	if (!v1) startOverview();
	v1.set(fromRoute(query, v1));
	strip();
}

/* -- scenes */
let sort = { key: TIMED ? "ratio" : "max", up: !TIMED }, options = { cols: false, bary: false };
const openScene = s => go(`scenes/${s.id}?left=${v2.a}&right=${v2.b}${v2.mode === "slide" ? "" : `&mode=${v2.mode}`}`);
const stepScene = d => openScene(SCENES[(v2.scene.number + d + SCENES.length) % SCENES.length]);
function startScenes(s) {
	const rail = $("#rail");
	rail.innerHTML = html`${SCENES.map(s => html`<button role="option" data-key="${s.id}"><canvas aria-hidden="true"></canvas><span>${s.title}</span></button>`)}`;
	thumbs(rail);
	onChoose(rail, id => openScene(S[id]));
	const change = (v, changed) => {
		if (!changed.view) {
			probe(v);
			sceneTable();
			if (!("pin" in changed)) rowPlot(v);
		}
		remember(v);
	};
	v2 = new Viewer($("#v2"), { scene: s, a: "gouraud", b: "reference", probe, row: toggleRow, change });
	for (const id in options) $("#" + id).onclick = e => {
		e.target.ariaPressed = options[id] = !options[id];
		sceneTable();
	};
	$("#copy").onclick = copyMarkdown;
	$("#rowplot-close").onclick = () => toggleRow(v2);
	onChoose($("#probe"), (m, e) => v2.show(m, e.shiftKey));
	onChoose($("#rowplot-chart"), (m, e) => v2.show(m, e.shiftKey));
	onChoose($("#table"), chooseInTable);
}
function scenes([id], query) {
	const s = S[id] ?? v2?.scene ?? SCENES[0], rail = $("#rail");
	if (!v2) startScenes(s);
	if (v2.scene !== s) Object.assign(v2, { pin: null, hover: null, z: 1, cx: .5, cy: .5 });
	write({ "t-scenes": s.title, "scene-about": (s.description || "").replace(/\s+/g, " "), "scene-facts": sceneFacts(s).filter(Boolean).join(" · ") });
	const held = rail.contains(document.activeElement);
	for (const b of $$("button", rail)) {
		const on = b.dataset.key === s.id;
		b.ariaSelected = on;
		b.tabIndex = on ? 0 : -1;
		if (!on) continue;
		if (held) b.focus({ preventScroll: true });
		reveal(b);
	}
	const asked = { ...fromRoute(query, v2), scene: s };
	v2.set(asked);
	if (asked.line != null) showRow(v2, asked.line);
	else if (v2.line != null && query.has("left")) showRow(v2, null);
}
function sceneFacts(s) {
	const cut = s.triangulation, reasons = { culled: "facing away", outside: "outside the view", zero_area: "without area", no_area: "without area", cancelling: "whose lobes cancel", edge_on: "edge-on", unprojected: "at the plane of the eye" };
	const left = Object.keys(reasons).filter(k => s.stats[k]).map(k => `${grouped(s.stats[k])} ${reasons[k]}`);
	return [
		`${plural(s.polygons, "polygon")} in view`, plural(s.lights, "light"), `${(s.covered_pixels / s.w / s.h * 100).toFixed(0)} % covered`, `${s.w} × ${s.h}`,
		s.interpolation === "screen" ? "linear on the screen" : "perspective-correct", `${levelName(s.renderer)} code, ${plural(s.renderer.threads, "thread")}`,
		left.length && `left out: ${left.join(", ")}`, cut && `split into triangles, the reference changes by up to ${num(cut.difference.max * 255)} levels`,
		s.not_simple && `${plural(s.not_simple, "polygon")} crossing themselves: not drawn by barycentric`,
	];
}
let probing = 0;
/* Shows every method at the pixel pointed at, held, or worst. */
async function probe(v) {
	const s = v.scene, turn = ++probing, of = v.a === "reference" ? v.b : v.a, rest = v.rest = !v.hover && !v.pin && s.rows[of]?.worst || null, pixel = v.hover ?? v.pin ?? rest;
	if (!s.drawn) return;
	const list = ["reference", ...s.list], at = pixel && pixel[1] * s.w + pixel[0], found = pixel && await Promise.all(list.map(async m => {
		const [{ px }, map] = await Promise.all([picture(s, m), errors(s, m)]);
		return [m, { colour: px.slice(4 * at, 4 * at + 3), error: map[at] }];
	}));
	if (turn !== probing) return;
	const here = Object.fromEntries(found ?? []), shown = list.filter(m => list.length < 17 || unfolded.has("methods") || m === v.a || m === v.b || keyOf(m) || MARKED.has(m));
	const value = m => {
		const { colour, error } = here[m] ?? {};
		if (!pixel || m === "reference") return pixel && [...colour].join(" ");
		return error ? error.toFixed(error % 1 ? 1 : 0) : "·";
	};
	write({ "probe-where": pixel ? `${pixel.join(", ")}${rest ? ` · worst of ${nameOf(of)}` : v.pin && !v.hover ? " · held" : ""}` : "point at the picture" });
	fill($("#probe-list"), html`${shown.map(m => html`<li><button data-key="${m}" class="${m === v.a ? "a" : m === v.b ? "b" : ""}"><kbd>${keyOf(m) ?? "·"}</kbd>${mark(m)}<span class="name">${nameOf(m)}</span><i style="background:rgb(${here[m]?.colour ?? ""})"></i><span class="value ${here[m]?.error > 1 ? "bad" : ""}">${value(m)}</span></button></li>`)}${shown.length < list.length && html`<li><button data-fold="methods">All ${list.length - 1} methods</button></li>`}`);
	if (!pixel) return;
	const pen = $("#probe canvas").getContext("2d"), images = await Promise.all([picture(s, v.a), picture(s, v.b)]);
	pen.imageSmoothingEnabled = false;
	pen.strokeStyle = "#fff";
	images.forEach(({ canvas }, n) => {
		pen.drawImage(canvas, pixel[0] - 3, pixel[1] - 3, 7, 7, 72 * n, 0, 70, 70);
		pen.strokeRect(72 * n + 30.5, 30.5, 9, 9);
	});
}
/* Opens or closes the plot of a row. */
function toggleRow(v) { showRow(v, v.line == null ? (v.pin ?? v.rest ?? [0, v.scene.h >> 1])[1] : null); }
function showRow(v, y) {
	v.line = y;
	$("#rowplot").hidden = y == null;
	$(".row", v.root).ariaPressed = y != null;
	v.draw();
	rowPlot(v);
	remember(v);
}
/* Intensity of a row by each method, and its slope below. */
async function rowPlot(v) {
	const el = $("#rowplot-chart"), s = v.scene;
	if (v.line == null || !s.drawn) return;
	const row = v.line = clamp(v.pin ? v.pin[1] : v.line, 0, s.h - 1), list = ["reference", ...s.list], pixels = await Promise.all(list.map(m => picture(s, m)));
	const greys = pixels.map(({ px }) => Array.from({ length: s.w }, (_, x) => [.2126, .7152, .0722].reduce((grey, k, c) => grey + k * px[4 * (row * s.w + x) + c], 0)));
	const slopes = greys.map(g => g.map((_, x) => (g[Math.min(s.w - 1, x + 2)] - g[Math.max(0, x - 2)]) / 4));
	const bold = m => m === v.a || m === v.b, drawn = [...list].sort(by(bold));
	const chart = (values, label, H) => plot({
		title: `Row ${row}`, x: ["pixel of the row"], y: [label], marks: v.pin ? [v.pin[0] + .5] : [],
		series: drawn.map(m => ({ label: nameOf(m), colour: hue(m), kind: `${bold(m) ? "" : "thin"} ${m === "reference" ? "dash1" : ""}`, points: values[list.indexOf(m)].map((g, x) => [x + .5, g]) })),
	}, widthOf(el) || 700, H);
	write({ "rowplot-title": `Row ${row} of ${s.title}` });
	fill(el, html`${chart(greys, "grey level", 230)}${chart(slopes, "slope, levels per pixel", 170)}<div class="legend">${list.map(m => html`<button data-key="${m}" aria-pressed="${bold(m)}">${named(m)}</button>`)}</div>`);
	v.draw();
}
/* Columns of the table: key, head, a mark for those that are always shown. */
const COLUMNS = [
	["max", "max error", 1], ["rms", "RMS", 1], ["p99", "99 %"], ["own", "own max"], ["over1", "pixels > 1 level", 1], ["other", "other polygon"], ["psnr", "PSNR, dB"], ["ssim", "SSIM"],
	["ms", "ms", 1], ["ns", "ns per pixel"], ["ratio", "speed, × naive Phong", 1], ["barycentric", "× barycentric"],
];
const DESCENDING = ["ratio", "barycentric", "psnr", "ssim"];
function sceneTable() {
	const value = q => sort.key === "name" ? IDS.indexOf(q.variant) : q[sort.key]?.median ?? q[sort.key] ?? (sort.key === "psnr" ? 1e9 : -1);
	const rows = Object.values(v2.scene.rows).filter(q => options.bary || !q.bary).sort(by(q => (sort.up ? 1 : -1) * value(q))), [shown, more] = folded(rows, 15, "rows");
	const ratios = rows.map(q => q.ratio).filter(Boolean), slowest = Math.max(...rows.map(q => q.ms ?? 0)), width = options.cols ? 104 : 170;
	const x = scale(true, Math.min(.77, ...ratios.map(r => r.low * .96)), Math.max(1.3, ...ratios.map(r => r.high * 1.04)), 5, width - 6);
	const level = (e, q) => bar(num(e), 100 * clamp(Math.log(e / .001) / Math.log(255 / .001), 0, 1), hue(q.variant)), cells = {
		max: level, rms: level,
		ms: (ms, q) => ms ? bar(num(ms), ms / slowest * 100, hue(q.variant)) : "–",
		own: (e, q) => q.within === false ? html`<span title="more than rounding explains">! ${num(e)}</span>` : num(e),
		over1: grouped, other: grouped, barycentric: ratioText,
		psnr: v => v?.toFixed(1) ?? "∞",
		ssim: v => v?.toFixed(4) ?? "–",
		ratio: (r, q) => r ? html`<span class="speed"><svg style="color:${hue(q.variant)}" width="${width}" height="18" aria-hidden="true">${line(x(1), 0, x(1), 18)}${shape(q.variant, x(r.median), 9, 3.4)}${line(x(r.low), 9, x(r.high), 9, "whisker")}${[r.low, r.high].map(v => line(x(v), 3, x(v), 15, "whisker"))}</svg><span class="${r.tie ? "" : r.median > 1 ? "good" : "bad"}" title="${r.low.toFixed(2)}–${r.high.toFixed(2)}">${ratioText(r)}</span></span>` : "–",
	};
	const columns = COLUMNS.filter(([, , always]) => options.cols || always), all = [["name", "method"], ...columns], arrow = key => sort.key === key && (sort.up ? " ↑" : " ↓");
	const name = q => html`<button class="name" data-key="row ${q.variant}">${named(q.variant)}${q.bary && html` <small>barycentric</small>`}</button>`;
	fill($("#table"), html`${table(all.map(([key, label]) => html`<button data-key="${key}">${label}${arrow(key)}</button>`), shown.map(q => [name(q), ...columns.map(([key]) => (cells[key] ?? num)(q[key], q))]), "choose")}${more}`);
	$$("#table [scope=col]").forEach((th, i) => { th.ariaSort = all[i][0] !== sort.key ? "none" : sort.up ? "ascending" : "descending"; });
	$$("#table tbody tr").forEach((tr, i) => {
		tr.dataset.key = "row " + shown[i].variant;
		tr.className = `${shown[i].bary ? "bary" : ""} ${shown[i].variant === v2.a ? "sel" : ""}`;
	});
}
function chooseInTable(key, e) {
	if (key.startsWith("row ")) return v2.show(key.slice(4), e.shiftKey);
	sort = { key, up: sort.key === key ? !sort.up : !DESCENDING.includes(key) };
	sceneTable();
}
/* Copies the shown table, with intervals, as Markdown. */
async function copyMarkdown() {
	const cell = c => `${c.textContent.replace(/[|\\`*_<]/g, "\\$&")}${$("[title]", c) ? ` (${$("[title]", c).title})` : ""}`, [head, ...rows] = $$("#table tr").map(tr => `| ${[...tr.cells].map(cell).join(" | ")} |\n`);
	const markdown = head + head.replace(/[^|\n]+/g, " --: ").replace("--:", "---") + rows.join("");
	try {
		await navigator.clipboard.writeText(markdown);
		toast("Table copied as Markdown");
	} catch {
		save("table.md", markdown, "text/markdown");
		toast("Saved as a file: this browser does not copy");
	}
}

/* -- methods: formulas as mathematics */
const GREEK = { phi: "φ", theta: "θ", alpha: "α", delta: "δ" }, FUNCTIONS = ["sin", "cos", "sqrt", "rsqrt", "min", "max"];
const SIGNS = { ".": "·", "*": "×", "-": "−", "...": "…" };
const operator = t => html`<mo stretchy="false">${t}</mo>`, group = parts => html`<mrow>${parts}</mrow>`;
const isSpace = t => /^\s+$/.test(t), isWord = t => /^[A-Za-z]{3,}$/.test(t) && !FUNCTIONS.includes(t) && !GREEK[t] || ["by", "of", "at", "to", "on", "eq"].includes(t);
/* A name: d… is a difference, trailing letters are an index, N, L, V and the like are vectors. */
function symbol(t) {
	if (/^\d/.test(t)) return html`<mn>${t}</mn>`;
	if (GREEK[t]) return html`<mi>${GREEK[t]}</mi>`;
	const difference = /^d[a-z]*$/.test(t) ? null : /^(d*)([A-Za-z])([a-z0-9]*)(?:_(\w+))?$/.exec(t), [, d, head, letters, mark] = difference ?? [t, "", t];
	const name = html`${d && html`<mi mathvariant="normal">${"Δ".repeat(d.length)}</mi>`}${/^[NLVRHP]$/.test(head) ? html`<mi mathvariant="normal" class="vector">${head}</mi>` : html`<mi>${head}</mi>`}`, index = letters || mark;
	return index ? html`<msub>${group(name)}${group(html`<mi>${index}</mi>`)}</msub>` : group(name);
}
/* Makes fractions: a / b with spaces takes the products on both sides, a/b the neighbours. */
function fractions(items) {
	for (let i = items.findIndex(x => x.over); i > 0; i = items.findIndex(x => x.over)) {
		const end = (k, step) => {
			while (items[i].loose && items[k + step] && !items[k + step].op) k += step;
			return k;
		};
		const from = end(i - 1, -1), to = Math.min(end(i + 1, 1), items.length - 1), joined = (a, b) => group(items.slice(a, b).map(x => x.html));
		items.splice(from, to - from + 1, { html: html`<mfrac>${joined(from, i)}${joined(i + 1, to + 1)}</mfrac>` });
	}
	return items.map(x => x.html);
}
/* Reads tokens up to `close` as mathematics; takes them from the list. */
function mathematics(tokens, close) {
	const items = [], push = (html, more) => items.push({ html, ...more });
	while (tokens.length) {
		const t = tokens.shift(), before = items[items.length - 1];
		if (t === close) break;
		if (isSpace(t)) {
			if (before) before.gap = true;
		} else if (isWord(t)) {
			let words = t;
			while (tokens.length && (isSpace(tokens[0]) || isWord(tokens[0]) || /^(an?|[\d.\-']+|s)$/.test(tokens[0]) || words.endsWith("eq "))) words += tokens.shift();
			push(html`<mtext>\u00a0${words.trim()}\u00a0</mtext>`, { op: true });
		} else if (FUNCTIONS.includes(t) && tokens[0] === "(") {
			tokens.shift();
			const inner = group(mathematics(tokens, ")")), root = html`<msqrt>${inner}</msqrt>`;
			push(t === "sqrt" ? root : t === "rsqrt" ? html`<mfrac><mn>1</mn>${root}</mfrac>` : group([html`<mi>${t}</mi>`, operator("("), inner, operator(")")]));
		} else if (t === "(") {
			const inner = group([operator("("), mathematics(tokens, ")"), operator(")")]);
			if (before?.name && !before.gap) before.html = group([before.html, inner]);
			else push(inner);
		} else if (t === "|") push(group([operator("|"), mathematics(tokens, "|"), operator("|")]));
		else if (t === "^") {
			while (isSpace(tokens[0])) tokens.shift();
			push(html`<msup>${group(items.pop()?.html)}${symbol(tokens.shift())}</msup>`);
		} else if (t === "/") push("/", { op: true, over: true, loose: before?.gap });
		else if (/^[A-Za-z0-9]/.test(t)) push(symbol(t), { name: /^[A-Z]/.test(t) });
		else push(operator(SIGNS[t] ?? t), { op: t !== "." });
	}
	return fractions(items);
}
/* Sets a formula as `fastphong explain` prints it; the rest stays words. */
const formula = source => source.split(/[;\n]|,(?![^(]*\))/).map(part => part.trim()).filter(Boolean).map(part => {
	if (!/[=^/]/.test(part)) return html`<div class="words">${part}</div>`;
	const tokens = part.replace(/^(\w+)_next\s*=/, "$1 ←").match(/[A-Za-z]+\d*(?:_[a-z]+)?|\d+(?:\.\d+)?|\.\.\.|\s+|\S/g);
	return html`<div><math>${mathematics(tokens)}</math></div>`;
});
const OPERATIONS = ["additions", "multiplications", "comparisons", "divisions", "roots", "sines, arctangents", "powers"];
const RATES = [["pixel", o => o.walk.map((n, i) => n + o.shade[i])], ["span", o => o.span], ["edge", o => o.edge], ["edge, per scanline", o => o.edge_step], ["vertex", o => o.vertex], ["polygon", o => o.polygon]];
function article(m, most) {
	const { worst, scene: s } = m, corner = CORNERS.find(c => c.work === "frame" && !c.scalar), frame = corner && ratioIn(STUDY.methods.find(q => q.method === m.name), corner);
	const bad = worst?.max >= 1, rates = RATES.map(([label, of]) => [label, of(m.operations[0])]).filter(([, counts], i) => !i || sum(counts));
	const stack = counts => {
		const list = counts.map((n, i) => [n, OPERATIONS[i], Math.min(i, 5)]).filter(([n]) => n);
		return list.length ? html`<div class="stack" style="width:${Math.max(4, sum(counts) / most * 100)}%" role="img" aria-label="${list.map(([n, what]) => `${n} ${what}`).join(", ")}">${list.map(([n, what, i]) => html`<i class="o${i}" style="flex:${n} 0 ${i > 2 ? 13 : 0}px" title="${n} ${what}">${(n / most > .035 || i > 2) && n}</i>`)}</div>` : html`<div class="hint">none</div>`;
	};
	const figures = [
		m.speed && [m.speed.toFixed(2) + TIMES, `${MANY ? `${SCENES.length} scenes, ` : ""}${levelName(SCENES[0].renderer)}`],
		frame && [frame.median.toFixed(2) + TIMES, `whole picture of a sphere, ${levelName(corner)}`], worst && [num(worst.max), "worst error, levels", bad],
	].filter(Boolean);
	const verdict = bad ? html`<b>Fails</b> most in <a href="#scenes/${s.id}?left=${encodeURIComponent(m.name)}&right=reference">${s.title}</a>` : html`<b>No visible failure</b> ${MANY ? `in ${SCENES.length} scenes` : "in this scene"}`;
	return html`<article class="method" id="m-${m.name}"><div><h2>${mark(m.name)}${m.label} <code>${m.name}</code></h2><p class="idea">${m.title}</p><div class="formula">${formula(m.formula)}</div><p class="hint">${m.source} · ${m.perspective} · ${m.local}</p></div>
<div><div class="ops">${rates.map(([label, counts]) => html`<span>${label}</span>${stack(counts)}`)}</div><div class="kpi">${figures.map(([value, label, bad]) => html`<div><b class="${bad ? "bad" : ""}">${value}</b>${label}</div>`)}</div></div>
${s && html`<figure class="crop"><div class="pair">${["reference", m.name].map(i => html`<div><canvas data-method="${i}" role="img" aria-label="${nameOf(i)}"></canvas>${nameOf(i)}</div>`)}</div><figcaption>${verdict}. In principle: ${m.fails || "nowhere known"}.</figcaption></figure>`}</article>`;
}
function methods([id]) {
	if (id) unfolded.add("methods");
	const el = $("#methodlist"), [shown, more] = folded(METHODS, innerWidth < 1200 ? 6 : 12, "methods");
	if ($$(".method", el).length < shown.length) {
		const most = Math.max(...METHODS.flatMap(m => RATES.map(([, of]) => sum(of(m.operations[0])))));
		write({ "t-methods": `${plural(IDS.length, "way")} to one equation` });
		$("#light").innerHTML = html`${formula("I = Ia ka + Ip kd (L.N) + Ip ks (R.V)^n")}`;
		el.innerHTML = html`${shown.map(m => article(m, most))}${more}`;
		for (const { name, scene: s, worst } of shown) if (s && s.drawn) for (const c of $$("canvas", document.getElementById("m-" + name))) crop(c, s, c.dataset.method, worst.worst, 84, 84);
	}
}

/* -- speed */
const CORNERS = STUDY?.corners.map((c, i) => ({ ...c, i })) ?? [], oneLight = CORNERS.filter(c => c.lights === 1);
let cornerMode = "same";
/* True if a method draws naive Phong's picture in all scenes; without scenes, on the study's sphere. */
const isSame = m => (M[m.method]?.max ?? m.levels_off) <= 1;
const WORKS = { kernel: "loop", frame: "picture" };
const ratioIn = (m, c) => m?.corners[c.i].ratio_to_naive;
/* The fastest method of a corner that draws naive Phong's picture. */
const fastest = c => STUDY.methods.filter(m => isSame(m) && ratioIn(m, c)).sort(by(m => -ratioIn(m, c).median))[0];
/* Methods as lines; a place has a name, a note and values [v, low, high]. */
function slopes(id, label, list, panes, nameOf, format, gap = 20) {
	const el = $(id), W = widthOf(el), part = W < 460 ? W : W / panes.length, l = 40, t = 44, b = Math.max(430, t + list.length * 16.5);
	if (!W || !list.length) return;
	el.innerHTML = html`${panes.map(places => {
		const values = list.flatMap(m => places.flatMap(p => p.values(m))), last = m => format(places[places.length - 1].values(m)[0]), r = part - 34 - Math.max(...list.map(m => textWidth(`${nameOf(m.method)} ${last(m)}`, true)));
		const x = scale(false, 0, places.length - 1, l + 30, r), y = logScale(values, 1.05, b, t);
		return svg(part, b + 10, label, [axisY(y, l, r, y.ticks(gap)), places.map((p, i) => [line(x(i), t, x(i), b), text(x(i), 14, p.name, "bold mid"), text(x(i), 30, p.note, "tick mid")]), curves(x, y, list.map(m => ({
			method: m.method, name: nameOf(m.method), value: last(m), bold: MARKED.has(m.method), kind: MARKED.has(m.method) ? "" : "thin", href: `#methods/${m.method}`,
			tip: `${nameOf(m.method)}: ${places.map(p => `${p.name} ${p.note} ${num(p.values(m)[0])}`).join(", ")}`, points: places.map((p, i) => [i, ...p.values(m)]),
		})), { gap: 15.5, out: 22 })], true);
	})}`;
}
function corners(mode) {
	cornerMode = mode;
	const values = c => m => ["median", "low", "high"].map(k => ratioIn(m, c)[k]), list = STUDY.methods.filter(m => cornerMode === "all" || isSame(m));
	slopes("#corners", "Speed of methods in the shading loop and in whole pictures", list.filter(m => oneLight.every(c => ratioIn(m, c))), [oneLight.map(c => ({ name: WORKS[c.work], note: levelName(c), values: values(c) }))], nameOf, v => v.toFixed(2));
	const kernels = [true, false].map(scalar => CORNERS.filter(c => c.work === "kernel" && c.scalar === scalar)).filter(pair => pair.length > 1);
	slopes("#lights", "Nanoseconds per pixel with one and four lights", list.slice(0, 14), kernels.map(pair => pair.map(c => ({ name: levelName(c), note: plural(c.lights, "light"), values: m => ["median_ns", "p25_ns", "p75_ns"].map(k => m.corners[c.i].timing[k] / STUDY.span) }))), shortName, v => num(v, 2), 40);
}
const curveName = c => c.engine === "span" ? "lecture’s form" : nameOf(c.method), curveHue = c => c.engine === "span" ? "var(--ink3)" : hue(c.method);
/* Times of whole frames against a count. */
function grow(id, keep, count, label) {
	const el = $(id), W = widthOf(el), { points, curves: all } = D.scaling, chosen = points.map((p, i) => ({ ...p, i, n: count(p) })).filter(p => !p.away && keep(p)).sort(by(p => p.n));
	if (!W || chosen.length < 2) return;
	const series = all.map(c => ({
		method: c.method, name: curveName(c), colour: curveHue(c), kind: c.engine === "span" ? "dash1" : "", tip: curveName(c), points: chosen.filter(p => c.times[p.i]).map(p => [p.n, c.times[p.i].min_ns / 1e6]),
	})).filter(s => s.points.length);
	const ms = series.flatMap(s => s.points.map(p => p[1])), l = 48, r = W - (W < 480 ? 112 : 150), b = 286;
	const x = logScale(chosen.map(p => p.n), 1, l + 8, r), y = logScale(ms, 1.15, b, 14);
	el.innerHTML = svg(W, 330, `Time of a frame by ${label}`, [axisY(y, l, r + 8, y.ticks(40), " ms"), axisX(x, b, x.ticks(70)), text((l + r) / 2, 324, label, "axis mid"), curves(x, y, series)]);
}
const COSTS = [["vertex_ns", "vertex"], ["triangle_ns", "triangle"], ["span_ns", "span"], ["pixel_ns", "pixel of a span"], ["background_ns", "pixel of the picture"]];
/* The largest misfit of fits that are shown. */
const MISFIT = .5;
function costs() {
	const all = D.scaling.curves.filter(c => c.costs), list = all.filter(c => Math.abs(c.costs.worst) <= MISFIT), most = k => Math.max(...list.map(c => c.costs[k])) || 1;
	const even = c => {
		const base = list.find(o => o.method === BASE && o.engine === c.engine)?.costs, more = c.costs.span_ns - base?.span_ns, saved = base?.pixel_ns - c.costs.pixel_ns;
		return saved > 0 && list.includes(c) ? more > 0 ? num(more / saved, 2) : "0" : "–";
	};
	$("#costs").innerHTML = table(["", ...COSTS.map(([, name]) => name), "break-even span, pixels", "largest misfit"], all.map(c => [curveName(c), ...COSTS.map(([k]) => list.includes(c) ? bar(num(c.costs[k], 2), Math.max(1, c.costs[k] / most(k) * 100), curveHue(c)) : "–"), even(c), html`${(Math.abs(c.costs.worst) * 100).toFixed(0)} %${!list.includes(c) && html` <span class="bad">poor fit</span>`}`]));
	write({ misfit: MISFIT * 100 });
}
/* Documents side by side, a column each under its processor. */
function beside() {
	const names = [...new Set(DOCS.flatMap(d => d.comparisons.map(c => c.name)))], pick = $("#beside-scene"), rowsOf = (d, name) => d.comparisons.find(c => c.name === name)?.rows;
	if (!pick.options.length) pick.innerHTML = html`${[...(names.length > 1 ? [""] : []), ...names].map(n => html`<option value="${n}">${n || "all scenes they share"}</option>`)}`;
	pick.onchange = beside;
	const shared = pick.value ? [pick.value] : names.filter(n => DOCS.every(d => rowsOf(d, n)));
	// Older documents judged the row engine by the polygons of the span engine.
	const sameErrors = rows => DOCS.every(d => d.schema === D.schema) || !rows.some(r => r.engine === "row");
	const cell = (d, m) => {
		const rows = shared.map(n => rowsOf(d, n)?.find(r => r.variant === m));
		if (!rows.length || rows.some(r => !r?.speed)) return "–";
		return `${num(mean(rows.map(r => r.speed.timing.median_ns / 1e6)))} ms · ${mean(rows.map(r => r.speed.ratio_to_naive?.median ?? 1)).toFixed(2)}${TIMES} · ${sameErrors(rows) ? num(Math.max(...rows.map(r => r.error.max * 255))) : "–"} levels`;
	};
	const heads = DOCS.map(({ machine, date }) => html`${machine.cpu}<br><small>${[machine.version, machine.commit?.slice(0, 9), date].filter(Boolean).join(" · ")}</small>`);
	const variants = [...new Set(DOCS.flatMap(d => d.comparisons.flatMap(c => c.rows.map(r => r.variant))))];
	$("#beside").innerHTML = table(["method", ...heads], variants.map(m => [html`<span class="name">${named(m)}</span>`, ...DOCS.map(d => cell(d, m))]));
}
function speed() {
	if (STUDY) {
		const lecture = STUDY.methods.find(m => m.method === "fast-phong"), entry = (m, c) => ratioIn(m, c) ? html`${nameOf(m.method)} <b>${ratioText(ratioIn(m, c))}</b>` : "–";
		$("#speed-summary").innerHTML = table(["", ...oneLight.map(c => `${WORKS[c.work]}, ${levelName(c)}`)], [["fastest with naive Phong’s picture", ...oneLight.map(c => entry(fastest(c), c))], ["the lecture’s fast Phong", ...oneLight.map(c => entry(lecture, c))]]);
		write({ "same-where": MANY ? `all ${SCENES.length} scenes` : SCENES[0]?.title ?? "this sphere", "loop-span": grouped(STUDY.span), "study-span": grouped(STUDY.span), "study-frame": `${STUDY.mesh}, ${STUDY.size.join(" × ")}` });
		segments($("#corner-mode"), () => cornerMode, corners);
		corners(cornerMode);
	}
	const growth = D.scaling;
	if (growth) {
		grow("#grow-triangles", p => p.size.join() === growth.at.join(), p => p.triangles, `triangles, at ${growth.at.join(" × ")}`);
		grow("#grow-pixels", p => p.asked === growth.of, p => p.pixels, `covered pixels, about ${grouped(growth.of)} triangles`);
		costs();
	}
	if (DOCS.length > 1) beside();
}

/* -- lectures */
const figurePictures = f => memo("figures", () => JSON.parse($("#figure-pictures").textContent))[FIGURES.indexOf(f)] ?? [];
const chips = (f, named) => html`<span class="chips">${counts(f.findings).map(([k, n]) => chip(k, n + (named ? " " + k : "")))}</span>`;
const topic = f => f.title.split(":")[0];
function findingValue({ value, unit }) {
	const size = Math.abs(value), [digits, power] = value.toExponential(1).replace(/-/g, "−").replace("+", "").split("e");
	return html`${size && (size < .001 || size >= 1e6) ? html`${digits}·10<sup>${power}</sup>` : +value.toPrecision(4)} ${unit}`;
}
const findingTable = (list, where) => scrolling("Findings", table([where && "figure", "finding", "measured", "value", "verdict"].filter(Boolean), list.map((x, i) => [
	// A figure, and a finding of several measurements, stand once.
	...(where ? [x.figure !== list[i - 1]?.figure && html`<a href="#lectures/${x.figure.name}">${topic(x.figure)}</a><small>${x.figure.lecture}</small>`] : []), x.verdict !== list[i - 1]?.verdict && x.verdict, x.label, html`<span title="${x.value}">${findingValue(x)}</span>`, chip(x.agreement, x.agreement),
]), "findings"));
const PLOT_HUES = ["--base", "--h3", "--h2", "--h4", "--h1", "--h5"];
/* Curves over one another, on axes unless the chart is a small one. */
function plot(p, W, H) {
	const small = H < 150, series = p.series.map((s, i) => ({ ...keyed(s, i), points: s.points.filter(q => q.every(v => v != null && isFinite(v))) })), [l, r, t, b] = small ? [4, W - 4, 6, H - 6] : [52, W - 12, 22, H - 42];
	const axis = (values, [, kind], from, to) => {
		const log = kind === "log", list = values.filter(v => isFinite(v) && (!log || v > 0)), low = Math.min(...list), high = Math.max(...list);
		return low < high ? scale(log, low, high, from, to) : scale(log, low / 2 || -.5, low * 2 || .5, from, to);
	};
	const points = series.flatMap(s => s.points), x = axis([...points.map(q => q[0]), ...p.marks], p.x, l, r), y = axis(points.map(q => q[1]), p.y, b, t), at = ([u, v]) => [x(clamp(u, x.low, x.high)), y(clamp(v, y.low, y.high))];
	const axes = small ? [] : [axisY(y, l, r, y.ticks(32)), axisX(x, b, x.ticks(60)), text((l + r) / 2, H - 6, p.x[0], "axis mid"), text(2, 12, p.y[0], "axis")];
	return svg(W, H, `${p.title}: ${p.series.map(s => s.label).join(", ")}`, [axes, p.marks.map(m => line(x(m), t, x(m), b, "dots")), series.map(s => html`<g style="color:${s.colour}">${curve(s.points.map(at), s.kind)}</g>`)]);
}
const keyed = (s, i) => ({ colour: `var(${PLOT_HUES[i % 6]})`, kind: `dash${i % 6}`, ...s });
const legend = series => html`<div class="legend">${series.map(keyed).map(s => html`<span style="color:${s.colour}"><svg width="26" height="8" aria-hidden="true">${curve([[0, 4], [26, 4]], s.kind)}</svg><span>${s.label}</span></span>`)}</div>`;
/* The blocks of a figure. */
function figureBody(f) {
	const files = [...figurePictures(f)];
	const show = {
		text: b => html`<p>${b}</p>`,
		table: b => scrolling(f.title, table(b.head, b.rows, "plain")),
		plot: (b, at) => html`<figure class="plot"><h3>${b.title}</h3><div class="chartbox" data-plot="${at}"></div><figcaption>${b.caption}</figcaption></figure>`,
		pictures: b => html`<div class="shown" style="--columns:${clamp(b.columns, 1, 6)}">${b.shown.map(p => html`<figure><img src="${files.shift()}" alt="${p.alt}"><figcaption>${p.caption}</figcaption></figure>`)}</div>`,
	};
	return f.blocks.map((block, at) => {
		const [[kind, content]] = Object.entries(block);
		return show[kind](content, at);
	});
}
function drawPlots(f) {
	for (const el of $$("[data-plot]")) {
		const { plot: p } = f.blocks[el.dataset.plot];
		el.innerHTML = html`${plot(p, widthOf(el) || 460, 300)}${legend(p.series)}`;
	}
}
/* A figure's first pictures, or its first plot. */
function preview(f) {
	const first = f.blocks.find(b => b.plot)?.plot, shown = f.blocks.flatMap(b => b.pictures?.shown ?? []), files = figurePictures(f).slice(0, 3);
	return files.length ? files.map((src, i) => html`<img src="${src}" alt="${shown[i].alt}">`) : first && plot(first, 260, 112);
}
function lectures([part = ""]) {
	const body = $("#lecture-body"), lists = { wrong: FINDINGS.filter(x => x.agreement === "contradicts"), all: FINDINGS }, list = lists[part], [shown, more] = folded(list ?? [], 40, "findings");
	segments($("#lecture-tabs"), () => part, key => go(key ? "lectures/" + key : "lectures"));
	const f = FIGURES.find(q => q.name === part) ?? (FIGURES.length === 1 ? FIGURES[0] : null);
	if (list) body.innerHTML = html`${part === "wrong" && html`<p class="lead">${list.length} measurements disagree with what is printed, most under conditions that the text does not name.</p>`}${findingTable(shown, true)}${more}`;
	else if (f) {
		const links = html`<nav class="list" aria-label="Figures">${FIGURES.map(q => html`<a href="#lectures/${q.name}" ${q === f && html`aria-current="true"`}><span>${topic(q)}</span>${q.findings.some(x => x.agreement === "contradicts") && html`<span class="chip contradicts" title="contradicts">✗</span>`}</a>`)}</nav>`;
		body.innerHTML = html`<div class="${FIGURES.length > 1 ? "detail" : ""}">${FIGURES.length > 1 && links}<article class="fig"><h2>${f.title}</h2><p class="facts">${f.lecture}</p>${chips(f, true)}${figureBody(f)}<h3>Findings</h3>${findingTable(f.findings)}</article></div>`;
		reveal($(".list [aria-current]", body));
		drawPlots(f);
	} else {
		const [cards, rest] = folded(FIGURES, innerWidth < 700 ? 16 : 30, "figures");
		body.innerHTML = html`<div class="gallery">${cards.map(q => html`<a class="fcard" href="#lectures/${q.name}"><span class="preview">${preview(q)}</span><span class="tx"><b>${q.title}</b><small>${q.lecture}</small>${chips(q)}</span></a>`)}</div>${rest}`;
	}
}

/* -- how measured */
const quoted = w => /^[\w\-./:=,+@%]+$/.test(w) ? w : `'${w.replace(/'/g, "'\\''")}'`;
function measured() {
	const command = D.command_line.map(quoted).join(" "), { machine } = D, [scene] = SCENES, rounds = ROWS.map(q => q.rounds).filter(Boolean);
	const about = ({ cpu, os, arch, rustc, version, commit }) => `${cpu}, ${os} ${arch}; ${rustc}; fastphong ${version}${commit ? `, commit ${commit}` : ""}`;
	const facts = [
		["machine", about(machine)], ["logical processors", machine.cores], ["build", `${machine.profile}, opt-level ${machine.opt_level}, for ${machine.target_features.join() === "sse2" ? "baseline x86-64; wider instructions are chosen as it runs" : machine.target_features.join(", ")}`], ["date", D.date], ["whole run", D.seconds && `${num(D.seconds)} s`],
		["rounds", rounds.length && `${Math.min(...rounds)} to ${Math.max(...rounds)} of every method in a scene`], ["drawn by", scene && `the ${scene.renderer.engine} engine, ${levelName(scene.renderer)} code, ${plural(scene.renderer.threads, "thread")}`],
		["command", html`<code>${command}</code>`], ...DOCS.slice(1).map((d, i) => [`beside it, ${i + 1}`, about(d.machine)]),
	];
	const spreads = ROWS.filter(q => q.p75).map(q => (q.p75 - q.p25) / q.ms).sort(by(v => v)), typical = spreads[spreads.length >> 1] ?? 0;
	$("#busy").hidden = typical < .1;
	// A mesh alone is lit by the report, not by `compare`.
	const again = [command, scene && !/:|\.obj$/i.test(scene.name) && `fastphong compare ${quoted(scene.name)} --size ${scene.w}x${scene.h}`, `fastphong explain ${BEST ?? BASE}`];
	$("#machine").innerHTML = html`${facts.filter(fact => fact[1]).map(([name, value]) => html`<dt>${name}</dt><dd>${value}</dd>`)}`;
	write({ timed: D.timed, compared: D.compared, typical: num(typical * 100, 2), again: again.filter(Boolean).join("\n") });
	$("#get-json").onclick = () => save("fastphong-report.json", $("#fastphong-data").textContent, "application/json");
	$("#get-csv").onclick = () => save("fastphong-report.csv", csv(ROWS.map(({ worst, ratio, barycentric, ...q }) => ({ ...q, x: worst?.[0], y: worst?.[1], speed: ratio?.median, low: ratio?.low, high: ratio?.high, barycentric: barycentric?.median }))), "text/csv");
	$("#get-findings").onclick = () => save("fastphong-findings.csv", csv(FINDINGS.map(x => ({ ...x, figure: x.figure.name }))), "text/csv");
}

/* -- routes: #view/part?left=…&right=…&mode=…&x=…&y=…&zoom=…&row=… */
const VIEWS = { overview, scenes, methods, speed, lectures, measured };
let view = "", restoring = true;
function go(hash) {
	clearTimeout(timers.remember);
	location.hash = hash;
}
/* Reads a viewer's state from an address. */
function fromRoute(query, v) {
	const given = Object.fromEntries(query), whole = key => given[key] && isFinite(given[key]) ? Math.floor(given[key]) : null, s = S[given.scene] ?? v.scene, state = { scene: s };
	if (given.left) state.a = given.left;
	if (given.right) state.b = given.right;
	if (given.left || given.right || given.mode) state.mode = Object.values(MODES).includes(given.mode) ? given.mode : "slide";
	if (given.scale) state.top = +given.scale || 0;
	if (whole("x") != null && whole("y") != null) {
		const pin = [clamp(whole("x"), 0, s.w - 1), clamp(whole("y"), 0, s.h - 1)];
		Object.assign(state, { pin, z: clamp(+given.zoom || 1, 1, 32), cx: (pin[0] + .5) / s.w, cy: (pin[1] + .5) / s.h });
	}
	if (v.row && given.row) state.line = whole("row") ?? 0;
	return state;
}
/* Keeps the address in step with a viewer. */
function remember(v) {
	if (restoring) return;
	delay("remember", 60, () => {
		const own = v === v1 ? "overview" : "scenes", { scene: s, pin } = v;
		if (view !== own) return;
		const zoom = pin && v.z > 1 ? v.z.toFixed(1) : null, state = { scene: v === v1 && s !== SCENES[0] ? s.id : null, left: v.a, right: v.b, mode: v.mode === "slide" ? null : v.mode, scale: v.top || null, x: pin?.[0], y: pin?.[1], zoom, row: v.line };
		history.replaceState(null, "", `#${v === v1 ? own : `scenes/${s.id}`}?${new URLSearchParams(Object.entries(state).filter(([, value]) => value != null))}`);
	});
}
function route(e) {
	clearTimeout(timers.remember);
	const [path, query] = (e?.newURL ? new URL(e.newURL) : location).hash.slice(1).split("?"), [asked, ...parts] = path.split("/").map(decodeURIComponent), name = VIEWS[asked] && FILLED[asked] ? asked : FILLED.overview ? "overview" : "lectures", changed = name !== view;
	view = name;
	restoring = true;
	$$(".view").forEach(s => s.classList.toggle("on", s.id === name));
	const link = $(`.top nav a[href="#${name}"]`);
	$$(".top nav a").forEach(a => { a.ariaCurrent = a === link ? "page" : null; });
	VIEWS[name](parts.filter(Boolean), new URLSearchParams(query ?? ""));
	const target = e && document.getElementById("m-" + parts[0]);
	if (target) target.scrollIntoView();
	else if (changed || e && name === "lectures") scrollTo(0, 0);
	restoring = false;
	fadeEnds();
	document.title = `${name === "overview" ? "" : link.textContent + " · "}fastphong: Phong shading, measured`;
}
addEventListener("hashchange", route);
addEventListener("resize", () => delay("resize", 120, route));
addEventListener("keydown", e => {
	const v = view === "overview" ? v1 : view === "scenes" ? v2 : null, on = e.target;
	if (e.ctrlKey || e.metaKey || e.altKey || on.matches("select") || $("#keys").open) return;
	if (e.key === "?") return $("#keys").showModal();
	if (!v || e.key === " " && on.closest("button,a,.hit")) return;
	const step = v === v2 && ({ "[": -1, "]": 1 }[e.key] ?? (on.closest(".rail") && { ArrowUp: -1, ArrowLeft: -1, ArrowDown: 1, ArrowRight: 1 }[e.key]));
	if (step) {
		e.preventDefault();
		return stepScene(step);
	}
	if (e.key.startsWith("Arrow") && on.closest(".scroll,nav")) return;
	if (v.key(e)) e.preventDefault();
});
$("#help").onclick = () => $("#keys").showModal();
$("#theme").onclick = () => {
	const { dataset } = ROOT, dark = dataset.theme ? dataset.theme === "dark" : matchMedia("(prefers-color-scheme:dark)").matches;
	dataset.theme = dark ? "light" : "dark";
	try { localStorage.setItem("fastphong-theme", dataset.theme); } catch { /* a file opened from disk may have no storage */ }
};
$("#big").onclick = e => {
	e.currentTarget.ariaPressed = ROOT.toggleAttribute("data-big");
	route();
};
$$(".answer .m").forEach(a => a.style.setProperty("--c", hue(a.dataset.m)));
$$("[data-scene]").forEach(a => { a.href = `#scenes/${SCENES[a.dataset.scene].id}?left=${a.dataset.of}&right=reference&mode=error`; });
/* Parts of the page that have something to show. */
const FILLED = {
	scenes: SCENES.length, methods: IDS.length, lectures: FIGURES.length, findings: FINDINGS.length, overview: SCENES.length || FIGURES.length > 1, speed: STUDY || D.scaling || DOCS.length > 1, study: STUDY, growth: D.scaling,
	beside: DOCS.length > 1, many: MANY, strip: MANY && chosen(1).length, timed: TIMED, untimed: !TIMED, measured: true, numbers: !PICTURES, debug: D.machine.profile !== "release",
	srgb: SCENES.some(s => s.encoding === "srgb"), depth: ROWS.some(q => q.other),
};
$$("[data-if]").forEach(el => { el.hidden = !FILLED[el.dataset.if]; });
addEventListener("beforeprint", () => {
	$$(".view").forEach(s => s.classList.toggle("on", !!FILLED[s.id]));
	for (const name in VIEWS) if (FILLED[name]) VIEWS[name]([], new URLSearchParams());
});
addEventListener("afterprint", () => {
	view = "";
	route();
});
route();
