/* View: course. Chapters that Rust made of docs/course, with figures and findings put in. */

const CHAPTERS = $$("#course article");

/* A finding: the value, and what follows from it. */
function findingInto(el, { agreement, verdict, label, ...measured }) {
	el.classList.add(agreement);
	el.innerHTML = html`
		<p>${sentence(label)}: <b>${findingValue(measured)}</b></p>
		<p class="sub">${chip(agreement, agreement)} ${verdict}</p>`;
}

/* Fills the places of a chapter, unless they are as its width and the address ask for. On paper figures have no handles. */
function fillChapter(chapter, query) {
	const asked = () => `${widthOf(chapter)} ${location.hash}`;
	const filled = () => {
		chapter.dataset.filled = asked();
	};
	if (chapter.dataset.filled === asked()) return;
	for (const el of $$("[data-figure]", chapter)) {
		const f = FIGURES.find(q => q.name === el.dataset.figure);
		const finding = f.findings.find(x => x.key === el.dataset.finding);
		if (finding) findingInto(el, finding);
		else
			figureInto(el, f, query, moved => {
				rememberFigure(moved);
				filled();
			});
	}
	filled();
}

/* #course, #course/4.1, #course/4.2?angle=95 */
function course([part], query) {
	const shown = CHAPTERS.find(c => c.dataset.part === part) ?? CHAPTERS[0];
	CHAPTERS.forEach(c => c.classList.toggle("on", c === shown));
	$$("#course .list a").forEach(a => {
		a.ariaCurrent = a.hash === `#course/${shown.dataset.part}` ? "true" : null;
	});
	fillChapter(shown, query);
	reveal($("#course [aria-current]"));
}

/* On paper are all chapters. */
addEventListener("beforeprint", () => CHAPTERS.forEach(c => fillChapter(c)));
