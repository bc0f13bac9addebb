/* The viewer: two pictures side by side, with a slider between them, or in turn, or their errors. */

import { onChoose, segments } from "./controls.js";
import { $, $$, atNextFrame, html, save, toast } from "./markup.js";
import { clamp, num } from "./numbers.js";

/* The ways to compare by their keys, and what other keys and buttons do. */
export const MODES = { s: "slide", f: "flip", d: "side", e: "error" };

const KEYS = {
	" ": v => v.flip(),
	x: v => v.set({ a: v.b, b: v.a }),
	"+": v => v.zoom(2),
	"=": v => v.zoom(2),
	"-": v => v.zoom(0.5),
	z: v => v.zoom(0),
	w: v => v.worst(),
	r: v => v.row?.(v),
	png: v => v.save(),
	p: v => v.hold(v.pin ? null : (v.hover ?? v.rest)),
	arrowleft: (v, e) => v.slide(-1, e),
	arrowright: (v, e) => v.slide(1, e),
};

for (const key in MODES) KEYS[key] = v => v.set({ mode: MODES[key] });

/* The view of a scene before anything is moved. */
export const STILL = { azimuth: 0, elevation: 0, size: 1, light: null, exponent: 0, given: {} };

/* True if a view is the view of the stored pictures. */
export const isStill = view =>
	!view.azimuth &&
	!view.elevation &&
	view.size === 1 &&
	!view.light &&
	!view.exponent &&
	!Object.keys(view.given).length;

/* Compares the pictures of methods `a` and `b`. Each page has its own kind of viewer, which says what the pictures are, and may turn
   them. */
export class Viewer {
	/* What is shown: a scene, two of its pictures, and how they are compared. */
	/** @type {any} */
	scene;
	a;
	b;
	mode = "slide";
	side = "a";
	split = 0.5;
	view = STILL;
	/* How far it is zoomed, around which point, and the top of the scale of errors. */
	z = 1;
	cx = 0.5;
	cy = 0.5;
	top = 0;
	turn = 0;
	/* What the page does at a pixel, with a row, and when something changes. */
	probe;
	row;
	plot;
	change;
	choices;
	/* The row that is plotted, and the pixels that are pointed at, held, and worst. */
	line;
	hover;
	pin;
	rest;

	constructor(root, options) {
		this.root = root;
		Object.assign(this, options);
		root.tabIndex = -1;
		root.append($("#viewer-parts").content.cloneNode(true));
		this.canvas = $(".stage canvas", root);
		this.stage = $(".stage", root);
		this.divider = $(".divider", root);
		this.markMode = segments(
			$(".seg", root),
			() => this.mode,
			mode => this.set({ mode }),
		);
		root.onchange = ({ target }) => target.name && this.set({ [target.name]: target.value });
		onChoose($(".vfoot", root), (key, e) => (KEYS[key] ? KEYS[key](this, e) : this.choose(key)));
		$(".row", root).hidden = !this.row;
		this.hand = this.handOf();
		this.listen();
		new ResizeObserver(() => atNextFrame(() => this.draw())).observe(this.stage);
	}

	/* What each kind has: the picture of a method or its error map, names and marks. */
	/** @type {(s: any, m: string) => any} */
	image(s, m) {}

	/** @type {(m: string) => any} */
	nameOf(m) {}

	/** @type {(m: string) => any} */
	mark(m) {}

	/* What turns the pictures. Here nothing does. */
	/** @returns {any} */
	handOf() {
		const panel = $(".handles", this.root);
		return { panel, source: this.scene, can: false, controls() {}, placeSun() {} };
	}

	/* The method whose key is a digit. */
	/** @returns {any} */
	methodOf(digit) {}

	/* Chooses another scene. */
	choose(key) {}

	/* Draws the scale of the error map. */
	drawScale() {}

	/* Where the shown pictures and rows come from: the stored scene, or the one that the page draws. */
	get source() {
		return this.hand.source;
	}

