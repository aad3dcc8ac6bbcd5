// The page that answers while one edits. What it has set is in its address and nowhere else; each question carries all of it.

const KINDS = [["input", "Inputs", false], ["design", "Design variables", false], ["start", "Starts", true]];
const SECTIONS = ["brief", "modes", "along", "vibration", "shares", "verdicts", "equilibrium", "distributions", "mechanism"];
const OPEN = ["modes", "along", "vibration"];
// Milliseconds without a move after which the answers along an input are asked for, and the address follows.
const REST = 250;
// Controls beyond which one of them is looked for by its name.
const MANY = 12;
const SIMPLE = /^\s*(?:\+\/-)?\s*(\d+\.?\d*(?:[eE][+-]?\d+)?)\s*(\S*)\s*(.*)$/;

// What the page has set, from its address.
class Given {
  constructor(query) {
    Object.assign(this, { set: {}, start: {}, tolerance: {}, sweep: "", points: "", orders: "", samples: "" });
    for (const [key, text] of new URLSearchParams(query)) {
      const at = text.indexOf("=");
      if (["set", "start", "tolerance"].includes(key)) this[key][text.slice(0, at)] = text.slice(at + 1);
      else if (["sweep", "points", "orders", "samples"].includes(key)) this[key] = text;
    }
  }

  query() {
    const out = new URLSearchParams();
    for (const key of ["set", "start", "tolerance"]) for (const [name, text] of Object.entries(this[key])) out.append(key, `${name}=${text}`);
    for (const key of ["sweep", "points", "orders", "samples"]) if (this[key]) out.append(key, this[key]);
    return out.toString();
  }

  // As the server takes it: only what this machine has, so that an edit that takes a name away does not end all answers.
  question(names) {
    const known = (texts) => Object.fromEntries(Object.entries(texts).filter(([name]) => names.has(name)));
    const number = (text) => (text === "" ? undefined : Number(text));
    return {
      set: known(this.set), start: known(this.start), tolerance: known(this.tolerance),
      sweep: this.sweep || undefined, points: number(this.points), samples: number(this.samples),
      orders: this.orders ? this.orders.split(",").map(Number) : undefined,
    };
  }
}

const page = {
  given: new Given(location.search),
  news: null,
  controls: new Map(),
  sections: new Map(),
  slopes: null,
  mode: 0,
  // Grows with every change: an answer is of the values of its time.
  time: 0,
};

// Asks one question and reads the lines of its answer.
async function ask(kind, { signal, onSteps } = {}) {
  const given = page.given.question(new Set(page.news.controls.map(({ name }) => name)));
  const response = await fetch("answer", { method: "POST", signal, body: JSON.stringify({ ask: kind, given }) });
  if (!response.ok) throw new Error(await response.text());
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let rest = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) throw new Error("the connection broke off");
    const lines = (rest + value).split("\n");
    rest = lines.pop();
    for (const line of lines) {
      const { steps, answer, refused } = JSON.parse(line);
      if (refused !== undefined) throw new Error(refused);
      if (answer) return answer;
      onSteps?.(steps);
    }
  }
}

// The head: what is served, and how things are.
document.body.classList.add("live");
const main = document.querySelector("main");
const head = document.createElement("header");
document.body.prepend(head);
const aside = document.createElement("aside");
main.before(aside);
aside.setAttribute("aria-label", "What can be changed");
const title = htmlElement("h1", {}, head, document.title);
const state = htmlElement("p", { class: "state", role: "status" }, head, "Reading the declaration ...");
const mistakes = htmlElement("pre", { class: "mistakes", role: "alert", hidden: "" }, head);
const refusal = htmlElement("p", { class: "refusal bad", role: "alert", hidden: "" }, head);
const tools = htmlElement("div", { class: "tools" }, head);

function button(text, act, parent = tools) {
  const own = htmlElement("button", { type: "button" }, parent, text);
  own.addEventListener("click", act);
  return own;
}

function show(element, text) {
  element.hidden = !text;
  element.textContent = text ?? "";
}

button("Take samples", () => long("all"));
const stop = button("Stop", () => running?.abort());
stop.disabled = true;
const steps = htmlElement("span", { class: "steps", role: "status" }, tools);
button("Report", () => long("report"));
button("Study file", () => long("study"));
button("Declaration", () => long("declaration"));
button("Copy link", async (event) => { event.target.textContent = (await copied(location.href)) ? "Copied" : "Copy link"; });
button("Undo all", () => { page.given = new Given(""); build(); moved(); });

