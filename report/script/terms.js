/* Terms: each quantity of the course has one colour in texts, cards and strips. Pointing at a term lights it up everywhere. */

import { create, html, Markup, put } from "./markup.js";

/* Matches a term in a text, alone or with an index (I_next, J₁, t₀). */
const TERM =
	/(?<![\p{Nd}_'’]|(?!t(?=φ))\p{L})(Δ[INJKx]|[INJKdDφxt])(?![\p{Nd}'’]|(?!φ)\p{L}|_(?!next|current))/u;

/* Marks a term. */
export const term = (name, text = name) => html`<span data-term="${name}">${text}</span>`;

/* Sets a formula: marks its terms, and lowers what follows an underscore. */
export const formulaOf = text => {
	const low = part => new Markup(put(part).replace(/_(\w+)/g, "<sub>$1</sub>"));
	return html`${text.split(TERM).map((part, i) => (i % 2 ? term(part) : low(part)))}`;
};

/* Marks the terms in the texts of an element. */
export function markTerms(el) {
	const skipped = "a,button,summary,h2,h3,h4,svg,math,table,label,.stop,.live,.hands,[data-term]";
	const walker = document.createTreeWalker(el, NodeFilter.SHOW_TEXT);
	/** @type {any[]} */
	const texts = [];
	while (walker.nextNode())
		if (!walker.currentNode.parentElement.closest(skipped)) texts.push(walker.currentNode);
	for (const node of texts) {
		const parts = node.data.split(TERM);
		if (parts.length < 2) continue;
		const marked = parts.map((part, i) => {
			if (i % 2 === 0) return part;
			const span = create("span");
			span.dataset.term = span.textContent = part;
			return span;
		});
		node.replaceWith(...marked);
	}
}

let litScope;
const litRule = document.head.appendChild(create("style"));

/* Lights up a term in the chapter or figure around it. Without an element, puts out the term that is lit. */
function lightTerm(el) {
	const scope = el && (el.closest("article") ?? el.closest(".stop"));
	if (!scope && !litScope) return;
	litScope?.removeAttribute("data-lit");
	scope?.setAttribute("data-lit", "");
	litScope = scope;
	const look =
		"background:color-mix(in srgb,var(--t) 20%,#0000);box-shadow:0 2px var(--t);stroke-width:4";
	litRule.textContent = scope ? `[data-lit] [data-term="${el.dataset.term}"]{${look}}` : "";
}

/** @param {any} e */
const pointed = ({ target }) => lightTerm(target.closest?.("[data-term]"));
for (const type of ["pointerover", "focusin"]) addEventListener(type, pointed);
