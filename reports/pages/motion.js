// Motions in 3-D: two runs of a scene side by side, seen from the same place.
const bodyTints = {cylinder: [59, 120, 181], capsule: [201, 130, 43], sphere: [138, 107, 176], box: [154, 164, 174], plane: [200, 204, 196]};
const pale = [242, 239, 232], sun = unit([0.4, -0.6, 1.2]);

// Decodes the poses of a run: for each frame and moving body x y z and the quaternion w x y z, as base64 of float32.
function decodePoses(text) {
  return new Float32Array(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
}
// [position, orientation] of moving body `i` of `count`, interpolated between two frames.
function poseAt(poses, frame, i, count) {
  const first = Math.floor(frame), next = Math.min(poses.length / 7 / count - 1, first + 1), share = frame - first;
  const [p, q] = [first, next].map(f => Array.from(poses.subarray(7 * (f * count + i), 7 * (f * count + i) + 7)));
  const turn = Math.sign(p.slice(3).reduce((sum, x, k) => sum + x * q[3 + k], 0)) || 1;  // q and −q are one orientation
  const mixed = p.map((x, k) => x * (1 - share) + q[k] * share * (k < 3 ? 1 : turn));
  return [mixed.slice(0, 3), mixed.slice(3)];
}

// Meshes of the bodies; fixed bodies are placed once. A plane shows its outer side, as far as no other plane covers it.
function sceneOf({bodies, camera}) {
  const reach = 10 * length(add(camera.position, camera.look_at, -1)), moving = bodies.filter(b => !b.fixed).length;
  const segments = moving > 20 ? 16 : moving > 8 ? 24 : 48;  // of spheres and capsules; many are small on the canvas
  const parts = bodies.map(({shape, fixed, pose}) => {
    const near = toLocal({axes: axesOf(pose.orientation), centre: pose.position}, camera.look_at);
    const mesh = {...meshOf(shape, shape.shape === 'plane' ? near : null, reach, shape.shape === 'cylinder' ? 48 : segments), edges: []};
    return {shape, fixed, mesh, body: fixed ? placeMesh(shape, mesh, pose.orientation, pose.position) : null};
  });
  const planes = parts.filter(p => p.shape.shape === 'plane').map(p => p.body);
  const shown = planes.map(plane => planes.filter(other => other !== plane).reduce((face, {outward: [n], faces: [[p]]}) =>
      cut(face, x => dot(n, add(x, p, -1))), plane.faces[0]));
  planes.forEach((plane, i) => { plane.faces = shown[i].length ? [shown[i]] : []; });
  return parts;
}
// Meshes of what stands for the bodies in a run, by body.
function modelsOf(models, parts) {
  const segments = parts.length > 20 ? 12 : 24, meshes = new Map();
  for (const {body, parts: stand} of models) {
    meshes.set(parts[body], stand.map(({shape, centre, orientation = [1, 0, 0, 0]}) =>
        ({shape, centre, orientation, mesh: {...meshOf(shape, null, 1, segments)}})));
  }
  return meshes;
}
const modelTint = [214, 64, 90];
// Paints what stands for a body over it, so that both are seen.
function paintModel(canvas, body, model) {
  for (const {shape, centre, orientation, mesh} of model) {
    const placed = placeMesh(shape, mesh, orientation, [0, 0, 0]);
    const toWorld = p => add(body.centre, combine(body.axes, add(p, centre)));
    placed.faces = placed.faces.map(f => f.map(toWorld));
    placed.edges = placed.edges.map(e => e.map(toWorld));
    placed.outward = placed.outward.map(n => combine(body.axes, n));
    paintBody(canvas, placed, {tint: modelTint, light: sun, opacity: 0.45});
  }
}
function drawMotion(view, parts, poses, frame, models = new Map()) {
  const canvas = startFrame(view);
  if (canvas === null) return;
  const moving = parts.filter(p => !p.fixed);
  moving.forEach((part, i) => {
    const [position, orientation] = poseAt(poses, frame, i, moving.length);
    part.body = placeMesh(part.shape, part.mesh, orientation, position);
  });
  const shadows = moving.map(p => p.body), planes = parts.filter(p => p.shape.shape === 'plane');
  // Bodies are outside of all planes, which are therefore behind them.
  const order = farToNear(canvas, parts.filter(p => !planes.includes(p)).map(p => p.body));
  for (const {body} of planes) paintBody(canvas, body, {tint: bodyTints.plane, light: sun, shadows});
  for (const body of order) {
    const tint = bodyTints[body.shape.shape], box = body.shape.shape === 'box', wall = box && !shadows.includes(body);
    paintBody(canvas, body, {tint, pale, light: sun, opacity: wall ? 0.55 : 1, shadows: wall ? shadows : [],
                             outline: box ? `rgb(${times(tint, 0.6).join(' ')} / .7)` : null});
    const model = models.get(parts.find(p => p.body === body));
    if (model) paintModel(canvas, body, model);
  }
}

// The camera turns about the vertical through the point that it looks at.
function aimCamera(view, {position, look_at}) {
  const from = add(position, look_at, -1);
  Object.assign(view, {pan: look_at, towards: unit(from), lens: Math.tan(18 * Math.PI / 180)});
  view.zoom = 1 / (view.lens * length(from));
  turnCamera(view, 0, 0);
}
function turnCamera(view, sideways, upwards) {
  const [x, y, z] = view.towards, azimuth = Math.atan2(y, x) + sideways;
  const height = Math.max(-1.45, Math.min(1.45, Math.asin(z) + upwards));
  view.towards = [Math.cos(height) * Math.cos(azimuth), Math.cos(height) * Math.sin(azimuth), Math.sin(height)];
  view.right = [-Math.sin(azimuth), Math.cos(azimuth), 0];
  view.up = cross(view.towards, view.right);
}
const zoomCamera = (view, factor) => { view.zoom *= factor; };

// Says what the canvases `left` and `right` of motion.html show, for those who cannot see them.
function describeMotions(left, right) {
  byId('left').setAttribute('aria-label', left);
  byId('right').setAttribute('aria-label', right);
}
// Plays two runs at once on these canvases, with the controls `play`, `scrub`, `clock` and `speed`.
// `shown()`: {motion, pair: the two of its runs that are to be seen}. Returns a function that draws anew.
function playMotions(shown) {
  const views = ['left', 'right'].map(id => makeView(byId(id)));
  let time = 0, playing = false, before = 0, current = null, parts = null;
  const aim = motion => {
    current = motion;
    parts = sceneOf(motion);
    for (const view of views) aimCamera(view, motion.camera);
    byId('scrub').max = motion.duration;
    time = Math.min(time, motion.duration);
  };
  const draw = () => {
    const {motion, pair} = shown();
    if (motion !== current) aim(motion);
    const moving = parts.filter(p => !p.fixed).length;
    pair.forEach((run, i) => {
      run.decoded = run.decoded ?? decodePoses(run.poses);
      run.meshes = run.meshes ?? modelsOf(run.models ?? [], parts);
      drawMotion(views[i], parts, run.decoded, Math.min(run.decoded.length / 7 / moving - 1, time / motion.interval), run.meshes);
    });
    byId('scrub').value = time;
    byId('clock').textContent = `${time.toFixed(2)} s`;
  };
  const tick = now => {
    if (!playing) return;
    time += Math.max(0, now - before) / 1000 * Number(byId('speed').value);
    before = now;
    if (time > current.duration) time = 0;
    draw();
    requestAnimationFrame(tick);
  };
  const play = on => {
    playing = on;
    byId('play').textContent = on ? 'Pause' : 'Play';
    before = performance.now();
    if (on) requestAnimationFrame(tick);
  };
  byId('scrub').addEventListener('input', e => { play(false); time = Number(e.target.value); draw(); });
  byId('play').addEventListener('click', () => play(!playing));
  views.forEach((view, i) => steerView(view, () => {
    const {right, up, towards, zoom} = view;
    Object.assign(views[1 - i], {right, up, towards, zoom});
    draw();
  }, turnCamera, zoomCamera));
  addEventListener('resize', draw);
  aim(shown().motion);
  const wanted = /[#&]t=([0-9.]+)/.exec(location.hash);
  if (wanted) time = Math.min(current.duration, Number(wanted[1]));
  draw();
  return draw;
}
