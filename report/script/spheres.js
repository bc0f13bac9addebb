/* The first thing on the page: two spheres of equal triangles under one sun, which the reader moves. */

import { arrow, isCommand } from "./controls.js";
import { FIGURES } from "./data.js";
import { verdictLine } from "./findings.js";
import { $, $$, atNextFrame, delay, html } from "./markup.js";
import { num } from "./numbers.js";
import { figurePictures } from "./pictures.js";
import { CAN_DRAW, figureStudio, valuesOf } from "./studio.js";
import { DEGREES } from "./turn.js";

export const SPHERES = FIGURES.find(f => f.name === "spheres" && f.live);

/* The radius of the circle on which the sun is drawn when it shines from the side, as a part of a picture's width. */
const SUN_ORBIT = 0.455;
/* How many milliseconds the sun needs to go around once by itself. */
const SUN_ROUND = 12000;
/* How many pixels a finger moves before it drags. */
const SUN_SLOP = 8;

/* Names of the sun's directions, counterclockwise from the right. */
const SUN_SIDES = ["right", "upper right", "top", "upper left", "left", "lower left", "bottom", "lower right"];

/* A verdict with its measured value in bold. */
function withValue(text) {
	const [, before, value, after] = text.match(/^(.*?)([\d.]+ grey levels)(.*)$/) ?? [];
	return value ? html`${before}<b>${value}</b>${after}` : text;
}

/* The measurements at the highlight, in two sentences. */
const saysHighlight = ([gouraud, fast]) =>
	html`${withValue(gouraud.verdict)} Fast Phong is off by <b>${num(fast.value, 2)}</b>.`;

/* Returns a point, or the nearest point within the orbit. */
function inOrbit([x, y]) {
	const far = Math.max(1, Math.hypot(x, y));
	return [x / far, y / far];
}

class Spheres {
	/* The sun first moves by itself, unless an address places it or the reader prefers reduced motion. */
	constructor(el, query, remember, tell) {
		this.el = el;
		this.remember = remember;
		this.tell = tell;
		this.values = valuesOf(SPHERES.live, query);
		this.isHeld = !!query || matchMedia("(prefers-reduced-motion:reduce)").matches;
		el.classList.add("spheres");
		el.innerHTML = this.markup();
		this.balls = $$(".ball", el);
		this.suns = $$(".sun", el);
		this.said = $(".says", el);
		this.told = $(".unseen", el);
		this.button = $(".moves", el);
		this.show(SPHERES);
		for (const ball of this.balls) this.prepare(ball);
		if (!CAN_DRAW) return;
		this.suns[0].onkeydown = e => this.key(e);
		this.button.onclick = () => {
			this.isHeld = true;
			this.go(!this.goes);
		};
		// The sun stops when the spheres are out of sight, on another view or outside the window.
		new IntersectionObserver(entries => {
			if (!entries.at(-1).isIntersecting) this.go(false);
		}).observe(el);
		this.start();
	}

	markup() {
		const { shown } = SPHERES.blocks.find(b => b.pictures).pictures;
		const stills = figurePictures(SPHERES);
		const handle = [
			html`role="slider" tabindex="0" aria-label="Sun" aria-valuemin="0" aria-valuemax="90"`,
			html`aria-hidden="true"`,
		];
		const ball = ({ caption, alt }, i) => {
			const [name, how] = caption.split(": ");
			return html`
				<figure>
					<div class="ball">
						<img src="${stills[i]}" alt="${alt}" draggable="false">
						<canvas aria-hidden="true"></canvas>
						<svg aria-hidden="true"><path/><polygon/></svg>
						${CAN_DRAW && html`<div class="sun" ${handle[i]}></div>`}
					</div>
					<figcaption><b>${name}</b> ${how}</figcaption>
				</figure>`;
		};
		return html`
			<div class="balls" role="group" aria-label="Two spheres under one sun">${shown.map(ball)}</div>
			<div class="beside">
				<p class="says"></p>
				<p class="sub">Same triangles, normals and sun. Outlined: the triangle with the highlight.</p>
				${CAN_DRAW && html`<p class="acts"><button class="moves">Move the sun</button><span class="sub">or drag the sun</span></p>`}
				<p class="unseen" aria-live="polite"></p>
			</div>`;
	}

	/* Fits the outline to the still picture, and lets a pointer move the sun. */
	prepare(ball) {
		if (CAN_DRAW) this.listen(ball);
		const still = $("img", ball);
		const fit = () =>
			$("svg", ball).setAttribute("viewBox", `0 0 ${still.naturalWidth} ${still.naturalHeight}`);
		if (still.complete) fit();
		else still.onload = fit;
	}

	/* Makes the engine, and lets the sun go around once, unless the reader has moved it or prefers reduced motion. */
	async start() {
		try {
			this.studio = await figureStudio();
			this.draw();
			this.el.dataset.first = Math.round(performance.now());
			if (!this.isHeld) this.go(true, 1);
		} catch (error) {
			this.said.textContent = `Not drawn here: ${error.message}`;
		}
	}

