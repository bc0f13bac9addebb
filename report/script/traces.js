/* Traces: what the engine did on each line of a picture, by each method (schema fastphong.trace/1). The page stores the traces of the
   figure that can be stopped. When the reader moves a corner, the module makes new ones. */

import { $ } from "./markup.js";
import { figureStudio, inflate, jsonOf } from "./studio.js";

let storedTraces;

/* True if the page has traces, and this browser can unpack them. */
export const hasTraces = () => !!$("#figure-traces") && "DecompressionStream" in window;

/* Unpacks the stored traces, once: a trace for each variant of a method. */
export const tracesOf = () =>
	(storedTraces ??= inflate(jsonOf("figure-traces")).then(bytes =>
		JSON.parse(new TextDecoder().decode(bytes)),
	));

/* Traces the mesh with its corners at x1 y1 x2 y2 …, in pixels, by a variant of a method. */
export async function traceBy(variant, corners) {
	const studio = await figureStudio();
	return studio.trace(variant, corners);
}

/* Names edges for readers: by the letter of the polygon and the number of the edge. */
export const letterOf = polygon => String.fromCharCode(65 + (polygon % 26));
export const edgesOf = trace =>
	trace.edges.map((edge, id) => ({
		...edge,
		id,
		name: letterOf(edge.polygon) + (edge.corner + 1),
	}));

/* Where a crossing is, in pixels, and how far it moves from line to line. In the trace both are fractions of whole numbers. */
export const crossingOf = ({ pixel, rest: [rest, whole], step: [pixels, more] }) => ({
	x: pixel + 0.5 - rest / whole,
	dx: pixels + more / whole,
});

/* The pixels of a run, each with everything that the trace knows about it. */
/** @param {any} run */
export const pixelsOf = ({ x, pixels, values, colours, inside = {} }) =>
	Array.from({ length: pixels }, (_, i) => ({
		x: x + i,
		i,
		values: values?.[i] ?? [],
		colour: colours[i],
		// The first pixel takes a true root, which Newton's steps no longer change.
		guess: (i && inside.guess?.[i]) || [],
		d: [inside.d?.[i]].flat()[0],
		D: [inside.D?.[i]].flat()[0],
		t: inside.t?.[i],
		rest: inside.rest?.[i],
		step: inside.step?.[i],
		from: inside.from?.[i],
		to: inside.to?.[i],
	}));
