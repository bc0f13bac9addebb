/* The rasterizer that one can stop: a figure made of traces, step by step.

   Addresses, after #lectures/stop? or #course/stop? (#stop? leads to the first):
     method=gouraud | naive-phong | fast-phong | slerp-phong | any other that the traces hold
     steps=1 | 2 | 3        Newton's steps of fast-phong; without it the program's rule decides
     line=9&x=7             pixel 7 of line 9
     line=9&event=span&polygon=3
                            a step of a line: retire, step, enter, sort, span, depth, run, pixel; of polygon 0, 1, …
     event=bucket&edge=A2   an edge on its way into a bucket;  event=end is the finished picture
     ask=edges | shared | next
                            a question;  try=highlight | newton | edge | depth  starts an experiment
     x1=3.5&y1=4            corners that were moved, in pixels
     bare                   only the figure, in the whole window, with larger type
*/

import { address } from "./address.js";
import { isCommand } from "./controls.js";
import { variantOf } from "./live.js";
import { $, atNextFrame, create, focusOn, html, ROOT } from "./markup.js";
import { by, clamp } from "./numbers.js";
import { polygonOf, stepsOf } from "./steps.js";
import { Panel } from "./stop-panel.js";
import { CornerHands, screenColour, Stage } from "./stop-stage.js";
import { Fan, Strip } from "./stop-strip.js";
import { KNOWN, levels, REFERENCE, wordsOf } from "./stop-words.js";
import { CAN_DRAW, valuesOf } from "./studio.js";
import { crossingOf, edgesOf, hasTraces, traceBy, tracesOf } from "./traces.js";

const FIRST = { line: "6", x: "9" };
const OWN_KEYS = ["method", "steps", "line", "x", "event", "polygon", "edge", "ask", "try"];
/* For each speed, the milliseconds between two drawings, and how many steps each drawing advances. */
const SPEEDS = [
	[550, 1],
	[90, 1],
	[16, 2],
];
const methodOf = variant => variant.split(":")[0];
const isTraced = f => f.blocks.some(b => b.trace);

/* What each experiment starts with. */
const EXPERIMENTS = {
	highlight(s) {
		s.show("gouraud");
		s.go(s.events.length - 1);
		s.later = setTimeout(() => s.variant === "gouraud" && s.chooseMethod(REFERENCE), 1500);
	},
	// Goes to the pixel where one Newton step is furthest from the root.
	newton(s) {
		s.show("fast-phong:steps=1");
		const off = ({ p, row }) => Math.abs(s.value(p, "d") / s.truth(row, p.x).d - 1);
		s.go(s.events.filter(e => e.p).sort(by(e => -off(e)))[0].i);
	},
	edge(s) {
		s.show(s.variant);
		s.go(s.seek({ ask: "shared" }).i);
	},
	// Goes to a polygon that is partly in front of an earlier one.
	depth(s) {
		s.show(s.variant);
		const isBoth = e => [true, false].every(is => e.tests?.some(t => t.old && t.seen === is));
		s.go((s.events.find(isBoth) ?? s.events[0]).i);
	},
};

class StopFigure {
	/* The answers to the questions, and the steps of each trace. */
	answers = {};
	views = new WeakMap();
	speed = 1;
	width;
	height;

	constructor(f, stored, remember) {
		this.stored = stored;
		this.traces = stored;
		this.remember = remember;
		// Methods with their own view come first, and a method's variants with parameters before the one without.
		const known = Object.keys(KNOWN);
		const place = v => known.indexOf(methodOf(v)) + 1 || 99;
		this.variants = Object.keys(stored).sort(by(v => 2 * place(v) - v.includes(":")));
		this.methods = [...new Set(this.variants.map(methodOf))];
		this.chosen = Object.fromEntries(this.methods.map(m => [m, this.variantsOf(m)[0]]));
		this.handles = f.live?.handles.filter(h => h.axis) ?? [];
		this.canMove = CAN_DRAW && this.handles.length > 0;
		const root = Object.assign(create("section"), { className: "stop", ariaLabel: f.title });
		root.append($("#stop-parts").content.cloneNode(true));
		this.root = root;
		this.stage = new Stage(this, $(".s-stage svg", root));
		this.hands = new CornerHands(this);
		this.strip = new Strip(this, $(".s-strip svg", root));
		this.fan = new Fan(this, $(".s-fan", root));
		this.panel = new Panel(this, root);
		this.wire(root);
		this.useTrace(this.variants[0]);
		this.panel.lay();
		new ResizeObserver(() => atNextFrame(() => this.resized())).observe($(".s-stage", root));
	}

