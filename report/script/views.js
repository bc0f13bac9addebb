/* The views, and which of them have something to show. A new view needs a file that `program/src/report/page.rs` lists, a section and a link in the
   template, and a name in both lists here. */

import { CHAPTERS, course } from "./course.js";
import { CORNERS } from "./corners.js";
import {
	D, DOCS, FIGURES, FINDINGS, IDS, MANY, NOISES, PICTURES, ROWS, SCENES, STUDY, TIMED,
} from "./data.js";
import { lectures } from "./lectures.js";
import { chosen } from "./marks.js";
import { measured } from "./measured.js";
import { methods } from "./methods.js";
import { overview } from "./overview.js";
import { scenes } from "./scenes.js";
import { speed } from "./speed.js";

/* The functions that draw the views, in the order of the navigation. Each gets the parts of the view's address. */
export const VIEWS = { overview, scenes, methods, speed, lectures, course, measured };

/* Parts of the page that have something to show. */
export const FILLED = {
	scenes: SCENES.length,
	methods: IDS.length,
	lectures: FIGURES.length,
	course: CHAPTERS.length,
	findings: FINDINGS.length,
	overview: SCENES.length || FIGURES.length > 1,
	speed: STUDY || D.scaling || D.small || DOCS.length > 1,
	study: STUDY,
	corners: CORNERS.length,
	growth: D.scaling,
	small: D.small,
	beside: DOCS.length > 1,
	many: MANY,
	strip: MANY && chosen(1).length,
	noise: NOISES.length,
	own: NOISES.some(n => n.clock === "thread"),
	passed: NOISES.some(n => n.clock === "passed"),
	old: TIMED && !NOISES.length,
	untimed: !TIMED && !NOISES.length,
	measured: true,
	numbers: !PICTURES,
	debug: D.machine.profile !== "release",
	srgb: SCENES.some(s => s.encoding === "srgb"),
	depth: ROWS.some(q => q.other),
};
