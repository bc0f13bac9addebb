/* The strip below the stage, which shows the values that are stepped along the line, below their pixels; and the normals of a run in
   their plane. */

import { $ } from "./markup.js";
import { round, sum } from "./numbers.js";
import { Layer, screenColour } from "./stop-stage.js";
import { degreesOf, fixed, isLate, normalAt, phiOf, polygonHue } from "./stop-words.js";

const STRIP_HEIGHT = 132;

/* What the strip draws for each method: pairs of a term and its legend. */
export const STRIP_TERMS = {
	__proto__: null,
	depth: [
		["", "lines: how near"],
		["", "dots: nearest so far"],
	],
	gouraud: [
		["I", "bars and dots: I"],
		["ΔI", "step: ΔI"],
		["x", "from x₁ to x₂"],
	],
	"naive-phong": [
		["I", "bars: I"],
		["N", "dots: |N| before it is divided"],
		["d", "d brings it to 1"],
	],
	"fast-phong": [
		["I", "bars: I"],
		["D", "○ the true root √D"],
		["d", "● d by Newton, from the d at its left"],
	],
	"slerp-phong": [
		["I", "bars: I"],
		["t", "● sin tφ, ○ sin (1 − t)φ"],
		["φ", "t turns by Δt φ a pixel"],
	],
};

export const showsDepth = ({ k }) => k === "span" || k === "depth";

/* The style that gives a dot or line a polygon's colour in place of its term's. */
const hueStyle = polygon => `--t:${polygonHue(polygon)}`;

export class Strip {
	/* Layers, from back to front. */
	axis;
	bars;
	lines;
	dots;

	constructor(figure, svg) {
		this.figure = figure;
		this.svg = svg;
	}

	lay() {
		const { svg } = this;
		svg.setAttribute("viewBox", `0 0 ${this.figure.stage.width} ${STRIP_HEIGHT}`);
		svg.replaceChildren();
		for (const name of ["axis", "bars", "lines", "dots"]) this[name] = new Layer(svg);
	}

	x(pixel) {
		return this.figure.stage.x(pixel);
	}

	y(value) {
		return round(STRIP_HEIGHT - 10 - value * (STRIP_HEIGHT - 22));
	}

	line(points, name, kind = "", style = "") {
		const d = "M" + points.map(([x, v]) => `${this.x(x)} ${this.y(v)}`).join("L");
		if (points.length > 1)
			this.lines.put("path", { d, class: `s-curve ${kind}`, "data-term": name, style });
	}

	dot(x, value, name, kind = "", style = "") {
		const r = { "s-ring": 4.2, "s-small": 2.6 }[kind] ?? 3.2;
		this.dots.put("circle", {
			cx: this.x(x),
			cy: this.y(value),
			r,
			class: kind,
			"data-term": name,
			style,
		});
	}

	draw(e) {
		const isDepth = showsDepth(e);
		this.drawAxis(isDepth);
		if (isDepth) this.drawDepth(e);
		else for (const run of e.runs) this.drawRun(e, run);
		if (e.ask === "next") this.drawGuess(e);
		for (const name of ["axis", "bars", "lines", "dots"]) this[name].end();
	}

	drawAxis(isDepth) {
		const { left } = this.figure.stage;
		const end = this.x(this.figure.trace.size[0]);
		const names = isDepth ? ["far", "", "near"] : ["0", "0.5", "1"];
		names.forEach((name, i) => {
			const y = this.y(i / 2);
			this.axis.put("path", {
				d: `M${left} ${y}H${end}`,
				stroke: "#fff",
				"stroke-opacity": i ? 0.12 : 0.35,
			});
			this.axis.put("text", { x: left - 8, y: y + 4, class: "end" }, name);
		});
	}

	/* Draws how near each span of the line is, and which one is visible. */
	drawDepth(e) {
		const depths = this.figure.trace.vertices.map(v => v.depth);
		const [near, far] = [Math.min(...depths), Math.max(...depths)];
		const nearness = q => 0.08 + (0.84 * (far - q)) / (far - near || 1);
		for (const s of e.spans) {
			const points = s.depths.map((q, i) => [s.start + i + 0.5, nearness(q)]);
			const isNew = s === e.span && e.k === "span";
			this.line(points, "", isNew ? "" : "s-dashed", hueStyle(s.polygon));
			for (const [x, v] of points)
				if (!isNew && e.depth[x - 0.5]?.span === s.number)
					this.dot(x, v, "", "", hueStyle(s.polygon));
		}
	}

