/* The handles of a viewer: they turn the model, move the light, and choose parameters. */

import { arrow, isCommand, slider } from "./controls.js";
import { IDS, M, SCENES } from "./data.js";
import { canTurn, LiveScene, ownScene, variantOf } from "./live.js";
import { nameOf } from "./marks.js";
import { $, atNextFrame, delay, fill, html, save, toast } from "./markup.js";
import { clamp, memo, num, plural, TIMES } from "./numbers.js";
import { CAN_DRAW } from "./studio.js";
import { isStill, STILL } from "./viewer.js";

export const DEGREES = 180 / Math.PI;

/* The light's handle is at this part of the stage's short side from the middle (SUN_RING) when the light is at this angle from the
   line of sight (SUN_ANGLE). The light goes no further than SUN_MOST. */
const SUN_RING = 0.36;
const SUN_ANGLE = 90 / DEGREES;
const SUN_MOST = 175 / DEGREES;

/* Writes a view for a link, in degrees and with few digits. `viewOf` reads it back. */
export const viewQuery = ({ azimuth, elevation, size, light, exponent, given }) => {
	const fixed = (...list) => list.map(v => +v.toFixed(1)).join(",");
	const [angle, toward] = light ? sunOf(light) : [];
	const chosen = Object.entries(given).map(([m, all]) => variantOf(m, all));
	return {
		turn: azimuth || elevation ? fixed(azimuth * DEGREES, elevation * DEGREES) : null,
		size: size === 1 ? null : +size.toFixed(2),
		sun: light && fixed(angle * DEGREES, toward * DEGREES),
		exponent: exponent || null,
		with: chosen.join(";") || null,
	};
};

export function viewOf({ turn, size, sun, exponent, with: chosen }) {
	const numbers = text => (text ?? "").split(",").map(v => (isFinite(v) ? +v : 0));
	const [azimuth, elevation = 0] = numbers(turn).map(v => v / DEGREES);
	const [angle, toward = 0] = numbers(sun).map(v => v / DEGREES);
	const given = {};
	for (const variant of (chosen ?? "").split(";").filter(Boolean)) {
		const [m, ...all] = variant.split(":");
		const pairs = all.map(p => p.split("=")).filter(p => p.length === 2);
		if (IDS.includes(m) && pairs.length) given[m] = Object.fromEntries(pairs);
	}
	return {
		azimuth,
		elevation,
		size: clamp(+size || 1, 0.1, 20),
		light: sun ? lightAt(clamp(angle, 0, SUN_MOST), toward) : null,
		exponent: clamp(Math.round(+exponent) || 0, 0, 1000),
		given,
	};
}

/* Makes a direction from its angle from the line of sight and its angle around it. `sunOf` does the reverse. */
const lightAt = (angle, toward) => [
	Math.sin(angle) * Math.cos(toward),
	Math.sin(angle) * Math.sin(toward),
	Math.cos(angle),
];
const sunOf = ([x, y, z]) => [Math.atan2(Math.hypot(x, y), z), Math.atan2(y, x)];

/* A slider with this many steps over a logarithmic range. */
const logarithmic = (low, high, steps) => ({
	min: 0,
	max: steps,
	to: t => low * (high / low) ** (t / steps),
	from: v => Math.round((steps * Math.log(v / low)) / Math.log(high / low)),
});
const SIZES = logarithmic(0.25, 8, 120);
const EXPONENTS = logarithmic(1, 1000, 150);

export class Hand {
	/** @type {LiveScene} */
	live = null;
	moves = false;
	waits = false;
	rounds = 0;

