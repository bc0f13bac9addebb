/* Goals of the course: the reader moves a figure's handles until something fails. The figure's findings decide when. */

import { shownValue } from "./figure.js";
import { chip, figureNamed, findingOf } from "./findings.js";
import { $, html } from "./markup.js";
import { num } from "./numbers.js";
import { CAN_DRAW } from "./studio.js";

/* Reads a goal: `FIGURE RULE KEY [HANDLE] [times N UNIT]`. */
function goalOf(text) {
	const [figure, rule, key, ...rest] = text.split(" ");
	const at = rest.indexOf("times");
	const [factor, ...unit] = at < 0 ? [1] : rest.slice(at + 1);
	return { figure, rule, key, handle: rest[0], factor: +factor, unit: unit.join(" ") };
}

/* The rules. Each gets what was measured at the handles' values, and returns whether the goal is reached, and a sentence about it. */
const RULES = {
	/* The goal is the smallest value of a handle at which the finding contradicts the lecture. One step below, it must not contradict. */
	first: ({ found, said, handle, value, tried }) => {
		const fails = found.agreement === "contradicts";
		tried.set(value, fails);
		const low = fails ? +(value - handle.step).toFixed(4) : value;
		const high = +(low + handle.step).toFixed(4);
		const [below, here, above] = [low, value, high].map(v => shownValue(v, handle));
		if (tried.get(low) === false && tried.get(high))
			return [true, html`It shows at ${above}, and at ${below} it does not. Here: <b>${said}</b>.`];
		if (!fails) return [false, html`Not yet at ${here}: <b>${said}</b>.`];
		return [false, html`It shows at ${here}: <b>${said}</b>. Does it at a smaller one, too?`];
	},
	/* The goal is to reach the stored finding's value. */
	most: ({ found, said, stored }) =>
		found.value > 0.9999 * stored.value
			? [true, html`<b>${said}</b>. More is not possible.`]
			: [false, html`Not yet: <b>${said}</b>.`],
};

/* Follows the handles of a figure until its goal is reached. If the figure has no handles here, the goal is hidden and what it teaches stays visible. */
export function goalInto(el) {
	const goal = goalOf(el.dataset.toy);
	const f = figureNamed(goal.figure);
	const stored = findingOf(goal.figure, goal.key);
	if (!CAN_DRAW || !f?.live || !stored) {
		el.hidden = true;
		return;
	}
	const { handles } = f.live;
	const chosen = handles.findIndex(h => h.name === goal.handle);
	const learnt = el.nextElementSibling?.matches(".learnt") ? el.nextElementSibling : null;
	const tried = new Map();
	if (learnt) learnt.hidden = true;
	el.classList.add("on");
	el.insertAdjacentHTML("beforeend", html`<p class="state" role="status">Move the handles above.</p>`);
	const state = $(".state", el);
	const place = $(`.live[data-figure="${goal.figure}"]`, el.closest("article"));
	place.addEventListener("drawn", ({ detail: { content, values } }) => {
		if (el.dataset.done != null) return;
		const found = content.findings.find(x => x.key === goal.key);
		if (!found) {
			state.textContent = "The other handles have been moved: put them back.";
			return;
		}
		const { value, unit } = found;
		const said = `${num(value * goal.factor)} ${goal.unit || unit}`;
		const moved = { handle: handles[chosen], value: values[chosen] };
		const [isDone, text] = RULES[goal.rule]({ found, said, ...moved, tried, stored });
		state.innerHTML = html`${chip(isDone ? "confirms" : "adds", isDone ? "done" : "goal")} ${text}`;
		if (!isDone) return;
		el.dataset.done = "";
		if (learnt) learnt.hidden = false;
	});
}
