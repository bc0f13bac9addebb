/* The chart of the overview: error against time. */

import {
	axisX, axisY, curve, line, logScale, place, scale, svg, text, textWidth, widthOf, zoomOf,
} from "./charts.js";
import { BASE, IDS, isTooBusy, leftOut, M, ratioText, SCENES, trustText, UNTOLD } from "./data.js";
import { hue, MARKED, nameOf, shape } from "./marks.js";
import { $, fill, html, write } from "./markup.js";
import { clamp, num } from "./numbers.js";

/* Draws the error of every method against its time, and a line through the methods that no other beats in both. It covers all scenes if
   `basis` is "all", else only the viewer's. */
export function pareto(v, basis) {
	const el = $("#pareto");
	const s = v.source;
	const isLive = s !== v.scene;
	const all = basis === "all" && !v.scene.own;
	const untold = all ? UNTOLD : +(!isLive && isTooBusy(s));
	write({
		"pareto-sub": all
			? `Worst error in ${SCENES.length} scenes, mean time. ${leftOut(untold, "scene")}`
			: `${s.title}, ${s.w} × ${s.h}${isLive ? ", as turned here, on one thread of this browser" : ""}. ` +
				(untold ? trustText(s) : ""),
	});
	const W = widthOf(el);
	const H = Math.max(340, el.clientHeight / zoomOf());
	const l = 46;
	const r = W - 14;
	const t = 24;
	const b = H - 48;
	if (!W) return;
	const has = m => (all ? M[m].max != null : s.rows[m] && !(isLive && !s.rows[m].ms));
	/** @type {any[]} */
	const points = IDS.filter(has).map(m => {
		if (!all) {
			const q = s.rows[m];
			return { m, error: q.max, time: q.ms, ratio: q.ratio, low: q.msLow, high: q.msHigh };
		}
		const { max, speed: ratio } = M[m];
		const [time, low, high] = ["typical", "high", "low"].map(k => ratio && 1 / ratio[k]);
		return { m, error: max, time, ratio, low, high };
	});
	if (!points.length) return;
	const timed = points.every(p => p.time);
	if (!timed)
		points.forEach((p, i) => {
			p.time = i + 1;
		});
	const x = logScale(points.flatMap(p => [p.time, p.low, p.high]).filter(Boolean), 1.2, l, r);
	const y = scale(
		true,
		clamp(Math.min(...points.map(p => p.error / 2.2)), 0.0005, 0.3),
		Math.max(2, ...points.map(p => p.error * 4)),
		b,
		t,
	);
	for (const p of points) [p.x, p.y] = [x(p.time), y(Math.max(p.error, y.low * 1.1))];
	const one = clamp(y(1), t, b);
	const base = points.find(p => p.m === BASE);
	const shown = [];
	shown.push(
		html`<rect x="${l}" y="${one}" width="${r - l}" height="${b - one}" class="same"/>`,
		axisY(
			y,
			l,
			r,
			y.ticks(60).filter(e => Math.log10(e) % 1 === 0),
		),
		timed && axisX(x, b, x.ticks(40)),
	);
	shown.push(
		text(
			(l + r) / 2,
			H - 8,
			timed
				? "← faster   ·   " + (all ? "time as a multiple of naive Phong’s" : "ms a frame")
				: untold
					? "the machine was too busy to tell times"
					: "no times were taken",
			"axis mid",
		),
		text(
			l - 38,
			t - 9,
			`${all ? "worst error in any scene" : "max error"}, grey levels`,
			"axis",
		),
	);
	if (base && timed) shown.push(line(base.x, t, base.x, b, "dots"));
	// The line steps down at each method that is more exact than all faster ones.
	const steps = [];
	if (timed)
		for (const p of [...points].sort((p, q) => p.time - q.time || p.error - q.error)) {
			const last = steps[steps.length - 1];
			if (last && p.y <= last[1]) continue;
			steps.push([p.x, last?.[1] ?? t], [p.x, p.y]);
			p.front = true;
		}
	if (timed) {
		steps.push([r, steps[steps.length - 1][1]]);
		shown.push(curve(steps, "front"));
	}
	const same = "below one grey level: the same picture";
	const taken = [l, one + 3, l + textWidth(same), one + 20];
	if (b - one > 24) shown.push(text(l + 8, one + 16, same, "tick halo washed"));
	for (const p of points) {
		[p.left, p.right] = [p.m === v.a, p.m === v.b];
		p.value = p.ratio && (p.left || p.right || p.front) ? ratioText(p.ratio) : "";
		p.priority = 3 * p.left + 2 * p.right + +!!p.front + +MARKED.has(p.m);
		p.w = textWidth(`${nameOf(p.m)}  ${p.value}`, p.left) + 6;
	}
	place(
		points,
		[l + 2, t, r, b - 1],
		[
			taken,
			...steps
				.slice(1)
				.map(([px, py], i) => [steps[i][0] - 2, steps[i][1] - 2, px + 2, py + 2]),
		],
	);
	for (const p of points) {
		const time = timed && `, ${num(p.time)} ${all ? "of naive Phong’s time" : "ms"}`;
		const value = html`<tspan dx="4" class="value">${p.value}</tspan>`;
		const kind = `label halo ${p.left ? "bold" : ""}`;
		const ring = p.left || p.right ? "on" : "";
		shown.push(html`
			<g class="hit" tabindex="0" role="button" data-key="${p.m}"
				aria-pressed="${p.left}" style="color:${hue(p.m)}">
				<title>${nameOf(p.m)}: error ${num(p.error)} levels${time}</title>
				${p.label?.end && line(p.x, p.y, ...p.label.end, "leader")}
				${p.low && line(x(p.low), p.y, x(p.high), p.y, "whisker")}
				<circle class="ring ${ring}" cx="${p.x}" cy="${p.y}" r="10.5"/>
				${shape(p.m, p.x, p.y, 5.8)}
				${p.label && text(p.label.x + 2, p.label.y + 4.3, [nameOf(p.m), value], kind)}
			</g>`);
	}
	fill(el, svg(W, H, "Error against time of every method", shown, true));
}
