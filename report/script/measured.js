/* View: how it was measured. */

import { BASE, D, DOCS, FINDINGS, levelName, ROWS, SCENES } from "./data.js";
import { BEST } from "./marks.js";
import { $, html, save, write } from "./markup.js";
import { by, csv, num, plural } from "./numbers.js";

/* Quotes a word for a shell if it needs quotes. */
const quoted = w => (/^[\w\-./:=,+@%]+$/.test(w) ? w : `'${w.replace(/'/g, "'\\''")}'`);

/* #measured */
export function measured() {
	const command = D.command_line.map(quoted).join(" ");
	const { machine } = D;
	const [scene] = SCENES;
	const rounds = ROWS.map(q => q.rounds).filter(Boolean);
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
		[
			"rounds",
			rounds.length &&
				`${Math.min(...rounds)} to ${Math.max(...rounds)} of every method in a scene`,
		],
		[
			"drawn by",
			scene &&
				`the ${scene.renderer.engine} engine, ${levelName(scene.renderer)} code, ` +
					plural(scene.renderer.threads, "thread"),
		],
		["command", html`<code>${command}</code>`],
		...DOCS.slice(1).map((d, i) => [`beside it, ${i + 1}`, about(d.machine)]),
	];
	const spreads = ROWS.filter(q => q.p75)
		.map(q => (q.p75 - q.p25) / q.ms)
		.sort(by(v => v));
	const typical = spreads[spreads.length >> 1] ?? 0;
	$("#busy").hidden = typical < 0.1;
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
		typical: num(typical * 100, 2),
		again: again.filter(Boolean).join("\n"),
	});
	$("#get-json").onclick = () =>
		save("fastphong-report.json", $("#fastphong-data").textContent, "application/json");
	$("#get-csv").onclick = () =>
		save(
			"fastphong-report.csv",
			csv(
				ROWS.map(({ worst, ratio, barycentric, ...q }) => ({
					...q,
					x: worst?.[0],
					y: worst?.[1],
					speed: ratio?.median,
					low: ratio?.low,
					high: ratio?.high,
					barycentric: barycentric?.median,
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
