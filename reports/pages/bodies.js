// Vectors and bodies. A view of a contact puts the origin at the contact, so that it can be enlarged until the rounding
// of doubles shows.
const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
const times = (a, s) => [s * a[0], s * a[1], s * a[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = a => Math.hypot(...a);
const unit = a => times(a, 1 / length(a));
const combine = ([a, b, c], [x, y, z]) => [a[0] * x + b[0] * y + c[0] * z, a[1] * x + b[1] * y + c[1] * z, a[2] * x + b[2] * y + c[2] * z];
// A unit vector perpendicular to n: the projection of the first direction that is not nearly parallel to n.
function across(n, ...directions) {
  const rests = [...directions, [1, 0, 0], [0, 1, 0]].map(d => add(d, n, -dot(d, n)));
  return unit(rests.find(r => length(r) > 0.05) || rests[rests.length - 1]);
}

// The columns of the rotation matrix of a quaternion w, x, y, z of any length.
function axesOf(orientation) {
  const norm = Math.hypot(...orientation);
  const [w, x, y, z] = orientation.map(q => q / norm);
  return [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
          [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
          [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]];
}

// A convex polyhedron in its own coordinates: {faces: polygons, normals: one for each face, edges: polylines, stripe:
// whether each face is pale, so that a round body is seen to turn}. Round parts have `segments` faces around and more
// close to the point `near`, unless it is null. A plane becomes a square about `near` that extends `reach` each way.
function meshOf(s, near, reach, segments = 48) {
  switch (s.shape) {
    case 'cylinder': return cylinderMesh(s, near, segments);
    case 'box': return boxMesh(s);
    case 'plane': return planeMesh(s, near, reach);
    case 'prism': return prismMesh(s);
    case 'convex': return convexMesh(s);
    default: return capsuleMesh(s, near, segments);  // a sphere is a capsule of no length
  }
}
// A mesh in the world: {shape, axes, centre, faces, outward: the faces' normals, edges, stripe}.
function placeMesh(shape, mesh, orientation, centre) {
  const axes = axesOf(orientation), toWorld = c => add(centre, combine(axes, c));
  return {shape, axes, centre, stripe: mesh.stripe, faces: mesh.faces.map(f => f.map(toWorld)),
          edges: mesh.edges.map(e => e.map(toWorld)), outward: mesh.normals.map(n => combine(axes, n))};
}
const toLocal = ({axes, centre}, p) => axes.map(e => dot(e, add(p, centre, -1)));
// A body in coordinates whose origin is the contact; its mesh is finest there.
function makeBody(shape, pose, contact, reach) {
  const centre = add(pose.position, contact, -1);
  const near = toLocal({axes: axesOf(pose.orientation), centre}, [0, 0, 0]);
  return placeMesh(shape, meshOf(shape, near, reach), pose.orientation, centre);
}

// Values from lo to hi in `count` equal steps, refined around `at` unless it is null.
function steps(lo, hi, count, at) {
  const values = [];
  for (let i = 0; i <= count; ++i) values.push(lo + (hi - lo) * i / count);
  if (at === null) return values;
  for (let d = (hi - lo) / count; d > 1e-7 * (hi - lo); d /= 4) values.push(at - d, at + d);
  values.push(at);
  return values.filter(v => v >= lo && v <= hi).sort((a, b) => a - b);
}

// Eight stripes around the z axis.
const isPale = angle => Math.floor(angle / (Math.PI / 4) + 8) % 2 === 1;
// A solid of revolution about z; its profile is a list of [radius, z] from bottom to top.
function revolve(profile, near, segments, loops) {
  const at = near && Math.atan2(near[1], near[0]), start = at === null ? -Math.PI : at - Math.PI;
  const angles = steps(start, start + 2 * Math.PI, segments, at);
  const point = ([r, z], a) => [r * Math.cos(a), r * Math.sin(a), z];
  const faces = [], normals = [], stripe = [];
  for (let i = 1; i < profile.length; ++i) {
    const [low, high] = [profile[i - 1], profile[i]];
    for (let k = 1; k < angles.length; ++k) {
      const middle = (angles[k - 1] + angles[k]) / 2;
      const across = high[1] - low[1], in_ = low[0] - high[0], norm = Math.hypot(across, in_);
      if (!(norm > 0)) continue;
      faces.push([point(low, angles[k - 1]), point(low, angles[k]), point(high, angles[k]), point(high, angles[k - 1])]);
      normals.push([across / norm * Math.cos(middle), across / norm * Math.sin(middle), in_ / norm]);
      stripe.push(isPale(middle));
    }
  }
  return {faces, normals, stripe, edges: loops.map(p => angles.map(a => point(p, a)))};
}
function cylinderMesh({radius, half_length: h}, near, segments) {
  const mesh = revolve([[radius, -h], [radius, h]], near, segments, [[radius, -h], [radius, h]]);
  for (const [end, rim] of mesh.edges.entries()) {
    const normal = [0, 0, end === 0 ? -1 : 1];
    for (let i = 0, k = 1; k < rim.length; ++k) {  // a sector for each stripe
      const pale = isPale(Math.atan2(...[1, 0].map(c => rim[k - 1][c] + rim[k][c])));
      if (k + 1 < rim.length && isPale(Math.atan2(...[1, 0].map(c => rim[k][c] + rim[k + 1][c]))) === pale) continue;
      mesh.faces.push([[0, 0, rim[0][2]], ...rim.slice(i, k + 1)]);
      mesh.normals.push(normal);
      mesh.stripe.push(pale);
      i = k;
    }
  }
  return mesh;
}
function capsuleMesh({radius, half_length: h = 0}, near, segments) {
  const end = near && Math.sign(near[2]) * Math.min(h, Math.abs(near[2]));
  const latitude = near && Math.atan2(near[2] - end, Math.hypot(near[0], near[1]));
  const profile = s => steps(s < 0 ? -Math.PI / 2 : 0, s < 0 ? 0 : Math.PI / 2, segments / 4, latitude)
      .map(v => [radius * Math.cos(v), s * h + radius * Math.sin(v)]);
  return revolve([...profile(-1), ...profile(1)], near, segments, h > 0 ? [[radius, -h], [radius, h]] : [[radius, 0]]);
}
function boxMesh({half_extents: h}) {
  const faces = [], normals = [];
  for (const k of [0, 1, 2]) {
    for (const s of [-1, 1]) {
      faces.push([[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => {
        const corner = [0, 0, 0];
        corner[k] = s * h[k]; corner[(k + 1) % 3] = a * h[(k + 1) % 3]; corner[(k + 2) % 3] = b * h[(k + 2) % 3];
        return corner;
      }));
      normals.push([0, 1, 2].map(i => i === k ? s : 0));
    }
  }
  return {faces, normals, edges: faces.map(f => [...f, f[0]]), stripe: faces.map(() => false)};
}
// A polyhedron whose faces are lists of indices of its vertices, or a polygon with one on either side.
function convexMesh({vertices, faces: indices = []}) {
  const faces = indices.map(f => f.map(i => vertices[i]));
  const normals = faces.map(([a, b, c]) => unit(cross(add(b, a, -1), add(c, a, -1))));
  return {faces, normals, edges: faces.map(f => [...f, f[0]]), stripe: faces.map(() => false)};
}
// A regular prism with its corners on the circle of its radius.
function prismMesh({sides, radius, half_length: h}) {
  const angles = Array.from({length: sides}, (_, i) => 2 * Math.PI * i / sides);
  const [low, high] = [-h, h].map(z => angles.map(a => [radius * Math.cos(a), radius * Math.sin(a), z]));
  const wall = angles.map((a, i) => [low[i], low[(i + 1) % sides], high[(i + 1) % sides], high[i]]);
  const normals = angles.map(a => [Math.cos(a + Math.PI / sides), Math.sin(a + Math.PI / sides), 0]);
  const faces = [...wall, low, high];
  return {faces, normals: [...normals, [0, 0, -1], [0, 0, 1]], edges: faces.map(f => [...f, f[0]]), stripe: faces.map(() => false)};
}
// A square of the plane with a grid.
function planeMesh({normal, displacement}, near, reach) {
  const norm = length(normal), n = times(normal, 1 / norm);
  const foot = add(near, n, displacement / norm - dot(n, near));
  const t = across(n, [1, 0, 0]), s = cross(n, t);
  const at = (a, b) => add(add(foot, t, a * reach), s, b * reach);
  const edges = [];
  for (let i = -4; i <= 4; ++i) edges.push([at(i / 4, -1), at(i / 4, 1)], [at(-1, i / 4), at(1, i / 4)]);
  const face = [at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)];
  return {faces: [face, [...face].reverse()], normals: [n, times(n, -1)], edges, stripe: [false, false]};
}

// The part [lo, hi] of the line p + y·d that is within a body; null where it misses.
function chord(body, p, d) {
  const o = toLocal(body, p), e = body.axes.map(axis => dot(axis, d)), s = body.shape;
  const round = (o, e, r) => {  // |o + y·e| <= r
    const a = dot(e, e), b = dot(o, e);
    const rest = a > 0 ? add(o, e, -b / a) : o, square = r * r - dot(rest, rest);
    if (square < 0) return null;
    if (!(a > 0)) return [-Infinity, Infinity];
    const h = Math.sqrt(square / a);
    return [-b / a - h, -b / a + h];
  };
  const slab = (o, e, h) => {  // |o + y·e| <= h
    if (e === 0) return Math.abs(o) <= h ? [-Infinity, Infinity] : null;
    const ends = [(-h - o) / e, (h - o) / e];
    return e > 0 ? ends : ends.reverse();
  };
  const both = (...parts) => {
    if (parts.includes(null)) return null;
    const lo = Math.max(...parts.map(c => c[0])), hi = Math.min(...parts.map(c => c[1]));
    return lo <= hi ? [lo, hi] : null;
  };
  const below = (n, at) => {  // n·(p + y·d − at) <= 0
    const slope = dot(n, d), room = dot(n, add(at, p, -1));
    if (slope === 0) return room >= 0 ? [-Infinity, Infinity] : null;
    return slope > 0 ? [-Infinity, room / slope] : [room / slope, Infinity];
  };
  const side = h => both(round([o[0], o[1], 0], [e[0], e[1], 0], s.radius), slab(o[2], e[2], h));
  switch (s.shape) {
    case 'cylinder': return side(s.half_length);
    case 'sphere': return round(o, e, s.radius);
    case 'box': return both(...[0, 1, 2].map(i => slab(o[i], e[i], s.half_extents[i])));
    case 'plane': return below(body.outward[0], body.faces[0][0]);
    case 'convex': {
      if (body.faces.length > 2) return both(...body.faces.map((f, i) => below(body.outward[i], f[0])));
      const [front] = body.faces, [n] = body.outward, y = dot(n, add(front[0], p, -1)) / dot(n, d);
      const walls = front.map((corner, i) => below(cross(add(front[(i + 1) % front.length], corner, -1), n), corner));
      return both(Number.isFinite(y) ? [y, y] : null, ...walls);
    }
    default: {  // a capsule: its side and its two ends
      const parts = [side(s.half_length), ...[-1, 1].map(end =>
          round([o[0], o[1], o[2] - end * s.half_length], e, s.radius))].filter(c => c !== null);
      return parts.length ? [Math.min(...parts.map(c => c[0])), Math.max(...parts.map(c => c[1]))] : null;
    }
  }
}

// The support function of a bounded body about its centre: how far the body extends along n.
function extentAlong({shape: s, axes}, n) {
  if (s.shape === 'convex') return Math.max(...s.vertices.map(v => dot(combine(axes, v), n)));
  if (s.shape === 'box') return s.half_extents.reduce((sum, h, i) => sum + h * Math.abs(dot(axes[i], n)), 0);
  const along = Math.abs(dot(axes[2], n)), h = (s.half_length || 0) * along;
  return h + s.radius * (s.shape === 'cylinder' ? Math.sqrt(Math.max(0, 1 - along * along)) : 1);
}
// A plane between two bounded bodies, {normal: from B to A, at: its distance from the origin}. Its normal is the direction
// with the largest gap among those of the bodies' features: enough to tell which body hides the other.
function planeBetween(a, b) {
  const d = add(a.centre, b.centre, -1), radial = [a, b].map(({axes}) => add(d, axes[2], -dot(d, axes[2])));
  const directions = [d, ...a.axes, ...b.axes, ...radial, ...[a, b].flatMap(({shape, outward}) => shape.shape === 'convex' ? outward : []), ...a.axes.flatMap(e => b.axes.map(f => cross(e, f)))];
  let best = {gap: -Infinity};
  for (const direction of directions) {
    const size = length(direction);
    if (!(size > 1e-9)) continue;
    const n = times(direction, (dot(direction, d) < 0 ? -1 : 1) / size);
    const lowA = dot(a.centre, n) - extentAlong(a, times(n, -1)), highB = dot(b.centre, n) + extentAlong(b, n);
    if (lowA - highB > best.gap) best = {gap: lowA - highB, normal: n, at: (lowA + highB) / 2};
  }
  return best;
}
