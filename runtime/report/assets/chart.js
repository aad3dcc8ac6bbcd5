// Draws a figure of the crate eigentol-figures: panels with a legend whose entries hide what they name, values under the pointer or
// the arrow keys, and a rectangle to zoom into.

const WIDEST = 760;

// Of labels: pixels of a letter at most, and how far they stand below their points, most wanted first.
const LETTER = 7;
// What only compares, and is paler than what it is compared with.
const GREY = "#6e6e6e";
const strength = (colour) => (colour === GREY ? 0.35 : 0.75);
const LABEL_RISES = [-6, 14, 4, -20, 28, -34, 42, -48, 56];
const DASHES = { solid: "", dashed: "8 5", dotted: "2 4", dash_dotted: "9 4 2 4" };

function drawFigure(figure, parent) {
  // Panels over one axis stand exactly one below the other.
  const room = Math.max(...figure.panels.map(({ y }) => leftMargin(y, proper(y.range))));
  figure.panels.forEach((panel) => new Chart(panel, parent, figure.title, room));
}

// Everything of a panel that can be pointed at or hidden, whatever it is, in the order in which it is painted.
function seriesOf(panel) {
  const kinds = [
    ["band", panel.bands],
    ["bars", panel.bars],
    ["mark", panel.marks],
    ["curve", panel.curves],
    ["errors", panel.error_bars],
    ["markers", panel.markers],
  ];
  return kinds.flatMap(([kind, all]) => all.map((own) => ({ kind, own, label: own.label, hidden: false })));
}

// The points of a series that have values to show: place, and lines of text.
function pointsOf({ kind, own }, { x, y }) {
  const line = (axis, value) => `${axis.name || "value"}: ${valueText(axis, value)}`;
  const both = (at) => [line(x, at[0]), line(y, at[1])];
  switch (kind) {
    case "curve":
      return own.pieces.flat().map((at) => ({ at, lines: both(at) }));
    case "markers":
      return own.points.map((at) => ({ at, lines: both(at) }));
    case "errors":
      return own.bars.map(({ at, low, high }) => {
        const axis = low[0] === high[0] ? 1 : 0;
        const span = `${valueText([x, y][axis], low[axis])} to ${valueText([x, y][axis], high[axis])}`;
        return { at, lines: [...both(at), `interval: ${span}`] };
      });
    case "band":
      return own.edges.map(([at, low, high]) => ({
        at: [at, (low + high) / 2],
        lines: [line(x, at), `${y.name || "value"}: ${valueText(y, low)} to ${valueText(y, high)}`],
        shy: true,
      }));
    case "bars":
      return own.bars.map(([left, right, low, high]) => ({
        at: [(left + right) / 2, (low + high) / 2],
        within: [left, right, low, high],
        lines: barLines(x, y, [left, right, low, high]),
      }));
    default:
      return [];
  }
}

function barLines(x, y, [left, right, low, high]) {
  if (y.categories.length > 0) {
    return [valueText(y, (low + high) / 2), `${x.name}: ${valueText(x, Math.abs(left) > Math.abs(right) ? left : right)}`];
  }
  const span = x.categories.length > 0
    ? valueText(x, (left + right) / 2)
    : `${x.name}: ${valueText(x, left)} to ${valueText(x, right)}`;
  return [span, `${y.name || "value"}: ${valueText(y, Math.abs(low) > Math.abs(high) ? low : high)}`];
}

// Black is the colour of the letters, on dark paper too.
const tint = (colour) => (colour === "#000000" ? "currentColor" : colour);

class Chart {
  static count = 0;

