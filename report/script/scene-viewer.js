/* The viewer of the report's scenes, which are stored, or drawn in the page. */

import { IDS, S } from "./data.js";
import { errorMap, heat, STOPS } from "./errors.js";
import { keyOf, mark, nameOf } from "./marks.js";
import { $, html } from "./markup.js";
import { picture, thumbs } from "./pictures.js";
import { Hand } from "./turn.js";
import { Viewer } from "./viewer.js";

export class SceneViewer extends Viewer {
	constructor(root, options) {
		super(root, options);
		if (!this.choices) return;
		$(".choices", root).innerHTML = html`${this.choices.map(
			s => html`
				<button data-key="${s.id}" title="${s.title}">
					<canvas aria-hidden="true"></canvas>
				</button>`,
		)}`;
		setTimeout(() => thumbs($(".choices", root)), 300);
	}

	/* What turns the model and moves the light. */
	handOf() {
		return new Hand(this);
	}

	/* The picture of a method, or its error map. */
	image(s, m) {
		return this.mode === "error" ? errorMap(s, m, this.top) : picture(s, m);
	}

	nameOf(m) {
		return nameOf(m);
	}

	mark(m) {
		return mark(m);
	}

	/* The method whose key is a digit. */
	methodOf(digit) {
		return ["reference", ...IDS].find(m => keyOf(m) === digit);
	}

	/* Shows the scene of a button. */
	choose(id) {
		this.set({ scene: S[id], pin: null });
	}

	drawScale() {
		const bar = $(".heat", this.root);
		const ticks = this.top ? [0, this.top / 2, this.top] : [0, 1, 3, 10, 30, 100, 255];
		bar.style.background = `linear-gradient(90deg, ${STOPS})`;
		bar.innerHTML = html`${ticks.map(
			t => html`<span style="left:${heat(t, this.top) * 100}%">${t}</span>`,
		)}`;
	}
}
