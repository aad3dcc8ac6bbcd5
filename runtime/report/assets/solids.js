// Solids as flat faces, in the frame of their body: lists of corners, anticlockwise seen from outside.

// Sides of a round thing: of the large view, and of the small pictures.
const FINE = 28;
const COARSE = 12;

// The faces of a solid of a scene; what has no thickness of its own gets one that can be seen in a mechanism of this size.
function facesOf({ center, shape }, size, sides) {
  const [[kind, data]] = Object.entries(shape);
  const thin = 0.007 * size;
  switch (kind) {
    case "Point": return ball(center, Array(3).fill(0.016 * size), identity(), sides);
    case "Sphere": return ball(center, Array(3).fill(data.radius), identity(), sides);
    case "Ellipsoid": return ball(center, data.semi_axes.map((own) => Math.max(own, 0.3 * thin)), data.axes, sides);
    case "Rod": return cylinder(center, data.along, thin, data.length, sides);
    case "Disk": return cylinder(center, data.axis, data.radius, 0.6 * thin, sides);
    case "Cylinder": return cylinder(center, data.axis, data.radius, data.length, sides);
    case "Tube": return tube(center, data, sides);
    case "Box": return box(center, data.edges, data.size);
    default: return [];
  }
}

function identity() {
  return [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
}

function ring(center, axis, radius, offset, sides = FINE) {
  const [a, b] = across(axis);
  return Array.from({ length: sides }, (_, k) => {
    const angle = (2 * Math.PI * k) / sides;
    const out = plus(times(radius * Math.cos(angle), a), times(radius * Math.sin(angle), b));
    return plus(plus(center, times(offset, axis)), out);
  });
}

// Quadrangles between two rings of corners.
function belt(under, over) {
  return under.map((corner, k) => {
    const next = (k + 1) % under.length;
    return { corners: [corner, under[next], over[next], over[k]], smooth: true };
  });
}

function cylinder(center, axis, radius, long, sides) {
  const [under, over] = [-long / 2, long / 2].map((offset) => ring(center, axis, radius, offset, sides));
  return [...belt(under, over), { corners: over }, { corners: [...under].reverse() }];
}

function tube(center, { axis, inner, outer, length: long }, sides) {
  const [under, over] = [-long / 2, long / 2].map((offset) => ring(center, axis, outer, offset, sides));
  const [below, above] = [-long / 2, long / 2].map((offset) => ring(center, axis, inner, offset, sides));
  const flat = (faces) => faces.map(({ corners }) => ({ corners }));
  return [...belt(under, over), ...belt(above, below), ...flat(belt(over, above)), ...flat(belt(below, under))];
}

// Sections of a beam with two more between any two: the centre line is the cubic that has its direction at both.
function smoothed(sections) {
  const between = (a, b) => [1 / 3, 2 / 3].flatMap((share) => {
    const mix = (p, q) => p.map((value, k) => value + share * (q[k] - value));
    const chord = length(minus(b.pose.position, a.pose.position));
    if (chord === 0) return [];
    const [along, onward] = [a, b].map(({ pose }) => times(chord, turned(pose.rotation, [1, 0, 0])));
    const rest = 1 - share;
    const straight = plus(times(rest * rest * (1 + 2 * share), a.pose.position), times(share * share * (1 + 2 * rest), b.pose.position));
    const bent = plus(times(rest * rest * share, along), times(-share * share * rest, onward));
    const rotation = a.pose.rotation.map((row, k) => mix(row, b.pose.rotation[k]));
    return [{ pose: { position: plus(straight, bent), rotation }, size: mix(a.size, b.size) }];
  });
  return sections.flatMap((section, k) => (k === 0 ? [section] : [...between(sections[k - 1], section), section]));
}

// The faces of a beam between its sections, in the common frame.
function beamFaces(sections, round, sides) {
  const rims = sections.map(({ pose, size: [width, height] }) => {
    const rim = round
      ? Array.from({ length: sides }, (_, n) => (2 * Math.PI * n) / sides).map((angle) => [Math.cos(angle) / 2, Math.sin(angle) / 2])
      : [[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0.5, -0.5]];
    return rim.map(([across, up]) => placed(pose, [0, width * across, height * up]));
  });
  const belts = rims.slice(1).flatMap((over, k) => belt(rims[k], over));
  const sheath = belts.map(({ corners }) => ({ corners, smooth: round }));
  return [...sheath, { corners: rims[rims.length - 1] }, { corners: [...rims[0]].reverse() }];
}

function box(center, edges, size) {
  const half = edges.map((edge, k) => times(size[k] / 2, edge));
  const right = dot(cross(edges[0], edges[1]), edges[2]) > 0;
  const faces = [];
  for (const k of [0, 1, 2]) {
    const [a, b] = [half[(k + 1) % 3], half[(k + 2) % 3]];
    for (const side of [1, -1]) {
      const middle = plus(center, times(side, half[k]));
      const corners = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([p, q]) => plus(middle, plus(times(p, a), times(q, b))));
      faces.push({ corners: (side > 0) === right ? corners : corners.reverse() });
    }
  }
  return faces;
}

function ball(center, radii, axes, sides) {
  const columns = Math.round(0.58 * sides);
  const rows = Math.round(0.36 * sides);
  const right = dot(cross(axes[0], axes[1]), axes[2]) > 0;
  const at = (row, column) => {
    const [v, h] = [(Math.PI * row) / rows, (2 * Math.PI * column) / columns];
    const own = [Math.sin(v) * Math.cos(h), Math.sin(v) * Math.sin(h), Math.cos(v)];
    return own.reduce((sum, value, k) => plus(sum, times(value * radii[k], axes[k])), center);
  };
  const faces = [];
  for (let row = 0; row < rows; row += 1) {
    for (let column = 0; column < columns; column += 1) {
      const all = [at(row, column), at(row + 1, column), at(row + 1, column + 1), at(row, column + 1)];
      const corners = row === 0 ? all.slice(0, 3) : row === rows - 1 ? [all[0], all[1], all[3]] : all;
      faces.push({ corners: right ? corners : corners.reverse(), smooth: true });
    }
  }
  return faces;
}
