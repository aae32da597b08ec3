// PhysX 5.6.1 (npm's physx-js-webidl, compiled to WebAssembly), single precision.
//
// Calls        physx: PxGjkQuery::proximityInfo, GJK and EPA, which a scene asks for convex cores;
//              the plane has no such query and is asked as by physx-world.
//              physx-world: both bodies are added to a scene without gravity, which takes one step
//              of 1 µs, and the points of its contact report are taken; then they are removed, so
//              that nothing is left of the pair. All of it is timed.
// Shapes       PxConvexCoreGeometry of a PxConvexCoreCylinder, along x, turned to ours, height a
//              full one; PxCapsuleGeometry along x; PxSphereGeometry, PxBoxGeometry,
//              PxPlaneGeometry, solid below x = 0; a PxConvexMesh of a convex body's vertices. Of
//              more than 255 of them PhysX leaves some out; of those in one plane it makes a box
//              about them that is 20 mm thick, and smaller bodies than 1 mm it enlarges.
//              physx-floor:N: PxTriangleMesh of the plane's or box's triangles (floor.mjs), in a
//              scene.
// Margin       0 on all; the tolerance length of 1 m is PhysX's default.
// Conventions  separatingAxis, and the normal of a contact report, points from the second body to
//              the first.
// Points       Midway between pointA and pointB; of a scene as in the report.
// Casts        physx: PxGjkQuery::sweep, which moves the second body: it is asked with the opposite
//              direction, and its normal is reversed. It stops 0.1 mm short. The plane has none.
// Threshold    The query's contactDistance; in the scene, contacts beyond it are dropped. A contact
//              offset of a thousandth of the cylinder's smaller size beyond the threshold is set,
//              for PhysX wants more than zero.
// Precision    Poses are rounded to float.
// Traps        The package is built for browsers alone, and refuses to load where it sees node.
//
// node physx.mjs [world | floor]
import { run } from '../clients/touchstone_candidate.mjs';
import fs from 'node:fs';
import path from 'node:path';
import { FLOOR, makeFloor } from './floor.mjs';
import {
  ALL_PAIRS, folderOf, load, middle, multiply, named, refuse, rotate, smallest, turn, versionOf,
} from './packages.mjs';

const PhysX = await loadAsInBrowser();
const VERSION = [24, 16, 8].map((bits) => PhysX.PHYSICS_VERSION >> bits & 255).join('.');
if (!PhysX.PxConvexCoreCylinder) refuse(`PhysX ${VERSION} has no cylinder (PxConvexCoreCylinder)`);
const { PxTopLevelFunctions: Px, PxConvexCoreGeometryFactory: Cores, PxGjkQuery: Gjk } =
  Object.fromEntries(['PxTopLevelFunctions', 'PxConvexCoreGeometryFactory', 'PxGjkQuery']
    .map((name) => [name, PhysX[name].prototype]));

async function loadAsInBrowser() {
  const wasmBinary = fs.readFileSync(path.join(folderOf('physx-js-webidl'), 'physx-js-webidl.wasm'));
  const { default: start } = await load('physx-js-webidl');
  const { process } = globalThis;
  globalThis.process = undefined;
  globalThis.window = globalThis;
  try {
    return await start({ wasmBinary });
  } finally {
    globalThis.process = process;
    delete globalThis.window;
  }
}

const X_TO_Z = [Math.SQRT1_2, 0, -Math.SQRT1_2, 0];
const TOLERANCE_LENGTH = 1, STEP = 1e-6, MAX_POINTS = 16;

const scene = makeScene();
const material = scene.physics.createMaterial(0.5, 0.5, 0);
const poseOfA = new PhysX.PxTransform(PhysX.PxIDENTITYEnum.PxIdentity);
const poseOfB = new PhysX.PxTransform(PhysX.PxIDENTITYEnum.PxIdentity);
const result = new PhysX.PxGjkQueryProximityInfoResult();
const swept = new PhysX.PxGjkQuerySweepResult(), direction = new PhysX.PxVec3(0, 0, 0);
const cooking = new PhysX.PxCookingParams(new PhysX.PxTolerancesScale());

