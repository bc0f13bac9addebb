/* View: speed. */

import { beside } from "./beside.js";
import { segments } from "./controls.js";
import { cornerMode, corners, CORNERS, fastest, oneLight, ratioIn, WORKS } from "./corners.js";
import {
	D, DOCS, isTooBusy, leftOut, levelName, MANY, ratioText, SCENES, STUDY, trustText,
} from "./data.js";
import { grow } from "./growth.js";
import { nameOf } from "./marks.js";
import { $, html, table, write } from "./markup.js";
import { by, grouped } from "./numbers.js";
import { small } from "./small.js";

/* #speed */
export function speed() {
	if (STUDY) write({ "study-trust": trustText(STUDY) });
	if (CORNERS.length) {
		const lecture = STUDY.methods.filter(m => m.method === "fast-phong");
		const entry = (list, c) => {
			const [first, ...others] = list.filter(m => ratioIn(m, c)).map(m => nameOf(m.method));
			const name = others.length > 1 ? `${others.length} others` : others[0];
			return html`${first}${name && ` or ${name}`} <b>${ratioText(ratioIn(list[0], c))}</b>`;
		};
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
		const told = growth.points.filter(p => !isTooBusy(p));
		const worst = told.map(p => p.noise).sort(by(noise => -noise?.doubt))[0];
		write({
			"growth-trust":
				(worst ? `Least certain point: ${worst.sentence}. ` : "") +
				leftOut(growth.points.length - told.length, "point"),
		});
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
