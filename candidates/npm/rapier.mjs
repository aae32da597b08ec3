// Rapier (npm's @dimforge/rapier3d-compat, compiled to WebAssembly), single precision.
//
// Calls        rapier: Shape.contactShape, which is parry's contact query: GJK, then EPA for bodies
//              that overlap, closed forms for the plane's and the sphere's pairs.
//              rapier-world: both bodies are added to a world without gravity, which takes one step
//              of 1 µs, and the manifolds of World.contactPair are taken; then they are removed, so
//              that nothing is left of the pair. All of it is timed.
// Shapes       Cylinder and Capsule along y, turned to ours; Ball, Cuboid; HalfSpace, which passes
//              through the origin of its frame: displaced along its normal; ConvexPolyhedron of a
//              convex body's vertices, be they in one plane or not, Triangle of three.
//              rapier-floor:N: TriMesh of the plane's or box's triangles (floor.mjs), in a world;
//              rapier-floor-edges:N: the same with FIX_INTERNAL_EDGES.
// Margin       None; Rapier's round shapes (RoundCylinder) are others.
// Conventions  The normal is normal1 of B if B is the plane, which has to come first, otherwise
//              normal2, which points out of B as well. A manifold's normal points from its first
//              body to its second, which may be either.
// Points       Midway between those on both bodies; of a query one, of a floor the 16 deepest.
// Casts        rapier: Shape.castShape with target distance 0, which stops at a penetration; B is the
//              first shape and stands still, and the normal is its outward one, in its own frame.
// Threshold    The query's prediction; the world's prediction distance, at least its own of 2 mm.
//              What lies beyond the threshold nevertheless is dropped.
// Precision    Poses are rounded to float.
// Traps        A panic of Rust is a trap of WebAssembly: the client ends and is started again.
//
// node rapier.mjs [world | floor | floor-edges]
import { run } from '../clients/touchstone_candidate.mjs';
import { FLOOR, makeFloor } from './floor.mjs';
import {
  ALL_PAIRS, Y_TO_Z, load, middle, multiply, named, refuse, rotate, versionOf,
} from './packages.mjs';

const { default: RAPIER } = await load('@dimforge/rapier3d-compat');
await RAPIER.init();

const mode = process.argv[2];
if (!RAPIER.Shape.prototype.contactShape) refuse('it has no Shape.contactShape');
if (mode === 'floor-edges' && !RAPIER.TriMeshFlags?.FIX_INTERNAL_EDGES) {
  refuse('it has no TriMeshFlags.FIX_INTERNAL_EDGES');
}
// Before 0.13 a cast has no target distance, and its time is `toi`.
const TARGET = RAPIER.Shape.prototype.castShape?.length < 10 ? [] : [0];

function makeShape(shape) {
  switch (shape.shape) {
    case 'cylinder': return new RAPIER.Cylinder(shape.half_length, shape.radius);
    case 'capsule': return new RAPIER.Capsule(shape.half_length, shape.radius);
    case 'sphere': return new RAPIER.Ball(shape.radius);
    case 'box': return new RAPIER.Cuboid(...shape.half_extents);
    case 'convex': return shape.vertices.length === 3
      ? new RAPIER.Triangle(...shape.vertices.map(toVector))
      : new RAPIER.ConvexPolyhedron(new Float32Array(shape.vertices.flat()));
    case 'floor': return new RAPIER.TriMesh(new Float32Array(shape.corners.flat()),
      new Uint32Array(shape.triangles.flat()),
      mode === 'floor-edges' ? RAPIER.TriMeshFlags.FIX_INTERNAL_EDGES : undefined);
    default: return new RAPIER.HalfSpace(toVector(shape.normal));
  }
}

const toVector = ([x, y, z]) => ({ x, y, z });
const toArray = ({ x, y, z }) => [x, y, z];
const isAlongY = (shape) => shape.shape === 'cylinder' || shape.shape === 'capsule';
function toQuaternion(pose, alongY) {
  const [w, x, y, z] = alongY ? multiply(pose.orientation, Y_TO_Z) : pose.orientation;
  return { x, y, z, w };
}

/** The place of a half-space, whose origin lies on its surface. */
function onPlane(plane, pose) {
  const up = rotate(pose.orientation, plane.normal);
  return toVector(pose.position.map((x, i) => x + plane.displacement * up[i]));
}

