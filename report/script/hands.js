/* Your own hands: exercises that the reader programs. The reader's code runs in a worker, and its values are compared with the engine's. */

import { line, svg, text } from "./charts.js";
import { FIGURES } from "./data.js";
import { $, fill, html } from "./markup.js";
import { clamp } from "./numbers.js";
import { tracesOf } from "./traces.js";
import { DEGREES } from "./turn.js";

/* How many milliseconds the reader's code may run, and how many a worker may take to start. */
const HANDS_LIMIT = 500;
const HANDS_START = 5000;

/* A list of n values: the first one, and then what a function makes of the previous one. */
const walked = (n, first, next) => {
	const list = [first];
	for (let k = 1; k < n; k++) list.push(next(list[k - 1], k));
	return list;
};

/* Common mistakes with a value that grows by Δ per pixel: the values that each leads to, and what was done wrong. */
const slips = (name, n, first, by) => {
	const steps = (from, step) => walked(n, from, v => v + step);
	return [
		[steps(first, 0), `nothing is added${name && ` to ${name}`}`],
		[steps(first, 2 * by), `Δ${name} is added twice`],
		[steps(first, -by), `Δ${name} is subtracted`],
		[steps(first + by, by), `Δ${name} is added before pixel() is called`],
	];
};

/* Reads a column of the table of Lecture 21's exercises: a value for each pixel. */
function column(name) {
	const { blocks } = FIGURES.find(f => f.name === "exercises");
	const { head, rows } = blocks.find(b => b.table?.head[0] === "pixel").table;
	return rows.map(row => [+row[head.indexOf(name)]]);
}

/* Finds a run of a trace: its pixels, and where its edges cross the line. */
async function runOf(variant, y, x) {
	const { active, runs, spans } = (await tracesOf())[variant].lines[y];
	const run = runs.find(r => r.x === x);
	const { left, right } = spans[run.span];
	const ends = [left, right].map(id => {
		const { pixel, rest, at } = active.find(a => a.edge === id);
		return [pixel + 0.5 - rest[0] / rest[1], at[0]];
	});
	return { ...run, n: run.pixels, ends };
}

const loop = (before, ...body) =>
	`${before}\nfor (let i = 0; i < n; i++) {\n${body.map(l => `\t${l}\n`).join("")}}`;

/* The exercises. Each has the values to start from (`given`), the code to start with and a solution (`texts`), the names of the
   values of a pixel, the engine's values, common mistakes for each value (`slips`), and a sentence on what it teaches. */
