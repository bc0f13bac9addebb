/* The button that switches between light and dark. */

import { $, ROOT } from "./markup.js";

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