	/* Draws both spheres for the current values. */
	draw() {
		const { content, pictures } = this.studio.figure(SPHERES.name, this.values);
		this.balls.forEach((ball, i) => {
			const canvas = $("canvas", ball);
			const { width, height } = pictures[i];
			if (canvas.width !== width) Object.assign(canvas, { width, height });
			canvas.getContext("2d").putImageData(pictures[i], 0, 0);
		});
		this.show(content);
		this.tell?.(content, this.values);
		this.el.dataset.shown = this.values.join(" ");
	}

	/* Shows the sentence, the triangle and the sun. */
	show(content) {
		const [first, ...others] = content.blocks.find(b => b.pictures).pictures.outlines;
		const mesh = [first, ...others].map(corners => `M${corners.join("L")}Z`).join("");
		this.said.innerHTML = saysHighlight(content.findings);
		for (const ball of this.balls) {
			$("path", ball).setAttribute("d", mesh);
			$("polygon", ball).setAttribute("points", first.join(" "));
		}
		const [x, y] = inOrbit(this.values);
		for (const sun of this.suns) {
			sun.style.left = `${50 + 100 * SUN_ORBIT * x}%`;
			sun.style.top = `${50 - 100 * SUN_ORBIT * y}%`;
		}
		if (!CAN_DRAW) return;
		const [aside, toward] = [Math.asin(Math.min(1, Math.hypot(x, y))), Math.atan2(y, x)];
		this.suns[0].ariaValueNow = Math.round(aside * DEGREES);
		this.suns[0].ariaValueText = `${Math.round(aside * DEGREES)}° from the line of sight, toward the ${SUN_SIDES.at(Math.round(toward / (Math.PI / 4)))}`;
	}

	/* Moves the sun, at the next frame of the screen. */
	move(values) {
		this.values = inOrbit(values);
		this.isHeld = true;
		this.go(false);
		if (!this.studio || this.waits) return;
		this.waits = true;
		atNextFrame(() => {
			this.waits = false;
			this.draw();
		});
		delay("spheres", 500, () => {
			this.told.textContent = this.said.textContent;
			const query = SPHERES.live.handles.map((h, i) => [h.name, this.values[i].toFixed(3)]);
			this.remember?.(new URLSearchParams(query));
		});
	}

	/* Lets the sun go around by itself, a few times or until it is stopped. */
	go(goes, rounds = Infinity) {
		if (goes === !!this.goes || (goes && !this.studio)) return;
		this.button.textContent = goes ? "Stop" : "Move the sun";
		const turn = (this.goes = goes && {});
		if (!goes) return;
		const [x, y] = this.values;
		const r = Math.max(0.2, Math.hypot(x, y));
		const begin = performance.now();
		const step = () => {
			if (this.goes !== turn) return;
			if (!this.el.checkVisibility()) return this.go(false);
			const part = Math.min((performance.now() - begin) / SUN_ROUND, rounds);
			const angle = Math.atan2(y, x) + 2 * Math.PI * part;
			this.values = [r * Math.cos(angle), r * Math.sin(angle)];
			this.draw();
			if (part < rounds) atNextFrame(step);
			else this.go(false);
		};
		atNextFrame(step);
	}

	key(e) {
		if (isCommand(e)) return;
		const way = arrow(e, 0.03, 0.15);
		if (way) this.move([this.values[0] + way[0], this.values[1] - way[1]]);
	}

	/* A mouse drags the sun from anywhere on the ball. A finger drags it from the sun itself or by moving sideways, and moves it by a tap.
   Other movements of a finger scroll the page. */
	listen(ball) {
		let held = null;
		const to = e => {
			const box = ball.getBoundingClientRect();
			const part = [(e.clientX - box.left) / box.width, (e.clientY - box.top) / box.height];
			this.move([(part[0] - 0.5) / SUN_ORBIT, (0.5 - part[1]) / SUN_ORBIT]);
		};
		ball.onpointerdown = e => {
			if (e.button) return;
			const drags = e.pointerType === "mouse" || e.target.matches(".sun");
			held = { x: e.clientX, y: e.clientY, drags };
			ball.setPointerCapture(e.pointerId);
			if (held.drags) to(e);
		};
		ball.onpointermove = e => {
			if (!held) return;
			const [dx, dy] = [e.clientX - held.x, e.clientY - held.y].map(Math.abs);
			held.drags ||= dx > SUN_SLOP && dx > dy;
			if (held.drags) to(e);
		};
		ball.onpointerup = e => {
			if (held) to(e);
			held = null;
		};
		ball.onpointercancel = () => {
			held = null;
		};
	}
}

/* Puts the spheres into an element, with the lecture's claim and all findings. */
export function spheresWithVerdicts(el, query, remember) {
	el.classList.add("live-figure");
	el.innerHTML = html`
		<p class="claim">${SPHERES.live.claim}</p>
		<div></div>
		<div class="verdicts"></div>`;
	new Spheres(el.children[1], query, remember, ({ findings }, values) => {
		$(".verdicts", el).innerHTML = html`${findings.map(verdictLine)}`;
		el.dataset.shown = values.join(" ");
	});
	return true;
}

/* Fills the places of a view that are meant for the spheres. */
export function placeSpheres(view) {
	for (const el of SPHERES ? $$("[data-spheres]:empty", view) : []) new Spheres(el);
}