const EXERCISES = {
	"3.6": async () => {
		const { x, n, at, by, values, ends } = await runOf("gouraud", 6, 3);
		const [[x1, I1], [x2, I2]] = ends;
		const [first, ΔI] = [at[0], by[0]];
		const steps = (from, step) => walked(n, from, v => v + step);
		const text = (Δ, next) =>
			loop(`const ΔI = ${Δ};  // (3.5)\nlet current = first;  // at the first pixel`, "pixel(current);", `const next = ${next};  // (3.6)`, "current = next;");
		return {
			given: { I1, I2, x1, x2, first, n },
			texts: [text(0, "current"), text("(I2 - I1) / (x2 - x1)", "current + ΔI")],
			names: ["I"],
			x,
			values,
			range: [0, 0.6],
			slips: [
				[
					...slips("I", n, first, ΔI),
					[steps(I1, ΔI), "I starts at x₁, not at the centre of the first pixel"],
					[steps(first, (I2 - I1) / n), "I₂ − I₁ is divided by the number of pixels, not by x₂ − x₁"],
					[steps(first, I2 - I1), "I₂ − I₁ is not divided by x₂ − x₁"],
				],
			],
			learnt: "One addition a pixel, and nothing else.",
		};
	},
	"4.4": async () => {
		const { x, n, at, by, values } = await runOf("fast-phong:steps=1", 9, 5);
		const [[J, K, ...N], [ΔJ, ΔK, ...ΔN], [, , d]] = [at, by, values[0]];
		const D = values.map(v => v[3]);
		const F = (v, k) => v * v - D[k];
		const newton = (v, k) => v - F(v, k) / (2 * v);
		const text = (...parts) =>
			loop(
				"// In place of the root: one step of Newton’s method for x² = D",
				"pixel(J, K, d);",
				...["J = ", "K = ", "N = N.map((v, k) => "].map((l, i) => l + parts[i]),
				"const D = N[0] * N[0] + N[1] * N[1] + N[2] * N[2];",
				`d = ${parts[3]};`,
			);
		return {
			given: { J, ΔJ, K, ΔK, N, ΔN, d, n },
			texts: [text("J;", "K;", "v);", "d"), text("J + ΔJ;", "K + ΔK;", "v + ΔN[k]);", "d - (d * d - D) / (2 * d)")],
			names: ["J", "K", "d"],
			x,
			values,
			slips: [
				slips("J", n, J, ΔJ),
				slips("K", n, K, ΔK),
				[
					[walked(n, d, v => v), "d or N does not change"],
					[D.map(Math.sqrt), "this is the root itself, which Newton’s step only approaches"],
					[walked(n, d, (v, k) => v - F(v, k)), "F(x) is not divided by 2x"],
					[walked(n, d, (v, k) => v - F(v, k) / v), "F(x) is divided by x, not by 2x"],
					[walked(n, d, (v, k) => v + F(v, k) / (2 * v)), "F(x) / 2x is added, not subtracted"],
					[walked(n, d, (v, k) => newton(v, k - 1)), "D is still the previous pixel’s: step N first"],
					[walked(n, d, (v, k) => newton(newton(v, k), k)), "these are two Newton steps"],
				],
			],
			learnt: "Five additions and one Newton step, and no root. N turns fast here, so a single step lags behind, and so does the engine’s d.",
		};
	},
	"exercise 1": async () => {
		const values = column("intensity");
		const n = values.length;
		const [sin24, sin25] = [0.40674, 0.42262];
		const text = (Δ, next) => loop(`const Δ = ${Δ};\nlet current = sin24;`, "pixel(current);", `current = ${next};`);
		return {
			given: { sin24, sin25, n },
			texts: [text(0, "current"), text("(sin25 - sin24) / 10", "current + Δ")],
			names: ["sin"],
			x: 0,
			values,
			range: [0.4, 0.425],
			slips: [
				[
					...slips("", n, sin24, (sin25 - sin24) / 10),
					[walked(n, sin24, v => v + sin25 - sin24), "a whole degree is added, but a pixel is a tenth of a degree"],
					[values.map((_, k) => Math.sin((24 + k / 10) / DEGREES)), "this is the sine itself: interpolate between the lines of the table instead"],
				],
			],
			learnt: `Pixel 3 answers the exercise: sin 24.3° is about ${values[3][0].toFixed(4)}.`,
		};
	},
	"exercise 2": async () => {
		const values = column("e to the t");
		const [n, Δt, factor] = [values.length, -0.25, Math.exp(-0.25)];
		const text = (factor, next) => loop(`const factor = ${factor};\nlet current = 1;`, "pixel(current);", `current = ${next};`);
		return {
			given: { Δt, n },
			texts: [text(1, "current"), text("Math.exp(Δt)", "current * factor")],
			names: ["eᵗ"],
			x: 0,
			values,
			slips: [
				[
					[walked(n, 1, v => v), "nothing is multiplied"],
					[walked(n, 1, v => v * Δt), "the factor is Δt, but should be e to the Δt"],
					[walked(n, 1, v => v + Δt), "Δt is added, but eᵗ changes by a factor"],
					[walked(n, 1, v => v / factor), "t grows, but should fall by a quarter per pixel"],
					[walked(n, factor, v => v * factor), "the factor is applied before pixel() is called"],
				],
			],
			learnt: "One multiplication per pixel. So fog needs no exponential.",
		};
	},
};

/* How far a right value may be from the engine's, at pixel k, for values of this size. The engine works in f32. Each of k additions
   rounds by half a unit in the last place, which is 2⁻²⁴ of the value. With products the factor is rounded, too, so that k products
   make 2k roundings. At most eight roundings come before: of t₀, Δt, differences, and Newton's step. The reader's f64 adds nothing
   that matters. The three components of N carry their roundings into d, which makes at most √3 times as many. 2 · (2k + 8) · 2⁻²⁴
   covers all of these. */
const handsTolerance = (k, size) => 2 * (2 * k + 8) * 2 ** -24 * size;

/* Finds the first wrong value of the reader's code, and guesses why. Returns nothing if all are right. */
function firstWrong({ names, values, slips }, all) {
	const size = Math.max(...values.flat().map(Math.abs));
	for (const [k, given] of all.slice(0, values.length).entries())
		for (const [c, name] of names.entries()) {
			const [is, should] = [given[c], values[k][c]];
			if (Math.abs(is - should) <= handsTolerance(k, size)) continue;
			const isAlike = (v, i) => i >= all.length || Math.abs(v - all[i][c]) < 1e-5;
			const slip = Number.isFinite(is) ? slips[c].find(([list]) => list.every(isAlike)) : [0, /^“/.test(is) ? "this is a text, not a number" : "this is not a number"];
			return { k, c, name, is, should, why: slip?.[1] };
		}
}

