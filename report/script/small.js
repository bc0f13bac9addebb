/* Charts of loops in integers, on processors without a floating-point unit. */

/* The method of the table that has a loop, for its mark and colour: names of loops begin like it. */
function methodOfLoop(loop) {
	const printed = loop.endsWith("-as-printed");
	const method = `integer-${loop.split("-")[0]}${printed ? "-printed" : ""}`;
	return M[method] ? method : null;
}

/* Parts of the names of loops, as readers know them. */
const PARTS = { 1: "+ Newton", nh: "N·H", dull: "no highlight" };

const nameOfLoop = loop =>
	loop
		.split("-")
		.map(part => PARTS[part] ?? part)
		.join(" ");

/* Error at 15° against the cost of a pixel: number `column` of a loop's figures. */
function costOfLoops(id, column, label) {
	const el = $(id);
	const W = widthOf(el);
	if (!W) return;
	const points = D.small.spans
		.filter(loop => loop.worst_error.length)
		.map(loop => ({
			m: methodOfLoop(loop.method),
			name: nameOfLoop(loop.method),
			cost: loop.at_32_pixels_15_degrees[column],
			error: loop.worst_error[1],
		}));
	const [l, r, t, b] = [44, W - 14, 24, 286];
	const x = logScale(
		points.map(p => p.cost),
		1.25,
		l,
		r,
	);
	const y = scale(false, 0, Math.ceil(Math.max(...points.map(p => p.error)) + 0.5), b, t);
	for (const p of points) {
		[p.x, p.y] = [x(p.cost), y(p.error)];
		p.w = textWidth(p.name) + 6;
		// The plain loops, by their whole name, are labelled first.
		p.priority = +!p.name.includes(" ");
	}
	place(points, [l + 2, t, r, b - 1], []);
	el.innerHTML = svg(W, 330, `Error against ${label}`, [
		axisY(y, l, r, y.ticks(40)),
		axisX(x, b, x.ticks(45)),
		text(l - 38, t - 9, "worst error at 15°, grey levels", "axis"),
		text((l + r) / 2, 324, `← faster   ·   ${label}`, "axis mid"),
		points.map(
			p => html`
				<g style="color:${hue(p.m)}">
					<title>${p.name}: ${num(p.error)} levels, ${num(p.cost)} ${label}</title>
					${p.label?.end && line(p.x, p.y, ...p.label.end, "leader")}
					${shape(p.m, p.x, p.y, 5.2)}
					${p.label && text(p.label.x + 2, p.label.y + 4.3, p.name, "label halo")}
				</g>`,
		),
	]);
}

function small() {
	costOfLoops("#small-m0", 1, "cycles of a Cortex-M0+ a pixel");
	costOfLoops("#small-rv", 2, "instructions of RV32IMC a pixel");
	const cycles = name =>
		D.small.spans.find(loop => loop.method === name)?.at_32_pixels_15_degrees[1];
	const [soft, fast, naive] = ["soft-naive", "fast", "naive"].map(cycles);
	const times = `${num(soft / naive, 2)} times as many as in integers`;
	$("#small-soft").innerHTML = html`
		<span>Naive Phong in emulated floats takes ${num(soft)} cycles a pixel there, ${times}.</span>
		<span> The lecture’s fast Phong takes ${num(fast / naive, 2)} of naive Phong’s cycles.</span>
		<span> Measured by <code>${D.small.command}</code>.</span>`;
}
