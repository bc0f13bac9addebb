/* Each method's name, key, colour and mark. */

import { BASE, IDS, isTooBusy, M, meanRatio, METHODS, SCENES } from "./data.js";
import { $$, html } from "./markup.js";
import { by, round } from "./numbers.js";

/* Each family of methods has a hue and a shape, and each member a filling. Naive Phong's family is drawn in ink. */
const FAMILIES = [...new Set(METHODS.map(m => m.family))].filter(f => f !== M[BASE]?.family);
const SHAPES = $$("[id^=mark-]:not(#mark-diamond)").map(path => path.id.slice(5));

for (const m of METHODS) {
	const family = FAMILIES.indexOf(m.family);
	const members = METHODS.filter(o => o.family === m.family);
	m.hue = family < 0 ? "var(--base)" : `var(--h${family % 11})`;
	m.shape = family < 0 ? "diamond" : SHAPES[family % SHAPES.length];
	m.filling = members.indexOf(m) % 3;
	m.head = members[0] === m;
	// The worst error in all scenes, and the mean speed in those where it can be told, if they are most.
	const drawn = SCENES.filter(s => s.rows[m.name]);
	const ratios = drawn.filter(s => !isTooBusy(s)).map(s => s.rows[m.name].ratio);
	m.scene = [...drawn].sort(by(s => -s.rows[m.name].max))[0];
	m.worst = m.scene?.rows[m.name];
	m.max = m.worst?.max;
	m.speed =
		ratios.length && ratios.length * 2 >= drawn.length && ratios.every(Boolean)
			? meanRatio(ratios)
			: null;
}

/* Keys 1 to 9 go to the first method of each family, then to the most exact others. */
const order = m => IDS.indexOf(m.name);

[...METHODS]
	.sort(by(m => (m.head ? order(m) : 1e6 + (m.max ?? 0))))
	.slice(0, 9)
	.sort(by(order))
	.forEach((m, i) => {
		m.key = String(i + 1);
	});

/* A method's name, short name, colour and key. */
export const nameOf = m => M[m]?.label ?? m;
export const shortName = m => nameOf(m).replace(" Phong", "");
export const hue = m => M[m]?.hue ?? "var(--ink3)";

export const keyOf = m => (m === "reference" ? "0" : M[m].key);

/* The methods that the answer names, the best of these, and the methods that charts emphasise. */
const NAMED = $$(".answer .m").map(a => a.dataset.m);
export const BEST = NAMED[0] ?? IDS[IDS.length - 1];
export const MARKED = new Set([BASE, BEST, ...NAMED]);

/* A few methods: those that the answer names, then the fastest. */
export const chosen = n =>
	IDS.filter(m => m !== BASE && M[m].speed)
		.sort(by(m => -M[m].speed.typical))
		.sort(by(m => Math.max(1, M[m].max)))
		.sort(by(m => !MARKED.has(m)))
		.slice(0, n);

/* A method's mark around a point of an SVG. */
export function shape(m, x, y, size = 5) {
	const { shape = "circle", filling = 1 } = M[m] ?? {};
	return html`
		<use href="#mark-${shape}" class="mark fill${filling}" style="color:${hue(m)}"
			transform="translate(${round(x)} ${round(y)}) scale(${size})"/>`;
}

/* A method's mark in a text. */
export const mark = m => html`
	<svg width="13" height="13" viewBox="-7 -7 14 14" aria-hidden="true">
		${shape(m, 0, 0)}
	</svg>`;

/* A method's mark and name. */
export const named = m => html`${mark(m)}${nameOf(m)}`;