/* Writes two values with as many digits as they need to look different. */
function apart(...pair) {
	const shown = digits => pair.map(v => (Number.isFinite(v) ? v.toFixed(digits).replace("-", "−") : String(v)));
	const enough = [4, 5, 6, 7].find(digits => shown(digits)[0] !== shown(digits)[1]);
	return shown(enough ?? 8);
}

/* Starts a worker that runs the reader's code, with the given values under their names. The code begins on the worker's third line,
   which `runHands` subtracts from the lines of errors. The page's policy holds in the worker, too, so it reaches no network. What it
   posts is short, whatever the code does. */
function handsWorker(given, text) {
	const source = `"use strict";onerror=(m,u,line)=>{postMessage({says:m.slice(0,120),line});return true};postMessage("begins");const all=[];let exps=0;{const e=Math.exp;Math.exp=x=>(exps++,e(x))}const plain=x=>typeof x=="number"?x:typeof x=="string"?"“"+x.slice(0,20)+"”":Array.isArray(x)?"a list":typeof x;
(function({${Object.keys(given)}},pixel){
${text}
})(${JSON.stringify(given)},(...v)=>{if(all.push(v.slice(0,5).map(plain))>999)throw Error("pixel() was called more than 999 times")});postMessage({all,exps})`;
	const url = URL.createObjectURL(new Blob([source]));
	setTimeout(() => URL.revokeObjectURL(url), HANDS_START);
	return new Worker(url);
}

/* Runs the reader's code until a signal ends it. Resolves to its pixels, or fails with an error and its line. */
const runHands = (given, text, signal) =>
	new Promise((done, fail) => {
		const worker = handsWorker(given, text);
		let timer;
		const end = (settle, value) => {
			clearTimeout(timer);
			worker.terminate();
			settle(value);
		};
		const limit = (ms, says) => {
			clearTimeout(timer);
			timer = setTimeout(() => end(fail, Error(says)), ms);
		};
		// Firefox does not say where a syntax error is, so there may be no line.
		const fails = (says, at) => {
			if (!Number.isFinite(at)) return end(fail, Error("This is not JavaScript yet: look for a missing bracket or quote"));
			const line = clamp(at - 2, 1, text.split("\n").length);
			const short = says.replace("Uncaught ", "").replace(/(?<=^[^]{90})[^]+/, "…");
			end(fail, Object.assign(Error(`Line ${line}: ${short}`), { line }));
		};
		limit(HANDS_START, "No worker starts here");
		signal.onabort = () => end(() => {});
		worker.onmessage = ({ data }) => {
			if (data === "begins") limit(HANDS_LIMIT, "Stopped after half a second: does the loop end?");
			else if (Array.isArray(data?.all)) end(done, data);
			else if (data?.says) fails(String(data.says), data.line);
		};
		worker.onerror = e => {
			e.preventDefault();
			fails(e.message, e.lineno);
		};
	});

/* Draws bars for the reader's values, and dots for the engine's: a row for each name. */
function handsStrip({ names, values, x, range: [low, high] = [0, 1] }, all, wrong) {
	const [W, H, l] = [44, 74, 34];
	const at = k => l + W * k;
	const y = v => H - 10 - (H - 18) * clamp((v - low) / (high - low), -0.05, 1.1);
	const bar = (v, k, c) => {
		const grey = Math.round(255 * clamp(v, 0, 1));
		const isWrong = wrong?.k === k && wrong.c === c;
		return html`<rect ${isWrong && html`class="wrong"`} x="${at(k) + 3}" y="${Math.min(y(v), y(low))}" width="${W - 6}" height="${Math.abs(y(v) - y(low))}" fill="rgb(${grey},${grey},${grey})"/>`;
	};
	const row = (name, c) => html`
		<g transform="translate(0,${c * H})">
			${text(l - 8, H / 2, name, "end")}
			${line(l, y(low), at(values.length), y(low), "range")}
			${all.slice(0, values.length).map((v, k) => Number.isFinite(v[c]) && bar(v[c], k, c))}
			${values.map((v, k) => html`<circle cx="${at(k + 0.5)}" cy="${y(v[c])}" r="4.5"/>`)}
		</g>`;
	const below = values.map((_, k) => text(at(k + 0.5), H * names.length + 6, x + k, "tick mid"));
	const list = (all, c) => all.slice(0, values.length).map(v => +v[c]?.toFixed?.(4)).join(", ") || "none";
	const told = names.map((name, c) => ` ${name} from pixel ${x} on: yours ${list(all, c)}; the engine’s ${list(values, c)}.`);
	return svg(at(values.length) + 4, H * names.length + 12, `Bars: your pixels. Dots: the engine’s.${told.join("")}`, [names.map(row), below]);
}

