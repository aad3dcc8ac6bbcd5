// The mechanism with its modes and forced vibrations: a small picture of each to choose from, and a large one that moves and can be turned.

const SECONDS = 2;
// Milliseconds for small pictures at a time.
const PAINTING = 8;
// Milliseconds without another machine after which the small pictures follow.
const STILL = 120;
const whenIdle = (act) => (window.requestIdleCallback ? requestIdleCallback(act, { timeout: 200 }) : setTimeout(act, 20));
const VIEWS = [["oblique", -0.9, 0.42], ["from the front", -Math.PI / 2, 0], ["from the side", 0, 0], ["from above", -Math.PI / 2, Math.PI / 2]];

// As another player shows it, if one is given: by that player itself where the same can be chosen.
function showMechanism({ scene, up, motions }, parent, before) {
  const model = new Model(scene, up);
  const states = [{ title: "Equilibrium", about: "", count: 1, frame: () => model.rest }, ...motions.map(stateOf)];
  if (!before?.offers(model, states)) return new Player(model, states, parent, before);
  before.follow(model, states, parent);
  return before;
}

// Poses are formed when they are first seen.
function stateOf({ title, about, frames }) {
  const poses = (numbers) => Array.from({ length: numbers.length / 12 }, (_, pose) => poseOf(numbers, 12 * pose));
  const seen = [];
  return { title, about, count: frames.length, frame: (phase) => (seen[phase] ??= poses(frames[phase])) };
}

class Player {
  constructor(model, states, parent, before) {
    Object.assign(this, { model, states, parent, chosen: 0, phase: 0, playing: false });
    this.large = htmlElement("canvas", {
      class: "view3d",
      tabindex: "0",
      role: "img",
      "aria-label": "The mechanism in space. Drag or use the arrow keys to turn it, plus and minus to zoom.",
    }, parent);
    this.painter = new Painter(this.large, model);
    this.about = htmlElement("p", { class: "about", role: "status" }, parent);
    this.controls(parent);
    this.gallery(parent);
    this.listen();
    if (before) this.resume(before);
    else this.show(0);
  }

  offers(model, states) {
    const names = (own) => Object.keys(own.upright).join();
    return states.length === this.states.length && names(model) === names(this.model);
  }

  // Shows another machine, at another place of the page.
  follow(model, states, parent) {
    parent.append(...this.parent.childNodes);
    Object.assign(this, { model, states, parent });
    this.painter.model = model;
    this.small.forEach(({ text, painter }, number) => {
      text.textContent = states[number].title;
      painter.model = model;
    });
    this.tell();
    this.paint();
    clearTimeout(this.later);
    this.later = setTimeout(() => this.paintGallery(), STILL);
  }

  controls(parent) {
    const bar = htmlElement("div", { class: "controls" }, parent);
    const button = (text, act) => {
      const made = htmlElement("button", { type: "button" }, bar, text);
      made.addEventListener("click", act);
      return made;
    };
    this.play = button("Play", () => this.setPlaying(!this.playing));
    const phase = htmlElement("label", {}, bar, "Phase ");
    this.slider = htmlElement("input", { type: "range", min: 0, max: 360, step: 1, value: 0 }, phase);
    this.slider.addEventListener("input", () => {
      this.setPlaying(false);
      this.phase = Number(this.slider.value) / 360;
      this.paint();
    });
    for (const [name, azimuth, elevation] of VIEWS) button(name[0].toUpperCase() + name.slice(1), () => this.look(azimuth, elevation));
    const up = htmlElement("label", {}, bar, "Up ");
    this.upwards = htmlElement("select", {}, up);
    for (const name of Object.keys(this.model.upright)) htmlElement("option", { value: name }, this.upwards, name);
    this.upwards.value = this.model.up;
    this.upwards.addEventListener("change", () => {
      this.painter.up = this.upwards.value;
      this.paint();
      this.paintGallery();
    });
    const names = htmlElement("label", {}, bar);
    this.named = htmlElement("input", { type: "checkbox" }, names);
    names.append(" Names");
    this.named.addEventListener("change", () => this.paint());
  }

  // Pictures of all states: they choose, and are what a printed page shows.
  gallery(parent) {
    const box = htmlElement("div", { class: "gallery", role: "group", "aria-label": "What is shown" }, parent);
    this.small = this.states.map((state, number) => {
      const button = htmlElement("button", { type: "button", "aria-pressed": "false" }, box);
      const canvas = htmlElement("canvas", { class: "small", "aria-hidden": "true" }, button);
      const text = htmlElement("span", {}, button, state.title);
      button.addEventListener("click", () => {
        this.show(number);
        this.paint();
      });
      return { button, text, painter: new Painter(canvas, this.model, false) };
    });
  }