	variantsOf(method) {
		return this.variants.filter(v => methodOf(v) === method);
	}

	/* -- traces */

	/* Returns the steps of a trace, and its pixels by their places. Makes them once. */
	viewOf(trace) {
		if (this.views.has(trace)) return this.views.get(trace);
		const view = { events: stepsOf(trace), pixels: [] };
		for (const e of view.events) if (e.p) view.pixels[e.row * trace.size[0] + e.p.x] = e;
		this.views.set(trace, view);
		return view;
	}

	/* Switches to a variant, at the step most like `like`, which is a step of another variant. */
	useTrace(variant, like) {
		const trace = this.traces[variant];
		this.trace = trace;
		this.variant = variant;
		this.method = methodOf(variant);
		this.names = trace.names;
		this.chosen[this.method] = variant;
		this.words = wordsOf(this.method);
		this.edges = edgesOf(trace);
		this.corners = trace.vertices.map(v => v.at.map(c => c / trace.unit));
		const { events, pixels } = this.viewOf(trace);
		this.events = events;
		this.usesNewton = events.some(e => e.p?.guess.length > 1);
		this.painted = pixels.map(({ i, p }) => ({ i, colour: screenColour(p.colour) }));
		this.at = like ? this.nearest(like).i : 0;
	}

	get now() {
		return this.events[this.at];
	}

	/* Returns a value of a pixel by its name. */
	value(p, name) {
		return p.values[this.names.pixel.indexOf(name)];
	}

	pixelBy(variant, row, x) {
		const trace = this.traces[variant];
		return trace && this.viewOf(trace).pixels[row * trace.size[0] + x]?.p;
	}

	/* Returns the pixel by naive Phong, with which all others are compared. */
	truth(row, x) {
		return this.pixelBy(REFERENCE, row, x);
	}

	/* Returns the greatest difference from naive Phong's picture in grey levels, or null if there is no trace of it. */
	worst() {
		if (!this.traces[REFERENCE]) return null;
		const off = ({ p, row }) => p && Math.abs(levels(p.colour[0], this.truth(row, p.x).colour[0]));
		return Math.max(0, ...this.events.map(e => off(e) ?? 0));
	}

	/* Returns how an edge crosses its first line. */
	crossing(edge) {
		const line = edge.crosses && this.trace.lines[edge.first];
		const a = line && line.active.find(v => v.edge === edge.id);
		return a && crossingOf(a);
	}

	/* Returns the step that is most like a step of another trace. */
	nearest(old) {
		const x = e => e.p?.x ?? -9;
		const cost = e =>
			1000 * Math.abs(e.row - old.row) +
			(e.k === old.k ? 0 : 60) +
			20 * Math.abs((polygonOf(e) ?? -1) - (polygonOf(old) ?? -1)) +
			Math.abs(x(e) - x(old)) +
			0.01 * Math.abs(e.i - old.i);
		const costs = this.events.map(cost);
		return this.events[costs.indexOf(Math.min(...costs))];
	}

	/* -- corners that are moved */

	/* Returns the index of a corner's first handle. Corners are vertices of the trace, and handles belong to the figure: they match if
   they start at the same place. */
	handleOf(corner) {
		const at = Object.values(this.stored)[0].vertices[corner].at.map(c => c / this.trace.unit);
		const isThere = (h, i) =>
			h.axis === "x" && h.start === at[0] && this.handles[i + 1].start === at[1];
		return this.handles.findIndex(isThere);
	}

	moveCorner(corner, x, y) {
		const i = this.handleOf(corner);
		if (i < 0) return;
		this.moved ??= this.handles.map(h => h.start);
		[x, y].forEach((v, axis) => {
			const { step, range } = this.handles[i + axis];
			this.moved[i + axis] = clamp(Math.round(v / step) * step, ...range);
		});
		this.answers = {};
		if (!this.waits) atNextFrame(() => this.retrace());
		this.waits = true;
	}

	/* Traces the current method for the moved corners, and the other methods when the hand rests. */
	async retrace() {
		this.waits = false;
		const { moved } = this;
		try {
			const trace = await traceBy(this.variant, moved);
			if (moved !== this.moved) return;
			this.traces = { [this.variant]: trace };
			this.problem = "";
		} catch (error) {
			this.problem = `Not traced here: ${error.message}. The numbers are the stored ones.`;
			this.restore();
		}
		this.show(this.variant, this.now);
		clearTimeout(this.later);
		this.later = setTimeout(() => this.retraceOthers(), 120);
	}

