/* Keys, and the buttons of the bar on top. */

addEventListener("keydown", e => {
	const v = seenViewer();
	const on = e.target;
	if (e.ctrlKey || e.metaKey || e.altKey || on.matches("select,input,textarea") || $("#keys").open) return;
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

$("#theme").onclick = () => {
	const { dataset } = ROOT;
	const dark = dataset.theme
		? dataset.theme === "dark"
		: matchMedia("(prefers-color-scheme:dark)").matches;
	dataset.theme = dark ? "light" : "dark";
	try {
		localStorage.setItem("fastphong-theme", dataset.theme);
	} catch {
		/* a file opened from disk may have no storage */
	}
};

$("#big").onclick = e => {
	e.currentTarget.ariaPressed = ROOT.toggleAttribute("data-big");
	route();
};
