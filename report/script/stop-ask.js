/* The questions of the figure: the reader predicts, then looks. The answers come from the trace. */

import { $, focusOn, html } from "./markup.js";
import { fixed, listed, plus, polygonHue } from "./stop-words.js";
import { formulaOf } from "./terms.js";
import { letterOf } from "./traces.js";

const verdictOf = ({ ok, shown }, why) => html`
	<div class="s-verdict">
		${!shown && html`<b class="${ok ? "good" : "bad"}">${ok ? "✓ Right." : "✗ Not quite."}</b> `}${why}
	</div>
	<p><button class="s-primary" data-do="on">Go on</button></p>`;

const askButtons = isOff => html`
	<p>
		<button class="s-primary" data-do="check" ${isOff && html`disabled`}>Check</button>
		<button data-do="show">Just show me</button>
	</p>`;

const EDGES_QUESTION = {
	prepare(e, mine, figure) {
		const sort = figure.events.find(v => v.k === "sort" && v.row === e.target.row);
		mine.right = new Set(sort?.active.map(a => a.edge.id));
		mine.set ??= new Set(e.active.map(a => a.edge.id));
		mine.bad = figure.edges.filter(d => mine.right.has(d.id) !== mine.set.has(d.id));
		mine.ok = !mine.bad.length;
	},
	choose(mine, id) {
		if (!mine.set.delete(+id)) mine.set.add(+id);
	},
	mark({ done, shown, right, set }, id) {
		if (!done) return "";
		if (shown || right.has(id) === set.has(id)) return right.has(id) ? "s-right" : "";
		return right.has(id) ? "s-missed" : "s-wrong";
	},
	markup(e, mine, { edges }) {
		const row = e.target.row;
		const choices = edges.map(
			d => html`
				<button class="s-choice ${this.mark(mine, d.id)}" style="--c:${polygonHue(d.polygon)}" data-choice="${d.id}"
					aria-pressed="${(mine.shown ? mine.right : mine.set).has(d.id)}" ${mine.done && html`disabled`}>${d.name}</button>`,
		);
		const names = edges.filter(d => mine.right.has(d.id)).map(d => d.name);
		const isOne = d =>
			mine.right.has(d.id)
				? `is active: from line ${d.first} up to line ${d.end - 1}`
				: `is not: it covers lines ${d.first} to ${d.end - 1}`;
		const why =
			mine.ok || mine.shown
				? `An edge is active while the centre of the line, ${row}.5, is between its ends: ${listed(names)}.`
				: html`<ul>${mine.bad.map(d => html`<li>${d.name} ${isOne(d)}.</li>`)}</ul>`;
		return html`
			<p>The edges of line ${e.row} are chosen already. Remove those that end, and add those that begin: the edge table shows where.</p>
			<p>${choices}</p>
			${mine.done ? verdictOf(mine, why) : askButtons()}`;
	},
};

const SHARED_QUESTION = {
	prepare(e, mine) {
		mine.right = e.meet.owners.map(o => o.polygon);
		mine.pair = [e.meet.a, e.meet.b].map(a => a.edge.polygon);
		mine.own ??= mine.right.map(() => null);
		if (mine.shown) mine.own = mine.right;
		mine.ok = mine.own.every((p, i) => p === mine.right[i]);
	},
	choose(mine, i) {
		const [first, second] = mine.pair;
		mine.own[i] = mine.own[i] === first ? second : first;
	},
	markup(e, mine) {
		const { a, owners } = e.meet;
		const [first, second] = mine.pair.map(letterOf);
		const choices = owners.map(({ x }, i) => {
			const owner = mine.own[i];
			const hue = owner == null ? "var(--ink3)" : polygonHue(owner);
			const mark = mine.done && (owner === mine.right[i] ? "s-right" : "s-wrong");
			return html`
				<button class="s-choice ${mark}" data-choice="${i}" style="--c:${hue}" aria-label="Pixel ${x}: ${owner == null ? "no owner yet" : letterOf(owner)}"
					${mine.done && html`disabled`}>${owner == null ? "?" : letterOf(owner)}<small>${x}</small></button>`;
		});
		const why =
			a.rest[0] === 0
				? `The centre of pixel ${a.pixel} lies exactly on the edge. A centre on an edge belongs to the polygon at its right: one owner, no gap, no pixel drawn twice.`
				: `What counts is the centre: from pixel ${a.pixel} on, centres lie right of the crossing.`;
		const given = !mine.ok && !mine.shown && `They belong to ${mine.right.map(letterOf).join(" ")}. `;
		return html`
			<p>${first} and ${second} share the edge that crosses line ${e.row} at x = ${fixed(a.x, 2)}. Tap each pixel until it shows its owner.</p>
			<p>${choices}</p>
			${mine.done ? verdictOf(mine, html`${given}${why}`) : askButtons(mine.own.includes(null))}`;
	},
};

const NEXT_QUESTION = {
	prepare(e, mine) {
		const { p, run } = e.target;
		mine.value ??= Math.round(run.list[p.i - 1].values[0] * 200) / 200;
		mine.ok = Math.abs(mine.value - p.values[0]) < 0.0101;
	},
	name: ({ names, method }) => (method === "gouraud" ? "I" : names.pixel[0]),
	markup(e, mine, figure) {
		const { p, run } = e.target;
		const name = this.name(figure);
		const before = run.list.slice(Math.max(0, p.i - 3), p.i).map(v => fixed(v.values[0]));
		const growth = run.by?.[0];
		const isStepped = growth != null && !run.is_ends;
		const why = html`
			It is <b>${fixed(p.values[0], 4)}</b>${!mine.shown && `, you said ${fixed(mine.value)}`}.
			${isStepped ? ` All steps are equal: ${plus(growth, 4)}. Add it to the last value, and there you are.` : " On a circle the steps are nearly equal, but not quite."}`;
		return html`
			<p>The last pixels of this run had ${formulaOf(name)} = ${before.join(", ")}. What does pixel ${p.x} have?</p>
			<p class="s-slide">
				<input type="range" min="${p.values[0] < 0 || mine.value < 0 ? -1 : 0}" max="1" step="0.005" value="${mine.value}"
					aria-label="Your prediction" ${mine.done && html`disabled`}>
				<output>${fixed(mine.value)}</output>
			</p>
			${mine.done ? verdictOf(mine, why) : askButtons()}`;
	},
};

export const QUESTIONS = { edges: EDGES_QUESTION, shared: SHARED_QUESTION, next: NEXT_QUESTION };

/* Makes the buttons of a question work. */
export function wireAsk(box, figure) {
	const redraw = () => figure.draw();
	box.onclick = ({ target }) => {
		const button = target.closest("button");
		const e = figure.now;
		if (!button || e.k !== "ask") return;
		const mine = figure.answers[e.ask];
		const { choice, do: act } = button.dataset;
		if (act === "on") {
			figure.go(e.i + 1);
			return focusOn(figure.panel.drives.forth);
		}
		if (choice) QUESTIONS[e.ask].choose(mine, choice);
		else Object.assign(mine, { done: true, shown: act === "show" });
		redraw();
		focusOn($(choice ? `[data-choice="${choice}"]` : "[data-do=on]", box));
	};
	box.oninput = ({ target }) => {
		const mine = figure.answers.next;
		mine.value = +target.value;
		$("output", box).textContent = fixed(mine.value);
		figure.strip.draw(figure.now);
	};
}