  constructor(panel, parent, title, room) {
    this.panel = panel;
    this.room = room;
    this.series = seriesOf(panel);
    for (const one of this.series) one.points = pointsOf(one, panel);
    this.whole = [proper(panel.x.range), proper(panel.y.range)];
    this.view = this.whole;
    const wide = Math.max(340, Math.min(WIDEST, parent.clientWidth || WIDEST));
    this.size = [wide, Math.round(Math.max(250, 0.46 * wide))];
    this.id = `clip${(Chart.count += 1)}`;
    const letters = (axis) => Math.max(0, ...axis.categories.map((name) => name.length));
    const left = room;
    // Names that do not fit beside each other stand aslant.
    this.slant = 7.4 * letters(panel.x) > (wide - 26 - left) / Math.max(1, panel.x.categories.length);
    const under = this.slant ? 44 + 4.6 * Math.min(18, letters(panel.x)) : 48;
    if (this.slant) this.size[1] += under - 48;
    this.inner = { left, right: wide - 26, top: 12, bottom: this.size[1] - under };
    this.box = htmlElement("div", { class: "panel" }, parent);
    this.legend();
    this.plot = htmlElement("div", { class: "plot" }, this.box);
    this.svg = svgElement("svg", {
      viewBox: `0 0 ${this.size.join(" ")}`,
      role: "group",
      tabindex: "0",
      "aria-label": `${title}: ${heading(panel.y)} over ${heading(panel.x)}. Arrow keys move through the values, plus and minus zoom.`,
    }, this.plot);
    this.tip = htmlElement("div", { class: "tip", role: "status", hidden: "" }, this.plot);
    this.draw();
    this.listen();
  }

  // One button for all that has the same label.
  legend() {
    const labels = [...new Set(this.series.map((one) => one.label).filter((label) => label))];
    if (labels.length === 0) return;
    const bar = htmlElement("div", { class: "legend", role: "group", "aria-label": "Shown in the chart" }, this.box);
    for (const label of labels) {
      const button = htmlElement("button", { type: "button", "aria-pressed": "true" }, bar);
      const picture = svgElement("svg", { viewBox: "0 0 34 14", width: 34, height: 14, "aria-hidden": "true" }, button);
      for (const one of this.series.filter((own) => own.label === label)) swatch(one, picture);
      htmlElement("span", {}, button, label);
      button.addEventListener("click", () => {
        const hidden = button.getAttribute("aria-pressed") === "true";
        button.setAttribute("aria-pressed", String(!hidden));
        for (const one of this.series) if (one.label === label) one.hidden = hidden;
        this.draw();
      });
    }
  }

  draw() {
    this.inner.left = Math.max(this.room, leftMargin(this.panel.y, this.view[1]));
    const { left, right, top, bottom } = this.inner;
    if (this.panel.equal_scales) {
      const all = this.view === this.whole;
      this.view = equalised(this.view, (right - left) / (bottom - top));
      if (all) this.whole = this.view;
    }
    this.x = scale(this.view[0], [left, right], this.panel.x.logarithmic);
    this.y = scale(this.view[1], [bottom, top], this.panel.y.logarithmic);
    this.svg.replaceChildren();
    const clip = svgElement("clipPath", { id: this.id }, svgElement("defs", {}, this.svg));
    svgElement("rect", { x: left, y: top, width: right - left, height: bottom - top }, clip);
    this.drawAxes();
    const inside = svgElement("g", { "clip-path": `url(#${this.id})` }, this.svg);
    this.series.forEach((one, number) => {
      if (one.hidden) return;
      const group = svgElement("g", { "data-series": number, class: one.kind }, inside);
      this.drawSeries(one, group);
    });
    this.drawLabels();
    this.frame = svgElement("rect", { class: "drag", width: 0, height: 0 }, this.svg);
    this.cursor = svgElement("circle", { class: "cursor", r: 5, visibility: "hidden" }, this.svg);
    if (this.view !== this.whole) this.resetButton();
  }

  // Each beside its point where no other label stands, if there is such a place.
  drawLabels() {
    const taken = [];
    const { left, right, top, bottom } = this.inner;
    const rises = this.panel.y.categories.length > 0 ? [4] : LABEL_RISES;
    for (const { at, text } of this.panel.labels) {
      if (!this.inView(at)) continue;
      const [x, y] = this.pixel(at);
      const wide = LETTER * text.length;
      const inside = (from) => Math.max(left + 2, Math.min(right - wide, from));
      const places = rises.flatMap((rise) => [x + 6, x - 6 - wide].map((from) => [from, y + rise]));
      const box = ([from, base]) => [from, base - 10, from + wide, base + 3];
      const fits = ([from, high, to, low]) => from >= left && to <= right && high >= top && low <= bottom;
      const free = (own) => !taken.some((other) => own[0] < other[2] && other[0] < own[2] && own[1] < other[3] && other[1] < own[3]);
      const boxes = places.map(box);
      const [from, , , low] = boxes.find((own) => fits(own) && free(own)) ?? boxes.find(fits) ?? box([inside(x + 6), Math.max(top + 12, y - 6)]);
      taken.push([from, low - 13, from + wide, low]);
      svgText(text, { x: from, y: low - 3, class: "label" }, this.svg);
    }
  }

