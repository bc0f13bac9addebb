/* Compares documents of several machines or commits side by side. */

import { D, DOCS, isTooBusy, leftOut, meanRatio, ratioText } from "./data.js";
import { named } from "./marks.js";
import { $, html, table, write } from "./markup.js";
import { mean, num } from "./numbers.js";

/* Draws the table of all documents: a column for each, headed by its processor. */
export function beside() {
	const names = [...new Set(DOCS.flatMap(d => d.comparisons.map(c => c.name)))];
	const pick = $("#beside-scene");
	const sceneOf = (d, name) => d.comparisons.find(c => c.name === name);
	if (!pick.options.length)
		pick.innerHTML = html`${[...(names.length > 1 ? [""] : []), ...names].map(
			n => html`<option value="${n}">${n || "all scenes they share"}</option>`,
		)}`;
	pick.onchange = beside;
	const shared = pick.value ? [pick.value] : names.filter(n => DOCS.every(d => sceneOf(d, n)));
	// Times are means over the same scenes on all machines, except those that tell no time at all.
	const isTold = d => n => !isTooBusy(sceneOf(d, n));
	const told = shared.filter(n => DOCS.every(d => isTold(d)(n) || !shared.some(isTold(d))));
	write({ "beside-left": leftOut(shared.length - told.length, "scene") });
	// Documents of the first schema took the polygons of the span engine as the truth for the row engine's errors.
	const isFirst = d => d.schema.endsWith("/1");
	const sameErrors = rows =>
		DOCS.every(d => isFirst(d) === isFirst(D)) || !rows.some(r => r.engine === "row");
	const cell = (d, m) => {
		const rowIn = n => sceneOf(d, n)?.rows.find(r => r.variant === m);
		const rows = shared.map(rowIn);
		if (!rows.length || !rows.every(Boolean)) return "–";
		const worst = sameErrors(rows) ? num(Math.max(...rows.map(r => r.error.max * 255))) : "–";
		const speeds = told.map(n => isTold(d)(n) && rowIn(n).speed);
		if (!speeds.length || !speeds.every(s => s && s.ratio_to_naive)) return `– · ${worst} levels`;
		const ms = mean(speeds.map(s => s.timing.typical_ns / 1e6));
		const ratio = meanRatio(speeds.map(s => s.ratio_to_naive));
		return `${num(ms)} ms · ${ratioText(ratio)} · ${worst} levels`;
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
