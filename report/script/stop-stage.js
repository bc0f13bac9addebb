/* The stage of the figure: the edge table at the left, then pixels, polygons, active edges, and the scan line with its crossings. */

import { arrow } from "./controls.js";
import { focusOn, sentence } from "./markup.js";
import { clamp, round, sum } from "./numbers.js";
import { polygonOf } from "./steps.js";
import { fixed, polygonHue } from "./stop-words.js";
import { letterOf } from "./traces.js";

function svgNode(tag, attributes = {}, parent) {
	const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
	for (const name in attributes) node.setAttribute(name, attributes[name]);
	parent?.append(node);
	return node;
}

/* A group whose shapes are kept from step to step. Only attributes that differ are changed, which makes a step fast. */
export class Layer {
	constructor(parent) {
		this.group = svgNode("g", { "aria-hidden": true }, parent);
		this.shapes = [];
		this.used = 0;
	}

	/* Draws one more shape. */
	put(tag, attributes, text = "") {
		let shape = this.shapes[this.used];
		if (shape?.tag !== tag) {
			const node = svgNode(tag);
			if (shape) shape.node.replaceWith(node);
			else this.group.append(node);
			shape = this.shapes[this.used] = { tag, node, attributes: {}, text: "" };
		}
		this.used++;
		const { node, attributes: old } = shape;
		for (const name in old) if (!(name in attributes)) node.removeAttribute(name);
		for (const name in attributes)
			if (old[name] !== attributes[name]) node.setAttribute(name, attributes[name]);
		if (shape.text !== text) node.textContent = text;
		Object.assign(shape, { attributes, text });
	}

	/* Ends a drawing: hides shapes of the previous one that were not drawn again. */
	end() {
		this.shapes.slice(this.used).forEach(({ node, attributes }) => {
			if (attributes.display !== "none") node.setAttribute("display", "none");
			attributes.display = "none";
		});
		this.used = 0;
	}
}

/* Turns a colour of the trace into a colour of the screen. */
export const screenColour = colour => `rgb(${colour.map(c => Math.round(255 * clamp(c, 0, 1))).join()})`;

const GROUPS = ["gutter", "polygons", "edges", "corners", "line", "marks"];

export class Stage {
	width;
	left;
	unit;
	isSmall;
	fills;
	/* Layers, from back to front. */
	gutter;
	polygons;
	edges;
	corners;
	line;
	marks;

	constructor(figure, svg) {
		this.figure = figure;
		this.svg = svg;
	}

	/* Lays the stage out for its width, and draws the parts that no step changes. */
	lay(width, height) {
		const { svg, figure } = this;
		const [columns, rows] = figure.trace.size;
		const least = width < 480 ? 68 : clamp(width * 0.18, 116, 150);
		const unit = Math.min((width - least - 10) / columns, (height - 14) / rows);
		const left = (width + least - 10 - columns * unit) / 2;
		Object.assign(this, { width, left, unit, isSmall: width < 480, fills: [] });
		svg.setAttribute("viewBox", `0 0 ${width} ${Math.max(this.y(rows) + 8, isFinite(height) && height)}`);
		svg.replaceChildren();
		const pixels = svgNode("g", { "shape-rendering": "crispEdges" }, svg);
		const cell = (_, i) => {
			const [x, y] = [this.x(i % columns), this.y(Math.floor(i / columns))];
			return svgNode("rect", { x, y, width: unit + 0.3, height: unit + 0.3, fill: "none" }, pixels);
		};
		this.cells = Array.from({ length: columns * rows }, cell);
		const across = Array.from(
			{ length: columns + 1 },
			(_, x) => `M${this.x(x)} ${this.y(0)}V${this.y(rows)}`,
		);
		const down = Array.from(
			{ length: rows + 1 },
			(_, y) => `M${left} ${this.y(y)}H${this.x(columns)}`,
		);
		svgNode("path", { d: across.concat(down).join(""), class: "s-grid" }, svg);
		for (const name of GROUPS) this[name] = new Layer(svg);
		figure.hands.lay(svg);
	}

