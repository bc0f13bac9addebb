/* The table of all methods on a scene. */

import { line, scale } from "./charts.js";
import { folded } from "./controls.js";
import { IDS, ratioText, TIMED, trustText } from "./data.js";
import { hue, named, shape } from "./marks.js";
import { $, $$, bar, fill, html, save, table, toast, write } from "./markup.js";
import { by, clamp, grouped, num } from "./numbers.js";

/* How the table is sorted, and which optional parts it shows. */
let sort = { key: TIMED ? "ratio" : "max", up: !TIMED };
export let options = { cols: false, bary: false };

/* The columns of the table: key, head, and a mark if the column is always shown. */
const COLUMNS = [
	["max", "max error", 1],
	["rms", "RMS", 1],
	["p99", "99 %"],
	["own", "own max"],
	["over1", "pixels > 1 level", 1],
	["other", "other polygon"],
	["clamped", "clamped pixels"],
	["psnr", "PSNR, dB"],
	["ssim", "SSIM"],
	["ms", "ms", 1],
	["ns", "ns per pixel"],
	["ratio", "speed, × naive Phong", 1],
	["barycentric", "× barycentric"],
	["work", "× naive Phong by work", 1],
];

/* Columns in which larger is better. */
const DESCENDING = ["ratio", "barycentric", "work", "psnr", "ssim"];

/* A speed as a multiple of naive Phong's: its interval on the scale `x`, and its typical value. */
function speedBar(r, m, x, width) {
	const ends = [r.low, r.high].map(v => line(x(v), 3, x(v), 15, "whisker"));
	const verdict = r.tie ? "" : r.typical > 1 ? "good" : "bad";
	const interval = `${r.low.toFixed(2)}–${r.high.toFixed(2)}`;
	return html`
		<span class="speed">
			<svg style="color:${hue(m)}" width="${width}" height="18" aria-hidden="true">
				${line(x(1), 0, x(1), 18)}
				${shape(m, x(r.typical), 9, 3.4)}
				${line(x(r.low), 9, x(r.high), 9, "whisker")}
				${ends}
			</svg>
			<span class="${verdict}" title="${interval}">${ratioText(r)}</span>
		</span>`;
}

/* Draws the table of a viewer's scene. */
export function sceneTable(v) {
	const rows = Object.values(v.scene.rows).filter(q => options.bary || !q.bary);
	// A column without values, for example of speeds that cannot be told, is left out.
	const columns = COLUMNS.filter(
		([key, , always]) => (options.cols || always) && rows.some(q => q[key] != null),
	);
	const all = [["name", "method"], ...columns];
	const { key: sorted, up } = all.some(([key]) => key === sort.key) ? sort : { key: "max", up: true };
	const value = q =>
		sorted === "name"
			? IDS.indexOf(q.variant)
			: (q[sorted]?.typical ?? q[sorted] ?? (sorted === "psnr" ? 1e9 : -1));
	rows.sort(by(q => (up ? 1 : -1) * value(q)));
	const [shown, more] = folded(rows, 15, "rows");
	const ratios = rows.map(q => q.ratio).filter(Boolean);
	const slowest = Math.max(...rows.map(q => q.ms ?? 0));
	const width = options.cols ? 104 : 170;
	const x = scale(
		true,
		Math.min(0.77, ...ratios.map(r => r.low * 0.96)),
		Math.max(1.3, ...ratios.map(r => r.high * 1.04)),
		5,
		width - 6,
	);
	const level = (e, q) =>
		bar(num(e), 100 * clamp(Math.log(e / 0.001) / Math.log(255 / 0.001), 0, 1), hue(q.variant));
	const cells = {
		max: level,
		rms: level,
		ms: (ms, q) => (ms ? bar(num(ms), (ms / slowest) * 100, hue(q.variant)) : "–"),
		own: (e, q) =>
			q.within === false
				? html`<span title="more than rounding explains">! ${num(e)}</span>`
				: num(e),
		over1: grouped,
		other: grouped,
		clamped: n => (n == null ? "–" : grouped(n)),
		barycentric: ratioText,
		work: ratioText,
		psnr: v => v?.toFixed(1) ?? "∞",
		ssim: v => v?.toFixed(4) ?? "–",
		ratio: (r, q) => (r ? speedBar(r, q.variant, x, width) : "–"),
	};
	const arrow = key => sorted === key && (up ? " ↑" : " ↓");
	const name = q => html`
		<button class="name" data-key="row ${q.variant}">
			${named(q.variant)}${q.bary && html` <small>barycentric</small>`}
		</button>`;
	write({ "scene-trust": trustText(v.scene) });
	fill(
		$("#table"),
		html`${table(
			all.map(
				([key, label]) => html`<button data-key="${key}">${label}${arrow(key)}</button>`,
			),
			shown.map(q => [name(q), ...columns.map(([key]) => (cells[key] ?? num)(q[key], q))]),
			"choose",
		)}${more}`,
	);
	$$("#table [scope=col]").forEach((th, i) => {
		th.ariaSort = all[i][0] !== sorted ? "none" : up ? "ascending" : "descending";
	});
	$$("#table tbody tr").forEach((tr, i) => {
		tr.dataset.key = "row " + shown[i].variant;
		tr.className = `${shown[i].bary ? "bary" : ""} ${shown[i].variant === v.a ? "sel" : ""}`;
	});
}

/* Sorts by a column, or shows the method of a row. */
export function chooseInTable(v, key, e) {
	if (key.startsWith("row ")) return v.show(key.slice(4), e.shiftKey);
	sort = { key, up: sort.key === key ? !sort.up : !DESCENDING.includes(key) };
	sceneTable(v);
}

/* Copies the shown table, with intervals, as Markdown. */
export async function copyMarkdown() {
	const cell = c => {
		const title = $("[title]", c)?.title;
		const words = c.textContent.replace(/[|\\`*_<]/g, "\\$&");
		return title == null ? words : `${words} (${title})`;
	};
	const lines = $$("#table tr").map(tr => `| ${[...tr.cells].map(cell).join(" | ")} |\n`);
	const [head, ...rows] = lines;
	const markdown = head + head.replace(/[^|\n]+/g, " --: ").replace("--:", "---") + rows.join("");
	try {
		await navigator.clipboard.writeText(markdown);
		toast("Table copied as Markdown");
	} catch {
		save("table.md", markdown, "text/markdown");
		toast("Saved as a file: this browser does not copy");
	}
}
