/* Addresses: #view/part?left=…&right=…&mode=…&x=…&y=…&zoom=…&row=… */

import { redraw } from "./controls.js";
import { S, SCENES } from "./data.js";
import { delay, timers } from "./markup.js";
import { clamp } from "./numbers.js";
import { viewOf, viewQuery } from "./turn.js";
import { MODES } from "./viewer.js";

/* The view that is shown. While it is being restored from an address, viewers do not change the address. */
export const address = { view: "", restoring: true };

/* Goes to an address. If it is the current one, shows it again, because the reader's own mesh may be shown in its place. */
export function go(hash) {
	clearTimeout(timers.remember);
	if (location.hash === "#" + hash) redraw();
	else location.hash = hash;
}

/* Reads a viewer's state from an address. */
/** @returns {any} */
export function fromRoute(query, v) {
	/** @type {any} */
	const given = Object.fromEntries(query);
	const whole = key => (given[key] && isFinite(given[key]) ? Math.floor(given[key]) : null);
	const s = S[given.scene] ?? v.scene;
	const state = { scene: s };
	if (given.left) state.a = given.left;
	if (given.right) state.b = given.right;
	if (given.left || given.right || given.mode)
		state.mode = Object.values(MODES).includes(given.mode) ? given.mode : "slide";
	if (given.scale) state.top = +given.scale || 0;
	if (whole("x") != null && whole("y") != null) {
		const pin = [clamp(whole("x"), 0, s.w - 1), clamp(whole("y"), 0, s.h - 1)];
		Object.assign(state, {
			pin,
			z: clamp(+given.zoom || 1, 1, 32),
			cx: (pin[0] + 0.5) / s.w,
			cy: (pin[1] + 0.5) / s.h,
		});
	}
	state.view = viewOf(given);
	if (v.row && given.row) state.line = whole("row") ?? 0;
	return state;
}

/* Makes the address name what a viewer shows. */
export function keepAddress(v) {
	const { id: own } = v.root.closest(".view");
	const isFirst = own === "overview";
	const { scene: s, pin } = v;
	if (address.view !== own || s.own) return;
	const zoom = pin && v.z > 1 ? v.z.toFixed(1) : null;
	const state = {
		scene: isFirst && s !== SCENES[0] ? s.id : null,
		left: v.a,
		right: v.b,
		mode: v.mode === "slide" ? null : v.mode,
		scale: v.top || null,
		x: pin?.[0],
		y: pin?.[1],
		zoom,
		row: v.line,
		...viewQuery(v.view),
	};
	const given = Object.entries(state).filter(([, value]) => value != null);
	const path = isFirst ? own : `scenes/${s.id}`;
	history.replaceState(null, "", `#${path}?${new URLSearchParams(given)}`);
}

/* Keeps the address in step with a viewer. */
export function remember(v) {
	if (!address.restoring) delay("remember", 60, () => keepAddress(v));
}
