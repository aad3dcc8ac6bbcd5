// Vectors and poses in space. A pose sees a vector `r` of its frame at `position + rotation r`.

const plus = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (factor, a) => [factor * a[0], factor * a[1], factor * a[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = (a) => Math.hypot(a[0], a[1], a[2]);
const unit = (a) => times(1 / (length(a) || 1), a);
const turned = (rows, a) => [dot(rows[0], a), dot(rows[1], a), dot(rows[2], a)];
const placed = ({ position, rotation }, a) => plus(position, turned(rotation, a));

// Two unit vectors that are perpendicular to a third and to each other.
function across(axis) {
  const away = Math.abs(axis[0]) < 0.7 ? [1, 0, 0] : [0, 1, 0];
  const first = unit(cross(axis, away));
  return [first, cross(axis, first)];
}

// A pose of twelve numbers: position, then the rows of the rotation.
function poseOf(numbers, at) {
  const three = (k) => [numbers[at + k], numbers[at + k + 1], numbers[at + k + 2]];
  return { position: three(0), rotation: [three(3), three(6), three(9)] };
}

// Between two poses that are near each other.
function between(a, b, share) {
  const mix = (p, q) => p.map((value, k) => value + share * (q[k] - value));
  return { position: mix(a.position, b.position), rotation: a.rotation.map((row, k) => mix(row, b.rotation[k])) };
}

// The rotation of a viewer who stands at an azimuth and an elevation: right, up and towards the viewer.
function viewer(azimuth, elevation) {
  const [c, s] = [Math.cos(azimuth), Math.sin(azimuth)];
  const [u, v] = [Math.cos(elevation), Math.sin(elevation)];
  return [[-s, c, 0], [-c * v, -s * v, u], [c * u, s * u, v]];
}
