// The page of `touchstone choose`: its tables, the chart of error and cost, the motion.
const needs = data.scene.needs, answer = data.runs[data.answer];
const exactName = name => name === 'reference' ? 'exact cylinder' : name;
const measured = (value, need) => value === null ? 'the motion becomes absurd' : `${exponent(value)}${need.unit}`;

const wide = text => element('td', {class: 'text wrap'}, text);

// Words such as "can stands within 0.5°: 12° at 0.71 s".
function failure(run) {
  const need = needs[run.first_broken], verdict = run.verdicts[run.first_broken];
  return `${need.text}: ${measured(verdict.value, need)} at ${verdict.time.toFixed(2)} s`;
}

function headline() {
  byId('title').textContent = `What does the scene ${data.scene.name} need?`;
  byId('description').textContent = data.scene.description;
  const exact = data.runs[0].microseconds_per_step;
  byId('headline').textContent = !data.possible ? 'Not even exact contacts meet the needs of this scene.'
      : data.exact_is_cheapest
          ? `The exact cylinder is itself the cheapest model that meets all needs: contacts take ${exponent(exact)} µs of a step.`
          : `The cheapest models that meet all needs save ${Math.round(100 * data.time_saved)}% of the contacts' time: ` +
            `${exponent(answer.microseconds_per_step)} µs of a step instead of ${exponent(exact)} µs.`;
  byId('provenance').textContent = `${data.command}; ${data.machine.cpu}, ${data.machine.compiler}. ` +
      `The rest of a step, solver and harness, takes ${exponent(data.rest_of_step_microseconds)} µs.`;
}

function answerTables() {
  byId('kind-table').append(table([textColumn('pairs'), textColumn('model'), 'ns a query', 'ns exactly', column('queries', {class: 'wide'}), textColumn('next cheaper one breaks a need')],
      data.kinds.map(k => [wide(`${k.name} (${k.bodies})`), exactName(k.chosen), whole(k.nanoseconds), whole(k.exact_nanoseconds),
          whole(k.asked), k.next_cheaper === null ? 'there is none' : `${k.next_cheaper.name}, ${whole(k.next_cheaper.nanoseconds)} ns`]), 'Times of a query, median'));
  byId('need-table').append(table(['', 'need', 'measured', 'at'].map(textColumn), answer.verdicts.map((v, i) => [
      element('td', {class: v.holds ? 'good text' : 'bad text'}, v.holds ? 'holds' : 'broken'), needs[i].text,
      measured(v.value, needs[i]), `${v.time.toFixed(2)} s`]), 'What was measured of each need, and when'));
}

function failures() {
  const list = byId('failure-list');
  for (const kind of data.kinds.filter(k => k.next_cheaper !== null)) {
    const run = data.runs[kind.next_cheaper.run], e = run.evidence;
    list.append(element('article', {}, element('h3', {}, `${kind.next_cheaper.name} for ${kind.name}`),
        element('p', {}, failure(run)),
        e && element('p', {}, `${e.bodies} at ${e.time.toFixed(2)} s: ${e.wrong}.`), e && command(e.replay)));
  }
  if (!list.children.length) list.append(element('p', {}, 'No cheaper model has a routine for any of these pairs.'));
}

// Whether a run has one candidate for all pairs; runs of the search have longer names.
const isUniform = run => !run.name.includes(' ') && run.name !== 'combination';
function runTable() {
  byId('run-table').append(table([textColumn('model'), 'µs of a step', 'error / limit', textColumn('breaks first'), textColumn('worst answer before')],
      data.runs.filter(isUniform).map(r => [r.name, exponent(r.microseconds_per_step, 3),
          element('td', {class: r.holds ? 'good' : 'bad'}, r.error === null ? 'absurd' : exponent(r.error)),
          wide(r.holds ? '' : failure(r)), wide(r.evidence ? `${r.evidence.bodies}: ${r.evidence.wrong}` : '')]), 'Each run with one model'));
  if (data.too_slow.length) byId('too-slow').textContent = `Not run, because their queries alone would take more than 3 s: ${data.too_slow.join(', ')}.`;
}

