// Jolt Physics (npm's jolt-physics, compiled to WebAssembly), single precision.
//
// Calls        TransformedShape::CollideShape of the cylinder's shape (shape 1) against a
//              TransformedShape of the other body (shape 2), with the settings of a default
//              CollideShapeSettings: collision and penetration tolerance 1e-4 m. This is what a
//              world asks in its narrow phase before it clips faces to a manifold: one point.
//              jolt-world: both bodies are made for a world without gravity, which takes one step
//              of 1 µs, and the manifold of its contact listener is taken; then they are destroyed,
//              so that nothing is left of the pair. All of it is timed.
// Shapes       CylinderShape and CapsuleShape along y, turned to ours; SphereShape, BoxShape,
//              PlaneShape; ConvexHullShape of a convex body's vertices, with Jolt's tolerance of
//              1 mm, by which it may leave out some, and none of smaller bodies than that.
//              jolt-floor:N: MeshShape of the plane's or box's triangles (floor.mjs); the deepest
//              hit of any. Only edges at which a mesh is not flat are active, as by default.
// Margin       jolt, jolt-world: Jolt's convex radius of 0.05 m on cylinder and box, at most half
//              of the smallest half extent (Jolt refuses more than the whole one), and on convex
//              bodies, where Jolt makes it as small as it must be. It is taken from the inside:
//              faces stay where they are, edges are rounded.
//              jolt-margin-0: convex radius 0. jolt-margin:M: M metres, at most the smallest half
//              extent. A cylinder's or box's given rounding is its convex radius. Where even the
//              bodies without it overlap, Jolt asks its EPA of the sharp ones. What it makes of a
//              convex body's edges is not known.
// Conventions  mPenetrationAxis, and a manifold's normal, moves shape 2 out; which body is the
//              manifold's first is checked.
// Points       Midway between those on both bodies.
// Casts        TransformedShape::CastShape with default settings, for which edges are sharp
//              (mUseShrunkenShapeAndConvexRadius is off); the first hit, its normal along the
//              penetration axis. Not of worlds and floors.
// Threshold    mMaxSeparationDistance; the world's speculative contact distance, at least its own
//              of 2 cm, and what lies beyond the threshold is dropped.
// Precision    Poses are rounded to float.
// Traps        Until a JoltInterface exists, every pair's function is null, and a query ends the
//              program.
//
// node jolt.mjs [margin-0 | margin | world | floor]
import { run } from '../clients/touchstone_candidate.mjs';
import { FLOOR, makeFloor } from './floor.mjs';
import {
  ALL_PAIRS, Y_TO_Z, load, middle, multiply, named, smallest, versionOf,
} from './packages.mjs';

const Jolt = await (await load('jolt-physics')).default();

const settings = new Jolt.JoltSettings();
const LAYER = 0;
const layers = new Jolt.ObjectLayerPairFilterTable(1);
layers.EnableCollision(LAYER, LAYER);
const broadPhase = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
broadPhase.MapObjectToBroadPhaseLayer(LAYER, new Jolt.BroadPhaseLayer(0));
settings.mObjectLayerPairFilter = layers;
settings.mBroadPhaseLayerInterface = broadPhase;
settings.mObjectVsBroadPhaseLayerFilter =
  new Jolt.ObjectVsBroadPhaseLayerFilterTable(broadPhase, 1, layers, 1);
const jolt = new Jolt.JoltInterface(settings);

const one = new Jolt.Vec3(1, 1, 1), zero = new Jolt.RVec3(0, 0, 0);
const upright = new Jolt.Quat(0, 0, 0, 1);
const any = new Jolt.ShapeFilter();
const position = new Jolt.RVec3(), rotation = new Jolt.Quat();

const usual = { says: 'convex radius 0.05 m, at most half of the smallest half extent',
  of: (shape) => Math.min(0.05, smallest(shape) / 2) };
const MARGINS = {
  undefined: { name: 'jolt', ...usual },
  world: { name: 'jolt-world', ...usual },
  floor: { name: 'jolt-floor', ...usual, parameter: FLOOR.parameter },
  'margin-0': { name: 'jolt-margin-0', says: 'convex radius 0', of: () => 0 },
  margin: { name: 'jolt-margin', says: 'convex radius as given, at most the smallest half extent',
    of: (shape, margin) => Math.min(margin, smallest(shape)),
    parameter: { meaning: 'convex radius, metres', min: 0, max: 1, usual: 0.01 } },
};
const margin = MARGINS[process.argv[2]], hasFloor = process.argv[2] === 'floor';

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
    case 'convex': return makeHull(shape.vertices, convexRadius);
    case 'floor': return makeMesh(shape);
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

