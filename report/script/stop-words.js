/* What each step of the figure says: a heading, a sentence, and equations with the values of the trace. */

import { nameOf } from "./marks.js";
import { html } from "./markup.js";
import { plural, sum } from "./numbers.js";
import { formulaOf } from "./terms.js";
import { letterOf } from "./traces.js";

/* Writes a value with fixed digits and a proper minus sign. */
export const fixed = (v, digits = 3) => {
	const text = v.toFixed(digits);
	return (+text === 0 ? text.replace("-", "") : text).replace("-", "−");
};
/* Writes a value as a summand, with its sign. */
export const plus = (v, digits = 3) => (v < 0 ? "− " : "+ ") + fixed(Math.abs(v), digits);
const vector = (v, digits = 2) => `(${v.map(c => fixed(c, digits)).join(", ")})`;

/* Writes a share in per cent, and as a power of ten if it is small. */
function percent(share) {
	const v = 100 * share;
	if (v === 0 || v >= 0.01) return `${fixed(v, v < 0.1 ? 2 : 1)} %`;
	const [digits, power] = v.toExponential(1).split("e-");
	return html`${digits}·10<sup>−${power}</sup> %`;
}

/* The angle of a sine and a cosine, in degrees. */
export const degreesOf = ([sin, cos]) => (Math.atan2(sin, cos) * 180) / Math.PI;
/* The angle φ of a great circle: the sum of the angle behind and the angle ahead. */
export const phiOf = ({ t, rest }) => degreesOf(t) + degreesOf(rest);

export const listed = items =>
	items.length < 2 ? items.join("") : `${items.slice(0, -1).join(", ")} and ${items.at(-1)}`;

/* The method with which all others are compared. */
export const REFERENCE = "naive-phong";

/* The titles of the questions. */
export const ASKED = {
	edges: "Which edges are active?",
	shared: "Whose pixels are these?",
	next: "What comes next?",
};

/* Each polygon's colour. */
export const polygonHue = p => `var(--h${[2, 3, 4, 1, 5, 6, 8, 9][p % 8]})`;

/* An equation: the formula, its number in the lecture, and its values. */
const equation = (formula, number, values, polygon) => html`
	<div class="s-eq" style="--c:${polygonHue(polygon)}">
		<span class="s-f">${formulaOf(formula)}</span>
		<span class="s-no">${number}</span>
		<span class="s-v">${values}</span>
	</div>`;
const bold = (name, text) => html`<b data-term="${name}">${text}</b>`;

/* A grey level is 1/255. */
export const levels = (a, b) => 255 * (a - b);
export const isLate = (d, root) => Math.abs(d / root - 1) > 2e-3;

/* -- methods: the names of each one's values, and its equations: [formula, number in the lecture, values] */

export const normalAt = (s, at) => at.slice(s.names.varyings.indexOf("Nx"));
const spaced = (values, digits = 2) => values.map(v => fixed(v, digits)).join(" ");

/* Components of normals, short enough for a table. */
const shortly = values => spaced(values).replace(/\b0\./g, ".");

/* current + Δ = next, of the term that is named. */
const added = (name, current, growth, next, digits = 3) =>
	html`${fixed(current, digits)} ${plus(growth, digits)} = ${bold(name, fixed(next, digits))}`;
/* from + t₀ · (to − from) = value at the first centre. */
const begun = (name, from, to, t0, value, digits = 3) =>
	html`${fixed(from)} + ${fixed(t0, digits)} · ${fixed(to - from)} = ${bold(name, fixed(value, digits))}`;