	/* Changes scene, pictures, mode or view. */
	async set(change) {
		const { live, ...others } = change;
		// A view belongs to one scene.
		if (others.scene && others.scene !== this.scene) others.view ??= STILL;
		const looks = "view" in others;
		Object.assign(this, others);
		if (live) this.hand.live = live;
		const { root, scene: s } = this;
		const error = this.mode === "error";
		const known = (m, otherwise) => (m === "reference" || s.list.includes(m) ? m : otherwise);
		this.top = Number(this.top);
		this.a = known(this.a, s.list[0]);
		this.b = known(this.b, "reference");
		for (const name of ["a", "b"]) {
			const select = $(`[name=${name}]`, root);
			select.innerHTML = html`${["reference", ...s.list].map(
				m => html`<option value="${m}">${this.nameOf(m)}</option>`,
			)}`;
			select.value = this[name];
			select.previousElementSibling.innerHTML = this.mark(this[name]);
		}
		this.markMode();
		$$(".choices button", root).forEach(b => {
			b.ariaPressed = b.dataset.key === s.id;
		});
		this.stage.style.aspectRatio = `${s.w}/${s.h}`;
		root.dataset.mode = this.mode;
		if (error) this.drawScale();
		if (!("side" in change) && ("mode" in change || "a" in change)) this.side = "a";
		this.A = this.B = null;
		this.hand.controls();
		this.change?.(this, change);
		const isLive = !isStill(this.view) || s.own;
		const isReady = isLive && (await this.hand.ready());
		// If the page cannot draw the view, the stored pictures are shown, unless the reader chose another scene meanwhile.
		if (this.scene !== s) return;
		if (isLive && !isReady) this.view = STILL;
		if (isReady && looks) await this.hand.rest();
		else await this.present();
	}

	/* Fetches the pictures of both sides, and draws them. */
	async present() {
		const s = this.source;
		const error = this.mode === "error";
		if (!s.drawn && !s.own) return;
		const turn = ++this.turn;
		const { root } = this;
		try {
			const [A, B] = await Promise.all([
				this.image(s, this.a),
				this.image(s, error && this.b === "reference" ? this.a : this.b),
			]);
			if (turn !== this.turn) return;
			[this.A, this.B] = [A.canvas, B.canvas];
			$(".missing", root).hidden = true;
			this.draw();
			root.dataset.shown = [s.id, this.a, this.b, this.mode].join("|");
		} catch (problem) {
			if (s !== this.scene) throw problem;
			$(".missing", root).hidden = false;
		}
	}

	get single() {
		return this.mode === "flip" || (this.mode === "error" && this.b === "reference");
	}

	get slides() {
		return !this.single && this.mode !== "side";
	}

	/* The part of the picture that a pane shows: scale, corner, size. */
	part() {
		const w = this.stage.clientWidth / (this.mode === "side" ? 2 : 1);
		const h = this.stage.clientHeight;
		const { w: iw, h: ih } = this.scene;
		const k = Math.min(w / iw, h / ih) * this.z;
		const corner = (centre, size, seen) =>
			seen >= size ? (size - seen) / 2 : clamp(centre * size - seen / 2, 0, size - seen);
		return { k, x: corner(this.cx, iw, w / k), y: corner(this.cy, ih, h / k), w, h, iw, ih };
	}