  drawAxes() {
    const { left, right, top, bottom } = this.inner;
    const { x, y } = this.panel;
    const axes = svgElement("g", { class: "axes" }, this.svg);
    for (const [value, text] of marksOf(x, this.view[0], Math.max(2, Math.min(8, Math.floor((right - left) / 70))))) {
      const place = this.x(value);
      if (x.categories.length === 0) svgElement("line", { x1: place, x2: place, y1: top, y2: bottom, class: "grid" }, axes);
      const aslant = this.slant && { "text-anchor": "end", transform: `rotate(-35 ${place} ${bottom + 14})` };
      svgText(shortened(text, 18), { x: place, y: this.slant ? bottom + 14 : bottom + 17, "text-anchor": "middle", ...aslant }, axes);
    }
    for (const [value, text] of marksOf(y, this.view[1], 6)) {
      const place = this.y(value);
      if (y.categories.length === 0) svgElement("line", { x1: left, x2: right, y1: place, y2: place, class: "grid" }, axes);
      svgText(shortened(text, 26), { x: left - 7, y: place + 4, "text-anchor": "end" }, axes);
    }
    for (const [low, high] of [[[left, bottom], [right, bottom]], [[left, top], [left, bottom]]]) {
      svgElement("line", { x1: low[0], y1: low[1], x2: high[0], y2: high[1], class: "axis" }, axes);
    }
    svgText(heading(x), { x: (left + right) / 2, y: this.size[1] - 9, "text-anchor": "middle", class: "name" }, axes);
    if (!heading(y)) return;
    const middle = (top + bottom) / 2;
    svgText(heading(y), { x: 16, y: middle, "text-anchor": "middle", class: "name", transform: `rotate(-90 16 ${middle})` }, axes);
  }

  drawSeries({ kind, own }, group) {
    const { top, bottom } = this.inner;
    const path = (points) => points.map((at, k) => `${k ? "L" : "M"}${this.pixel(at).map((v) => v.toFixed(2)).join(" ")}`).join("");
    if (kind === "curve") {
      for (const piece of own.pieces) {
        svgElement("path", { d: path(piece), fill: "none", stroke: tint(own.colour), "stroke-width": 2, "stroke-dasharray": DASHES[own.stroke] }, group);
      }
    } else if (kind === "band") {
      const upper = own.edges.map(([at, , high]) => [at, high]);
      const lower = own.edges.map(([at, low]) => [at, low]).reverse();
      svgElement("path", { d: `${path([...upper, ...lower])}Z`, fill: own.colour, "fill-opacity": 0.22, stroke: own.colour, "stroke-opacity": 0.35, "stroke-width": 0.7 }, group);
    } else if (kind === "bars") {
      for (const [a, b, low, high] of own.bars) {
        const [x, y] = this.pixel([a, high]);
        const [right, under] = this.pixel([b, low]);
        svgElement("rect", { x, y, width: Math.max(0, right - x), height: Math.max(0, under - y), fill: own.colour, "fill-opacity": strength(own.colour), stroke: "#fff", "stroke-width": 0.6 }, group);
      }
    } else if (kind === "mark") {
      const x = this.x(own.at);
      svgElement("line", { x1: x, x2: x, y1: top, y2: bottom, class: "marked" }, group);
    } else if (kind === "markers") {
      for (const at of own.points) marker(own.shape, own.colour, this.pixel(at), group);
    } else {
      for (const { at, low, high } of own.bars) {
        errorBar(this.pixel(low), this.pixel(high), own.colour, group);
        marker(own.shape, own.colour, this.pixel(at), group);
      }
    }
  }

  pixel([x, y]) {
    return [this.x(x), this.y(y)];
  }

