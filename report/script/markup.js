/* HTML and SVG from templates, and what is done with elements everywhere. */

export const ROOT = document.documentElement;

/* Finds an element, or all elements, by a selector. */
/** @type {(selector: string, root?: ParentNode) => any} */
export const $ = (selector, root = document) => root.querySelector(selector);
/** @type {(selector: string, root?: ParentNode) => any[]} */
export const $$ = (selector, root = document) => [...root.querySelectorAll(selector)];

export const create = tag => document.createElement(tag);
const ENTITIES = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&#39;" };

/* Text that is HTML or SVG already. */
export class Markup extends String {}

/* Writes a value as markup. Null, undefined and `false` are left out. */
export function put(v) {
	if (v instanceof Markup) return v;
	if (Array.isArray(v)) return v.map(put).join("");
	if (v == null || v === false) return "";
	return String(v).replace(/[&<>"']/g, c => ENTITIES[c]);
}

/* Capitalises a text like a sentence. Names with capitals or signs stay unchanged. */
export const sentence = text => text.replace(/^[a-z](?![a-z]*-)/, letter => letter.toUpperCase());

/* Drops line breaks with their indentation. A line break before a word, for example an attribute, becomes a space. */
const joinLines = text => text.replace(/\n\s*(\w?)/g, (_, letter) => letter && " " + letter);

/* Tags a template of HTML or SVG: escapes values that are no markup, and joins lists. */
export function html(texts, ...values) {
	const [first, ...rest] = texts.map(joinLines);
	return new Markup(rest.reduce((all, text, i) => all + put(values[i]) + text, first));
}

/* Fades the end of a list or table that scrolls on. */
function fadeEnd(el) {
	el.classList.toggle("more-right", el.scrollLeft + el.clientWidth < el.scrollWidth - 2);
	el.classList.toggle("more-below", el.scrollTop + el.clientHeight < el.scrollHeight - 2);
}

const SCROLLED = ".scroll, .rail, .list, .choices";
export const fadeEnds = () => $$(SCROLLED).forEach(fadeEnd);

/** @param {any} e */
const scrolled = ({ target }) => target.matches?.(SCROLLED) && fadeEnd(target);
addEventListener("scroll", scrolled, true);

/* Moves the focus to an element, if there is one. The page does not scroll to it. */
export const focusOn = el => el?.focus({ preventScroll: true });

/* Puts markup into an element, and returns the focus to the control that had it. */
export function fill(el, markup) {
	/** @type {any} */
	const on = document.activeElement;
	const { key, handle } = el.contains(on) ? on.dataset : {};
	el.innerHTML = markup;
	const name = key != null ? "key" : "handle";
	const value = CSS.escape(key ?? handle ?? "");
	if (value) focusOn($(`[data-${name}="${value}"]`, el));
	delay("fade", 30, fadeEnds);
}

/* Shows an image in a canvas, which gets its size. */
export function paint(canvas, image) {
	const { width, height } = image;
	Object.assign(canvas, { width, height });
	canvas.getContext("2d").putImageData(image, 0, 0);
	return canvas;
}

/* Writes texts into elements, by their ids. */
export function write(texts) {
	for (const id in texts) $("#" + id).textContent = texts[id];
}

/* A table: heads, and rows whose first cell names the row. */
export function table(heads, rows, kind = "") {
	const head = heads.map(h => html`<th scope="col">${h}</th>`);
	const body = rows.map(
		([name, ...cells]) =>
			html`<tr><th scope="row">${name}</th>${cells.map(c => html`<td>${c}</td>`)}</tr>`,
	);
	return html`
		<table class="data ${kind}">
			<thead><tr>${head}</tr></thead>
			<tbody>${body}</tbody>
		</table>`;
}

/* A part that scrolls separately from the page, also by keys. */
export const scrolling = (label, body) =>
	html`<div class="scroll" tabindex="0" role="region" aria-label="${label}">${body}</div>`;

/* A number with a bar beside it. */
export const bar = (value, percent, colour) =>
	html`
		<span class="bar">
			<span>${value}</span>
			<i><b style="width:${percent}%;background:${colour}"></b></i>
		</span>`;

export const timers = {};

/* Does something after a while. A second call with this name before then replaces the first. */
export function delay(what, ms, action) {
	clearTimeout(timers[what]);
	timers[what] = setTimeout(action, ms);
}

/* Does something at the next frame of the screen, or after 100 ms if none comes, as in a hidden window. */
export function atNextFrame(action) {
	let isDone = false;
	const once = () => {
		if (!isDone) action();
		isDone = true;
	};
	requestAnimationFrame(once);
	setTimeout(once, 100);
}

/* Shows a message for a moment. */
export function toast(text) {
	write({ toast: text });
	$("#toast").classList.add("on");
	delay("toast", 1800, () => $("#toast").classList.remove("on"));
}

/* Has the browser save a file. */
export function save(name, content, type) {
	const a = create("a");
	a.download = name;
	a.href = URL.createObjectURL(new Blob([content], { type }));
	a.click();
	setTimeout(() => URL.revokeObjectURL(a.href), 1e4);
}