// Error and cost of all runs. A run whose motion became absurd is drawn at the top.
function costChart() {
  const errors = data.runs.map(r => r.error).filter(e => e > 0 && e < 1e4).concat(1);
  const cost = data.runs.map(r => r.microseconds_per_step);
  const low = 10 ** Math.floor(Math.log10(Math.max(1e-3, Math.min(...errors)))), high = 10 ** Math.ceil(Math.log10(2 * Math.max(...errors)));
  const at = i => ({x: cost[i], y: Math.min(high, Math.max(low, data.runs[i].error === null ? high : data.runs[i].error))});
  const points = data.runs.map((run, i) => {
    const uniform = isUniform(run), isAnswer = i === data.answer;
    return {...at(i), fill: `var(${run.holds ? '--good' : '--bad'})`, stroke: null, size: uniform ? 60 : 30,
            symbol: symbolPath(uniform ? 'circle' : 'diamond', 0, 0, 1),
            label: isAnswer ? (i === 0 ? 'exact, the answer' : 'the answer') : uniform ? run.name : '',
            weight: isAnswer ? 'bold' : 'normal', order: isAnswer ? -2 : data.front.includes(i) ? -1 : i,
            tip: `${run.name}\n${exponent(cost[i])} µs, ${run.holds ? 'all needs hold' : failure(run)}`};
  });
  if (data.possible) points.unshift({...at(data.answer), fill: 'none', stroke: 'var(--ink)', size: 320, symbol: symbolPath('circle', 0, 0, 1), label: '', order: 1e6});
  drawScatter(byId('front'), 'Error of each run against its cost', {height: 420, points, limit: 1, lines: [{rows: data.front.map(at)}],
      x: {title: 'contacts of a step, µs', domain: [Math.min(...cost) * 0.8, Math.max(...cost) * 1.3], ticks: decadesOf(cost).ticks, label: numberLabel},
      y: {title: 'error / limit', domain: [low, high], ticks: decadesOf([low, high]).ticks, label: numberLabel}});
}

// The motion: two runs side by side, seen from the same place.
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
function drawMotion(view, parts, poses, frame) {
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

function startMotion(motion) {
  const runs = motion.runs.map(r => ({...r, poses: decodePoses(r.poses)})), parts = sceneOf(motion);
  const views = ['left', 'right'].map(id => makeView(byId(id))), select = byId('other');
  const moving = parts.filter(p => !p.fixed).length;
  let time = 0, playing = false, before = 0;
  const draw = () => {
    [runs[0], runs[select.value]].forEach(({poses}, i) =>
        drawMotion(views[i], parts, poses, Math.min(poses.length / 7 / moving - 1, time / motion.interval)));
    byId('scrub').value = time;
    byId('clock').textContent = `${time.toFixed(2)} s`;
  };
  const tick = now => {
    if (!playing) return;
    time += Math.max(0, now - before) / 1000 * Number(byId('speed').value);
    before = now;
    if (time > motion.duration) time = 0;
    draw();
    requestAnimationFrame(tick);
  };
  const play = on => {
    playing = on;
    byId('play').textContent = on ? 'Pause' : 'Play';
    before = performance.now();
    if (on) requestAnimationFrame(tick);
  };
  select.append(...options(runs.map((r, i) => [i, r.name]).slice(runs.length > 1 ? 1 : 0)));
  const note = () => { byId('other-note').textContent = runs[select.value].note; };
  select.addEventListener('change', () => { note(); draw(); });
  byId('scrub').max = motion.duration;
  byId('scrub').addEventListener('input', e => { play(false); time = Number(e.target.value); draw(); });
  byId('play').addEventListener('click', () => play(!playing));
  views.forEach((view, i) => {
    aimCamera(view, motion.camera);
    steerView(view, () => {
      const {right, up, towards, zoom} = view;
      Object.assign(views[1 - i], {right, up, towards, zoom});
      draw();
    }, turnCamera, zoomCamera);
  });
  addEventListener('resize', draw);
  note();
  const wanted = /[#&]t=([0-9.]+)/.exec(location.hash);
  if (wanted) time = Math.min(motion.duration, Number(wanted[1]));
  draw();
}

headline();
if (data.possible) {
  answerTables();
  failures();
}
runTable();
keepDrawn(costChart);
startMotion(data.motion);
listSections();
