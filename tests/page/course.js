/* Reads the course as a student does: scrolls, answers, reaches goals and follows links. `check.js` calls it with its tools. */
async function checkCourse({ check, until, wait, visit, seen, slide, labels, accessible }) {
  const top = el => el.getBoundingClientRect().top;
  /* True if an element has come to its place at the top, below the bars. */
  const starts = el => top(el) > 0 && top(el) < 200;
  const marked = () => document.querySelector("#course .list [aria-current]")?.hash;
  /* Browsers fire scroll events with frames. A browser without a window draws no frames, so fire the events by hand. */
  const scroll = async by => {
    scrollBy(0, by);
    dispatchEvent(new Event("scroll"));
    await wait(150);
  };
  const onPaper = [...document.styleSheets].flatMap(s => [...s.cssRules]).filter(r => r.media?.mediaText === "print").flatMap(r => [...r.cssRules]);
  const parts = CHAPTERS.map(c => c.dataset.part);
  check("course: it has all chapters in order", parts.join() === "0,1,2,3,4.1,4.2,4.3,4.4,5,teaching");
  check("course: the list has all chapters", [...document.querySelectorAll("#course .list a")].map(a => a.hash).join() === parts.map(p => "#course/" + p).join());
  await visit("course");
  check("course: it starts at the top", scrollY === 0 && marked() === "#course/0");
  await scroll(0);
  check("course: a near chapter is filled", !farAway.has(chapterOf("0")) && farAway.has(chapterOf("4.4")));
  check("course: a far chapter is not filled", !chapterOf("4.4").querySelector("[data-filled]") && chapterOf("4.4").querySelectorAll(".live canvas, .live svg, .live img").length === 0);
  for (const [i, c] of CHAPTERS.entries()) {
    const { part } = c.dataset, where = `course ${part}`;
    await visit("course/" + part);
    await until(`${where}: its address leads to it, at ${Math.round(top(c))}`, () => starts(c));
    check(`${where}: it is marked in the list`, marked() === "#course/" + part && location.hash === "#course/" + part);
    const place = c.querySelector(".live"), f = place && figureNamed(place.dataset.figure);
    if (f) {
      await until(`${where}: its figure is drawn`, () => [...place.querySelectorAll("img, svg, canvas")].some(seen));
      if (f.name !== "stop") check(`${where}: a link to its figure`, place.querySelector(".more")?.hash === "#lectures/" + f.name);
      await wait(300);
      check(`${where}: it stays in its place while figures come, at ${Math.round(top(c))}`, starts(c));
    }
    await ask(c, where, i % 2 === 0);
    for (const el of c.querySelectorAll(".found")) {
      const { figure, finding } = el.dataset, x = findingOf(figure, finding);
      check(`${where}: ${figure} ${finding}`, seen(el) && el.querySelector(".chip." + x?.agreement) && el.textContent.includes(x.verdict) && el.querySelector("b").innerHTML === String(findingValue(x)));
    }
    for (const a of c.querySelectorAll(".go-stop")) check(`${where}: ${a.hash}`, a.hash.startsWith("#course/stop?") && a.textContent.trim());
    labels(where);
    if (["1", "4.2", "teaching"].includes(part)) {
      // Hide the parts that other tests check.
      const others = [...document.querySelectorAll("#course :is(.spheres, .stop, .own)")];
      for (const el of others) el.hidden = true;
      accessible(where);
      for (const el of others) el.hidden = false;
    }
    const text = [...c.querySelectorAll(":scope > p")].map(p => p.getBoundingClientRect().width / parseFloat(getComputedStyle(p).fontSize));
    check(`${where}: lines of ${Math.max(...text)} em`, Math.max(...text) < 40);
    const links = [...c.querySelectorAll(":scope > :last-child a")].map(a => a.hash);
    check(`${where}: its links`, links.join() === [parts[i - 1], parts[i + 1]].filter(p => p).map(p => "#course/" + p).join());
  }
  await costs();
  await scrolling();
  await teaching();
  if (CAN_DRAW) await goals();

  /* Answers a chapter's question, once wrong and once right. A finding decides. */
  async function ask(c, where, rightly) {
    const el = c.querySelector(".ask"), measured = c.querySelector(".measured");
    if (!el) return check(`${where}: a question`, ["0", "teaching"].includes(c.dataset.part));
    check(`${where}: the measurements are folded`, !seen(measured));
    check(`${where}: on paper the measurements are not folded`, onPaper.some(r => r.style.display === "block" && measured.matches(r.selectorText)));
    const q = questionOf(el.dataset.question), best = q.all.map(x => x.value).indexOf(Math.max(...q.all.map(x => x.value)));
    if (q.kind === "largest") el.querySelectorAll("[data-choice]")[rightly ? best : (best + 1) % q.all.length].click();
    else {
      const [input, send] = [el.querySelector("input"), el.querySelector(".answer-it")], [{ value }] = q.all;
      check(`${where}: no answer yet`, send.disabled);
      slide(input, rightly ? value : value > (q.low + q.high) / 2 ? q.low : q.high);
      send.click();
    }
    const said = el.querySelector(".said");
    check(`${where}: the focus stays in the question`, document.activeElement === said);
    check(`${where}: ${rightly ? "right" : "wrong"}: ${said.textContent}`, said.querySelector(rightly ? ".confirms" : ".contradicts"));
    check(`${where}: the measured value is stated`, said.innerHTML.includes(String(findingValue({ ...q.all[best], unit: "" })).trim()) && said.textContent.includes(q.all[best].verdict));
    check(`${where}: the measurements unfold`, seen(measured));
  }

  /* Compares the bars of naive Phong with the trace: it takes a root at each drawn pixel. */
  async function costs() {
    if (typeof tracesOf !== "function" || !hasTraces() || !M.flat) return;
    await visit("course/4.1");
    const el = chapterOf("4.1").querySelector(".cost");
    dispatchEvent(new Event("wheel"));
    await scroll(top(el) - 300);
    await until("course: the costs of a picture", () => el.querySelector(".bill"));
    const drawn = Object.values(await tracesOf())[0].lines.flatMap(l => l.runs.flatMap(r => r.colours)).length;
    const [roots] = [...el.querySelectorAll(".bill > span")].filter(s => s.textContent === "roots").map(s => s.nextElementSibling.textContent);
    check(`course: ${roots} roots for ${drawn} pixels`, +roots === drawn);
    await scroll(200);
    await until("course: the bars grow", () => !el.querySelector("[data-width]"));
  }

  /* Scrolls by hand. The list and the address follow, and Back returns to the place before. */
  async function scrolling() {
    const [first, then] = [chapterOf("3"), chapterOf("4.3")];
    const entries = history.length;
    dispatchEvent(new Event("wheel"));
    for (const c of [then, first]) {
      await scroll(top(c) + c.offsetHeight / 2 - 200);
      await until(`course: the list follows to ${c.dataset.part}`, () => marked() === "#course/" + c.dataset.part);
      await until("course: the address follows, too", () => location.hash === "#course/" + c.dataset.part);
    }
    check("course: scrolling adds no entries to the history", history.length === entries);
    const link = first.querySelector(".go-stop"), y = top(link);
    link.click();
    await until("course: a link leads into the figure", () => location.hash.startsWith("#course/stop?") && (starts(chapterOf("0").querySelector(".live"))));
    history.back();
    const isBack = () => Math.abs(top(link) - y) < 4 && location.hash === "#course/3" && !document.querySelector(".go-back");
    await until(`course: Back returns to the place before, from ${y} to ${top(link)}`, isBack);
    link.click();
    await until("course: a way back stands above the figure", () => starts(document.querySelector(".go-back") ?? document.body));
    check("course: the way back names the chapter", document.querySelector(".go-back").textContent.includes("3 Gouraud shading"));
    document.querySelector(".go-back").click();
    await until(`course: the way back returns to the place before, from ${y} to ${top(link)}`, isBack);
  }

  /* Opens every address that the page for teachers names. */
  async function teaching() {
    await visit("course/teaching");
    const hashes = [...chapterOf("teaching").querySelectorAll("a:has(code)")].map(a => a.hash);
    check(`course: addresses for teachers: ${hashes.length}`, hashes.length > 8);
    for (const hash of hashes) {
      await visit(hash.slice(1));
      const part = hash.slice(1).split("?")[0].split("/")[1];
      if (!part) await until(`course: ${hash} is the start`, () => scrollY === 0);
      else if (part !== "stop") await until(`course: ${hash}`, () => starts(chapterOf(part)));
      else if (typeof stopInto === "function") {
        const asked = [...new URLSearchParams(hash.split("?")[1])];
        await until(`course: ${hash}, not ${location.hash}`, () => asked.every(([k, v]) => new URLSearchParams(location.hash.split("?")[1]).get(k) === v));
        if (!hash.includes("bare")) await until(`course: ${hash} shows the figure`, () => starts(chapterOf("0").querySelector(".live")));
      }
    }
  }

  /* Moves handles until the goals of the chapters are reached. */
  async function goals() {
    const newton = chapterOf("4.2"), chip = kind => newton.querySelector(".verdicts .chip")?.matches("." + kind);
    await visit("course/4.2?angle=95");
    await until("course 4.2: one step is not enough at 95°", () => chip("contradicts"));
    const state = c => c.querySelector(".toy .state").textContent, done = c => "done" in c.querySelector(".toy").dataset;
    await until(`course 4.2: ${state(newton)}`, () => state(newton).includes("95°") && !done(newton) && !seen(newton.querySelector(".learnt")));
    const angle = newton.querySelector(".live [data-handle]");
    slide(angle, 90);
    await until("course 4.2: it is at 90°, and the address says so", () => chip("confirms") && location.hash === "#course/4.2?angle=90");
    await until(`course 4.2: the goal is reached: ${state(newton)}`, () => done(newton) && newton.querySelector(".toy .state .confirms") && seen(newton.querySelector(".learnt")));
    dispatchEvent(new Event("resize"));
    await wait(200);
    check("course 4.2: a moved handle stays", newton.querySelector(".live [data-handle]") === angle);
    location.hash = "course/4.2";
    await until("course 4.2: its link restores it", () => newton.querySelector(".live [data-handle]").value === "60");
    const square = chapterOf("3");
    await visit("course/3");
    await until("course 3: a goal", () => state(square).includes("Not yet"));
    slide(square.querySelector(".live [data-handle]"), 90);
    await until(`course 3: it is reached: ${state(square)}`, () => done(square));
  }
}
