/* Shows the view that the address names. */

import { address, keepAddress } from "./address.js";
import { startReading } from "./course.js";
import { $, $$, delay, fadeEnds, timers } from "./markup.js";
import { v1 } from "./overview.js";
import { v2 } from "./scenes.js";
import { placeSpheres } from "./spheres.js";
import { FILLED, VIEWS } from "./views.js";

/* Decodes a part of an address, or returns it unchanged if that fails. */
function decoded(part) {
	try {
		return decodeURIComponent(part);
	} catch {
		return part;
	}
}

/* Shows the view that the address names, or the first that has something to show. */
export function route(e) {
	clearTimeout(timers.remember);
	const [path, query] = (e?.newURL ? new URL(e.newURL) : location).hash.slice(1).split("?");
	const [asked, ...parts] = path.split("/").map(decoded);
	// #stop is a short address for talks.
	if (asked === "stop") return location.replace(`#lectures/stop${query ? "?" + query : ""}`);
	const isView = Object.hasOwn(VIEWS, asked) && FILLED[asked];
	const name = isView ? asked : FILLED.overview ? "overview" : "lectures";
	if (asked && !isView) history.replaceState(null, "", "#" + name);
	const changed = name !== address.view;
	address.view = name;
	address.restoring = true;
	$$(".view").forEach(s => s.classList.toggle("on", s.id === name));
	const link = $(`.top nav a[href="#${name}"]`);
	$$(".top nav a").forEach(a => {
		a.ariaCurrent = a === link ? "page" : null;
	});
	const chapter = VIEWS[name](parts.filter(Boolean), new URLSearchParams(query ?? ""));
	placeSpheres($("#" + name));
	const target = e && document.getElementById("m-" + parts[0]);
	if (target) target.scrollIntoView();
	else if (name === "course" && (e || changed)) startReading(chapter);
	else if (changed || (e && name === "lectures")) scrollTo(0, 0);
	address.restoring = false;
	fadeEnds();
	const title = name === "overview" ? "" : link.textContent + " · ";
	document.title = title + "fastphong: Phong shading, measured";
}

addEventListener("hashchange", route);
addEventListener("redraw", () => route());

/* Draws all views for print, without a change of the address. */
addEventListener("beforeprint", () => {
	address.restoring = true;
	$$(".view").forEach(s => s.classList.toggle("on", !!FILLED[s.id]));
	for (const name in VIEWS) if (FILLED[name]) VIEWS[name]([], new URLSearchParams());
});

addEventListener("afterprint", () => {
	address.view = "";
	route();
});

/* The viewer of the current view, if it has one. */
export const seenViewer = () => ({ overview: v1, scenes: v2 })[address.view];

/* Draws everything for the window's new width. The address knows neither the reader's own mesh nor a view that still moves, so
   these are not restored from it. */
function resized() {
	const v = seenViewer();
	if (v?.hand.moves) return delay("resize", 120, resized);
	if (v?.scene.own) return v.draw();
	if (v?.hand.live) keepAddress(v);
	route();
}

addEventListener("resize", () => delay("resize", 120, resized));
