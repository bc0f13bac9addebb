"use strict";
// One viewer a scene: a large picture, all pictures zoomed alike, and the pixel under the cursor in all of them.
// The page says all it has to say without this.

const ZOOMS = [1, 2, 3, 4, 6, 8, 12, 16, 24, 32];
const SHOWS = ["method", "reference", "map"];
const scenes = [];

class Viewer {
  constructor(section) {
    this.section = section;
    this.id = section.id.replace(/^scene-/, "");
    const [reference, ...methods] = section.querySelectorAll(".pictures > figure");
    this.reference = pictureOf(reference);
    this.methods = methods.map(pictureOf);
    if (this.methods.length === 0) throw new Error("nothing to show");
    // The attributes: the properties tell how large it stands on the page.
    this.width = Number(this.reference.picture.getAttribute("width"));
    this.height = Number(this.reference.picture.getAttribute("height"));
    this.chosen = 0;
    this.show = "method";
    this.zoom = 1;
    this.left = 0; // The first texel column that is seen, and the first row.
    this.top = 0;
    this.pixel = null;
    this.build();
    this.choose(Math.max(0, this.methods.findIndex((method) => method.name === "fast-phong")));
  }

  build() {
    const stage = element("div", { className: "pane stage", tabIndex: 0 });
    stage.setAttribute("role", "application");
    stage.setAttribute("aria-label", "Picture viewer. Press ? for its keys.");
    stage.style.aspectRatio = `${this.width} / ${this.height}`;
    this.images = Object.fromEntries(SHOWS.map((show) => [show, stage.appendChild(element("img", { alt: "" }))]));
    this.images.reference.src = this.reference.picture.src;
    this.marker = stage.appendChild(element("span", { className: "marker", hidden: true }));
    this.label = stage.appendChild(element("span", { className: "label" }));
    const controls = element("div", { className: "controls" });
    this.buttons = this.methods.map((method, i) => {
      const key = i < 9 ? element("kbd", { textContent: String(i + 1) }) : "";
      return this.button(controls, [key, " ", method.name], () => this.choose(i));
    });
    this.flickerButton = this.button(controls, [element("kbd", { textContent: "space" }), " reference"], () => this.flicker());
    this.mapButton = this.button(controls, [element("kbd", { textContent: "d" }), " difference"], () => this.toggleMap());
    this.button(controls, ["−"], () => this.step(-1)).setAttribute("aria-label", "Zoom out");
    this.zoomText = controls.appendChild(element("output", { textContent: "1×" }));
    this.button(controls, ["+"], () => this.step(1)).setAttribute("aria-label", "Zoom in");
    button(controls, [element("kbd", { textContent: "?" }), " keys"], help);
    this.readout = element("div", { className: "readout" });
    const viewer = element("div", { className: "viewer" });
    viewer.append(stage, controls, this.readout);
    this.section.querySelector(".pictures").before(viewer);
    this.stage = stage;
    this.methods.forEach((method, i) => method.figure.addEventListener("click", () => this.choose(i)));
    this.reference.figure.addEventListener("click", () => this.showing("reference"));
    for (const pane of this.section.querySelectorAll(".pane")) {
      pane.addEventListener("pointermove", (event) => this.point(pane, event));
    }
    this.listenToDrags(stage);
    this.fillReadout();
  }

  /** A button after whose click keys go to the picture again; one that is pressed by keys keeps them. */
  button(parent, content, action) {
    return button(parent, content, (event) => {
      action();
      if (event.detail > 0) this.stage.focus({ preventScroll: true });
    });
  }

  listenToDrags(stage) {
    let from = null;
    stage.addEventListener("pointerdown", (event) => {
      if (this.zoom === 1 || event.button !== 0) return;
      from = { x: event.clientX, y: event.clientY, left: this.left, top: this.top };
      stage.setPointerCapture(event.pointerId);
    });
    stage.addEventListener("pointermove", (event) => {
      if (!from) return;
      const texel = (stage.clientWidth / this.width) * this.zoom;
      this.look(from.left - (event.clientX - from.x) / texel, from.top - (event.clientY - from.y) / texel);
    });
    for (const end of ["pointerup", "pointercancel"]) stage.addEventListener(end, () => (from = null));
  }

