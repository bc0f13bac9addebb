/* Findings: values that figures measured, each with a verdict on what the lecture says. */

import { FIGURES } from "./data.js";
import { html, scrolling, sentence, table } from "./markup.js";

/* The sign of each verdict on the lecture. */
const VERDICTS = { confirms: "✓", adds: "+", contradicts: "✗" };

/* Counts the findings of each verdict, without verdicts that no finding has. */
export const counts = list =>
	Object.keys(VERDICTS)
		.map(k => [k, list.filter(x => x.agreement === k).length])
		.filter(([, n]) => n);

export const chip = (verdict, label) =>
	html`<span class="chip ${verdict}">${VERDICTS[verdict]} ${label}</span>`;

/* A value with its unit, in scientific notation if far from 1. */
export function findingValue({ value, unit }) {
	const size = Math.abs(value);
	const [digits, power] = value.toExponential(1).replace(/-/g, "−").replace("+", "").split("e");
	const isFar = size && (size < 0.001 || size >= 1e6);
	const number = isFar ? html`${digits}·10<sup>${power}</sup>` : +value.toPrecision(4);
	return html`${number} ${unit}`;
}

/* A finding in one line: what was measured, and what follows from it. */
export const verdictLine = x => html`
	<p class="verdict">
		${chip(x.agreement, x.agreement)}
		<span>${sentence(x.label)}: <b>${findingValue(x)}</b>. ${x.verdict}</span>
	</p>`;

export const figureNamed = name => FIGURES.find(f => f.name === name);
export const findingOf = (name, key) => figureNamed(name)?.findings.find(x => x.key === key);

/* The short title of a figure: the part before the colon. */
export const topic = f => f.title.split(":")[0];

/* A table of findings. With `where` it has a column for the figure. */
export function findingTable(list, where) {
	const figure = f => html`
		<a href="#lectures/${f.name}">${topic(f)}</a>
		<small>${f.lecture}</small>`;
	// A figure is named only on its first row, and so is a verdict that several measurements share.
	const rows = list.map((x, i) => [
		...(where ? [x.figure !== list[i - 1]?.figure && figure(x.figure)] : []),
		x.verdict !== list[i - 1]?.verdict && x.verdict,
		x.label,
		html`<span title="${x.value}">${findingValue(x)}</span>`,
		chip(x.agreement, x.agreement),
	]);
	const heads = [where && "figure", "finding", "measured", "value", "verdict"].filter(Boolean);
	return scrolling("Findings", table(heads, rows, "findings"));
}
