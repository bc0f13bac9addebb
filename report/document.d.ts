/* Types of what the page's script reads: the document, which docs/bench-json.md describes, and the
   functions of the module. Fields that the script does not read are not here. */

interface ReportDocument {
	baseline?: string;
	beside?: ReportDocument[];
	command_line: string[];
	compared: string;
	comparisons?: Comparison[];
	date: string | null;
	figures?: Figure[];
	machine: Machine;
	methods?: Method[];
	scaling?: Scaling;
	schema: string;
	seconds: number | null;
	small?: { command: string; spans: SmallLoop[] };
	speedups?: Speedups;
	timed: string;
}

interface Machine {
	arch: string;
	commit: string | null;
	cores: number;
	cpu: string;
	opt_level: string;
	os: string;
	profile: string;
	rustc: string;
	target_features: string[];
	version: string;
}

interface Comparison {
	name: string;
	title: string;
	description: string;
	width: number;
	height: number;
	encoding: "linear" | "srgb";
	interpolation: string;
	lights: number;
	polygons: number;
	not_simple: number;
	covered_pixels: number;
	clamping: { clamped: number; covered: number } | null;
	stats: Record<string, number>;
	triangulation: { difference: Errors } | null;
	renderer: { engine: string; level: string; threads: number };
	rows: MethodRow[];
	barycentric: MethodRow[];
	noise: Noise | null;
}

/* A method on a scene. Errors are in parts of 1. */
interface MethodRow {
	variant: string;
	engine: string;
	error: Errors;
	own: Errors;
	speed: {
		timing: Timing;
		ns_per_covered_pixel: number;
		ratio_to_naive: Ratio | null;
		ratio_to_barycentric: Ratio | null;
		work_to_naive?: Ratio | null;
	} | null;
	kinds?: { name: string; polygons: number }[];
	clamped: number;
	within_bound: boolean;
	other_polygon: number;
}

interface Errors {
	max: number;
	rms: number;
	p99: number;
	psnr: number | null;
	ssim: number | null;
	over_one_level: number;
	worst: [number, number] | null;
}

/* A time without its samples, which the page does not have. */
interface Timing {
	typical_ns: number;
	low_ns: number;
	high_ns: number;
}

interface Ratio {
	typical: number;
	low: number;
	high: number;
	tie: boolean;
}

/* How far times can be trusted. */
interface Noise {
	trust: "quiet" | "busy" | "too-busy";
	clock: "thread" | "passed";
	interrupted: number;
	rounds: number;
	doubt: number;
	sentence: string;
}

interface Method {
	name: string;
	label: string;
	title: string;
	family: string;
	source: string;
	formula: string;
	fails: string;
	perspective: string;
	local: string;
	operations: Operations[];
	/* What `marks.js` adds. */
	hue?: string;
	shape?: string;
	filling?: number;
	head?: boolean;
	key?: string;
	scene?: any;
	worst?: any;
	max?: number;
	speed?: Ratio | null;
}

/* Operations of each kind that a method does once for each of these. */
interface Operations {
	walk: number[];
	shade: number[];
	span: number[];
	edge: number[];
	edge_step: number[];
	vertex: number[];
	polygon: number[];
}

interface Speedups {
	mesh: string;
	size: [number, number];
	span: number;
	corners: { work: "frame" | "kernel"; scalar: boolean; level: string; lights: number }[];
	methods: SpeedupRow[];
	noise: Noise | null;
}

interface SpeedupRow {
	method: string;
	levels_off: number;
	corners: { timing: Timing; ratio_to_naive: Ratio | null }[];
}

interface Scaling {
	at: [number, number];
	of: number;
	points: {
		asked: number;
		away: boolean;
		pixels: number;
		size: [number, number];
		triangles: number;
		noise: Noise | null;
	}[];
	curves: {
		engine: string;
		method: string;
		times: (Timing | null)[];
	}[];
}

interface SmallLoop {
	method: string;
	at_32_pixels_15_degrees: number[];
	worst_error: number[];
}

/* A figure of the lectures. */
interface Figure extends FigureContent {
	name: string;
	title: string;
	lecture: string;
	live?: { claim: string; handles: Handle[] };
}

interface FigureContent {
	blocks: Block[];
	findings: Finding[];
}

/* A part of a figure: one of these. */
interface Block {
	text?: string;
	table?: { head: string[]; rows: string[][] };
	plot?: Plot;
	pictures?: {
		columns: number;
		shown: { caption: string; alt: string }[];
		outlines?: [number, number][][];
	};
	trace?: any;
}

interface Plot {
	title: string;
	caption?: string;
	x: string[];
	y: string[];
	marks: number[];
	series: Series[];
}

interface Series {
	label: string;
	points: [number, number][];
	colour?: string;
	kind?: string;
}

interface Finding {
	key: string;
	label: string;
	value: number;
	unit: string;
	verdict: string;
	agreement: "confirms" | "adds" | "contradicts";
	/* What `data.js` adds. */
	figure?: Figure;
}

interface Handle {
	name: string;
	label: string;
	unit: string;
	axis: "x" | "y" | null;
	range: [number, number];
	start: number;
	step: number;
}

/* The functions of `live/src/lib.rs`. Addresses and lengths are in bytes. */
interface LiveModule {
	memory: WebAssembly.Memory;
	text(length: number): number;
	said(): number;
	file(): void;
	load(width: number, height: number): number;
	notes(): number;
	turned(): number;
	light(): number;
	frame(
		width: number,
		height: number,
		azimuth: number,
		elevation: number,
		size: number,
		x: number,
		y: number,
		z: number,
		exponent: number,
		samples: number,
	): number;
	scene(): number;
	draw(exact: number): number;
	picture(): number;
	compare(): number;
	errors(): number;
	parameters(): number;
	trace(): number;
	figure(): number;
	panel(index: number): number;
}
