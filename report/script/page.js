/* Starts the page. */

/* Colours the methods in the answer, whose words Rust writes. */
$$(".answer .m").forEach(a => a.style.setProperty("--c", hue(a.dataset.m)));

$$("[data-scene]").forEach(a => {
	const { scene, of } = a.dataset;
	a.href = `#scenes/${SCENES[scene].id}?left=${of}&right=reference&mode=error`;
});

$$("[data-if]").forEach(el => {
	el.hidden = !FILLED[el.dataset.if];
});

addEventListener("beforeprint", () => {
	// Drawing all views for print must not change the address.
	restoring = true;
	$$(".view").forEach(s => s.classList.toggle("on", !!FILLED[s.id]));
	for (const name in VIEWS) if (FILLED[name]) VIEWS[name]([], new URLSearchParams());
});

addEventListener("afterprint", () => {
	view = "";
	route();
});

route();