	constructor(v) {
		this.v = v;
		this.sun = $(".sun", v.root);
		this.panel = $(".handles", v.root);
		this.panel.oninput = e => this.handle(e.target);
		this.panel.onchange = () => this.controls();
		// A slider is held until the pointer is released anywhere. A list is not, because it opens and may swallow that event.
		this.panel.onpointerdown = e => {
			this.holds = e.target.matches("input");
		};
		for (const event of ["pointerup", "pointercancel"])
			addEventListener(event, () => {
				this.holds = false;
			});
		this.panel.onclick = e => {
			if (e.target.closest(".still")) v.set({ view: STILL });
			if (e.target.closest(".file")) this.saveScene();
		};
		this.listenToSun();
		// The handler must not return false, because the browser would then ignore the key, for example Tab.
		v.stage.onkeydown = e => {
			if (e.target === v.stage) this.key(e);
		};
		v.stage.ondragover = e => e.preventDefault();
		v.stage.ondrop = e => this.drop(e);
		// The light and the handles appear when the pointer or the focus first comes near.
		const comes = () => {
			this.near = true;
			this.controls();
		};
		for (const event of ["pointerenter", "focusin"])
			v.root.addEventListener(event, comes, { once: true });
	}

	get can() {
		return canTurn(this.v.scene) && this.failed !== this.v.scene;
	}

	/* Where pictures come from: the stored scene, or the one that the page draws. */
	get source() {
		const { scene, view } = this.v;
		const isLive = this.live?.scene === scene && (scene.own || !isStill(view));
		return isLive ? this.live : scene;
	}

	/* Loads the scene. Returns false if it cannot be drawn here. */
	async ready() {
		const s = this.v.scene;
		if (this.live?.scene === s) return true;
		if (!this.can) return false;
		try {
			// Another scene may still be loading.
			if (this.loading?.scene !== s) this.loading = { scene: s, made: LiveScene.make(s) };
			const live = await this.loading.made;
			if (this.v.scene !== s) return false;
			this.live = live;
			this.controls();
			this.v.draw();
			return true;
		} catch (error) {
			if (this.v.scene === s) this.fail(error);
			return false;
		} finally {
			if (this.loading?.scene === s) this.loading = null;
		}
	}

	/* Says why the scene cannot be drawn here, and shows its stored pictures. */
	fail(error) {
		toast(`Not drawn here: ${error.message.split("\n")[0]}`);
		this.failed = this.v.scene;
		this.live = null;
		this.v.view = STILL;
		this.controls();
	}

	/* Changes the view and draws it at the next frame of the screen. Draws it exactly when nothing has moved for a while. */
	move(change) {
		this.v.view = { ...this.v.view, ...change };
		if (this.waits) return;
		this.waits = true;
		atNextFrame(async () => {
			this.waits = false;
			if (!(await this.ready())) return;
			await this.look(true);
			delay("rest", 200, () => this.rest());
		});
	}

	async look(moves) {
		this.moves = moves;
		this.rounds = 0;
		try {
			if (this.source !== this.v.scene) {
				this.live.look(this.v.view, moves, this.v.mode === "error");
				const [, elevation] = this.live.studio.turned();
				const isBeyond = Math.abs(elevation - this.v.view.elevation) > 1e-9;
				if (isBeyond) this.v.view = { ...this.v.view, elevation };
			}
			await this.v.present();
		} catch (error) {
			this.fail(error);
			await this.v.present();
		}
	}

	/* Shows the view exactly. Takes it through its link first, so that the link restores the picture to the byte. */
	async rest() {
		const { v } = this;
		v.view = this.known(viewOf(viewQuery(v.view)));
		await this.look(false);
		this.controls();
		v.change?.(v, { moved: true });
		v.probe?.(v);
		v.plot?.(v);
		delay("rounds", 60, () => {
			if (!this.moves && this.source === this.live) this.tell(this.live);
			this.round();
		});
	}

	/* Shows the first of the notes that were not shown before, and how many more there are. Without any it says `otherwise`. */
	tell(live, otherwise) {
		const [first, ...more] = live.news();
		const others = more.length ? ` (and ${plural(more.length, "thing")} more)` : "";
		if (first || otherwise) toast(first ? first + others : otherwise);
	}

	/* Returns the view without parameters that its methods do not have, since a link may ask for any. */
	known(view) {
		const isKnown = ([m, all]) =>
			Object.entries(all).every(([k, v]) => this.live?.studio.knows(`${m}:${k}=${v}`));
		return { ...view, given: Object.fromEntries(Object.entries(view.given).filter(isKnown)) };
	}

