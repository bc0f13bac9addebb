/* Checks the first screen, and the exercises that the reader programs. `check.js` calls these functions with its tools. */

/* Checks the two spheres under one sun. The sun moves by finger, mouse and keys, and the sentence states what the engine measured. */
const checkSpheres = async ({ check, until, visit, wait, seen, drag }) => {
  if (!SPHERES) return;
  await visit("measured");
  await visit("overview");
  const el = document.querySelector("#overview [data-spheres]");
  check("spheres: they are the first thing", seen(el) && el.getBoundingClientRect().bottom + scrollY < 900);
  const [balls, stills] = [[...el.querySelectorAll(".ball")], [...el.querySelectorAll(".ball img")]];
  check("spheres: there are two, with still pictures", balls.length === 2 && stills.every(img => img.src.startsWith("data:image/png") && img.alt));
  if (CAN_DRAW) checkStudio ??= await Studio.make();
  else return check("spheres: no handles without the engine", !el.querySelector(".sun, button"));
  await until("spheres: drawn", () => el.dataset.shown);
  const first = el.querySelector(".sun"), value = () => el.dataset.shown.split(" ").map(Number);
  const shots = () => balls.map(ball => ball.querySelector("canvas").toDataURL());
  /* Returns where a ball's sun or its highlight's triangle stands, from the ball's middle, as shares of its side. */
  const part = (ball, selector) => {
    const [b, s] = [ball.getBoundingClientRect(), ball.querySelector(selector).getBoundingClientRect()];
    return [((s.left + s.right) / 2 - (b.left + b.right) / 2) / b.width, ((s.top + s.bottom) / 2 - (b.top + b.bottom) / 2) / b.height];
  };
  first.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft", bubbles: true, cancelable: true }));
  await until("spheres: a key stops what moves by itself", () => el.querySelector(".moves").textContent === "Move the sun");
  await wait(100);
  const verdicts = new Set();
  for (const [u, v] of [[.3, .3], [.62, .4], [.5, .28], [.4, .7], [.95, .5], [.5, .5]]) {
    const before = shots();
    await drag(balls[verdicts.size % 2], [.5, .4], [u, v]);
    // A browser that draws no frames shows the change after a tenth of a second.
    await wait(160);
    const after = shots(), where = `spheres, sun at ${u} ${v}`;
    check(`${where}: both pictures change`, after.every((shot, i) => shot !== before[i]));
    check(`${where}: they differ from one another`, after[0] !== after[1]);
    for (const ball of balls) check(`${where}: the sun is under the finger`, part(ball, ".sun").every((p, i) => Math.abs(p - ([u, v][i] - .5)) < .02));
    // The highlight's angle from the line of sight is half the sun's.
    const half = Math.sin(Math.asin(Math.min(1, Math.hypot(...value()))) / 2) / 1.3 / 2, [x, y] = part(balls[1], "polygon");
    const toward = Math.atan2(v - .5, u - .5);
    check(`${where}: the outlined triangle is where the highlight is`, Math.hypot(x - half * Math.cos(toward), y - half * Math.sin(toward)) < .09);
    const { content } = figureOf(value()), said = el.querySelector(".says").textContent;
    check(`${where}: the sentence is the engine's: ${said}`, said.startsWith(content.findings[0].verdict));
    verdicts.add(said.split(":")[0] + said.includes("right to"));
  }
  check("spheres: the sentence changes", verdicts.size > 1);
  for (const [key, i, sign] of [["ArrowRight", 0, 1], ["ArrowLeft", 0, -1], ["ArrowUp", 1, 1], ["ArrowDown", 1, -1]]) {
    const before = value();
    first.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
    await until(`spheres: ${key}`, () => sign * (value()[i] - before[i]) > .01);
  }
  check("spheres: Tab leaves the sun", first.dispatchEvent(new KeyboardEvent("keydown", { key: "Tab", bubbles: true, cancelable: true })));
  await until("spheres: the sentence is announced once the sun rests", () => el.querySelector(".unseen").textContent === el.querySelector(".says").textContent);
  check("spheres: the sun says where it is", /^\d+° from the line of sight, toward the [a-z ]+$/.test(first.ariaValueText));
  const before = el.dataset.shown;
  el.querySelector(".moves").click();
  await until("spheres: a button moves the sun", () => el.dataset.shown !== before);
  await visit("measured");
  await wait(160);
  const left = el.dataset.shown;
  await wait(300);
  check("spheres: nothing moves in a hidden view", el.dataset.shown === left);
  // As a figure of the lectures the spheres have an address, and show all findings.
  await visit("lectures/spheres?x=0.25&y=-0.5");
  const hands = () => document.querySelector(".hands");
  await until("spheres: an address places the sun", () => hands().dataset.shown === "0.25 -0.5");
  check("spheres: two findings", hands().querySelectorAll(".verdict .chip").length === 2);
  await wait(300);
  check("spheres: the sun rests where the address places it", hands().dataset.shown === "0.25 -0.5");
  hands().querySelector(".sun").dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowUp", bubbles: true, cancelable: true }));
  await until("spheres: the address follows", () => location.hash === "#lectures/spheres?x=0.250&y=-0.470");
};

