/* Keys, and the buttons of the bar on top. */

import { isCommand } from "./controls.js";
import { route, seenViewer } from "./link.js";
import { $, ROOT } from "./markup.js";
import { stepScene, v2 } from "./scenes.js";

addEventListener("keydown", e => {
	const v = seenViewer();
	/** @type {any} */
	const on = e.target;
	if (isCommand(e) || on.matches("select,input,textarea") || $("#keys").open) return;
	if (e.key === "?") return $("#keys").showModal();
	if (!v || (e.key === " " && on.closest("button,a,.hit"))) return;
	const step =
		v === v2 &&
		({ "[": -1, "]": 1 }[e.key] ??
			(on.closest(".rail") &&
				{ ArrowUp: -1, ArrowLeft: -1, ArrowDown: 1, ArrowRight: 1 }[e.key]));
	if (step) {
		e.preventDefault();
		return stepScene(step);
	}
	if (e.key.startsWith("Arrow") && on.closest(".scroll,nav")) return;
	if (v.key(e)) e.preventDefault();
});

$("#help").onclick = () => $("#keys").showModal();

$("#big").onclick = e => {
	e.currentTarget.ariaPressed = ROOT.toggleAttribute("data-big");
	route();
};
