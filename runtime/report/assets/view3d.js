// A mechanism in space, drawn from the back to the front on a canvas: at its equilibrium, or in motion.

const BODY_COLOURS = ["#4d9fd1", "#e8b04a", "#5cc2a0", "#d98a5b", "#b08ac0", "#9ccff0", "#c9c06a", "#8fa3ad"];
const LIGHT = unit([0.35, 0.55, 0.75]);
const REST = "#9a9a9a";
const LINK = "#7a3b69";
// Rotations that bring a direction of the common frame upwards.
const UPRIGHT = {
  z: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  "-z": [[1, 0, 0], [0, -1, 0], [0, 0, -1]],
  y: [[0, 0, 1], [1, 0, 0], [0, 1, 0]],
  "-y": [[0, 0, -1], [1, 0, 0], [0, -1, 0]],
  x: [[0, 1, 0], [0, 0, 1], [1, 0, 0]],
  "-x": [[0, -1, 0], [0, 0, 1], [-1, 0, 0]],
};

class Model {
  constructor(scene, up) {
    this.scene = scene;
    this.upright = { ...UPRIGHT };
    const along = Object.keys(UPRIGHT).find((name) => dot(UPRIGHT[name][2], up) > 1 - 1e-9);
    if (!along) this.upright.oblique = [...across(up), up];
    this.up = along ?? "oblique";
    const [low, high] = scene.bounds;
    this.middle = times(0.5, plus(low, high));
    this.size = length(minus(high, low)) || 1;
    this.rest = [...scene.bodies, ...scene.beams.flatMap(({ sections }) => sections)].map(({ pose }) => pose);
    const flexures = scene.joints.filter(isFlexure);
    // The roots and stations of beams and shafts: the beams show where they are.
    const ofFlexures = new Set(flexures.flatMap(({ from, to }) => [from.body, to.body]));
    this.ofBeams = new Set([...ofFlexures].filter((body) => scene.bodies[body]?.solids.length === 0));
    // An ellipsoid stands for masses and moments of inertia: the joints within it are what one knows of the body.
    this.vague = scene.bodies.map(({ solids }, body) => !this.ofBeams.has(body) && solids.every(({ shape }) => "Ellipsoid" in shape));
    const faces = (sides) => scene.bodies.map(({ solids }) => solids.filter((one) => !one.hole).flatMap((one) => facesOf(one, this.size, sides)));
    this.faces = faces(FINE);
    this.coarse = faces(COARSE);
    this.shafts = new Set(shaftsOf(scene).map(({ name }) => name));
    this.bearings = bearingsOf(scene);
    this.superelements = superelementsOf(scene);
    this.ofSuperelements = new Set(this.superelements.flat());
    this.sticks = scene.bodies.map((_, number) => this.stick(number));
    this.colours = this.colourBodies();
    for (const [first, ...others] of this.superelements) for (const body of others) this.colours[body] = this.colours[first];
  }

  // Each beam with the poses of its sections, which follow those of the bodies.
  beams(poses) {
    let number = this.scene.bodies.length;
    return this.scene.beams.map(({ name, round, sections }) => {
      const own = sections.map(({ size }) => ({ pose: poses[number++], size }));
      return { name, round, sections: own };
    });
  }

  // Bodies without a shape of their own are seen as lines to what is fixed in them.
  stick(number) {
    const seats = this.scene.joints.flatMap(({ from, to }) => [from, to]).filter(({ body }) => body === number);
    const places = [...seats, ...this.scene.points.filter(({ body }) => body === number)].map(({ place }) => place);
    return places.map((place) => [[0, 0, 0], place]).filter(([a, b]) => length(minus(a, b)) > 1e-9 * this.size);
  }

  // The colours of the bodies, then of the beams.
  colourBodies() {
    let number = 0;
    const next = () => BODY_COLOURS[number++ % BODY_COLOURS.length];
    return [...this.faces.map((faces) => (faces.length > 0 ? next() : "#777777")), ...this.scene.beams.map(next)];
  }

  place(poses, body, place) {
    return body === null ? place : placed(poses[body], place);
  }

  direction(poses, body, direction) {
    return body === null ? direction : turned(poses[body].rotation, direction);
  }

  point(poses, number) {
    const { body, place } = this.scene.points[number];
    return this.place(poses, body, place);
  }
}

// One picture of a model: projects, sorts, paints.
class Painter {
  constructor(canvas, model, fine = true) {
    this.canvas = canvas;
    this.model = model;
    this.fine = fine;
    this.context = canvas.getContext("2d");
    this.azimuth = -0.9;
    this.elevation = 0.42;
    this.zoom = 1;
    this.up = model.up;
  }

