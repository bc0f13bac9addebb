/* Compares documents of several machines or commits side by side. */

import { D, DOCS } from "./data.js";
import { named } from "./marks.js";
import { $, html, table } from "./markup.js";
import { mean, num, TIMES } from "./numbers.js";

/* Draws the table of all documents: a column for each, headed by its processor. */
export function beside() {
	const names = [...new Set(DOCS.flatMap(d => d.comparisons.map(c => c.name)))];
	const pick = $("#beside-scene");
	const rowsOf = (d, name) => d.comparisons.find(c => c.name === name)?.rows;
	if (!pick.options.length)
		pick.innerHTML = html`${[...(names.length > 1 ? [""] : []), ...names].map(
			n => html`<option value="${n}">${n || "all scenes they share"}</option>`,
		)}`;
	pick.onchange = beside;
	const shared = pick.value ? [pick.value] : names.filter(n => DOCS.every(d => rowsOf(d, n)));
	// Older documents took the polygons of the span engine as the truth for the row engine's errors.
	const sameErrors = rows =>
		DOCS.every(d => d.schema === D.schema) || !rows.some(r => r.engine === "row");
	const cell = (d, m) => {
		const rows = shared.map(n => rowsOf(d, n)?.find(r => r.variant === m));
		if (!rows.length || rows.some(r => !r?.speed)) return "–";
		const ms = mean(rows.map(r => r.speed.timing.median_ns / 1e6));
		const ratio = mean(rows.map(r => r.speed.ratio_to_naive?.median ?? 1));
		const worst = sameErrors(rows) ? num(Math.max(...rows.map(r => r.error.max * 255))) : "–";
		return `${num(ms)} ms · ${ratio.toFixed(2)}${TIMES} · ${worst} levels`;
	};
	const heads = DOCS.map(({ machine, date }) => {
		const facts = [machine.version, machine.commit?.slice(0, 9), date].filter(Boolean);
		return html`${machine.cpu}<br><small>${facts.join(" · ")}</small>`;
	});
	const variants = [
		...new Set(DOCS.flatMap(d => d.comparisons.flatMap(c => c.rows.map(r => r.variant)))),
	];
	$("#beside").innerHTML = table(
		["method", ...heads],
		variants.map(m => [
			html`<span class="name">${named(m)}</span>`,
			...DOCS.map(d => cell(d, m)),
		]),
	);
}
