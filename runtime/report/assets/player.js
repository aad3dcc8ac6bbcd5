// The mechanism with its modes and forced vibrations: a small picture of each to choose from, and a large one that moves and can be turned.

const SECONDS = 2;
// Milliseconds for small pictures at a time.
const PAINTING = 8;
const whenIdle = (act) => (window.requestIdleCallback ? requestIdleCallback(act, { timeout: 200 }) : setTimeout(act, 20));
const VIEWS = [["oblique", -0.9, 0.42], ["from the front", -Math.PI / 2, 0], ["from the side", 0, 0], ["from above", -Math.PI / 2, Math.PI / 2]];

// As another player shows it, if one is given.
function showMechanism({ scene, up, motions }, parent, before) {
  const model = new Model(scene, up);
  const states = [{ title: "Equilibrium", about: "", frames: [model.rest] }, ...motions.map(stateOf)];
  return new Player(model, states, parent, before);
}

function stateOf({ title, about, frames }) {
  const poses = (numbers) => Array.from({ length: numbers.length / 12 }, (_, pose) => poseOf(numbers, 12 * pose));
  return { title, about, frames: frames.map(poses) };
}

class Player {
  constructor(model, states, parent, before) {
    Object.assign(this, { model, states, chosen: 0, phase: 0, playing: false });
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
    else this.choose(0);
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
      htmlElement("span", {}, button, state.title);
      button.addEventListener("click", () => this.choose(number));
      return { button, painter: new Painter(canvas, this.model, this.model.coarse) };
    });
  }

  choose(number) {
    this.chosen = number;
    this.phase = 0;
    const { title, about, frames } = this.states[number];
    this.about.textContent = about ? `${title}: ${about}` : title;
    this.small.forEach(({ button }, k) => button.setAttribute("aria-pressed", String(k === number)));
    const moves = frames.length > 1;
    this.play.disabled = !moves;
    this.slider.disabled = !moves;
    this.setPlaying(moves && !matchMedia("(prefers-reduced-motion: reduce)").matches);
    this.paint();
    this.paintGallery();
  }

  // Shows what another player shows, as it shows it.
  resume({ painter, named, chosen, phase, playing }) {
    const { azimuth, elevation, zoom, up } = painter;
    if (up in this.model.upright) this.upwards.value = up;
    Object.assign(this.painter, { azimuth, elevation, zoom, up: this.upwards.value });
    this.named.checked = named.checked;
    this.choose(Math.min(chosen, this.states.length - 1));
    this.phase = phase;
    if (!playing) this.setPlaying(false);
    this.slider.value = 360 * phase;
    this.paint();
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
    const { frames } = this.states[this.chosen];
    const place = this.phase * frames.length;
    const [before, after] = [frames[Math.floor(place) % frames.length], frames[(Math.floor(place) + 1) % frames.length]];
    return before.map((pose, body) => between(pose, after[body], place - Math.floor(place)));
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
    painter.paint(this.states[number].frames[0], { ghost: number > 0, triad: false });
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
    new ResizeObserver(() => {
      this.paint();
      this.paintGallery();
    }).observe(large);
  }
}
