/* The panel beside the stage: what happens now, the active edges, the pixel by each method, and the program. */

import { $, $$, html } from "./markup.js";
import { plural, round } from "./numbers.js";
import { QUESTIONS, wireAsk } from "./stop-ask.js";
import { screenColour } from "./stop-stage.js";
import { showsDepth, STRIP_TERMS } from "./stop-strip.js";
import {
	answerOf, ASKED, fixed, levels, plus, polygonHue, REFERENCE, TELL, wordsOf,
} from "./stop-words.js";
import { formulaOf, term } from "./terms.js";

const variantLabel = v =>
	v
		.split(":")
		.slice(1)
		.map(p => p.split("=")[1])
		.join(", ") || "auto";

/* Puts markup into an element if it is not there already, so that unchanged parts cost nothing. */
function renew(el, markup) {
	const text = String(markup ?? "");
	if (el.written === text) return;
	el.written = text;
	el.innerHTML = text;
}

export class Panel {
	/* The parts of the page, each with the end of its class as its name. */
	answer;
	methods;
	variants;
	what;
	kicker;
	text;
	eqs;
	ask;
	active;
	four;
	track;
	where;
	say;
	legend;
	hint;
	program;

	constructor(figure, root) {
		for (const name in this) this[name] = $(`.s-${name}`, root);
		this.figure = figure;
		this.head = $("h3", this.what);
		this.count = $("h4 small", this.active.closest(".s-sec"));
		this.range = $(".s-time input", root);
		this.drives = Object.fromEntries($$(".s-go", root).map(b => [b.dataset.do, b]));
		this.speeds = $$("[data-speed]", root);
		this.lines = $$("li", this.program);
		wireAsk(this.ask, figure);
	}

	/* Lays out the parts that depend on the trace: its methods and its time line. */
	lay() {
		const { figure } = this;
		const { events, method, variant } = figure;
		const variants = figure.variantsOf(method);
		renew(this.answer, answerOf(figure));
		renew(
			this.methods,
			html`${figure.methods.map(m => html`<button data-method="${m}">${wordsOf(m).label}<i></i></button>`)}`,
		);
		this.swatches = $$("button", this.methods);
		this.variants.hidden = variants.length < 2;
		$("span", this.variants).textContent = method === "fast-phong" ? "Newton’s steps" : "";
		renew(
			$(".seg", this.variants),
			html`${variants.map(v => html`<button data-variant="${v}">${variantLabel(v)}</button>`)}`,
		);
		for (const b of this.swatches) b.ariaPressed = b.dataset.method === method;
		for (const b of $$("button", this.variants)) b.ariaPressed = b.dataset.variant === variant;
		this.layTrack(events);
		this.range.max = events.length - 1;
		renew(this.hint, this.hintText());
	}

	/* The lines on the time line, and the questions on it. */
	layTrack(events) {
		const last = events.length - 1;
		const starts = events.filter((e, i) => e.row !== events[i - 1]?.row).map(e => e.i);
		const percent = i => round((1000 * i) / last) / 10;
		this.segments = starts.map((from, i) => ({ from, end: starts[i + 1] ?? last }));
		const parts = this.segments.map(
			({ from, end }) =>
				html`<i style="left:${percent(from)}%;width:calc(${percent(end - from)}% - 2px)"></i>`,
		);
		const asks = events
			.filter(e => e.k === "ask")
			.map(
				e =>
					html`<button style="left:${percent(e.i)}%" data-go="${e.i}" data-ask="${e.ask}"></button>`,
			);
		renew(this.track, html`${parts}${asks}`);
		this.parts = $$("i", this.track);
		this.asks = $$("button", this.track);
	}

	hintText() {
		const { figure } = this;
		const keys = list => [...list].map(k => html`<kbd>${k}</kbd> `);
		const move = figure.canMove
			? figure.problem || "Drag any corner: its intensity stays."
			: "Corners cannot be dragged here without WebAssembly, so the numbers are the stored ones.";
		const asks = figure.events.filter(e => e.ask).length;
		const last = String(Math.min(9, figure.methods.length));
		return html`
			${move} ${keys("←→")}a step, ${keys("PN")}a line, ${keys(["space"])}play, ${keys("1")}to ${keys(last)}methods,
			or ${keys("T")}talk. The bar below a method’s name is this pixel
			as that method shades it. ${asks > 0 && `On the way: ${plural(asks, "question")}.`}`;
	}

	draw(e) {
		const { figure } = this;
		const told = TELL[e.k](e, figure);
		const isAsking = e.k === "ask";
		renew(this.kicker, html`${told.kicker}`);
		renew(this.head, html`${told.head}`);
		renew(this.text, html`${told.text}`);
		this.drawLegend(e);
		renew(this.eqs, told.eqs);
		this.text.hidden = isAsking;
		this.ask.hidden = !isAsking;
		this.what.classList.toggle("s-asking", isAsking);
		if (isAsking) this.drawAsk(e);
		this.lines.forEach((li, i) => {
			const current = i === told.line ? "step" : null;
			if (li.ariaCurrent !== current) li.ariaCurrent = current;
		});
		renew(this.active, this.activeTable(e));
		this.active.classList.toggle("s-wide", figure.method !== "gouraud");
		renew(this.count, html`${e.active.length ? plural(e.active.length, "edge") : ""}`);
		renew(this.four, this.byEach(e));
		this.drawDrive(e);
		if (!figure.timer) this.announce(e, told);
	}

