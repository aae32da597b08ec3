// A cylinder against planes and spheres, in closed form.
//
// touchstone --candidate-command "node candidates/clients/example.mjs" report --count 2
import { run } from './touchstone_candidate.mjs';

const add = (u, v, scale = 1) => u.map((x, i) => x + scale * v[i]);
const dot = (u, v) => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
const cross = (u, v) =>
  [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];

// v turned by a unit quaternion: v + 2 w (q × v) + 2 q × (q × v).
function rotate([w, ...q], v) {
  const twice = cross(q, v).map((x) => 2 * x);
  return add(add(v, twice, w), cross(q, twice));
}
const rotateBack = ([w, x, y, z], v) => rotate([w, -x, -y, -z], v);

// In the cylinder's frame the plane is n·x ≤ displacement. The lowest points of both rims, and two
// more of each, which matter where a cap lies flat.
function planeContacts({ radius, half_length }, n, displacement) {
  const down = Math.hypot(n[0], n[1]) > 1e-12 ? Math.atan2(-n[1], -n[0]) : 0;
  const third = 2 * Math.PI / 3;
  return [-half_length, half_length].flatMap((z) => [down, down + third, down - third].map((angle) => {
    const onA = [radius * Math.cos(angle), radius * Math.sin(angle), z];
    return { onA, distance: dot(n, onA) - displacement };
  }));
}

// In the cylinder's frame, of a sphere about c: the way out is along the axis, across it, or away
// from the rim.
function sphereContact({ radius, half_length }, c, ofSphere) {
  const across = Math.hypot(c[0], c[1]), end = Math.sign(c[2]) || 1;
  const outward = across > 0 ? [c[0] / across, c[1] / across, 0] : [1, 0, 0];
  const u = across - radius, v = Math.abs(c[2]) - half_length;  // beyond the side, beyond the cap
  const length = u > 0 && v > 0 ? Math.hypot(u, v) : Math.max(u, v);
  const weights = u > 0 && v > 0 ? [u / length, v / length] : u > v ? [1, 0] : [0, 1];
  const n = add(outward.map((x) => weights[0] * x), [0, 0, end], weights[1]);  // from A to B
  return { n: n.map((x) => -x), onA: add(c, n, -length), distance: length - ofSphere };
}

run({
  name: 'example-closed-form',
  version: '1.0',
  settings: 'closed form; plane: three points of each rim; points halfway between the bodies',
  pairs: ['cylinder-plane', 'cylinder-sphere'],

  prepare(a, b, threshold) {
    return b.shape === 'plane' || b.shape === 'sphere' ? { a, b, threshold } : null;
  },

  query({ a, b, threshold }, poseA, poseB) {
    let n, found;
    if (b.shape === 'plane') {
      const normal = rotate(poseB.orientation, b.normal);
      const displacement = b.displacement + dot(normal, add(poseB.position, poseA.position, -1));
      n = rotateBack(poseA.orientation, normal);
      found = planeContacts(a, n, displacement);
    } else {
      const centre = rotateBack(poseA.orientation, add(poseB.position, poseA.position, -1));
      found = [sphereContact(a, centre, b.radius)];
      n = found[0].n;
    }
    found = found.filter(({ distance }) => distance <= threshold);
    if (found.length === 0) return null;
    const normal = rotate(poseA.orientation, n);
    const points = found.map(({ onA, distance }) => ({
      position: add(poseA.position, rotate(poseA.orientation, add(onA, n, -distance / 2))),
      normal,
      depth: -distance,
    }));
    return { signed_distance: Math.min(...found.map(({ distance }) => distance)), normal, points };
  },
});
