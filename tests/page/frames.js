/* Turns a scene of the page for 180 frames, each of two pictures and their errors, and prints to the console how long a frame took. */
(async () => {
  const wait = ms => new Promise(r => setTimeout(r, ms));
  await wait(1500);
  const s = S[new URLSearchParams(location.hash.split("?")[1]).get("scene")] ?? SCENES[0];
  for (const mode of ["slide", "error"]) {
    await v1.set({ scene: s, mode, a: "gouraud", b: "fast-phong", top: 0 });
    await v1.hand.ready();
    const times = [], at = performance.now();
    let before = at;
    for (let n = 0; n < 200; n++) {
      v1.hand.turnBy(3, 0);
      await new Promise(r => requestAnimationFrame(r));
      const now = performance.now();
      if (n >= 20) times.push(now - before);
      before = now;
    }
    const drawn = Object.entries(v1.hand.live.times).filter(([m]) => m.includes(" naive")).map(([m, all]) => [m, all.slice(2).sort((a, b) => a - b)[all.length - 2 >> 1]]);
    times.sort((a, b) => a - b);
    console.log(`FRAMES ${s.id}, ${v1.hand.live.polygons} polygons, ${s.w} x ${s.h}, ${mode}: median ${(1000 / times[times.length >> 1]).toFixed(0)} frames a second, 95 % within ${times[Math.floor(.95 * times.length)].toFixed(1)} ms; ${drawn.map(([m, ms]) => `${m} ${ms?.toFixed(2)} ms`).join(", ")}`);
    await wait(600);
  }
  const rounds = v1.hand.rounds;
  await wait(3000);
  const [frames, before] = [v1.turn, v1.hand.rounds];
  await wait(1000);
  console.log(`FRAMES at rest: ${v1.turn - frames} pictures and ${v1.hand.rounds - before} rounds in a second`, rounds);
  // Time a step of the figure that can be stopped, including the layout.
  if (FIGURES.some(isTraced)) {
    location.hash = "lectures/stop";
    while (!stopFigures.get("lectures")?.width) await wait(50);
    const figure = stopFigures.get("lectures");
    for (const variant of figure.variants) {
      figure.show(variant, figure.now);
      const times = Array.from({ length: 300 }, (_, i) => {
        const before = performance.now();
        figure.go(30 + i);
        figure.root.getBoundingClientRect();
        return performance.now() - before;
      }).sort((a, b) => a - b);
      console.log(`FRAMES stop, ${variant}: a step takes ${times[150].toFixed(1)} ms, 95 % within ${times[285].toFixed(1)} ms`);
    }
  }
  console.log("FRAMES done");
})();
