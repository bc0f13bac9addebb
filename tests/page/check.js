/* Uses every control of the report's page. `tests/page/run` opens the page in a frame; this script reports the result to the page around the frame. */
(async () => {
  const failed = [], wait = ms => new Promise(r => setTimeout(r, ms));
  addEventListener("error", e => failed.push("error: " + e.message));
  addEventListener("unhandledrejection", e => failed.push("rejected: " + e.reason));
  let count = 0;
  const check = (what, is) => { count++; if (!is) failed.push(what); };
  const until = async (what, is) => { for (let i = 0; i < 200 && !is(); i++) await wait(20); check(what, is()); };
  const key = (k, o = {}) => document.body.dispatchEvent(new KeyboardEvent("keydown", { key: k, code: /^\d$/.test(k) ? "Digit" + k : "", bubbles: true, cancelable: true, ...o }));
  const visit = async h => { location.hash = h; await wait(120); };
  const shown = v => v.root.dataset.shown ?? "";
  /* Checks that no labels of charts overlap, and that nothing is cut off or wider than the window. */
  const labels = where => {
    for (const svg of document.querySelectorAll(".view.on .chartbox svg")) {
      const boxes = [...svg.querySelectorAll("text.label")].map(t => [t.textContent, t.getBoundingClientRect()]);
      boxes.forEach(([a, p], i) => boxes.slice(i + 1).forEach(([b, q]) => {
        const over = Math.min(p.right, q.right) - Math.max(p.left, q.left) > 1 && Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > 4;
        if (over) failed.push(`${where}: "${a}" lies over "${b}"`);
      }));
      const frame = svg.getBoundingClientRect();
      for (const el of svg.querySelectorAll("text.label, .whisker")) {
        const box = el.getBoundingClientRect();
        check(`${where}: cut off in a chart: ${el.textContent || "a whisker"}`, box.left > frame.left - 2 && box.right < frame.right + 2 && box.top > frame.top - 2 && box.bottom < frame.bottom + 2);
      }
    }
    for (const el of document.querySelectorAll(".view.on :is(.scroll, .rail, .list, .choices)")) {
      if (el.scrollWidth - el.scrollLeft > el.clientWidth + 2) check(`${where}: no sign that ${el.id || el.className} scrolls`, el.classList.contains("more-right") && getComputedStyle(el).maskImage !== "none");
      if (el.scrollHeight - el.scrollTop > el.clientHeight + 2) check(`${where}: no sign that ${el.id || el.className} scrolls down`, el.classList.contains("more-below") && getComputedStyle(el).maskImage !== "none");
    }
    const nav = document.querySelector(".top nav"), tools = document.querySelector(".tools").getBoundingClientRect();
    check(`${where}: the navigation is cut off`, nav.scrollWidth <= nav.clientWidth + 1 && [...nav.children].every(a => a.hidden || a.getBoundingClientRect().right <= tools.left + 1));
    // The spheres of the overview, or the viewer with its buttons, fit into the first screen.
    const stage = document.querySelector(".view.on :is(#overview .spheres, .viewer .vfoot)"), below = stage && stage.getBoundingClientRect().bottom + scrollY;
    if (below && innerWidth >= 1400) check(`${where}: buttons of the viewer end at ${Math.round(below)} of ${innerHeight}`, below <= innerHeight);
    const jargon = /\bkernels?\b|four corners|one pixel at a time|avx512/i.exec(document.querySelector(".view.on:not(#lectures)")?.innerText);
    check(`${where}: a word that the page does not explain: ${jargon?.[0]}`, !jargon);
    check(`${where}: wider than the window`, document.documentElement.scrollWidth <= innerWidth + 1);
    check(`${where}: a picture without an alternative text`, ![...document.images].some(i => !i.hasAttribute("alt")));
  };
  /* Checks the accessibility of everything visible: contrast of texts, order of headings, names of controls and pictures, and a focus that shows. */
  const pen = document.createElement("canvas").getContext("2d", { willReadFrequently: true }), colours = new Map();
  const rgba = colour => {
    if (!colours.has(colour)) {
      pen.clearRect(0, 0, 1, 1);
      pen.fillStyle = colour;
      pen.fillRect(0, 0, 1, 1);
      const [r, g, b, a] = pen.getImageData(0, 0, 1, 1).data;
      colours.set(colour, [r, g, b, a / 255]);
    }
    return colours.get(colour);
  };
  const over = (top, under, alpha = top[3]) => [0, 1, 2].map(i => top[i] * alpha + under[i] * (1 - alpha));
  const luminance = c => [.2126, .7152, .0722].reduce((sum, k, i) => sum + k * (c[i] <= 10.31475 ? c[i] / 3294.6 : ((c[i] / 255 + .055) / 1.055) ** 2.4), 0);
  const background = el => {
    if (!el) return [255, 255, 255];
    const colour = rgba(getComputedStyle(el).backgroundColor);
    return colour[3] === 1 ? colour.slice(0, 3) : over(colour, background(el.parentElement));
  };
  const opacity = el => el ? +getComputedStyle(el).opacity * opacity(el.parentElement) : 1;
  const seen = el => el.checkVisibility({ visibilityProperty: true }) && el.getClientRects().length;
  /* Drags from one point of an element to another. Points are shares of the element's size. */
  const drag = async (el, from, to) => {
    const box = el.getBoundingClientRect();
    const fire = (type, [u, v]) => el.dispatchEvent(new PointerEvent(type, { pointerId: 1, clientX: box.left + u * box.width, clientY: box.top + v * box.height, bubbles: true, cancelable: true }));
    el.setPointerCapture = () => {};
    fire("pointerdown", from);
    for (const k of [.25, .5, .75, 1]) { fire("pointermove", from.map((c, i) => c + (to[i] - c) * k)); await wait(30); }
    fire("pointerup", to);
  };
  const slide = (input, value) => {
    input.value = value;
    input.dispatchEvent(new Event("input", { bubbles: true }));
  };
  /* Returns the bytes of a viewer's left picture, as text. */
  const bytes = async v => (await picture(v.source, v.a)).px.join();
  const rested = v => () => v.hand.live && !v.hand.moves && !v.hand.waits && v.source === v.hand.live && v.hand.live.exact === "reference";
  /* Checks the scenes that are drawn in the page: every handle changes the picture, and a link restores it to the byte. */
  const live = async () => {
    if (!CAN_DRAW) return;
    const turned = SCENES.filter(s => s.drawn && canTurn(s));
    check("live: some scenes can be turned", turned.length > 0);
    for (const s of innerWidth < 800 ? turned.slice(0, 1) : turned.slice(0, 6)) {
      await visit(`scenes/${s.id}?left=${s.list[1]}&right=${s.list[2]}`);
      await until(`${s.id}: shown`, () => shown(v2).startsWith(s.id + "|"));
      // A drag moves a zoomed picture instead of turning the model, so zoom out first.
      v2.zoom(0);
      v2.root.dispatchEvent(new Event("pointerenter"));
      await v2.hand.ready();
      check(`${s.id}: there are handles`, !v2.hand.panel.hidden && v2.hand.panel.querySelectorAll("input").length >= 2);
      const stored = await bytes(v2);
      await drag(v2.stage, [.15, .3], [.3, .4]);
      await until(`${s.id}: a drag turns`, rested(v2));
      check(`${s.id}: the drag turns by an angle`, v2.view.azimuth && v2.view.elevation);
      await until(`${s.id}: the view stands in the link`, () => new URLSearchParams(location.hash.split("?")[1]).get("turn") === viewQuery(v2.view).turn);
      const there = await bytes(v2), hash = location.hash;
      const text = v2.hand.live.studio.scene();
      check(`${s.id}: the view can be saved as a scene file`, text.includes("[camera]") && text.includes("eye"));
      check(`${s.id}: the picture turns`, there !== stored);
      const q = v2.source.rows[v2.a];
      check(`${s.id}: errors are stated against the reference`, document.querySelector("#v2 .tag.a").textContent.includes(`max ${num(q.max)} levels`) && !document.querySelector("#v2 .tag.a").textContent.includes("from"));
      accessible(`${s.id}, turned`);
      await link(`${s.id}: a turned view is restored`, hash.slice(1), () => rested(v2)());
      check(`${s.id}: the link restores the picture to the byte`, await bytes(v2) === there);
      if (!v2.hand.sun.hidden) {
        v2.hand.sun.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowDown", shiftKey: true, bubbles: true }));
        await wait(40);
        await until(`${s.id}: the light moves`, () => rested(v2)() && v2.view.light);
        check(`${s.id}: the light changes the picture`, await bytes(v2) !== there);
      }
      const tab = new KeyboardEvent("keydown", { key: "Tab", bubbles: true, cancelable: true });
      check(`${s.id}: Tab leaves the divider`, v2.divider.dispatchEvent(tab));
      for (const input of v2.hand.panel.querySelectorAll("input[type=range]")) {
        const { handle } = input.dataset, before = await bytes(v2);
        slide(v2.hand.panel.querySelector(`[data-handle="${handle}"]`), handle === "exponent" ? 60 : input.max);
        await wait(40);
        await until(`${s.id}: ${handle} is moved`, rested(v2));
        if (handle === "size") check(`${s.id}: ${handle} changes the picture`, await bytes(v2) !== before);
        const held = () => v2.hand.panel.querySelector(`[data-handle="${handle}"]`);
        held().focus();
        v2.hand.controls();
        check(`${s.id}: ${handle} keeps the focus`, document.activeElement.dataset.handle === handle);
        const slider = held();
        slider.dispatchEvent(new PointerEvent("pointerdown", { bubbles: true }));
        v2.hand.controls();
        check(`${s.id}: ${handle} is not replaced while it is held`, slider === held());
        slider.dispatchEvent(new PointerEvent("pointerup", { bubbles: true }));
      }
      v2.stage.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft", bubbles: true }));
      await wait(40);
      await until(`${s.id}: by keys`, rested(v2));
      // The page writes the address a moment later.
      await wait(100);
      v2.hand.turnBy(50, 0);
      const { azimuth } = v2.view;
      dispatchEvent(new Event("resize"));
      await wait(700);
      check(`${s.id}: a new size of the window does not turn the model`, Math.abs(v2.view.azimuth - azimuth) < 1e-3);
      for (const mode of ["side", "error", "flip", "slide"]) { await v2.set({ mode }); await until(`${s.id}: ${mode}`, () => shown(v2).endsWith("|" + mode)); }
      v2.hand.panel.querySelector(".still").click();
      await until(`${s.id}: as stored`, () => isStill(v2.view) && v2.source === v2.scene);
      check(`${s.id}: the stored picture comes back`, await bytes(v2) === stored);
      labels(`${s.id}, live`);
    }
    // In every view the chart has all methods, not only in the first view.
    if (canTurn(SCENES[0])) {
      const [, left, right] = SCENES[0].list;
      await visit(`overview?left=${left}&right=${right}&turn=20,0`);
      await until("live: a link to a turned view", rested(v1));
      await until("live: all methods are drawn", () => v1.source.list?.every(m => m in v1.source.rows));
      v1.hand.turnBy(50, 0);
      await wait(60);
      await until("live: all methods are drawn of the next view", () => rested(v1)() && v1.source.list.every(m => m in v1.source.rows));
      await visit("scenes/" + turned[0].id);
    }
    // Drop mesh files, and a file that is not a mesh.
    const drop = (name, text) => {
      const bytes = new TextEncoder().encode(text);
      return v2.hand.drop({ preventDefault() {}, dataTransfer: { files: [{ name, size: bytes.length, arrayBuffer: async () => bytes.buffer }] } });
    };
    const before = v2.scene;
    await drop("bad.obj", "v 0 0\nf 1 2 3\n");
    check(`live: a bad file is refused: ${document.getElementById("toast").textContent}`, v2.scene === before && document.getElementById("toast").textContent.includes("bad.obj"));
    await drop("picture.png", "x");
    check("live: a file that is not a mesh is refused", v2.scene === before);
    await drop("own.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nf 1 2 3 4\n");
    await until("live: a dropped mesh is drawn", () => v2.scene.title === "own.obj" && shown(v2).startsWith("own|"));
    check("live: the dropped mesh has pixels", new Set(await bytes(v2).then(text => text.split(","))).size > 2);
    check("live: the dropped mesh's name is the title", document.getElementById("t-scenes").textContent === "own.obj");
    go(location.hash.slice(1));
    await until("live: the address leads back", () => v2.scene === before && v2.source === before);
    // The link has values out of range and parameters that do not exist.
    await visit(`scenes/${before.id}?turn=1e999,x&size=-5&sun=9e9,90&with=${BASE}:nosuch=1;${BASE};nosuch:x=1;constructor:x=1`);
    await until("live: a link that asks for too much", () => rested(v2)() && v2.view.size === 0.1 && !Object.keys(v2.view.given).length);
    const sun = v2.hand.sun.getBoundingClientRect(), stage = v2.stage.getBoundingClientRect();
    check("live: the light can be reached, wherever it is", v2.hand.sun.hidden || sun.top >= stage.top && sun.bottom <= stage.bottom);
    for (const odd of ["%", "constructor", "scenes/constructor", "lectures/constructor"]) {
      await visit(odd);
      check(`live: #${odd} shows a view`, document.querySelectorAll(".view.on").length === 1);
    }
    // Choose a scene while another one is still loading.
    const [first, second] = turned;
    if (second) {
      await visit("scenes/" + second.id);
      v2.hand.live = null;
      v2.set({ scene: first, view: { ...STILL, azimuth: 1 } });
      v2.set({ scene: second, view: { ...STILL, azimuth: 0.5 } });
      await until("live: the scene that was chosen last", () => rested(v2)() && v2.hand.live.scene === second && v2.view.azimuth);
    }
    await v2.set({ scene: SCENES[0] });
  };
  /* Checks the figures whose parameters the reader moves. */
  const handles = async () => {
    if (!CAN_DRAW) return;
    const moving = FIGURES.filter(f => f.live && !isTraced(f) && f !== SPHERES);
    for (const f of innerWidth < 800 ? moving.slice(0, 2) : moving) {
      await visit("lectures/" + f.name);
      const el = document.querySelector(".hands");
      await until(`${f.name}: drawn`, () => el.dataset.shown);
      const body = () => [...el.querySelectorAll(".live-body canvas")].map(c => c.toDataURL()).join() + el.querySelector(".live-body").textContent + el.querySelector(".verdicts").textContent + [...el.querySelectorAll("path")].map(p => p.getAttribute("d"));
      check(`${f.name}: there is a verdict`, el.querySelectorAll(".verdict .chip").length > 0);
      for (const input of el.querySelectorAll("input")) {
        const before = body(), values = el.dataset.shown, to = +input.value === +input.max ? input.min : input.max;
        slide(input, to);
        await until(`${f.name}: ${input.dataset.handle} is moved`, () => el.dataset.shown !== values);
        check(`${f.name}: ${input.dataset.handle} changes the figure`, body() !== before);
      }
      const point = el.querySelector("[data-point]");
      if (point) {
        const values = el.dataset.shown;
        point.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowUp", bubbles: true }));
        await until(`${f.name}: a corner is moved`, () => el.dataset.shown !== values);
        const again = el.dataset.shown;
        await drag(el.querySelector(".pad"), [.5, .58], [.5, .3]);
        await until(`${f.name}: a corner is dragged`, () => el.dataset.shown !== again);
      }
      await wait(300);
      const there = body(), hash = location.hash.slice(1);
      check(`${f.name}: values stand in the link`, hash.includes("?"));
      await visit("lectures");
      await visit(hash);
      await until(`${f.name}: restored`, () => document.querySelector(".hands")?.dataset.shown);
      const { textContent } = document.querySelector(".hands .verdicts");
      check(`${f.name}: the verdict is restored`, there.includes(textContent));
      document.querySelector(".hands .still").click();
      labels(`${f.name}, live`);
      accessible(`${f.name}, live`);
    }
  };
  const contrasts = where => {
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
      const node = walker.currentNode, el = node.parentElement;
      if (!node.data.trim() || !seen(el) || el.closest("script, template, noscript, option, .skip, title")) continue;
      const style = getComputedStyle(el), svg = el.closest("svg text"), halo = svg && style.stroke !== "none";
      const under = halo ? rgba(style.stroke) : background(el), ink = over(rgba(svg ? style.fill : style.color), under, rgba(svg ? style.fill : style.color)[3] * opacity(el));
      const [low, high] = [luminance(ink), luminance(under)].sort((a, b) => a - b), ratio = (high + .05) / (low + .05);
      count++;
      if (ratio < 4.5) failed.push(`${where}: contrast ${ratio.toFixed(2)} of "${node.data.trim().slice(0, 30)}" (${el.tagName}.${el.getAttribute("class") ?? ""})`);
    }
  };
  /* Checks that marks in charts stand out from their background. */
  const marks = where => {
    for (const el of document.querySelectorAll(".view.on .chartbox .mark")) {
      const under = background(el), ink = over(rgba(getComputedStyle(el).color), under, opacity(el)), [low, high] = [luminance(ink), luminance(under)].sort((a, b) => a - b);
      count++;
      if ((high + .05) / (low + .05) < 3) failed.push(`${where}: contrast ${((high + .05) / (low + .05)).toFixed(2)} of a mark of ${getComputedStyle(el).color}`);
    }
  };
  /* Checks that a point's label is nearest to its own mark or has a line to it, and covers no other mark. */
  const owned = where => {
    const points = [...document.querySelectorAll("#pareto .hit")].map(g => ({ g, mark: g.querySelector(".mark").getBoundingClientRect(), label: g.querySelector(".label")?.getBoundingClientRect() }));
    const far = ({ left, right, top, bottom }, { mark: m }) => Math.hypot(Math.max(0, left - (m.left + m.right) / 2, (m.left + m.right) / 2 - right), Math.max(0, top - (m.top + m.bottom) / 2, (m.top + m.bottom) / 2 - bottom));
    for (const p of points) if (p.label) for (const o of points) if (o !== p) {
      check(`${where}: the label ${p.g.dataset.key} lies on the mark of ${o.g.dataset.key}`, far(p.label, o) > 1 || points.length > 14);
      check(`${where}: the label ${p.g.dataset.key} is nearer to the mark of ${o.g.dataset.key}`, p.g.querySelector(".leader") || far(p.label, o) >= far(p.label, p) - 1);
    }
  };
  const accessible = where => {
    const { dataset } = document.documentElement, before = dataset.theme;
    for (const theme of ["light", "dark"]) {
      dataset.theme = theme;
      contrasts(`${where}, ${theme}`);
      marks(`${where}, ${theme}`);
    }
    if (before) dataset.theme = before; else delete dataset.theme;
    const headings = [...document.querySelectorAll("h1, h2, h3, h4, h5, h6")].filter(seen).map(h => +h.tagName[1]);
    check(`${where}: one first heading`, headings[0] === 1 && headings.filter(h => h === 1).length === 1);
    check(`${where}: no heading skips a level: ${headings}`, headings.every((h, i) => !i || h <= headings[i - 1] + 1));
    const named = el => (el.getAttribute("aria-label") ?? document.getElementById(el.getAttribute("aria-labelledby"))?.textContent ?? el.getAttribute("title") ?? el.getAttribute("alt") ?? (el.labels?.[0] ?? el).textContent ?? "").trim();
    for (const el of document.querySelectorAll("button, a, select, input, img, [role]")) if (seen(el) && !el.closest("[aria-hidden=true]")) check(`${where}: no name for ${el.outerHTML.slice(0, 80)}`, /[\p{L}\d]/u.test(named(el)) || el.getAttribute("alt") === "");
    for (const el of document.querySelectorAll("canvas, svg")) if (seen(el)) check(`${where}: neither named nor hidden: ${el.outerHTML.slice(0, 80)}`, el.closest("[aria-hidden=true]") || named(el));
    const controls = [...document.querySelectorAll("button, a[href], select, input, summary, [tabindex], .hit")].filter(el => seen(el) && el.tabIndex >= 0 && !el.disabled);
    for (const el of controls) {
      el.focus({ preventScroll: true });
      const shown = [el, el.parentElement, ...el.children].some(e => getComputedStyle(e).outlineStyle !== "none" && getComputedStyle(e).outlineWidth !== "0px");
      check(`${where}: the focus does not show on ${el.outerHTML.slice(0, 80)}`, document.activeElement === el && shown);
    }
    for (const el of document.querySelectorAll(".view.on :is(.hit, [role=button], .scroll, pre)")) if (seen(el)) check(`${where}: not reached by Tab: ${el.outerHTML.slice(0, 60)}`, el.tabIndex === 0 || el.matches("a"));
    document.activeElement.blur();
  };
  const wasTooBusy = ({ noise }) => !!noise && noise.trust === "too-busy", leaves = n => n ? `Too busy to time: ${plural(n, "scene")}.` : "";
  /* The columns of a scene's table that have values, if all are shown. */
  const columns = s => COLUMNS.filter(([key]) => Object.values(s.rows).some(q => q[key] != null)).length;
  const link = async (what, hash, is) => { await visit("measured"); await visit(hash); await until(what, is); };
  const tell = async () => {
    await wait(300);
    return `${failed.length ? "FAILED" : "PASSED"} ${count} checks\n${[...new Set(failed)].join("\n")}`.trim();
  };
  // Workers need real time, so exercises are tried in a separate window.
  if (location.search === "?hands") {
    await checkHands({ check, until, visit, wait, seen, accessible, contrasts }).catch(e => failed.push("stopped: " + e.stack));
    return console.log("HANDS " + (await tell()).replaceAll("\n", "; "));
  }
  try {
    // Ratios have as many digits as their intervals leave known.
    for (const [typical, half, text] of [[1, 0, "1.00"], [0.2, 0.004, "0.20"], [1.05, 0.02, "1.05"], [1.43, 0.05, "1.4"], [1.43, 0.04, "1.43"], [1.43, 0.2, "about 1.4"], [12.3, 0.5, "12"], [12.3, 0.2, "12.3"], [1.43, 0.5, null]])
      check(`digits of ${typical} ± ${half}`, ratioText({ typical, low: typical - half, high: typical + half }) === (text ? text + TIMES : "–"));
    check("a tie is marked, and the baseline is not", ratioText({ typical: 1, low: 0.98, high: 1.02, tie: true }) === "= 1.00" + TIMES && ratioText({ typical: 1, low: 1, high: 1, tie: true }) === "1.00" + TIMES && ratioText(null) === "–");
    const scenes = SCENES.length, drawn = scenes && PICTURES;
    // The course may be long, because it is read in one scroll.
    if (IDS.length <= 11) for (const v in FILLED) if (FILLED[v] && v !== "course") {
      await visit(v);
      if (v !== "course") check(`${v}: ${document.documentElement.scrollHeight / innerHeight} screens`, document.documentElement.scrollHeight <= 6 * innerHeight);
    }
    if (scenes) {
      await visit("overview");
      if (drawn) {
        await until("overview: the viewer shows", () => shown(v1));
        const marks = [...document.querySelectorAll("#pareto .hit")];
        check("overview: a mark for each method", marks.length === IDS.length);
        for (const m of [...IDS].slice(-3)) {
          document.querySelector(`#pareto .hit[data-key="${CSS.escape(m)}"]`).dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true }));
          await until(`overview: ${m} is shown when its mark is chosen`, () => shown(v1).split("|")[1] === m);
        }
        for (const b of document.querySelectorAll("#pareto-basis button")) { b.click(); owned(`overview, ${b.textContent}`); labels(`overview, ${b.textContent}`); }
        for (const b of document.querySelectorAll("#v1 .choices button")) { b.click(); await until("overview: a scene is chosen", () => shown(v1).startsWith(b.dataset.key + "|")); }
      }
      labels("overview");
      for (const a of document.querySelectorAll("[data-scene]")) {
        const { scene } = M[a.dataset.of];
        check(`overview: the worst scene of ${a.dataset.of} is linked`, a.textContent === scene.title && a.getAttribute("href").startsWith(`#scenes/${scene.id}?left=${a.dataset.of}&`));
      }
      const untold = SCENES.filter(wasTooBusy);
      if (drawn && MANY) {
        document.querySelector("#pareto-basis [data-key=all]").click();
        check("overview: the chart says how many scenes have no times", document.querySelector("#pareto-sub").textContent.includes(leaves(untold.length)));
        check("overview: the chart has no times if the machine was too busy everywhere", untold.length < scenes || document.querySelector("#pareto").textContent.includes("too busy"));
      }
      if (FILLED.strip) {
        check("overview: the strip has no scene without times", untold.every(s => !document.querySelector(`#strip a[href="#scenes/${s.id}"]`)));
        check("overview: the strip says how many are left out", document.querySelector("#strip").textContent.includes(leaves(untold.length)));
      }
      accessible("overview");
      const words = [...document.querySelectorAll("#overview p")].filter(p => p.offsetParent).map(p => p.textContent.trim()).join(" ").split(/\s+/).length;
      // The spheres' sentences take forty of these words, and the answers' cards up to 120.
      check(`overview: ${words} words of running text`, words < 220);
      for (const s of new Set([SCENES[0], ...untold.slice(0, 1), SCENES[scenes - 1]])) {
        await visit(`scenes/${s.id}`);
        check(`${s.id}: title`, document.querySelector("#t-scenes").textContent === s.title);
        check(`${s.id}: a row for each method`, document.querySelectorAll("#table tbody tr").length >= Math.min(15, s.list.length));
        for (const b of ["cols", "bary"]) document.getElementById(b).click();
        check(`${s.id}: more columns and rows`, document.querySelectorAll("#table thead th").length === 1 + columns(s) && (document.querySelector("#table .bary") || !s.barycentric.length || document.querySelector("#table .fold")));
        accessible(`${s.id}: table`);
        const heads = [...document.querySelectorAll("#table thead button")].map(b => b.dataset.key), isTold = s.list.some(m => s.rows[m].ratio);
        check(`${s.id}: times and speeds only where they are known: ${heads}`, ["ms", "ratio"].every(k => heads.includes(k) === isTold) && !(isTold && untold.includes(s)));
        check(`${s.id}: work on several threads`, heads.includes("work") === s.list.some(m => s.rows[m].work));
        check(`${s.id}: how far times can be trusted`, document.querySelector("#scene-trust").textContent === (s.noise ? `${sentence(s.noise.sentence)}.` : ""));
        for (const b of ["cols", "bary"]) document.getElementById(b).click();
        if (TIMED) check(`${s.id}: speeds have whiskers`, [...document.querySelectorAll("#table .speed")].every(el => el.querySelectorAll(".whisker").length === 3) && document.querySelector(".tablebox .sub").textContent.includes("logarithmic"));
        for (const k of ["name", "max", "rms", "ms", "ratio", "ratio"]) document.querySelector(`#table thead [data-key=${k}]`)?.click();
        if (!drawn) continue;
        await until(`${s.id}: the viewer shows`, () => shown(v2).startsWith(s.id + "|"));
        for (const [k, mode] of [["f", "flip"], ["d", "side"], ["e", "error"], ["s", "slide"]]) { key(k); await until(`${s.id}: ${mode}`, () => shown(v2).endsWith("|" + mode)); }
        for (const b of document.querySelectorAll("#v2 .vbar .seg button")) b.click();
        key("s");
        for (const m of IDS.filter(i => M[i].key && s.list.includes(i))) {
          key(M[m].key);
          await until(`${s.id}: key ${M[m].key} puts ${m} on the left`, () => v2.a === m);
          key(M[m].key, { shiftKey: true });
          await until(`${s.id}: with shift on the right`, () => v2.b === m);
        }
        key("0", { shiftKey: true });
        await until(`${s.id}: 0 is the reference`, () => v2.b === "reference");
        const worst = s.list.find(m => s.rows[m].worst && s.rows[m].max > 1);
        if (worst) {
          await v2.set({ a: worst });
          key("w");
          check(`${s.id}: worst pixel`, v2.pin?.join() === s.rows[worst].worst.join() && v2.z === 12);
          await until(`${s.id}: the probe tells of it`, () => document.querySelector("#probe h2").textContent.includes(v2.pin.join(", ")));
          key("r");
          await until(`${s.id}: a row is plotted`, () => document.querySelector("#rowplot-chart svg"));
          key("r");
        }
        for (const k of ["+", "-", "z", " ", " ", "x", "x", "ArrowLeft", "ArrowRight", "p"]) key(k);
        for (const b of document.querySelectorAll("#v2 .zoom button")) b.click();
        const { px } = await picture(s, s.list[0]), there = (await picture(s, "reference")).px;
        check(`${s.id}: a colour for each pixel`, px.length === 4 * s.w * s.h);
        // Maps do not depend on the window's width, so try them at one width.
        if (innerWidth < 800) for (const m of s.list) {
          const map = await errors(s, m), most = map.reduce((a, e) => Math.max(a, e), 0);
          check(`${s.id}: an error for each pixel of ${m}`, map.length === s.w * s.h);
          // Rounding moves each of two linear pictures by half a level.
          if (s.encoding !== "srgb" && !s.rows[m].other) check(`${s.id}: the map of ${m} reaches its largest error, ${most} against ${s.rows[m].max}`, Math.abs(most - s.rows[m].max) <= 1.001);
          if (s.encoding !== "srgb" && m === s.list[0]) check(`${s.id}: errors are differences`, map.every((e, i) => e === Math.max(...[0, 1, 2].map(c => Math.abs(px[4 * i + c] - there[4 * i + c])))));
        }
        const m = s.list[s.list.length - 1];
        await link(`${s.id}: a link is restored`, `scenes/${s.id}?left=${encodeURIComponent(m)}&right=reference&mode=error&x=3&y=2&zoom=4&row=2`, () => v2.a === m && v2.mode === "error" && v2.pin?.join() === "3,2" && v2.z === 4 && v2.line === 2);
        labels("scenes");
        accessible("scenes");
        showRow(v2, null);
      }
      if (scenes > 1) { const before = v2.scene; key("]"); await until("the next scene", () => v2.scene !== before); key("["); await until("the scene before", () => v2.scene === before); }
      await live();
      await visit("methods");
      const most = innerWidth < 1200 ? 6 : 12, articles = IDS.length < 1.2 * most ? IDS.length : most;
      check("methods: an article for each method", document.querySelectorAll(".method").length === articles);
      check("methods: formulas are mathematics", document.querySelectorAll("#methodlist math").length >= articles - 1);
      labels("methods");
      accessible("methods");
      document.querySelector("#methodlist .fold")?.click();
      check("methods: all methods are listed", document.querySelectorAll(".method").length === IDS.length);
    }
    if (STUDY || D.scaling || DOCS.length > 1) {
      await visit("speed");
      labels("speed");
      if (STUDY) check("speed: how far times can be trusted", document.querySelector("#study-trust").textContent.toLowerCase() === (STUDY.noise ? `${STUDY.noise.sentence}.` : "").toLowerCase());
      const points = D.scaling?.points.filter(wasTooBusy).length;
      if (points) check("speed: growth says which points are left out", document.querySelector("#growth-trust").textContent.includes(`Too busy to time: ${plural(points, "point")}.`));
      if (DOCS.length > 1) {
        const shared = D.comparisons.filter(c => DOCS.every(d => d.comparisons.some(o => o.name === c.name))).map(c => DOCS.map(d => wasTooBusy(d.comparisons.find(o => o.name === c.name))));
        const asked = DOCS.map((_, i) => shared.some(busy => !busy[i])), left = shared.filter(busy => busy.some((is, i) => is && asked[i])).length;
        if (shared.length > 1) check("speed: machines are compared over scenes that none was too busy for", document.querySelector("#beside-left").textContent === leaves(left));
        check("speed: errors of machines stay", [...document.querySelectorAll("#beside td")].every(td => /^(–|(.* ms · .*|–) · [^ ]+ levels)$/.test(td.textContent)));
      }
      for (const c of oneLight) {
        const [first, ...others] = fastest(c), reaches = m => ratioIn(m, c).high >= ratioIn(first, c).low;
        const row = document.querySelector("#speed-summary tbody tr").cells[1 + oneLight.indexOf(c)].textContent;
        check(`speed: a fastest method only if its interval is apart: ${row}`, row.startsWith(nameOf(first.method)) && row.includes(" or ") === others.length > 0 && STUDY.methods.every(m => !ratioIn(m, c) || (M[m.method]?.max ?? m.levels_off) > 1 || m === first || others.includes(m) === reaches(m)));
      }
      if (STUDY) check("speed: the same picture is the Overview's", [...document.querySelectorAll("#corners .hit")].map(a => a.getAttribute("href").slice(9)).every(m => !M[m] || M[m].max === undefined || M[m].max <= 1));
      document.querySelectorAll("#corner-mode button").forEach(b => b.click());
      labels("speed, all");
      accessible("speed");
    }
    await checkSpheres({ check, until, visit, wait, seen, drag });
    if (FIGURES.length) await handles();
    if (FIGURES.length) {
      for (const h of ["lectures", "lectures/wrong", "lectures/all"]) { await visit(h); check(h, document.querySelector("#lecture-body").textContent.length > 200); labels(h); accessible(h); }
      const tabs = document.querySelector("#lecture-tabs").getBoundingClientRect();
      check("lectures: the title touches the tabs", tabs.top - document.querySelector("#t-lectures").getBoundingClientRect().bottom >= 8);
      await visit("lectures");
      document.querySelector("#lecture-body .fold")?.click();
      check("lectures: all figures", FIGURES.length === 1 || document.querySelectorAll(".fcard").length === FIGURES.length);
      await visit("lectures/all");
      document.querySelector("#lecture-body .fold")?.click();
      check("lectures: all findings", document.querySelectorAll(".findings tbody tr").length === FINDINGS.length);
      let before = [];
      for (const tr of document.querySelectorAll(".findings tbody tr")) {
        const [figure, finding] = [...tr.cells].map(c => c.textContent);
        check(`lectures: repeated: ${figure || finding}`, (!figure || figure !== before[0]) && (!finding || figure || finding !== before[1]));
        before = [figure || before[0], finding || before[1]];
      }
      for (const f of FIGURES) { await visit("lectures/" + f.name); check(`figure ${f.name}`, document.querySelector(".fig h2")?.textContent === f.title && document.querySelectorAll(".findings tbody tr").length === f.findings.length); labels(f.name); if (f === FIGURES[0] || f.name === "slerp") accessible(f.name); }
    }
    if (CHAPTERS.length) await checkCourse({ check, until, wait, visit, seen, slide, labels, accessible });
    await visit("measured");
    check("measured: the processor is named", document.querySelector("#machine").textContent.includes(D.machine.cpu));
    labels("measured");
    accessible("measured");
    for (const b of ["theme", "theme", "big", "big", "help"]) document.getElementById(b).click();
    check("help opens", document.getElementById("keys").open);
    contrasts("keys");
    document.getElementById("keys").close();
    dispatchEvent(new Event("beforeprint"));
    check("print: exactly the views with content are printed", [...document.querySelectorAll(".view")].every(s => s.classList.contains("on") === !!FILLED[s.id]));
    check("print: all chapters have their figures", [...document.querySelectorAll("#course :is(.live, .found)")].every(el => el.querySelector(".chip, .more, .verdicts, .stop") || !figureNamed(el.dataset.figure)));
    dispatchEvent(new Event("afterprint"));
  } catch (e) { failed.push("stopped: " + e.stack); }
  parent.postMessage(await tell(), "*");
})();