	/* Returns the pixels of a run that are drawn so far. */
	seen(e, run) {
		if (e.target?.run === run) return run.list.slice(0, e.target.p.i);
		if (run !== e.run) return run.list;
		return e.p ? run.list.slice(0, e.p.i + 1) : [];
	}

	bar(x, from, to, more) {
		const [top, low] = [this.y(Math.max(from, to)), this.y(Math.min(from, to))];
		const height = Math.max(1, low - top);
		this.bars.put("rect", {
			x: this.x(x) + 1,
			y: top,
			width: this.figure.stage.unit - 2,
			height,
			...more,
		});
	}

	drawRun(e, run) {
		const { method } = this.figure;
		const seen = this.seen(e, run);
		for (const p of seen)
			this.bar(p.x, 0, p.colour[0], {
				class: p === e.p ? "s-value s-now" : "s-value",
				fill: screenColour(p.colour),
				"fill-opacity": method === "gouraud" ? 1 : 0.45,
				"data-term": "I",
			});
		const y = this.y(0) + 4;
		this.bars.put("path", {
			d: `M${this.x(run.x)} ${y}H${this.x(run.end)}`,
			class: "s-curve s-thick",
			style: hueStyle(run.polygon),
		});
		const draw = {
			gouraud: this.gouraud,
			"naive-phong": this.naive,
			"fast-phong": this.fast,
			"slerp-phong": this.slerp,
		};
		(draw[method] ?? this.other).call(this, e, run, seen);
	}

	/* Draws a value over the whole run as a curve. */
	curve(run, name, value) {
		const points = run.list.map(p => [p.x + 0.5, value(p)]);
		this.line(
			points.filter(([, v]) => v != null),
			name,
			"s-dashed",
		);
	}

	gouraud(e, { span }, seen) {
		const ends = [span.left, span.right].map(a => [a.x, a.at[0]]);
		this.line(ends, "I", "s-dashed");
		for (const end of ends) this.dot(...end, "x", "s-ring");
		seen.forEach((p, i) => {
			const [x, v] = [p.x + 0.5, p.values[0]];
			const old = seen[i - 1]?.values[0];
			if (p === e.p && i)
				this.line(
					[
						[x - 1, old],
						[x, old],
						[x, v],
					],
					"ΔI",
					"s-thick",
				);
			this.dot(x, v, "I");
		});
	}

	naive(e, run, seen) {
		this.curve(run, "N", p => p.d);
		for (const p of seen) {
			const x = p.x + 0.5;
			if (p === e.p)
				this.line(
					[
						[x, p.d],
						[x, 1],
					],
					"d",
					"s-thick",
				);
			this.dot(x, p.d, "N");
		}
	}

	fast(e, run, seen) {
		const { figure } = this;
		const root = p => figure.truth(e.row, p.x)?.d;
		this.curve(run, "D", root);
		for (const p of seen) {
			const x = p.x + 0.5;
			const d = figure.value(p, "d");
			const [first] = p.guess;
			if (p.guess.length > 1)
				this.line([[x - 1, first], ...p.guess.map(g => [x, g])], "d", p === e.p ? "s-thick" : "");
			const isKnown = root(p) != null;
			if (isKnown) this.dot(x, root(p), "D", "s-ring");
			this.dot(x, d, "d", "s-small", isKnown && isLate(d, root(p)) ? "--t:#ff4d3d" : "");
		}
	}

	slerp(e, run, seen) {
		for (const key of ["t", "rest"]) {
			this.curve(run, "t", p => p[key][0]);
			for (const p of seen) this.dot(p.x + 0.5, p[key][0], "t", key === "t" ? "" : "s-ring");
		}
	}

	/* Draws the first values of any other method, as far as they fit on the strip. */
	other(e, run, seen) {
		const isOnStrip = v => v >= 0 && v <= 1.05;
		this.figure.names.pixel.slice(0, 3).forEach((name, i) => {
			for (const { x, values } of seen)
				if (isOnStrip(values[i]))
					this.dot(x + 0.5, values[i], name, i ? "s-ring" : "", hueStyle(i + 1));
		});
	}