function makeScene() {
  const foundation = Px.CreateFoundation(PhysX.PHYSICS_VERSION, new PhysX.PxDefaultAllocator(),
    new PhysX.PxDefaultErrorCallback());
  const scale = new PhysX.PxTolerancesScale();
  const physics = Px.CreatePhysics(PhysX.PHYSICS_VERSION, foundation, scale);
  const description = new PhysX.PxSceneDesc(scale);
  description.gravity = new PhysX.PxVec3(0, 0, 0);
  description.cpuDispatcher = Px.DefaultCpuDispatcherCreate(0);
  const shader = new PhysX.PassThroughFilterShaderImpl();
  const flags = PhysX.PxPairFlagEnum;
  shader.filterShader = () => {
    shader.outputPairFlags = flags.eDETECT_DISCRETE_CONTACT | flags.eNOTIFY_TOUCH_FOUND |
      flags.eNOTIFY_CONTACT_POINTS;
    return 0;
  };
  Px.setupPassThroughFilterShader(description, shader);
  const made = { physics, points: null, shapeOfA: null };
  const reports = new PhysX.PxSimulationEventCallbackImpl();
  const points = new PhysX.PxArray_PxContactPairPoint(MAX_POINTS);
  reports.onContact = (header, pairs) => {
    const pair = PhysX.NativeArrayHelpers.prototype.getContactPairAt(
      PhysX.wrapPointer(pairs, PhysX.PxContactPair), 0);
    const sign = PhysX.getPointer(pair.get_shapes(0)) === PhysX.getPointer(made.shapeOfA) ? 1 : -1;
    const count = pair.extractContacts(points.begin(), MAX_POINTS);
    made.points = Array.from({ length: count }, (_, i) => {
      const point = points.get(i);
      const normal = toArray(point.normal).map((x) => sign * x);
      return { position: toArray(point.position), normal, depth: -point.separation };
    });
  };
  for (const name of ['onConstraintBreak', 'onWake', 'onSleep', 'onTrigger']) {
    reports[name] = () => {};
  }
  description.simulationEventCallback = reports;
  made.scene = physics.createScene(description);
  return made;
}

const toArray = (v) => [v.x, v.y, v.z];

function place(transform, [x, y, z], [w, qx, qy, qz]) {
  const { p, q } = transform;
  p.x = x; p.y = y; p.z = z;
  q.x = qx; q.y = qy; q.z = qz; q.w = w;
}

function makeGeometry(shape) {
  switch (shape.shape) {
    case 'cylinder': {
      const core = new PhysX.PxConvexCoreCylinder(2 * shape.half_length, shape.radius);
      const made = Cores.createFromCylinder(core, 0);
      PhysX.destroy(core);
      return made;
    }
    case 'capsule': return new PhysX.PxCapsuleGeometry(shape.radius, shape.half_length);
    case 'sphere': return new PhysX.PxSphereGeometry(shape.radius);
    case 'box': return new PhysX.PxBoxGeometry(...shape.half_extents);
    case 'convex': return makeHull(shape.vertices);
    case 'floor': return makeMesh(shape);
    default: return new PhysX.PxPlaneGeometry();
  }
}

const meshes = new Map();  // by their geometries

function makePoints(vertices) {
  const points = new PhysX.PxArray_PxVec3(vertices.length), point = new PhysX.PxVec3(0, 0, 0);
  vertices.forEach(([x, y, z], i) => {
    point.x = x; point.y = y; point.z = z;
    points.set(i, point);
  });
  PhysX.destroy(point);
  return points;
}

function makeMesh({ corners, triangles }) {
  const points = makePoints(corners), indices = new PhysX.PxArray_PxU32(3 * triangles.length);
  triangles.flat().forEach((corner, i) => indices.set(i, corner));
  const description = new PhysX.PxTriangleMeshDesc();
  description.points.count = corners.length;
  description.points.stride = 12;
  description.points.data = points.begin();
  description.triangles.count = triangles.length;
  description.triangles.stride = 12;
  description.triangles.data = indices.begin();
  const mesh = Px.CreateTriangleMesh(cooking, description);
  for (const made of [points, indices, description]) PhysX.destroy(made);
  const geometry = new PhysX.PxTriangleMeshGeometry(mesh);
  meshes.set(geometry, mesh);
  return geometry;
}

/** Null if PhysX makes no mesh of the vertices. */
function makeHull(vertices) {
  const points = makePoints(vertices);
  const description = new PhysX.PxConvexMeshDesc();
  description.points.count = vertices.length;
  description.points.stride = 12;
  description.points.data = points.begin();
  description.flags = new PhysX.PxConvexFlags(PhysX.PxConvexFlagEnum.eCOMPUTE_CONVEX);
  const mesh = Px.CreateConvexMesh(cooking, description);
  for (const made of [points, description]) PhysX.destroy(made);
  if (PhysX.getPointer(mesh) === 0) return null;
  const geometry = new PhysX.PxConvexMeshGeometry(mesh);
  meshes.set(geometry, mesh);
  return geometry;
}

/** Where PhysX has B's frame: a capsule along x, a plane's surface through the origin across x. */
function frameOfB(b, { position, orientation }) {
  if (b.shape === 'cylinder' || b.shape === 'capsule') {
    return [position, multiply(orientation, X_TO_Z)];
  }
  if (b.shape !== 'plane') return [position, orientation];
  const up = rotate(orientation, b.normal);
  return [position.map((x, i) => x + b.displacement * up[i]),
    multiply(orientation, turn([1, 0, 0], b.normal))];
}

