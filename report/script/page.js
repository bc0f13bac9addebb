/* Starts the page. */

import { SCENES } from "./data.js";
import "./keys.js";
import { route } from "./link.js";
import { hue } from "./marks.js";
import { $$ } from "./markup.js";
import "./theme.js";
import { FILLED } from "./views.js";

/* Colours the methods in the answers, whose words Rust writes. */
$$(".lede .m").forEach(a => a.style.setProperty("--c", hue(a.dataset.m)));

$$("[data-scene]").forEach(a => {
	const { scene, of } = a.dataset;
	a.href = `#scenes/${SCENES[scene].id}?left=${of}&right=reference&mode=error`;
});

$$("[data-if]").forEach(el => {
	el.hidden = !FILLED[el.dataset.if];
});

route();
