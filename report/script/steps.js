/* Steps of a trace: turns the trace of a picture into the list of everything that happened, in order. Nothing is computed here: a
   step only says where its values are in the trace. */

import { by } from "./numbers.js";
import { crossingOf, edgesOf, pixelsOf } from "./traces.js";

/* The state before anything has begun. */
const NOTHING = { active: [], spans: [], depth: [], runs: [] };

/* Lists the steps of a picture: first edges go into buckets, then lines follow one by one, with three questions on the way. */
export function stepsOf(trace) {
	const edges = edgesOf(trace);
	const events = edges.map(edge => ({ ...NOTHING, k: "bucket", row: -1, edge }));
	let before = [];
	for (const line of trace.lines) {
		const active = line.active.map(a => ({ ...a, ...crossingOf(a), edge: edges[a.edge] }));
		events.push(...stepsOfLine(line, edges, before, active, trace.size[0]));
		before = active;
	}
	events.push({ ...NOTHING, k: "end", row: trace.size[1] });
	askOf(events, trace);
	events.forEach((e, i) => {
		e.i = i;
	});
	return events;
}

/* Lists the steps of a line. `before` holds the active edges of the line above, `after` the active edges of this line. */
function stepsOfLine(line, edges, before, after, width) {
	const events = [];
	const now = { ...NOTHING, row: line.y };
	const say = (k, more) => events.push({ ...now, k, ...more });
	const entry = id => after.find(a => a.edge.id === id);
	now.active = before;
	if (line.left.length) {
		now.active = before.filter(a => !line.left.includes(a.edge.id));
		say("retire", { gone: line.left.map(id => edges[id]), before });
	}
	if (line.stepped.length) {
		now.active = now.active.map(a => entry(a.edge.id) ?? a);
		say("step", { old: before });
	}
	for (const entered of line.entered) {
		const a = entry(entered.edge);
		now.active = [...now.active, a];
		say("enter", { a, entered });
	}
	if (!after.length) {
		say("empty");
		return events;
	}
	now.active = after;
	now.depth = Array(width).fill(null);
	say("sort");
	spanSteps(line, now, say);
	runSteps(line, now, say);
	return events;
}

/* Lists the steps of the spans of a line. Two neighbouring edges of a polygon bound a span: one step finds it, the next tests its depth. */
function spanSteps(line, now, say) {
	const spans = line.spans.map((s, number) => ({
		...s,
		number,
		left: now.active.find(a => a.edge.id === s.left),
		right: now.active.find(a => a.edge.id === s.right),
	}));
	for (const [left, right] of pairsOf(now.active)) {
		const polygon = left.edge.polygon;
		const span = spans.find(s => s.left === left && s.right === right);
		if (!span) {
			say("span", { span: { polygon, left, right, none: true } });
			continue;
		}
		now.spans = [...now.spans, span];
		say("span", { span });
		const isSeen = x => span.seen.some(([from, to]) => x >= from && x < to);
		const tests = span.depths.map((z, i) => {
			const x = span.start + i;
			return { x, z, old: now.depth[x], seen: isSeen(x) };
		});
		now.depth = [...now.depth];
		for (const { x, z, seen } of tests) if (seen) now.depth[x] = { z, span: span.number, polygon };
		say("depth", { span, tests });
	}
	now.all = spans;
}

/* The pairs of active edges, polygon by polygon. */
function pairsOf(active) {
	const pairs = [];
	for (let i = 0; i + 1 < active.length; i++)
		if (active[i].edge.polygon === active[i + 1].edge.polygon) {
			pairs.push([active[i], active[i + 1]]);
			i++;
		}
	return pairs;
}

/* Lists the steps that shade the visible parts of spans, run by run and pixel by pixel. */
function runSteps(line, now, say) {
	for (const r of line.runs) {
		const span = now.all[r.span];
		const run = { ...r, span, polygon: span.polygon, end: r.x + r.pixels, list: pixelsOf(r) };
		now.runs = [...now.runs, run];
		say("run", { run });
		for (const p of run.list) say("pixel", { run, p, last: run.list[p.i - 1] });
	}
}

/* Inserts the questions where there is something to predict. */
function askOf(events, trace) {
	const places = [askEdges(events), askShared(events, trace), askNext(events)];
	const found = places.filter(Boolean).sort(by(q => -q.before));
	for (const { ask, before, meet } of found) {
		const target = events[before];
		const { row: above, active, spans, depth, runs } = events[before - 1];
		const row = ask === "edges" ? above : target.row;
		events.splice(before, 0, { k: "ask", ask, row, active, spans, depth, runs, target, meet });
	}
}

/* Finds a place for *Which edges are active?*: the line where most edges change. */
function askEdges(events) {
	const change = new Map();
	const add = (e, n) => {
		const c = change.get(e.row) ?? { row: e.row, enter: 0, retire: 0 };
		c[e.k] += n;
		change.set(e.row, c);
	};
	for (const e of events) if (e.k === "enter" || e.k === "retire") add(e, e.gone?.length ?? 1);
	const both = [...change.values()].filter(c => c.enter && c.retire);
	const [best] = both.sort(by(c => (c.row > 8 ? 100 : 0) - c.enter - c.retire));
	return best && { ask: "edges", before: events.findIndex(e => e.row === best.row) };
}

/* The polygons that own the two pixels at the left of a crossing and the two at its right. A pixel has none where spans overlap or end. */
function ownersAt({ pixel }, { spans }) {
	return [-2, -1, 0, 1].map(by => {
		const own = spans.filter(s => pixel + by >= s.start && pixel + by < s.end);
		return { x: pixel + by, polygon: own.length === 1 ? own[0].polygon : null };
	});
}

/* Finds a place for *Whose pixels are these?*: a line where two polygons share an edge, if possible with a pixel's centre on it. */
function askShared(events, trace) {
	const ends = ({ edge }) => `${edge.top} ${edge.bottom}`;
	const meet = [];
	events.forEach((e, i) => {
		if (e.k !== "sort") return;
		for (const a of e.active)
			for (const b of e.active) {
				if (a.edge.polygon >= b.edge.polygon || ends(a) !== ends(b)) continue;
				const owners = ownersAt(a, trace.lines[e.row]);
				const isTheirs = o => o.polygon === a.edge.polygon || o.polygon === b.edge.polygon;
				if (owners.every(isTheirs)) meet.push({ i, row: e.row, a, b, owners });
			}
	});
	const exact = meet.filter(m => m.a.rest[0] === 0);
	const best = exact.filter(m => m.row >= 8)[1] ?? exact[0] ?? meet[0];
	return best && { ask: "shared", before: best.i + 1, meet: best };
}

/* Finds a place for *What comes next?*: the middle of a long run. */
function askNext(events) {
	const i = events.findIndex(e => e.k === "run" && e.row >= 7 && e.run.pixels >= 6);
	return i >= 0 && events[i].run.list[0].values.length > 0 && { ask: "next", before: i + 5 };
}

/* The polygon that a step is about. */
export const polygonOf = e => (e.run ?? e.span ?? e.a?.edge ?? e.edge)?.polygon;