const ofGouraud = {
	label: "Gouraud",
	values: ["I", "ΔI"],
	shown: a => fixed(a.at[0]),
	grown: a => plus(a.by[0], 4),
	along: (a, b) => ["I_next = I_current + ΔI", "(3.6)", added("I", b.at[0], a.by[0], a.at[0])],
	begin: ({ from, to, t0 }, a) => [
		"I = I₁ + t₀ (I₂ − I₁)",
		"(3.5)",
		begun("I", from[0], to[0], t0, a.at[0]),
	],
	growth: ({ span: { left, right }, by: [growth] }) =>
		html`(${fixed(right.at[0])} − ${fixed(left.at[0])}) / ${fixed(right.x - left.x)} = ${bold("ΔI", fixed(growth, 4))}`,
	run: run => [
		["ΔI = (I₂ − I₁) / (x₂ − x₁)", "(3.5)", ofGouraud.growth(run)],
		["I = I₁ + t₀ (I₂ − I₁)", "first centre", bold("I", fixed(run.at[0], 4))],
	],
	head: "One addition",
	text: "At the pixel there is only this addition. The corners were lit before.",
	pixel: (s, { p, last, run }) => [
		last
			? ["I_next = I_current + ΔI", "(3.6)", added("I", last.values[0], run.by[0], p.values[0], 4)]
			: [
					"I = I₁ + t₀ (I₂ − I₁)",
					"(3.5)",
					begun("I", run.span.left.at[0], run.span.right.at[0], run.t0, p.values[0], 4),
				],
		[
			"ΔI = (I₂ − I₁) / (x₂ − x₁)",
			"(3.5)",
			html`${ofGouraud.growth(run)}, <br>constant along the whole run`,
		],
	],
};

const ofNaive = {
	label: "Naive Phong",
	values: ["N", "ΔN"],
	shown: a => shortly(a.at),
	grown: a => shortly(a.by),
	along: (a, b) => [
		"N_next = N_current + ΔN",
		"(4.2)",
		html`${vector(b.at)} + ${vector(a.by)} = ${bold("N", vector(a.at))}`,
	],
	begin: (entered, a) => ["N = N₁ + t₀ (N₂ − N₁)", "(4.1)", bold("N", vector(a.at))],
	run: run => [
		["ΔN = (N₂ − N₁) / (x₂ − x₁)", "(4.1)", bold("ΔN", vector(run.by, 4))],
		["N", "first centre", html`${bold("N", vector(run.at, 3))}, shorter than 1`],
	],
	head: "Three additions and a root",
	text: "A blend of two unit vectors is shorter than 1. So each pixel needs a root and a division before it is lit.",
	pixel: (s, { p, last, run }) => [
		[
			"N_next = N_current + ΔN",
			"(4.2)",
			html`${last && html`${vector(last.values)} + ${vector(run.by)} <br>= `}${bold("N", vector(p.values, 3))}`,
		],
		[
			"d = √(N · N)",
			"root",
			html`√${fixed(p.D, 4)} = ${bold("d", fixed(p.d, 4))}, N / d = ${vector(p.values.map(c => c / p.d))}`,
		],
		["I = k_a + k_d L·N + k_s (R·V)ⁿ", "(2.1)", bold("I", fixed(p.colour[0], 4))],
	],
};

/* Says how Newton's steps improved the guess, or that the pixel took a true root. */
function newtonOf(s, { p, row: y }) {
	const d = s.value(p, "d");
	const root = s.truth(y, p.x)?.d;
	const why = !p.i && s.usesNewton && ": the first pixel has no guess";
	if (p.guess.length < 2)
		return ["d = √D", "(4.4)", html`${bold("d", fixed(d, 5))}, a true root${why}`];
	const guesses = p.guess.slice(0, -1).map(g => `${fixed(g, 5)} → `);
	const mark = root && isLate(d, root) ? "bad" : "good";
	const off =
		root &&
		html` <br>true root ${fixed(root, 5)}, off by <span class="${mark}">${percent(Math.abs(d / root - 1))}</span>`;
	return [
		"d = g − (g² − D) / 2g, from g = d_current",
		"Newton",
		html`${guesses}${bold("d", fixed(d, 5))}${off}`,
	];
}

/* How far a colour is from naive Phong's. */
function offText(s, { p, row: y }) {
	const truth = s.truth(y, p.x);
	const off = truth && Math.abs(levels(p.colour[0], truth.colour[0]));
	if (!truth || off < 0.05) return truth && ": naive Phong’s within 0.05 levels";
	return html` · <span class="${off > 0.5 && "bad"}">${fixed(off, 1)} grey levels off</span>`;
}

