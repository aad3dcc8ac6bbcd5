// What stands on stations: shafts with their bearings, and superelements.

// Of a beam, a shaft or a superelement: no joint that one sees.
function isFlexure({ kind }) {
  return kind === "flexure" || kind === "station";
}

function shaftsOf({ beams, joints }) {
  return beams.filter((beam) => joints.some(({ name, kind }) => kind === "station" && name === beam.name));
}

// The bodies of the stations of each superelement, which follow each other and are called after the first.
function superelementsOf({ bodies, joints }) {
  const all = [];
  let first;
  for (const { name, kind, to } of joints) {
    if (kind !== "station" || bodies[to.body].solids.length === 0) continue;
    if (first === undefined || !name.startsWith(`${first}_station_`)) {
      first = name;
      all.push([]);
    }
    all[all.length - 1].push(to.body);
  }
  return all;
}

// The faces of rods from stations to their middle, in the common frame: they meet there as the stations move.
function spokes(stations, size) {
  const middle = times(1 / stations.length, stations.reduce(plus));
  return stations.flatMap((station) => {
    const arm = minus(middle, station);
    const rod = { center: plus(station, times(0.5, arm)), shape: { Rod: { along: unit(arm), length: length(arm) } } };
    return facesOf(rod, size, COARSE);
  });
}

// Bushings around a shaft: the point that each stands on, the direction and the radius of the shaft there.
function bearingsOf({ beams, bodies, joints, links, points }) {
  const onStations = new Set(joints.filter(({ kind }) => kind === "station").map(({ to }) => to.body));
  const sections = shaftsOf({ beams, joints }).flatMap((shaft) => shaft.sections);
  const at = ({ body, place }) => (body === null ? place : placed(bodies[body].pose, place));
  return links.flatMap(({ kind, ends }) => {
    const journal = ends.find((end) => onStations.has(points[end].body) && bodies[points[end].body].solids.length === 0);
    if (kind !== "bushing" || journal === undefined) return [];
    const seat = ends.find((end) => end !== journal) ?? journal;
    const place = at(points[journal]);
    const away = ({ pose }) => length(minus(pose.position, place));
    const nearest = Math.min(...sections.map(away));
    const there = sections.filter((section) => away(section) <= nearest + 1e-9);
    const radius = Math.max(...there.map((section) => section.size[0])) / 2;
    if (radius === 0 || length(minus(at(points[seat]), place)) > radius) return [];
    return [{ seat, axis: turned(there[0].pose.rotation, [1, 0, 0]), radius }];
  });
}

// The faces of a bearing, a collar.
function collar(center, { axis, radius }) {
  return tube(center, { axis, inner: radius, outer: 1.35 * radius, length: 0.6 * radius }, COARSE);
}
