/* View: how it was measured. */

import { BASE, D, DOCS, FINDINGS, levelName, NOISES, ROWS, SCENES } from "./data.js";
import { BEST } from "./marks.js";
import { $, html, save, write } from "./markup.js";
import { csv, num, plural } from "./numbers.js";

/* Quotes a word for a shell if it needs quotes. */
const quoted = w => (/^[\w\-./:=,+@%]+$/.test(w) ? w : `'${w.replace(/'/g, "'\\''")}'`);

/* #measured */
export function measured() {
	const command = D.command_line.map(quoted).join(" ");
	const { machine } = D;
	const [scene] = SCENES;
	// The least and the most of a field of the scenes' noise, as text.
	const range = (key, text) => {
		const values = NOISES.map(n => n[key]);
		const ends = [Math.min(...values), Math.max(...values)].map(text);
		return [...new Set(ends)].join(" to ");
	};
	const trusts = ["quiet", "busy", "too-busy"].flatMap(trust => {
		const count = NOISES.filter(n => n.trust === trust).length;
		return count ? `${trust.replace("-", " ")} in ${plural(count, "scene")}` : [];
	});
	const about = ({ cpu, os, arch, rustc, version, commit }) =>
		`${cpu}, ${os} ${arch}; ${rustc}; fastphong ${version}` +
		(commit ? `, commit ${commit}` : "");
	const features =
		machine.target_features.join() === "sse2"
			? "baseline x86-64; wider instructions are chosen as it runs"
			: machine.target_features.join(", ");
	const facts = [
		["machine", about(machine)],
		["logical processors", machine.cores],
		["build", `${machine.profile}, opt-level ${machine.opt_level}, for ${features}`],
		["date", D.date],
		["whole run", D.seconds && `${num(D.seconds)} s`],
		["rounds", NOISES.length && `${range("rounds", num)} in a scene`],
		[
			"drawn by",
			scene &&
				`the ${scene.renderer.engine} engine, ${levelName(scene.renderer)} code, ` +
					plural(scene.renderer.threads, "thread"),
		],
		["command", html`<code>${command}</code>`],
		...DOCS.slice(1).map((d, i) => [`beside it, ${i + 1}`, about(d.machine)]),
	];
	// The report adds lights to a bare mesh file, and `compare` does not, so no command is shown for it.
	const again = [
		command,
		scene &&
			!/:|\.(obj|stl|ply|off|gltf|glb)$/i.test(scene.name) &&
			`fastphong compare ${quoted(scene.name)} --size ${scene.w}x${scene.h}`,
		`fastphong explain ${BEST ?? BASE}`,
	];
	$("#machine").innerHTML = html`${facts
		.filter(([, value]) => value)
		.map(([name, value]) => html`<dt>${name}</dt><dd>${value}</dd>`)}`;
	write({
		timed: D.timed,
		compared: D.compared,
		interrupted: range("interrupted", v => num(v * 100, 2)),
		trusts: trusts.join(", "),
		again: again.filter(Boolean).join("\n"),
	});
	$("#get-json").onclick = () =>
		save("fastphong-report.json", $("#fastphong-data").textContent, "application/json");
	$("#get-csv").onclick = () =>
		save(
			"fastphong-report.csv",
			csv(
				ROWS.map(({ kinds, worst, ratio, barycentric, work, ...q }) => ({
					...q,
					x: worst?.[0],
					y: worst?.[1],
					speed: ratio?.typical,
					low: ratio?.low,
					high: ratio?.high,
					barycentric: barycentric?.typical,
					work: work?.typical,
				})),
			),
			"text/csv",
		);
	$("#get-findings").onclick = () =>
		save(
			"fastphong-findings.csv",
			csv(FINDINGS.map(x => ({ ...x, figure: x.figure.name }))),
			"text/csv",
		);
}