const ofFast = {
	label: "Fast Phong",
	values: ["J, K", "ΔJ, ΔK"],
	shown: a => spaced(a.at.slice(0, 2)),
	grown: a =>
		a.by
			.slice(0, 2)
			.map(v => plus(v))
			.join(" "),
	along: (a, b) => [
		"J_next = J_current + ΔJ",
		"(4.3)",
		html`${added("J", b.at[0], a.by[0], a.at[0])}, and so do K and N`,
	],
	begin: ({ from, to, t0 }, a) => [
		"J = J₁ + t₀ (J₂ − J₁)",
		"(4.3)",
		begun("J", from[0], to[0], t0, a.at[0]),
	],
	run: ({ by: [j, k, ...n], list: [first, second] }, s) => [
		[
			"ΔJ = (J₂ − J₁) / (x₂ − x₁), and ΔK",
			"(4.3)",
			html`${bold("ΔJ", fixed(j, 4))}, ${bold("ΔK", fixed(k, 4))} · ΔN = ${vector(n.slice(-3))}`,
		],
		[
			"d = √(N · N)",
			"(4.4)",
			second?.guess.length < 2
				? "true roots on this whole run: d changes too fast for Newton"
				: html`${bold("d", fixed(s.value(first, "d"), 4))}: the only true root of this run`,
		],
	],
	head: "Additions, and a true root",
	newton:
		"The d of the pixel at the left is the guess. Newton’s step improves it: an error e becomes about e²/2.",
	text: "On this run the program’s rule takes true roots.",
	pixel(s, e) {
		const { p, last, run } = e;
		const j = last
			? added("J", last.values[0], run.by[0], p.values[0])
			: html`J = ${bold("J", fixed(p.values[0]))}`;
		return [
			[
				"J_next = J_current + ΔJ, and so for K",
				"(4.3)",
				html`${j} · K = ${bold("K", fixed(p.values[1]))} · D = N·N = ${bold("D", fixed(s.value(p, "D"), 4))}`,
			],
			newtonOf(s, e),
			[
				"I = k_a + k_d J/d + k_s (2JK/D − L·V)ⁿ",
				"(4.6)",
				html`${bold("I", fixed(p.colour[0], 4))}${offText(s, e)}`,
			],
		];
	},
};

const TURN = "sin (t + Δt)φ = sin tφ cos Δtφ + cos tφ sin Δtφ";

const ofSlerp = {
	label: "Slerp",
	values: ["N", "φ"],
	shown: a => shortly(a.at),
	grown: a => `${fixed(phiOf(a.circle), 1)}°`,
	along: (a, b) => [
		TURN,
		"(4.9)",
		html`${fixed(b.circle.t[0])} → ${bold("t", fixed(a.circle.t[0]))}, N = ${bold("N", vector(a.at))}`,
	],
	begin: (entered, a) => ["N = slerp (N₁, N₂, t₀)", "(4.7)", bold("N", vector(a.at))],
	run: ({ list: [p] }) => [
		["φ = cos⁻¹ (N₁ · N₂)", "(4.7)", html`${bold("φ", fixed(phiOf(p), 2))}°`],
		["sin Δtφ, cos Δtφ", "constants", spaced(p.step, 5)],
	],
	head: "Turned by an equal angle",
	text: "The weights move on a circle, so N keeps its length and no root is needed.",
	pixel: (s, { p, last }) => [
		[
			TURN,
			"(4.9)",
			html`${last && `${fixed(last.t[0], 4)} · ${fixed(p.step[1])} + ${fixed(last.t[1], 4)} · ${fixed(p.step[0])} = `}${bold("t", fixed(p.t[0], 4))}`,
		],
		["sin (1 − t − Δt)φ, and both cosines", "(4.10–4.12)", bold("t", fixed(p.rest[0], 4))],
		[
			"J = sin (1 − t)φ J₁ / sin φ + sin tφ J₂ / sin φ",
			"(4.8)",
			html`${fixed(p.rest[0])} · ${fixed(p.from[0])} + ${fixed(p.t[0])} · ${fixed(p.to[0])} = ${bold("J", fixed(p.values[0], 4))} <br>K = ${bold("K", fixed(p.values[1], 4))} → I = ${bold("I", fixed(p.colour[0], 4))}`,
		],
	],
};

