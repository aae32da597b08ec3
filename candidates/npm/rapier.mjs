// Rapier (npm's @dimforge/rapier3d-compat, compiled to WebAssembly), single precision.
//
// Calls        Shape.contactShape, which is parry's contact query: GJK, then EPA for bodies that overlap,
//              closed forms for the plane's and the sphere's pairs.
// Shapes       Cylinder and Capsule along y, turned to ours; Ball, Cuboid; HalfSpace, which passes through
//              the origin of its frame: displaced along its normal.
// Margin       None; Rapier's round shapes (RoundCylinder) are others.
// Conventions  The normal is normal1 of B if B is the plane, which has to come first, otherwise normal2,
//              which points out of B as well.
// Points       One, midway between those on both bodies.
// Threshold    The query's prediction; what lies beyond it nevertheless is dropped.
// Precision    Poses are rounded to float.
// Traps        A panic of Rust is a trap of WebAssembly: the client ends and is started again.
import { run } from '../clients/touchstone_candidate.mjs';
import { Y_TO_Z, load, middle, multiply, rotate, versionOf } from './packages.mjs';

const { default: RAPIER } = await load('@dimforge/rapier3d-compat');
await RAPIER.init();

function makeShape(shape) {
  switch (shape.shape) {
    case 'cylinder': return new RAPIER.Cylinder(shape.half_length, shape.radius);
    case 'capsule': return new RAPIER.Capsule(shape.half_length, shape.radius);
    case 'sphere': return new RAPIER.Ball(shape.radius);
    case 'box': return new RAPIER.Cuboid(...shape.half_extents);
    default: return new RAPIER.HalfSpace(toVector(shape.normal));
  }
}

const toVector = ([x, y, z]) => ({ x, y, z });
const toArray = ({ x, y, z }) => [x, y, z];
function toQuaternion(pose, alongY) {
  const [w, x, y, z] = alongY ? multiply(pose.orientation, Y_TO_Z) : pose.orientation;
  return { x, y, z, w };
}

run({
  name: 'rapier',
  version: versionOf('@dimforge/rapier3d-compat'),
  settings: 'contactShape, single precision, no margin; one point, midway between those on both bodies',
  precision: 'float',
  runs: 'wasm',
  pairs: ['cylinder-plane', 'cylinder-sphere', 'cylinder-capsule', 'cylinder-cylinder', 'cylinder-box'],

  prepare: (a, b, threshold) => ({ b, shapeA: makeShape(a), shapeB: makeShape(b), threshold,
    turned: b.shape === 'cylinder' || b.shape === 'capsule' }),

  query({ b, shapeA, shapeB, threshold, turned }, poseA, poseB) {
    const atA = toVector(poseA.position), turnA = toQuaternion(poseA, true);
    const turnB = toQuaternion(poseB, turned);
    let found, normal;
    if (b.shape === 'plane') {
      const up = rotate(poseB.orientation, b.normal);
      const atB = toVector(poseB.position.map((x, i) => x + b.displacement * up[i]));
      found = shapeB.contactShape(atB, turnB, shapeA, atA, turnA, threshold);
      normal = found && toArray(found.normal1);
    } else {
      found = shapeA.contactShape(atA, turnA, shapeB, toVector(poseB.position), turnB, threshold);
      normal = found && toArray(found.normal2);
    }
    if (!found || found.distance > threshold) return null;
    const position = middle(toArray(found.point1), toArray(found.point2));
    return { signed_distance: found.distance, normal, points: [{ position, normal, depth: -found.distance }] };
  },
});
