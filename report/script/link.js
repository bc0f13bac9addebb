/* Addresses: #view/part?left=…&right=…&mode=…&x=…&y=…&zoom=…&row=… */

/* The view that is shown. While it is being restored from an address, viewers do not change the address. */
let view = "";
let restoring = true;

/* Goes to an address. If it is the current one, shows it again, because the reader's own mesh may be shown in its place. */
function go(hash) {
	clearTimeout(timers.remember);
	if (location.hash === "#" + hash) route();
	else location.hash = hash;
}

/* Decodes a part of an address, or returns it unchanged if that fails. */
function decoded(part) {
	try {
		return decodeURIComponent(part);
	} catch {
		return part;
	}
}

/* Reads a viewer's state from an address. */
function fromRoute(query, v) {
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
function keepAddress(v) {
	const own = v === v1 ? "overview" : "scenes";
	const { scene: s, pin } = v;
	if (view !== own || s.own) return;
	const zoom = pin && v.z > 1 ? v.z.toFixed(1) : null;
	const state = {
		scene: v === v1 && s !== SCENES[0] ? s.id : null,
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
	const path = v === v1 ? own : `scenes/${s.id}`;
	history.replaceState(null, "", `#${path}?${new URLSearchParams(given)}`);
}

/* Keeps the address in step with a viewer. */
function remember(v) {
	if (!restoring) delay("remember", 60, () => keepAddress(v));
}

/* Shows the view that the address names, or the first that has something to show. */
function route(e) {
	clearTimeout(timers.remember);
	const [path, query] = (e?.newURL ? new URL(e.newURL) : location).hash.slice(1).split("?");
	const [asked, ...parts] = path.split("/").map(decoded);
	// #stop is a short address for talks.
	if (asked === "stop") return location.replace(`#lectures/stop${query ? "?" + query : ""}`);
	const isView = Object.hasOwn(VIEWS, asked) && FILLED[asked];
	const name = isView ? asked : FILLED.overview ? "overview" : "lectures";
	if (asked && !isView) history.replaceState(null, "", "#" + name);
	const changed = name !== view;
	view = name;
	restoring = true;
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
	restoring = false;
	fadeEnds();
	const title = name === "overview" ? "" : link.textContent + " · ";
	document.title = title + "fastphong: Phong shading, measured";
}

addEventListener("hashchange", route);
/* The viewer of the current view, if it has one. */
const seenViewer = () => (view === "overview" ? v1 : view === "scenes" ? v2 : null);

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
