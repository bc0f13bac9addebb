/* View: speed. */

import { beside } from "./beside.js";
import { segments } from "./controls.js";
import { cornerMode, corners, fastest, oneLight, ratioIn, WORKS } from "./corners.js";
import { D, DOCS, levelName, MANY, ratioText, SCENES, STUDY } from "./data.js";
import { grow } from "./growth.js";
import { nameOf } from "./marks.js";
import { $, html, table, write } from "./markup.js";
import { grouped } from "./numbers.js";
import { small } from "./small.js";

/* #speed */
export function speed() {
	if (STUDY) {
		const lecture = STUDY.methods.find(m => m.method === "fast-phong");
		const entry = (m, c) =>
			ratioIn(m, c) ? html`${nameOf(m.method)} <b>${ratioText(ratioIn(m, c))}</b>` : "–";
		$("#speed-summary").innerHTML = table(
			["", ...oneLight.map(c => `${WORKS[c.work]}, ${levelName(c)}`)],
			[
				["fastest with naive Phong’s picture", ...oneLight.map(c => entry(fastest(c), c))],
				["the lecture’s fast Phong", ...oneLight.map(c => entry(lecture, c))],
			],
		);
		write({
			"same-where": MANY
				? `all ${SCENES.length} scenes`
				: (SCENES[0]?.title ?? "this sphere"),
			"loop-span": grouped(STUDY.span),
			"study-span": grouped(STUDY.span),
			"study-frame": `${STUDY.mesh}, ${STUDY.size.join(" × ")}`,
		});
		segments($("#corner-mode"), () => cornerMode, corners);
		corners(cornerMode);
	}
	const growth = D.scaling;
	if (growth) {
		grow(
			"#grow-triangles",
			p => p.size.join() === growth.at.join(),
			p => p.triangles,
			`triangles, at ${growth.at.join(" × ")}`,
		);
		grow(
			"#grow-pixels",
			p => p.asked === growth.of,
			p => p.pixels,
			`covered pixels, about ${grouped(growth.of)} triangles`,
		);
	}
	if (D.small) small();
	if (DOCS.length > 1) beside();
}
