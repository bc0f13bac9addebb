"use strict";
/* The report's page: draws one JSON document (#fastphong-data) and its pictures. No library, nothing is loaded. */

/* ---------- small tools */
const $ = (s, r = document) => r.querySelector(s), $$ = (s, r = document) => [...r.querySelectorAll(s)];
const clamp = (v, a, b) => Math.max(a, Math.min(b, v));
const esc = s => String(s).replace(/[&<>"']/g, c => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&#39;" })[c]);
const sum = a => a.reduce((x, y) => x + y, 0);
const geo = a => Math.exp(sum(a.map(Math.log)) / a.length);
const by = f => (a, b) => f(a) - f(b);
const X = "\u2009×", TINY = 1e-4;
/* A number with `digits` significant digits, never in scientific notation. */
function num(v, digits = 3) {
 if (v == null || !isFinite(v)) return "–";
 const size = Math.abs(v);
 if (size === 0) return "0";
 if (size >= 1000) return Math.round(v).toLocaleString("en");
 if (size < .001) return "<\u20090.001";
 return v.toFixed(clamp(digits - 1 - Math.floor(Math.log10(size)), 0, 4));
}
const grouped = n => n.toLocaleString("en"), plural = (n, one) => `${grouped(n)} ${one}${n === 1 ? "" : "s"}`;
const memory = new Map();
/* Keeps what `make` makes; forgets what was not used for long. */
function memo(key, make) {
 const kept = memory.get(key) ?? make();
 memory.delete(key);
 memory.set(key, kept);
 if (memory.size > 220) memory.delete(memory.keys().next().value);
 return kept;
}
function toast(text) {
 const e = $("#toast");
 e.textContent = text;
 e.classList.add("on");
 clearTimeout(toast.timer);
 toast.timer = setTimeout(() => e.classList.remove("on"), 1800);
}
/* A row of buttons of which one is pressed. */
function segments(el, items, get, set) {
 const draw = () => { el.innerHTML = items.map(([k, l]) => `<button data-k="${esc(k)}" aria-pressed="${get() === k}">${esc(l)}</button>`).join(""); };
 el.onclick = e => { const b = e.target.closest("button"); if (b) { set(b.dataset.k); draw(); } };
 draw();
 return draw;
}
function save(name, text, type) {
 const a = document.createElement("a");
 a.download = name;
 a.href = URL.createObjectURL(new Blob([text], { type }));
 a.click();
 setTimeout(() => URL.revokeObjectURL(a.href), 1e4);
}
const csv = rows => rows.map(r => r.map(c => /[",\r\n]/.test(c ?? "") ? `"${String(c).replace(/"/g, '""')}"` : c ?? "").join(",") + "\r\n").join("");

/* ---------- data */
const D = JSON.parse($("#fastphong-data").textContent), BASE = D.baseline || "naive-phong", BARY = "barycentric";
const DOCS = [D, ...(D.beside || [])];
const slugs = new Set();
const SCENES = (D.comparisons || []).map((c, number) => {
 const plain = c.name.replace(/[^A-Za-z0-9]+/g, "-").replace(/^-|-$/g, "") || "scene";
 let id = plain;
 for (let n = 2; slugs.has(id); n++) id = `${plain}-${n}`;
 slugs.add(id);
 const rows = {};
 for (const r of c.rows.concat(c.barycentric)) rows[(r.engine === BARY ? "bary:" : "") + r.variant] = flat(r);
 return { ...c, id, number, rows, list: c.rows.map(r => r.variant), title: c.title || c.name, w: c.width, h: c.height };
});
/* The numbers of a row: errors in grey levels, times in ms, ratios as [median, low, high, tie]. */
function flat(r) {
 const e = r.error, s = r.speed, ratio = q => q && [q.median, q.low, q.high, q.tie];
 return {
  variant: r.variant, bary: r.engine === BARY, max: e.max * 255, rms: e.rms * 255, p99: e.p99 * 255, own: r.own.max * 255, explained: r.within_bound,
  over1: e.over_one_level, psnr: e.psnr, ssim: e.ssim, worst: e.worst, other: r.other_polygon, ms: s && s.timing.median_ns / 1e6, p25: s && s.timing.p25_ns / 1e6,
  p75: s && s.timing.p75_ns / 1e6, rounds: s && s.timing.rounds, ns: s && s.ns_per_covered_pixel, ratio: s && ratio(s.ratio_to_naive), barycentric: s && ratio(s.ratio_to_barycentric),
 };
}
const S = Object.fromEntries(SCENES.map(s => [s.id, s])), IDS = (D.methods || []).map(m => m.name), M = Object.fromEntries((D.methods || []).map(m => [m.name, m]));
const TIMED = SCENES.some(s => Object.values(s.rows).some(q => q.ratio)), MANY = SCENES.length > 1;
const hasPictures = s => !!$(`#pictures-${s.number}`), PICTURES = SCENES.some(hasPictures);
if (!PICTURES) document.documentElement.classList.add("nopictures");
/* Each family of methods has a hue and a shape, each member a filling; naive Phong is ink. */
const HUES = 11, SHAPES = ["square", "up", "circle", "plus", "down", "hexagon", "star", "pentagon"];
const FAMILIES = [...new Set(D.methods?.map(m => m.family))].filter(f => f !== M[BASE]?.family);
for (const m of D.methods || []) {
 const f = FAMILIES.indexOf(m.family), members = D.methods.filter(o => o.family === m.family);
 m.hue = f < 0 ? "var(--base)" : `var(--h${f % HUES})`;
 m.shape = f < 0 ? "diamond" : SHAPES[f % SHAPES.length];
 m.filling = members.indexOf(m) % 3;
 m.head = members[0] === m;
}
/* What a method comes to over all scenes: the worst error, the geometric mean of speeds. */
for (const m of D.methods || []) {
 const rows = SCENES.map(s => [s, s.rows[m.name]]).filter(q => q[1]);
 const worst = rows.reduce((a, q) => !a || q[1].max > a[1].max ? q : a, null);
 m.max = worst ? worst[1].max : null;
 m.worst = worst && { scene: worst[0], q: worst[1] };
 const ratios = rows.map(q => q[1].ratio?.[0]).filter(Boolean);
 m.speed = ratios.length && ratios.length === rows.length ? geo(ratios) : null;
}
/* Keys 1 to 9: a family's first member each, then the most exact of the others; in the order of the table. */
[...(D.methods || [])].sort(by(m => (m.head ? 0 : 1e6) + (m.head ? IDS.indexOf(m.name) : m.max ?? 0))).slice(0, 9)
 .sort(by(m => IDS.indexOf(m.name))).forEach((m, i) => { m.key = String(i + 1); });
const nm = m => m === "reference" ? "reference" : M[m]?.label ?? m, hue = m => m === "reference" ? "var(--ink3)" : M[m]?.hue ?? "var(--ink3)";
const BEST = $(".answer .m")?.dataset.m ?? IDS[IDS.length - 1];
const MARKED = new Set([BASE, BEST, ...$$(".answer .m").map(a => a.dataset.m)]);

/* ---------- marks */
const POLY = n => Array.from({ length: n }, (_, i) => [Math.sin(i * 2 * Math.PI / n) * 1.12, -Math.cos(i * 2 * Math.PI / n) * 1.12]);
const OUTLINES = {
 square: [[-.86, -.86], [.86, -.86], [.86, .86], [-.86, .86]], up: [[0, -1.1], [1.05, .8], [-1.05, .8]], down: [[0, 1.1], [1.05, -.8], [-1.05, -.8]],
 diamond: [[0, -1.25], [1.1, 0], [0, 1.25], [-1.1, 0]], hexagon: POLY(6), pentagon: POLY(5),
 star: POLY(10).map(([x, y], i) => i % 2 ? [x * .5, y * .5] : [x * 1.15, y * 1.15]),
 plus: [[-.4, -1.1], [.4, -1.1], [.4, -.4], [1.1, -.4], [1.1, .4], [.4, .4], [.4, 1.1], [-.4, 1.1], [-.4, .4], [-1.1, .4], [-1.1, -.4], [-.4, -.4]],
};
function shape(m, x, y, r = 5.5) {
 const o = M[m] || { shape: "circle", filling: 1 }, c = hue(m), hollow = o.filling > 0;
 const paint = hollow ? `fill="var(--card)" stroke="${c}" stroke-width="2"` : `fill="${c}" stroke="var(--card)" stroke-width="1"`;
 const dot = o.filling > 1 ? `<circle cx="${x}" cy="${y}" r="${r * .34}" fill="${c}"/>` : "";
 if (o.shape === "circle") return `<circle cx="${x}" cy="${y}" r="${r * .95}" ${paint}/>${dot}`;
 return `<path d="M${OUTLINES[o.shape].map(([u, v]) => (x + u * r).toFixed(1) + " " + (y + v * r).toFixed(1)).join("L")}Z" ${paint} stroke-linejoin="round"/>${dot}`;
}
const mark = m => `<svg width="13" height="13" viewBox="-7 -7 14 14" aria-hidden="true">${shape(m, 0, 0, 5)}</svg>`;
const tw = (() => {
 const c = document.createElement("canvas").getContext("2d");
 let family;
 return (t, bold) => { family ??= getComputedStyle(document.body).fontFamily; c.font = (bold ? "650 " : "") + "12.5px " + family; return c.measureText(t).width; };
})();

/* ---------- pictures: filtered planes, deflated; each adds to the one most like it */
const pictureData = s => memo("json" + s.id, () => JSON.parse($(`#pictures-${s.number}`).textContent));
async function unpack(text, w, h, count) {
 const binary = atob(text), bytes = new Uint8Array(binary.length);
 for (let i = 0; i < bytes.length; i++) bytes[i] = binary.charCodeAt(i);
 const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
 const rows = new Uint8Array(await new Response(stream).arrayBuffer()), planes = [];
 let at = 0;
 for (let p = 0; p < count; p++) {
  const out = new Uint8Array(w * h);
  for (let y = 0; y < h; y++) {
   const filter = rows[at++], here = y * w, above = here - w;
   for (let x = 0; x < w; x++, at++) {
    const left = x ? out[here + x - 1] : 0, up = y ? out[above + x] : 0;
    let guess = 0;
    if (filter === 1) guess = left;
    else if (filter === 2) guess = up;
    else if (filter === 3) guess = left + up >> 1;
    else if (filter === 4) {
     const corner = x && y ? out[above + x - 1] : 0, g = left + up - corner, a = Math.abs(g - left), b = Math.abs(g - up), c = Math.abs(g - corner);
     guess = a <= b && a <= c ? left : b <= c ? up : corner;
    }
    out[here + x] = rows[at] + guess;
   }
  }
  planes.push(out);
 }
 return planes;
}
const plus = (a, b) => a.map((p, i) => { const o = new Uint8Array(p.length), q = b[i]; for (let k = 0; k < o.length; k++) o[k] = p[k] + q[k]; return o; });
const stored = (s, m) => pictureData(s).rows[m];
const planes = (s, m) => memo(`planes ${s.id} ${m}`, async () => {
 if (m === "reference") return unpack(pictureData(s).reference, s.w, s.h, 3);
 const e = stored(s, m), base = await planes(s, e.on ?? "reference");
 return e.add ? plus(base, await unpack(e.add, s.w, s.h, 3)) : base;
});
/* Error of each pixel as it is stored: 0 up to 1/64 level, then some steps an octave. */
const codes = (s, m) => memo(`codes ${s.id} ${m}`, async () => {
 if (m === "reference") return new Uint8Array(s.w * s.h);
 const e = stored(s, m), base = e.map_on ? await codes(s, e.map_on) : new Uint8Array(s.w * s.h);
 return e.map ? plus([base], await unpack(e.map, s.w, s.h, 1))[0] : base;
});
const levels = s => memo(`levels ${s.id}`, () => Float32Array.from({ length: 256 }, (_, c) => c ? 2 ** ((c - 1) / pictureData(s).steps) / 64 : 0));
function canvasOf(s, fill) {
 const c = document.createElement("canvas"), d = new Uint8ClampedArray(s.w * s.h * 4);
 [c.width, c.height] = [s.w, s.h];
 fill(d);
 c.getContext("2d").putImageData(new ImageData(d, s.w, s.h), 0, 0);
 return c;
}
/* `px` holds the stored grey levels; the canvas shows linear ones as sRGB only where the scene is stored as such. */
const picture = (s, m) => memo(`picture ${s.id} ${m}`, async () => {
 const [g, r, b] = await planes(s, m), px = new Uint8ClampedArray(s.w * s.h * 4);
 for (let i = 0, j = 0; i < g.length; i++, j += 4) { px[j] = r[i] + g[i] & 255; px[j + 1] = g[i]; px[j + 2] = b[i] + g[i] & 255; px[j + 3] = 255; }
 return { px, canvas: canvasOf(s, d => d.set(px)) };
});
const STOPS = [[0, 0, 4], [28, 16, 68], [79, 18, 123], [129, 37, 129], [181, 54, 122], [229, 80, 100], [251, 135, 97], [254, 194, 135], [252, 253, 191]];
const HEAT = Array.from({ length: 256 }, (_, i) => { const f = i / 255 * (STOPS.length - 1), k = Math.min(STOPS.length - 2, f | 0); return STOPS[k].map((a, j) => Math.round(a + (STOPS[k + 1][j] - a) * (f - k))); });
const LOW = -6, HIGH = Math.log2(255);
/* Position of an error on the scale of a map: logarithmic for `top` 0, else linear up to `top`. */
const heat = (e, top) => top ? Math.min(1, e / top) : e <= 1 / 64 ? 0 : clamp((Math.log2(e) - LOW) / (HIGH - LOW), 0, 1);
const errorCanvas = (s, m, top) => memo(`map ${s.id} ${m} ${top}`, async () => {
 const map = await codes(s, m), colours = Array.from(levels(s), e => HEAT[Math.round(heat(e, top) * 255)]);
 return canvasOf(s, d => { for (let i = 0, j = 0; i < map.length; i++, j += 4) { const c = colours[map[i]]; d[j] = c[0]; d[j + 1] = c[1]; d[j + 2] = c[2]; d[j + 3] = 255; } });
});
/* Draws the reference, small, as soon as there is time. */
let queue = Promise.resolve();
const thumb = (canvas, s) => {
 [canvas.width, canvas.height] = [112, 84];
 if (!hasPictures(s)) return;
 queue = queue.then(() => new Promise(r => setTimeout(r, 8))).then(() => picture(s, "reference")).then(p => {
  const x = canvas.getContext("2d"), k = Math.min(112 / s.w, 84 / s.h);
  x.imageSmoothingQuality = "high";
  x.drawImage(p.canvas, (112 - s.w * k) / 2, (84 - s.h * k) / 2, s.w * k, s.h * k);
 }).catch(() => {});
};

/* ---------- the viewer */
const MODES = [["slide", "Slider"], ["flip", "Flip"], ["side", "Side by side"], ["error", "Error map"]];
class Viewer {
 constructor(root, o) {
  Object.assign(this, { root, mode: "slide", split: .5, z: 1, cx: .5, cy: .5, top: 0, side: "a", turn: 0 }, o);
  root.tabIndex = -1;
  root.innerHTML = `<div class="vbar"><label class="vsel"><span class="k">Left</span><span class="mk"></span><select class="sa" aria-label="Left picture"></select></label><label class="vsel"><span class="k">Right</span><span class="mk"></span><select class="sb" aria-label="Right picture"></select></label><span class="sp"></span><div class="seg" role="group" aria-label="How to compare"></div></div>
<div class="stage"><canvas role="img"></canvas><div class="tag a"></div><div class="tag b"></div><div class="divider" role="slider" tabindex="0" aria-label="Divider" aria-valuemin="0" aria-valuemax="100"><i></i></div></div>
<div class="vfoot"><div class="scn"></div><div class="scale" hidden><span>error, levels</span><div class="sc"><canvas width="256" height="1" aria-hidden="true"></canvas></div><div class="vsel"><select class="top" aria-label="Scale of the error map"><option value="0">log</option><option value="1">0–1</option><option value="10">0–10</option><option value="100">0–100</option></select></div></div><span class="sp"></span><div class="zoom"><button data-z="-" aria-label="Zoom out">−</button><button data-z="0" aria-label="Whole picture">Fit</button><button data-z="+" aria-label="Zoom in">+</button></div><button class="worst" title="Go to the worst pixel (W)">Worst pixel</button>${o.row ? '<button class="row" title="Intensity along the row (R)">Row</button>' : ""}<button class="save" title="Save this view as PNG">PNG</button></div>`;
  [this.canvas, this.stage, this.divider] = ["canvas", ".stage", ".divider"].map(q => $(q, root));
  this.drawModes = segments($(".vbar .seg", root), MODES, () => this.mode, k => this.set({ mode: k }));
  $(".sa", root).onchange = e => this.set({ a: e.target.value });
  $(".sb", root).onchange = e => this.set({ b: e.target.value });
  $(".top", root).onchange = e => this.set({ top: +e.target.value });
  $(".zoom", root).onclick = e => { const k = e.target.dataset.z; if (k) this.zoom({ "+": 2, "-": .5, 0: 0 }[k]); };
  $(".worst", root).onclick = () => this.worst();
  $(".save", root).onclick = () => this.save();
  if (o.row) $(".row", root).onclick = () => o.row(this);
  this.pointer();
  new ResizeObserver(() => this.draw()).observe(this.stage);
  this.divider.onkeydown = e => { const d = (e.shiftKey ? .1 : .02) * ({ ArrowLeft: -1, ArrowRight: 1 }[e.key] || 0); if (d) { e.preventDefault(); e.stopPropagation(); this.move(this.split + d); } };
  if (o.choices) {
   const c = $(".scn", root);
   c.innerHTML = o.choices.map(s => `<button data-s="${s.id}" title="${esc(s.title)}" aria-label="${esc(s.title)}"><canvas></canvas></button>`).join("");
   $$("button", c).forEach(b => setTimeout(() => thumb($("canvas", b), S[b.dataset.s]), 300));
   c.onclick = e => { const b = e.target.closest("button"); if (b) this.set({ scene: S[b.dataset.s], pin: null }); };
  }
 }
 /* Changes scene, pictures or mode, and shows them as soon as they are unpacked. */
 async set(o) {
  Object.assign(this, o);
  const s = this.scene, r = this.root, known = m => m === "reference" || s.list.includes(m) ? m : null;
  this.a = known(this.a) ?? s.list[0];
  this.b = known(this.b) ?? "reference";
  const list = m => [["reference", "reference"], ...s.list.map(i => [i, nm(i)])].map(([v, l]) => `<option value="${esc(v)}"${v === m ? " selected" : ""}>${esc(l)}</option>`).join("");
  $(".sa", r).innerHTML = list(this.a);
  $(".sb", r).innerHTML = list(this.b);
  $$(".vbar .mk", r).forEach((e, i) => { e.innerHTML = mark(i ? this.b : this.a); });
  this.drawModes();
  $$(".scn button", r).forEach(x => x.setAttribute("aria-pressed", x.dataset.s === s.id));
  this.stage.style.aspectRatio = `${s.w}/${s.h}`;
  const error = this.mode === "error";
  $(".scale", r).hidden = !error;
  $(".scn", r).hidden = error;
  if (error) this.scaleBar();
  if (!("side" in o) && ("mode" in o || "a" in o)) this.side = "a";
  this.change?.(this, o);
  if (!hasPictures(s)) { this.A = this.B = null; return; }
  const turn = ++this.turn;
  try {
   const of = m => error ? errorCanvas(s, m, this.top) : picture(s, m).then(p => p.canvas);
   const [A, B] = await Promise.all([of(this.a), of(error && this.b === "reference" ? this.a : this.b)]);
   if (turn !== this.turn) return;
   [this.A, this.B] = [A, B];
   this.draw();
   r.dataset.shown = `${s.id}|${this.a}|${this.b}|${this.mode}`;
  } catch (e) { this.stage.insertAdjacentHTML("beforeend", '<p class="missing">This browser cannot unpack pictures: it has no DecompressionStream.</p>'); }
 }
 single() { return this.mode === "flip" || this.mode === "error" && this.b === "reference"; }
 /* What of the picture is seen, in one pane: scale, corner, size. */
 view() {
  const w = this.stage.clientWidth / (this.mode === "side" ? 2 : 1), h = this.stage.clientHeight, { w: iw, h: ih } = this.scene;
  const k = Math.min(w / iw, h / ih) * this.z, vw = w / k, vh = h / k, fit = (c, i, v) => v >= i ? (i - v) / 2 : clamp(c * i - v / 2, 0, i - v);
  return { k, x: fit(this.cx, iw, vw), y: fit(this.cy, ih, vh), w, h, iw, ih };
 }
 draw() {
  if (!this.A) return;
  const v = this.view(), r = devicePixelRatio || 1, c = this.canvas, two = this.mode === "side";
  if (!v.w) return;
  c.width = v.w * r * (two ? 2 : 1);
  c.height = v.h * r;
  const x = c.getContext("2d");
  x.scale(r, r);
  x.imageSmoothingEnabled = v.k * r < 2.01 && this.z === 1;
  x.imageSmoothingQuality = "high";
  const one = this.single(), at = this.split * v.w;
  const pane = (image, from, to, shift = 0) => { x.save(); x.beginPath(); x.rect(from, 0, to - from, v.h); x.clip(); x.drawImage(image, shift - v.x * v.k, -v.y * v.k, v.iw * v.k, v.ih * v.k); x.restore(); };
  if (one) pane(this.side === "a" || this.mode === "error" ? this.A : this.B, 0, v.w);
  else if (two) { pane(this.A, 0, v.w - 1); pane(this.B, v.w + 1, 2 * v.w, v.w); }
  else { pane(this.A, 0, at); pane(this.B, at, v.w); }
  const p = this.hover || this.pin || this.rest;
  if (p) for (const shift of two ? [0, v.w] : [0]) {
   const px = (p[0] - v.x) * v.k + shift, py = (p[1] - v.y) * v.k, s = Math.max(v.k, 9), o = (s - v.k) / 2;
   for (const [width, style] of [[3, "#000a"], [1.4, "#fff"]]) { x.lineWidth = width; x.strokeStyle = style; x.strokeRect(px - o, py - o, s, s); }
  }
  if (this.line != null) { x.fillStyle = "#fff8"; x.fillRect(0, (this.line + .5 - v.y) * v.k - .5, v.w * 2, 1); }
  const slides = !one && !two, d = this.divider;
  d.style.display = slides ? "" : "none";
  d.style.left = this.split * 100 + "%";
  d.setAttribute("aria-valuenow", Math.round(this.split * 100));
  this.stage.dataset.mode = this.mode;
  this.stage.toggleAttribute("data-single", one);
  this.stage.classList.toggle("zoomed", this.z > 1);
  const error = this.mode === "error", q = m => this.scene.rows[m];
  const text = m => m === "reference" ? "<b>reference</b><span>f64, closed form</span>" : `<b>${esc(nm(m))}${error ? " · error" : ""}</b><span>max ${num(q(m).max)} levels${q(m).ms ? ` · ${num(q(m).ms)} ms` : ""}</span>`;
  const [ta, tb] = [".tag.a", ".tag.b"].map(t => $(t, this.root));
  ta.innerHTML = text(one && !error && this.side === "b" ? this.b : this.a);
  tb.innerHTML = text(this.b);
  ta.style.opacity = one || two || this.split > .16 ? 1 : 0;
  tb.style.opacity = !one && (two || this.split < .84) ? 1 : 0;
  c.setAttribute("aria-label", `${this.scene.title}: ${nm(this.a)}${one ? "" : ` left, ${nm(this.b)} right`}${error ? ", error map" : ""}`);
 }
 scaleBar() {
  const c = $(".scale canvas", this.root), x = c.getContext("2d"), sc = $(".sc", this.root);
  HEAT.forEach((h, i) => { x.fillStyle = `rgb(${h})`; x.fillRect(i, 0, 1, 1); });
  $$("span", sc).forEach(e => e.remove());
  for (const t of this.top ? [0, .5, 1].map(u => u * this.top) : [1 / 64, .1, 1, 10, 100]) {
   const e = document.createElement("span"), at = heat(t, this.top);
   e.textContent = t === 1 / 64 ? "1/64" : t;
   e.style.left = at * 100 + "%";
   e.style.transform = at === 0 ? "none" : at === 1 ? "translateX(-100%)" : "";
   sc.append(e);
  }
 }
 /* Zooms by a factor (0: whole picture) around a point of the stage. */
 zoom(f, ax, ay) {
  const v = this.view();
  if (f === 0) { this.z = 1; this.cx = this.cy = .5; this.moved(); return; }
  const z = clamp(this.z * f, 1, 32);
  if (ax == null) [ax, ay] = this.pin ? [(this.pin[0] + .5 - v.x) * v.k, (this.pin[1] + .5 - v.y) * v.k] : [v.w / 2, v.h / 2];
  const k = v.k / this.z * z, ix = v.x + ax / v.k, iy = v.y + ay / v.k;
  this.cx = (ix - ax / k + v.w / k / 2) / v.iw;
  this.cy = (iy - ay / k + v.h / k / 2) / v.ih;
  this.z = z;
  this.moved();
 }
 moved() { this.draw(); this.change?.(this, { view: 1 }); }
 move(split) { this.split = clamp(split, 0, 1); this.draw(); }
 local(e) { const b = this.stage.getBoundingClientRect(), v = this.view(), x = e.clientX - b.left; return { x: this.mode === "side" ? x % v.w : x, y: e.clientY - b.top, wide: b.width, v }; }
 at(e) { const { x, y, v } = this.local(e), p = [Math.floor(v.x + x / v.k), Math.floor(v.y + y / v.k)]; return p[0] >= 0 && p[1] >= 0 && p[0] < v.iw && p[1] < v.ih ? p : null; }
 hold(p) { this.pin = p; this.probe?.(this); this.draw(); this.change?.(this, { pin: 1 }); }
 pointer() {
  const s = this.stage, fingers = new Map(), apart = () => { const [p, q] = [...fingers.values()]; return Math.hypot(p.clientX - q.clientX, p.clientY - q.clientY); };
  let g = null;
  s.onpointerdown = e => {
   if (e.button) return;
   fingers.set(e.pointerId, e);
   const { x, wide } = this.local(e), slides = !this.single() && this.mode !== "side", near = Math.abs(x / wide - this.split) * wide < 24;
   g = { x: e.clientX, y: e.clientY, cx: this.cx, cy: this.cy, far: 0, kind: slides && (near || this.z === 1) ? "split" : "pan" };
   s.setPointerCapture(e.pointerId);
   if (fingers.size === 2) g = { kind: "pinch", d: apart(), z: this.z, far: 99 };
  };
  s.onpointermove = e => {
   if (fingers.has(e.pointerId)) fingers.set(e.pointerId, e);
   if (g?.kind === "pinch" && fingers.size === 2) {
    const b = s.getBoundingClientRect(), [p, q] = [...fingers.values()];
    this.zoom(g.z * apart() / g.d / this.z, (p.clientX + q.clientX) / 2 - b.left, (p.clientY + q.clientY) / 2 - b.top);
    return;
   }
   if (g) {
    const { x, wide, v } = this.local(e);
    g.far = Math.max(g.far, Math.hypot(e.clientX - g.x, e.clientY - g.y));
    if (g.kind === "split" && g.far > 2) this.move(x / wide);
    else if (g.kind === "pan" && this.z > 1) { this.cx = g.cx - (e.clientX - g.x) / v.k / v.iw; this.cy = g.cy - (e.clientY - g.y) / v.k / v.ih; this.draw(); }
   }
   if (this.probe && (!g || g.kind !== "split" || g.far < 3)) { this.hover = this.at(e); this.probe(this); this.draw(); }
  };
  s.onpointerup = e => {
   fingers.delete(e.pointerId);
   if (g && g.far < 4) {
    if (this.probe) { const p = this.at(e); this.hold(this.pin && p && Math.hypot(p[0] - this.pin[0], p[1] - this.pin[1]) < 4 ? null : p); }
    else if (this.mode === "flip") this.flip();
    else if (!this.single() && this.mode !== "side") { const { x, wide } = this.local(e); this.move(x / wide); }
   } else if (g?.kind === "pan" || g?.kind === "pinch") this.moved();
   g = null;
  };
  s.onpointercancel = e => { fingers.delete(e.pointerId); g = null; };
  s.onpointerleave = () => { if (!g && this.probe) { this.hover = null; this.probe(this); this.draw(); } };
  s.addEventListener("wheel", e => { if (!e.ctrlKey && !e.metaKey) return; e.preventDefault(); const { x, y } = this.local(e); this.zoom(2 ** (-e.deltaY / 120), x, y); }, { passive: false });
  s.ondblclick = e => { if (e.target.closest(".divider")) return; const { x, y } = this.local(e); this.zoom(e.shiftKey ? .25 : 4, x, y); };
 }
 flip() { if (this.mode !== "flip") return this.set({ mode: "flip", side: "b" }); this.side = this.side === "a" ? "b" : "a"; this.draw(); }
 show(m, right) {
  if (!this.scene.list.includes(m) && m !== "reference") return;
  if (right) return this.set({ b: m });
  return this.set(this.mode === "flip" && m === this.b ? { side: "b" } : { a: m });
 }
 worst() {
  const m = this.a === "reference" ? this.b : this.a, q = this.scene.rows[m];
  if (!q?.worst) return toast("No pixel differs");
  Object.assign(this, { z: 12, cx: (q.worst[0] + .5) / this.scene.w, cy: (q.worst[1] + .5) / this.scene.h, hover: null });
  this.hold(q.worst.slice());
  toast(`${nm(m)}: worst pixel ${q.worst.join(", ")} — ${num(q.max)} levels`);
 }
 save() { const a = document.createElement("a"); a.download = `${this.scene.id}-${this.a}-${this.b}-${this.mode}.png`.replace(/[^\w.-]/g, "_"); a.href = this.canvas.toDataURL(); a.click(); }
 /* True if the key was one of the viewer's. */
 key(e) {
  const digit = /^Digit(\d)$/.exec(e.code || ""), set = mode => { this.set({ mode }); return true; };
  if (digit) { const m = digit[1] === "0" ? "reference" : IDS.find(i => M[i].key === digit[1]); if (m) this.show(m, e.shiftKey); return true; }
  switch (e.key.toLowerCase()) {
   case " ": this.flip(); return true;
   case "s": return set("slide");
   case "f": return set("flip");
   case "d": return set("side");
   case "e": return set("error");
   case "x": this.set({ a: this.b, b: this.a }); return true;
   case "+": case "=": this.zoom(2); return true;
   case "-": this.zoom(.5); return true;
   case "z": this.zoom(0); return true;
   case "w": this.worst(); return true;
   case "r": this.row?.(this); return true;
   case "p": this.hold(this.pin ? null : this.hover ?? this.rest); return true;
   case "arrowleft": case "arrowright":
    if (this.single() || this.mode === "side") return false;
    this.move(this.split + (e.key === "ArrowLeft" ? -1 : 1) * (e.shiftKey ? .1 : .02));
    return true;
  }
  return false;
 }
}

/* ---------- charts */
const SVG = (w, h, body, label) => `<svg viewBox="0 0 ${w} ${h}" width="${w}" height="${h}" role="img" aria-label="${esc(label)}">${body}</svg>`;
const lin = (a, b, c, d) => v => c + (v - a) / (b - a || 1) * (d - c), logs = (a, b, c, d) => { const f = lin(Math.log(a), Math.log(b), c, d); return v => f(Math.log(v)); };
const text = (x, y, t, o = "") => `<text x="${x.toFixed?.(1) ?? x}" y="${y.toFixed?.(1) ?? y}" ${o}>${t}</text>`, MID = 'text-anchor="middle"', END = 'text-anchor="end"';
const line = (x1, y1, x2, y2, o = 'class="gr"') => `<line x1="${x1.toFixed(1)}" y1="${y1.toFixed(1)}" x2="${x2.toFixed(1)}" y2="${y2.toFixed(1)}" ${o}/>`;
/* Ticks of a logarithmic axis: as many as fit. */
function logTicks(a, b, room) {
 for (const steps of [[1, 2, 5], [1, 3], [1]]) {
  const t = [];
  for (let e = Math.floor(Math.log10(a)); e <= Math.log10(b); e++) for (const s of steps) { const v = s * 10 ** e; if (v >= a * .999 && v <= b * 1.001) t.push(+v.toPrecision(3)); }
  if (t.length <= room && t.length > 1) return t;
 }
 const t = [], d = Math.log10(b / a), step = Math.max(1, Math.ceil(d / room));
 for (let e = Math.ceil(Math.log10(a) - 1e-9); e <= Math.log10(b) + 1e-9; e += step) t.push(+(10 ** e).toPrecision(3));
 return t.length > 1 ? t : [a, b].map(v => +v.toPrecision(2));
}
function linTicks(a, b, room) {
 const raw = (b - a) / room, p = 10 ** Math.floor(Math.log10(raw)), step = [1, 2, 5, 10].map(s => s * p).find(s => s >= raw), t = [];
 for (let v = Math.ceil(a / step) * step; v <= b + step * 1e-6; v += step) t.push(+v.toPrecision(6));
 return t;
}
const tickText = v => v === 0 ? "0" : Math.abs(v) >= 1e6 ? +(v / 1e6).toPrecision(2) + " M" : Math.abs(v) >= 1e4 ? +(v / 1e3).toPrecision(3) + " k" : Math.abs(v) < 1e-3 ? `10<tspan dy="-4" font-size="9">${Math.round(Math.log10(Math.abs(v)))}</tspan>` : String(+v.toPrecision(3));
/* Positions at least `gap` apart, near those wished for, within limits. */
function spread(ys, gap, low = -1e9, high = 1e9) {
 const o = ys.map((y, i) => ({ y, i })).sort(by(p => p.y));
 if (high - low < gap * (o.length - 1)) gap = (high - low) / Math.max(1, o.length - 1);
 let at = low;
 for (const p of o) { p.y = Math.max(p.y, at); at = p.y + gap; }
 at = high;
 for (const p of o.reverse()) { p.y = Math.min(p.y, at); at = p.y - gap; }
 const r = [];
 o.forEach(p => { r[p.i] = p.y; });
 return r;
}
/* Places labels of points greedily: none overlaps another label or a mark; a label without room is left out (`L` null). */
function place(points, box, bars = []) {
 const done = [], marks = points.map(p => [p.x - 7, p.y - 7, p.x + 7, p.y + 7]);
 const over = (a, b) => Math.max(0, Math.min(a[2], b[2]) - Math.max(a[0], b[0])) * Math.max(0, Math.min(a[3], b[3]) - Math.max(a[1], b[1]));
 for (const p of [...points].sort((a, b) => (b.pri || 0) - (a.pri || 0) || a.y - b.y)) {
  let best = null;
  for (let ring = 0; ring < 7; ring++) for (let a = 0; a < (ring ? 16 : 4); a++) {
   const t = ring ? a * Math.PI / 8 : a * Math.PI / 2, r = 11 + ring * 13, cx = p.x + Math.cos(t) * (r + (Math.abs(Math.cos(t)) > .3 ? p.w / 2 - 2 : 0)), cy = p.y + Math.sin(t) * (r + 2);
   const q = [cx - p.w / 2, cy - 8, cx + p.w / 2, cy + 8];
   if (q[0] < box[0] || q[1] < box[1] || q[2] > box[2] || q[3] > box[3] || done.some(d => over(q, d) > 0)) continue;
   let cost = ring * 26 + (a === 0 ? 0 : a === 2 && !ring ? 3 : 5);
   marks.forEach((d, i) => { if (points[i] !== p) cost += over(q, d) * 5; });
   for (const d of bars) cost += over(q, d) * 1.6;
   if (!best || cost < best.cost) best = { cost, q, cy, ring };
  }
  p.L = best && (best.cost < 420 || p.pri) ? best : null;
  if (p.L) done.push(p.L.q);
 }
}
const bind = (el, f) => { el.onclick = el.onkeydown = e => { const h = e.target.closest(".hit"); if (h && (e.type !== "keydown" || e.key === "Enter" || e.key === " ")) { e.preventDefault(); f(h.dataset, e); } }; };

/* ---------- overview: error against time */
let basis = MANY ? "all" : "scene";
function pareto(v) {
 const el = $("#pareto"), s = v.scene, all = basis === "all";
 $("#pareto-sub").textContent = all ? `All ${SCENES.length} scenes: worst error anywhere, geometric mean of times. The line is what nothing beats.` : `${s.title}, ${s.w} × ${s.h}. The line is what nothing beats; choose a mark to see its picture.`;
 const W = Math.round(el.clientWidth), H = Math.max(340, Math.round(el.clientHeight) || 460), l = 46, r = 14, t = 24, b = 48;
 if (!W) return;
 const points = IDS.flatMap(m => {
  const q = s.rows[m];
  if (all) return M[m].max == null ? [] : [{ m, t: M[m].speed && 1 / M[m].speed, e: M[m].max, R: M[m].speed }];
  return q ? [{ m, t: q.ms, e: q.max, R: q.ratio?.[0], lo: q.p25, hi: q.p75 }] : [];
 }), timed = points.every(p => p.t);
 if (!timed) points.forEach((p, i) => { p.t = i + 1; });
 const floor = clamp(Math.min(...points.map(p => p.e / 2.2)), .0005, .3), top = Math.max(2, ...points.map(p => p.e * 1.6)), ts = points.map(p => p.t), t0 = Math.min(...ts), t1 = Math.max(...ts);
 const wide = t1 / t0 > 6, pad = (t1 - t0) * .2 || t1 * .2, x = wide ? logs(t0 / 1.25, t1 * 1.35, l, W - r) : lin(Math.max(0, t0 - pad), t1 + pad * 1.15, l, W - r), y = logs(floor, top, H - b, t), y1 = clamp(y(1), t, H - b);
 let o = `<rect x="${l}" y="${y1}" width="${W - r - l}" height="${H - b - y1}" fill="var(--wash)"/>`;
 for (const g of [.001, .01, .1, 1, 10, 100].filter(g => g >= floor && g <= top)) o += line(l, y(g), W - r, y(g)) + text(l - 7, y(g) + 4, g, `class="t" ${END}`);
 if (timed) for (const g of wide ? logTicks(t0, t1 * 1.3, 6) : linTicks(Math.max(t0 - pad, t0 / 5), t1 + pad, 6)) o += text(x(g), H - b + 17, tickText(g), `class="t" ${MID}`) + line(x(g), H - b, x(g), H - b + 4);
 o += text((l + W - r) / 2, H - 8, timed ? `← faster   ·   ${all ? "time as a multiple of naive Phong’s" : "ms a frame"}` : "no times were taken", `class="ax" ${MID}`) + text(l - 38, t - 9, `${all ? "worst error in any scene" : "max error"}, grey levels`, 'class="ax"');
 const base = points.find(p => p.m === BASE), bars = [];
 if (base && timed) { o += line(x(base.t), t, x(base.t), H - b, 'stroke="var(--ink3)" stroke-dasharray="2 4"'); bars.push([x(base.t) - 2, t, x(base.t) + 2, H - b]); }
 let best = Infinity, d = "", last = null;
 if (timed) {
  for (const p of [...points].sort((p, q) => p.t - q.t || p.e - q.e)) {
   const e = Math.max(p.e, floor * 1.1);
   if (e >= best) continue;
   const px = x(p.t), py = y(e);
   if (last) bars.push([last[0] + 7, last[1] - 2, px, last[1] + 2], [px - 2, Math.min(last[1], py), px + 2, Math.max(last[1], py)]);
   d += d ? `H${px.toFixed(1)}V${py.toFixed(1)}` : `M${px.toFixed(1)} ${t}V${py.toFixed(1)}`;
   [best, last, p.front] = [e, [px, py], true];
  }
  bars.push([last[0] + 7, last[1] - 2, W - r, last[1] + 2]);
  o += `<path d="${d}H${W - r}" fill="none" stroke="var(--ink3)" stroke-width="1.25" opacity=".75"/>`;
 }
 const under = W < 460 ? "under 1 level" : "below one grey level: the same picture";
 if (H - b - y1 > 24) { o += text(l + 8, y1 + 16, under, 'class="t" style="paint-order:stroke;stroke:var(--wash);stroke-width:5px"'); bars.push([l, y1 + 3, l + tw(under), y1 + 20]); }
 const speed = p => p.R && (p.m === v.a || p.m === v.b || p.front) ? "  " + p.R.toFixed(2) + X : "";
 for (const p of points) Object.assign(p, { x: x(p.t), y: y(Math.max(p.e, floor * 1.1)), pri: (p.m === v.a ? 3 : 0) + (p.front ? 1 : 0) + (p.m === v.b ? 2 : 0) + (MARKED.has(p.m) ? 1 : 0), w: tw(nm(p.m) + speed(p), 1) + 5 });
 place(points, [l + 2, t, W - r, H - b - 1], bars);
 for (const p of points) if (p.L?.ring) o += line(p.x, p.y, clamp(p.x, p.L.q[0], p.L.q[2]), p.L.cy, 'stroke="var(--line2)"');
 for (const p of points) {
  const on = p.m === v.a, other = p.m === v.b, label = `${nm(p.m)}: error ${num(p.e)} levels${timed ? `, ${num(p.t)} ${all ? "of naive Phong’s time" : "ms"}` : ""}`;
  const faint = points.length > 14 && !p.front && !MARKED.has(p.m) && !on && !other;
  o += `<g class="hit" tabindex="0" role="button" data-m="${esc(p.m)}" aria-pressed="${on}" aria-label="${esc(label)}"${faint ? ' opacity=".55"' : ""}><title>${esc(label)}</title>${p.lo ? line(x(p.lo), p.y, x(p.hi), p.y, `stroke="${hue(p.m)}" opacity=".55"`) : ""}<circle class="ring" cx="${p.x}" cy="${p.y}" r="10.5" fill="none" stroke="${on || other ? "var(--ink)" : "var(--ink3)"}" stroke-width="1.5" opacity="${on || other ? 1 : 0}"/>${shape(p.m, p.x, p.y, 5.8)}`;
  if (p.L) o += `<rect x="${p.L.q[0]}" y="${p.L.q[1]}" width="${p.w}" height="16" fill="transparent"/>` + text(p.L.q[0] + 2, p.L.cy + 4.3, `${esc(nm(p.m))}<tspan dx="3" style="fill:var(--ink2);font-weight:450">${speed(p)}</tspan>`, `class="halo label"${on ? ' style="font-weight:650"' : ""}`);
  o += "</g>";
 }
 el._points = points;
 el.innerHTML = SVG(W, H, o, "Error against time of every method");
}

/* Which methods stand for all where there is room for few: naive Phong's rivals that the answer names, then the fastest. */
const chosen = n => [...IDS].filter(m => m !== BASE && M[m].speed).sort((a, b) => MARKED.has(b) - MARKED.has(a) || (M[a].max > 1) - (M[b].max > 1) || (M[a].max > 1 ? M[a].max - M[b].max : M[b].speed - M[a].speed)).slice(0, n);
let allRows = false;
/* The scenes as a strip of marks: speeds of a few methods. */
function strip() {
 const el = $("#strip"), W = Math.round(el.clientWidth), few = chosen(4), lead = few.find(m => m !== BEST) ?? few[0];
 if (!W || !few.length) return;
 const timed = SCENES.filter(s => few.some(m => s.rows[m]?.ratio)), value = (s, m) => s.rows[m]?.ratio?.[0];
 const sorted = [...timed].sort((a, b) => (value(b, lead) ?? 0) - (value(a, lead) ?? 0)), rows = allRows ? sorted : sorted.slice(0, 24);
 const narrow = W < 520, l = narrow ? 132 : 208, r = 14, t = 42, rh = 20.5, H = t + rows.length * rh + 26, vs = rows.flatMap(s => few.map(m => value(s, m)).filter(Boolean)).concat(1);
 const x = logs(Math.min(...vs) / 1.06, Math.max(...vs) * 1.06, l, W - r);
 let o = "", cx = narrow ? 0 : 4;
 const near = g => [1, .5, 2, .25, 4, .1, 8, 16].some(k => k !== g && k > 0 && (k === 1 || Math.abs(Math.log2(g)) % 1) && Math.abs(x(k) - x(g)) < 26);
 for (const g of [.1, .25, .5, .75, 1, 1.25, 1.5, 2, 4, 8, 16].filter(g => g > Math.min(...vs) / 1.06 && g < Math.max(...vs) * 1.06 && !near(g))) o += line(x(g), t - 6, x(g), H - 22, g === 1 ? 'stroke="var(--ink3)"' : undefined) + text(x(g), H - 7, g + (g === 1 ? X : ""), `class="t" ${MID}`);
 for (const m of few) { const name = narrow ? nm(m).replace(" Phong", "") : nm(m); o += shape(m, cx + 6, 10, 4.6) + text(cx + 16, 14, esc(name), 'style="font-size:12px"'); cx += 30 + tw(name) * .97; }
 if (x(1) - l > 60) o += text(x(1) - 8, t - 12, "slower", `class="t" ${END}`);
 if (W - r - x(1) > 150) o += text(x(1) + 8, t - 12, "faster than naive Phong", 'class="t"');
 rows.forEach((s, i) => {
  const y = t + i * rh + rh / 2, here = few.filter(m => value(s, m)), rs = here.map(m => value(s, m)), title = narrow && s.title.length > 19 ? s.title.slice(0, 18) + "…" : s.title.length > 34 ? s.title.slice(0, 33) + "…" : s.title;
  const tip = `${s.title}\n${here.map(m => `${nm(m)} ${value(s, m).toFixed(2)} ×`).join("\n")}`;
  o += `<g class="hit" data-s="${s.id}" tabindex="0" role="button" aria-label="${esc(tip)}"><title>${esc(tip)}</title><rect x="0" y="${y - rh / 2}" width="${W}" height="${rh}" fill="transparent"/>${text(l - 14, y + 4, esc(title), `${END} style="font-size:12px"`)}${line(x(Math.min(...rs)), y, x(Math.max(...rs)), y, 'stroke="var(--line)" stroke-width="2"')}`;
  for (const m of here) o += `<g opacity="${s.rows[m].max > 1 ? .38 : 1}">${shape(m, x(value(s, m)), y, 4.6)}</g>`;
  o += "</g>";
 });
 el.innerHTML = SVG(W, H, o, `Speed of ${few.length} methods in ${rows.length} scenes`) + '<p class="sub">Pale: off by more than one grey level in that scene — another picture.</p>' + (sorted.length > rows.length ? `<button class="fold">All ${sorted.length} scenes</button>` : "");
 bind(el, d => go("scenes/" + d.s));
 $(".fold", el)?.addEventListener("click", e => { e.stopPropagation(); allRows = true; strip(); });
}
const VERDICTS = ["confirms", "adds", "contradicts"], FIGURES = D.figures || [], FINDINGS = FIGURES.flatMap(f => f.findings.map(x => ({ ...x, f })));
function waffle() {
 const n = Object.fromEntries(VERDICTS.map(k => [k, FINDINGS.filter(x => x.agreement === k).length]));
 $("#waffle-sub").textContent = `${FINDINGS.length} statements measured in ${plural(FIGURES.length, "figure")}; each square is one.`;
 $("#waffle").innerHTML = `<div class="wkey"><div class="confirms"><b>${n.confirms}</b>■ <span>as printed</span></div><div class="adds"><b>${n.adds}</b>□ <span>not said there</span></div><div class="contradicts"><b>${n.contradicts}</b>● <span>wrong, or only under conditions</span></div></div><div class="waffle" aria-hidden="true">${VERDICTS.map(k => `<i class="${k}"></i>`.repeat(n[k])).join("")}</div>`;
}
/* Draws a part of a picture, its pixels as squares. */
async function crop(canvas, s, m, cx, cy, w, h) {
 const p = await picture(s, m);
 [w, h] = [Math.min(w, s.w), Math.min(h, s.h)];
 const x0 = Math.round(clamp(cx - w / 2, 0, s.w - w)), y0 = Math.round(clamp(cy - h / 2, 0, s.h - h));
 [canvas.width, canvas.height] = [w * 2, h * 2];
 const x = canvas.getContext("2d");
 x.imageSmoothingEnabled = false;
 x.drawImage(p.canvas, x0, y0, w, h, 0, 0, w * 2, h * 2);
}
/* Where the lecture's fast method (else the least exact one that is no rival) is worst. */
function breakPair() {
 const m = M["fast-phong"] ? "fast-phong" : [...IDS].sort(by(i => -(M[i].max ?? 0)))[0], w = M[m]?.worst, el = $("#break");
 $("#take-break").hidden = !w || w.q.max < 1 || !hasPictures(w.scene);
 if ($("#take-break").hidden) return;
 $("#break-title").textContent = `Where ${nm(m)} breaks`;
 $("#break-sub").textContent = `${w.scene.title}: off by ${num(w.q.max)} grey levels.`;
 $("#break-link").href = `#scenes/${w.scene.id}?left=${m}&right=reference&mode=side`;
 el.innerHTML = ["reference", m].map(i => `<figure><canvas data-m="${esc(i)}" role="img" aria-label="${esc(nm(i))}"></canvas><figcaption>${esc(nm(i))}</figcaption></figure>`).join("");
 $$("canvas", el).forEach(c => crop(c, w.scene, c.dataset.m, w.q.worst?.[0] ?? 0, w.q.worst?.[1] ?? 0, w.scene.w * .6, w.scene.h * .6));
}
let v1, v2, hoverTimer;
function overview(_, q) {
 if (!SCENES.length) { $(".hero").hidden = $("#take-strip").hidden = $("#take-break").hidden = true; waffle(); return; }
 $("#take-strip").hidden = !MANY || !chosen(1).length;
 $("#take-lectures").hidden = !FINDINGS.length;
 const first = !v1;
 if (first) {
  const apart = s => Math.max(...s.list.map(m => s.rows[m].max)), choices = [...SCENES].filter(hasPictures).sort((a, b) => apart(b) - apart(a)).slice(0, 8).sort(by(s => s.number));
  const left = s => ["gouraud", ...[...s.list].sort(by(m => -s.rows[m].max))].find(m => s.list.includes(m));
  v1 = new Viewer($("#v1"), { scene: SCENES[0], a: left(SCENES[0]), b: SCENES[0].list.includes(BEST) && BEST !== left(SCENES[0]) ? BEST : "reference", choices: choices.length > 1 ? choices : null, change: (v, o) => { if (!o.view) pareto(v); remember(v); } });
  if (MANY) segments($("#pareto-basis"), [["all", `${SCENES.length} scenes`], ["scene", "This scene"]], () => basis, k => { basis = k; pareto(v1); });
  const el = $("#pareto"), near = (e, m) => {
   const box = $("svg", el).getBoundingClientRect(), at = e.clientX == null || e.type === "keydown" ? null : [e.clientX - box.left, e.clientY - box.top];
   const p = at && [...el._points].sort(by(p => Math.hypot(p.x - at[0], p.y - at[1])))[0];
   return p && Math.hypot(p.x - at[0], p.y - at[1]) < 11 ? p.m : m;
  };
  const keep = m => { v1.kept = m; };
  bind(el, (d, e) => { const m = near(e, d.m); if (!e.shiftKey) keep(m); v1.show(m, e.shiftKey); });
  el.onpointerover = e => { const h = e.target.closest(".hit"), m = h && near(e, h.dataset.m); if (h && e.pointerType === "mouse" && m !== v1.b && m !== v1.a) { clearTimeout(hoverTimer); hoverTimer = setTimeout(() => { v1.kept ??= v1.a; v1.set({ a: m }); }, 140); } };
  el.onpointerleave = () => { clearTimeout(hoverTimer); if (v1.kept && v1.kept !== v1.a) v1.set({ a: v1.kept }); v1.kept = null; };
  if (FINDINGS.length) waffle();
 }
 v1.set(fromRoute(q, v1));
 strip();
 if (first) setTimeout(breakPair, 350);
}

/* ---------- scenes */
let sort = { k: TIMED ? "ratio" : "max", d: TIMED ? -1 : 1 }, wide = false, bary = false;
function rail() {
 const el = $("#rail");
 if (el.children.length) return;
 el.innerHTML = SCENES.map(s => `<button role="option" data-s="${s.id}" tabindex="-1"><canvas aria-hidden="true"></canvas><span>${esc(s.title)}</span></button>`).join("");
 $$("button", el).forEach(b => thumb($("canvas", b), S[b.dataset.s]));
 el.onclick = e => { const b = e.target.closest("button"); if (b) openScene(S[b.dataset.s]); };
 el.onkeydown = e => { const d = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[e.key]; if (d) { e.preventDefault(); e.stopPropagation(); step(d); } };
}
const openScene = s => go(`scenes/${s.id}?left=${v2.a}&right=${v2.b}${v2.mode === "slide" ? "" : `&mode=${v2.mode}`}`);
const step = d => openScene(SCENES[(v2.scene.number + d + SCENES.length) % SCENES.length]);
function scenes([id], q) {
 if (!SCENES.length) return go("lectures");
 const s = S[id] ?? v2?.scene ?? SCENES[0];
 rail();
 if (!v2) {
  v2 = new Viewer($("#v2"), { scene: s, a: "gouraud", b: "reference", probe, row: v => toggleRow(v), change: (v, o) => { if (!o.view) { probe(v); markRows(); if (!("pin" in o)) rowPlot(v); } remember(v); } });
  $(".scn", $("#v2")).innerHTML = '<span class="hint-keys"><kbd>1</kbd>–<kbd>9</kbd> blink&nbsp; <kbd>Space</kbd> flip&nbsp; double-click zooms</span>';
  $("#cols").onclick = e => { wide = !wide; e.target.setAttribute("aria-pressed", wide); e.target.textContent = wide ? "Fewer columns" : "More columns"; table(); };
  $("#bary").onclick = e => { bary = !bary; e.target.setAttribute("aria-pressed", bary); table(); };
  $("#copy").onclick = copyMarkdown;
  $("#rowplot-close").onclick = () => toggleRow(v2);
  if (!hasPictures(s)) $(".scene-head").insertAdjacentHTML("beforebegin", '<p class="notice">These numbers were read from files (<code>--from</code>), which hold no pictures: the viewer, the probe and the maps need a report that draws.</p>');
 }
 if (v2.scene !== s) Object.assign(v2, { pin: null, hover: null, z: 1, cx: .5, cy: .5 });
 const n = s.stats, cut = s.triangulation, left = [["culled", "seen from the culled side"], ["outside", "outside the view"], ["zero_area", "without area"], ["unprojected", "at the plane of the eye"]].filter(([k]) => n[k]).map(([k, w]) => `${grouped(n[k])} ${w}`);
 $("#t-scenes").textContent = s.title;
 $("#scene-about").textContent = (s.description || "").replace(/\s+/g, " ");
 $("#scene-facts").textContent = `${plural(s.polygons, "polygon")} in view · ${plural(s.lights, "light")} · ${(s.covered_pixels / s.w / s.h * 100).toFixed(0)} % covered · ${s.w} × ${s.h} · ${s.interpolation === "screen" ? "linear on the screen" : "perspective-correct"} · ${s.renderer.level}, ${plural(s.renderer.threads, "thread")}${left.length ? ` · left out: ${left.join(", ")}` : ""}${cut ? ` · cut into triangles, the reference itself moves by up to ${num(cut.difference.max * 255)} levels` : ""}${s.not_simple ? ` · ${plural(s.not_simple, "polygon")} crossing themselves are not drawn by the barycentric renderer` : ""}`;
 $$("#rail button").forEach(x => {
  const on = x.dataset.s === s.id, r = $("#rail");
  x.setAttribute("aria-selected", on);
  if (!on) return;
  if (r.scrollHeight > r.clientHeight) r.scrollTop = Math.max(0, x.offsetTop - r.offsetTop - r.clientHeight / 2 + 24);
  r.scrollLeft = Math.max(0, x.offsetLeft - r.offsetLeft - r.clientWidth / 2 + 52);
 });
 const o = { ...fromRoute(q, v2), scene: s };
 v2.set(o);
 if (o.line != null) showRow(v2, o.line);
 else if (v2.line != null && q.has("left")) showRow(v2, null);
 table();
}
let probing = 0;
/* Colour and error of every method at the pixel under the pointer, else at the held one, else at the worst of the left. */
async function probe(v) {
 const s = v.scene, my = ++probing, of = v.a === "reference" ? v.b : v.a, rest = !v.hover && !v.pin && s.rows[of]?.worst, p = v.hover || v.pin || rest;
 v.rest = rest || null;
 if (!hasPictures(s)) return;
 const list = ["reference", ...s.list], px = {}, er = {};
 if (p) {
  const i = p[1] * s.w + p[0];
  await Promise.all(list.map(async m => { const q = await picture(s, m); px[m] = [...q.px.slice(4 * i, 4 * i + 3)]; er[m] = levels(s)[(await codes(s, m))[i]]; }));
  if (my !== probing) return;
 }
 const value = m => !p ? "" : m === "reference" ? px[m].join(" ") : er[m] === 0 ? "≤ 0.02" : er[m] >= 8 && s.encoding !== "srgb" ? Math.max(...px[m].map((c, i) => Math.abs(c - px.reference[i]))) : er[m] < 1 ? er[m].toFixed(2) : er[m] < 10 ? er[m].toFixed(1) : er[m].toFixed(0);
 const folded = list.length > 16 && !probe.open ? list.filter(m => m === "reference" || m === v.a || m === v.b || M[m].key || MARKED.has(m)) : list;
 const html = `<h2>Pixel <span>${p ? `${p[0]}, ${p[1]}${rest ? ` · worst of ${esc(nm(of))}` : v.pin && !v.hover ? " · held" : ""}` : "point at the picture"}</span></h2><canvas class="zoomed-px" width="142" height="70" role="img" aria-label="The pixel and its neighbours, left and right"></canvas><ol>${folded.map(m => `<li><button data-m="${esc(m)}" class="${m === v.a ? "a" : m === v.b ? "b" : ""}"><kbd>${m === "reference" ? 0 : M[m].key || "·"}</kbd>${mark(m)}<span class="n">${esc(nm(m))}</span><span class="sw" style="${p ? `background:rgb(${px[m]})` : ""}"></span><span class="v${p && er[m] >= 1 ? " vis" : ""}">${value(m)}</span></button></li>`).join("")}</ol>${folded.length < list.length ? `<button class="more">All ${list.length - 1} methods</button>` : ""}<p class="hint">${p ? "Error in grey levels; red is one or more. Click holds a pixel." : "Every method’s colour and error at the pixel under the pointer."}</p>`;
 const el = $("#probe");
 if (el._html !== html) {
  el.innerHTML = el._html = html;
  $("ol", el).onclick = e => { const b = e.target.closest("button"); if (b) v.show(b.dataset.m, e.shiftKey); };
  $(".more", el)?.addEventListener("click", () => { probe.open = true; probe(v); });
 }
 if (!p) return;
 const c = $(".zoomed-px", el), x = c.getContext("2d"), [A, B] = [(await picture(s, v.a)).canvas, (await picture(s, v.b)).canvas];
 x.imageSmoothingEnabled = false;
 x.clearRect(0, 0, 142, 70);
 x.drawImage(A, p[0] - 3, p[1] - 3, 7, 7, 0, 0, 70, 70);
 x.drawImage(B, p[0] - 3, p[1] - 3, 7, 7, 72, 0, 70, 70);
 x.strokeStyle = "#fff";
 for (const o of [0, 72]) x.strokeRect(o + 30.5, 30.5, 9, 9);
}
const toggleRow = v => showRow(v, v.line == null ? (v.pin ?? v.rest ?? [0, v.scene.h >> 1])[1] : null);
function showRow(v, y) { v.line = y; $("#rowplot").hidden = y == null; $(".row", v.root).setAttribute("aria-pressed", y != null); v.draw(); rowPlot(v); remember(v); }
/* Intensity of a row by each method, and its slope below. */
async function rowPlot(v) {
 const el = $("#rowplot-chart"), s = v.scene;
 if (v.line == null || !hasPictures(s)) return;
 const y0 = v.line = clamp(v.pin ? v.pin[1] : v.line, 0, s.h - 1), list = ["reference", ...s.list], grey = {}, W = Math.round(el.clientWidth) || 700;
 await Promise.all(list.map(async m => { const { px } = await picture(s, m); grey[m] = Float32Array.from({ length: s.w }, (_, x) => { const i = 4 * (y0 * s.w + x); return .2126 * px[i] + .7152 * px[i + 1] + .0722 * px[i + 2]; }); }));
 const slope = g => g.map((_, x) => (g[Math.min(s.w - 1, x + 2)] - g[Math.max(0, x - 2)]) / 4), bold = [v.b, v.a], slopes = Object.fromEntries(list.map(m => [m, slope(grey[m])]));
 const l = 44, r = 10, H1 = 190, H2 = 120, H = H1 + H2 + 34, x = lin(0, s.w, l, W - r), range = o => [Math.min(...list.map(m => Math.min(...o[m]))), Math.max(...list.map(m => Math.max(...o[m])))];
 const [g0, g1] = range(grey), [s0, s1] = range(slopes), ya = lin(g0, g1 + 1, H1 - 6, 10), yb = lin(s0, s1 + .1, H1 + H2, H1 + 14);
 const curve = (g, y) => "M" + Array.from(g, (q, i) => x(i + .5).toFixed(1) + " " + y(q).toFixed(1)).join("L");
 let o = "";
 for (const t of linTicks(g0, g1 + 1, 4)) o += line(l, ya(t), W - r, ya(t)) + text(l - 6, ya(t) + 4, t, `class="t" ${END}`);
 for (const t of linTicks(s0, s1 + .1, 3)) o += line(l, yb(t), W - r, yb(t)) + text(l - 6, yb(t) + 4, tickText(t), `class="t" ${END}`);
 for (const t of linTicks(0, s.w, 8)) o += text(x(t), H - 18, t, `class="t" ${MID}`);
 o += text((l + W - r) / 2, H - 3, "pixel of the row", `class="ax" ${MID}`) + text(l + 4, 20, "grey level", 'class="ax halo"') + text(l + 4, H1 + 26, "slope, levels a pixel", 'class="ax halo"');
 for (const m of [...list.filter(m => !bold.includes(m)), ...bold]) { const on = bold.includes(m), c = `fill="none" stroke="${hue(m)}" stroke-width="${on ? 2 : 1}" opacity="${on ? 1 : .35}"${m === "reference" && on ? ' stroke-dasharray="5 3"' : ""}`; o += `<path d="${curve(grey[m], ya)}" ${c}/><path d="${curve(slopes[m], yb)}" ${c}/>`; }
 if (v.pin) o += line(x(v.pin[0] + .5), 8, x(v.pin[0] + .5), H1 + H2, 'stroke="var(--ink3)" stroke-dasharray="2 3"');
 $("#rowplot-title").textContent = `Row ${y0} of ${s.title}`;
 el.innerHTML = SVG(W, H, o, `Grey levels along row ${y0}, and their slope`) + `<div class="legend">${list.map(m => `<button data-m="${esc(m)}" class="${m === v.a ? "a" : m === v.b ? "b" : ""}">${mark(m)}${esc(nm(m))}</button>`).join("")}</div>`;
 $(".legend", el).onclick = e => { const b = e.target.closest("button"); if (b) v.show(b.dataset.m, e.shiftKey); };
 v.draw();
}
const COLUMNS = [["max", "max error", 1], ["rms", "RMS", 1], ["p99", "99 %"], ["own", "own max"], ["over1", "pixels > 1 level"], ["other", "other polygon"], ["psnr", "PSNR, dB"], ["ssim", "SSIM"], ["ms", "ms", 1], ["ns", "ns a pixel"], ["ratio", "speed, × naive Phong", 1], ["barycentric", "× barycentric"]];
const tableRows = () => Object.values(v2.scene.rows).filter(q => bary || !q.bary);
const sortValue = (q, k) => k === "name" ? IDS.indexOf(q.variant) : k === "ratio" || k === "barycentric" ? q[k]?.[0] ?? 0 : q[k] ?? (k === "psnr" ? 1e9 : -1);
const ratioText = q => q ? `${q[3] && q[1] !== q[2] ? "= " : ""}${q[0].toFixed(2)}${X}` : "–";
function table() {
 const rows = tableRows().sort((a, b) => { const x = sortValue(a, sort.k), y = sortValue(b, sort.k); return (x < y ? -1 : x > y ? 1 : 0) * sort.d; }), columns = COLUMNS.filter(c => wide || c[2]);
 const ratios = rows.map(q => q.ratio).filter(Boolean), lo = Math.min(.8, ...ratios.map(r => r[1])), hi = Math.max(1.25, ...ratios.map(r => r[2])), sw = wide ? 104 : 170, x = logs(lo * .96, hi * 1.04, 5, sw - 6);
 const long = e => clamp((Math.log10(Math.max(e, TINY)) + 3) / (Math.log10(255) + 3), 0, 1) * 100, slowest = Math.max(...rows.map(q => q.ms ?? 0)), folded = rows.length > 18 && !table.open;
 const bar = (value, part, c) => `<td><span class="inl"><span>${value}</span><i style="--c:${c}"><b style="width:${part}%"></b></i></span></td>`;
 const cell = (q, k) => {
  const c = hue(q.variant);
  switch (k) {
   case "max": case "rms": return bar(num(q[k]), long(q[k]), c);
   case "ms": return q.ms ? bar(num(q.ms), q.ms / slowest * 100, c) : "<td>–</td>";
   case "ratio": {
    if (!q.ratio) return "<td>–</td>";
    const [m, a, b, tie] = q.ratio, base = q.variant === BASE && !q.bary, tick = v => line(x(v), 5, x(v), 13, `stroke="${c}" opacity=".6"`);
    return `<td><span class="speedcell" style="grid-template-columns:${sw}px 5.2em"><svg width="${sw}" height="18" aria-hidden="true">${line(x(1), 0, x(1), 18, 'stroke="var(--line2)"')}${line(x(a), 9, x(b), 9, `stroke="${c}" stroke-width="2" opacity=".6"`)}${tick(a)}${tick(b)}${shape(q.variant, x(m), 9, 4.4)}</svg><span class="${base || tie ? "" : m > 1 ? "faster" : "slower"}" title="95 %: ${a.toFixed(2)}–${b.toFixed(2)}">${ratioText(q.ratio)}</span></span></td>`;
   }
   case "barycentric": return `<td>${ratioText(q.barycentric)}</td>`;
   case "ssim": return `<td>${q.ssim == null ? "–" : q.ssim.toFixed(4)}</td>`;
   case "psnr": return `<td>${q.psnr == null ? "∞" : q.psnr.toFixed(1)}</td>`;
   case "over1": case "other": return `<td>${grouped(q[k])}</td>`;
   case "own": return `<td${q.explained ? "" : ' title="more than rounding explains"'}>${q.explained ? "" : "! "}${num(q.own)}</td>`;
   default: return `<td>${num(q[k])}</td>`;
  }
 };
 const head = (k, l) => `<th scope="col" aria-sort="${sort.k === k ? (sort.d > 0 ? "ascending" : "descending") : "none"}"><button data-k="${k}">${l}${sort.k === k ? (sort.d > 0 ? " ↑" : " ↓") : ""}</button></th>`;
 $("#table").innerHTML = `<table class="data"><thead><tr>${head("name", "method")}${columns.map(([k, l]) => head(k, l)).join("")}</tr></thead><tbody>${(folded ? rows.slice(0, 15) : rows).map(q => `<tr data-m="${esc(q.variant)}"${q.bary ? ' class="bary"' : ""}><th scope="row"><button class="mname">${mark(q.variant)}${esc(nm(q.variant))}${q.bary ? " <small>barycentric</small>" : ""}</button></th>${columns.map(c => cell(q, c[0])).join("")}</tr>`).join("")}</tbody></table>${folded ? `<button class="fold">All ${rows.length} rows</button>` : ""}`;
 $("#table thead").onclick = e => { const b = e.target.closest("button"); if (!b) return; const k = b.dataset.k; sort = sort.k === k ? { k, d: -sort.d } : { k, d: ["ratio", "barycentric", "psnr", "ssim"].includes(k) ? -1 : 1 }; table(); };
 $("#table tbody").onclick = e => { const t = e.target.closest("tr"); if (t) v2.show(t.dataset.m, e.shiftKey); };
 $("#table .fold")?.addEventListener("click", () => { table.open = true; table(); });
 markRows();
}
const markRows = () => $$("#table tbody tr").forEach(t => t.classList.toggle("sel", t.dataset.m === v2?.a));
function copyMarkdown() {
 const rows = tableRows().sort(by(q => -(q.ratio?.[0] ?? 0))), cell = t => String(t).replace(/[|\\`*_<]/g, "\\$&");
 const markdown = `| ${cell(v2.scene.title)} | max error, levels | RMS | ms | speed |\n|---|--:|--:|--:|--:|\n${rows.map(q => `| ${cell(nm(q.variant))}${q.bary ? " (barycentric)" : ""} | ${num(q.max)} | ${num(q.rms)} | ${num(q.ms)} | ${q.ratio ? `${q.ratio[0].toFixed(2)} (${q.ratio[1].toFixed(2)}–${q.ratio[2].toFixed(2)})` : "–"} |`).join("\n")}`;
 (navigator.clipboard?.writeText(markdown) ?? Promise.reject()).then(() => toast("Table copied as Markdown"), () => { save("table.md", markdown, "text/markdown"); toast("Saved: the browser does not let a file copy"); });
}

/* ---------- methods: formulas as mathematics */
const GREEK = { phi: "φ", theta: "θ", alpha: "α", delta: "δ" }, FUNCTIONS = new Set(["sin", "cos", "sqrt", "rsqrt", "min", "max"]), VECTORS = /^[NLVRHP]$/;
const mo = t => `<mo stretchy="false">${esc(t)}</mo>`, mrow = s => `<mrow>${s}</mrow>`, words = t => `<mtext>&nbsp;${esc(t)}&nbsp;</mtext>`;
/* A name: d… is a difference, trailing letters are an index, N, L, V and the like are vectors. */
function symbol(t) {
 if (/^\d/.test(t)) return `<mn>${t}</mn>`;
 if (GREEK[t]) return `<mi>${GREEK[t]}</mi>`;
 const [, d, head, index, mark] = /^(d*)([A-Za-z])([a-z0-9]*)(?:_(\w+))?$/.exec(/^[a-z]+$/.test(t) && t[0] === "d" ? "_" : t) ?? (/^d$/.test(t) ? [0, "", "d", ""] : [0, "", t, ""]);
 const main = `${d ? `<mi mathvariant="normal">${"Δ".repeat(d.length)}</mi>` : ""}<mi${VECTORS.test(head) ? ' mathvariant="normal" class="v"' : ""}>${head}</mi>`, under = index || mark;
 return under ? `<msub>${mrow(main)}${mrow(`<mi>${esc(under)}</mi>`)}</msub>` : mrow(main);
}
/* Reads a formula as `fastphong explain` prints it; what is no formula stays words. */
function formula(source) {
 return source.split(/[;\n]|,(?![^(]*\))/).map(s => s.trim()).filter(Boolean).map(part => {
  if (!/[=^/]/.test(part)) return `<div class="words">${esc(part)}</div>`;
  const named = /^(\w+)_next\s*=/.exec(part), tokens = (named ? part.replace(named[0], named[1] + " ←") : part).match(/[A-Za-z]+\d*(?:_[a-z]+)?|\d+(?:\.\d+)?|\.\.\.|\s+|\S/g);
  let at = 0;
  const isWord = t => /^[A-Za-z]{3,}$/.test(t) && !FUNCTIONS.has(t) && !GREEK[t] || ["by", "of", "at", "to", "on", "eq"].includes(t);
  const read = close => {
   const items = [];
   const push = (html, o = {}) => items.push({ html, ...o });
   while (at < tokens.length) {
    const t = tokens[at++];
    if (t === close) break;
    if (/^\s+$/.test(t)) { if (items.length) items[items.length - 1].gap = true; continue; }
    if (isWord(t)) {
     let w = t;
     while (at < tokens.length && (/^\s+$/.test(tokens[at]) || isWord(tokens[at]) || /^(an?|[\d.\-']+|s)$/.test(tokens[at]) || w.endsWith("eq ") || tokens[at] === "'")) w += tokens[at++];
     push(words(w.trim()), { op: true });
    } else if (FUNCTIONS.has(t) && tokens[at] === "(") {
     at++;
     const inner = mrow(read(")"));
     push(t === "sqrt" ? `<msqrt>${inner}</msqrt>` : t === "rsqrt" ? `<mfrac><mn>1</mn><msqrt>${inner}</msqrt></mfrac>` : mrow(`<mi>${t}</mi>${mo("(")}${inner}${mo(")")}`));
    } else if (t === "(" ) {
     const before = items[items.length - 1], call = before && !before.op && !before.gap && before.name, inner = mrow(`${mo("(")}${read(")")}${mo(")")}`);
     if (call) before.html = mrow(before.html + inner);
     else push(inner);
    } else if (t === "|") push(mrow(`${mo("|")}${read("|")}${mo("|")}`));
    else if (t === "^") {
     const base = items.pop();
     while (/^\s+$/.test(tokens[at])) at++;
     push(`<msup>${mrow(base?.html ?? "")}${symbol(tokens[at++])}</msup>`);
    } else if (t === "/") push("/", { op: true, over: true, loose: items[items.length - 1]?.gap });
    else if (/^[A-Za-z0-9]/.test(t)) push(symbol(t), { name: /^[A-Z]/.test(t) });
    else push(mo({ ".": "·", "*": "×", "-": "−", "...": "…" }[t] ?? t), { op: t !== ".", dot: t === "." });
   }
   // Fractions: a / b with spaces takes the products on both sides, a/b without them the neighbours.
   for (let i = items.findIndex(x => x.over); i > 0; i = items.findIndex(x => x.over)) {
    const loose = items[i].loose, product = (k, step) => { let e = k; while (loose && items[e + step] && !items[e + step].op) e += step; return e; };
    const a = product(i - 1, -1), b = Math.min(product(i + 1, 1), items.length - 1);
    const join = list => mrow(list.map(x => x.html).join(""));
    items.splice(a, b - a + 1, { html: `<mfrac>${join(items.slice(a, i))}${join(items.slice(i + 1, b + 1))}</mfrac>` });
   }
   return items.map(x => x.html).join("");
  };
  return `<div><math>${read()}</math></div>`;
 }).join("");
}
const OPERATIONS = [["additions", "+"], ["multiplications", "×"], ["comparisons", "<"], ["divisions", "÷"], ["roots", "√"], ["sines, arctangents", "∿"], ["powers", "^"]];
const RATES = [["a span", "span"], ["an edge", "edge"], ["a scanline of an edge", "edge_step"], ["a vertex", "vertex"], ["a polygon", "polygon"]];
const NUMBERS = ["No", "One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight", "Nine", "Ten", "Eleven", "Twelve"];
function methods([id]) {
 const el = $("#methodlist"), many = D.methods?.length > 14;
 if (!el.children.length) {
  $("#t-methods").textContent = `${NUMBERS[IDS.length] ?? IDS.length} ${IDS.length === 1 ? "way" : "ways"} to one equation`;
  $("#light").innerHTML = formula("I = Ia ka + Ip kd (L.N) + Ip ks (R.V)^n");
  const pixel = m => m.operations[0].walk.map((v, i) => v + m.operations[0].shade[i]), all = D.methods.flatMap(m => [pixel(m), ...RATES.map(r => m.operations[0][r[1]])].map(sum)), most = Math.max(...all);
  const stack = o => sum(o) ? `<div class="stack" style="width:${Math.max(4, sum(o) / most * 100)}%" role="img" aria-label="${o.map((v, i) => v ? `${v} ${OPERATIONS[i][0]}` : "").filter(Boolean).join(", ")}">${o.map((v, i) => v ? `<i class="o${Math.min(i, 5)}" style="flex:${v} 0 ${i > 2 ? 13 : 0}px" title="${v} ${OPERATIONS[i][0]}">${v / most > .035 || i > 2 ? v : ""}</i>` : "").join("")}</div>` : '<div class="none">none</div>';
  const corner = D.speedups?.corners.findIndex(c => c.work === "frame" && !c.scalar);
  const article = m => {
   const w = m.worst, study = D.speedups?.methods.find(q => q.method === m.name)?.corners[corner]?.ratio_to_naive, fails = m.fails || "nowhere known", bad = w && w.q.max >= 1;
   const kpi = [m.speed && [(m.name === BASE ? "1" : m.speed.toFixed(2)) + X, MANY ? `${SCENES.length} scenes, ${SCENES[0].renderer.level}` : SCENES[0].renderer.level], study && [study.median.toFixed(2) + X, `whole frame, ${D.speedups.corners[corner].level.toUpperCase()}`], w && [num(w.q.max), "worst error, levels", bad]].filter(Boolean);
   return `<article class="method" id="m-${esc(m.name)}"><div><h2>${mark(m.name)}${esc(m.label)} <code>${esc(m.name)}</code></h2><p class="idea">${esc(m.title)}</p><div class="formula">${formula(m.formula)}</div><p class="src">${esc(m.source)} · ${esc(m.perspective)} · ${esc(m.local)}</p></div>
<div><div class="ops"><div class="row"><span>a pixel</span>${stack(pixel(m))}</div>${RATES.filter(r => sum(m.operations[0][r[1]])).map(([l, k]) => `<div class="row"><span>${l}</span>${stack(m.operations[0][k])}</div>`).join("")}</div><div class="kpi">${kpi.map(([v, l, b]) => `<div><b${b ? ' class="slower"' : ""}>${v}</b>${l}</div>`).join("")}</div></div>
${w ? `<figure class="crop"><div class="cc"><canvas data-m="reference" role="img" aria-label="reference"></canvas><canvas data-m="${esc(m.name)}" role="img" aria-label="${esc(m.label)}"></canvas><span>reference</span><span>${esc(m.label)}</span></div><figcaption>${bad ? `<b>Fails</b> most in <a href="#scenes/${w.scene.id}?left=${encodeURIComponent(m.name)}&right=reference">${esc(w.scene.title)}</a>; in principle: ${esc(fails)}.` : `<b>No visible failure</b> ${MANY ? `in ${SCENES.length} scenes` : "in this scene"}. In principle: ${esc(fails)}.`}</figcaption></figure>` : ""}</article>`;
  };
  const shown = many && !methods.open && !id ? D.methods.slice(0, 11) : D.methods;
  el.innerHTML = `<div class="opkey">${OPERATIONS.slice(0, 6).map(([t], i) => `<span><i class="o${i}"></i>${t}</span>`).join("")}<span>counted from the methods’ own code, one light, shininess 32</span></div>${shown.map(article).join("")}${shown.length < D.methods.length ? `<button class="fold">All ${D.methods.length} methods</button>` : ""}`;
  $(".fold", el)?.addEventListener("click", () => { methods.open = true; el.innerHTML = ""; methods([]); });
  for (const m of shown) {
   const w = m.worst, k = document.getElementById("m-" + m.name);
   if (w && hasPictures(w.scene)) $$("canvas", k).forEach(c => { queue = queue.then(() => crop(c, w.scene, c.dataset.m, w.q.worst?.[0] ?? w.scene.w / 2, w.q.worst?.[1] ?? w.scene.h / 2, 84, 84)).catch(() => {}); });
  }
 }
 const target = id && document.getElementById("m-" + id);
 if (target) requestAnimationFrame(() => target.scrollIntoView({ block: "start" }));
}

/* ---------- speed */
let cornerMode = "same";
const STUDY = D.speedups, studied = () => STUDY.methods.filter(m => cornerMode === "all" || m.levels_off <= 1);
const cornerName = c => [c.work, c.level === "scalar" ? "scalar" : c.level.toUpperCase()];
function corners() {
 const el = $("#corners"), W = Math.round(el.clientWidth), places = STUDY.corners.map((c, i) => [c, i]).filter(q => q[0].lights === 1), ratio = (m, i) => m.corners[i].ratio_to_naive;
 const ms = studied().filter(m => places.every(q => ratio(m, q[1])));
 if (!W || !ms.length) return;
 const narrow = W < 560, l = narrow ? 36 : 44, r = narrow ? 140 : 172, t = 58, b = 20, H = Math.max(430, t + b + ms.length * 16.5), x = lin(0, places.length - 1, l + 26, W - r - 14), vs = ms.flatMap(m => places.map(q => ratio(m, q[1]).median)), lo = Math.min(...vs) * .9, hi = Math.max(...vs) * 1.1, y = logs(lo, hi, H - b, t);
 let o = "", last = -99;
 for (const g of [32, 16, 8, 4, 3, 2, 1.5, 1.25, 1, .75, .5, .25, .1]) if (g >= lo && g <= hi && (g === 1 || y(g) - last > 22)) { last = y(g); o += line(l, y(g), W - r, y(g), g === 1 ? 'stroke="var(--ink3)"' : undefined) + text(l - 6, y(g) + 4, g + (g === 1 ? X : ""), `class="t" ${END}`); }
 places.forEach(([c, i], k) => {
  const best = STUDY.methods.filter(m => m.levels_off <= 1 && ratio(m, i)).sort((p, q) => ratio(q, i).median - ratio(p, i).median)[0], [work, level] = cornerName(c);
  o += line(x(k), t, x(k), H - b);
  o += narrow ? text(x(k), 14, work, `class="b" ${MID} style="font-size:11px"`) + text(x(k), 28, level, `${MID} style="font-size:11px"`) : text(x(k), 16, `${work}, ${level}`, `class="b" ${MID}`);
  if (best) o += narrow ? "" : text(x(k), 32, "fastest: " + esc(nm(best.method)), `class="t" ${MID}`);
  if (best) o += text(x(k), 46, ratio(best, i).median.toFixed(2) + X, `class="t" ${MID}`);
 });
 const end = places[places.length - 1][1], labels = spread(ms.map(m => y(ratio(m, end).median)), 16, t, H - b);
 ms.forEach((m, n) => {
  const hero = MARKED.has(m.method), c = hue(m.method), tip = `${nm(m.method)}: ${places.map(([k, i]) => `${cornerName(k).join(" ")} ${ratio(m, i).median.toFixed(2)} ×`).join(", ")}`;
  o += `<g class="hit" data-m="${esc(m.method)}" tabindex="0" role="button" aria-label="${esc(tip)}"><title>${esc(tip)}</title><path d="M${places.map(([, i], k) => x(k).toFixed(1) + " " + y(ratio(m, i).median).toFixed(1)).join("L")}" fill="none" stroke="${c}" stroke-width="${hero ? 2.25 : 1.4}" opacity="${hero ? .95 : .6}"/>${places.map(([, i], k) => line(x(k), y(ratio(m, i).low), x(k), y(ratio(m, i).high), `stroke="${c}" stroke-width="1.5"`) + shape(m.method, x(k), y(ratio(m, i).median), 5)).join("")}<path d="M${x(places.length - 1) + 8} ${y(ratio(m, end).median)}L${x(places.length - 1) + 20} ${labels[n]}" stroke="var(--line2)" fill="none"/>${text(x(places.length - 1) + 24, labels[n] + 4, `${esc(nm(m.method))}<tspan dx="6" style="fill:var(--ink2);font-weight:450">${ratio(m, end).median.toFixed(2)}</tspan>`, `class="label" style="${hero ? "font-weight:600;" : ""}${narrow ? "font-size:11px" : ""}"`)}</g>`;
 });
 el.innerHTML = SVG(W, H, o, "Speed of methods in kernels and frames, scalar and SIMD");
 bind(el, d => go("methods/" + d.m));
}
function lights() {
 const el = $("#lights"), W = Math.round(el.clientWidth), ms = studied().slice(0, 14), H = 450, t = 40;
 const pairs = [true, false].map(scalar => [1, 4].map(n => STUDY.corners.findIndex(c => c.work === "kernel" && c.scalar === scalar && c.lights === n))).filter(p => p.every(i => i >= 0)), half = (W - 20 * (pairs.length - 1)) / pairs.length;
 if (!W || !pairs.length) return;
 const ns = (m, i) => m.corners[i].timing.median_ns / STUDY.span;
 let o = "";
 pairs.forEach(([one, four], k) => {
  const x0 = k * (half + 20), v = ms.flatMap(m => [ns(m, one), ns(m, four)]), y = logs(Math.min(...v) * .9, Math.max(...v) * 1.1, H - 34, t), xa = x0 + 34, xb = x0 + half - 118, labels = spread(ms.map(m => y(ns(m, four))), 15, t, H - 34);
  o += text((xa + xb) / 2, 14, cornerName(STUDY.corners[one])[1], `class="b" ${MID}`);
  for (const [at, n] of [[xa, 1], [xb, 4]]) o += text(at, H - 12, W < 520 ? n : n === 1 ? "1 light" : "4 lights", `class="t" ${MID}`) + line(at, t - 8, at, H - 28);
  ms.forEach((m, i) => {
   const hero = MARKED.has(m.method), c = hue(m.method), q = n => m.corners[n].timing;
   o += `<g class="hit" data-m="${esc(m.method)}"><title>${esc(nm(m.method))}: ${num(ns(m, one))} → ${num(ns(m, four))} ns a pixel</title>${line(xa, y(ns(m, one)), xb, y(ns(m, four)), `stroke="${c}" stroke-width="${hero ? 2.25 : 1.4}" opacity="${hero ? .95 : .6}"`)}${[[xa, one], [xb, four]].map(([at, n]) => line(at, y(q(n).p25_ns / STUDY.span), at, y(q(n).p75_ns / STUDY.span), `stroke="${c}" stroke-width="3" opacity=".28"`) + shape(m.method, at, y(ns(m, n)), 4.6)).join("")}${text(xb + 12, labels[i] + 4, `${num(ns(m, four), 2)} <tspan style="fill:var(--ink2);${hero ? "font-weight:600" : ""}">${esc(nm(m.method).replace(" Phong", ""))}</tspan>`, 'class="label" style="font-size:11.5px"')}</g>`;
  });
  const least = Math.min(...ms.map(m => ns(m, one))), most = Math.max(...ms.map(m => ns(m, one)));
  for (const v of [least, most]) o += text(xa - 9, y(v) + 4, num(v, 2), `class="t" ${END}`);
 });
 el.innerHTML = SVG(W, H, o, "Nanoseconds a pixel with one and four lights");
 bind(el, d => go("methods/" + d.m));
}
const curveName = c => c.engine === "span" ? `${nm(c.method)}, lecture’s form` : nm(c.method), curveHue = c => c.engine === "span" ? "var(--ink3)" : hue(c.method);
function grow(id, keep, count, label) {
 const el = $(id), W = Math.round(el.clientWidth), G = D.scaling, points = G.points.map((p, i) => ({ n: count(p), i, p })).filter(q => keep(q.p)).sort(by(q => q.n));
 if (!W || points.length < 2) return;
 const H = 330, l = 48, r = W < 480 ? 112 : 150, t = 14, b = 44, x = logs(points[0].n, points[points.length - 1].n, l + 8, W - r), ms = (c, q) => c.times[q.i] && c.times[q.i].min_ns / 1e6, v = G.curves.flatMap(c => points.map(q => ms(c, q))).filter(Boolean), y = logs(Math.min(...v) * .85, Math.max(...v) * 1.15, H - b, t);
 let o = "";
 for (const g of logTicks(Math.min(...v) * .85, Math.max(...v) * 1.15, 6)) o += line(l, y(g), W - r + 8, y(g)) + text(l - 6, y(g) + 4, tickText(g) + " ms", `class="t" ${END}`);
 for (const g of logTicks(points[0].n, points[points.length - 1].n, 5)) o += text(x(g), H - b + 18, tickText(g), `class="t" ${MID}`);
 o += text((l + W - r) / 2, H - 6, label, `class="ax" ${MID}`);
 const drawn = G.curves.map(c => points.filter(q => ms(c, q))), ends = drawn.map(q => q[q.length - 1]), labels = spread(G.curves.map((c, i) => y(ms(c, ends[i]))), 16, t, H - b);
 G.curves.forEach((c, i) => {
  const colour = curveHue(c), name = c.engine === "span" ? "lecture’s form" : nm(c.method);
  o += `<path d="M${drawn[i].map(q => x(q.n).toFixed(1) + " " + y(ms(c, q)).toFixed(1)).join("L")}" fill="none" stroke="${colour}" stroke-width="2"${c.engine === "span" ? ' stroke-dasharray="5 4"' : ""}/>${drawn[i].map(q => `<circle cx="${x(q.n)}" cy="${y(ms(c, q))}" r="3" fill="${colour}"><title>${esc(curveName(c))}: ${num(ms(c, q))} ms</title></circle>`).join("")}${text(x(ends[i].n) + 9, labels[i] + 4, esc(name), 'class="halo label" style="font-size:12px"')}`;
 });
 el.innerHTML = SVG(W, H, o, label);
}
function costs() {
 const curves = D.scaling.curves.filter(c => c.costs), kinds = [["vertex_ns", "vertex"], ["triangle_ns", "triangle"], ["span_ns", "span"], ["pixel_ns", "pixel of a span"], ["background_ns", "pixel of the picture"]];
 const row = (c, most, k) => `<div class="cost" title="${esc(curveName(c))}"><span><i style="width:${Math.max(1, c.costs[k] / most * 100)}%;background:${curveHue(c)}"></i></span><span>${num(c.costs[k], 2)}</span></div>`;
 $("#costs").innerHTML = `<div class="names"><b>&nbsp;</b>${curves.map(c => `<div>${esc(c.engine === "span" ? "lecture’s form" : nm(c.method))}</div>`).join("")}</div>${kinds.map(([k, n]) => `<div><b>${n}</b>${curves.map(c => row(c, Math.max(...curves.map(c => c.costs[k])) || 1, k)).join("")}</div>`).join("")}`;
 const base = curves.find(c => c.method === BASE && c.engine !== "span"), fitted = curves.find(c => c !== base && c.costs);
 const even = base ? curves.filter(c => c.method !== BASE && c.engine === base.engine).map(c => {
  const saves = base.costs.pixel_ns - c.costs.pixel_ns, more = c.costs.span_ns - base.costs.span_ns;
  return `${nm(c.method)} ${saves <= 0 ? "saves nothing a pixel" : more <= 0 ? "is cheaper from the first pixel of a span" : `from ${num(more / saves, 2)} pixels a span`}`;
 }) : [];
 const worst = Math.max(...curves.map(c => Math.abs(c.costs.worst)));
 $("#breakeven").textContent = even.length ? `Break-even with ${nm(BASE)} by these costs: ${even.join("; ")}. The largest misfit of a time is ${(worst * 100).toFixed(0)} %.` : fitted ? `The largest misfit of a time is ${(worst * 100).toFixed(0)} %.` : "";
}
let besideScene = "";
/* Documents side by side: a column each, the processor as its head. */
function beside() {
 const names = [...new Set(DOCS.flatMap(d => d.comparisons.map(c => c.name)))], pick = $("#beside-scene"), all = "all scenes they share";
 if (!pick.options.length) { pick.innerHTML = [...(names.length > 1 ? [""] : []), ...names].map(n => `<option value="${esc(n)}">${esc(n || all)}</option>`).join(""); besideScene = pick.value; pick.onchange = () => { besideScene = pick.value; beside(); }; }
 const shared = besideScene ? [besideScene] : names.filter(n => DOCS.every(d => d.comparisons.some(c => c.name === n)));
 const cell = (d, m) => { const rows = shared.map(n => d.comparisons.find(c => c.name === n)?.rows.find(r => r.variant === m)); if (!rows.length || rows.some(r => !r?.speed)) return null; return { ms: geo(rows.map(r => r.speed.timing.median_ns / 1e6)), ratio: geo(rows.map(r => r.speed.ratio_to_naive?.median ?? 1)), max: Math.max(...rows.map(r => r.error.max * 255)) }; };
 const variants = [...new Set(DOCS.flatMap(d => d.comparisons.flatMap(c => c.rows.map(r => r.variant))))];
 $("#beside").innerHTML = `<table class="data"><thead><tr><th scope="col">method</th>${DOCS.map(d => `<th scope="col" title="${esc(d.machine.rustc)}">${esc(d.machine.cpu)}<br><small>${esc([d.machine.version, d.machine.commit?.slice(0, 9), d.date].filter(Boolean).join(" · "))}</small></th>`).join("")}</tr></thead><tbody>${variants.map(m => `<tr><th scope="row"><span class="mname">${mark(m)}${esc(nm(m))}</span></th>${DOCS.map(d => { const q = cell(d, m); return `<td>${q ? `${num(q.ms)} ms · ${q.ratio.toFixed(2)}${X} · ${num(q.max)} levels` : "–"}</td>`; }).join("")}</tr>`).join("")}</tbody></table>`;
}
function speed() {
 const show = (id, on) => { $(id).hidden = !on; };
 show("#speed-corners", STUDY);
 show("#speed-growth", D.scaling);
 show("#speed-beside", DOCS.length > 1);
 show("#speed-none", !STUDY && !D.scaling);
 show("#speed-answer", STUDY);
 if (STUDY) {
  const places = STUDY.corners.map((c, i) => [c, i]).filter(q => q[0].lights === 1), phrase = ([c, i]) => {
   const same = STUDY.methods.filter(m => m.levels_off <= 1 && m.corners[i].ratio_to_naive).sort((p, q) => q.corners[i].ratio_to_naive.median - p.corners[i].ratio_to_naive.median)[0], fast = STUDY.methods.find(m => m.method === "fast-phong")?.corners[i].ratio_to_naive;
   return same && `${cornerName(c).reverse().join(" ")}s: ${nm(same.method)} ${same.corners[i].ratio_to_naive.median.toFixed(2)}${X}${fast && same.method !== "fast-phong" ? `, fast Phong ${fast.median.toFixed(2)}${X}` : ""}`;
  };
  $("#speed-answer").textContent = `Fastest with naive Phong’s picture, and the lecture’s fast Phong beside it — ${places.map(phrase).filter(Boolean).join("; ")}.`;
  $("#corners-sub").textContent = `Speed as a multiple of naive Phong’s in the same corner; whiskers are 95 % intervals. Spans of ${grouped(STUDY.span)} pixels; frames of ${STUDY.mesh}, ${STUDY.size.join(" × ")}.`;
  $("#lights-sub").textContent = `A span of ${grouped(STUDY.span)} pixels, ns a pixel; less is better. Bars: middle half of the samples.`;
  if (!$("#corner-mode").children.length) segments($("#corner-mode"), [["same", "Same picture"], ["all", "All"]], () => cornerMode, k => { cornerMode = k; corners(); lights(); });
  corners();
  lights();
 }
 if (D.scaling) {
  const G = D.scaling, at = G.at;
  grow("#grow-triangles", p => !p.away && p.size.join() === at.join(), p => p.triangles, `triangles, at ${at.join(" × ")}`);
  grow("#grow-pixels", p => !p.away && p.asked === G.of, p => p.pixels, `covered pixels, about ${grouped(G.of)} triangles`);
  costs();
 }
 if (DOCS.length > 1) beside();
}

/* ---------- lectures */
const SIGN = { confirms: "✓", contradicts: "✗", adds: "+" };
const figurePictures = () => memo("figures", () => JSON.parse($("#figure-pictures").textContent));
const chip = (k, t) => `<span class="chip ${k}">${SIGN[k]} ${t}</span>`;
const chips = (f, named) => `<span class="chips">${VERDICTS.map(k => [k, f.findings.filter(x => x.agreement === k).length]).filter(q => q[1]).map(([k, n]) => chip(k, n + (named ? " " + k : ""))).join("")}</span>`;
function findingValue(x) {
 const size = Math.abs(x.value), power = size !== 0 && (size < .001 || size >= 1e6);
 const shown = power ? (([m, e]) => `${m}·10<sup>${+e}</sup>`.replace("-", "−"))(x.value.toExponential(1).split("e")) : String(+x.value.toPrecision(4));
 return shown + (x.unit ? " " + esc(x.unit) : "");
}
const where = f => `<a href="#lectures/${f.name}">${esc(f.title.split(":")[0])}</a><span class="where">${esc(f.lecture)}</span>`;
const findingTable = (list, named) => `<div class="scroll" tabindex="0" role="region" aria-label="Findings"><table class="data flist"><thead><tr>${named ? '<th scope="col">where</th>' : ""}<th scope="col">measured</th><th scope="col">value</th><th scope="col">verdict</th><th scope="col">in words</th></tr></thead><tbody>${list.map(x => `<tr>${named ? `<td>${where(x.f)}</td>` : ""}<td>${esc(x.label)}</td><td class="num" title="${x.value}">${findingValue(x)}</td><td>${chip(x.agreement, x.agreement)}</td><td>${esc(x.verdict)}</td></tr>`).join("")}</tbody></table></div>`;
function wrongTable() {
 const wrong = FINDINGS.filter(x => x.agreement === "contradicts");
 return `<p class="answer2">${wrong.length} measurements disagree with what is printed, most under conditions that the text does not name.</p><div class="scroll" tabindex="0" role="region" aria-label="Where the lectures are wrong"><table class="data flist"><thead><tr><th scope="col">the lecture</th><th scope="col">what it turns out to be</th><th scope="col">measured</th><th scope="col">value</th></tr></thead><tbody>${wrong.map((x, i) => { const n = wrong.filter(o => o.f === x.f).length; return `<tr>${wrong[i - 1]?.f === x.f ? "" : `<td rowspan="${n}">${where(x.f)}</td>`}<td>${esc(x.verdict)}</td><td>${esc(x.label)}</td><td class="num">${findingValue(x)}</td></tr>`; }).join("")}</tbody></table></div>`;
}
/* Curves over one another; labels at their ends, or below where there is no room. */
function plotSVG(p, W, small) {
 const series = p.series.map(s => ({ ...s, points: s.points.filter(([x, y]) => x != null && y != null && isFinite(x) && isFinite(y)) })), H = small ? 112 : 300, l = small ? 4 : 52, r = small ? 4 : 12, t = small ? 6 : 22, b = small ? 6 : 42;
 const axis = (values, [, scale], from, to) => {
  let v = values.filter(isFinite);
  const log = scale === "log";
  if (log) v = v.filter(q => q > 0);
  if (!v.length) v = [1, 2];
  let [a, z] = [Math.min(...v), Math.max(...v)];
  if (a === z) [a, z] = log ? [a / 2, z * 2] : [a - .5, z + .5];
  const f = log ? logs(a, z, from, to) : lin(a, z, from, to);
  return { f: q => clamp(f(log ? Math.max(q, a) : q), Math.min(from, to), Math.max(from, to)), ticks: log ? logTicks(a, z, 6) : linTicks(a, z, 6) };
 };
 const all = series.flatMap(s => s.points), x = axis(all.map(q => q[0]).concat(p.marks), p.x, l, W - r), y = axis(all.map(q => q[1]), p.y, H - b, t);
 const DASH = ["", "7 3", "2 2", "9 3 2 3", "4 4", "1 3"], colour = i => ["var(--base)", "var(--h3)", "var(--h2)", "var(--h4)", "var(--h1)", "var(--h5)"][i % 6];
 let o = "";
 if (!small) {
  for (const g of y.ticks) o += line(l, y.f(g), W - r, y.f(g)) + text(l - 6, y.f(g) + 4, tickText(g), `class="t" ${END}`);
  for (const g of x.ticks) o += text(x.f(g), H - b + 17, tickText(g), `class="t" ${MID}`);
  o += text((l + W - r) / 2, H - 6, esc(p.x[0]), `class="ax" ${MID}`) + text(2, 12, esc(p.y[0]), 'class="ax"');
 }
 for (const m of p.marks) o += line(x.f(m), t, x.f(m), H - b, 'stroke="var(--ink3)" stroke-dasharray="2 3"');
 series.forEach((s, i) => { o += `<path d="M${s.points.map(q => x.f(q[0]).toFixed(1) + " " + y.f(q[1]).toFixed(1)).join("L")}" fill="none" stroke="${colour(i)}" stroke-width="${small ? 1.5 : 1.75}"${DASH[i % 6] ? ` stroke-dasharray="${DASH[i % 6]}"` : ""}/>`; });
 const legend = small ? "" : `<div class="legend">${series.map((s, i) => `<span><svg width="26" height="8" aria-hidden="true">${line(0, 4, 26, 4, `stroke="${colour(i)}" stroke-width="2"${DASH[i % 6] ? ` stroke-dasharray="${DASH[i % 6]}"` : ""}`)}</svg> ${esc(s.label)}</span>`).join("")}</div>`;
 return SVG(W, H, o, `${p.title}: ${p.series.map(s => s.label).join(", ")}`) + legend;
}
function figureBody(f) {
 const files = [...figurePictures()[FIGURES.indexOf(f)] ?? []];
 const block = ([kind, b]) => {
  if (kind === "text") return `<p>${esc(b)}</p>`;
  if (kind === "table") return `<div class="plain scroll" tabindex="0" role="region" aria-label="${esc(f.title)}"><table><thead><tr>${b.head.map(h => `<th scope="col">${esc(h)}</th>`).join("")}</tr></thead><tbody>${b.rows.map(r => `<tr>${r.map((c, i) => i ? `<td>${esc(c)}</td>` : `<th scope="row">${esc(c)}</th>`).join("")}</tr>`).join("")}</tbody></table></div>`;
  if (kind === "plot") return `<figure class="plot"><h4>${esc(b.title)}</h4><div class="chartbox" data-plot="${f.blocks.findIndex(q => q.plot === b)}"></div><figcaption>${esc(b.caption)}</figcaption></figure>`;
  return `<div class="shown" style="--columns:${clamp(b.columns, 1, 6)};--widest:1fr">${b.shown.map(p => `<figure><img src="${files.shift() ?? ""}" alt="${esc(p.alt)}"><figcaption>${esc(p.caption)}</figcaption></figure>`).join("")}</div>`;
 };
 let html = "", plots = "";
 const flush = () => { if (plots) html += `<div class="plots">${plots}</div>`; plots = ""; };
 for (const b of f.blocks.map(b => Object.entries(b)[0])) { if (b[0] === "plot") plots += block(b); else { flush(); html += block(b); } }
 flush();
 return html;
}
function lectures([sub]) {
 const body = $("#lecture-body"), tabs = [["", plural(FIGURES.length, "figure")], ["wrong", "Where the lectures are wrong"], ["all", `All ${FINDINGS.length} findings`]], tab = ["wrong", "all"].includes(sub) ? sub : "";
 if (!FIGURES.length) { body.innerHTML = '<p class="answer2">No figures are in this report (<code>--figures all</code>).</p>'; return; }
 segments($("#lecture-tabs"), tabs, () => sub && !tab ? null : tab, k => go("lectures" + (k ? "/" + k : "")));
 const f = FIGURES.find(q => q.name === sub) ?? (FIGURES.length === 1 ? FIGURES[0] : null);
 if (tab === "wrong") body.innerHTML = wrongTable();
 else if (tab === "all") body.innerHTML = findingTable(FINDINGS, true);
 else if (!f) {
  body.innerHTML = `<div class="gal">${FIGURES.map(q => `<a class="fcard" href="#lectures/${q.name}"><span class="th"></span><span class="tx"><b>${esc(q.title)}</b><small>${esc(q.lecture)}</small>${chips(q)}</span></a>`).join("")}</div>`;
  $$(".fcard", body).forEach((c, i) => {
   const th = $(".th", c), plot = FIGURES[i].blocks.find(b => b.plot)?.plot, shown = FIGURES[i].blocks.flatMap(b => b.pictures?.shown ?? []), files = figurePictures()[i] ?? [];
   if (!files.length) { th.classList.add("fig"); th.innerHTML = plot ? plotSVG(plot, 260, true) : ""; return; }
   files.slice(0, 3).forEach((src, n) => { const img = new Image(); img.alt = shown[n]?.alt ?? ""; img.src = src; img.decoding = "async"; th.append(img); });
   const first = $("img", th);
   first.decode().then(() => { const a = first.naturalWidth / first.naturalHeight, n = Math.min(files.length, 3); th.style.gridTemplateColumns = a > 3 ? "1fr" : `repeat(${n},1fr)`; if (first.naturalWidth < 60 && a > 4.5 && plot) { th.classList.add("fig"); th.innerHTML = plotSVG(plot, 260, true); } }).catch(() => {});
  });
 } else {
  body.innerHTML = `<div class="md">${FIGURES.length > 1 ? `<nav class="list" aria-label="Figures">${FIGURES.map(q => `<a href="#lectures/${q.name}"${q === f ? ' aria-current="true"' : ""}><span>${esc(q.title.split(":")[0])}</span>${q.findings.some(x => x.agreement === "contradicts") ? '<span class="chip contradicts" title="contradicts">✗</span>' : ""}</a>`).join("")}</nav>` : ""}<article class="fig"><h2 class="ft">${esc(f.title)}</h2><p class="facts">${esc(f.lecture)}</p>${chips(f, true)}<div class="body">${figureBody(f)}</div><h3>Findings</h3>${findingTable(f.findings)}</article></div>`;
  const current = $(".list [aria-current]", body);
  if (current) current.parentElement.scrollTop = current.offsetTop - current.parentElement.offsetTop - 120;
  plots(f);
 }
}
function plots(f) {
 $$("[data-plot]").forEach(el => { el.innerHTML = plotSVG(f.blocks[el.dataset.plot].plot, Math.round(el.clientWidth) || 460); });
}

/* ---------- how measured */
const command = D.command_line.map(w => /^[\w\-./:=,+@%]+$/.test(w) ? w : `'${w.replace(/'/g, "'\\''")}'`).join(" ");
function measured() {
 const el = $("#rounds"), W = Math.round(el.clientWidth) || 500, ms = chosen(4), widths = ms.map(m => clamp(10 + 14 / (M[m].speed ?? 1), 10, 40)), total = 3 * (sum(widths) + 6) + 40, k = (W - 6) / total;
 let o = "", x = 0;
 if (ms.length > 1) {
  for (let round = 0; round < 3; round++) {
   o += text(x * k, 12, `round ${round + 1}`, 'class="t"');
   const order = ms.map((_, i) => (i + (round >> 1)) % ms.length);
   for (const i of round & 1 ? order.reverse() : order) { o += `<rect x="${x * k}" y="20" width="${Math.max(1, widths[i] * k - 2)}" height="20" rx="3" fill="${hue(ms[i])}"><title>${esc(nm(ms[i]))}</title></rect>`; x += widths[i]; }
   x += 6;
  }
  el.innerHTML = SVG(W, 48, o + text(x * k, 34, "… at least 5", 'class="t"'), "Rounds: the methods take turns");
 }
 const rounds = SCENES.flatMap(s => Object.values(s.rows).map(q => q.rounds)).filter(Boolean), m = D.machine, scene = SCENES[0];
 const rows = [["processor", m.cpu], ["logical processors", m.cores], ["system", `${m.os} ${m.arch}`], ["compiled by", `${m.rustc}, ${m.profile}, opt-level ${m.opt_level}`], ["for", m.target_features.join(", ")], ["fastphong", m.version + (m.commit ? `, commit ${m.commit}` : "")], ["date", D.date], ["whole run", D.seconds && `${num(D.seconds)} s`], ["rounds", rounds.length && `${Math.min(...rounds)} to ${Math.max(...rounds)} of every method in a scene`], ["drawn by", scene && `the ${scene.renderer.engine} engine, ${scene.renderer.level}, ${plural(scene.renderer.threads, "thread")}`], ["command", `<code>${esc(command)}</code>`]];
 $("#machine").innerHTML = rows.filter(r => r[1]).map(([t, v]) => `<dt>${t}</dt><dd class="over-v">${t === "command" ? v : esc(v)}</dd>`).join("") + (D.beside || []).map((d, i) => `<dt>beside it, ${i + 1}</dt><dd>${esc(d.machine.cpu)}, ${esc(d.machine.os)} ${esc(d.machine.arch)}; ${esc(d.machine.rustc)}; fastphong ${esc(d.machine.version)}${d.machine.commit ? ", " + esc(d.machine.commit) : ""}</dd>`).join("");
 $("#timed").textContent = `Timed: ${D.timed}. Compared: ${D.compared}.`;
 const spreads = SCENES.flatMap(s => Object.values(s.rows)).filter(q => q.p75).map(q => (q.p75 - q.p25) / q.ms).sort(by(v => v)), typical = spreads[spreads.length >> 1];
 const bias = [
  m.profile !== "release" && "<b>Built without optimisation: the times say nothing of the methods.</b>",
  !TIMED && "No times were taken: this report tells of errors only.",
  typical != null && `The middle half of the samples of a time typically spreads over ${num(typical * 100, 2)} % of it${typical > .1 ? ": the machine was busy with other things, and what intervals cannot tell apart should be measured again on a quiet one" : ""}.`,
  TIMED && `Scenes are drawn and timed at the size that is shown${MANY ? "; the first three were given more rounds than the others" : ""}.`,
  SCENES.some(s => Object.values(s.rows).some(q => q.other)) && "Pixels at which a method shows another polygon than the reference are counted and left out of its error: their colours tell of depth, not of shading.",
  SCENES.some(s => s.encoding === "srgb") && "Scenes stored as sRGB are compared in linear light; their pictures are shown as stored.",
  D.scaling && "Growth is explained by least times, since points cannot be timed in turns with one another; all else by medians.",
 ];
 $("#bias").innerHTML = bias.filter(Boolean).map(t => `<p class="bias-q">${t}</p>`).join("");
 $("#again").textContent = [command, ...(scene ? [`fastphong compare ${/^[\w\-./:=,+@%?&]+$/.test(scene.name) ? scene.name : `'${scene.name}'`} --size ${scene.w}x${scene.h}`] : []), `fastphong explain ${BEST ?? BASE}`].join("\n");
 const stem = "fastphong-report";
 $("#get-json").onclick = () => save(stem + ".json", $("#fastphong-data").textContent, "application/json");
 $("#get-csv").onclick = () => save(stem + ".csv", csv([["scene", "method", "engine", "max, levels", "rms, levels", "p99, levels", "pixels over 1 level", "psnr, dB", "ssim", "ms", "ns a pixel", "speed", "low", "high"], ...SCENES.flatMap(s => Object.values(s.rows).map(q => [s.name, q.variant, q.bary ? BARY : s.renderer.engine, q.max, q.rms, q.p99, q.over1, q.psnr, q.ssim, q.ms, q.ns, ...(q.ratio ?? []).slice(0, 3)]))]), "text/csv");
 $("#get-findings").onclick = () => save("fastphong-findings.csv", csv([["figure", "key", "label", "value", "unit", "agreement", "verdict"], ...FINDINGS.map(x => [x.f.name, x.key, x.label, x.value, x.unit, x.agreement, x.verdict])]), "text/csv");
 $("#get-findings").hidden = !FINDINGS.length;
 $("#get-csv").hidden = !SCENES.length;
}

/* ---------- routes: #view/part?left=…&right=…&mode=…&x=…&y=…&zoom=…&row=… */
const VIEWS = { overview, scenes, methods, speed, lectures, measured }, TITLES = { overview: "", scenes: "Scenes", methods: "Methods", speed: "Speed", lectures: "Lectures", measured: "How measured" };
let current = "", remembering, restoring = true;
const go = h => { clearTimeout(remembering); location.hash = h; };
/* What an address says of a viewer. */
function fromRoute(q, v) {
 const o = {}, whole = k => q.has(k) && isFinite(q.get(k)) ? Math.floor(+q.get(k)) : null;
 if (q.get("scene") && S[q.get("scene")]) o.scene = S[q.get("scene")];
 if (q.has("left")) o.a = q.get("left");
 if (q.has("right")) o.b = q.get("right");
 if (MODES.some(m => m[0] === q.get("mode"))) o.mode = q.get("mode");
 else if (q.has("left") || q.has("right")) o.mode = "slide";
 if (q.has("scale")) o.top = +q.get("scale") || 0;
 const s = o.scene ?? v.scene, [x, y] = [whole("x"), whole("y")];
 if (x != null && y != null) { o.pin = [clamp(x, 0, s.w - 1), clamp(y, 0, s.h - 1)]; o.z = clamp(+q.get("zoom") || 1, 1, 32); [o.cx, o.cy] = [(o.pin[0] + .5) / s.w, (o.pin[1] + .5) / s.h]; }
 if (v.row && q.has("row")) o.line = clamp(whole("row") ?? 0, 0, s.h - 1);
 return o;
}
/* Keeps the address in step with a viewer, so that a link shows what its sender saw. */
function remember(v) {
 if (restoring) return;
 clearTimeout(remembering);
 remembering = setTimeout(() => {
  if (current !== (v === v1 ? "overview" : "scenes")) return;
  const q = new URLSearchParams(), s = v.scene;
  if (v === v1 && s !== SCENES[0]) q.set("scene", s.id);
  q.set("left", v.a);
  q.set("right", v.b);
  if (v.mode !== "slide") q.set("mode", v.mode);
  if (v.top) q.set("scale", v.top);
  if (v.pin) { q.set("x", v.pin[0]); q.set("y", v.pin[1]); if (v.z > 1) q.set("zoom", +v.z.toFixed(1)); }
  if (v.line != null) q.set("row", v.line);
  history.replaceState(null, "", `#${v === v1 ? "overview" : "scenes/" + s.id}?${q}`);
 }, 60);
}
function route(e) {
 clearTimeout(remembering);
 const [path, query] = (e?.newURL ? new URL(e.newURL) : location).hash.slice(1).split("?"), [v, ...parts] = path.split("/").map(decodeURIComponent), name = VIEWS[v] ? v : "overview", changed = name !== current;
 current = name;
 restoring = true;
 $$(".view").forEach(s => s.classList.toggle("on", s.id === name));
 $$(".top nav a").forEach(a => {
  const on = a.hash === "#" + name;
  if (on) a.setAttribute("aria-current", "page"); else a.removeAttribute("aria-current");
  if (on && changed) a.scrollIntoView({ block: "nearest", inline: "center" });
 });
 if (changed || name === "lectures") scrollTo(0, 0);
 VIEWS[name](parts.filter(Boolean), new URLSearchParams(query ?? ""));
 restoring = false;
 document.title = `${TITLES[name] ? TITLES[name] + " · " : ""}fastphong: Phong shading, measured`;
}
function redraw() {
 if (current === "overview" && v1) { pareto(v1); strip(); }
 if (current === "speed") speed();
 if (current === "measured") measured();
 if (current === "scenes" && v2) rowPlot(v2);
 if (current === "lectures") { const f = FIGURES.find(q => location.hash.endsWith("/" + q.name)) ?? FIGURES[0]; if (f && $("[data-plot]")) plots(f); }
}
addEventListener("hashchange", route);
let resizing;
addEventListener("resize", () => { clearTimeout(resizing); resizing = setTimeout(redraw, 120); });
addEventListener("keydown", e => {
 if (e.ctrlKey || e.metaKey || e.altKey || /^(SELECT|INPUT|TEXTAREA)$/.test(e.target.tagName) || $("#keys").open) return;
 if (e.key === "?") { $("#keys").showModal(); return; }
 const v = current === "overview" ? v1 : current === "scenes" ? v2 : null;
 if (!v) return;
 if (current === "scenes" && (e.key === "[" || e.key === "]")) { step(e.key === "]" ? 1 : -1); return; }
 if (e.key === " " && e.target.closest("button,a,summary,.hit")) return;
 if (/^Arrow/.test(e.key) && e.target.closest(".scroll,.rail,nav")) return;
 if (v.key(e)) e.preventDefault();
});
$("#help").onclick = () => $("#keys").showModal();
$("#theme").onclick = () => {
 const r = document.documentElement, dark = r.dataset.theme ? r.dataset.theme === "dark" : matchMedia("(prefers-color-scheme:dark)").matches;
 r.dataset.theme = dark ? "light" : "dark";
 try { localStorage.setItem("fastphong-theme", r.dataset.theme); } catch { /* a file opened from disk may have no storage */ }
};
$("#big").onclick = e => { e.currentTarget.setAttribute("aria-pressed", document.documentElement.toggleAttribute("data-big")); redraw(); };
$$(".answer .m").forEach(a => a.style.setProperty("--c", hue(a.dataset.m)));
$$(".top nav a").forEach(a => {
 const has = { "#scenes": SCENES.length, "#methods": IDS.length, "#speed": STUDY || D.scaling || DOCS.length > 1, "#lectures": FIGURES.length, "#overview": SCENES.length || FIGURES.length > 1 }[a.hash];
 a.hidden = has !== undefined && !has;
});
addEventListener("beforeprint", () => {
 $$(".view").forEach(s => s.classList.add("on"));
 const none = new URLSearchParams();
 if (SCENES.length) { overview([], none); if (!v2) scenes([], none); methods([]); }
 speed();
 if (!$("#lecture-body").children.length) lectures([]);
 measured();
});
addEventListener("afterprint", () => { current = ""; route(); });
if (!SCENES.length && FIGURES.length === 1 && !location.hash) history.replaceState(null, "", "#lectures/" + FIGURES[0].name);
route();