	/* Traces the next of the other methods, naive Phong first, unless the hand moves on. */
	async retraceOthers() {
		const { moved, traces } = this;
		const missing = [REFERENCE, ...Object.values(this.chosen), ...this.variants].find(
			v => this.variants.includes(v) && !traces[v],
		);
		if (!moved || !missing) return;
		const trace = await traceBy(missing, moved);
		if (this.traces !== traces || this.waits) return;
		traces[missing] = trace;
		this.panel.lay();
		this.draw();
		this.later = setTimeout(() => this.retraceOthers(), 0);
	}

	/* Returns the corners to their first places. */
	restore() {
		this.moved = null;
		this.traces = this.stored;
	}

	/* -- showing */

	resized() {
		const { clientWidth: width, clientHeight } = $(".s-stage", this.root);
		// In a talk the stage fills the remaining height. Otherwise its height follows from its width.
		const isFixed = getComputedStyle(this.stage.svg).position === "absolute";
		const height = isFixed ? clientHeight : Infinity;
		if (!width || (width === this.width && height === this.height)) return;
		Object.assign(this, { width, height });
		this.stage.lay(width, height);
		this.strip.lay();
		this.draw();
	}

	/* Shows a variant, at the step most like `like`. */
	show(variant, like) {
		if (!this.traces[variant]) return this.traceFirst(variant, like);
		this.useTrace(variant, like);
		this.panel.lay();
		this.draw();
	}

	/* Shows a method that has no trace for the moved corners yet, after tracing it. */
	async traceFirst(variant, like) {
		const { moved, traces } = this;
		traces[variant] = await traceBy(variant, moved);
		if (traces === this.traces) this.show(variant, like);
	}

	draw() {
		const e = this.now;
		if (this.width) {
			this.stage.draw(e);
			this.strip.draw(e);
			this.fan.draw(e);
		}
		this.panel.draw(e);
		$("[data-do=first]", this.root).style.visibility = this.moved ? "" : "hidden";
		this.keepAddress();
	}

	/* -- driving */

	go(i) {
		this.at = clamp(i, 0, this.events.length - 1);
		const { now } = this;
		const isEnd = this.at === this.events.length - 1;
		if (this.timer && (isEnd || (now.k === "ask" && !this.answers[now.ask]?.done))) this.halt();
		this.draw();
	}

	step(by) {
		this.halt();
		this.go(this.at + by);
	}

	/* Goes forward to the next line or question, or back to the start of this line or of the previous one. */
	line(by) {
		this.halt();
		const { events, at, now } = this;
		const isOpen = e => e.k === "ask" && !this.answers[e.ask]?.done;
		const start = row => events.find(e => e.row === row).i;
		if (by > 0)
			return this.go(
				(events.find(e => e.i > at && (e.row > now.row || isOpen(e))) ?? events.at(-1)).i,
			);
		const first = start(now.row);
		this.go(at > first ? first : start(events[Math.max(0, first - 1)].row));
	}

	play() {
		if (this.timer) {
			this.halt();
			return this.draw();
		}
		if (this.at === this.events.length - 1) this.at = 0;
		const [ms, count] = SPEEDS[this.speed];
		this.timer = setInterval(() => (this.root.checkVisibility() ? this.advance(count) : this.halt()), ms);
		this.advance(1);
	}

	/* Advances by some steps, but not past an open question. */
	advance(count) {
		let i = this.at;
		for (let k = 0; k < count; k++) {
			i++;
			const e = this.events[i];
			if (e?.k === "ask" && !this.answers[e.ask]?.done) break;
			if (e?.k === "ask") i++;
		}
		this.go(i);
	}

	halt() {
		clearInterval(this.timer);
		this.timer = 0;
	}

	chooseMethod(method) {
		delete this.answers.next;
		this.show(this.chosen[method], this.now);
	}

	/* -- addresses */