	draw() {
		// The stage and the buttons below it fit into the window.
		const top = scrollY + this.stage.getBoundingClientRect().top;
		const below = this.hand.panel.offsetHeight + $(".vfoot", this.root).offsetHeight;
		const others = top + below + 9;
		this.stage.style.maxHeight = `max(300px,100vh - ${others}px)`;
		const view = this.part();
		const { k, w, h } = view;
		if (!this.A || !w) return;
		const ratio = devicePixelRatio || 1;
		const canvas = this.canvas;
		const pen = canvas.getContext("2d");
		const side = this.mode === "side";
		const error = this.mode === "error";
		const panes = side ? 2 : 1;
		[canvas.width, canvas.height] = [w * ratio * panes, h * ratio];
		pen.scale(ratio, ratio);
		pen.imageSmoothingEnabled = k * ratio < 2.01 && this.z === 1;
		pen.imageSmoothingQuality = "high";
		const pane = (image, from, to, left = 0) =>
			pen.drawImage(
				image,
				view.x + (from - left) / k,
				view.y,
				(to - from) / k,
				h / k,
				from,
				0,
				to - from,
				h,
			);
		const second = this.side === "b" && !error;
		const from = side ? w + 1 : this.split * w;
		pane(this.single && second ? this.B : this.A, 0, this.single ? w : side ? w - 1 : from);
		if (!this.single) pane(this.B, from, w * panes, side ? w : 0);
		const pixel = this.hover ?? this.pin ?? this.rest;
		for (let n = 0; pixel && n < panes; n++) {
			const size = Math.max(k, 9);
			const [x, y] = [(pixel[0] - view.x) * k + n * w, (pixel[1] - view.y) * k].map(
				v => v - (size - k) / 2,
			);
			for (const [width, colour] of [
				[3, "#000a"],
				[1.4, "#fff"],
			]) {
				[pen.lineWidth, pen.strokeStyle] = [width, colour];
				pen.strokeRect(x, y, size, size);
			}
		}
		if (this.line != null) {
			pen.fillStyle = "#fff8";
			pen.fillRect(0, (this.line + 0.5 - view.y) * k - 0.5, w * panes, 1);
		}
		this.divider.hidden = !this.slides;
		this.divider.style.left = this.split * 100 + "%";
		this.divider.ariaValueNow = Math.round(this.split * 100);
		this.stage.classList.toggle("slides", this.slides);
		this.stage.classList.toggle("zoomed", this.z > 1);
		const label = (part, m, shown) => {
			const el = $(part, this.root);
			const s = this.source;
			const q = s.rows[m];
			const isLive = s !== this.scene;
			const time = q?.ms ? ` · ${num(q.ms)} ms${isLive ? " here" : ""}` : "";
			const from = isLive && s.exact !== "reference" ? ` from ${this.nameOf(s.exact)}` : "";
			const about = s.about?.(m) ?? (q ? `max ${num(q.max)} levels${from}${time}` : "f64, closed form");
			el.innerHTML = html`<b>${this.nameOf(m)}${error && " · error"}</b>${about}`;
			el.classList.toggle("faint", !shown);
		};
		label(".tag.a", this.single && second ? this.b : this.a, !this.slides || this.split > 0.16);
		label(".tag.b", this.b, side || (this.slides && this.split < 0.84));
		const names =
			this.nameOf(this.a) + (this.single ? "" : ` left, ${this.nameOf(this.b)} right`);
		this.hand.placeSun();
		canvas.ariaLabel = `${this.scene.title}: ${names}${error ? ", error map" : ""}`;
	}

	/* Zooms by a factor, 0 for the whole picture, around a point of the stage. */
	zoom(factor, x, y) {
		const view = this.part();
		const z = clamp(this.z * factor, 1, 32);
		const k = (view.k / this.z) * z;
		if (x == null)
			[x, y] = this.pin
				? [(this.pin[0] + 0.5 - view.x) * view.k, (this.pin[1] + 0.5 - view.y) * view.k]
				: [view.w / 2, view.h / 2];
		this.cx = factor ? (view.x + x / view.k + (view.w / 2 - x) / k) / view.iw : 0.5;
		this.cy = factor ? (view.y + y / view.k + (view.h / 2 - y) / k) / view.ih : 0.5;
		this.z = z;
		this.moved();
	}

	moved() {
		this.draw();
		this.change?.(this, { moved: true });
	}

	move(split) {
		this.split = clamp(split, 0, 1);
		this.draw();
	}

	slide(sign, { shiftKey }) {
		return this.slides && this.move(this.split + sign * (shiftKey ? 0.1 : 0.02));
	}

	/* A point of the window on the stage: in its pane, and as a part of its width. */
	local({ clientX, clientY }) {
		const box = this.stage.getBoundingClientRect();
		const view = this.part();
		const x = clientX - box.left;
		return {
			x: this.mode === "side" ? x % view.w : x,
			y: clientY - box.top,
			part: x / box.width,
			view,
		};
	}