  /** Shows method `i` large. */
  choose(i) {
    if (i >= this.methods.length) return;
    this.chosen = i;
    const { picture, map } = this.methods[i];
    this.images.method.src = picture.src;
    this.images.method.classList.toggle("over", picture.classList.contains("over"));
    this.images.map.src = map.src;
    if (this.show === "reference") this.show = "method";
    this.update();
  }

  showing(show) {
    this.show = show;
    this.update();
  }

  flicker() {
    this.showing(this.show === "reference" ? "method" : "reference");
  }

  toggleMap() {
    this.showing(this.show === "map" ? "method" : "map");
  }

  step(by) {
    this.setZoom(ZOOMS[ZOOMS.indexOf(this.zoom) + by] ?? this.zoom);
  }

  /** Zooms and leaves the marked texel where it stands; without one, the middle. */
  setZoom(zoom) {
    const seen = { x: this.width / this.zoom, y: this.height / this.zoom };
    const at = this.pixel ?? { x: this.left + seen.x / 2, y: this.top + seen.y / 2 };
    const keep = { x: (at.x - this.left) / seen.x, y: (at.y - this.top) / seen.y };
    this.zoom = zoom;
    this.look(at.x - (keep.x * this.width) / zoom, at.y - (keep.y * this.height) / zoom);
  }

  /** Moves the corner of what is seen, by whole texels and within the picture. */
  look(left, top) {
    const clamp = (value, size) => Math.round(Math.min(Math.max(value, 0), size - size / this.zoom));
    this.left = clamp(left, this.width);
    this.top = clamp(top, this.height);
    this.update();
  }

  /** The texel under the pointer, in whichever picture it is. */
  point(pane, event) {
    const box = pane.getBoundingClientRect();
    const x = this.left + ((event.clientX - box.left) / box.width) * (this.width / this.zoom);
    const y = this.top + ((event.clientY - box.top) / box.height) * (this.height / this.zoom);
    this.mark(Math.floor(x), Math.floor(y));
  }

  /** Marks a texel, and moves what is seen so that it is seen. */
  mark(x, y) {
    this.pixel = { x: Math.min(Math.max(x, 0), this.width - 1), y: Math.min(Math.max(y, 0), this.height - 1) };
    const follow = (at, from, size) => Math.min(Math.max(from, at + 1 - Math.floor(size / this.zoom)), at);
    this.look(follow(this.pixel.x, this.left, this.width), follow(this.pixel.y, this.top, this.height));
    this.fillReadout();
  }

  moveMark(dx, dy) {
    const seen = { x: this.width / this.zoom, y: this.height / this.zoom };
    const from = this.pixel ?? { x: Math.floor(this.left + seen.x / 2), y: Math.floor(this.top + seen.y / 2) };
    this.mark(from.x + dx, from.y + dy);
  }

  update() {
    const method = this.methods[this.chosen];
    const { style, classList } = this.section;
    style.setProperty("--zoom", this.zoom);
    style.setProperty("--left", `${(-100 * this.left * this.zoom) / this.width}%`);
    style.setProperty("--top", `${(-100 * this.top * this.zoom) / this.height}%`);
    classList.toggle("zoomed", this.zoom > 1);
    for (const show of SHOWS) this.images[show].classList.toggle("shown", show === this.show);
    const said = { method: method.name, reference: "reference", map: `${method.name}: difference from the reference` };
    this.label.textContent = said[this.show];
    this.images[this.show].alt = said[this.show];
    this.buttons.forEach((b, i) => b.setAttribute("aria-pressed", String(i === this.chosen)));
    this.methods.forEach((m, i) => m.figure.classList.toggle("chosen", i === this.chosen));
    this.flickerButton.setAttribute("aria-pressed", String(this.show === "reference"));
    this.mapButton.setAttribute("aria-pressed", String(this.show === "map"));
    this.zoomText.textContent = `${this.zoom}×`;
    [...this.readout.querySelectorAll("tbody tr")].forEach((row, i) => row.classList.toggle("chosen", i === this.chosen + 1));
    this.placeMarker();
    remember(this);
  }

