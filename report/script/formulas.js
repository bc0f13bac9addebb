/* Turns formulas that `fastphong explain` prints into MathML. */

import { html } from "./markup.js";

const GREEK = { phi: "φ", theta: "θ", alpha: "α", delta: "δ" };
const FUNCTIONS = ["sin", "cos", "sqrt", "min", "max"];

const SIGNS = { ".": "·", "*": "×", "-": "−", "...": "…" };

const operator = t => html`<mo stretchy="false">${t}</mo>`;
const group = parts => html`<mrow>${parts}</mrow>`;

/* True if a token is a word of text, and not the name of a variable, function or Greek letter. */
const isSpace = t => /^\s+$/.test(t);
const isWord = t =>
	(/^[A-Za-z]{3,}$/.test(t) && !FUNCTIONS.includes(t) && !GREEK[t]) ||
	["by", "of", "at", "to", "on", "eq"].includes(t);

/* Sets a name or a number: a leading d is a difference, trailing letters are an index, and N, L, V, R, H and P are vectors. */
function symbol(t) {
	if (/^\d/.test(t)) return html`<mn>${t}</mn>`;
	if (GREEK[t]) return html`<mi>${GREEK[t]}</mi>`;
	const difference = /^d[a-z]*$/.test(t)
		? null
		: /^(d*)([A-Za-z])([a-z0-9]*)(?:_(\w+))?$/.exec(t);
	const [, d, head, letters, mark] = difference ?? [t, "", t];
	const deltas = d && html`<mi mathvariant="normal">${"Δ".repeat(d.length)}</mi>`;
	const letter = /^[NLVRHP]$/.test(head)
		? html`<mi mathvariant="normal" class="vector">${head}</mi>`
		: html`<mi>${head}</mi>`;
	const name = html`${deltas}${letter}`;
	const index = letters || mark;
	return index ? html`<msub>${group(name)}${group(html`<mi>${index}</mi>`)}</msub>` : group(name);
}

/* Makes fractions. In `a / b` with spaces they hold the whole products on both sides, in `a/b` only the neighbours. */
function fractions(items) {
	for (let i = items.findIndex(x => x.over); i > 0; i = items.findIndex(x => x.over)) {
		const end = (k, step) => {
			while (items[i].loose && items[k + step] && !items[k + step].op) k += step;
			return k;
		};
		const from = end(i - 1, -1);
		const to = Math.min(end(i + 1, 1), items.length - 1);
		const joined = (a, b) => group(items.slice(a, b).map(x => x.html));
		items.splice(from, to - from + 1, {
			html: html`<mfrac>${joined(from, i)}${joined(i + 1, to + 1)}</mfrac>`,
		});
	}
	return items.map(x => x.html);
}

/* Reads tokens up to `close` as mathematics, and removes them from the list. */
function mathematics(tokens, close) {
	const items = [];
	const push = (html, more) => items.push({ html, ...more });
	while (tokens.length) {
		const t = tokens.shift();
		const before = items[items.length - 1];
		if (t === close) break;
		if (isSpace(t)) {
			if (before) before.gap = true;
		} else if (isWord(t)) {
			let words = t;
			while (
				tokens.length &&
				(isSpace(tokens[0]) ||
					isWord(tokens[0]) ||
					/^(an?|[\d.\-']+|s)$/.test(tokens[0]) ||
					words.endsWith("eq "))
			)
				words += tokens.shift();
			push(html`<mtext>\u00a0${words.trim()}\u00a0</mtext>`, { op: true });
		} else if (FUNCTIONS.includes(t) && tokens[0] === "(") {
			tokens.shift();
			const inner = group(mathematics(tokens, ")"));
			const root = html`<msqrt>${inner}</msqrt>`;
			push(
				t === "sqrt"
					? root
					: group([html`<mi>${t}</mi>`, operator("("), inner, operator(")")]),
			);
		} else if (t === "(") {
			const inner = group([operator("("), mathematics(tokens, ")"), operator(")")]);
			if (before?.name && !before.gap) before.html = group([before.html, inner]);
			else push(inner);
		} else if (t === "|") push(group([operator("|"), mathematics(tokens, "|"), operator("|")]));
		else if (t === "^") {
			while (isSpace(tokens[0])) tokens.shift();
			push(html`<msup>${group(items.pop()?.html)}${symbol(tokens.shift())}</msup>`);
		} else if (t === "/") push("/", { op: true, over: true, loose: before?.gap });
		else if (/^[A-Za-z0-9]/.test(t)) push(symbol(t), { name: /^[A-Z]/.test(t) });
		else push(operator(SIGNS[t] ?? t), { op: t !== "." });
	}
	return fractions(items);
}

/* Sets a formula that `fastphong explain` prints. Parts without an operator stay words. */
export const formula = source =>
	source
		.split(/[;\n]|,(?![^(]*\))/)
		.map(part => part.trim())
		.filter(Boolean)
		.map(part => {
			if (!/[=^/]/.test(part)) return html`<div class="words">${part}</div>`;
			const tokens = part
				.replace(/^(\w+)_next\s*=/, "$1 ←")
				.match(/[A-Za-z]+\d*(?:_[a-z]+)?|\d+(?:\.\d+)?|\.\.\.|\s+|\S/g);
			return html`<div><math>${mathematics(tokens)}</math></div>`;
		});
