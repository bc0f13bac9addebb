/* Checks the figure that can be stopped: every step of every method, its numbers against the trace, questions, corners, keys and
   addresses. It runs after the page's own script, in a frame that `tests/page/run` opens, and reports to the page around the frame. */
(async () => {
  const failed = [], wait = ms => new Promise(r => setTimeout(r, ms));
  addEventListener("error", e => failed.push("error: " + e.message));
  addEventListener("unhandledrejection", e => failed.push("rejected: " + (e.reason?.stack ?? e.reason)));
  let count = 0;
  const check = (what, is) => { count++; if (!is) failed.push(what); };
  const until = async (what, is) => { for (let i = 0; i < 300 && !is(); i++) await wait(20); check(what, is()); };
  const visit = async h => { location.hash = h; await wait(150); };
  const figure = () => stopFigures.get("lectures");
  const key = (k, on = document.body, o = {}) => on.dispatchEvent(new KeyboardEvent("keydown", { key: k, bubbles: true, cancelable: true, ...o }));
  const query = () => Object.fromEntries(new URLSearchParams(location.hash.split("?")[1]));
  const $in = (selector, root = figure().root) => root.querySelector(selector);

  /* Returns all numbers that the trace has at a step, and the differences and ratios of two of them that the step may show. */
  const allowed = (s, e) => {
    const pool = [1, e.row, e.row + .5];
    const add = v => { if (typeof v === "number") pool.push(v); else if (v && typeof v === "object") Object.values(v).forEach(add); };
    const minus = (a, b) => a && b && a.forEach((v, i) => pool.push(v - b[i]));
    const edges = [e.edge, e.a?.edge, ...(e.gone ?? [])].filter(Boolean);
    for (const { top, bottom, first, end } of edges) {
      const [a, b] = [top, bottom].map(i => s.trace.vertices[i].at.map(c => c / s.trace.unit));
      add([a, b, first, end, e.row + .5 - a[1]]);
      minus(b, a);
    }
    const line = s.trace.lines[e.row] ?? s.trace.lines[e.edge?.first];
    const placeOf = a => a.pixel + .5 - a.rest[0] / a.rest[1];
    const crossing = a => add([a.at, a.by, a.pixel, a.rest, a.circle, placeOf(a), a.step[0] + a.step[1] / a.rest[1]]);
    line?.active.forEach(crossing);
    s.trace.lines[e.row - 1]?.active.forEach(crossing);
    if (e.entered) { add([e.entered]); minus(e.entered.to, e.entered.from); }
    const ends = e.span ?? e.run?.span;
    if (ends) { add([ends.t0, ends.dt, ends.depth, ends.depths]); minus(ends.right.at, ends.left.at); pool.push(placeOf(ends.right) - placeOf(ends.left)); }
    e.tests?.forEach(t => add([t.z, t.old?.z]));
    if (e.run) {
      const truth = s.traces["naive-phong"].lines[e.row].runs.find(r => r.x === e.run.x), i = (e.p?.x ?? e.run.x) - e.run.x;
      const inside = Object.values(e.run.inside ?? {}).flatMap(list => [list[i], list[i - 1]]);
      add([e.run.t0, e.run.dt, e.run.at, e.run.by, e.run.values[i], e.run.values[i - 1], inside, e.run.colours[i]]);
      const root = truth?.inside.d[i][0], d = e.run.values[i]?.[s.names.pixel.indexOf("d")];
      if (root) { add([root]); pool.push(255 * (e.run.colours[i][0] - truth.colours[i][0]), .05); }
      if (root && d) pool.push(100 * (d / root - 1));
      if (s.method === "naive-phong") e.run.values[i].forEach(c => pool.push(c / root));
      const { t, rest } = e.run.inside ?? {};
      if (t) pool.push([t[0], rest[0]].map(([a, b]) => Math.atan2(a, b) * 180 / Math.PI).reduce((a, b) => a + b));
    }
    return pool.map(Math.abs);
  };
  const numbers = text => [...text.matchAll(/(\d+)(?:\.(\d+))?(?:·10−(\d+))?/g)].map(([all, , digits = "", power = 0]) => ({ all, value: parseFloat(all) * 10 ** -power, within: .5001 * 10 ** -(digits.length + +power) }));
  const checkNumbers = (s, e) => {
    const pool = allowed(s, e);
    for (const v of s.root.querySelectorAll(".s-eq .s-v")) {
      const text = v.innerHTML.replace(/<br>/g, " ").replace(/<[^>]*>/g, "");
      for (const { all, value, within } of numbers(text)) check(`${s.variant}, step ${e.i}, ${e.k}: ${all} is not a number of the trace: ${text}`, pool.some(p => Math.abs(p - value) <= within + 1e-9));
    }
  };

  const steps = s => {
    for (const v of s.variants) {
      s.show(v, s.now);
      const kinds = new Set();
      const stride = innerWidth === 1400 ? 1 : 7;
      for (let i = 0; i < s.events.length; i += stride) {
        s.go(i);
        const e = s.now, odd = /NaN|undefined|null|Infinity|\[object/.exec(s.root.innerHTML);
        check(`${v}, step ${i}: ${odd?.[0]}: ${odd && s.root.innerHTML.slice(odd.index - 60, odd.index + 30)}`, !odd);
        check(`${v}, step ${i}: the step is described`, $in(".s-say").textContent.length > 20);
        kinds.add(e.k);
        checkNumbers(s, e);
      }
      if (stride === 1) check(`${v}: all kinds of steps: ${[...kinds]}`, ["bucket", "empty", "retire", "step", "enter", "sort", "span", "depth", "run", "pixel", "ask", "end"].every(k => kinds.has(k)));
      const drawn = new Map();
      for (const e of s.events) if (e.p) { const at = e.row * s.trace.size[0] + e.p.x; check(`${v}: pixel ${at} is drawn twice`, !drawn.has(at)); drawn.set(at, e); }
      s.go(s.events.length - 1);
      const fills = [...s.root.querySelectorAll(".s-stage rect")].map(r => r.getAttribute("fill"));
      for (const [, e] of drawn) check(`${v}: a colour of the trace is not on the stage`, fills.includes(screenColour(e.p.colour)));
    }
  };

  /* Answers each question right and wrong. */
  const questions = async s => {
    s.chooseMethod("gouraud");
    for (const isRight of [true, false]) {
      s.answers = {};
      for (const ask of ["edges", "shared", "next"]) {
        await visit(`lectures/stop?ask=${ask}&n=${isRight}`);
        const e = s.now, box = $in(".s-ask");
        check(`ask=${ask}: it is asked`, e.ask === ask && !box.hidden);
        const choice = i => box.querySelector(`[data-choice="${i}"]`);
        if (ask === "edges") {
          const line = s.trace.lines[e.target.row].active.map(a => a.edge);
          s.edges.forEach(d => { if (line.includes(d.id) !== (choice(d.id).ariaPressed === "true")) choice(d.id).click(); });
          if (!isRight) choice(line[0]).click();
        }
        if (ask === "shared") {
          const owner = x => s.events.find(v => v.p?.x === x && v.row === e.row).run.polygon;
          check("ask=shared: nothing is checked before all are chosen", box.querySelector("[data-do=check]").disabled);
          e.meet.owners.forEach(({ x }, i) => { do choice(i).click(); while (s.answers.shared.own[i] !== owner(x)); });
          if (!isRight) choice(1).click();
        }
        if (ask === "next") {
          const slide = box.querySelector("input");
          slide.value = e.target.p.values[0] + (isRight ? .004 : .2);
          slide.dispatchEvent(new Event("input", { bubbles: true }));
          check("ask=next: the strip follows", $in(".s-guess"));
        }
        box.querySelector("[data-do=check]").click();
        check(`ask=${ask}: ${isRight ? "right" : "wrong"} is answered as such: ${box.textContent}`, !!box.querySelector(".s-verdict .good") === isRight && !!box.querySelector(".s-verdict .bad") === !isRight);
        check(`ask=${ask}: the focus goes on`, document.activeElement.dataset.do === "on");
        check(`ask=${ask}: the list shows its mark`, $in(`[data-ask=${ask}]`).textContent === (isRight ? "✓" : "✗"));
        check(`ask=${ask}: its verdict is announced`, $in(".s-say").textContent.includes(isRight ? "Right" : "Not quite"));
        const { at } = s;
        document.activeElement.click();
        check(`ask=${ask}: go on`, s.at === at + 1);
        check(`ask=${ask}: the focus is on Step`, document.activeElement.dataset.do === "forth");
      }
    }
    s.answers = {};
    await visit("lectures/stop?ask=shared&n=shown");
    $in("[data-do=show]").click();
    check("ask: showing an answer does not count as a failure", !$in(".s-ask .bad, .s-ask .s-wrong") && $in("[data-ask=shared]").textContent === "·");
  };

  /* Moves corners by key and by pointer. The traces follow, also those of the other methods. */
  const corners = async s => {
    await visit("lectures/stop?method=fast-phong&steps=1&line=6&x=9");
    if (!s.canMove) return check("no WebAssembly: the page says so", $in(".s-hint").textContent.includes("cannot"));
    const hand = s.root.querySelectorAll(".s-hand")[2], x = s.corners[2][0];
    hand.focus();
    key("ArrowRight", hand);
    await until("a corner is moved by a key", () => s.corners[2][0] === x + .125);
    check("a moved corner keeps the focus", document.activeElement === hand);
    await until("all methods are traced again", () => s.variants.every(v => s.traces[v] && s.traces[v] !== s.stored[v]));
    check("moving a corner keeps the step", s.now.row === 6 && s.now.p?.x === 9);
    checkNumbers(s, s.now);
    const box = hand.querySelector(".s-dot").getBoundingClientRect();
    const fire = (type, dx, dy) => hand.dispatchEvent(new PointerEvent(type, { pointerId: 1, clientX: box.x + 4.5 + dx, clientY: box.y + 4.5 + dy, bubbles: true, cancelable: true }));
    hand.setPointerCapture = () => {};
    const before = s.trace;
    fire("pointerdown", 0, 0);
    for (const d of [5, 10, 20, 30]) { fire("pointermove", -d, -d); await wait(40); }
    fire("pointerup", -30, -30);
    await until("a corner is dragged", () => s.trace !== before && s.corners[2][0] < x);
    await wait(1000);
    check(`the address has it: ${location.hash}, ${s.corners[2]}`, Math.abs(query().x3 - s.corners[2][0]) < 1e-3);
    const moved = String(s.corners), hash = location.hash.slice(1);
    $in("[data-do=first]").click();
    check("the first corners come back", s.traces === s.stored && s.corners[2][0] === x);
    await wait(400);
    await visit(hash);
    await until("a link brings moved corners back", () => String(s.corners) === moved && s.now.p?.x === 9);
    await visit("lectures/stop?method=gouraud");
    check("another link has the first corners", s.traces === s.stored);
  };

  const driving = async s => {
    await wait(400);
    await visit("lectures/stop?method=gouraud&line=6&x=9");
    check("a link leads to the middle of a span", s.method === "gouraud" && s.now.row === 6 && s.now.p?.x === 9);
    $in(".s-frame").scrollIntoView();
    const { at } = s;
    key("ArrowRight");
    check("→ is a step", s.at === at + 1);
    key("ArrowLeft");
    check("← is a step back", s.at === at);
    key("n");
    check("n is the next line or question", s.now.row === 7 || s.now.k === "ask");
    key("p");
    key("3");
    check("3 is fast Phong", s.method === "fast-phong" && $in("[data-method=fast-phong]").ariaPressed === "true");
    key("End", $in(".s-go"));
    check("End is the end", s.now.k === "end");
    key("Home", $in(".s-go"));
    check("Home is the start", s.at === 0);
    $in('[data-speed="2"]').click();
    $in("[data-do=play]").click();
    const said = $in(".s-say").textContent;
    await until("it plays", () => s.at > 3);
    check("steps are not announced while it plays", $in(".s-say").textContent === said);
    await until("and stops at a question", () => !s.timer);
    check("playing stops at a question", s.now.k === "ask");
    $in("[data-do=line-forth]").focus();
    key("End", document.activeElement);
    check("Next line keeps the focus at the end", document.activeElement.ariaDisabled === "true");
    $in("[data-do=play]").click();
    await visit("lectures/newell");
    await wait(1000);
    check(`a figure that is left stops and leaves the address alone: ${location.hash}`, !s.timer && location.hash === "#lectures/newell");
    for (const [hash, is] of [
      ["method=fast-phong&steps=2&line=9&x=7", e => s.variant === "fast-phong:steps=2" && e.row === 9 && e.p?.x === 7],
      ["method=fast-phong&line=9&event=span&polygon=3", e => s.variant === "fast-phong" && e.k === "span" && e.span.polygon === 3 && e.row === 9],
      ["method=slerp-phong&event=end", e => s.method === "slerp-phong" && e.k === "end"],
      ["event=bucket&edge=A2", e => e.k === "bucket" && e.edge.name === "A2"],
      ["line=3", e => e.row === 3],
      ["try=newton", e => s.variant === "fast-phong:steps=1" && isLate(s.value(e.p, "d"), s.truth(e.row, e.p.x).d)],
      ["try=depth", e => e.tests.some(t => t.old && t.seen) && e.tests.some(t => t.old && !t.seen)],
      ["try=edge", e => e.ask === "shared"],
      ["try=highlight", e => e.k === "end"],
      ["method=nosuch&steps=9&line=99&x=-1&event=%3Cb%3E", e => s.method === "gouraud" && e],
    ]) {
      await visit("lectures/stop?" + hash);
      check(`#lectures/stop?${hash} leads to ${s.variant}, ${s.now.k} of line ${s.now.row}`, is(s.now));
      await wait(300);
      check(`${hash}: the address is corrected: ${location.hash}`, !location.hash.includes("nosuch"));
      const [kept, variant] = [s.now, s.variant];
      s.address = "";
      s.follow(new URLSearchParams(location.hash.split("?")[1]));
      check(`${hash}: its own address leads back`, s.variant === variant && (s.now === kept || s.now.k === kept.k && s.now.row === kept.row && polygonOf(s.now) === polygonOf(kept)));
    }
    await visit("stop?method=naive-phong&line=9&x=7");
    await until("#stop leads to the figure", () => location.hash.startsWith("#lectures/stop?") && s.method === "naive-phong" && s.now.p?.x === 7);
    const x = s.now;
    dispatchEvent(new Event("resize"));
    await wait(300);
    check("a new size of the window keeps the step", s.now === x && s.root.isConnected);
    await visit("lectures/stop?method=gouraud&bare");
    check("bare: only the figure is shown", s.isBare && !document.querySelector(".top").checkVisibility({ visibilityProperty: true }) && $in(".s-stage").checkVisibility({ visibilityProperty: true }));
    check("bare: it fits", s.root.scrollWidth <= s.root.clientWidth + 1);
    check("bare: Play is on the screen", $in(".s-keys").getBoundingClientRect().bottom <= innerHeight);
    key("Escape");
    check("Escape shows the page", !s.isBare && document.querySelector(".top").checkVisibility({ visibilityProperty: true }));
    $in("[data-do=bare]").click();
    await visit("lectures/newell");
    check("bare: another figure shows the page", document.querySelector(".top").checkVisibility({ visibilityProperty: true }));
    const { now } = s;
    await visit("lectures/stop");
    check("the figure is found unchanged after a visit elsewhere", s.now === now && s.root.isConnected && !s.isBare);
  };

  /* Checks names, sizes and contrast, and that equal terms light up together. */
  const looks = async s => {
    const boxes = [...s.root.querySelectorAll("button, input, [tabindex]")].filter(el => el.checkVisibility());
    for (const el of boxes) check(`a control without a name: ${el.outerHTML.slice(0, 90)}`, el.ariaLabel || el.textContent.trim() || el.title);
    for (const el of boxes) {
      if (!el.matches("button, input")) continue;
      const { height } = el.getBoundingClientRect();
      check(`under 34 px high: ${el.outerHTML.slice(0, 90)}: ${height}`, height >= 33.9 || el.matches(".s-track button"));
    }
    check(`wider than the window: ${document.documentElement.scrollWidth}`, document.documentElement.scrollWidth <= innerWidth + 1);
    check("the stage is cut off", $in(".s-stage").getBoundingClientRect().right <= innerWidth);
    const legend = $in(".s-legend [data-term=I]");
    legend.dispatchEvent(new PointerEvent("pointerover", { bubbles: true }));
    const lit = [...s.root.querySelectorAll("[data-term=I]")].filter(el => getComputedStyle(el).backgroundColor !== "rgba(0, 0, 0, 0)" || el.ownerSVGElement);
    check("a term lights up in the card, too", lit.some(el => el.closest(".s-eq")));
    document.body.dispatchEvent(new PointerEvent("pointerover", { bubbles: true }));
    check("the term goes out again", !document.querySelector("[data-lit]"));
    const text = document.createElement("p");
    text.textContent = "So I_next = I_current + ΔI, d/D, in and I_p k_d; don’t: N·N, N_vertex, J₁, t₀, sin tφ.";
    markTerms(text);
    check(`terms are marked: ${text.innerHTML}`, [...text.children].map(c => c.textContent).join(" ") === "I I ΔI d D N N J t t φ");
  };

  try {
    await visit("lectures/stop");
    await until("the figure is shown", () => figure()?.width);
    const s = figure();
    check("it begins in the middle of a span", s.method === "gouraud" && s.now.row === 6 && s.now.p?.x === 9);
    await wait(400);
    check("the address stays while nothing is touched", location.hash === "#lectures/stop");
    for (const theme of ["light", "dark"]) {
      ROOT.dataset.theme = theme;
      await looks(s);
    }
    delete ROOT.dataset.theme;
    steps(s);
    await driving(s);
    await questions(s);
    await corners(s);
    await looks(s);
  } catch (e) { failed.push("stopped: " + e.stack); }
  await wait(300);
  parent.postMessage(`${failed.length ? "FAILED" : "PASSED"} ${count} checks\n${[...new Set(failed)].slice(0, 40).join("\n")}`.trim(), "*");
})();
