/* Controls: buttons of which one is chosen, lists that fold, and fades where a list scrolls on. */

/* Fades the end of a list or table that scrolls on. */
function fadeEnd(el) {
	el.classList.toggle("more-right", el.scrollLeft + el.clientWidth < el.scrollWidth - 2);
	el.classList.toggle("more-below", el.scrollTop + el.clientHeight < el.scrollHeight - 2);
}

const SCROLLED = ".scroll, .rail, .list, .choices";
const fadeEnds = () => $$(SCROLLED).forEach(fadeEnd);

addEventListener("scroll", e => e.target.matches?.(SCROLLED) && fadeEnd(e.target), true);

/* Calls `choose` with the key of the button, mark or row that is chosen. */
function onChoose(el, choose) {
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

/* The lists that the reader has unfolded. */
const unfolded = new Set();

/* Returns the first entries of a long list, and the button that shows the rest. */
function folded(list, most, what) {
	const all = unfolded.has(what) || list.length < 1.2 * most;
	return [
		all ? list : list.slice(0, most),
		!all && html`<button class="fold" data-fold="${what}">All ${list.length} ${what}</button>`,
	];
}

addEventListener("click", e => {
	const what = e.target.dataset?.fold;
	if (!what) return;
	unfolded.add(what);
	route();
});

/* Wires buttons of which one is pressed. Returns the function that marks the pressed one. */
function segments(el, pressed, choose) {
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
const slider = ({ key, label, title, min, max, step = 1, value, text }) =>
	html`
		<label class="handle" title="${title ?? label}">
			<span>${label}<b>${text}</b></span>
			<input type="range" data-handle="${key}" min="${min}" max="${max}" step="${step}" value="${value}">
		</label>`;

/* Which way the arrow keys lead, as [to the right, downward]. */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/* Scrolls a chosen entry into view. */
const reveal = el => el?.scrollIntoView({ block: "nearest", inline: "center" });