  placeMarker() {
    this.marker.hidden = this.pixel === null;
    if (this.pixel === null) return;
    const percent = (value, from, size) => `${(100 * (value - from) * this.zoom) / size}%`;
    this.marker.style.left = percent(this.pixel.x, this.left, this.width);
    this.marker.style.top = percent(this.pixel.y, this.top, this.height);
    this.marker.style.width = `${(100 * this.zoom) / this.width}%`;
    this.marker.style.height = `${(100 * this.zoom) / this.height}%`;
  }

  /** The colours of the marked texel in all pictures, and their differences from the reference as stored. */
  fillReadout() {
    if (this.pixel === null) {
      const hint = "Point at a picture, or press the arrow keys on the large one, to read a pixel in all of them.";
      this.readout.replaceChildren(element("p", { textContent: hint }));
      return;
    }
    const { x, y } = this.pixel;
    const below = texels(this.reference);
    const at = 4 * (y * this.width + x);
    const colour = (data) => [data[at], data[at + 1], data[at + 2]];
    const base = colour(below);
    const rows = [this.reference, ...this.methods].map((shown, i) => {
      const rgb = colour(texels(shown, this.reference));
      const off = Math.max(...rgb.map((c, k) => Math.abs(c - base[k])));
      const row = element("tr", { className: i === this.chosen + 1 ? "chosen" : "" });
      const swatch = element("span", { className: "swatch" });
      swatch.style.background = `rgb(${rgb})`;
      row.append(element("th", { textContent: shown.name, scope: "row" }), cell(swatch), ...rgb.map(cell));
      row.append(cell(i === 0 ? "" : off));
      return row;
    });
    const head = element("tr");
    head.append(...["", "", "R", "G", "B", "off by"].map((text) => element("th", { textContent: text, scope: "col" })));
    const table = element("table");
    table.createTHead().append(head);
    table.createTBody().append(...rows);
    const place = element("p", { textContent: `Column ${x}, row ${y}; levels as stored` });
    this.readout.replaceChildren(place, table);
  }

  key(event) {
    const { key } = event;
    const by = event.shiftKey ? 10 : 1;
    const arrows = { ArrowLeft: [-by, 0], ArrowRight: [by, 0], ArrowUp: [0, -by], ArrowDown: [0, by] };
    const inside = this.stage === document.activeElement;
    if (/^[1-9]$/.test(key)) this.choose(Number(key) - 1);
    else if (key === "0") this.showing("reference");
    else if (key === " " && isInView(this.stage)) this.flicker();
    else if (key === "d") this.toggleMap();
    else if (key === "+" || key === "=") this.step(1);
    else if (key === "-") this.step(-1);
    else if (key === "Escape") this.setZoom(1);
    else if (inside && key in arrows) this.moveMark(...arrows[key]);
    else return false;
    return true;
  }
}

/** A figure of the page: its name, its picture, its difference map. */
function pictureOf(figure) {
  const [picture, map] = figure.querySelectorAll("img");
  return { figure, name: figure.dataset.name, picture, map, texels: null };
}

/** The colours of a picture, with the reference below it where it holds only what differs. */
function texels(shown, reference) {
  if (shown.texels === null) {
    const { picture } = shown;
    const canvas = element("canvas", { width: picture.naturalWidth, height: picture.naturalHeight });
    const context = canvas.getContext("2d", { willReadFrequently: true });
    if (picture.classList.contains("over")) context.drawImage(reference.picture, 0, 0);
    context.drawImage(picture, 0, 0);
    shown.texels = context.getImageData(0, 0, canvas.width, canvas.height).data;
  }
  return shown.texels;
}

function element(name, properties = {}) {
  return Object.assign(document.createElement(name), properties);
}

function cell(content) {
  const td = element("td");
  td.append(content);
  return td;
}

