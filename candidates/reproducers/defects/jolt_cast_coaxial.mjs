// Jolt Physics in JavaScript: where a can is cast onto another one along their common axis, the
// penetration axis is askew.
//
// Expected  (0, 0, -1) or its opposite. Caps meet flat, but for the 1e-7 rad of a quarter turn in floats:
//           no shorter way parts two discs than across them.
// Seen      an axis that leans by tens of degrees. For cans along y, without a turn, it is right.
// Run       npm install jolt-physics@1.1.0 && node jolt_cast_coaxial.mjs
import initJolt from 'jolt-physics';

const Jolt = await initJolt();
const settings = new Jolt.JoltSettings();
const layers = new Jolt.ObjectLayerPairFilterTable(1);
const broadPhase = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
broadPhase.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
settings.mObjectLayerPairFilter = layers;
settings.mBroadPhaseLayerInterface = broadPhase;
settings.mObjectVsBroadPhaseLayerFilter =
  new Jolt.ObjectVsBroadPhaseLayerFilterTable(broadPhase, 1, layers, 1);
new Jolt.JoltInterface(settings);  // queries need one, too

const can = new Jolt.CylinderShape(1, 0.5);  // half height, radius
const turn = new Jolt.Quat(Math.SQRT1_2, 0, 0, Math.SQRT1_2);  // of y into z
const standing = new Jolt.TransformedShape(), one = new Jolt.Vec3(1, 1, 1), zero = new Jolt.RVec3(0, 0, 0);
standing.mShape = can;
standing.SetWorldTransform(zero, turn, one);
const start = Jolt.RMat44.prototype.sRotationTranslation(turn, new Jolt.RVec3(0, 0, 3));
const cast = new Jolt.RShapeCast(can, one, start, new Jolt.Vec3(0, 0, -2));
const hits = new Jolt.CastShapeAllHitCollisionCollector();
standing.CastShape(cast, new Jolt.ShapeCastSettings(), zero, hits, new Jolt.ShapeFilter());
const { mFraction, mPenetrationAxis } = hits.mHits.at(0), axis = mPenetrationAxis.Normalized();
console.log(`fraction ${mFraction}, axis (${axis.GetX()}, ${axis.GetY()}, ${axis.GetZ()})`);
process.exit(Math.abs(axis.GetZ()) > 0.999 ? 0 : 1);