/** A shape that is ours until it is released; null if Jolt makes none. */
function makeHull(vertices, convexRadius) {
  const settings = new Jolt.ConvexHullShapeSettings(), point = new Jolt.Vec3();
  for (const vertex of vertices) {
    point.Set(...vertex);
    settings.mPoints.push_back(point);
  }
  settings.mMaxConvexRadius = convexRadius;
  Jolt.destroy(point);
  return created(settings);
}

function makeMesh({ corners, triangles }) {
  const list = new Jolt.TriangleList();
  for (const triangle of triangles) {
    const ends = triangle.map((i) => new Jolt.Vec3(...corners[i]));
    const one = new Jolt.Triangle(...ends, 0);
    list.push_back(one);
    for (const made of [one, ...ends]) Jolt.destroy(made);
  }
  const settings = new Jolt.MeshShapeSettings(list);
  Jolt.destroy(list);
  return created(settings);
}

function created(settings) {
  const made = settings.Create();
  const shape = made.IsValid() ? made.Get() : null;
  shape?.AddRef();
  Jolt.destroy(settings);
  return shape;
}

/** The shapes of a pair, given to `take`, which keeps them; null if one of them cannot be made. */
function withShapes(a, b, convexRadiusOf, take) {
  if (b.shape === 'convex' && b.rounding) return null;  // it would be around the hull
  const radii = [a, b].map((shape) => shape.rounding ?? convexRadiusOf(shape));
  const [shapeA, shapeB] = [a, b].map((shape, i) => makeShape(shape, radii[i]));
  if (!shapeB) return null;
  const taken = { ...take(shapeA, shapeB), roundings: [a, b].map(({ shape }, i) =>
    shape === 'cylinder' || shape === 'box' ? radii[i] : shape === 'convex' && radii[i] ? NaN : 0) };
  if (b.shape === 'convex' || b.shape === 'floor') shapeB.Release();
  return taken;
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

// The same of a cast.
const castHits = new Jolt.CastShapeCollectorJS();
let castHit = null;
castHits.Reset = () => { castHit = null; };
castHits.OnBody = () => {};
castHits.AddHit = (address) => {
  const { mFraction, mPenetrationAxis } = Jolt.wrapPointer(address, Jolt.ShapeCastResult);
  if (castHit && castHit.fraction <= mFraction) return;
  castHit = { fraction: mFraction, axis: toArray(mPenetrationAxis) };
};
const castSettings = new Jolt.ShapeCastSettings(), direction = new Jolt.Vec3();

const toArray = (v) => [v.GetX(), v.GetY(), v.GetZ()];

const needsTurn = (shape) => shape.shape === 'cylinder' || shape.shape === 'capsule';

const byQuery = {
  settings: `CollideShape, single precision; ${margin.says}; tolerances 1e-4; ` +
    'one point, midway between those on both bodies',

  prepare(a, b, threshold, parameter) {
    const floor = hasFloor ? makeFloor(a, b, parameter) : null;
    if (hasFloor && !floor) return null;
    return withShapes(a, floor ?? b, (shape) => margin.of(shape, parameter), (shapeA, shapeB) => {
      shapeA.AddRef();
      const body = new Jolt.TransformedShape();
      body.mShape = shapeB;
      const query = new Jolt.CollideShapeSettings();
      query.mMaxSeparationDistance = threshold;
      return { shapeA, body, query, floor, turned: needsTurn(b) };
    });
  },

  query({ shapeA, body, query, floor, turned }, poseA, poseB) {
    place(floor ? floor.at(poseA, poseB) : poseB, turned);
    body.SetWorldTransform(position, rotation, one);
    place(poseA, true);
    hit = null;
    const atA = Jolt.RMat44.prototype.sRotationTranslation(rotation, position);
    body.CollideShape(shapeA, one, atA, query, zero, hits, any);
    if (!hit) return null;
    const { distance, axis, onA, onB } = hit;
    const length = -Math.hypot(...axis);
    const normal = axis.map((x) => x / length);
    return { signed_distance: distance, normal,
      points: [{ position: middle(onA, onB), normal, depth: -distance }] };
  },

  cast: hasFloor ? undefined : ({ shapeA, body, turned }, poseA, poseB, sweep) => {
    place(poseB, turned);
    body.SetWorldTransform(position, rotation, one);
    place(poseA, true);
    direction.Set(...sweep);
    castHit = null;
    const atA = Jolt.RMat44.prototype.sRotationTranslation(rotation, position);
    const moving = new Jolt.RShapeCast(shapeA, one, atA, direction);
    castHits.ResetEarlyOutFraction();
    body.CastShape(moving, castSettings, zero, castHits, any);
    Jolt.destroy(moving);
    if (!castHit) return null;
    const { fraction, axis } = castHit, length = -Math.hypot(...axis);
    return { fraction, normal: length ? axis.map((x) => x / length) : axis };
  },

  release({ shapeA, body, query }) {
    shapeA.Release();
    Jolt.destroy(body);  // releases its shape
    Jolt.destroy(query);
  },
};

const system = jolt.GetPhysicsSystem(), bodies = system.GetBodyInterface();
const physics = system.GetPhysicsSettings(), OWN_DISTANCE = physics.mSpeculativeContactDistance;
const STEP = 1e-6;
let manifold = null;  // of the last step, with A's body as the first

function listen(idOfA) {
  const listener = new Jolt.ContactListenerJS();
  listener.OnContactValidate = () => Jolt.ValidateResult_AcceptAllContactsForThisBodyPair;
  listener.OnContactAdded = (first, second, address) => {
    const found = Jolt.wrapPointer(address, Jolt.ContactManifold);
    const isFirst = Jolt.wrapPointer(first, Jolt.Body).GetID().GetIndex() === idOfA();
    const normal = toArray(found.mWorldSpaceNormal).map((x) => isFirst ? -x : x);
    const points = [];
    for (let i = 0; i < found.mRelativeContactPointsOn1.size(); ++i) {
      const ends = [found.GetWorldSpaceContactPointOn1(i), found.GetWorldSpaceContactPointOn2(i)]
        .map(toArray);
      const [onA, onB] = isFirst ? ends : ends.reverse();
      const depth = normal.reduce((sum, x, j) => sum + x * (onB[j] - onA[j]), 0);
      points.push({ position: middle(onA, onB), normal, depth });
    }
    manifold = { signed_distance: -found.mPenetrationDepth, normal, points };
  };
  listener.OnContactPersisted = () => {};
  listener.OnContactRemoved = () => {};
  system.SetContactListener(listener);
}

let idOfA = -1;
const byWorld = {
  settings: `contact listener of a step of a world, single precision; ${margin.says}; points ` +
    'midway between those on both bodies',

  prepare(a, b, threshold) {
    const body = (shape, motion) =>
      new Jolt.BodyCreationSettings(shape, zero, upright, motion, LAYER);
    return withShapes(a, b, (shape) => margin.of(shape), (shapeA, shapeB) => ({
      a: body(shapeA, Jolt.EMotionType_Dynamic), b: body(shapeB, Jolt.EMotionType_Static),
      threshold, turned: needsTurn(b) }));
  },

  query({ a, b, threshold, turned }, poseA, poseB) {
    const ids = [[b, poseB, turned], [a, poseA, true]].map(([settings, pose, alongY]) => {
      place(pose, alongY);
      settings.mPosition = position;
      settings.mRotation = rotation;
      const body = bodies.CreateBody(settings);
      bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
      return body.GetID();
    });
    idOfA = ids[1].GetIndex();
    manifold = null;
    physics.mSpeculativeContactDistance = Math.max(OWN_DISTANCE, threshold);
    jolt.Step(STEP, 1);
    for (const id of ids.reverse()) {
      bodies.RemoveBody(id);
      bodies.DestroyBody(id);
    }
    if (!manifold || manifold.signed_distance > threshold) return null;
    return { ...manifold, points: manifold.points.filter(({ depth }) => -depth <= threshold) };
  },

  release({ a, b }) {
    Jolt.destroy(a);  // release their shapes
    Jolt.destroy(b);
  },
};

if (margin.name === 'jolt-world') {
  system.SetGravity(new Jolt.Vec3(0, 0, 0));
  listen(() => idOfA);
}

run({
  name: named(margin.name),
  version: versionOf('jolt-physics'),
  precision: 'float',
  runs: 'wasm',
  pairs: hasFloor ? FLOOR.pairs : ALL_PAIRS,
  parameter: margin.parameter,
  roundings: ({ roundings }) => roundings,
  ...margin.name === 'jolt-world' ? byWorld : byQuery,
});