/* Says what is wrong, in a sentence or two. Returns nothing if all is right. */
function judgement(own, { all, exps }, wrong) {
	const n = own.values.length;
	if (wrong) {
		const [should, is] = apart(wrong.should, wrong.is);
		const name = own.names.length > 1 && html`, ${wrong.name}`;
		return html`Pixel ${own.x + wrong.k}${name}: it should be <b>${should}</b>, yours is <b>${is}</b>${wrong.why && `: ${Number.isFinite(wrong.is) ? "it seems that " : ""}${wrong.why}`}.`;
	}
	if (all.length !== n) return `Your code called pixel() ${all.length} times, but there are ${n} pixels.`;
	if (exps > 2) return `All ${n} pixels are right, but your code called the exponential ${exps} times: once is enough.`;
}

/* Keeps the reader's code while the window is open, where the browser allows it. */
function handsKept(name, text) {
	try {
		if (text != null) sessionStorage.setItem(name, text);
		return sessionStorage.getItem(name);
	} catch {
		return null; // a file opened from disk may have no storage
	}
}

/* Puts an exercise into an element, once. Where it cannot run, the element keeps its text. */
export async function handsInto(el, name) {
	if (!EXERCISES[name] || !("Worker" in window) || el.dataset.made) return;
	el.dataset.made = name;
	const own = await EXERCISES[name]().catch(() => null);
	if (!own) return;
	const shown = v => (Array.isArray(v) ? `[${v.map(shown).join(", ")}]` : +v.toFixed(5));
	const given = Object.entries(own.given).map(([key, v]) => html`<code>${key} = ${shown(v)}</code> `);
	const key = `fastphong-hands-${name}`;
	el.append($("#hands-parts").content.cloneNode(true));
	const [area, lines, strip, said, solve] = ["textarea", ".lines", ".chartbox", ".said", "[data-do=solve]"].map(s => $(`.own ${s}`, el));
	$(".given span", el).innerHTML = html`${given}`;
	area.rows = Math.max(...own.texts.map(t => t.split("\n").length)) + 1;
	area.ariaLabel = `Your code, which calls pixel(${own.names.join(", ")}) for each pixel`;
	let mine = null;
	const write = text => {
		if (area.value !== text) area.value = text;
		lines.textContent = text.split("\n").map((_, i) => i + 1).join("\n");
	};
	const say = (kind, markup) => {
		said.className = `said ${kind}`;
		const asks = kind === "bad" && /\b(fetch|import\w*|XMLHttpRequest|WebSocket)\s*\(/.test(area.value);
		fill(said, html`${markup}${asks && " Code here has no network."}`);
	};
	let runs = new AbortController();
	const forget = () => {
		mine = null;
		solve.textContent = "Show a solution";
	};
	const draw = (all, wrong) => fill(strip, handsStrip(own, all, wrong));
	const run = async () => {
		runs.abort();
		runs = new AbortController();
		try {
			const result = await runHands(own.given, area.value, runs.signal);
			const wrong = firstWrong(own, result.all);
			const fault = judgement(own, result, wrong);
			draw(result.all, wrong);
			say(fault ? "bad" : "good", fault ?? `Right: all pixels agree with the engine’s. ${own.learnt}`);
		} catch (error) {
			say("bad", error.message.replace(/[.!?…]*$/, marks => marks[0] ?? "."));
			if (error.line) select(error.line);
		}
		solve.disabled = false;
		el.dataset.ran = (+el.dataset.ran || 0) + 1;
	};
	const select = line => {
		const all = area.value.split("\n");
		const from = all.slice(0, line - 1).join("\n").length + (line > 1);
		area.setSelectionRange(from, from + all[line - 1].length);
	};
	const acts = {
		run,
		anew: () => {
			runs.abort();
			forget();
			write(handsKept(key, own.texts[0]) ?? own.texts[0]);
			draw([]);
			say("", "");
		},
		solve: () => {
			const text = mine ?? own.texts[1];
			if (mine == null) {
				mine = area.value;
				solve.textContent = "Back to mine";
			} else forget();
			write(text);
			run();
		},
	};
	area.oninput = () => {
		write(area.value);
		handsKept(key, area.value);
	};
	// Tab leaves the editor, like any other control.
	area.onkeydown = e => {
		if (e.key === "Enter" && (e.ctrlKey || e.metaKey)) run();
	};
	$(".own .acts", el).onclick = e => acts[e.target.dataset.do]?.();
	write(handsKept(key) ?? own.texts[0]);
	draw([]);
}