	/* Draws by all methods a few times, so that the chart shows errors and times of this view. Then the page is idle. */
	round() {
		const { live, v } = this;
		if (this.moves || this.source !== live || this.rounds >= 6 || v.root.offsetParent === null) return;
		const next = live.list.find(m => (live.count[m] ?? 0) <= this.rounds && m in M);
		if (next) {
			live.count[next] = this.rounds + 1;
			live.draw(next);
		} else {
			this.rounds++;
			v.change?.(v, { round: true });
			v.draw();
		}
		delay("rounds", 8, () => this.round());
	}

	/* Saves the scene in its current view as a file. */
	saveScene() {
		try {
			this.live.studio.frame(this.live.w, this.live.h, this.v.view);
			save(`${this.v.scene.id}.toml`, this.live.studio.scene(), "text/plain");
		} catch (error) {
			toast(error.message);
		}
	}

	/* Shows the handles: size, exponent, and the parameters of both methods. */
	controls() {
		const { v, live } = this;
		const shown = this.can && live?.scene === v.scene;
		if (this.near && this.can && !shown) this.ready();
		this.panel.hidden = !shown;
		$(".turns", v.root).hidden = !this.can || !isStill(v.view);
		v.stage.classList.toggle("turnable", this.can);
		v.stage.ariaLabel = `The pictures${this.can ? ": arrow keys turn the model" : ""}`;
		this.sun.hidden = !shown || !live.firstLight.some(Boolean);
		// A handle that is being held must not be replaced.
		if (!shown || this.holds) return;
		const { size, exponent } = v.view;
		const methods = [...new Set([v.a, v.b])].filter(m => live.list.includes(m) && !m.includes(":"));
		const parts = [
			slider({ key: "size", label: "Size", ...SIZES, value: SIZES.from(size), text: `${num(size, 2)}${TIMES}` }),
			slider({
				key: "exponent",
				label: "Exponent",
				...EXPONENTS,
				value: EXPONENTS.from(exponent || 32),
				text: exponent || "the scene’s",
			}),
			...methods.map(m => this.parametersOf(m).map(p => this.parameter(m, p))),
		];
		fill(
			this.panel,
			html`
				${parts}
				<button class="still" ${isStill(v.view) && "disabled"}>As stored</button>
				<button class="file" title="The scene in this view, for fastphong render">Scene file</button>`,
		);
		this.placeSun();
	}

	parametersOf(m) {
		return memo(`parameters ${m}`, () => this.live.studio.parameters(m));
	}

	/* The handle of a parameter. */
	parameter(m, { name, meaning, value, auto, values: { words, range, whole } }) {
		const now = this.v.view.given[m]?.[name] ?? value;
		const key = `${m}:${name}`;
		const label = `${nameOf(m)}: ${name}`;
		if (words)
			return html`
				<label class="handle" title="${meaning}"><span>${label}</span>
				<select data-handle="${key}">${words.map(
					w => html`<option ${w === now && "selected"}>${w}</option>`,
				)}</select></label>`;
		const [low, high] = range;
		const step = whole ? 1 : null;
		const least = auto ? low - (step ?? 0.01 * (high - low)) : low;
		return slider({
			key,
			label,
			title: meaning,
			min: least,
			max: Math.min(high, whole ? low + 15 : high),
			step: step ?? (high - low) / 200,
			value: now === "auto" ? least : now,
			text: now,
		});
	}

	handle(target) {
		const key = target.dataset.handle;
		const value = target.value;
		const { given } = this.v.view;
		if (key === "size") this.move({ size: SIZES.to(value) });
		else if (key === "exponent") this.move({ exponent: Math.round(EXPONENTS.to(value)) });
		else {
			const [m, name] = key.split(":");
			const p = this.parametersOf(m).find(q => q.name === name);
			const isAuto = p.auto && target.type === "range" && +value < p.values.range[0];
			const text = isAuto ? "auto" : String(value);
			const { [name]: _, ...others } = given[m] ?? {};
			const all = text === p.value ? others : { ...others, [name]: text };
			const { [m]: before, ...rest } = given;
			this.move({ given: Object.keys(all).length ? { ...rest, [m]: all } : rest });
		}
		const out = $("b", target.parentElement);
		const { size, exponent, given: now } = this.v.view;
		if (out)
			out.textContent =
				key === "size"
					? num(size, 2) + TIMES
					: key === "exponent"
						? exponent
						: (now[key.split(":")[0]]?.[key.split(":")[1]] ?? value);
	}