/* Any other method: its values by their names. */
const ofOther = {
	values: ["values", "Δ"],
	shown: a => spaced(a.at.slice(0, 3)),
	grown: a => spaced(a.by.slice(0, 3)),
	along: (a, b) => [
		"next = current + Δ",
		"(3.3)",
		`${spaced(b.at.slice(0, 4))} → ${spaced(a.at.slice(0, 4))}`,
	],
	begin: (entered, a) => ["at the first centre", "", spaced(a.at.slice(0, 4))],
	run: ({ at = [] }) => [["at the first centre", "", spaced(at.slice(0, 4))]],
	head: "From the pixel at the left",
	text: "These values come from the walk along the run, and the colour comes from them.",
	pixel: (s, e) => [
		...e.p.values.slice(0, 6).map((v, i) => [s.names.pixel[i], "", html`<b>${fixed(v, 5)}</b>`]),
		["I", "(2.1)", html`${bold("I", fixed(e.p.colour[0], 4))}${offText(s, e)}`],
	],
};

export const KNOWN = {
	__proto__: null,
	gouraud: ofGouraud,
	"naive-phong": ofNaive,
	"fast-phong": ofFast,
	"slerp-phong": ofSlerp,
};
export const wordsOf = method => KNOWN[method] ?? { ...ofOther, label: nameOf(method) };

/* -- steps: what each kind of step says */

const rowsOf = (list, polygon) => html`${list.filter(Boolean).map(e => equation(...e, polygon))}`;
const ceiling = v => html`⌈${fixed(v)} − ½⌉`;