/* Makes the figure for given values in a separate studio. */
let checkStudio;
const figureOf = values => checkStudio.figure("spheres", values);

/* Checks the exercises that the reader programs: right solutions, each slip, faults, endless loops, and attempts to reach a network. */
const checkHands = async ({ check, until, visit, wait, seen, accessible, contrasts }) => {
  if (typeof tracesOf === "undefined" || !hasTraces() || !FIGURES.some(f => f.name === "exercises")) return;
  await visit("course");
  const place = document.querySelector("#course").appendChild(document.createElement("div"));
  for (const name in EXERCISES) {
    const where = `hands ${name}`, own = await EXERCISES[name]();
    const el = place.appendChild(document.createElement("div"));
    el.innerHTML = "<p>The paragraph that stays.</p>";
    await handsInto(el, name);
    const [area, said, solve] = ["textarea", ".said", "[data-do=solve]"].map(s => el.querySelector(s));
    const press = async what => {
      const ran = el.dataset.ran;
      el.querySelector(`[data-do=${what}]`).click();
      await until(`${where}: ${what}`, () => el.dataset.ran !== ran);
      return said.textContent;
    };
    const run = text => {
      area.value = text;
      area.dispatchEvent(new Event("input", { bubbles: true }));
      return press("run");
    };
    check(`${where}: it begins with its start`, area.value === own.texts[0] && seen(el.querySelector("svg")));
    check(`${where}: a solution is shown after a try`, solve.disabled);
    check(`${where}: the start is not yet right: ${await press("run")}`, said.matches(".bad") && /^Pixel \d+.*: it should be [−\d.]+, yours is [−\d.]+: it seems that /.test(said.textContent));
    const [wrong] = own.names.length > 1 ? [firstWrong(own, own.values.map((v, k) => own.names.map((_, c) => own.slips[c][0][0][k])))] : [];
    if (wrong) check(`${where}: the first wrong pixel is the second one`, wrong.k === 1 && wrong.name === own.names[0]);
    check(`${where}: the solution is right: ${await press("solve")}`, said.matches(".good"));
    check(`${where}: a bar and a dot for each pixel`, el.querySelectorAll("rect").length === own.values.length * own.names.length && el.querySelectorAll("circle").length === own.values.length * own.names.length);
    await press("solve");
    check(`${where}: the reader's own text comes back`, area.value === own.texts[0]);
    // Each slip is recognised and answered with its own reason.
    for (const [c, list] of own.slips.entries()) for (const [values, why] of list) {
      const all = own.values.map((v, k) => own.names.map((_, i) => (i === c ? values[k] : v[i])));
      const found = firstWrong(own, all);
      check(`${where}: ${why}: ${found?.why}`, found?.why === why && found.c === c);
    }
    const text = own.texts[1];
    check(`${where}: too few pixels`, (await run(text.replace("i < n", "i < n - 2"))).startsWith(`Your code called pixel() ${own.values.length - 2} times, but there are ${own.values.length} pixels`));
    check(`${where}: no number: ${await run(text.replace("pixel(", "pixel(undefined, "))}`, said.textContent.includes("this is not a number"));
    check(`${where}: a text: ${await run("pixel('0.4');")}`, said.textContent.endsWith("“0.4”: this is a text, not a number."));
    check(`${where}: much is cut: ${await run("throw 'x'.repeat(1e6);")}`, /^Line 1: .{60,90}…$/.test(said.textContent));
    check(`${where}: a list of much: ${await run("pixel(new Array(1e7).fill(1));")}`, said.textContent.includes("yours is a list"));
    check(`${where}: no network: ${await run("fetch('http://127.0.0.1:9/').catch(() => {});")}`, said.textContent.endsWith("Code here has no network."));
    check(`${where}: one end mark: ${await run("throw Error('failed to load..');")}`, said.textContent.endsWith("failed to load."));
    el.querySelector("[data-do=run]").click();
    check(`${where}: the newest run counts: ${await run("throw 2;")}`, said.textContent === "Line 1: 2.");
    // A difference that f32 rounds away is right, and a larger one is wrong.
    const off = by => firstWrong(own, own.values.map((v, k) => own.names.map((_, c) => v[c] * (1 + (k ? by : 0)))));
    check(`${where}: the tolerance`, !off(1e-7) && !off(-1e-7) && off(2e-5) && off(-2e-5));
    check(`${where}: a fault names its line: ${await run("let a = 1;\nlet b = ;\n" + text)}`, said.textContent.startsWith("Line 2: SyntaxError"));
    check(`${where}: the faulty line is selected`, area.value.slice(area.selectionStart, area.selectionEnd) === "let b = ;");
    check(`${where}: a fault at run time names its line, too: ${await run("\n\nnosuch();")}`, said.textContent.startsWith("Line 3: ReferenceError: nosuch"));
    const start = performance.now();
    check(`${where}: an endless loop is stopped: ${await run("for (;;) {}")}`, said.textContent.includes("Stopped after half a second"));
    check(`${where}: soon`, performance.now() - start < 4000);
    check(`${where}: a flood of pixels: ${await run("for (;;) pixel(1);")}`, said.textContent.includes("more than 999"));
    if (name === "exercise 2") check(`${where}: an exponential at each pixel: ${await run("for (let i = 0; i < n; i++) pixel(Math.exp(i * Δt));")}`, said.textContent.includes("called the exponential"));
    const kept = "// kept\n" + text;
    await run(kept);
    const again = place.appendChild(document.createElement("div"));
    await handsInto(again, name);
    check(`${where}: the reader's text is kept`, again.querySelector("textarea").value === kept);
    again.remove();
    el.querySelector("[data-do=anew]").click();
    check(`${where}: the start comes back`, area.value === own.texts[0] && !said.textContent);
    await press("solve");
    el.querySelector("[data-do=anew]").click();
    check(`${where}: the start comes back after a solution, too, without older text`, area.value === own.texts[0] && solve.textContent === "Show a solution");
    const key = k => new KeyboardEvent("keydown", { key: k, bubbles: true, cancelable: true, ctrlKey: k === "Enter" });
    check(`${where}: Tab leaves the editor`, area.dispatchEvent(key("Tab")));
    area.focus();
    area.dispatchEvent(key("?"));
    check(`${where}: keys of the page do not work in it`, !document.getElementById("keys").open);
    const ran = el.dataset.ran;
    area.dispatchEvent(key("Enter"));
    await until(`${where}: Ctrl and Enter run it`, () => el.dataset.ran !== ran);
    check(`${where}: the paragraph stays`, el.firstChild.textContent === "The paragraph that stays.");
    check(`${where}: controls of 34 px or more`, [...el.querySelectorAll("button")].every(b => b.offsetHeight >= 34));
    for (const theme of ["light", "dark"]) {
      document.documentElement.dataset.theme = theme;
      contrasts(`${where}, ${theme}`);
    }
    delete document.documentElement.dataset.theme;
    if (name !== "4.4") el.remove();
  }
  accessible("hands");
  place.remove();
  // Nothing leaves the page. The policy blocks each attempt, even if there is a network.
  const attempts = {
    fetch: 'fetch("http://127.0.0.1:9/").catch(() => {})',
    XMLHttpRequest: 'const x = new XMLHttpRequest(); x.open("GET", "http://127.0.0.1:9/"); x.send()',
    WebSocket: 'new WebSocket("ws://127.0.0.1:9/")',
    EventSource: 'new EventSource("http://127.0.0.1:9/")',
    importScripts: 'importScripts("http://127.0.0.1:9/a.js")',
    import: 'import("http://127.0.0.1:9/a.js").catch(() => {})',
    eval: 'eval("1")',
  };
  for (const [what, code] of Object.entries(attempts)) {
    const worker = handsWorker({}, `addEventListener("securitypolicyviolation", e => postMessage({ blocked: e.effectiveDirective })); try { ${code} } catch {}`);
    let blocked;
    worker.onmessage = ({ data }) => { blocked ??= data.blocked; };
    worker.onerror = e => e.preventDefault();
    await until(`hands: ${what} is blocked by the page's policy`, () => /^(connect|script|worker)-src/.test(blocked));
    worker.terminate();
  }
};