  inView([x, y]) {
    const [[left, right], [low, high]] = this.view;
    return x >= left && x <= right && y >= low && y <= high;
  }

  // The nearest value to a place in the chart; of a bar the place may be anywhere in it, of a band only where nothing else is near.
  nearest(place) {
    let best = null;
    for (const one of this.series) {
      if (one.hidden) continue;
      for (const point of one.points) {
        const inside = point.within && this.contains(point.within, place);
        if (!inside && !this.inView(point.at)) continue;
        const [x, y] = this.pixel(point.at);
        const distance = inside ? 12 : Math.hypot(x - place[0], y - place[1]) + (point.shy ? 25 : 0);
        if (distance < (best?.distance ?? 60)) best = { distance, one, point };
      }
    }
    return best;
  }

  contains([left, right, low, high], [x, y]) {
    const value = [this.x.inverse(x), this.y.inverse(y)];
    return value[0] >= left && value[0] <= right && value[1] >= Math.min(low, high) && value[1] <= Math.max(low, high);
  }

  show(found) {
    this.tip.hidden = !found;
    this.cursor.setAttribute("visibility", found ? "visible" : "hidden");
    if (!found) return;
    const [x, y] = this.pixel(found.point.at);
    this.cursor.setAttribute("cx", x);
    this.cursor.setAttribute("cy", y);
    this.tip.replaceChildren();
    if (found.one.label) htmlElement("strong", {}, this.tip, found.one.label);
    for (const line of found.point.lines) htmlElement("div", {}, this.tip, line);
    this.tip.classList.toggle("leftwards", x > this.size[0] * 0.6);
    this.tip.style.left = `${(100 * x) / this.size[0]}%`;
    this.tip.style.top = `${(100 * y) / this.size[1]}%`;
  }

  // The place of an event in the coordinates of the drawing.
  place(event) {
    const box = this.svg.getBoundingClientRect();
    return [((event.clientX - box.left) * this.size[0]) / box.width, ((event.clientY - box.top) * this.size[1]) / box.height];
  }

  zoom(view) {
    this.view = view;
    this.show(null);
    this.draw();
  }

  resetButton() {
    const { right, top } = this.inner;
    const button = svgElement("g", { class: "reset", role: "button", tabindex: "0", "aria-label": "Show all" }, this.svg);
    svgElement("rect", { x: right - 74, y: top + 2, width: 72, height: 22, rx: 4 }, button);
    svgText("show all", { x: right - 38, y: top + 17, "text-anchor": "middle" }, button);
    button.addEventListener("click", () => this.zoom(this.whole));
    button.addEventListener("pointerdown", (event) => event.stopPropagation());
  }

  listen() {
    let start = null;
    this.svg.addEventListener("pointerdown", (event) => {
      start = this.place(event);
    });
    this.svg.addEventListener("pointermove", (event) => {
      const place = this.place(event);
      this.show(start ? null : this.nearest(place));
      if (start) this.drag(start, place);
    });
    const end = (event) => {
      if (start) this.zoomInto(start, this.place(event));
      start = null;
    };
    this.svg.addEventListener("pointerup", end);
    this.svg.addEventListener("pointerleave", (event) => {
      end(event);
      this.show(null);
    });
    this.svg.addEventListener("dblclick", () => this.zoom(this.whole));
    this.svg.addEventListener("keydown", (event) => this.key(event));
    this.svg.addEventListener("blur", () => this.show(null));
  }

  drag([x, y], [right, under]) {
    const { frame } = this;
    frame.setAttribute("x", Math.min(x, right));
    frame.setAttribute("y", Math.min(y, under));
    frame.setAttribute("width", Math.abs(right - x));
    frame.setAttribute("height", Math.abs(under - y));
  }

  zoomInto(start, end) {
    this.drag([0, 0], [0, 0]);
    if (Math.abs(end[0] - start[0]) < 12 || Math.abs(end[1] - start[1]) < 12) return;
    const limits = (scaled, a, b) => [scaled.inverse(a), scaled.inverse(b)].sort((p, q) => p - q);
    this.zoom([limits(this.x, start[0], end[0]), limits(this.y, start[1], end[1])]);
  }

