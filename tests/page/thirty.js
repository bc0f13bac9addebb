/* Adds made-up methods to a page's data until there are 30, to try charts, lists and keys with many methods. The machine is made up, too: too busy
   in the second scene, where it drew on several threads, and busy elsewhere. Another one beside it was too busy in the first scene. */
{
  const element = document.getElementById("fastphong-data"), data = JSON.parse(element.textContent);
  const families = ["alpha", "bishop", "cubic", "delta", "eigen", "fourier", "hermite", "weimer"], sources = ["gouraud", "fast-phong", "duff-phong", "slerp-phong"];
  // Multiples of the golden ratio are scattered, but equal in every run.
  const chance = n => (n * 0.6180339887) % 1;
  const added = Array.from({ length: Math.max(0, 30 - data.methods.length) }, (_, n) => ({ name: `${families[n % 8]}-phong-${n}`, source: sources[n % 4], factor: 0.3 + 2.5 * chance(n + 1) }));
  const copy = (list, key, { name, source }) => {
    const made = structuredClone(list.find(m => m[key] === source));
    list.push(Object.assign(made, { [key]: name }));
    return made;
  };
  const slower = (ratio, timing, k) => {
    for (const q of ["typical", "low", "high"]) ratio[q] *= k;
    for (const q of ["typical_ns", "low_ns", "high_ns"]) timing[q] /= k;
  };
  for (const [n, m] of added.entries()) {
    Object.assign(copy(data.methods, "name", m), { label: m.name.replaceAll("-", " "), family: families[n % 8] });
    for (const scene of data.comparisons) {
      const { speed } = copy(scene.rows, "variant", m);
      slower(speed.ratio_to_naive, speed.timing, m.factor);
    }
    for (const corner of data.speedups ? copy(data.speedups.methods, "method", m).corners : []) slower(corner.ratio_to_naive, corner.timing, m.factor);
  }
  const busy = { trust: "busy", clock: "thread", interrupted: .42, rounds: 12, cost_ns: 6e4, doubt: .026, sentence: "busy: 42 % of the samples were interrupted; times are the thread's own, ± 2.6 %" };
  const tooBusy = { ...busy, trust: "too-busy", clock: "passed", doubt: .12, sentence: "too busy to tell on 2 threads; --threads 1 can" };
  data.comparisons.forEach((scene, i) => { scene.noise = i === 1 ? tooBusy : busy; });
  for (const { speed } of data.comparisons[1]?.rows ?? []) speed.work_to_naive = { ...speed.ratio_to_naive };
  if (data.speedups) data.speedups.noise = busy;
  data.scaling?.points.forEach((point, i) => { point.noise = i % 4 === 1 ? tooBusy : busy; });
  const beside = structuredClone({ ...data, figures: [] });
  beside.comparisons[0].noise = tooBusy;
  data.beside = [beside];
  element.textContent = JSON.stringify(data);
  for (const pictures of document.querySelectorAll("script[id^=pictures-]")) {
    const stored = JSON.parse(pictures.textContent);
    for (const { name, source } of added) stored.rows[name] = { on: source };
    pictures.textContent = JSON.stringify(stored);
  }
}
