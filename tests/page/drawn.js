/* Draws scenes and a reader's own mesh in the page, from two sides and by every method. For `tests/page/drawn` it writes the files of
   the mesh, the scene file of each view, and for each picture the method and the hash of its colours. */
(async () => {
  const lines = [];
  try {
    const hash = async px => {
      const colours = px.filter((_, i) => i % 4 < 3), digest = await crypto.subtle.digest("SHA-256", colours);
      return [...new Uint8Array(digest)].map(b => b.toString(16).padStart(2, "0")).join("");
    };
    // A wedge in three materials, one of which its library lacks, with smooth ends. Its size is no scene’s.
    const mesh = {
      "own.obj": "mtllib own.mtl\nv 0 0 0\nv 2 0 0\nv 2 0 1\nv 0 0 1\nv 0 1 0.5\nv 2 1 0.3\nusemtl red\nf 1 2 3 4\nf 4 3 6 5\nusemtl gone\nf 2 1 5 6\nusemtl shiny\ns 1\nf 1 4 5\nf 3 2 6\n",
      "own.mtl": "newmtl red\nKd 0.8 0.1 0.1\nnewmtl shiny\nKa 0.1 0.2 0.3\nKd 0.2 0.4 0.6\nKs 0.5 0.5 0.5\nNs 40\n",
    };
    const size = { w: 301, h: 143 };
    const files = Object.entries(mesh).map(([name, text]) => {
      lines.push(`FILE ${name} ${btoa(text)}`);
      const bytes = new TextEncoder().encode(text);
      return { name, size: bytes.length, arrayBuffer: async () => bytes.buffer };
    });
    const own = await ownScene(files, size);
    for (const s of [...["coarse-sphere", "football", "perspective"].map(id => S[id]), own]) {
      const { id } = s;
      const live = await LiveScene.make(s);
      for (const [turn, view] of [STILL, { ...STILL, azimuth: .7, elevation: -.3, size: 1.2, light: lightAt(.9, 2) }].entries()) {
        live.look(view, false);
        // What the page knows of the mesh is told once, and never by a flag.
        const [told, again] = [live.news(), live.news()];
        const isOdd = note => note.includes("--");
        if (again.length || told.some(isOdd) || (s === own && !turn && !told.length)) lines.push(`NOTES ${id}-${turn} ${[...told, ...again].join(" | ")}`);
        lines.push(`SCENE ${id}-${turn} ${btoa(live.studio.scene())}`);
        for (const m of live.list) {
          const drawn = await hash(live.one(m).px);
          lines.push(`DRAWN ${id}-${turn} ${m} ${drawn}`);
          // The mesh without a scene file.
          if (s === own && !turn) lines.push(`ALONE ${size.w}x${size.h} ${m} ${drawn}`);
        }
      }
    }
  } catch (error) { lines.push(`FAILED ${error.stack}`); }
  const found = document.createElement("pre");
  found.id = "found";
  found.textContent = lines.join("\n");
  document.body.replaceChildren(found);
})();