	x(pixel) {
		return round(this.left + pixel * this.unit);
	}

	y(line) {
		return round(6 + line * this.unit);
	}

	point(corner) {
		const [x, y] = this.figure.corners[corner];
		return [this.x(x), this.y(y)];
	}

	draw(e) {
		this.drawPixels(e);
		this.drawGutter(e);
		this.drawPolygons(e);
		this.drawCorners();
		this.drawEdges(e);
		this.drawLine(e);
		this.drawMarks(e);
		for (const name of GROUPS) this[name].end();
		this.figure.hands.draw();
	}

	/* Paints the pixels that are drawn so far. */
	drawPixels(e) {
		this.cells.forEach((cell, i) => {
			const paint = this.figure.painted[i];
			const fill = paint?.i <= e.i ? paint.colour : "none";
			if (this.fills[i] !== fill) cell.setAttribute("fill", fill);
			this.fills[i] = fill;
		});
	}

	/* Draws the edge table. An edge that waits is an outline, an active one is filled, and one that has ended is faded. */
	drawGutter(e) {
		const { figure, gutter, isSmall, left } = this;
		const { trace } = figure;
		const isHere = e.row >= 0 && e.row < trace.size[1];
		gutter.put("rect", {
			x: 0,
			y: this.y(isHere ? e.row : 0),
			width: left - 4,
			height: this.unit,
			class: "s-here",
			opacity: +isHere,
		});
		trace.buckets.forEach((bucket, y) => {
			const text = isSmall && y !== e.row && y % 2 ? "" : String(y);
			gutter.put(
				"text",
				{ x: left - 8, y: this.y(y + 0.5) + 4, class: y === e.row ? "end s-big" : "end" },
				text,
			);
			bucket.forEach((id, i) => this.bucketMark(e, figure.edges[id], y, i, bucket.length));
		});
		if (!isSmall) gutter.put("text", { x: 4, y: this.y(0.5) + 4 }, "edge table");
	}

	bucketMark(e, edge, y, i, count) {
		const { gutter, isSmall } = this;
		const height = Math.min(this.unit - 2, 22);
		const width = Math.min(26, (this.left - (isSmall ? 18 : 30)) / Math.max(4, count) - 2);
		const isActive = e.active.some(a => a.edge.id === edge.id);
		const isNew = (e.edge ?? e.a?.edge)?.id === edge.id;
		const isOver = e.row >= edge.end;
		const visibility = e.k === "bucket" && edge.id > e.edge.id ? "hidden" : "visible";
		const x = 4 + i * (width + 2);
		const style = `--c:${polygonHue(edge.polygon)}`;
		const kind = `${isActive ? "s-lives" : ""} ${isNew ? "s-new" : ""} ${isOver ? "s-over" : ""}`;
		gutter.put("rect", {
			x,
			y: round(this.y(y + 0.5) - height / 2),
			width,
			height,
			rx: 2.5,
			visibility,
			style,
			class: `s-bucket ${kind}`,
		});
		const name = isSmall ? String(edge.corner + 1) : edge.name;
		gutter.put(
			"text",
			{
				x: x + width / 2,
				y: this.y(y + 0.5) + 3.6,
				visibility,
				style,
				class: `mid s-name ${kind}`,
			},
			name,
		);
	}

	drawPolygons(e) {
		const { polygons, unit } = this;
		this.figure.trace.polygons.forEach(({ corners }, i) => {
			const points = corners.map(c => this.point(c));
			const style = `--c:${polygonHue(i)}`;
			polygons.put("polygon", { points: points.join(" "), class: "s-polygon", style });
			let [x, y] = [0, 1].map(axis => sum(points.map(p => p[axis])) / points.length);
			// The first polygon's letter would cover the highlight in the middle.
			if (i === 0) [x, y] = [x + 3.4 * unit, y - 0.9 * unit];
			const isInTheWay = e.row >= 0 && Math.abs(y - this.y(e.row + 0.5)) < 1.1 * unit;
			const visibility = isInTheWay ? "hidden" : "visible";
			polygons.put(
				"text",
				{ x: round(x), y: round(y + 5), class: "mid s-halo s-letter", visibility, style },
				letterOf(i),
			);
		});
	}

