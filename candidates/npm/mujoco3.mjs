// MuJoCo 3.14 (npm's @mujoco/mujoco, Google DeepMind's build for WebAssembly), double precision.
//
// Calls        mj_kinematics and mj_collision of a model with one free body and one geom or mocap
//              body for B, made from XML for each pair of shapes.
// Routes       Plane, sphere and capsule by MuJoCo's closed forms where it has them; others by its
//              own convex collision (nativeccd): GJK and EPA, ccd_tolerance 1e-6 and ccd_iterations
//              35, all as by default.
// Points       mujoco3: several of flat features, as by default (multiccd). mujoco3-single:
//              multiccd off. Midway between the two surfaces.
// Shapes       Half lengths, a capsule's without its round ends. A plane is solid below its frame's
//              xy-plane. A convex body is a mesh asset of its vertices, whose hull MuJoCo makes and
//              keeps in single precision; of vertices in one plane it makes none.
// Conventions  A contact frame's x axis points from geom1 to geom2; reversed if geom1 is the
//              cylinder.
// Threshold    The cylinder's margin.
// Traps        Contacts are copies: delete them. The plane has to hang from a static body other
//              than the world, whose geoms mj_kinematics leaves where they were. An MjData serves
//              all models with the same kinds of geoms, but for meshes, for its arena is large;
//              mj_kinematics and mj_collision write whatever is read of it.
//
// node mujoco3.mjs [single]
import { run } from '../clients/touchstone_candidate.mjs';
import { ALL_PAIRS, load, multiply, named, rotate, turn } from './packages.mjs';

const { default: start } = await load('@mujoco/mujoco');
const mujoco = await start();
const single = process.argv[2] === 'single';

function geomXml(shape, margin) {
  if (shape.shape === 'convex') return `<geom type='mesh' mesh='b' margin='${margin}'/>`;
  const size = { plane: [0, 0, 1], sphere: [shape.radius], box: shape.half_extents }[shape.shape] ??
    [shape.radius, shape.half_length];
  return `<geom type='${shape.shape}' size='${size.join(' ')}' margin='${margin}'/>`;
}

/** A free cylinder and B, which is moved by its body. */
function makeModel(a, b, threshold) {
  const flag = single ? "<flag multiccd='disable'/>" : '';
  const mesh = b.shape === 'convex' ?
    `<asset><mesh name='b' vertex='${b.vertices.flat().join(' ')}'/></asset>` : '';
  return mujoco.MjModel.from_xml_string(`<mujoco><option>${flag}</option>${mesh}<worldbody>
    <body mocap='${b.shape !== 'plane'}'>${geomXml(b, 0)}</body>
    <body><freejoint/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/>
      ${geomXml(a, threshold)}</body></worldbody></mujoco>`);
}

const datas = new Map();  // by the kind of B

/** The data for models with this kind of B, made of one that lives as long. */
function dataFor(a, b, model) {
  if (b.shape === 'convex') return new mujoco.MjData(model);
  if (!datas.has(b.shape)) datas.set(b.shape, new mujoco.MjData(makeModel(a, b, 0)));
  return datas.get(b.shape);
}

run({
  name: named(single ? 'mujoco3-single' : 'mujoco3'),
  version: mujoco.mj_versionString(),
  settings: `mj_collision, double precision; nativeccd, tolerance 1e-6, 35 iterations; multiccd ${
    single ? 'off' : 'on, as by default'}; points midway between the bodies`,
  precision: 'double',
  runs: 'wasm',
  pairs: ALL_PAIRS,

  prepare(a, b, threshold) {
    let model;
    try {
      model = makeModel(a, b, threshold);
    } catch (error) {
      if (b.shape !== 'convex') throw error;
      return null;  // MuJoCo makes no mesh of its vertices
    }
    return { model, data: dataFor(a, b, model), isOwn: b.shape === 'convex',
      plane: b.shape === 'plane' ? { ...b, turn: turn([0, 0, 1], b.normal) } : null };
  },

  query({ model, data, plane }, poseA, poseB) {
    data.qpos.set([...poseA.position, ...poseA.orientation]);
    if (plane) {
      const up = rotate(poseB.orientation, plane.normal);
      model.body_pos.set(poseB.position.map((x, i) => x + plane.displacement * up[i]), 3);
      model.body_quat.set(multiply(poseB.orientation, plane.turn), 4);
    } else {
      data.mocap_pos.set(poseB.position);
      data.mocap_quat.set(poseB.orientation);
    }
    mujoco.mj_kinematics(model, data);
    mujoco.mj_collision(model, data);
    if (data.ncon === 0) return null;
    const contacts = data.contact;
    const points = [];
    for (let i = 0; i < data.ncon; ++i) {
      const contact = contacts.get(i);
      const sign = contact.geom1 === 1 ? -1 : 1;
      const normal = [...contact.frame.slice(0, 3)].map((x) => sign * x);
      points.push({ position: [...contact.pos], normal, depth: -contact.dist });
      contact.delete();
    }
    contacts.delete();
    const deepest = points.reduce((u, v) => v.depth > u.depth ? v : u);
    return { signed_distance: -deepest.depth, normal: deepest.normal, points };
  },

  release({ model, data, isOwn }) {
    if (isOwn) data.delete();
    model.delete();
  },
});
