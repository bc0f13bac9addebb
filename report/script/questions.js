/* Questions of the course: the reader answers, a measured value decides, and then the chapter's measurements are shown. */

import { slider } from "./controls.js";
import { chip, findingOf, findingValue } from "./findings.js";
import { $, $$, focusOn, html, Markup } from "./markup.js";
import { clamp } from "./numbers.js";

/* Answers within this part of the slider's range count as close. */
const CLOSE = 0.12;

/* Reads a question: `FIGURE slider KEY LOW HIGH STEP UNIT`, or `FIGURE largest KEY KEY…`. */
/** @returns {any} */
function questionOf(text) {
	const [figure, kind, ...rest] = text.split(" ");
	if (kind === "largest") return { kind, all: rest.map(key => findingOf(figure, key)) };
	const [key, ...more] = rest;
	const [low, high, step] = more.map(Number);
	return { kind, all: [findingOf(figure, key)], low, high, step, unit: more.slice(3).join(" ") };
}

/* A value with the unit of a question. */
const withUnit = (value, unit) => html`${findingValue({ value, unit })}`;

/* Says how far off an answer on a slider is. */
function saysAnswer(given, { value, verdict }, { low, high, step, unit }) {
	const off = given - value;
	const [how, word] =
		Math.abs(off) <= step
			? ["confirms", "Right"]
			: Math.abs(off) <= CLOSE * (high - low)
				? ["adds", "Close"]
				: ["contradicts", "Not quite"];
	const far = html`, which is <b>${withUnit(Math.abs(off), unit)}</b> too ${off < 0 ? "low" : "high"}`;
	return html`
		${chip(how, word)} You said ${withUnit(given, unit)}${how !== "confirms" && far}.
		Measured: <b>${withUnit(value, unit)}</b>. ${verdict}`;
}

/* Says if a choice is the right one. */
const saysChoice = (i, best, all) => html`
	${chip(...(i === best ? ["confirms", "Right"] : ["contradicts", "Not quite"]))}
	Measured: <b>${withUnit(all[i].value, all[i].unit)}</b>${
		i !== best && html` for your answer, and <b>${withUnit(all[best].value, all[best].unit)}</b> for the right one`
	}. ${all[best].verdict}`;

/* The control of a question: a slider, or a button for each line of its list. */
function askControl(q, choices) {
	if (q.kind === "largest")
		return html`<div class="choice">${choices.map((text, i) => html`<button data-choice="${i}">${text}</button>`)}</div>`;
	const { low, high, step } = q;
	const value = low + step * Math.round((high - low) / step / 2);
	return html`
		<div class="guess">
			${slider({ key: "guess", label: "Your answer", min: low, max: high, step, value, text: "?" })}
			<button class="answer-it" disabled>Answer</button>
		</div>`;
}

/* Shows a chapter's measurements, and fills their places. */
function unfold(chapter, fillPlace) {
	chapter.classList.remove("folded");
	$$(".measured :is([data-figure], [data-cost])", chapter).forEach(el => fillPlace(el));
}

/* Lets the reader answer a question. The chapter's measurements stay folded until then, or until the reader asks to see them.
   `fillPlace` fills their places. */
export function askInto(el, fillPlace) {
	const q = questionOf(el.dataset.question);
	if (q.all.some(x => !x)) return;
	const chapter = el.closest("article");
	const choices = $$("li", el).map(li => li.textContent);
	const text = $("p", el);
	chapter.classList.add("folded");
	el.innerHTML = html`
		${new Markup(text.outerHTML)}
		<div role="group" aria-label="Your answer">${askControl(q, choices)}</div>
		<p class="said" role="status" tabindex="-1"></p>
		<button class="show-it">Just show me</button>`;
	const best = q.all.indexOf(q.all.reduce((a, b) => (b.value > a.value ? b : a)));
	const [said, input, send] = [$(".said", el), $("input", el), $(".answer-it", el)];
	const answer = text => {
		$(".show-it", el).hidden = true;
		unfold(chapter, fillPlace);
		if (input) {
			const part = clamp((q.all[0].value - q.low) / (q.high - q.low), 0, 1);
			input.insertAdjacentHTML("afterend", html`<i class="truth" style="--at:${part}"></i>`);
			input.disabled = send.disabled = true;
		}
		for (const b of $$("[data-choice]", el)) {
			b.classList.toggle("confirms", +b.dataset.choice === best);
			b.disabled = true;
		}
		said.innerHTML = text;
		// The button that was pressed is gone, so the focus moves to the question.
		focusOn(said);
	};
	if (input)
		input.oninput = () => {
			$("b", input.parentElement).innerHTML = withUnit(+input.value, q.unit);
			send.disabled = false;
		};
	if (send)
		send.onclick = () => answer(saysAnswer(+input.value, q.all[0], q));
	for (const b of $$("[data-choice]", el))
		b.onclick = () => {
			b.ariaPressed = "true";
			answer(saysChoice(+b.dataset.choice, best, q.all));
		};
	const { value, unit, verdict } = q.all[best];
	$(".show-it", el).onclick = () => answer(html`Measured: <b>${withUnit(value, q.unit ?? unit)}</b>. ${verdict}`);
}