/** Two supports for PxGjkQuery. */
function prepareQuery(a, b, geometries, threshold) {
  const supports = geometries.map((geometry) => new PhysX.ConvexGeomSupport(geometry, 0));
  return { geometries, supports, b, threshold };
}

function ask({ supports, b, threshold }, poseA, poseB) {
  place(poseOfA, poseA.position, multiply(poseA.orientation, X_TO_Z));
  place(poseOfB, ...frameOfB(b, poseB));
  const found =
    Gjk.proximityInfo(...supports, poseOfA, poseOfB, threshold, TOLERANCE_LENGTH, result);
  if (!found || result.separation > threshold) return null;
  const normal = toArray(result.separatingAxis), distance = result.separation;
  const position = middle(toArray(result.pointA), toArray(result.pointB));
  return { signed_distance: distance, normal, points: [{ position, normal, depth: -distance }] };
}

/** Two actors for the scene. */
function prepareScene(a, b, geometries, threshold) {
  const shapes = geometries.map((geometry) => scene.physics.createShape(geometry, material, true));
  shapes[0].setContactOffset(threshold + smallest(a) / 1000);
  shapes[1].setContactOffset(1e-30);
  const { physics } = scene;
  const actors = [physics.createRigidDynamic(poseOfA), physics.createRigidStatic(poseOfB)];
  actors.forEach((actor, i) => actor.attachShape(shapes[i]));
  return { geometries, shapes, actors, b, threshold };
}

function step({ shapes, actors, b, threshold }, poseA, poseB) {
  place(poseOfA, poseA.position, multiply(poseA.orientation, X_TO_Z));
  place(poseOfB, ...frameOfB(b, b.at ? b.at(poseA, poseB) : poseB));
  actors[0].setGlobalPose(poseOfA);
  actors[1].setGlobalPose(poseOfB);
  scene.points = [];
  scene.shapeOfA = shapes[0];
  actors.forEach((actor) => scene.scene.addActor(actor));
  scene.scene.simulate(STEP);
  scene.scene.fetchResults(true);
  actors.forEach((actor) => scene.scene.removeActor(actor));
  const points = scene.points.filter(({ depth }) => -depth <= threshold);
  if (points.length === 0) return null;
  const deepest = points.reduce((u, v) => v.depth > u.depth ? v : u);
  return { signed_distance: -deepest.depth, normal: deepest.normal, points };
}

/** Undefined of the plane, which has no support, and of no sweep, which has no direction. */
function sweepOf({ supports, b }, poseA, poseB, sweep) {
  if (!supports) return undefined;
  const distance = Math.hypot(...sweep);
  if (distance === 0) return undefined;
  place(poseOfA, poseA.position, multiply(poseA.orientation, X_TO_Z));
  place(poseOfB, ...frameOfB(b, poseB));
  direction.x = -sweep[0] / distance;
  direction.y = -sweep[1] / distance;
  direction.z = -sweep[2] / distance;
  if (!Gjk.sweep(...supports, poseOfA, poseOfB, direction, distance, swept)) return null;
  return { fraction: Math.min(1, swept.t / distance), normal: toArray(swept.n).map((x) => -x) };
}

const hasFloor = process.argv[2] === 'floor', inWorld = hasFloor || process.argv[2] === 'world';

run({
  name: named(hasFloor ? 'physx-floor' : inWorld ? 'physx-world' : 'physx'),
  version: `${VERSION} (${versionOf('physx-js-webidl')})`,
  settings: inWorld ?
    (hasFloor ? 'plane or box as PxTriangleMesh of N by N squares of two triangles; ' : '') +
    'contact report of a step of a scene, convex core of margin 0, single precision' :
    'PxGjkQuery::proximityInfo, convex core of margin 0, single precision, one point midway ' +
    'between the bodies; the plane: contact report of a step of a scene',
  precision: 'float',
  runs: 'wasm',
  pairs: hasFloor ? FLOOR.pairs : ALL_PAIRS,
  parameter: hasFloor ? FLOOR.parameter : undefined,

  prepare(a, asked, threshold, count) {
    const b = hasFloor ? makeFloor(a, asked, count) : asked;
    const geometryOfB = b && makeGeometry(b);
    if (!geometryOfB) return null;
    return (inWorld || b.shape === 'plane' ? prepareScene : prepareQuery)(
      a, b, [makeGeometry(a), geometryOfB], threshold);
  },

  query: (prepared, poseA, poseB) => (prepared.actors ? step : ask)(prepared, poseA, poseB),

  cast: inWorld ? undefined : sweepOf,

  release({ geometries, supports = [], shapes = [], actors = [] }) {
    for (const counted of [...actors, ...shapes]) counted.release();
    for (const geometry of geometries) {
      meshes.get(geometry)?.release();
      meshes.delete(geometry);
    }
    for (const made of [...supports, ...geometries]) PhysX.destroy(made);
  },
});
