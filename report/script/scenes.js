/* View: scenes. Shows one scene at a time, with its pictures, pixels, rows and table. */

import { fromRoute, go, remember } from "./address.js";
import { onChoose, reveal } from "./controls.js";
import { levelName, S, SCENES } from "./data.js";
import { nameOf } from "./marks.js";
import { $, $$, focusOn, html, write } from "./markup.js";
import { grouped, num, plural } from "./numbers.js";
import { thumbs } from "./pictures.js";
import { probe } from "./probe.js";
import { rowPlot, showRow, toggleRow } from "./row.js";
import { chooseInTable, copyMarkdown, options, sceneTable } from "./scene-table.js";
import { SceneViewer } from "./scene-viewer.js";

/* The viewer of this view. */
export let v2;

/* Opens a scene in the viewer's current state. `stepScene` opens the next or the previous one. */
const openScene = s =>
	go(`scenes/${s.id}?left=${v2.a}&right=${v2.b}${v2.mode === "slide" ? "" : `&mode=${v2.mode}`}`);

export const stepScene = d => {
	const { number = 0 } = v2.scene;
	openScene(SCENES[(number + d + SCENES.length) % SCENES.length]);
};

/* Makes the viewer and the controls. */
function startScenes(s) {
	const rail = $("#rail");
	rail.innerHTML = html`${SCENES.map(
		s => html`
			<button role="option" data-key="${s.id}">
				<canvas aria-hidden="true"></canvas>
				<span>${s.title}</span>
			</button>`,
	)}`;
	thumbs(rail);
	onChoose(rail, id => openScene(S[id]));
	const change = (v, changed) => {
		if (!changed.moved && !changed.round) {
			sceneHead(v.scene);
			probe(v);
			sceneTable(v);
			if (!("pin" in changed)) rowPlot(v);
		}
		remember(v);
	};
	v2 = new SceneViewer($("#v2"), {
		scene: s,
		a: "gouraud",
		b: "reference",
		probe,
		row: toggleRow,
		plot: rowPlot,
		change,
	});
	for (const id in options)
		$("#" + id).onclick = e => {
			e.target.ariaPressed = options[id] = !options[id];
			sceneTable(v2);
		};
	$("#copy").onclick = copyMarkdown;
	$("#rowplot-close").onclick = () => toggleRow(v2);
	for (const id of ["#probe", "#rowplot-chart"]) onChoose($(id), (m, e) => v2.show(m, e.shiftKey));
	onChoose($("#table"), (key, e) => chooseInTable(v2, key, e));
}

/* Shows the title, the description and the facts of a scene. */
function sceneHead(s) {
	write({
		"t-scenes": s.title,
		"scene-about": (s.description || "").replace(/\s+/g, " "),
		"scene-facts": sceneFacts(s).filter(Boolean).join(" · "),
	});
	$(".tablebox").hidden = !!s.own;
}

/* #scenes/SCENE */
export function scenes([id], query) {
	const s = S[id] ?? v2?.scene ?? SCENES[0];
	const rail = $("#rail");
	if (!v2) startScenes(s);
	if (v2.scene !== s) Object.assign(v2, { pin: null, hover: null, z: 1, cx: 0.5, cy: 0.5 });
	const held = rail.contains(document.activeElement);
	for (const b of $$("button", rail)) {
		const on = b.dataset.key === s.id;
		b.ariaSelected = on;
		b.tabIndex = on ? 0 : -1;
		if (!on) continue;
		if (held) focusOn(b);
		reveal(b);
	}
	const asked = { ...fromRoute(query, v2), scene: s };
	v2.set(asked);
	if (asked.line != null) showRow(v2, asked.line);
	else if (v2.line != null && query.has("left")) showRow(v2, null);
}

/* The facts of a scene, in a few words each. */
function sceneFacts(s) {
	if (s.own) return ["drawn here", `${s.w} × ${s.h}`];
	const cut = s.triangulation;
	const clamped = s.clamping ? s.clamping.clamped / (s.clamping.covered || 1) : 0;
	const reasons = {
		culled: "facing away",
		outside: "outside the view",
		zero_area: "without area",
		no_area: "without area",
		cancelling: "whose lobes cancel",
		edge_on: "edge-on",
		unprojected: "at the plane of the eye",
	};
	const left = Object.keys(reasons)
		.filter(k => s.stats[k])
		.map(k => `${grouped(s.stats[k])} ${reasons[k]}`);
	const share = k => `${((k.polygons / s.polygons) * 100).toFixed(0)} % ${k.name}`;
	const most = Math.max(0, ...Object.values(s.rows).map(q => q.other ?? 0));
	const others = (100 * most) / s.covered_pixels;
	const byKind = Object.values(s.rows)
		.filter(q => q.kinds && s.polygons)
		.map(q => `polygons by ${nameOf(q.variant)}: ${q.kinds.map(share).join(", ")}`);
	return [
		`${plural(s.polygons, "polygon")} in view`,
		plural(s.lights, "light"),
		`${((s.covered_pixels / s.w / s.h) * 100).toFixed(0)} % covered`,
		clamped > 0.02 &&
			`light is over 1 in ${(clamped * 100).toFixed(0)} % of that: it is clamped, which hides errors`,
		others > 0.1 &&
			`up to ${num(others)} % of that show a different polygon than the reference, because depths are equal up to rounding`,
		`${s.w} × ${s.h}`,
		s.interpolation === "screen" ? "linear on the screen" : "perspective-correct",
		`${levelName(s.renderer)} code, ${plural(s.renderer.threads, "thread")}`,
		left.length && `left out: ${left.join(", ")}`,
		cut &&
			"split into triangles, the reference changes by up to " +
				`${num(cut.difference.max * 255)} levels`,
		s.not_simple &&
			`${plural(s.not_simple, "polygon")} crossing themselves: not drawn by barycentric`,
		...byKind,
	];
}
