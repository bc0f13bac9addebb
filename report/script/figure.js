/* Figures with handles: a claim, handles, and pictures and findings that follow them. The code that made the stored figures makes these, too. */

import { arrow, slider } from "./controls.js";
import { verdictLine } from "./findings.js";
import { $, $$, atNextFrame, delay, fill, focusOn, html, paint } from "./markup.js";
import { by, clamp } from "./numbers.js";
import { plotsInto } from "./plot.js";
import { SPHERES, spheresWithVerdicts } from "./spheres.js";
import { CAN_DRAW, figureStudio, valuesOf } from "./studio.js";

export const shownValue = (v, { unit }) => `${+v.toFixed(4)}${unit}`;

/* Puts a figure with handles into an element. Calls `remember` with the values whenever they come to rest. Returns false if the
   figure cannot be drawn here. */
export function handlesInto(el, f, query, remember) {
	if (!CAN_DRAW || !f.live) return false;
	if (f === SPHERES) return spheresWithVerdicts(el, query, remember);
	const { claim, handles } = f.live;
	const values = valuesOf(f.live, query);
	const points = handles.flatMap((h, i) => (h.axis === "x" ? [i] : []));
	const sliders = handles.map(
		(h, i) =>
			!h.axis &&
			slider({
				key: i,
				label: h.label,
				min: h.range[0],
				max: h.range[1],
				step: h.step,
				value: values[i],
				text: shownValue(values[i], h),
			}),
	);
	el.classList.add("live-figure");
	el.innerHTML = html`
		<p class="claim">${claim}</p>
		<div class="handles" role="group" aria-label="What can be moved">
			${sliders}
			<button class="still">As stored</button>
		</div>
		<div class="live-body">
			${points.length > 0 && html`<svg class="pad" viewBox="-1.15 -1.15 2.3 2.3"></svg>`}
			<div class="fig"></div>
		</div>
		<div class="verdicts" aria-live="polite"></div>`;
	const [pad, body, said] = [$(".pad", el), $(".fig", el), $(".verdicts", el)];
	let waits = false;
	const draw = async () => {
		waits = false;
		try {
			const studio = await figureStudio();
			if (!el.isConnected) return;
			showContent(body, studio.figure(f.name, values));
			fill(said, html`${body.content.findings.map(verdictLine)}`);
			el.dataset.shown = values.join(" ");
			const detail = { content: body.content, values };
			el.dispatchEvent(new CustomEvent("drawn", { detail, bubbles: true }));
		} catch (error) {
			said.textContent = `Not drawn here: ${error.message}`;
		}
	};
	const moved = () => {
		if (pad) drawPad(pad, values, points, handles);
		const query = handles.flatMap((h, i) =>
			values[i] === h.start ? [] : [[h.name, +values[i].toFixed(4)]],
		);
		delay(`figure ${f.name}`, 200, () => remember?.(new URLSearchParams(query)));
		if (!waits) atNextFrame(draw);
		waits = true;
	};
	const place = (i, v) => {
		const { range, step } = handles[i];
		values[i] = clamp(Math.round(v / step) * step, ...range);
	};
	$(".handles", el).oninput = ({ target }) => {
		const i = target.dataset.handle;
		place(i, +target.value);
		$("b", target.parentElement).textContent = shownValue(values[i], handles[i]);
		moved();
	};
	$(".still", el).onclick = () => {
		handles.forEach((h, i) => {
			values[i] = h.start;
			const input = $(`[data-handle="${i}"]`, el);
			if (!input) return;
			input.value = h.start;
			$("b", input.parentElement).textContent = shownValue(h.start, h);
		});
		moved();
	};
	if (pad)
		dragPoints(pad, (i, x, y) => {
			place(i, x);
			place(i + 1, y);
			moved();
		}, i => [values[i], values[i + 1]]);
	moved();
	return true;
}

/* Shows the pictures and plots of a figure's content. */
function showContent(body, { content, pictures }) {
	body.content = content;
	const columns = content.blocks.find(b => b.pictures)?.pictures.columns ?? 1;
	const shown = content.blocks.flatMap(b => b.pictures?.shown ?? []);
	const plots = content.blocks.flatMap(b => b.plot ?? []);
	// Elements are kept while their count stays, so that pictures do not flicker when they are drawn again.
	const key = `${shown.length} ${plots.length}`;
	if (body.dataset.key !== key) {
		body.dataset.key = key;
		body.innerHTML = html`
			${shown.length > 0 &&
			html`<div class="shown" style="--columns:${clamp(columns, 1, 6)}">${shown.map(
				() => html`<figure><canvas role="img"></canvas><figcaption></figcaption></figure>`,
			)}</div>`}
			${plots.map(() => html`<figure class="plot"></figure>`)}`;
	}
	$$(".shown figure", body).forEach((figure, i) => {
		const canvas = paint($("canvas", figure), pictures[i]);
		canvas.ariaLabel = shown[i].alt;
		$("figcaption", figure).textContent = shown[i].caption;
	});
	plotsInto($$(".plot", body), plots, 260);
}

/* Draws the polygon whose corners the reader can drag. */
function drawPad(pad, values, points, handles) {
	const at = points.map(i => [values[i], -values[i + 1]]);
	/** @type {any} */
	const on = document.activeElement;
	const focus = pad.contains(on) && on.dataset.point;
	pad.innerHTML = html`
		<title>The polygon, whose corners are dragged</title>
		<polygon points="${at.map(p => p.join()).join(" ")}"/>
		${at.map(
			([x, y], n) => html`
				<circle cx="${x}" cy="${y}" r=".075" data-point="${points[n]}" tabindex="0" role="slider"
					aria-label="${handles[points[n]].label.split(",")[0]}" aria-valuenow="${x.toFixed(2)}"
					aria-valuetext="${x.toFixed(2)} to the right, ${(-y).toFixed(2)} up"/>
				<text x="${x}" y="${y + 0.032}">${n + 1}</text>`,
		)}`;
	if (focus) focusOn($(`[data-point="${focus}"]`, pad));
}

/* Lets the reader drag the points of a pad, or move them by arrow keys. */
function dragPoints(pad, to, of) {
	let held = null;
	const local = e => {
		const box = pad.getBoundingClientRect();
		return [
			((e.clientX - box.left) / box.width) * 2.3 - 1.15,
			1.15 - ((e.clientY - box.top) / box.height) * 2.3,
		];
	};
	pad.onpointerdown = e => {
		const [x, y] = local(e);
		const points = $$("[data-point]", pad).map(c => +c.dataset.point);
		const far = i => Math.hypot(of(i)[0] - x, of(i)[1] - y);
		held = points.sort(by(far))[0];
		if (far(held) > 0.25) held = null;
		else pad.setPointerCapture(e.pointerId);
	};
	pad.onpointermove = e => {
		if (held != null) to(held, ...local(e));
	};
	pad.onpointerup = pad.onpointercancel = () => {
		held = null;
	};
	pad.onkeydown = e => {
		const way = arrow(e, 1 / 16, 1 / 16);
		if (!way) return;
		const i = +e.target.dataset.point;
		const [x, y] = of(i);
		to(i, x + way[0], y - way[1]);
	};
}
