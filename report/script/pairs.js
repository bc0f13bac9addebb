/* Pairs of pictures: each is opened in a viewer of its own. Starts the page of `fastphong diff`. */

import { isCommand, segments } from "./controls.js";
import { $, $$, create, html } from "./markup.js";
import { memo, num } from "./numbers.js";
import "./theme.js";
import { Viewer } from "./viewer.js";

/* A picture of the page as a canvas. */
const imageOf = (s, m) =>
	memo(`${s.id} ${m}`, async () => {
		const image = s.images[m];
		image.loading = "eager";
		await image.decode();
		const canvas = create("canvas");
		[canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
		canvas.getContext("2d").drawImage(image, 0, 0);
		return { canvas };
	});

/* A viewer of a pair, in which nothing is turned. Its map is of both pictures. */
class PairViewer extends Viewer {
	image(s, m) {
		return imageOf(s, this.mode === "error" ? "map" : m);
	}

	nameOf(m) {
		return m === "reference" ? "Reference" : "Picture";
	}

	mark() {
		return "";
	}

	get single() {
		return this.mode === "flip" || this.mode === "error";
	}
}

/* The viewer that keys are for. */
let seen = null;

/* Opens or closes a pair. */
function toggle(card, opens = !card.classList.contains("on")) {
	card.classList.toggle("on", opens);
	$(".opens", card).textContent = opens ? "Close" : "Open";
	$(".viewer", card)?.remove();
	if (seen && !seen.root.isConnected) seen = null;
	if (!opens) return;
	const root = create("div");
	root.className = "viewer";
	card.append(root);
	const { size, largest, worst } = JSON.parse(card.dataset.pair);
	const images = Object.fromEntries($$("img", card).map(i => [i.className, i]));
	const scene = {
		id: card.id,
		title: $("h2", card).textContent,
		w: size[0],
		h: size[1],
		list: ["actual"],
		rows: { actual: { max: largest, worst } },
		drawn: true,
		images,
		about: m => (m === "reference" || largest == null ? "" : `up to ${num(largest)} levels`),
	};
	const v = new PairViewer(root, { scene, a: "actual", b: "reference" });
	$(".hints", root).innerHTML = html`
		<kbd>Space</kbd> flip&nbsp; <kbd>S</kbd> slider&nbsp; <kbd>E</kbd> map&nbsp;
		<kbd>W</kbd> worst pixel&nbsp; double-click zooms`;
	$(".scale", root).outerHTML = html`
		<div class="mapkey">0<i></i>${$("#pairs").dataset.levels} levels</div>`;
	$(".missing", root).textContent = "This browser cannot show the picture.";
	seen = v;
	root.addEventListener("pointerdown", () => (seen = v));
	v.set({ scene });
}

$$(".opens").forEach(button => {
	const card = button.closest(".pairing");
	button.onclick = () => toggle(card);
	$(".shots", card).onclick = () => toggle(card);
	$(".shots", card).style.cursor = "pointer";
});

addEventListener("keydown", e => {
	/** @type {any} */
	const on = e.target;
	if (isCommand(e) || on.matches("select,input")) return;
	if (!seen || (e.key === " " && on.closest("button,a"))) return;
	if (e.key === "Escape") return toggle(seen.root.closest(".pairing"), false);
	if (seen.key(e)) e.preventDefault();
});

let filter = "all";
segments(
	$("#filter"),
	() => filter,
	key => {
		filter = key;
		$("main").dataset.filter = key;
	},
);

/* A link to a pair opens it. */
const linked = /^#pair-\d+$/.test(location.hash) && $(location.hash);
if (linked && $(".opens", linked)) toggle(linked, true);