	/* Draws the reader's prediction, and the true value once the reader has answered. */
	drawGuess({ target: { p, run } }) {
		const { value = run.list[p.i - 1].values[0], done } = this.figure.answers.next ?? {};
		this.bar(p.x, 0, value, { class: "s-guess" });
		if (done)
			this.line(
				[
					[p.x - 0.2, p.values[0]],
					[p.x + 1.2, p.values[0]],
				],
				"",
				"s-thick",
				"--t:#66cfa5",
			);
	}
}

/* -- the normals of a run, in the plane that its ends span */

const FAN = { radius: 112, x: 200, y: 128 };

export class Fan {
	constructor(figure, box) {
		this.figure = figure;
		this.box = box;
		this.note = $("small", box);
		this.layer = new Layer($("svg", box));
	}

	draw(e) {
		const { figure, box, layer } = this;
		const { run } = e;
		box.hidden = !run || !["naive-phong", "fast-phong", "slerp-phong"].includes(figure.method);
		if (box.hidden) return;
		this.drawArrows(e, figure.method === "slerp-phong" ? this.turned(run) : this.between(e, run));
		layer.end();
	}

	/* Returns where a vector of the plane, [to the right, upward], is drawn. */
	/** @returns {any} */
	place([right, up], length = 1) {
		return [round(FAN.x + FAN.radius * right * length), round(FAN.y - FAN.radius * up * length)];
	}

	/* Returns slerp's normals by their angles in the trace. All have length 1. */
	turned(run) {
		const phi = phiOf(run.list[0]);
		const at = degrees => [Math.sin, Math.cos].map(f => f(((degrees - phi / 2) * Math.PI) / 180));
		const pixels = run.list.map(p => at(degreesOf(p.t)));
		return { ends: [at(0), at(phi)], pixels, note: `${fixed(phi, 0)}° apart; all of length 1` };
	}

	/* Returns linearly interpolated normals of the trace, projected into the plane of both ends. */
	between(e, run) {
		const { figure } = this;
		const ends = [run.span.left, run.span.right].map(end => normalAt(figure, end.at));
		const dot = (u, v) => sum(u.map((c, i) => c * v[i]));
		const unit = v => v.map(c => c / (Math.sqrt(dot(v, v)) || 1));
		const [a, b] = ends.map(unit);
		const [up, right] = [1, -1].map(sign => unit(b.map((c, i) => c + sign * a[i])));
		const seen = v => v && [dot(v, right), dot(v, up)];
		return {
			ends: ends.map(seen),
			pixels: run.list.map(p => seen(figure.truth(e.row, p.x)?.values)),
			note:
				figure.method === "fast-phong"
					? "divided by d; red where it misses the circle"
					: "divided by d, back on the circle",
		};
	}

	drawArrows({ run, p, row }, { ends, pixels, note }) {
		const { layer, figure } = this;
		const hue = polygonHue(run.polygon);
		const line = (d, kind, style = "", name = "") =>
			layer.put("path", { d, class: kind, style, "data-term": name });
		const arrow = (to, width, colour) =>
			line(
				`M${FAN.x} ${FAN.y}L${this.place(to)}`,
				"s-arrow",
				`--c:${colour};stroke-width:${width}`,
			);
		const ball = ([cx, cy], r, fill) => layer.put("circle", { cx, cy, r, fill });
		const [from, to] = [-0.998, 0.998].map(x => this.place([x, 0.07]));
		line(`M${from}A${FAN.radius} ${FAN.radius} 0 0 1 ${to}`, "s-circle");
		if (figure.method !== "slerp-phong")
			line(`M${this.place(ends[0])}L${this.place(ends[1])}`, "s-chord");
		ends.forEach((end, i) => {
			arrow(end, 2, "var(--ink2)");
			const [x, y] = this.place(end);
			layer.put("text", { x: x + (i ? 8 : -8), y: y - 2, class: i ? "" : "end" }, `N${"₁₂"[i]}`);
		});
		for (const at of pixels.filter(Boolean)) {
			arrow(at, 0.7, hue);
			ball(this.place(at), 2.2, hue);
		}
		this.note.textContent = note;
		const now = p && pixels[p.i];
		if (!now) return;
		const d = figure.value(p, "d") ?? p.d ?? 1;
		const root = figure.truth(row, p.x)?.d;
		arrow(now, 3, hue);
		if (d !== 1) line(`M${this.place(now)}L${this.place(now, 1 / d)}`, "s-divided", "", "d");
		ball(
			this.place(now, 1 / d),
			4,
			figure.method === "fast-phong" && isLate(d, root) ? "var(--bad)" : "var(--good)",
		);
	}
}