  paint(poses, { ghost = false, names = false, triad = true } = {}) {
    const { canvas, context, model } = this;
    const sharp = Math.max(2, window.devicePixelRatio || 1);
    const [wide, high] = [canvas.clientWidth || canvas.width / sharp, canvas.clientHeight || canvas.height / sharp];
    if (canvas.width !== Math.round(wide * sharp) || canvas.height !== Math.round(high * sharp)) {
      canvas.width = Math.round(wide * sharp);
      canvas.height = Math.round(high * sharp);
    }
    context.setTransform(sharp, 0, 0, sharp, 0, 0);
    context.fillStyle = "#ffffff";
    context.fillRect(0, 0, wide, high);
    this.view = viewer(this.azimuth, this.elevation);
    this.factor = (0.86 * this.zoom * Math.min(wide, high * 1.25)) / model.size;
    this.origin = [wide / 2, high / 2];
    if (ghost) this.run([...this.bodies(model.rest, true), ...this.beams(model.rest, true)]);
    this.run([...this.bodies(poses, false), ...this.beams(poses, false), ...this.joints(poses), ...this.links(poses), ...this.wheels(poses)]);
    if (names) this.names(poses);
    if (triad) this.triad(wide, high);
  }

  run(jobs) {
    jobs.sort((a, b) => a.depth - b.depth);
    for (const { paint } of jobs) paint();
  }

  // Pixel and depth of a place.
  see(place) {
    const [right, up, near] = this.seen(minus(place, this.model.middle));
    return [this.origin[0] + this.factor * right, this.origin[1] - this.factor * up, near];
  }

  // Right, up and towards the viewer, of a direction of the common frame.
  seen(direction) {
    return turned(this.view, turned(this.model.upright[this.up], direction));
  }

  bodies(poses, ghost) {
    const jobs = [];
    const all = this.fine ? this.model.faces : this.model.coarse;
    all.forEach((faces, body) => {
      if (this.model.ofSuperelements.has(body)) return;
      const pose = poses[body];
      for (const { corners, smooth } of faces) {
        const there = corners.map((corner) => placed(pose, corner));
        jobs.push(...this.face(there, smooth, this.model.colours[body], ghost, this.model.vague[body] && !ghost));
      }
      if (!this.model.vague[body]) return;
      for (const ends of this.model.sticks[body]) {
        const [a, b] = ends.map((end) => this.see(placed(pose, end)));
        const colour = ghost ? "#dddddd" : faces.length > 0 ? "#444444" : REST;
        jobs.push({ depth: (a[2] + b[2]) / 2, paint: () => this.line([a, b], colour, 2) });
      }
    });
    for (const stations of this.model.superelements) {
      const faces = spokes(stations.map((body) => poses[body].position), this.model.size);
      jobs.push(...faces.flatMap(({ corners, smooth }) => this.face(corners, smooth, this.model.colours[stations[0]], ghost)));
    }
    return jobs;
  }

  // A face of the common frame, if its outside is seen.
  face(corners, smooth, own, ghost, veiled = false) {
    const seen = corners.map((corner) => this.see(corner));
    if (turns(seen) >= 0) return [];
    const depth = seen.reduce((sum, corner) => sum + corner[2], 0) / seen.length;
    const colour = ghost ? "#ececec" : this.shade(own, corners);
    return [{ depth, paint: () => this.polygon(seen, colour, ghost ? "#d8d8d8" : smooth ? colour : "rgba(0,0,0,0.35)", veiled ? 0.45 : 1) }];
  }

  // Beams as the belts between their sections; the centre line is seen however slender they are. Without a shape, a
  // stroke along the second axis says how a section stands.
  beams(poses, ghost) {
    const stroke = 0.02 * this.model.size;
    return this.model.beams(poses).flatMap(({ name, sections, round }, number) => {
      const drawn = this.fine ? smoothed(sections) : sections;
      const colour = this.model.colours[this.model.scene.bodies.length + number];
      const line = ghost ? "#dddddd" : colour;
      const path = drawn.map(({ pose }) => this.see(pose.position));
      const lines = path.slice(1).map((end, k) => [path[k], end]);
      const shaped = sections.every(({ size }) => size[0] > 0);
      if (!shaped) {
        const ends = ({ pose }) => [-stroke, stroke].map((side) => this.see(placed(pose, [0, side, 0])));
        lines.push(...sections.map(ends));
      }
      const jobs = lines.map(([a, b]) => ({ depth: (a[2] + b[2]) / 2, paint: () => this.line([a, b], line, 2) }));
      if (!shaped) return jobs;
      const faces = beamFaces(drawn, round, this.fine && this.model.shafts.has(name) ? FINE : COARSE);
      return [...jobs, ...faces.flatMap(({ corners, smooth }) => this.face(corners, smooth, colour, ghost))];
    });
  }

  joints(poses) {
    const long = 0.035 * this.model.size;
    return this.model.scene.joints.filter((joint) => !isFlexure(joint)).flatMap(({ from }) => {
      const place = this.model.place(poses, from.body, from.place);
      const seen = this.see(place);
      // In front of what it holds together.
      const depth = seen[2] + 0.02 * this.model.size;
      const jobs = [{ depth, paint: () => this.dot(seen, 2.6) }];
      if (from.axis) {
        const axis = times(long, this.model.direction(poses, from.body, from.axis));
        const ends = [minus(place, axis), plus(place, axis)].map((end) => this.see(end));
        jobs.push({ depth, paint: () => this.line(ends, "#222222", 1.4) });
      }
      return jobs;
    });
  }

