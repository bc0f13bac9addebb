/* Draws scenes in the page, from two sides and by every method. For `tests/page/drawn` it writes the scene file of each view, and for
   each picture the method and the hash of its colours. */
(async () => {
  const lines = [];
  try {
    const hash = async px => {
      const colours = px.filter((_, i) => i % 4 < 3), digest = await crypto.subtle.digest("SHA-256", colours);
      return [...new Uint8Array(digest)].map(b => b.toString(16).padStart(2, "0")).join("");
    };
    for (const id of ["coarse-sphere", "football", "perspective"]) {
      const live = await LiveScene.make(S[id]);
      for (const [turn, view] of [STILL, { ...STILL, azimuth: .7, elevation: -.3, size: 1.2, light: lightAt(.9, 2) }].entries()) {
        live.look(view, false);
        lines.push(`SCENE ${id}-${turn} ${btoa(live.studio.scene())}`);
        for (const m of live.list) lines.push(`DRAWN ${id}-${turn} ${m} ${await hash(live.one(m).px)}`);
      }
    }
  } catch (error) { lines.push(`FAILED ${error.stack}`); }
  const found = document.createElement("pre");
  found.id = "found";
  found.textContent = lines.join("\n");
  document.body.replaceChildren(found);
})();