export const TELL = {
	bucket({ edge }, s) {
		const [[x1, y1], [x2, y2]] = [s.corners[edge.top], s.corners[edge.bottom]];
		const first = s.crossing(edge);
		return {
			line: 0,
			kicker: "Edge table",
			head: edge.crosses
				? `Edge ${edge.name} waits beside line ${edge.first}`
				: `Edge ${edge.name} crosses no line`,
			text: edge.crosses
				? "That is the first line whose centre it crosses. It plays no part before."
				: "It lies between the centres of two lines, or it is horizontal. It is left out, because its neighbours close the polygon without it.",
			eqs: rowsOf(
				[
					[
						"first line = ⌈y_top − ½⌉",
						"",
						html`${ceiling(y1)} = <b>${edge.first}</b>, end ${ceiling(y2)} = <b>${edge.end}</b>`,
					],
					first && [
						"Δx = (x₂ − x₁) / (y₂ − y₁)",
						"(3.4)",
						html`${fixed(x2 - x1)} / ${fixed(y2 - y1)} = ${bold("Δx", fixed(first.dx))} a line`,
					],
				],
				edge.polygon,
			),
		};
	},
	empty: e => ({
		line: 1,
		kicker: "Next line",
		head: `Line ${e.row}: nothing`,
		text: "No edge begins here and none is active, so the line costs nothing.",
	}),
	retire: (e, s) => ({
		line: 2,
		kicker: "Active edges",
		head: `${listed(e.gone.map(g => g.name))} ${e.gone.length > 1 ? "end" : "ends"} before line ${e.row}`,
		text: "An edge leaves when the line’s centre is no longer above the edge’s lower end. It is not stepped again.",
		eqs: html`${e.gone.slice(0, 2).map(g => equation(`${g.name}: end ≤ line`, "", html`${ceiling(s.corners[g.bottom][1])} = <b>${g.end}</b> ≤ ${e.row}`, g.polygon))}`,
	}),
	step(e, s) {
		const [a] = e.active;
		const b = e.old.find(o => o.edge.id === a.edge.id);
		return {
			line: 3,
			kicker: "Along the edges",
			head: `${e.active.length > 1 ? `All ${e.active.length} edges step` : `Edge ${a.edge.name} steps`} to line ${e.row}`,
			text: `One line down, each active edge adds its own Δ to its x and its ${s.words.values[0]}. Here is edge ${a.edge.name}:`,
			eqs: rowsOf(
				[["x_next = x_current + Δx", "(3.3)", added("x", b.x, a.dx, a.x)], s.words.along(a, b)],
				a.edge.polygon,
			),
		};
	},
	enter({ a, entered, row: y }, s) {
		const [[, y1], [, y2]] = [s.corners[a.edge.top], s.corners[a.edge.bottom]];
		const down = fixed(y + 0.5 - y1);
		return {
			line: 4,
			kicker: "Active edges",
			head: `Edge ${a.edge.name} becomes active`,
			text: `Its bucket is line ${y}. It starts at the centre of the line, ${+down ? `${down} below` : "exactly at"} its upper end.`,
			eqs: rowsOf(
				[
					[
						"t₀ = (y_centre − y₁) / (y₂ − y₁)",
						"",
						html`${down} / ${fixed(y2 - y1)} = ${bold("t", fixed(entered.t0))}`,
					],
					s.words.begin(entered, a),
				],
				a.edge.polygon,
			),
		};
	},
	sort({ active }) {
		const polygons = [...new Set(active.map(a => a.edge.polygon))];
		const line = p => {
			const own = active.filter(a => a.edge.polygon === p);
			const places = own.map((a, i) => [i > 0 && " ≤ ", bold("x", fixed(a.x))]);
			return equation(own.map(a => a.edge.name).join(" … "), "", html`${places}`, p);
		};
		return {
			line: 5,
			kicker: "Sort",
			head: "From left to right, polygon by polygon",
			text: "Two neighbours of a polygon are the ends of a span. Crossings are compared as fractions of whole numbers: no rounding can swap them.",
			eqs: html`${polygons.map(line)}`,
		};
	},
	span({ span: { polygon, left, right, start, end, none, t0, dt } }) {
		const told = { line: 6, kicker: "Span" };
		if (none)
			return {
				...told,
				head: `${letterOf(polygon)}: no pixel centre between its edges`,
				text: "So nothing is drawn, and nothing is lost: the centre belongs to a neighbour.",
				eqs: rowsOf(
					[["⌈x₁ − ½⌉ = ⌈x₂ − ½⌉", "", html`x₁ = ${fixed(left.x)}, x₂ = ${fixed(right.x)}`]],
					polygon,
				),
			};
		return {
			...told,
			head: `${letterOf(polygon)} covers ${end - start > 1 ? `pixels ${start} to ${end - 1}` : `pixel ${start}`}`,
			text: "A pixel belongs to the span if its centre is on the left crossing or right of it, and left of the right crossing. So no pixel is drawn twice or skipped.",
			eqs: rowsOf(
				[
					[
						"first = ⌈x₁ − ½⌉, end = ⌈x₂ − ½⌉",
						"",
						html`${ceiling(left.x)} = <b>${left.pixel}</b>, ${ceiling(right.x)} = <b>${right.pixel}</b> <br>The centre of pixel ${left.pixel} is ${left.rest[0] ? `${left.rest[0]}/${left.rest[1]} right of x₁` : "exactly at x₁"}.`,
					],
					[
						"Δt = 1 / (x₂ − x₁)",
						"Δx = 1",
						html`1 / (${fixed(right.x)} − ${fixed(left.x)}) = <b>${fixed(dt, 4)}</b>, t₀ = ${bold("t", fixed(t0, 4))}`,
					],
				],
				polygon,
			),
		};
	},
	depth({ span: { polygon, depth }, tests }) {
		const contested = tests.filter(t => t.old);
		const won = contested.filter(t => t.seen).length;
		const lost = contested.length - won;
		const turn = contested.find((t, i) => i && contested[i - 1].seen !== t.seen) ?? contested[0];
		const name = letterOf(polygon);
		const heads = [
			won && lost && `${name} wins ${won}, loses ${lost}`,
			lost && `${name} is hidden here`,
			won && `${name} hides ${plural(won, "pixel")}`,
		];
		return {
			line: 7,
			kicker: "Depth test",
			head: heads.find(Boolean) || `Nothing is in front of ${name}`,
			text: turn
				? "At each pixel the nearer polygon wins, before anything is shaded. The letters show which one is visible."
				: "An empty line is infinitely far away, so every pixel is visible. Nothing is shaded yet.",
			eqs: rowsOf(
				[
					[
						"q_next = q_current + Δq",
						"(3.3)",
						`from ${fixed(depth[0], 4)} by ${fixed(depth[1], 5)} a pixel`,
					],
					turn && [
						`pixel ${turn.x}: is q < stored?`,
						"",
						html`${fixed(turn.z, 4)} ${turn.seen ? "<" : "≥"} ${fixed(turn.old.z, 4)}: <b>${letterOf(turn.seen ? polygon : turn.old.polygon)}</b> is visible`,
					],
				],
				polygon,
			),
		};
	},
	run: ({ run }, s) => ({
		line: 8,
		kicker: "Run",
		head: `${plural(run.pixels, "visible pixel")} of ${letterOf(run.polygon)}`,
		text: "All divisions are done here, once. From now on each pixel follows from the one at its left.",
		eqs: rowsOf(s.words.run(run, s), run.polygon),
	}),
	pixel(e, s) {
		const { p, run } = e;
		const steps = p.guess.length - 1;
		const { head, text, newton, pixel } = s.words;
		return {
			line: 9,
			kicker: `Pixel ${p.x} of line ${e.row}, in ${letterOf(run.polygon)}`,
			head:
				steps > 0
					? `Additions, and ${plural(steps, "Newton step")}`
					: head,
			text: !p.i
				? "The first centre is not at x₁ but a little right of it: t₀ says how far."
				: steps > 0
					? newton
					: text,
			eqs: rowsOf(pixel(s, e), run.polygon),
		};
	},
	end: () => ({
		line: 10,
		kicker: "Done",
		head: "All lines are drawn",
		text: "Every pixel was written once or not at all, and hidden pixels were never shaded. Now move a corner, or choose another method.",
	}),
	ask: e => ({
		line: { edges: 2, shared: 6, next: 9 }[e.ask],
		kicker: "Your turn to predict",
		head:
			e.ask === "edges"
				? `Which edges are active on line ${e.target.row}?`
				: ASKED[e.ask],
	}),
};

