/* Numbers, and their texts. */

export const TIMES = "\u2009×";
export const clamp = (v, low, high) => Math.max(low, Math.min(high, v));
/* Compares by a number, for `sort`. */
export const by = f => (a, b) => f(a) - f(b);
export const grouped = n => n.toLocaleString("en");
export const sum = list => list.reduce((x, y) => x + y, 0);
export const mean = list => Math.exp(sum(list.map(Math.log)) / list.length); // geometric

/* A number with `digits` significant digits, never in scientific notation. */
export function num(v, digits = 3) {
	if (v == null || !isFinite(v)) return "–";
	const size = Math.abs(v);
	if (size === 0) return "0";
	if (size >= 1000) return grouped(Math.round(v));
	if (size < 0.001) return "<\u20090.001";
	return v.toFixed(clamp(digits - 1 - Math.floor(Math.log10(size)), 0, 4));
}

/* A count of things. */
export const plural = (n, one) => `${grouped(n)} ${one}${n === 1 ? "" : "s"}`;
const csvCell = c => (/[",\r\n]/.test(c ?? "") ? `"${String(c).replace(/"/g, '""')}"` : (c ?? ""));

/* Comma-separated values: a line for each object, below a line with the names of their fields. */
export const csv = list =>
	[Object.keys(list[0]), ...list.map(Object.values)]
		.map(row => row.map(csvCell).join(",") + "\r\n")
		.join("");

/* Values by key. The most recently used ones are last. */
const memory = new Map();

/* Returns the value of a key, which `make` makes the first time. Forgets values that were not used for long. */
export function memo(key, make) {
	const kept = memory.get(key) ?? make();
	memory.delete(key);
	memory.set(key, kept);
	if (memory.size > 220) memory.delete(memory.keys().next().value);
	return kept;
}

/* A coordinate of a chart, to a tenth of a pixel. */
export const round = v => Math.round(v * 10) / 10;
