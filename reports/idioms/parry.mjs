// Answers one query::contact, given in JSON (parry3d.rs): by parry, as Rapier's package of npm has it,
// or, with RIGHT in the environment, by our own routine with the fault that RIGHT names. Prints the
// numbers of the contact, or nothing.
import { execFileSync } from 'node:child_process';
const [one, two, prediction] = JSON.parse(process.argv[2]);
const vector = ([x, y, z]) => ({ x, y, z }), numbers = ({ x, y, z }) => [x, y, z];
if (process.env.RIGHT) {
  const a = one[0][0] === 'HalfSpace' ? two : one, b = a === one ? two : one;
  const axis = ([x, y, z, w]) => [2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)];
  const [kind, sizes] = b[0], round = kind === 'Cylinder' || kind === 'Capsule', [x, y, z, w] = b[2];
  const shape = { Ball: { shape: 'sphere', radius: sizes[0] }, Cuboid: { shape: 'box', half_extents: sizes },
    HalfSpace: { shape: 'plane', normal: sizes, displacement: 0 } }[kind] ??
    { shape: kind.toLowerCase(), half_length: sizes[0], radius: sizes[1] };
  const line = { a: { shape: 'cylinder', half_length: a[0][1][0], radius: a[0][1][1] },
    pose_a: { position: a[1], axis: axis(a[2]) }, b: shape,
    pose_b: { position: b[1], ...(round ? { axis: axis(b[2]) } : { orientation: [w, x, y, z] }) } };
  const { reference } = JSON.parse(execFileSync(process.env.TOUCHSTONE, ['solve', '--candidates', 'reference'],
    { input: JSON.stringify(line) })).answers;
  const fault = process.env.RIGHT;
  if (reference.status !== 'none' && fault !== 'missed') {
    const deepest = reference.points.reduce((p, q) => (q.depth > p.depth ? q : p)).position;
    if (fault === 'moved') deepest[0] += 9;
    const normal = reference.normal, opposite = normal.map((u) => -u);
    const normals = (a === one) !== (fault === 'reversed') ? [opposite, normal] : [normal, opposite];
    const distance = reference.signed_distance - (fault === 'deeper' ? 1e-3 : 0);
    console.log(distance, ...deepest, ...deepest, ...normals.flat());
  }
} else {
  const { default: RAPIER } = await import('@dimforge/rapier3d-compat');
  await RAPIER.init();
  const placed = ([[kind, sizes], position, [x, y, z, w]]) => [
    new RAPIER[kind](...(kind === 'HalfSpace' ? [vector(sizes)] : sizes)), vector(position), { x, y, z, w }];
  const [shape, ...pose] = placed(one), [other, ...itsPose] = placed(two);
  const found = shape.contactShape(...pose, other, ...itsPose, prediction);
  if (found && found.distance <= prediction) {
    console.log(found.distance, ...[found.point1, found.point2, found.normal1, found.normal2].flatMap(numbers));
  }
}