	/* Draws what the corners carry: I by Gouraud, else a normal. */
	drawCorners() {
		const { corners, unit, figure } = this;
		const { vertices, polygons, names, size } = figure.trace;
		vertices.forEach(({ normal, varyings }, i) => {
			const [x, y] = this.point(i);
			if (names.varyings[0] !== "Ir") {
				const [dx, dy] = normal.map(c => round(c * 1.9 * unit));
				corners.put("path", { d: `M${x} ${y}l${dx} ${dy}`, class: "s-normal", "data-term": "N" });
				return;
			}
			const others = polygons
				.filter(p => p.corners.includes(i))
				.flatMap(p => p.corners.map(c => this.point(c)));
			// The value is placed away from the middle of its polygons, and not below the last line.
			const out = [x, y].map((v, axis) => v - sum(others.map(p => p[axis])) / others.length);
			const [right, down] = out.map(v => v / (Math.hypot(...out) || 1));
			const at = {
				x: round(x + 14 * right),
				y: round(clamp(y + 15 * down + 4, 12, this.y(size[1]) + 4)),
			};
			corners.put(
				"text",
				{ ...at, class: right > 0 ? "s-halo" : "s-halo end", "data-term": "I" },
				fixed(varyings[0], 2),
			);
		});
	}

	drawEdges(e) {
		const draw = ({ top, bottom, polygon }, width, isWhite) => {
			const style = `stroke:${isWhite ? "#fff" : polygonHue(polygon)};stroke-width:${width}`;
			const d = `M${this.point(top)}L${this.point(bottom)}`;
			this.edges.put("path", {
				d,
				style,
				class: "s-edge",
				"stroke-dasharray": isWhite ? "3 5" : "",
			});
		};
		if (e.edge) draw(e.edge, 4, !e.edge.crosses);
		for (const a of e.active) draw(a.edge, a === e.a ? 5 : 2.6);
		for (const edge of e.gone ?? []) draw(edge, 3, true);
	}

	/* Draws the scan line, with a point at each pixel's centre, and the crossings on it. */
	drawLine(e) {
		const { line } = this;
		const [columns, rows] = this.figure.trace.size;
		if (e.row < 0 || e.row >= rows) return;
		const y = this.y(e.row + 0.5);
		line.put("path", { d: `M${this.x(0)} ${y}H${this.x(columns)}`, class: "s-scan" });
		const centres = Array.from({ length: columns }, (_, x) => `M${this.x(x + 0.5)} ${y}h0`);
		line.put("path", {
			d: centres.join(""),
			class: "s-centres",
			"stroke-width": e.ask === "shared" ? 4.5 : 3,
		});
		if (e.k === "retire" || e.ask === "edges") return;
		for (const { x, edge } of e.active) {
			const d = `M${round(this.x(x) - 5)} ${round(y - 9)}h10l-5 9z`;
			line.put("path", {
				d,
				class: "s-crossing",
				style: `--c:${polygonHue(edge.polygon)}`,
				"data-term": "x",
			});
		}
	}

	/* Draws a box on the scan line. */
	box(e, from, end, more) {
		this.marks.put("rect", {
			x: this.x(from),
			y: this.y(e.row),
			width: round((end - from) * this.unit),
			height: this.unit,
			...more,
		});
	}

