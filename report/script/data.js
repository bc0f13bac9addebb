/* The document that `fastphong report` wrote, in the form that the views need. */

import { $, ROOT } from "./markup.js";
import { TIMES } from "./numbers.js";

const LEVELS = { sse2: "baseline x86-64", avx512: "AVX-512" };

/* The name of an instruction set, as readers know it. */
export const levelName = ({ level }) =>
	level === "scalar" ? level : (LEVELS[level] ?? level.toUpperCase());

/* A ratio of speeds as text, with = before it if it may be a tie. */
export const ratioText = q =>
	q ? `${q.tie && q.low !== q.high ? "= " : ""}${q.median.toFixed(2)}${TIMES}` : "–";

/* The document, and the documents to compare it with. */
/** @type {ReportDocument} */
export const D = JSON.parse($("#fastphong-data").textContent);
export const DOCS = [D, ...(D.beside ?? [])];

export const BASE = D.baseline ?? "naive-phong";
const BARY = "barycentric";

/* A row of a comparison: errors in grey levels, times in ms. */
/**
 * @param {string} scene
 * @param {MethodRow} row
 */
function rowOf(
	scene,
	{
		variant,
		engine,
		error,
		own,
		speed,
		kinds,
		clamped,
		within_bound: within,
		other_polygon: other,
	},
) {
	const time = key => speed && speed.timing[key] / 1e6;
	return {
		scene,
		variant,
		engine,
		bary: engine === BARY,
		within,
		other,
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
		ms: time("median_ns"),
		p25: time("p25_ns"),
		p75: time("p75_ns"),
		rounds: speed?.timing.rounds,
		ns: speed?.ns_per_covered_pixel,
		ratio: speed?.ratio_to_naive,
		barycentric: speed?.ratio_to_barycentric,
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
			rowOf(c.name, r),
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

/* What the document has: times, several scenes, figures, a study of speed, pictures. */
export const TIMED = ROWS.some(q => q.ratio);
export const MANY = SCENES.length > 1;

export const FIGURES = D.figures ?? [];
export const FINDINGS = FIGURES.flatMap(f => f.findings.map(x => ({ ...x, figure: f })));

export const STUDY = D.speedups;
export const PICTURES = SCENES.some(s => s.drawn);
ROOT.classList.toggle("nopictures", !PICTURES);