// Work that is asked for: one at a time.
let running = null;
async function long(kind) {
  running?.abort();
  const own = new AbortController();
  running = own;
  const { time } = page;
  stop.disabled = false;
  const began = performance.now();
  const told = (count) => { steps.textContent = `${count} steps, ${((performance.now() - began) / 1000).toFixed(0)} s`; };
  told(0);
  try {
    const answer = await ask(kind, { signal: own.signal, onSteps: told });
    if (answer.file) save(answer.file);
    else take(answer.sections, time);
    show(refusal, answer.file?.note);
    steps.textContent = "";
  } catch (error) {
    steps.textContent = own.signal.aborted ? "Stopped." : "";
    if (!own.signal.aborted) show(refusal, error.message);
  } finally {
    if (running === own) {
      running = null;
      stop.disabled = true;
    }
  }
}

function save({ name, text }) {
  const address = URL.createObjectURL(new Blob([text], { type: "application/octet-stream" }));
  const link = htmlElement("a", { href: address, download: name.split(/[\\/]/).pop() }, document.body);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

// The answers at the operating point follow each move, one question at a time and always with the newest values; those along
// an input follow when the moves have ended.
let asking = false;
let dirty = false;
let pause = null;
let following = null;
function moved() {
  page.time += 1;
  dirty = true;
  following?.abort();
  clearTimeout(pause);
  pause = setTimeout(rested, REST);
  if (!asking) follow();
}

async function follow() {
  asking = true;
  while (dirty && page.news?.machine) {
    dirty = false;
    const { time } = page;
    const began = performance.now();
    try {
      const { sections } = await ask("at_point");
      // The view stays under the hand that turns it.
      while (document.querySelector(".view3d:active")) await new Promise((done) => setTimeout(done, 50));
      page.slopes = sections.slopes;
      for (const own of page.controls.values()) own.follow(sections.values[own.name]);
      take(sections, time);
      describe();
      show(refusal, null);
      say(performance.now() - began);
    } catch (error) {
      show(refusal, error.message);
      age();
    }
  }
  asking = false;
  document.documentElement.dataset.answered = String(Number(document.documentElement.dataset.answered ?? 0) + 1);
}

async function rested() {
  history.replaceState(null, "", `?${page.given.query()}${location.hash}`);
  if (!page.news?.machine) return;
  following?.abort();
  const own = new AbortController();
  following = own;
  const { time } = page;
  try {
    take((await ask("along", { signal: own.signal, onSteps: (count) => { steps.textContent = `along the input: ${count} steps`; } })).sections, time);
    document.documentElement.dataset.followed = String(Number(document.documentElement.dataset.followed ?? 0) + 1);
  } catch (error) {
    if (!own.signal.aborted) show(refusal, error.message);
  } finally {
    if (following === own && !running) steps.textContent = "";
  }
}

function say(milliseconds) {
  const { mistakes: wrong, busy, name } = page.news;
  state.className = wrong ? "state old" : "state";
  if (wrong) state.textContent = `${name} has mistakes: this is the last answer before them.`;
  else if (busy) state.textContent = `${name} has changed and is being read ...`;
  else state.textContent = `${name}${milliseconds === undefined ? "" : `, answered in ${milliseconds.toFixed(0)} ms`}`;
}

// Puts sections in their places. What is folded is drawn when it is unfolded.
function take({ sections }, time) {
  const scroll = scrollY;
  for (const { id, heading, html } of sections) {
    const own = page.sections.get(id) ?? newSection(id, heading);
    const before = own.body.querySelector(".mechanism")?.player;
    own.body.innerHTML = html;
    Object.assign(own, { drawn: false, time });
    if (own.element.open !== false) draw(own, before);
  }
  age();
  scrollTo(scrollX, scroll);
}

// A section keeps what it had until its question is answered, and says so.
function age() {
  for (const { element, earlier, time } of page.sections.values()) {
    const old = time !== page.time;
    element.classList.toggle("old", old);
    earlier.textContent = old ? "from earlier values" : "";
  }
}

function draw(own, before) {
  if (own.drawn) return;
  own.drawn = true;
  enliven(own.body, before);
}

function newSection(id, heading) {
  const folds = id !== "brief";
  const element = document.createElement(folds ? "details" : "section");
  element.id = id;
  element.className = folds ? "answer section" : "answer";
  const own = { id, element, drawn: false };
  const top = folds ? htmlElement("summary", {}, element) : element;
  htmlElement("h2", {}, top, heading);
  own.earlier = htmlElement("span", { class: "earlier", role: "status" }, top);
  own.body = htmlElement("div", {}, element);
  if (folds) {
    element.open = OPEN.includes(id);
    element.addEventListener("toggle", () => { if (element.open) draw(own); });
  }
  page.sections.set(id, own);
  const later = SECTIONS.slice(SECTIONS.indexOf(id) + 1).map((other) => page.sections.get(other)?.element).find(Boolean);
  main.insertBefore(element, later ?? null);
  return own;
}

// The controls.
function group(text, folded) {
  const box = htmlElement("fieldset", {}, aside);
  const legend = htmlElement("legend", {}, box);
  const toggle = button(text, () => toggle.setAttribute("aria-expanded", String(!box.classList.toggle("folded"))), legend);
  toggle.setAttribute("aria-expanded", String(!folded));
  box.classList.toggle("folded", folded);
  return box;
}

function field(parent, text, key, hint) {
  const label = htmlElement("label", { class: "wide" }, parent);
  htmlElement("span", {}, label, text);
  const input = htmlElement("input", { type: "text", placeholder: hint, value: page.given[key], "aria-label": text }, label);
  input.addEventListener("change", () => { page.given[key] = input.value.trim(); moved(); });
}

function build() {
  const folded = new Map([...aside.querySelectorAll("fieldset")].map((box) => [box.querySelector("button").textContent, box.classList.contains("folded")]));
  aside.replaceChildren();
  page.controls.clear();
  const choice = htmlElement("label", { class: "wide" }, aside);
  htmlElement("span", {}, choice, "Derivatives of");
  page.choice = htmlElement("select", {}, choice);
  page.choice.addEventListener("change", () => { page.mode = Number(page.choice.value); describe(); });
  if (page.news.controls.length > MANY) finder();
  for (const [kind, text, usual] of KINDS) {
    const all = page.news.controls.filter((own) => own.kind === kind);
    if (all.length === 0) continue;
    const box = group(text, folded.get(text) ?? usual);
    for (const own of all) page.controls.set(`${kind} ${own.name}`, new Control(own, box));
  }
  const box = group("Along an input", folded.get("Along an input") ?? true);
  field(box, "Range", "sweep", page.news.sweep ?? "speed=0..6000 rpm");
  field(box, "Values", "points", "41");
  field(box, "Orders", "orders", "1");
  field(box, "Samples", "samples", "what 5 s allow");
}

// Hides what does not have the text in its name.
function finder() {
  const label = htmlElement("label", { class: "wide" }, aside);
  htmlElement("span", {}, label, "Find");
  const input = htmlElement("input", { type: "search", "aria-label": "Find a control", value: page.found ?? "" }, label);
  const find = () => {
    page.found = input.value;
    for (const { box, name } of page.controls.values()) box.hidden = !name.includes(input.value.trim());
  };
  input.addEventListener("input", find);
  setTimeout(find);
}

class Control {
  constructor(own, parent) {
    Object.assign(this, own);
    this.key = own.kind === "start" ? "start" : "set";
    this.box = htmlElement("div", { class: "control" }, parent);
    const line = htmlElement("div", { class: "line" }, this.box);
    htmlElement("span", { class: "what" }, line, own.name);
    this.slope = htmlElement("output", { class: "slope" }, line);
    const given = page.given[this.key][own.name];
    this.text = given ?? this.usual();
    this.slider = htmlElement("input", { type: "range", "aria-label": `${own.name}, slider` }, this.box);
    this.entry = htmlElement("input", { type: "text", "aria-label": `${own.name}, value with unit`, spellcheck: "false" }, this.box);
    this.entry.value = this.text;
    this.range(own.value);
    this.slider.addEventListener("input", () => this.take(`${Number(Number(this.slider.value).toPrecision(6))} ${own.unit}`.trim()));
    this.entry.addEventListener("change", () => { this.take(this.entry.value.trim()); });
    if (own.tolerance !== null) this.spread(own);
    this.mark();
  }

  usual() {
    return `${this.value} ${this.unit}`.trim();
  }

  // What the text of the entry means, in the unit of the control.
  follow(value) {
    if (value === undefined || Number(this.slider.value) === value) return;
    const { min, max } = this.slider;
    if (value < Number(min) || value > Number(max)) this.range(value);
    else if (document.activeElement !== this.slider) this.slider.value = value;
  }

  // The slider is about a value.
  range(value) {
    const turn = { rad: Math.PI, deg: 180 }[this.unit];
    let [low, high] = value > 0 ? [0, 2 * value] : value < 0 ? [2 * value, 0] : [-1, 1];
    if (this.kind === "design" && value !== 0) [low, high] = [low === 0 ? value / 2 : 1.5 * value, low === 0 ? 1.5 * value : value / 2];
    if (this.kind === "start") [low, high] = turn ? [-turn, turn] : [Math.min(-1, 2 * value), Math.max(1, 2 * value)];
    if (this.kind === "input" && value === 0) high = { rpm: 3000, Hz: 50, "rad/s": 300 }[this.unit] ?? 1;
    Object.assign(this.slider, { min: low, max: high, step: (high - low) / 400 });
    this.slider.value = value;
  }

  spread({ name, unit, tolerance }) {
    this.usualSpread = tolerance;
    this.width = htmlElement("input", { type: "range", min: 0, "aria-label": `${name}, tolerance slider` }, this.box);
    this.band = htmlElement("input", { type: "text", placeholder: "no tolerance", "aria-label": `${name}, tolerance`, spellcheck: "false" }, this.box);
    this.share = htmlElement("output", { class: "share" }, this.box);
    this.band.value = page.given.tolerance[name] ?? tolerance;
    this.widths();
    this.width.addEventListener("input", () => this.takeBand(`${Number(Number(this.width.value).toPrecision(4))} ${this.after}`.trim()));
    this.band.addEventListener("change", () => { this.takeBand(this.band.value.trim() || "0%"); this.widths(); });
  }

  // A half-width has a slider; what says more is text.
  widths() {
    const text = this.band.value.trim();
    const [, digits, unit, law] = SIMPLE.exec(text || "0 %") ?? [];
    const simple = digits !== undefined && ["%", this.unit].includes(unit);
    this.width.disabled = !simple;
    if (!simple) return;
    this.after = `${unit} ${law}`.trim();
    const most = Number(digits) > 0 ? 3 * Number(digits) : unit === "%" ? 5 : 1;
    Object.assign(this.width, { max: most, step: most / 300 });
    this.width.value = Number(digits);
  }

  take(text) {
    if (text === "" || text === this.usual()) delete page.given[this.key][this.name];
    else page.given[this.key][this.name] = text;
    this.entry.value = text || this.usual();
    this.mark();
    moved();
  }

  takeBand(text) {
    if (text === this.usualSpread || (text === "0%" && !this.usualSpread)) delete page.given.tolerance[this.name];
    else page.given.tolerance[this.name] = text;
    this.band.value = text;
    this.mark();
    moved();
  }

  mark() {
    const changed = this.name in page.given[this.key] || (this.tolerance !== null && this.name in page.given.tolerance);
    this.box.classList.toggle("changed", changed);
  }
}

// A unit in the denominator.
function per(unit) {
  if (unit === "") return "";
  return /[*/]/.test(unit) ? `/(${unit})` : `/${unit}`;
}

// Derivatives and shares beside the controls.
function describe() {
  const { slopes, choice } = page;
  const modes = slopes?.modes ?? [];
  page.mode = Math.min(page.mode, Math.max(0, modes.length - 1));
  choice.replaceChildren();
  modes.forEach(({ name, frequency, band }, k) => {
    const about = `${name}: ${numberText(frequency)}${band ? ` \u00b1 ${numberText(Number(band.toPrecision(3)))}` : ""} ${slopes.unit}`;
    htmlElement("option", { value: k }, choice, about);
  });
  if (modes.length > 0) choice.value = page.mode;
  else htmlElement("option", {}, choice, "no frequency");
  for (const own of page.controls.values()) {
    if (own.kind === "start") continue;
    const slope = slopes?.by[own.name]?.[page.mode];
    own.slope.textContent = slope === undefined || slope === null ? "" : `${numberText(slope)} ${slopes.unit}${per(own.unit)}`;
    const share = slopes?.shares[own.name]?.[page.mode];
    if (own.share) own.share.textContent = share > 0 ? `${(100 * share).toFixed(share < 0.1 ? 1 : 0)} % of the band` : "";
  }
}

// News of the declaration, one request after the other.
async function listen() {
  let version = 0;
  for (;;) {
    try {
      const response = await fetch("news", { method: "POST", body: JSON.stringify({ after: version }) });
      if (!response.ok) throw new Error(await response.text());
      const news = await response.json();
      const { machine } = page.news ?? {};
      version = news.version;
      page.news = news;
      show(mistakes, news.mistakes);
      say();
      if (news.mistakes) {
        page.time += 1;
        age();
      }
      if (news.mechanism) title.textContent = news.mechanism;
      if (news.machine && news.machine !== machine) {
        build();
        moved();
      }
      document.documentElement.dataset.version = String(version);
    } catch {
      state.className = "state old";
      state.textContent = "The server does not answer: this is its last answer.";
      await new Promise((done) => setTimeout(done, 1000));
      version = 0;
    }
  }
}
listen();