	pixelAt(e) {
		const { x, y, view } = this.local(e);
		const pixel = [Math.floor(view.x + x / view.k), Math.floor(view.y + y / view.k)];
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

	/* One finger or the mouse turns the model, moves the divider, or a zoomed picture; two fingers zoom. */
	listen() {
		const stage = this.stage;
		const fingers = new Map();
		const pair = () => {
			const [p, q] = [...fingers.values()];
			return {
				apart: Math.hypot(p.clientX - q.clientX, p.clientY - q.clientY),
				clientX: (p.clientX + q.clientX) / 2,
				clientY: (p.clientY + q.clientY) / 2,
			};
		};
		let gesture = null;
		stage.onpointerdown = e => {
			if (e.button) return;
			fingers.set(e.pointerId, e);
			stage.setPointerCapture(e.pointerId);
			const { part } = this.local(e);
			const near = Math.abs(part - this.split) * stage.clientWidth < 24;
			gesture = {
				kind: this.slides && near ? "split" : this.z > 1 ? "pan" : this.hand.can ? "turn" : this.slides ? "split" : "pan",
				from: e,
				cx: this.cx,
				cy: this.cy,
				far: 0,
			};
			if (fingers.size === 2)
				gesture = { kind: "pinch", apart: pair().apart, z: this.z, far: 99 };
		};
		stage.onpointermove = e => {
			if (fingers.has(e.pointerId)) fingers.set(e.pointerId, e);
			const { part, view } = this.local(e);
			const kind = gesture?.kind;
			if (kind === "pinch") {
				if (fingers.size < 2) return;
				const { apart, ...middle } = pair();
				const { x, y } = this.local(middle);
				return this.zoom((gesture.z * apart) / gesture.apart / this.z, x, y);
			}
			if (gesture) {
				const [dx, dy] = [
					e.clientX - gesture.from.clientX,
					e.clientY - gesture.from.clientY,
				];
				gesture.far = Math.max(gesture.far, Math.hypot(dx, dy));
				if (kind === "split" && gesture.far > 2) this.move(part);
				// A finger that starts upward or downward scrolls the page.
				const scrolls =
					e.pointerType === "touch" && !gesture.last && Math.abs(dy) >= Math.abs(dx);
				if (kind === "turn" && gesture.far > 2 && !scrolls) {
					const last = gesture.last ?? gesture.from;
					this.hand.turnBy(e.clientX - last.clientX, e.clientY - last.clientY);
					gesture.last = e;
				}
				if (kind === "pan" && this.z > 1) {
					[this.cx, this.cy] = [
						gesture.cx - dx / view.k / view.iw,
						gesture.cy - dy / view.k / view.ih,
					];
					this.draw();
				}
			}
			const drags = kind === "split" || kind === "turn";
			if (this.probe && (!drags || gesture.far < 3)) this.look(this.pixelAt(e));
		};
		stage.onpointerup = e => {
			fingers.delete(e.pointerId);
			if (gesture?.far < 4) this.tap(e);
			else if (gesture && gesture.kind !== "split" && gesture.kind !== "turn") this.moved();
			gesture = null;
		};
		stage.onpointercancel = e => {
			fingers.delete(e.pointerId);
			gesture = null;
		};
		stage.onpointerleave = () => {
			if (!gesture && this.probe) this.look(null);
		};
		stage.addEventListener(
			"wheel",
			e => {
				if (!e.ctrlKey && !e.metaKey) return;
				e.preventDefault();
				const { x, y } = this.local(e);
				this.zoom(2 ** (-e.deltaY / 120), x, y);
			},
			{ passive: false },
		);
		stage.ondblclick = e => {
			const { x, y } = this.local(e);
			if (!e.target.closest(".divider")) this.zoom(e.shiftKey ? 0.25 : 4, x, y);
		};
	}

	/* Holds the pixel or releases it. Without a probe, flips the pictures or moves the divider. */
	tap(e) {
		if (this.probe) {
			const pixel = this.pixelAt(e);
			const again =
				this.pin && pixel && Math.hypot(pixel[0] - this.pin[0], pixel[1] - this.pin[1]) < 4;
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
		this.set(
			right ? { b: m } : this.mode === "flip" && m === this.b ? { side: "b" } : { a: m },
		);
	}

	worst() {
		const m = this.a === "reference" ? this.b : this.a;
		const q = this.source.rows[m];
		const { w, h } = this.scene;
		if (!q?.worst) return toast("No pixel differs");
		Object.assign(this, {
			z: 12,
			cx: (q.worst[0] + 0.5) / w,
			cy: (q.worst[1] + 0.5) / h,
			hover: null,
		});
		this.hold([...q.worst]);
		toast(`${this.nameOf(m)}: worst pixel ${q.worst.join(", ")}, ${num(q.max)} levels`);
	}

	save() {
		this.canvas.toBlob(png =>
			save(
				`${this.scene.id}-${this.a}-${this.b}-${this.mode}.png`.replace(/[^\w.-]/g, "_"),
				png,
				"image/png",
			),
		);
	}

	/* True if the key was one of the viewer's. */
	key(e) {
		const digit = /^Digit(\d)$/.exec(e.code)?.[1];
		const action = KEYS[e.key.toLowerCase()];
		if (!digit) return !!action && action(this, e) !== false;
		const m = this.methodOf(digit);
		if (m) this.show(m, e.shiftKey);
		return true;
	}
}
