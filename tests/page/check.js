/* Uses every control of the report's page, as `tests/page/run` opens it in a headless Chromium. The result stands in #checked. */
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
  /* Labels of charts that overlap, and what is wider than the window. */
  const labels = where => {
    for (const svg of document.querySelectorAll(".view.on .chartbox svg")) {
      const boxes = [...svg.querySelectorAll("text.label")].map(t => [t.textContent, t.getBoundingClientRect()]);
      boxes.forEach(([a, p], i) => boxes.slice(i + 1).forEach(([b, q]) => {
        const over = Math.min(p.right, q.right) - Math.max(p.left, q.left) > 1 && Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > 4;
        if (over) failed.push(`${where}: "${a}" lies over "${b}"`);
      }));
    }
    check(`${where}: wider than the window`, document.documentElement.scrollWidth <= innerWidth + 1);
    check(`${where}: a picture without an alternative`, ![...document.images].some(i => !i.hasAttribute("alt")));
  };
  const link = async (what, hash, is) => { await visit("measured"); await visit(hash); await until(what, is); };
  try {
    const scenes = SCENES.length, drawn = scenes && PICTURES;
    if (scenes) {
      await visit("overview");
      if (drawn) {
        await until("overview: the viewer shows", () => shown(v1));
        const marks = [...document.querySelectorAll("#pareto .hit")];
        check("overview: a mark a method", marks.length === IDS.length);
        for (const m of [...IDS].slice(-3)) {
          document.querySelector(`#pareto .hit[data-m="${CSS.escape(m)}"]`).dispatchEvent(new KeyboardEvent("keydown", { key: "Enter", bubbles: true }));
          await until(`overview: ${m} is shown when its mark is chosen`, () => shown(v1).split("|")[1] === m);
        }
        document.querySelectorAll("#pareto-basis button").forEach(b => b.click());
        for (const b of document.querySelectorAll("#v1 .scn button")) { b.click(); await until("overview: a scene is chosen", () => shown(v1).startsWith(b.dataset.s + "|")); }
      }
      labels("overview");
      const words = [...document.querySelectorAll("#overview p")].filter(p => p.offsetParent).map(p => p.textContent.trim()).join(" ").split(/\s+/).length;
      check(`overview: ${words} words of running text`, words < 120);
      for (const s of [SCENES[0], SCENES[scenes - 1]]) {
        await visit(`scenes/${s.id}`);
        check(`${s.id}: title`, document.querySelector("#t-scenes").textContent === s.title);
        check(`${s.id}: a row a method`, document.querySelectorAll("#table tbody tr").length >= Math.min(15, s.list.length));
        for (const b of ["cols", "bary", "cols", "bary"]) document.getElementById(b).click();
        for (const k of ["name", "max", "rms", "ms", "ratio", "ratio"]) document.querySelector(`#table thead [data-k=${k}]`).click();
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
        const [px, er] = [await picture(s, s.list[0]), await codes(s, s.list[0])];
        check(`${s.id}: a colour and an error a pixel`, px.px.length === 4 * er.length && er.length === s.w * s.h);
        for (const m of s.list) if (s.rows[m].max > 1) { const top = levels(s)[(await codes(s, m)).reduce((a, c) => Math.max(a, c), 0)]; check(`${s.id}: the map of ${m} reaches its largest error`, top >= s.rows[m].max * .95 || s.rows[m].other > 0); }
        const m = s.list[s.list.length - 1];
        await link(`${s.id}: a link is restored`, `scenes/${s.id}?left=${encodeURIComponent(m)}&right=reference&mode=error&x=3&y=2&zoom=4&row=2`, () => v2.a === m && v2.mode === "error" && v2.pin?.join() === "3,2" && v2.z === 4 && v2.line === 2);
        labels("scenes");
        showRow(v2, null);
      }
      if (scenes > 1) { const before = v2.scene; key("]"); await until("the next scene", () => v2.scene !== before); key("["); await until("the scene before", () => v2.scene === before); }
      await visit("methods");
      check("methods: an article a method", document.querySelectorAll(".method").length === (IDS.length > 14 ? 11 : IDS.length));
      check("methods: formulas are mathematics", document.querySelectorAll("#methodlist math").length >= Math.min(11, IDS.length));
      labels("methods");
    }
    if (STUDY || D.scaling || DOCS.length > 1) {
      await visit("speed");
      labels("speed");
      document.querySelectorAll("#corner-mode button").forEach(b => b.click());
      labels("speed, all");
    }
    if (FIGURES.length) {
      for (const h of ["lectures", "lectures/wrong", "lectures/all"]) { await visit(h); check(h, document.querySelector("#lecture-body").textContent.length > 200); labels(h); }
      for (const f of FIGURES) { await visit("lectures/" + f.name); check(`figure ${f.name}`, document.querySelector(".fig h2")?.textContent === f.title && document.querySelectorAll(".flist tbody tr").length === f.findings.length); labels(f.name); }
    }
    await visit("measured");
    check("measured: the processor is named", document.querySelector("#machine").textContent.includes(D.machine.cpu));
    labels("measured");
    for (const b of ["theme", "theme", "big", "big", "help"]) document.getElementById(b).click();
    check("help opens", document.getElementById("keys").open);
    document.getElementById("keys").close();
    dispatchEvent(new Event("beforeprint"));
    check("print: all views", document.querySelectorAll(".view.on").length === 6);
    dispatchEvent(new Event("afterprint"));
  } catch (e) { failed.push("stopped: " + e.stack); }
  await wait(300);
  const result = document.createElement("pre");
  result.id = "checked";
  result.textContent = `${failed.length ? "FAILED" : "PASSED"} ${count} checks\n${[...new Set(failed)].join("\n")}`;
  document.body.append(result);
})();