	/* Marks the span, run and pixel of the step, and the crossings at its ends. */
	drawMarks(e) {
		const { marks, unit } = this;
		const { span, run, p } = e;
		const mark = (from, end) =>
			this.box(e, from, end, {
				class: e.k === "span" ? "s-mark s-filled" : "s-mark",
				style: `--c:${polygonHue(polygonOf(e))}`,
			});
		if (span && !span.none) mark(span.start, span.end);
		if (run) mark(run.x, run.end);
		for (const t of e.tests ?? []) {
			const polygon = t.seen ? span.polygon : t.old.polygon;
			const style = `--c:${t.seen ? polygonHue(polygon) : "#fff"};font-size:11px`;
			marks.put(
				"text",
				{ x: this.x(t.x + 0.5), y: this.y(e.row + 0.5) + 4.5, class: "mid s-halo s-letter", style },
				letterOf(polygon),
			);
		}
		const ends = span ?? run?.span;
		if (ends && unit > 13)
			[ends.left, ends.right].forEach(({ x }, i) => {
				const at = {
					x: clamp(round(this.x(x) + (i ? 7 : -7)), this.left + 9, this.width - 12),
					y: round(this.y(e.row + 0.5) - unit * 0.62),
				};
				marks.put("text", { ...at, class: "s-halo s-big mid", "data-term": "x" }, `x${"₁₂"[i]}`);
			});
		if (p) for (const kind of ["s-around", "s-pixel"]) this.box(e, p.x, p.x + 1, { class: kind });
		if (e.ask === "shared") this.drawOwners(e);
	}

	/* Marks the pixels of the question *Whose pixels are these?* */
	drawOwners(e) {
		const { own, right, done } = this.figure.answers.shared ?? {};
		e.meet.owners.forEach(({ x }, i) => {
			const owner = (done ? right : own)?.[i];
			this.box(e, x, x + 1, {
				class: "s-owned",
				style: `--c:${owner == null ? "none" : polygonHue(owner)}`,
			});
		});
	}
}

/* The corners as handles, which the reader drags or moves by arrow keys. They are kept from step to step, so that they keep the focus. */
export class CornerHands {
	constructor(figure) {
		this.figure = figure;
	}

	lay(svg) {
		const group = svgNode("g", {}, svg);
		this.nodes = this.figure.corners.map((_, i) => {
			const node = svgNode("g", { class: "s-hand" }, group);
			if (this.figure.canMove) this.wire(node, svg, i);
			svgNode("circle", { r: 17, fill: "transparent" }, node);
			svgNode("circle", { r: 4.5, class: "s-dot" }, node);
			return node;
		});
	}

	wire(node, svg, i) {
		const { figure } = this;
		node.setAttribute("tabindex", 0);
		node.setAttribute("role", "button");
		// A finger on a corner drags the corner and must not scroll the page.
		node.addEventListener("touchstart", e => e.preventDefault(), { passive: false });
		node.onpointerdown = e => {
			figure.halt();
			node.setPointerCapture(e.pointerId);
			node.classList.add("s-held");
			e.preventDefault();
			focusOn(node);
		};
		node.onpointermove = e => {
			if (!node.classList.contains("s-held")) return;
			const { stage } = figure;
			const box = svg.getBoundingClientRect();
			const scale = stage.width / box.width;
			const x = (e.clientX - box.left) * scale - stage.left;
			const y = (e.clientY - box.top) * scale - 6;
			figure.moveCorner(i, x / stage.unit, y / stage.unit);
		};
		node.onpointerup = node.onpointercancel = () => {
			node.classList.remove("s-held");
		};
		node.onkeydown = e => {
			const way = arrow(e, 0.125, 1);
			if (!way) return;
			figure.halt();
			const [x, y] = figure.corners[i];
			figure.moveCorner(i, x + way[0], y + way[1]);
		};
	}

	draw() {
		const { figure } = this;
		this.nodes.forEach((node, i) => {
			const at = figure.stage.point(i).join();
			if (node.dataset.at === at) return;
			node.dataset.at = at;
			node.setAttribute("transform", `translate(${at})`);
			if (!figure.canMove) return;
			const [x, y] = figure.corners[i];
			const [name] = sentence(figure.handles[figure.handleOf(i)]?.label ?? "corner").split(",");
			node.setAttribute(
				"aria-label",
				`${name} at ${fixed(x, 2)}, ${fixed(y, 2)}: drag it, or move it with the arrow keys`,
			);
		});
	}
}