  zoomBy(factor) {
    const about = [this.x, this.y].map((scaled, axis) => {
      const [low, high] = this.view[axis].map((end) => scaled(end));
      const [middle, half] = [(low + high) / 2, ((high - low) / 2) * factor];
      return [scaled.inverse(middle - half), scaled.inverse(middle + half)];
    });
    this.zoom(about);
  }

  // Left and right go along a series, up and down to another one.
  key(event) {
    const shown = this.series.filter((one) => !one.hidden && one.points.length > 0);
    const steps = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const step = steps[event.key];
    if (step && shown.length > 0) {
      const wrap = (value, count) => ((value % count) + count) % count;
      this.at ??= [-step[0], 0];
      const series = shown[wrap((this.at[1] += step[1]), shown.length)];
      const point = series.points[wrap((this.at[0] += step[0]), series.points.length)];
      this.show({ one: series, point });
    } else if (event.key === "+" || event.key === "=") this.zoomBy(0.7);
    else if (event.key === "-") this.zoomBy(1 / 0.7);
    else if (event.key === "Escape" || event.key === "Enter") this.zoom(this.whole);
    else return;
    event.preventDefault();
  }
}

// Room for what stands along the vertical axis, and for its name.
function leftMargin(axis, range) {
  const letters = Math.max(...marksOf(axis, range, 6).map(([, text]) => Math.min(26, text.length)), 0);
  return Math.max(62, Math.min(220, 36 + 7.4 * letters));
}

function swatch({ kind, own }, picture) {
  if (kind === "curve") {
    svgElement("line", { x1: 1, x2: 33, y1: 7, y2: 7, stroke: tint(own.colour), "stroke-width": 2.4, "stroke-dasharray": DASHES[own.stroke] }, picture);
  } else if (kind === "band" || kind === "bars") {
    svgElement("rect", { x: 3, y: 2, width: 28, height: 10, fill: own.colour, "fill-opacity": kind === "band" ? 0.25 : strength(own.colour) }, picture);
  } else if (kind === "mark") {
    svgElement("line", { x1: 17, x2: 17, y1: 0, y2: 14, class: "marked" }, picture);
  } else {
    if (kind === "errors") errorBar([17, 0], [17, 14], own.colour, picture);
    marker(own.shape, own.colour, [17, 7], picture);
  }
}

function errorBar(low, high, colour, parent) {
  const upright = Math.abs(low[0] - high[0]) < Math.abs(low[1] - high[1]);
  const cap = upright ? [4, 0] : [0, 4];
  const line = (a, b) => svgElement("line", { x1: a[0], y1: a[1], x2: b[0], y2: b[1], stroke: tint(colour), "stroke-width": 1.5 }, parent);
  line(low, high);
  for (const end of [low, high]) line([end[0] - cap[0], end[1] - cap[1]], [end[0] + cap[0], end[1] + cap[1]]);
}

function marker(shape, colour, [x, y], parent) {
  const hollow = { fill: "#fff", "fill-opacity": 0.6, stroke: tint(colour), "stroke-width": 1.7 };
  const filled = { fill: tint(colour), stroke: "#fff", "stroke-width": 0.7 };
  const polygon = (points, style) => svgElement("polygon", { points: points.map(([a, b]) => `${x + a},${y + b}`).join(" "), ...style }, parent);
  if (shape === "ring") svgElement("circle", { cx: x, cy: y, r: 4.2, ...hollow }, parent);
  else if (shape === "disc") svgElement("circle", { cx: x, cy: y, r: 4.2, ...filled }, parent);
  else if (shape === "square") svgElement("rect", { x: x - 3.8, y: y - 3.8, width: 7.6, height: 7.6, ...hollow }, parent);
  else if (shape === "triangle") polygon([[0, -5.5], [5, 4], [-5, 4]], filled);
  else if (shape === "diamond") polygon([[0, -5.5], [5.5, 0], [0, 5.5], [-5.5, 0]], filled);
  else for (const sign of [1, -1]) {
    svgElement("line", { x1: x - 4, y1: y - 4 * sign, x2: x + 4, y2: y + 4 * sign, stroke: tint(colour), "stroke-width": 2 }, parent);
  }
}