	/* Turns the model as a drag by this many pixels does. Arrow keys use it, too. */
	turnBy(dx, dy) {
		const { azimuth, elevation } = this.v.view;
		const k = 2.4 / Math.max(200, this.v.stage.clientHeight);
		this.move({ azimuth: azimuth - k * dx, elevation: clamp(elevation + k * dy, -Math.PI, Math.PI) });
	}

	key(e) {
		if (!this.can || isCommand(e)) return;
		const way = arrow(e, 10, 40);
		if (way) this.turnBy(...way);
	}

	get light() {
		return this.v.view.light ?? this.live?.firstLight ?? [0, 0, 1];
	}

	/* Where the light's handle belongs, on the stage or beside it. */
	sunAt() {
		const { w, h } = this.v.part();
		const [angle, toward] = sunOf(this.light);
		const r = ((angle / SUN_ANGLE) * SUN_RING) * Math.min(w, h);
		return { x: w / 2 + r * Math.cos(toward), y: h / 2 - r * Math.sin(toward), w, h };
	}

	/* Puts the light's handle where it belongs, or at the edge of the stage. If the light is behind the model, the handle is hollow. */
	placeSun() {
		const { sun } = this;
		if (sun.hidden) return;
		const [angle, toward] = sunOf(this.light);
		const { x, y, w, h } = this.sunAt();
		sun.style.left = `${clamp(x, 12, w - 12)}px`;
		sun.style.top = `${clamp(y, 12, h - 12)}px`;
		sun.classList.toggle("behind", angle > SUN_ANGLE);
		sun.ariaValueNow = Math.round(angle * DEGREES);
		sun.ariaValueText = `${Math.round(angle * DEGREES)}° from the line of sight, toward ${Math.round(toward * DEGREES)}°`;
	}

	lightTo(x, y) {
		const { w, h } = this.v.part();
		const [dx, dy] = [x - w / 2, h / 2 - y];
		const angle = ((Math.hypot(dx, dy) / Math.min(w, h)) / SUN_RING) * SUN_ANGLE;
		this.move({ light: lightAt(clamp(angle, 0, SUN_MOST), Math.atan2(dy, dx)) });
		this.placeSun();
	}

	listenToSun() {
		const { sun, v } = this;
		let held = false;
		sun.onpointerdown = e => {
			e.stopPropagation();
			held = !e.button;
			sun.setPointerCapture(e.pointerId);
		};
		sun.onpointermove = e => {
			e.stopPropagation();
			if (!held) return;
			const { x, y } = v.local(e);
			this.lightTo(x, y);
		};
		sun.onpointerup = sun.onpointercancel = e => {
			e.stopPropagation();
			held = false;
		};
		sun.ondblclick = e => {
			e.stopPropagation();
			this.move({ light: null });
			this.placeSun();
		};
		sun.onkeydown = e => {
			const way = arrow(e, 6, 24);
			if (!way) return;
			const { x, y } = this.sunAt();
			this.lightTo(x + way[0], y + way[1]);
		};
	}

	/* Shows a mesh file that the reader drops on the stage. */
	async drop(e) {
		e.preventDefault();
		const files = [...(e.dataTransfer?.files ?? [])];
		if (!files.length || !CAN_DRAW) return;
		const before = this.v.scene;
		try {
			const s = await ownScene(files, before.own ? SCENES[0] : before);
			const live = await LiveScene.make(s);
			await this.v.set({ scene: s, view: STILL, pin: null, live });
			this.tell(live, `${s.title}: ${plural(live.polygons, "polygon")}`);
		} catch (error) {
			toast(error.message.split("\n")[0]);
		}
	}
}
