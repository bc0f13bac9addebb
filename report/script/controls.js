/* Controls: buttons of which one is chosen, and lists that fold. */

import { $$, html } from "./markup.js";

/* Calls `choose` with the key of the button, mark or row that is chosen. */
export function onChoose(el, choose) {
	el.onclick = e => {
		const chosen = e.target.closest("[data-key]");
		if (chosen) choose(chosen.dataset.key, e);
	};
	el.onkeydown = e => {
		if (!e.target.matches("g") || (e.key !== "Enter" && e.key !== " ")) return;
		e.preventDefault();
		choose(e.target.dataset.key, e);
	};
}

/* Asks for the view to be drawn again. `link.js`, which knows the views, listens. */
export const redraw = () => dispatchEvent(new Event("redraw"));

/* The lists that the reader has unfolded. */
export const unfolded = new Set();

/* Returns the first entries of a long list, and the button that shows the rest. */
export function folded(list, most, what) {
	const all = unfolded.has(what) || list.length < 1.2 * most;
	return [
		all ? list : list.slice(0, most),
		!all && html`<button class="fold" data-fold="${what}">All ${list.length} ${what}</button>`,
	];
}

addEventListener("click", e => {
	/** @type {any} */
	const on = e.target;
	const what = on.dataset?.fold;
	if (!what) return;
	unfolded.add(what);
	redraw();
});

/* Wires buttons of which one is pressed. Returns the function that marks the pressed one. */
export function segments(el, pressed, choose) {
	const update = () =>
		$$("button", el).forEach(b => {
			b.ariaPressed = b.dataset.key === pressed();
		});
	onChoose(el, key => {
		choose(key);
		update();
	});
	update();
	return update;
}

/* A slider with its name and its value as text. Listeners know it by its `key`. */
export const slider = ({ key, label, title = label, min, max, step = 1, value, text }) =>
	html`
		<label class="handle" title="${title}">
			<span>${label}<b>${text}</b></span>
			<input type="range" data-handle="${key}" min="${min}" max="${max}" step="${step}" value="${value}">
		</label>`;

/* True if a key is part of a command to the browser. */
export const isCommand = e => e.ctrlKey || e.metaKey || e.altKey;

/* Which way the arrow keys lead, as [to the right, downward]. */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/* Takes an arrow key: returns its way times `near`, or `far` with shift. Leaves other keys alone. */
export function arrow(e, near, far) {
	const way = ARROWS[e.key];
	if (!way) return null;
	e.preventDefault();
	e.stopPropagation();
	return way.map(v => v * (e.shiftKey ? far : near));
}

/* Scrolls a chosen entry into view. */
export const reveal = el => el?.scrollIntoView({ block: "nearest", inline: "center" });
