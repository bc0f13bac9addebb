/* Drives a page by touch and reads its accessibility tree, through the DevTools protocol. `tests/page/run` opens this script in the
   same browser, with the addresses of the browser and of the page behind `#`. The result is a line on the console. */
(async () => {
  const [devtools, page] = location.hash.slice(1).split(",").map(decodeURIComponent), socket = new WebSocket(devtools), waiting = new Map();
  const failed = [];
  let id = 0, count = 0, session;
  socket.onmessage = e => {
    const message = JSON.parse(e.data), { resolve, reject } = waiting.get(message.id) ?? {};
    if (message.error) reject?.(Error(message.error.message)); else resolve?.(message.result);
  };
  await new Promise(done => { socket.onopen = done; });
  const call = (method, params = {}) => new Promise((resolve, reject) => {
    waiting.set(++id, { resolve, reject });
    socket.send(JSON.stringify({ id, method, params, sessionId: session }));
  });
  const run = async expression => {
    const { result, exceptionDetails } = await call("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw Error(`${expression}: ${exceptionDetails.exception?.description}`);
    return result.value;
  };
  const wait = ms => new Promise(done => setTimeout(done, ms));
  const check = (what, is) => { count++; if (!is) failed.push(what); };
  const touch = (type, ...points) => call("Input.dispatchTouchEvent", { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const until = async (what, expression) => {
    for (let n = 0; n < 200; n++) {
      if (await run(expression)) return check(what, true);
      await wait(25);
    }
    check(what, false);
  };
  try {
    const { targetId } = await call("Target.createTarget", { url: page });
    session = (await call("Target.attachToTarget", { targetId, flatten: true })).sessionId;
    await call("Emulation.setDeviceMetricsOverride", { width: 400, height: 800, deviceScaleFactor: 2, mobile: true });
    await call("Emulation.setTouchEmulationEnabled", { enabled: true, maxTouchPoints: 5 });
    await until("the page is there", "document.readyState === 'complete'");
    await run("location.hash = 'scenes'");
    await until("the viewer shows", "typeof v2 !== 'undefined' && !!v2?.root.dataset.shown");
    await run("v2.stage.scrollIntoView({ block: 'center' })");
    await wait(100);
    const box = await run("(() => { const b = v2.stage.getBoundingClientRect(); return { x: b.x, y: b.y, w: b.width, h: b.height }; })()"), at = (u, v) => [box.x + u * box.w, box.y + v * box.h];
    const drag = async (from, to) => {
      await touch("touchStart", from);
      for (const k of [.25, .5, .75, 1]) await touch("touchMove", from.map((v, i) => v + (to[i] - v) * k));
      await touch("touchEnd");
    };
    await drag(at(.5, .5), at(.2, .52));
    check("one finger moves the divider", Math.abs(await run("v2.split") - .2) < .03);
    const scrolled = await run("scrollY");
    await touch("touchStart", at(.45, .5), at(.55, .5));
    for (const d of [.1, .15, .2, .25]) await touch("touchMove", at(.5 - d, .5), at(.5 + d, .5));
    await touch("touchEnd");
    const zoom = await run("v2.z");
    check(`two fingers zoom (${zoom})`, zoom > 3.5 && zoom < 6.5);
    check("the page itself neither zooms nor scrolls", await run("visualViewport.scale") === 1 && await run("scrollY") === scrolled);
    await run("v2.set({ mode: 'flip' })");
    const before = await run("[v2.cx, v2.cy]");
    await drag(at(.5, .5), at(.3, .4));
    const after = await run("[v2.cx, v2.cy]");
    check("one finger moves a zoomed picture", after[0] - before[0] > .02 && after[1] - before[1] > .01);
    await run("v2.set({ mode: 'slide', pin: null }); v2.zoom(0)");
    await touch("touchStart", at(.4, .4));
    await touch("touchEnd");
    await until("a tap holds a pixel", "!!v2.pin");
    check("at the finger", await run(`Math.hypot(v2.pin[0] / v2.scene.w - .4, v2.pin[1] / v2.scene.h - .4)`) < .02);
    const swipe = await run("scrollY");
    await drag(at(.5, .9), at(.5, .2));
    await wait(300);
    check("a swipe over the picture scrolls the page", await run("scrollY") > swipe + 50);
    check("and does not turn the model", await run("isStill(v2.view)"));
    if (await run("CAN_DRAW && canTurn(v2.scene)")) {
      await run("v2.set({ mode: 'slide', pin: null }); v2.split = .9; v2.hand.ready()");
      await run("v2.stage.scrollIntoView({ block: 'center' })");
      await wait(200);
      Object.assign(box, await run("(() => { const b = v2.stage.getBoundingClientRect(); return { x: b.x, y: b.y, w: b.width, h: b.height }; })()"));
      await drag(at(.2, .5), at(.45, .52));
      await until("one finger turns the model", "v2.view.azimuth !== 0 && !v2.hand.moves");
      const [x, y] = await run("(() => { const b = v2.hand.sun.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()");
      await drag([x, y], [x - 40, y - 40]);
      await until("one finger moves the light", "!!v2.view.light && !v2.hand.moves");
    }
    if (await run("hasTraces() && CAN_DRAW")) {
      await run("location.hash = 'stop'");
      await until("the figure that can be stopped shows", "!!stopFigures.get('lectures')?.width");
      await run("stopFigures.get('lectures').hands.nodes[2].scrollIntoView({ block: 'center' })");
      await wait(200);
      const hand = await run("(() => { const b = stopFigures.get('lectures').hands.nodes[2].querySelector('.s-dot').getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()");
      const [from, corner] = [await run("scrollY"), await run("stopFigures.get('lectures').corners[2][1]")];
      await drag(hand, [hand[0], hand[1] - 60]);
      await until("one finger drags a corner up", `stopFigures.get('lectures').corners[2][1] < ${corner} - 2`);
      check("and the page stays", await run("scrollY") === from);
    }
    // Read the accessibility tree as a screen reader does.
    for (const view of ["overview", "scenes", "methods", "speed", "lectures", "measured"]) {
      await run(`location.hash = "${view}"`);
      await wait(400);
      const { nodes } = await call("Accessibility.getFullAXTree"), known = nodes.filter(n => !n.ignored);
      const nameless = known.filter(n => ["button", "link", "image", "img", "combobox", "slider", "heading", "option", "region", "graphics-document"].includes(n.role?.value) && !n.name?.value?.trim());
      check(`${view}: without a name: ${nameless.map(n => n.role.value).join(", ")}`, !nameless.length);
      check(`${view}: a main part and navigation`, ["main", "navigation"].every(role => known.some(n => n.role?.value === role)));
      const levels = known.filter(n => n.role?.value === "heading").map(n => n.properties.find(p => p.name === "level").value.value);
      check(`${view}: headings ${levels}`, levels[0] === 1 && levels.every((l, i) => !i || l <= levels[i - 1] + 1));
    }
  } catch (e) { failed.push("stopped: " + e.stack); }
  console.log(failed.length ? `TOUCH FAILED ${count} checks: ${failed.join("; ")}` : `TOUCH PASSED ${count} checks`);
})();