	/* Goes to the step that a query names. */
	follow(query) {
		const text = String(query);
		const given = Object.fromEntries(query);
		// An address that does not mention the figure leaves it where the reader left it.
		const isMine = key => OWN_KEYS.includes(key) || this.handles.some(h => h.name === key);
		if (this.address != null && (text === this.address || !Object.keys(given).some(isMine))) return;
		this.address = text;
		this.halt();
		this.followCorners(given);
		const method = this.methods.includes(given.method) ? given.method : this.methods[0];
		const named = given.steps ? variantOf(method, { steps: given.steps }) : method;
		const variant = [named, this.chosen[method]].find(v => this.variants.includes(v));
		const open = () => {
			const isTry = this.startsTry(given.try);
			if (!isTry) this.go(this.seek(given).i);
			const shown = this.query();
			// If an address names a step that does not exist, it is corrected.
			const isBroken = OWN_KEYS.some(key => given[key] && given[key] !== shown.get(key));
			this.kept = isBroken && !isTry ? "" : String(shown);
		};
		if (!this.moved || this.traces[variant]) {
			this.show(variant);
			return open();
		}
		// The address moves corners. Nothing is shown until they are traced.
		this.variant = variant;
		this.retrace().then(open);
	}

	followCorners(given) {
		const isGiven = this.canMove && this.handles.some(h => h.name in given);
		const values = isGiven ? valuesOf({ handles: this.handles }, new URLSearchParams(given)) : null;
		if (String(values) === String(this.moved ?? null)) return;
		this.restore();
		if (values) [this.moved, this.traces] = [values, {}];
	}

	/* Returns the step that an address names, or the nearest one. */
	seek(given) {
		const { events } = this;
		if (given.ask) return events.find(e => e.ask === given.ask) ?? events[0];
		const isEmpty = !["line", "x", "event"].some(key => key in given);
		const { line, x, event = x && "pixel", polygon, edge } = isEmpty ? FIRST : given;
		const edgeName = e => (e.edge ?? e.a?.edge)?.name;
		const isIt = e =>
			(line == null || e.row === +line) &&
			(!event || e.k === event) &&
			(x == null || e.p?.x === +x) &&
			(polygon == null || polygonOf(e) === +polygon) &&
			(!edge || edgeName(e) === edge);
		return events.find(isIt) ?? events.find(e => e.row === +line) ?? events[0];
	}

	/* Returns the query that leads to the current step. */
	query() {
		const e = this.now;
		const [, ...parameters] = this.variant.split(":");
		const query = new URLSearchParams({ method: this.method });
		for (const p of parameters) {
			const [name, value] = p.split("=");
			query.set(name, value);
		}
		const isOfLine = !e.ask && e.row >= 0 && e.k !== "end";
		const place = {
			ask: e.ask,
			line: isOfLine ? e.row : null,
			x: e.p?.x,
			event: e.ask || e.p ? null : e.k,
			polygon: e.p ? null : (e.run ?? e.span)?.polygon,
			edge: (e.edge ?? e.a?.edge)?.name,
		};
		for (const key in place) if (place[key] != null) query.set(key, place[key]);
		this.moved?.forEach((v, i) => {
			if (v !== this.handles[i].start) query.set(this.handles[i].name, String(+v.toFixed(4)));
		});
		if (this.isBare) query.set("bare", "");
		return query;
	}

	keepAddress() {
		clearTimeout(this.keeps);
		this.keeps = setTimeout(() => {
			const query = this.query();
			if (!this.root.checkVisibility() || String(query) === this.kept) return;
			this.kept = this.address = String(query);
			this.remember?.(query);
		}, 250);
	}

	/* -- experiments */

	startsTry(name) {
		if (!Object.hasOwn(EXPERIMENTS, name ?? "")) return false;
		this.halt();
		this.restore();
		this.answers = {};
		EXPERIMENTS[name](this);
		return true;
	}

	/* -- talks */

	setBare(isBare) {
		this.isBare = isBare;
		this.root.classList.toggle("s-bare", isBare);
		ROOT.toggleAttribute("data-bare", isBare);
		$("[data-do=bare]", this.root).ariaPressed = isBare;
	}

	/* -- buttons and keys */

	wire(root) {
		const act = {
			"line-back": () => this.line(-1),
			back: () => this.step(-1),
			play: () => this.play(),
			forth: () => this.step(1),
			"line-forth": () => this.line(1),
			first: () => this.firstCorners(),
			bare: () => this.talk(),
			full: () =>
				document.fullscreenElement ? document.exitFullscreen() : root.requestFullscreen(),
		};
		root.addEventListener("click", ({ target }) => {
			const given = target.closest("button")?.dataset ?? {};
			act[given.do]?.();
			if (given.method) this.chooseMethod(given.method);
			if (given.variant) this.show(given.variant, this.now);
			if (given.speed) this.changeSpeed(+given.speed);
			if (given.go) this.step(given.go - this.at);
			if (given.try) this.openTry(given.try);
		});
		$(".s-time input", root).oninput = ({ target }) => this.step(target.value - this.at);
		$("[data-do=full]", root).hidden = !document.fullscreenEnabled;
		root.onfullscreenchange = () => this.talk(document.fullscreenElement === root);
	}

