/* View: overview. */

import { fromRoute, remember } from "./address.js";
import { line, logScale, svg, text, widthOf } from "./charts.js";
import { folded, onChoose, segments } from "./controls.js";
import { FIGURES, FINDINGS, leftOut, M, MANY, ratioText, SCENES, UNTOLD } from "./data.js";
import { counts } from "./findings.js";
import { BEST, chosen, named, nameOf, shape } from "./marks.js";
import { $, $$, delay, html, timers, write } from "./markup.js";
import { by, num, plural, TIMES } from "./numbers.js";
import { pareto } from "./pareto.js";
import { crop } from "./pictures.js";
import { SceneViewer } from "./scene-viewer.js";

/* Draws the speeds of a few methods in each scene as a strip of marks. */
function strip() {
	const el = $("#strip");
	const W = widthOf(el);
	const few = chosen(4);
	const value = (s, m) => s.rows[m]?.ratio?.typical;
	if (!W || !few.length) return;
	const timed = SCENES.filter(s => few.some(m => value(s, m))).sort(
		by(s => -(value(s, few[0]) ?? 0)),
	);
	const [rows, more] = folded(timed, 24, "scenes");
	const [most, l] = W < 520 ? [17, 132] : [31, 224];
	const t = 8;
	const high = 20.5;
	const H = t + rows.length * high + 26;
	const values = rows.flatMap(s => few.map(m => value(s, m)).filter(Boolean)).concat(1);
	const x = logScale(values, 1.06, l, W - 14);
	const shown = [];
	for (const g of x.ticks(30))
		shown.push(
			line(x(g), t - 6, x(g), H - 22, g === 1 ? "one" : "grid"),
			text(x(g), H - 7, g + (g === 1 ? TIMES : ""), "tick mid"),
		);
	rows.forEach((s, i) => {
		const y = t + (i + 0.5) * high;
		const here = few.filter(m => value(s, m));
		const at = here.map(m => x(value(s, m)));
		const speeds = here.map(m => `${nameOf(m)} ${ratioText(s.rows[m].ratio)}`);
		const title = s.title.length > most ? s.title.slice(0, most - 1) + "…" : s.title;
		shown.push(html`
			<a class="hit" href="#scenes/${s.id}">
				<title>${s.title}: ${speeds.join(", ")}</title>
				<rect x="0" y="${y - high / 2}" width="${W}" height="${high}" fill="transparent"/>
				${text(l - 14, y + 4, title, "end")}
				${line(Math.min(...at), y, Math.max(...at), y, "range")}
				${here.map((m, n) => shape(m, at[n], y, s.rows[m].max > 1 ? 2.8 : 4.6))}
			</a>`);
	});
	const label = `Speed of ${few.length} methods in ${rows.length} scenes`;
	el.innerHTML = html`
		<div class="legend">${few.map(m => html`<span>${named(m)}</span>`)}</div>
		${svg(W, H, label, shown, true)}
		${more}
		${UNTOLD > 0 && html`<p class="sub">${leftOut(UNTOLD, "scene")}</p>`}`;
}

/* Says how many findings confirm the lectures. */
function waffle() {
	write({
		"waffle-sub": `${FINDINGS.length} statements, ${plural(FIGURES.length, "figure")}.`,
		...Object.fromEntries(counts(FINDINGS)),
	});
}

/* Shows where the lecture's fast method is worst. */
function breakPair() {
	const m = "fast-phong";
	const { scene: s, worst } = M[m] ?? {};
	$("#take-break").hidden = !worst || worst.max < 1 || !s.drawn;
	if ($("#take-break").hidden) return;
	write({
		"break-title": `Where ${nameOf(m)} breaks`,
		"break-sub": `${s.title}: off by ${num(worst.max)} grey levels.`,
		"break-a": "reference",
		"break-b": nameOf(m),
	});
	$("#break-link").href = `#scenes/${s.id}?left=${m}&right=reference&mode=side`;
	$$("#break canvas").forEach((c, i) =>
		crop(c, s, ["reference", m][i], worst.worst, s.w * 0.6, s.h * 0.6),
	);
}

/* The viewer of this view. */
export let v1;

/* Which scenes the chart covers: all, or only the viewer's. */
let basis = MANY ? "all" : "scene";

/* Makes the viewer, and lets the chart choose what it shows. */
function startOverview() {
	let hasTurned = false;
	const change = (v, changed) => {
		// When the reader turns a scene for the first time, the chart switches to this scene, so that its changes are seen.
		if (changed.round && !hasTurned) {
			hasTurned = true;
			basis = "scene";
			markBasis();
		}
		if (!changed.moved) pareto(v, basis);
		remember(v);
	};
	v1 = new SceneViewer($("#v1"), {
		scene: SCENES[0],
		a: "gouraud",
		b: BEST,
		choices: MANY && SCENES.filter(s => s.drawn).slice(0, 8),
		change,
	});
	const markBasis = segments(
		$("#pareto-basis"),
		() => basis,
		key => {
			basis = key;
			pareto(v1, basis);
		},
	);
	// Hovering over a mark shows its method for a moment, and choosing it keeps it.
	const el = $("#pareto");
	onChoose(el, (m, e) => {
		if (!e.shiftKey) v1.kept = m;
		v1.show(m, e.shiftKey);
	});
	el.onpointerover = e => {
		const m = e.target.closest(".hit")?.dataset.key;
		if (!m || e.pointerType !== "mouse" || m === v1.a || m === v1.b) return;
		delay("hover", 140, () => {
			v1.kept ??= v1.a;
			v1.set({ a: m });
		});
	};
	el.onpointerleave = () => {
		clearTimeout(timers.hover);
		if (v1.kept && v1.kept !== v1.a) v1.set({ a: v1.kept });
		v1.kept = null;
	};
	setTimeout(breakPair, 350);
}

/* #overview */
export function overview(_, query) {
	if (FINDINGS.length) waffle();
	if (!SCENES.length) return;
	if (!v1) startOverview();
	v1.set(fromRoute(query, v1));
	strip();
}
