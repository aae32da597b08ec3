// Vectors and the two bodies, in coordinates whose origin is the contact, so that a view may be
// enlarged until the rounding of the doubles shows.
const add = (a, b, s = 1) => a.map((x, i) => x + s * b[i]);
const times = (a, s) => a.map(x => s * x);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const length = a => Math.hypot(...a);
const unit = a => times(a, 1 / length(a));
const combine = (axes, c) => add(add(times(axes[0], c[0]), axes[1], c[1]), axes[2], c[2]);
// A unit vector across n; of the given directions the one furthest from n decides.
function across(n, ...directions) {
  const rests = [...directions, [1, 0, 0], [0, 1, 0]].map(d => add(d, n, -dot(d, n)));
  return unit(rests.find(r => length(r) > 0.05) || rests[rests.length - 1]);
}

// The columns of the rotation of a quaternion that need not have unit length.
function axesOf(orientation) {
  const norm = Math.hypot(...orientation);
  const [w, x, y, z] = orientation.map(q => q / norm);
  return [[1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)],
          [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)],
          [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]];
}

// {shape, axes, centre, faces: convex polygons, edges: polylines}. The meshes are fine near the
// contact, coarse elsewhere. `reach` is how much of a plane is shown.
function makeBody(shape, pose, contact, reach) {
  const body = {shape, axes: axesOf(pose.orientation), centre: add(pose.position, contact, -1)};
  body.toLocal = p => body.axes.map(e => dot(e, add(p, body.centre, -1)));
  body.toWorld = c => add(body.centre, combine(body.axes, c));
  const near = body.toLocal([0, 0, 0]);
  const mesh = {cylinder: cylinderMesh, capsule: capsuleMesh, sphere: capsuleMesh, box: boxMesh,
                plane: planeMesh}[shape.shape](shape, near, reach);
  body.faces = mesh.faces.map(f => f.map(body.toWorld));
  body.edges = mesh.edges.map(e => e.map(body.toWorld));
  body.outward = mesh.normals.map(n => combine(body.axes, n));
  return body;
}

// From lo to hi in `count` steps, and ever closer around `at`.
function steps(lo, hi, count, at) {
  const values = [];
  for (let i = 0; i <= count; ++i) values.push(lo + (hi - lo) * i / count);
  for (let d = (hi - lo) / count; d > 1e-7 * (hi - lo); d /= 4) values.push(at - d, at + d);
  values.push(at);
  return values.filter(v => v >= lo && v <= hi).sort((a, b) => a - b);
}

// A solid of revolution about z from its profile [radius, z], upwards.
function revolve(profile, near, loops) {
  const at = Math.atan2(near[1], near[0]);
  const angles = steps(at - Math.PI, at + Math.PI, 48, at);
  const point = ([r, z], a) => [r * Math.cos(a), r * Math.sin(a), z];
  const faces = [], normals = [];
  for (let i = 1; i < profile.length; ++i) {
    const [low, high] = [profile[i - 1], profile[i]];
    for (let k = 1; k < angles.length; ++k) {
      const middle = (angles[k - 1] + angles[k]) / 2;
      const across = high[1] - low[1], in_ = low[0] - high[0], norm = Math.hypot(across, in_);
      if (!(norm > 0)) continue;
      faces.push([point(low, angles[k - 1]), point(low, angles[k]), point(high, angles[k]), point(high, angles[k - 1])]);
      normals.push([across / norm * Math.cos(middle), across / norm * Math.sin(middle), in_ / norm]);
    }
  }
  const edges = loops.map(p => angles.map(a => point(p, a)));
  return {faces, normals, edges};
}
function cylinderMesh({radius, half_length: h}, near) {
  const mesh = revolve([[radius, -h], [radius, h]], near, [[radius, -h], [radius, h]]);
  mesh.faces.push(mesh.edges[0], mesh.edges[1]);
  mesh.normals.push([0, 0, -1], [0, 0, 1]);
  return mesh;
}
// A sphere is a capsule of no length.
function capsuleMesh({radius, half_length: h = 0}, near) {
  const end = Math.sign(near[2]) * Math.min(h, Math.abs(near[2]));
  const latitude = Math.atan2(near[2] - end, Math.hypot(near[0], near[1]));
  const profile = s => steps(s < 0 ? -Math.PI / 2 : 0, s < 0 ? 0 : Math.PI / 2, 12, latitude)
      .map(v => [radius * Math.cos(v), s * h + radius * Math.sin(v)]);
  return revolve([...profile(-1), ...profile(1)], near, h > 0 ? [[radius, -h], [radius, h]] : [[radius, 0]]);
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
  return {faces, normals, edges: faces.map(f => [...f, f[0]])};
}
// A square of the plane about the contact, with a grid.
function planeMesh({normal, displacement}, near, reach) {
  const norm = length(normal), n = times(normal, 1 / norm);
  const foot = add(near, n, displacement / norm - dot(n, near));
  const t = across(n, [1, 0, 0]), s = cross(n, t);
  const at = (a, b) => add(add(foot, t, a * reach), s, b * reach);
  const edges = [];
  for (let i = -4; i <= 4; ++i) edges.push([at(i / 4, -1), at(i / 4, 1)], [at(-1, i / 4), at(1, i / 4)]);
  const face = [at(-1, -1), at(1, -1), at(1, 1), at(-1, 1)];
  return {faces: [face, [...face].reverse()], normals: [n, times(n, -1)], edges};
}

// The part [lo, hi] of the line p + y·d that is within a body; null where it misses.
function chord(body, p, d) {
  const o = body.toLocal(p), e = body.axes.map(axis => dot(axis, d)), s = body.shape;
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
  const side = h => both(round([o[0], o[1], 0], [e[0], e[1], 0], s.radius), slab(o[2], e[2], h));
  switch (s.shape) {
    case 'cylinder': return side(s.half_length);
    case 'sphere': return round(o, e, s.radius);
    case 'box': return both(...[0, 1, 2].map(i => slab(o[i], e[i], s.half_extents[i])));
    case 'plane': {
      const norm = length(s.normal), slope = dot(s.normal, e) / norm;
      const room = (s.displacement - dot(s.normal, o)) / norm;
      if (slope === 0) return room >= 0 ? [-Infinity, Infinity] : null;
      return slope > 0 ? [-Infinity, room / slope] : [room / slope, Infinity];
    }
    default: {  // a capsule: its side and its two ends
      const parts = [side(s.half_length), ...[-1, 1].map(end =>
          round([o[0], o[1], o[2] - end * s.half_length], e, s.radius))].filter(c => c !== null);
      return parts.length ? [Math.min(...parts.map(c => c[0])), Math.max(...parts.map(c => c[1]))] : null;
    }
  }
}
