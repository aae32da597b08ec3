// Havok Physics (npm's @babylonjs/havok, the binary for WebAssembly), single precision.
//
// Calls        HP_World_ShapeProximityWithCollector: the nearest point of the body of B, alone in a
//              world, to the cylinder's shape; the distance is negative inside. The body is added
//              before the query and removed after it, for a world of its own takes 0.3 MB a pair;
//              both are timed.
// Shapes       HP_Shape_CreateCylinder and CreateCapsule by their end points on z, CreateSphere,
//              CreateBox (whole extents). There is no plane. Havok's cylinder is a prism of 16
//              sides with its corners on the rims: 1.9% of the radius are missing between two
//              corners. HP_Shape_CreateConvexHull of a convex body's vertices; one in one plane
//              comes out 10 to 15 mm thicker on both sides. havok-floor:N: HP_Shape_CreateMesh of
//              the plane's or box's triangles (floor.mjs).
// Margin       As Havok makes them; there is no call to set one. Edges are rounded by about 0.015
//              m.
// Conventions  The contact on the queried shape comes in that shape's frame, the one on B in the
//              world's. The normal is that on B, which points out of it.
// Points       One, midway between those on both bodies.
// Casts        HP_World_ShapeCastWithCollector, the first hit; its normal is that on B.
// Threshold    The query's maximum distance.
// Precision    Poses are rounded to float.
//
// node havok.mjs [floor]
import { run } from '../clients/touchstone_candidate.mjs';
import fs from 'node:fs';
import path from 'node:path';
import { FLOOR, makeFloor } from './floor.mjs';
import { folderOf, load, middle, named, refuse, rotate, versionOf } from './packages.mjs';

const { default: start } = await load('@babylonjs/havok');
const havok = await start({
  wasmBinary: fs.readFileSync(path.join(folderOf('@babylonjs/havok'), 'lib/esm/HavokPhysics.wasm')),
});

if (!havok.HP_World_ShapeProximityWithCollector) {
  refuse('it has no HP_World_ShapeProximityWithCollector');
}

/** The value of a call, which Havok pairs with a result code. */
function checked([code, value]) {
  if (code !== havok.Result.RESULT_OK) throw new Error(`Havok answers ${JSON.stringify(code)}`);
  return value;
}

function makeShape(shape) {
  const origin = [0, 0, 0], ends = [-1, 1].map((side) => [0, 0, side * shape.half_length]);
  switch (shape.shape) {
    case 'cylinder': return checked(havok.HP_Shape_CreateCylinder(...ends, shape.radius));
    case 'capsule': return checked(havok.HP_Shape_CreateCapsule(...ends, shape.radius));
    case 'sphere': return checked(havok.HP_Shape_CreateSphere(origin, shape.radius));
    case 'box': return checked(
      havok.HP_Shape_CreateBox(origin, [0, 0, 0, 1], shape.half_extents.map((x) => 2 * x)));
    case 'convex': return makeHull(shape.vertices);
    case 'floor': return makeMesh(shape);
    default: return null;
  }
}

function makeHull(vertices) {
  const numbers = vertices.flat(), address = havok._malloc(4 * numbers.length);
  havok.HEAPF32.set(numbers, address / 4);
  const made = havok.HP_Shape_CreateConvexHull(address, vertices.length);
  havok._free(address);
  return checked(made);
}

function makeMesh({ corners, triangles }) {
  const numbers = corners.flat(), indices = triangles.flat();
  const address = havok._malloc(4 * (numbers.length + indices.length));
  havok.HEAPF32.set(numbers, address / 4);
  havok.HEAP32.set(indices, address / 4 + numbers.length);
  const made = havok.HP_Shape_CreateMesh(
    address, corners.length, address + 4 * numbers.length, triangles.length);
  havok._free(address);
  return checked(made);
}

const hasFloor = process.argv[2] === 'floor';
const world = checked(havok.HP_World_Create());
const collector = checked(havok.HP_QueryCollector_Create(1));
const toXyzw = ([w, x, y, z]) => [x, y, z, w];

/** What `ask` returns while the body is the world's only one. */
function withBody(body, { position, orientation }, ask) {
  havok.HP_Body_SetQTransform(body, [position, toXyzw(orientation)]);
  havok.HP_World_AddBody(world, body, false);
  try {
    return ask();
  } finally {
    havok.HP_World_RemoveBody(world, body);
  }
}

run({
  name: named(hasFloor ? 'havok-floor' : 'havok'),
  version: versionOf('@babylonjs/havok'),
  settings: (hasFloor ? 'plane or box as a mesh of N by N squares of two triangles; ' : '') +
    'ShapeProximity query of a world with one body, single precision, margins as made (a ' +
    'cylinder is a rounded prism of 16 sides); one point, midway between those on both bodies',
  precision: 'float',
  runs: 'wasm',
  pairs: ['sphere', 'capsule', 'cylinder', 'box', 'convex'].map((b) => `cylinder-${b}`),
  ...hasFloor ? FLOOR : {},

  prepare(a, b, threshold, count) {
    const floor = hasFloor ? makeFloor(a, b, count) : null;
    if (hasFloor ? !floor : b.shape === 'plane') return null;
    const [shapeA, shapeB] = [a, floor ?? b].map(makeShape);
    const body = checked(havok.HP_Body_Create());
    havok.HP_Body_SetShape(body, shapeB);
    havok.HP_Body_SetMotionType(body, havok.MotionType.STATIC);
    return { shapeA, shapeB, body, floor, threshold };
  },

  query({ shapeA, body, floor, threshold }, poseA, poseB) {
    return withBody(body, floor ? floor.at(poseA, poseB) : poseB, () => {
      havok.HP_World_ShapeProximityWithCollector(world, collector,
        [shapeA, poseA.position, toXyzw(poseA.orientation), threshold, false, [0n]]);
      if (checked(havok.HP_QueryCollector_GetNumHits(collector)) === 0) return null;
      const [distance, onA, onB] =
        checked(havok.HP_QueryCollector_GetShapeProximityResult(collector, 0));
      // After body, collider and path.
      const [, , , pointOnA] = onA, [, , , pointOnB, normal] = onB;
      if (distance > threshold) return null;
      const inWorld = rotate(poseA.orientation, pointOnA).map((x, i) => x + poseA.position[i]);
      return { signed_distance: distance, normal,
        points: [{ position: middle(inWorld, pointOnB), normal, depth: -distance }] };
    });
  },

  cast: hasFloor ? undefined : ({ shapeA, body }, poseA, poseB, sweep) =>
    withBody(body, poseB, () => {
      const end = poseA.position.map((x, i) => x + sweep[i]);
      havok.HP_World_ShapeCastWithCollector(world, collector,
        [shapeA, toXyzw(poseA.orientation), poseA.position, end, false, [0n]]);
      if (checked(havok.HP_QueryCollector_GetNumHits(collector)) === 0) return null;
      const [fraction, , [, , , , normal]] =
        checked(havok.HP_QueryCollector_GetShapeCastResult(collector, 0));
      return { fraction, normal };
    }),

  release({ shapeA, shapeB, body }) {
    havok.HP_Body_Release(body);
    havok.HP_Shape_Release(shapeA);
    havok.HP_Shape_Release(shapeB);
  },
});