/* Says in a sentence what the whole picture costs, counted in the trace. */
export function answerOf(s) {
	const pixels = s.events.filter(e => e.p).map(e => e.p);
	if (!pixels.length)
		return html`<b class="s-m">${s.words.label}</b> has nothing to fill: no pixel centre lies inside a polygon.`;
	const newton = sum(pixels.map(p => Math.max(0, p.guess.length - 1)));
	const roots = pixels.filter(p => p.guess.length < 2).length;
	const off = s.worst();
	const far =
		off == null
			? ""
			: off < 0.05
				? html` Its picture is naive Phong’s.`
				: html` Off by at most <b>${fixed(off, 1)} grey levels</b>.`;
	const costs = {
		gouraud: html`with <b>one addition each</b>. Everything else happens at corners and edges. Stop it anywhere and look.`,
		"naive-phong": html`with <b>three additions each</b>, and then pays for <b>${pixels.length} roots</b> and all of the light at each pixel.`,
		"fast-phong": html`with <b>five additions each</b> and <b>${plural(newton, "Newton step")}</b> in place of ${pixels.length} roots: <b>${roots} are left</b>.${far}`,
		"slerp-phong": html`along circles: <b>four additions and eight products each</b>, and <b>no root at a pixel</b>.`,
	};
	return html`<b class="s-m">${s.words.label}</b> fills <b>${plural(pixels.length, "pixel")}</b> ${costs[s.method] ?? html`.${far}`}`;
}