  // Bushings as springs, and around a shaft as collars too.
  links(poses) {
    const collars = this.model.bearings.flatMap((bearing) =>
      collar(this.model.point(poses, bearing.seat), bearing).flatMap(({ corners }) => this.face(corners, true, LINK, false, true)));
    const lines = this.model.scene.links.map(({ kind, ends }) => {
      const [a, b] = ends.map((end) => this.see(this.model.point(poses, end)));
      const points = /spring|bushing/.test(kind) ? zigzag(a, b) : [a, b];
      const depth = (a[2] + b[2]) / 2 + 0.01 * this.model.size;
      return { depth, paint: () => this.line(points, LINK, 1.6) };
    });
    return [...collars, ...lines];
  }

  wheels(poses) {
    return this.model.scene.wheels.flatMap(({ center, axle, radius }) => {
      const middle = this.model.point(poses, center);
      const { body } = this.model.scene.points[center];
      const rim = axle ? ring(middle, this.model.direction(poses, body, axle), radius, 0) : ring(middle, [0, 0, 1], radius, 0);
      const seen = rim.map((own) => this.see(own));
      return seen.map((own, k) => {
        const next = seen[(k + 1) % seen.length];
        return { depth: (own[2] + next[2]) / 2 + 0.01 * this.model.size, paint: () => this.line([own, next], "#222222", 2) };
      });
    });
  }

  names(poses) {
    this.context.font = "12px system-ui, sans-serif";
    const { bodies } = this.model.scene;
    bodies.forEach(({ name, solids }, body) => {
      if (this.model.ofBeams.has(body) || this.model.superelements.some((stations) => stations.indexOf(body) > 0)) return;
      const [x, y] = this.see(placed(poses[body], solids[0]?.center ?? [0, 0, 0]));
      this.written(name, x + 5, y - 5);
    });
    for (const { name, sections } of this.model.beams(poses)) {
      const [x, y] = this.see(sections[Math.floor(sections.length / 2)].pose.position);
      this.written(name, x + 5, y - 5);
    }
  }

  // Words with a rim that keeps them readable on anything.
  written(text, x, y) {
    const { context } = this;
    context.lineWidth = 3;
    context.strokeStyle = "rgba(255,255,255,0.85)";
    context.strokeText(text, x, y);
    context.fillStyle = "#111111";
    context.fillText(text, x, y);
  }

  triad(wide, high) {
    const origin = [38, high - 36];
    this.context.font = "12px system-ui, sans-serif";
    ["x", "y", "z"].forEach((name, k) => {
      const [right, up] = this.seen(identity()[k]);
      const end = [origin[0] + 24 * right, origin[1] - 24 * up];
      this.line([origin, end], ["#b3261e", "#1b7a3d", "#1d4fa3"][k], 2);
      this.written(name, end[0] + (end[0] >= origin[0] ? 3 : -9), end[1] + 4);
    });
  }

  shade(colour, corners) {
    const normal = unit(cross(minus(corners[1], corners[0]), minus(corners[2], corners[1])));
    const [right, up, near] = this.seen(normal);
    const light = 0.62 + 0.38 * Math.max(0, dot([right, up, near], LIGHT));
    const part = (from) => Math.round(parseInt(colour.slice(from, from + 2), 16) * light);
    return `rgb(${part(1)},${part(3)},${part(5)})`;
  }

  polygon(points, fill, stroke, opacity) {
    const { context } = this;
    context.globalAlpha = opacity;
    context.beginPath();
    for (const [x, y] of points) context.lineTo(x, y);
    context.closePath();
    context.fillStyle = fill;
    context.fill();
    if (opacity === 1) {
      context.lineWidth = 0.6;
      context.strokeStyle = stroke;
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  line(points, colour, wide) {
    const { context } = this;
    context.beginPath();
    for (const [x, y] of points) context.lineTo(x, y);
    context.lineWidth = wide;
    context.strokeStyle = colour;
    context.stroke();
  }

  dot([x, y], radius) {
    const { context } = this;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fillStyle = "#222222";
    context.fill();
  }
}

// Negative when the corners go anticlockwise on the screen, where y points down: the outside is seen.
function turns(points) {
  let area = 0;
  points.forEach(([x, y], k) => {
    const [p, q] = points[(k + 1) % points.length];
    area += x * q - p * y;
  });
  return area;
}

function zigzag([x, y], [p, q]) {
  const long = Math.hypot(p - x, q - y);
  if (long < 12) return [[x, y], [p, q]];
  const wide = Math.min(5, 0.12 * long);
  const across = [(-wide * (q - y)) / long, (wide * (p - x)) / long];
  const inner = [0.2, 0.26, 0.38, 0.5, 0.62, 0.74, 0.8].map((share, k, all) => {
    const side = k === 0 || k === all.length - 1 ? 0 : k % 2 ? 1 : -1;
    return [x + share * (p - x) + side * across[0], y + share * (q - y) + side * across[1]];
  });
  return [[x, y], ...inner, [p, q]];
}
