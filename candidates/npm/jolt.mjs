// Jolt Physics (npm's jolt-physics, compiled to WebAssembly), single precision.
//
// Calls        TransformedShape::CollideShape of the cylinder's shape (shape 1) against a
//              TransformedShape of the other body (shape 2), with the settings of a default
//              CollideShapeSettings: collision and penetration tolerance 1e-4 m. This is what a world asks
//              in its narrow phase before it clips faces to a manifold, which the package does not
//              export: one point.
// Shapes       CylinderShape and CapsuleShape along y, turned to ours; SphereShape, BoxShape, PlaneShape.
// Margin       jolt: Jolt's convex radius of 0.05 m on cylinder and box, at most half of the smallest
//              half extent (Jolt refuses more than the whole one). It is taken from the inside: faces stay
//              where they are, edges are rounded.
//              jolt-margin-0: convex radius 0. jolt-margin:M: M metres, at most the smallest half extent.
// Conventions  mPenetrationAxis moves shape 2 out; the normal is its opposite, made a unit vector.
// Points       Midway between mContactPointOn1 and mContactPointOn2.
// Threshold    mMaxSeparationDistance.
// Precision    Poses are rounded to float.
// Traps        Until a JoltInterface exists, every pair's function is null, and a query ends the program.
//
// node jolt.mjs [margin-0 | margin]
import { run } from '../clients/touchstone_candidate.mjs';
import { Y_TO_Z, load, middle, multiply, smallest, versionOf } from './packages.mjs';

const Jolt = await (await load('jolt-physics')).default();

const settings = new Jolt.JoltSettings();
settings.mObjectLayerPairFilter = new Jolt.ObjectLayerPairFilterTable(1);
settings.mBroadPhaseLayerInterface = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(
  settings.mBroadPhaseLayerInterface, 1, settings.mObjectLayerPairFilter, 1);
new Jolt.JoltInterface(settings);

const one = new Jolt.Vec3(1, 1, 1), zero = new Jolt.RVec3(0, 0, 0);
const any = new Jolt.ShapeFilter();
const position = new Jolt.RVec3(), rotation = new Jolt.Quat();

const MARGINS = {
  undefined: { name: 'jolt', says: 'convex radius 0.05 m, at most half of the smallest half extent',
    of: (shape) => Math.min(0.05, smallest(shape) / 2) },
  'margin-0': { name: 'jolt-margin-0', says: 'convex radius 0', of: () => 0 },
  margin: { name: 'jolt-margin', says: 'convex radius as given, at most the smallest half extent',
    of: (shape, margin) => Math.min(margin, smallest(shape)),
    parameter: { meaning: 'convex radius, metres', min: 0, max: 1, usual: 0.01 } },
};
const margin = MARGINS[process.argv[2]];

function makeShape(shape, convexRadius) {
  switch (shape.shape) {
    case 'cylinder': return new Jolt.CylinderShape(shape.half_length, shape.radius, convexRadius);
    case 'capsule': return new Jolt.CapsuleShape(shape.half_length, shape.radius);
    case 'sphere': return new Jolt.SphereShape(shape.radius);
    case 'box': {
      const halfExtents = new Jolt.Vec3(...shape.half_extents);
      const made = new Jolt.BoxShape(halfExtents, convexRadius);
      Jolt.destroy(halfExtents);
      return made;
    }
    default: {
      const normal = new Jolt.Vec3(...shape.normal);
      const plane = new Jolt.Plane(normal, -shape.displacement);
      const made = new Jolt.PlaneShape(plane);
      Jolt.destroy(plane);
      Jolt.destroy(normal);
      return made;
    }
  }
}

/** Sets `position` and `rotation`. */
function place(pose, alongY) {
  const [w, x, y, z] = alongY ? multiply(pose.orientation, Y_TO_Z) : pose.orientation;
  rotation.Set(x, y, z, w);
  position.Set(...pose.position);
}

// One for all pairs: a query takes its hit at once.
const hits = new Jolt.CollideShapeCollectorJS();
let hit = null;
hits.Reset = () => { hit = null; };
hits.OnBody = () => {};
hits.AddHit = (address) => {
  const found = Jolt.wrapPointer(address, Jolt.CollideShapeResult);
  const distance = -found.mPenetrationDepth;
  if (hit && hit.distance <= distance) return;
  hit = { distance, axis: toArray(found.mPenetrationAxis),
    onA: toArray(found.mContactPointOn1), onB: toArray(found.mContactPointOn2) };
};

const toArray = (v) => [v.GetX(), v.GetY(), v.GetZ()];

run({
  name: margin.name,
  version: versionOf('jolt-physics'),
  settings: `CollideShape, single precision; ${margin.says}; tolerances 1e-4; ` +
    'one point, midway between those on both bodies',
  precision: 'float',
  runs: 'wasm',
  pairs: ['cylinder-plane', 'cylinder-sphere', 'cylinder-capsule', 'cylinder-cylinder', 'cylinder-box'],
  parameter: margin.parameter,

  prepare(a, b, threshold, parameter) {
    const [shapeA, shapeB] = [a, b].map((shape) => makeShape(shape, margin.of(shape, parameter)));
    shapeA.AddRef();
    const body = new Jolt.TransformedShape();
    body.mShape = shapeB;
    const query = new Jolt.CollideShapeSettings();
    query.mMaxSeparationDistance = threshold;
    return { shapeA, body, query, turned: b.shape === 'cylinder' || b.shape === 'capsule' };
  },

  query({ shapeA, body, query, turned }, poseA, poseB) {
    place(poseB, turned);
    body.SetWorldTransform(position, rotation, one);
    place(poseA, true);
    hit = null;
    body.CollideShape(shapeA, one, Jolt.RMat44.prototype.sRotationTranslation(rotation, position), query, zero,
      hits, any);
    if (!hit) return null;
    const { distance, axis, onA, onB } = hit;
    const length = -Math.hypot(...axis);
    const normal = axis.map((x) => x / length);
    return { signed_distance: distance, normal,
      points: [{ position: middle(onA, onB), normal, depth: -distance }] };
  },

  release({ shapeA, body, query }) {
    shapeA.Release();
    Jolt.destroy(body);  // releases its shape
    Jolt.destroy(query);
  },
});