const byQuery = {
  name: 'rapier',
  settings: 'contactShape, single precision, no margin; one point, midway between those on both ' +
    'bodies',

  prepare: (a, b, threshold) => ({ b, shapeA: makeShape(a), shapeB: makeShape(b), threshold }),

  query({ b, shapeA, shapeB, threshold }, poseA, poseB) {
    const atA = toVector(poseA.position), turnA = toQuaternion(poseA, true);
    const turnB = toQuaternion(poseB, isAlongY(b));
    let found, normal;
    if (b.shape === 'plane') {
      found = shapeB.contactShape(onPlane(b, poseB), turnB, shapeA, atA, turnA, threshold);
      normal = found && toArray(found.normal1);
    } else {
      found = shapeA.contactShape(atA, turnA, shapeB, toVector(poseB.position), turnB, threshold);
      normal = found && toArray(found.normal2);
    }
    if (!found || found.distance > threshold) return null;
    const position = middle(toArray(found.point1), toArray(found.point2));
    return { signed_distance: found.distance, normal,
      points: [{ position, normal, depth: -found.distance }] };
  },

  cast({ b, shapeA, shapeB }, poseA, poseB, sweep) {
    const atB = b.shape === 'plane' ? onPlane(b, poseB) : toVector(poseB.position);
    const turnB = toQuaternion(poseB, isAlongY(b)), still = toVector([0, 0, 0]);
    const found = shapeB.castShape(atB, turnB, still, shapeA, toVector(poseA.position),
      toQuaternion(poseA, true), toVector(sweep), ...TARGET, 1, true);
    if (!found) return null;
    const normal = rotate([turnB.w, turnB.x, turnB.y, turnB.z], toArray(found.normal1));
    return { fraction: found.time_of_impact ?? found.toi, normal };
  },
};

const world = new RAPIER.World({ x: 0, y: 0, z: 0 });
world.timestep = 1e-6;
// Before 0.13 the distance is not one of a normal length.
const PREDICTION = ['normalizedPredictionDistance', 'predictionDistance']
  .find((name) => name in world.integrationParameters);
// Before 0.14 a step looks for contacts once more when it has moved the bodies: A is held.
const isHeld = /^0[.]([0-9]|1[0-3])[.]/.test(versionOf('@dimforge/rapier3d-compat'));
function makeBodyA() {
  const body = RAPIER.RigidBodyDesc.dynamic();
  return isHeld ? body.lockTranslations().lockRotations() : body;
}
const OWN_PREDICTION = world.integrationParameters[PREDICTION];

const byWorld = {
  name: 'rapier-world',
  settings: 'contactPair after a step of a world, single precision, no margin; points midway ' +
    'between the bodies',

  prepare: (a, b, threshold) => ({ b, threshold, bodyA: makeBodyA(),
    bodyB: RAPIER.RigidBodyDesc.fixed(), colliderA: new RAPIER.ColliderDesc(makeShape(a)),
    colliderB: new RAPIER.ColliderDesc(makeShape(b)) }),

  query({ b, threshold, bodyA, bodyB, colliderA, colliderB }, poseA, poseB) {
    const atA = toVector(poseA.position), turnA = toQuaternion(poseA, true);
    const placeB = b.shape === 'floor' ? b.at(poseA, poseB) : poseB;
    const atB = b.shape === 'plane' ? onPlane(b, poseB) : toVector(placeB.position);
    const turnB = toQuaternion(placeB, isAlongY(b));
    world.integrationParameters[PREDICTION] = Math.max(OWN_PREDICTION, threshold);
    bodyA.setTranslation(atA.x, atA.y, atA.z).setRotation(turnA);
    bodyB.setTranslation(atB.x, atB.y, atB.z).setRotation(turnB);
    const [madeB, madeA] = [bodyB, bodyA].map((body) => world.createRigidBody(body));
    const inB = world.createCollider(colliderB, madeB);
    const inA = world.createCollider(colliderA, madeA);
    try {
      world.step();
      const points = [];
      const place = ({ x, y, z, w }, at, v) =>
        rotate([w, x, y, z], toArray(v)).map((u, i) => u + at[i]);
      world.contactPair(inA, inB, (manifold, flipped) => {
        const sign = flipped ? 1 : -1;
        const normal = toArray(manifold.normal()).map((x) => sign * x);
        for (let i = 0; i < manifold.numContacts(); ++i) {
          const distance = manifold.contactDist(i);
          if (distance > threshold) continue;
          const ends = [manifold.localContactPoint1(i), manifold.localContactPoint2(i)];
          const [onA, onB] = flipped ? ends.reverse() : ends;
          points.push({ depth: -distance, normal, position: middle(
            place(turnA, toArray(atA), onA), place(turnB, toArray(atB), onB)) });
        }
      });
      if (points.length === 0) return null;
      const deepest = points.reduce((u, v) => v.depth > u.depth ? v : u);
      points.sort((u, v) => v.depth - u.depth);
      return { signed_distance: -deepest.depth, normal: deepest.normal,
        points: points.slice(0, 16) };
    } finally {
      world.removeRigidBody(madeA);
      world.removeRigidBody(madeB);
    }
  },
};

const onFloor = {
  ...byWorld,
  ...FLOOR,
  name: `rapier-${mode}`,
  settings: `plane or box as TriMesh${mode === 'floor-edges' ? ' with FIX_INTERNAL_EDGES' : ''} ` +
    `of N by N squares of two triangles; ${byWorld.settings}`,
  prepare(a, b, threshold, count) {
    const floor = makeFloor(a, b, count);
    return floor && byWorld.prepare(a, floor, threshold);
  },
};

const asked = { world: byWorld, floor: onFloor, 'floor-edges': onFloor }[mode] ?? byQuery;
run({
  pairs: ALL_PAIRS,
  ...asked,
  name: named(asked.name),
  version: versionOf('@dimforge/rapier3d-compat'),
  precision: 'float',
  runs: 'wasm',
});
