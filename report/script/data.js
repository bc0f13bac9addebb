/* The document that `fastphong report` wrote, in the form that the views need. */

import { $, ROOT, sentence } from "./markup.js";
import { mean, plural, TIMES } from "./numbers.js";

const LEVELS = { sse2: "baseline x86-64", avx512: "AVX-512" };

/* The name of an instruction set, as readers know it. */
export const levelName = ({ level }) =>
	level === "scalar" ? level : (LEVELS[level] ?? level.toUpperCase());

/* A ratio of speeds as text, with the digits that its interval leaves known, and = before it if it may be a tie. */
export function ratioText(q) {
	const half = q && (q.high - q.low) / 2;
	if (!q || half > 0.3 * q.typical) return "–";
	const digits = half >= 0.5 ? 0 : half >= 0.05 ? 1 : 2;
	const about = half > 0.05 * q.typical ? "about " : "";
	const tie = q.tie && half ? "= " : "";
	return `${tie}${about}${q.typical.toFixed(digits)}${TIMES}`;
}

/* The geometric mean of ratios. */
export function meanRatio(list) {
	const [typical, low, high] = ["typical", "low", "high"].map(k => mean(list.map(q => q[k])));
	// As Ratio::SURE: faster or slower needs a wider interval than the one that is shown.
	const wider = end => typical * (end / typical) ** (3.09 / 1.96);
	return { typical, low, high, tie: wider(low) <= 1 && wider(high) >= 1 };
}

/* True if the machine was too busy for the times of a scene or an experiment. They are then not shown. */
export const isTooBusy = of => of?.noise?.trust === "too-busy";

/* Says how far times can be trusted, and how many are left out. */
export const trustText = ({ noise }) => (noise ? `${sentence(noise.sentence)}.` : "");
export const leftOut = (n, one) => (n ? `Too busy to time: ${plural(n, one)}.` : "");

/* The document, and the documents to compare it with. */
/** @type {ReportDocument} */
export const D = JSON.parse($("#fastphong-data").textContent);
export const DOCS = [D, ...(D.beside ?? [])];

export const BASE = D.baseline ?? "naive-phong";
const BARY = "barycentric";

/* A row of a comparison: errors in grey levels, times in ms. */
/**
 * @param {Comparison} c
 * @param {MethodRow} row
 */
function rowOf(c, row) {
	const { variant, engine, error, own, kinds, clamped } = row;
	const speed = isTooBusy(c) ? null : row.speed;
	const time = key => speed && speed.timing[key] / 1e6;
	return {
		scene: c.name,
		variant,
		engine,
		bary: engine === BARY,
		within: row.within_bound,
		other: row.other_polygon,
		clamped,
		kinds,
		max: error.max * 255,
		rms: error.rms * 255,
		p99: error.p99 * 255,
		own: own.max * 255,
		over1: error.over_one_level,
		psnr: error.psnr,
		ssim: error.ssim,
		worst: error.worst,
		ms: time("typical_ns"),
		msLow: time("low_ns"),
		msHigh: time("high_ns"),
		ns: speed?.ns_per_covered_pixel,
		ratio: speed?.ratio_to_naive,
		barycentric: speed?.ratio_to_barycentric,
		work: isTooBusy(c) ? row.speed?.work_to_naive : null,
	};
}

/* The scenes by their ids, which are parts of addresses, and in the order of the document. */
export const S = Object.create(null);

export const SCENES = (D.comparisons ?? []).map((c, number) => {
	const plain = c.name.replace(/[^A-Za-z0-9]+/g, "-").replace(/^-|-$/g, "");
	const id = plain && !S[plain] ? plain : `scene-${number + 1}`;
	const rows = Object.fromEntries(
		[...c.rows, ...c.barycentric].map(r => [
			(r.engine === BARY ? "bary:" : "") + r.variant,
			rowOf(c, r),
		]),
	);
	return (S[id] = {
		...c,
		id,
		number,
		rows,
		list: c.rows.map(r => r.variant),
		title: c.title || c.name,
		w: c.width,
		h: c.height,
		drawn: !!$(`#pictures-${number}`),
	});
});

export const ROWS = SCENES.flatMap(s => Object.values(s.rows));

/* The methods, their names, and the methods by name. */
export const METHODS = D.methods ?? [];
export const IDS = METHODS.map(m => m.name);
export const M = Object.fromEntries(METHODS.map(m => [m.name, m]));

/* What the document has: speeds that can be told, scenes without them, several scenes, figures, a study of speed, pictures. */
export const TIMED = ROWS.some(q => q.ratio);
export const UNTOLD = SCENES.filter(isTooBusy).length;
export const NOISES = SCENES.map(s => s.noise).filter(Boolean);
export const MANY = SCENES.length > 1;

export const FIGURES = D.figures ?? [];
export const FINDINGS = FIGURES.flatMap(f => f.findings.map(x => ({ ...x, figure: f })));

export const STUDY = D.speedups;
export const PICTURES = SCENES.some(s => s.drawn);
ROOT.classList.toggle("nopictures", !PICTURES);