  tell() {
    const { title, about } = this.states[this.chosen];
    this.about.textContent = about ? `${title}: ${about}` : title;
  }

  show(number) {
    this.chosen = number;
    this.phase = 0;
    this.tell();
    this.small.forEach(({ button }, k) => button.setAttribute("aria-pressed", String(k === number)));
    const moves = this.states[number].count > 1;
    this.play.disabled = !moves;
    this.slider.disabled = !moves;
    this.setPlaying(moves && !matchMedia("(prefers-reduced-motion: reduce)").matches);
  }

  // Shows what another player shows, as it shows it.
  resume({ painter, named, chosen, phase, playing }) {
    const { azimuth, elevation, zoom, up } = painter;
    if (up in this.model.upright) this.upwards.value = up;
    Object.assign(this.painter, { azimuth, elevation, zoom, up: this.upwards.value });
    this.named.checked = named.checked;
    this.show(Math.min(chosen, this.states.length - 1));
    this.phase = phase;
    if (!playing) this.setPlaying(false);
    this.slider.value = 360 * phase;
  }

  setPlaying(playing) {
    if (playing && !this.playing) {
      let last = null;
      const step = (now) => {
        if (!this.playing || !this.large.isConnected) return;
        this.phase = (this.phase + (now - (last ?? now)) / 1000 / SECONDS) % 1;
        last = now;
        this.slider.value = 360 * this.phase;
        this.paint();
        requestAnimationFrame(step);
      };
      requestAnimationFrame(step);
    }
    this.playing = playing;
    this.play.textContent = playing ? "Pause" : "Play";
  }

  // The poses of the chosen state at the phase.
  poses() {
    const { count, frame } = this.states[this.chosen];
    const place = this.phase * count;
    const first = Math.floor(place);
    const [before, after] = [frame(first % count), frame((first + 1) % count)];
    return before.map((pose, body) => between(pose, after[body], place - first));
  }

  paint() {
    this.painter.paint(this.poses(), { ghost: this.chosen > 0, names: this.named.checked });
  }

  // A few pictures at a time, where nothing else is to do: what is large moves on meanwhile, and a later call begins anew.
  paintGallery() {
    const states = [...this.states.keys()];
    const pass = (this.pass = () => {
      if (this.pass !== pass || !this.large.isConnected) return;
      const end = performance.now() + PAINTING;
      while (states.length > 0 && performance.now() < end) this.paintSmall(states.shift());
      if (states.length > 0) whenIdle(pass);
    });
    whenIdle(pass);
  }

  paintSmall(number) {
    const { painter } = this.small[number];
    Object.assign(painter, { azimuth: this.painter.azimuth, elevation: this.painter.elevation, up: this.painter.up });
    painter.paint(this.states[number].frame(0), { ghost: number > 0, triad: false });
  }

  look(azimuth, elevation) {
    Object.assign(this.painter, { azimuth, elevation: Math.max(-Math.PI / 2, Math.min(Math.PI / 2, elevation)) });
    this.paint();
    this.paintGallery();
  }

  zoom(factor) {
    this.painter.zoom = Math.max(0.2, Math.min(20, this.painter.zoom * factor));
    this.paint();
  }

  listen() {
    const { large, painter } = this;
    let last = null;
    large.addEventListener("pointerdown", (event) => {
      last = [event.clientX, event.clientY];
      large.setPointerCapture(event.pointerId);
    });
    large.addEventListener("pointermove", (event) => {
      if (!last) return;
      const [x, y] = [event.clientX - last[0], event.clientY - last[1]];
      last = [event.clientX, event.clientY];
      this.look(painter.azimuth - 0.008 * x, painter.elevation + 0.008 * y);
    });
    const end = () => (last = null);
    large.addEventListener("pointerup", end);
    large.addEventListener("pointercancel", end);
    large.addEventListener("wheel", (event) => {
      if (document.activeElement !== large) return;
      event.preventDefault();
      this.zoom(Math.exp(-0.0015 * event.deltaY));
    }, { passive: false });
    const keys = {
      ArrowLeft: () => this.look(painter.azimuth + 0.1, painter.elevation),
      ArrowRight: () => this.look(painter.azimuth - 0.1, painter.elevation),
      ArrowUp: () => this.look(painter.azimuth, painter.elevation + 0.1),
      ArrowDown: () => this.look(painter.azimuth, painter.elevation - 0.1),
      "+": () => this.zoom(1.2),
      "-": () => this.zoom(1 / 1.2),
      " ": () => this.play.click(),
    };
    large.addEventListener("keydown", (event) => {
      if (!keys[event.key]) return;
      keys[event.key]();
      event.preventDefault();
    });
    // The first call is the first painting.
    new ResizeObserver(() => {
      this.paint();
      this.paintGallery();
    }).observe(large);
  }
}