	drawLegend(e) {
		const { method, names } = this.figure;
		const legend = STRIP_TERMS[showsDepth(e) ? "depth" : method] ?? [
			["I", "bars: I"],
			...names.pixel.slice(0, 3).map(n => [n, n]),
		];
		const entry = ([name, text]) =>
			name ? html`<button data-term="${name}">${text}</button>` : html`<span>${text}</span>`;
		renew(this.legend, html`${legend.map(entry)}`);
	}

	/* Announces the step to screen readers in one sentence, and does not repeat a sentence. */
	announce({ p, ask }, { kicker, head }) {
		const isDone = this.figure.answers[ask]?.done;
		const text = isDone
			? $(".s-verdict", this.ask).innerText
			: `${kicker}: ${head}${p ? `, and the pixel is ${fixed(p.colour[0])}` : ""}`;
		const said = /[.?]$/.test(text) ? text : `${text}.`;
		if (this.say.textContent !== said) this.say.textContent = said;
	}

	drawAsk(e) {
		const { figure } = this;
		const question = QUESTIONS[e.ask];
		const mine = (figure.answers[e.ask] ??= { done: false });
		question.prepare(e, mine, figure);
		renew(this.ask, question.markup(e, mine, figure));
	}

	/* The table of the active edges. */
	activeTable(e) {
		const { figure } = this;
		const rows = e.k === "retire" ? e.before : e.active;
		if (!rows.length)
			return html`<tr><td>${e.k === "bucket" ? "none yet: the table is being built" : "none"}</td></tr>`;
		const { values, shown, grown } = figure.words;
		const names = values.map(v => html`<th scope="col">${formulaOf(v)}</th>`);
		const span = e.span ?? e.run?.span;
		const gone = new Set(e.gone?.map(g => g.id));
		const row = (a, i) => {
			const isFresh = a === e.a || a === span?.left || a === span?.right;
			const isFirst = a.edge.polygon !== rows[i - 1]?.edge.polygon;
			const kind = [gone.has(a.edge.id) && "s-gone", isFresh && "s-fresh", isFirst && "s-first"]
				.filter(Boolean)
				.join(" ");
			return html`
				<tr class="${kind}" style="--c:${polygonHue(a.edge.polygon)}">
					<th scope="row"><span class="s-chip">${a.edge.name}</span></th>
					<td>${a.edge.first}–${a.edge.end - 1}</td><td>${fixed(a.x, 2)}</td><td>${plus(a.dx, 2)}</td>
					<td>${shown(a, figure)}</td><td>${grown(a, figure)}</td>
				</tr>`;
		};
		return html`
			<thead><tr><th scope="col">edge</th><th scope="col">lines</th><th scope="col">${term("x")}</th><th scope="col">${term("Δx")}</th>${names}</tr></thead>
			<tbody>${rows.map(row)}</tbody>`;
	}

	/* The colour of the pixel by each method, and how far it is from naive Phong's. */
	byEach(e) {
		const { figure } = this;
		const truth = e.p && figure.truth(e.row, e.p.x);
		const cards = figure.methods.map((m, i) => {
			const colour = e.p && figure.pixelBy(figure.chosen[m], e.row, e.p.x)?.colour;
			const look = colour ? `background:${screenColour(colour)}` : "visibility:hidden";
			this.swatches[i].firstElementChild.style = look;
			const off = colour && truth ? levels(colour[0], truth.colour[0]) : null;
			// Where normals are far apart, the great circle is a different path, so the difference is not an error.
			const isFar = Math.abs(off) > 0.5;
			const isOther = isFar && m === "slerp-phong";
			const text =
				off == null
					? ""
					: m === REFERENCE
						? "reference"
						: Math.abs(off) < 0.05
							? "same"
							: `${off < 0 ? "−" : "+"}${fixed(Math.abs(off), 1)}${isOther ? ", another path" : ""}`;
			return html`
				<div class="${m === figure.method && "s-on"}">
					<i style="${look}"></i><b>${colour ? fixed(colour[0]) : "–"}</b>
					<small>${wordsOf(m).label.replace(" Phong", "")}</small>
					<small class="${isFar && !isOther && "bad"}">${text}</small>
				</div>`;
		});
		return html`${cards}`;
	}

	drawDrive(e) {
		const { figure, range, drives } = this;
		const last = figure.events.length - 1;
		if (+range.value !== e.i) range.value = e.i;
		range.setAttribute(
			"aria-valuetext",
			`step ${e.i + 1} of ${last + 1}, ${e.row >= 0 ? `line ${e.row}` : "edge table"}`,
		);
		this.where.textContent = `step ${e.i + 1} of ${last + 1}`;
		renew(drives.play, figure.timer ? "❚❚ Stop" : "▶ Play");
		// Not `disabled`, because a disabled button would lose the focus.
		drives.back.ariaDisabled = drives["line-back"].ariaDisabled = e.i === 0;
		drives.forth.ariaDisabled = drives["line-forth"].ariaDisabled = e.i === last;
		this.segments.forEach(({ end }, i) => this.parts[i].classList.toggle("s-done", end <= e.i));
		for (const b of this.asks) this.drawMark(b);
		for (const b of this.speeds) b.ariaPressed = +b.dataset.speed === figure.speed;
	}

	/* Shows on the time line how a question was answered. */
	drawMark(button) {
		const { ask } = button.dataset;
		const { done, shown, ok } = this.figure.answers[ask] ?? {};
		const [sign, kind, text] = !done
			? ["?", "", "waits"]
			: shown
				? ["·", "s-seen", "was shown"]
				: ok
					? ["✓", "s-ok", "answered right"]
					: ["✗", "s-no", "answered wrong"];
		if (button.textContent === sign) return;
		button.textContent = sign;
		button.className = kind;
		button.ariaLabel = `${ASKED[ask]}: the question ${text}`;
	}
}