function button(parent, content, action) {
  const made = element("button", { type: "button" });
  made.append(...content);
  made.addEventListener("click", action);
  return parent.appendChild(made);
}

function isInView(shown) {
  const box = shown.getBoundingClientRect();
  return box.bottom > 0 && box.top < innerHeight;
}

/** The scene that keys are meant for: the one with the focus, else the one whose viewer is nearest to the middle. */
function current() {
  const focused = scenes.find((scene) => scene.section.contains(document.activeElement));
  if (focused) return focused;
  const distance = (scene) => {
    const box = scene.stage.getBoundingClientRect();
    return Math.abs((box.top + box.bottom) / 2 - innerHeight / 2);
  };
  return scenes.reduce((best, scene) => (best && distance(best) <= distance(scene) ? best : scene), null);
}

function go(by) {
  const next = scenes[scenes.indexOf(current()) + by];
  if (!next) return;
  next.section.scrollIntoView();
  next.stage.focus({ preventScroll: true });
}

let starting = true;
let remembering = 0;

/** Keeps the state in the address, so that it can be passed on. Not more than browsers allow: they count. */
function remember(scene) {
  if (starting) return;
  clearTimeout(remembering);
  remembering = setTimeout(() => {
    const state = new URLSearchParams({ scene: scene.id, method: scene.methods[scene.chosen].name, show: scene.show });
    if (scene.zoom > 1) {
      state.set("zoom", scene.zoom);
      state.set("left", scene.left);
      state.set("top", scene.top);
    }
    try {
      history.replaceState(null, "", `#${state}`);
    } catch {
      // Some browsers refuse this for files; the state is then not kept.
    }
  }, 200);
}

/** Takes the state out of the address; other fragments are plain links. */
function recall() {
  const state = new URLSearchParams(location.hash.slice(1));
  const scene = scenes.find((s) => s.id === state.get("scene"));
  if (!scene) return;
  const method = scene.methods.findIndex((m) => m.name === state.get("method"));
  if (method >= 0) scene.choose(method);
  if (SHOWS.includes(state.get("show"))) scene.showing(state.get("show"));
  const zoom = Number(state.get("zoom"));
  if (ZOOMS.includes(zoom)) {
    scene.zoom = zoom;
    scene.look(Number(state.get("left")) || 0, Number(state.get("top")) || 0);
  }
  scene.section.scrollIntoView();
}

const KEYS = [
  ["1 … 9", "show a method large"],
  ["space", "flicker between method and reference"],
  ["0", "show the reference"],
  ["d", "show its difference from the reference"],
  ["+ −", "zoom all pictures of the scene"],
  ["arrows", "on the large picture: move the pixel that is read, with shift by ten"],
  ["drag", "move what is seen of zoomed pictures"],
  ["n p", "next scene, previous scene"],
  ["Esc", "zoom out"],
  ["?", "this help"],
];
let dialog = null;

function help() {
  if (dialog === null) {
    dialog = element("dialog");
    const list = element("dl");
    for (const [key, meaning] of KEYS) {
      const term = element("dt");
      term.append(element("kbd", { textContent: key }));
      list.append(term, element("dd", { textContent: meaning }));
    }
    dialog.append(element("h2", { textContent: "Keys" }), list);
    button(dialog, ["Close"], () => dialog.close());
    document.body.append(dialog);
  }
  if (dialog.open) dialog.close();
  else dialog.showModal();
}

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.key === "?") help();
  else if (dialog?.open) return;
  else if (event.key === "n") go(1);
  else if (event.key === "p") go(-1);
  else {
    const scene = current();
    // Links and buttons that were reached by keys keep their space.
    const isOthers = event.key === " " && document.activeElement.matches("a, button");
    if (!scene || isOthers || !scene.key(event)) return;
  }
  event.preventDefault();
});
for (const section of document.querySelectorAll("section.scene")) {
  try {
    scenes.push(new Viewer(section));
  } catch (error) {
    console.error(section.id, error);
  }
}
document.documentElement.classList.add("scripted");
recall();
starting = false;
addEventListener("hashchange", recall);