	firstCorners() {
		this.restore();
		this.answers = {};
		this.show(this.variant, this.now);
		focusOn(this.panel.drives.play);
	}

	/* Switches to a talk, which shows only the figure, and back. Full screen is a talk, too. */
	talk(isBare = !this.isBare) {
		if (!isBare && document.fullscreenElement) document.exitFullscreen();
		this.setBare(isBare);
		this.resized();
		this.draw();
	}

	openTry(name) {
		this.startsTry(name);
		const isCalm = matchMedia("(prefers-reduced-motion:reduce)").matches;
		$(".s-frame", this.root).scrollIntoView({
			behavior: isCalm ? "auto" : "smooth",
			block: "start",
		});
	}

	changeSpeed(speed) {
		const plays = this.timer;
		this.halt();
		this.speed = speed;
		if (plays) this.play();
		else this.draw();
	}

	/* Handles a key. Keys that usually scroll the page drive the figure only if it has the focus, or in a talk. */
	key({ key, target }, isInside) {
		const scrolls = {
			PageDown: () => this.line(1),
			PageUp: () => this.line(-1),
			Home: () => this.step(-1e6),
			End: () => this.step(1e6),
			" ": () => this.play(),
		};
		const keys = {
			ArrowRight: () => this.step(1),
			ArrowLeft: () => this.step(-1),
			n: () => this.line(1),
			p: () => this.line(-1),
			t: () => this.talk(),
		};
		if (this.isBare && !document.fullscreenElement) keys.Escape = keys.t;
		this.methods.slice(0, 9).forEach((m, i) => {
			keys[i + 1] = () => this.chooseMethod(m);
		});
		const isTaken = key === " " && target.closest("button,a,summary");
		if ((isInside || this.isBare) && !isTaken) Object.assign(keys, scrolls);
		keys[key]?.();
		return key in keys;
	}

	/* Returns how much of the figure is visible, or how much of the window it fills if it is higher than that. */
	get seen() {
		const { top, bottom, height } = $(".s-frame", this.root).getBoundingClientRect();
		return height
			? (Math.min(bottom, innerHeight) - Math.max(top, 0)) / Math.min(height, innerHeight)
			: 0;
	}
}

/* The figure of each view. When the reader returns to a view, its figure is in the state in which it was left. */
const stopFigures = new Map();

addEventListener("keydown", e => {
	/** @type {any} */
	const on = e.target;
	if (
		isCommand(e) ||
		e.defaultPrevented ||
		(on.matches?.("input,select,textarea,[contenteditable]") && e.key !== "Escape") ||
		$("#keys")?.open
	)
		return;
	const figures = [...stopFigures.values()].filter(
		s => s.root.checkVisibility(),
	);
	const inside = figures.find(s => s.root.contains(on));
	// Keys stay with an element elsewhere that has the focus, and arrow keys with a part that scrolls.
	if (e.key.startsWith("Arrow") && on.closest?.(".s-scroll")) return;
	const figure = inside ?? figures.find(s => on === document.body && (s.isBare || s.seen > 0.5));
	if (figure?.key(e, !!inside)) e.preventDefault();
});

// A new address ends a talk, unless it asks for one.
addEventListener("hashchange", () => ROOT.removeAttribute("data-bare"));

/* Puts the figure into an element. Calls `remember` with the query of each step at which the figure rests. Returns false if the figure
   cannot be shown here. */
export function stopInto(el, f, query, remember) {
	if (!isTraced(f) || !hasTraces()) return false;
	const place = address.view;
	const kept = stopFigures.get(place);
	const mount = figure => {
		figure.remember = remember;
		if (figure.root.parentElement !== el) el.replaceChildren(figure.root);
		figure.setBare(query.has("bare"));
		figure.follow(query);
		figure.resized();
	};
	if (kept) {
		mount(kept);
		return true;
	}
	el.innerHTML = html`<p class="s-waits">The figure is being unpacked.</p>`;
	tracesOf().then(
		stored => {
			if (!el.isConnected) return;
			const figure = stopFigures.get(place) ?? new StopFigure(f, stored, remember);
			stopFigures.set(place, figure);
			mount(figure);
		},
		error => {
			el.textContent = `The figure cannot be shown here: ${error.message}`;
		},
	);
	return true;
}
