// Two views of the scene, with one camera. `motion` has the bodies' shapes, which of them move, the
// time between frames, and for each run its poses: x y z, then the quaternion w x y z, as float32.
function decodePoses(text) {
  const bytes = Uint8Array.from(atob(text), c => c.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}

// Stripes show how a round body turns.
function stripes(colour) {
  const canvas = document.createElement('canvas');
  canvas.width = 16;
  canvas.height = 1;
  const pen = canvas.getContext('2d');
  for (let i = 0; i < 16; ++i) {
    pen.fillStyle = i % 4 < 2 ? colour : '#f2efe8';
    pen.fillRect(i, 0, 1, 1);
  }
  const texture = new THREE.CanvasTexture(canvas);
  texture.magFilter = THREE.NearestFilter;
  return texture;
}

const palette = {cylinder: '#3b78b5', capsule: '#c9822b', sphere: '#8a6bb0', box: '#9aa4ae'};

function geometryOf(s, reach) {
  switch (s.shape) {
    case 'cylinder': return new THREE.CylinderBufferGeometry(s.radius, s.radius, 2 * s.half_length, 48).rotateX(Math.PI / 2);
    case 'sphere': return new THREE.SphereBufferGeometry(s.radius, 32, 20);
    case 'box': return new THREE.BoxBufferGeometry(...s.half_extents.map(h => 2 * h));
    case 'capsule': {
      const profile = [];
      for (let i = 0; i <= 24; ++i) {
        const angle = Math.PI * (i / 24 - 0.5);
        profile.push(new THREE.Vector2(s.radius * Math.cos(angle), s.radius * Math.sin(angle) + (i < 12 ? -1 : 1) * s.half_length));
      }
      return new THREE.LatheBufferGeometry(profile, 40).rotateX(Math.PI / 2);
    }
    default: return new THREE.PlaneBufferGeometry(20 * reach, 20 * reach);
  }
}

// Turns z to the plane's normal and moves the plane there.
function placePlane(mesh, s) {
  const normal = new THREE.Vector3(...s.normal), length = normal.length();
  normal.normalize();
  mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
  mesh.position.copy(normal.multiplyScalar(s.displacement / length));
}

class View {
  constructor(canvas, motion) {
    this.canvas = canvas;
    this.motion = motion;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: true});
    this.renderer.shadowMap.enabled = true;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(36, 4 / 3, 0.001, 1000);
    this.camera.up.set(0, 0, 1);
    const target = new THREE.Vector3(...motion.camera.look_at);
    const reach = target.distanceTo(new THREE.Vector3(...motion.camera.position));
    this.camera.near = reach / 100;
    this.camera.far = reach * 20;
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x777788, 0.75));
    const sun = new THREE.DirectionalLight(0xffffff, 0.55);
    sun.position.copy(target).add(new THREE.Vector3(0.4 * reach, -0.6 * reach, 1.2 * reach));
    sun.target.position.copy(target);
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    Object.assign(sun.shadow.camera, {left: -reach, right: reach, top: reach, bottom: -reach, near: reach / 10, far: 4 * reach});
    sun.shadow.bias = -0.0005;
    this.scene.add(sun, sun.target);
    this.meshes = motion.bodies.map(b => {
      const plane = b.shape.shape === 'plane', round = !plane && b.shape.shape !== 'box';
      const material = plane ? new THREE.MeshLambertMaterial({color: '#c8ccc4', side: THREE.DoubleSide})
          : round ? new THREE.MeshPhongMaterial({map: stripes(palette[b.shape.shape]), shininess: 20})
          : new THREE.MeshLambertMaterial({color: palette.box, transparent: b.fixed, opacity: b.fixed ? 0.55 : 1});
      const mesh = new THREE.Mesh(geometryOf(b.shape, reach), material);
      mesh.castShadow = !plane && !b.fixed;
      mesh.receiveShadow = true;
      const group = new THREE.Group();
      group.position.fromArray(b.pose.position);
      const [w, x, y, z] = b.pose.orientation;
      group.quaternion.set(x, y, z, w).normalize();
      if (plane) placePlane(mesh, b.shape);
      group.add(mesh);
      this.scene.add(group);
      return group;
    });
    this.moving = this.meshes.filter((_, i) => !motion.bodies[i].fixed);
  }

  show(poses, time, at) {
    const count = this.moving.length, frames = poses.length / 7 / count;
    const frame = Math.min(frames - 1, time / this.motion.interval), first = Math.floor(frame);
    const next = Math.min(frames - 1, first + 1), share = frame - first;
    const turned = new THREE.Quaternion(), later = new THREE.Quaternion();
    this.moving.forEach((mesh, i) => {
      const p = 7 * (first * count + i), q = 7 * (next * count + i);
      mesh.position.set(...[0, 1, 2].map(k => poses[p + k] * (1 - share) + poses[q + k] * share));
      turned.set(poses[p + 4], poses[p + 5], poses[p + 6], poses[p + 3]);
      later.set(poses[q + 4], poses[q + 5], poses[q + 6], poses[q + 3]);
      mesh.quaternion.copy(turned.slerp(later, share));
    });
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.position.copy(at.position);
    this.camera.lookAt(at.target);
    this.camera.updateProjectionMatrix();
    this.renderer.render(this.scene, this.camera);
  }
}

// A camera on a sphere about its target, that both views share.
class Orbit {
  constructor(camera) {
    this.target = new THREE.Vector3(...camera.look_at);
    this.from = new THREE.Vector3(...camera.position).sub(this.target);
  }
  get position() { return this.from.clone().add(this.target); }
  turn(right, down) {
    const up = new THREE.Vector3(0, 0, 1);
    this.from.applyAxisAngle(up, -right);
    const side = up.clone().cross(this.from).normalize(), turned = this.from.clone().applyAxisAngle(side, -down);
    const height = turned.z / turned.length();
    if (Math.abs(height) < 0.99) this.from.copy(turned);
  }
  zoom(factor) { this.from.multiplyScalar(factor); }
  steer(canvas, redraw) {
    canvas.addEventListener('pointerdown', e => canvas.setPointerCapture(e.pointerId));
    canvas.addEventListener('pointermove', e => {
      if (!canvas.hasPointerCapture(e.pointerId)) return;
      this.turn(e.movementX / 150, e.movementY / 150);
      redraw();
    });
    canvas.addEventListener('wheel', e => { e.preventDefault(); this.zoom(Math.exp(0.001 * e.deltaY)); redraw(); }, {passive: false});
  }
}

function startMotion(motion) {
  const runs = motion.runs.map(r => ({...r, poses: decodePoses(r.poses)}));
  const orbit = new Orbit(motion.camera);
  const views = [new View(byId('left'), motion), new View(byId('right'), motion)];
  const select = byId('other');
  let time = 0, playing = false, before = 0;
  const draw = () => {
    views[0].show(runs[0].poses, time, orbit);
    views[1].show(runs[select.value].poses, time, orbit);
    byId('scrub').value = time;
    byId('clock').textContent = `${time.toFixed(2)} s`;
  };
  const tick = now => {
    if (!playing) return;
    time += (now - before) / 1000 * Number(byId('speed').value);
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
  const others = runs.length > 1 ? runs.slice(1) : runs;
  others.forEach(r => select.append(element('option', {value: runs.indexOf(r)}, r.name)));
  const note = () => { byId('other-note').textContent = runs[select.value].note; };
  select.addEventListener('change', () => { note(); draw(); });
  byId('scrub').max = motion.duration;
  byId('scrub').addEventListener('input', e => { play(false); time = Number(e.target.value); draw(); });
  byId('play').addEventListener('click', () => play(!playing));
  for (const view of views) orbit.steer(view.canvas, draw);
  addEventListener('resize', draw);
  note();
  const wanted = /[#&]t=([0-9.]+)/.exec(location.hash);
  if (wanted) time = Math.min(motion.duration, Number(wanted[1]));
  draw();
}
const needs = data.scene.needs, answer = data.runs[data.answer];
const percent = x => `${Math.round(100 * x)}%`;
const exactName = name => name === 'reference' ? 'exact cylinder' : name;
const measured = (value, need) => value === null ? 'the motion becomes absurd' : `${exponent(value)}${need.unit}`;

function table(heads, rows) {
  return element('table', {}, element('thead', {}, element('tr', {}, ...heads.map(h => element('th', {scope: 'col', class: 'text'}, h)))),
      element('tbody', {}, ...rows.map(r => element('tr', {}, ...r.map(c =>
          c instanceof HTMLTableCellElement ? c : element('td', {class: typeof c === 'number' ? '' : 'text'}, String(c)))))));
}
const wide = text => element('td', {class: 'text wrap'}, text);

// "can stands within 0.5°: 12° at 0.71 s"
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
          : `The cheapest models that meet all needs save ${percent(data.time_saved)} of the contacts' time: ` +
            `${exponent(answer.microseconds_per_step)} µs of a step instead of ${exponent(exact)} µs.`;
  byId('provenance').textContent = `${data.command}; ${data.machine.cpu}, ${data.machine.compiler}. ` +
      `The rest of a step, solver and harness, takes ${exponent(data.rest_of_step_microseconds)} µs.`;
}

function answerTables() {
  byId('kind-table').append(table(['pairs', 'model', 'ns a query', 'ns exactly', 'queries', 'next cheaper one breaks a need'],
      data.kinds.map(k => [wide(`${k.name} (${k.bodies})`), exactName(k.chosen), Math.round(k.nanoseconds), Math.round(k.exact_nanoseconds),
          k.asked, k.next_cheaper === null ? 'there is none' : `${k.next_cheaper.name}, ${Math.round(k.next_cheaper.nanoseconds)} ns`])));
  byId('need-table').append(table(['', 'need', 'measured', 'at'], answer.verdicts.map((v, i) => [
      element('td', {class: v.holds ? 'good text' : 'bad text'}, v.holds ? 'holds' : 'broken'), needs[i].text,
      measured(v.value, needs[i]), `${v.time.toFixed(2)} s`])));
}

function replayLine(evidence) {
  const command = element('code', {}, evidence.replay), button = element('button', {type: 'button'}, 'Copy');
  button.addEventListener('click', () => navigator.clipboard.writeText(evidence.replay).then(
      () => { button.textContent = 'Copied'; }, () => { button.textContent = 'Select and copy'; }));
  return element('div', {class: 'command'}, command, button);
}
function failures() {
  const list = byId('failure-list');
  for (const kind of data.kinds.filter(k => k.next_cheaper !== null)) {
    const run = data.runs[kind.next_cheaper.run], e = run.evidence;
    list.append(element('article', {}, element('h3', {}, `${kind.next_cheaper.name} for ${kind.name}`),
        element('p', {}, failure(run)),
        e && element('p', {}, `${e.bodies} at ${e.time.toFixed(2)} s: ${e.wrong}.`), e && replayLine(e)));
  }
  if (!list.children.length) list.append(element('p', {}, 'No cheaper model has a routine for any of these pairs.'));
}

// Runs with one candidate for all pairs; searches have longer names.
const isUniform = run => !run.name.includes(' ') && run.name !== 'combination';
function runTable() {
  byId('run-table').append(table(['model', 'µs of a step', 'error / limit', 'breaks first', 'worst answer before'],
      data.runs.filter(isUniform).map(r => [r.name, Number(r.microseconds_per_step.toPrecision(3)),
          element('td', {class: r.holds ? 'good' : 'bad'}, r.error === null ? 'absurd' : exponent(r.error)),
          wide(r.holds ? '' : failure(r)), wide(r.evidence ? `${r.evidence.bodies}: ${r.evidence.wrong}` : '')])));
  if (data.too_slow.length) byId('too-slow').textContent = `Not run, because their queries alone would take more than 3 s: ${data.too_slow.join(', ')}.`;
}

function chart() {
  const svg = byId('front'), left = 58, right = 740, top = 14, bottom = 372;
  const errors = data.runs.map(r => r.error).filter(e => e > 0 && e < 1e4).concat(1);
  const least = 10 ** Math.floor(Math.log10(Math.max(1e-3, Math.min(...errors)))), most = 10 ** Math.ceil(Math.log10(2 * Math.max(...errors)));
  const cost = data.runs.map(r => r.microseconds_per_step);
  const low = Math.log10(Math.min(...cost) * 0.8), high = Math.log10(Math.max(...cost) * 1.3);
  const x = c => left + (Math.log10(c) - low) / (high - low) * (right - left);
  const clamped = e => Math.min(most, Math.max(least, e === null ? most : e));
  const y = e => bottom - (Math.log10(clamped(e)) - Math.log10(least)) / Math.log10(most / least) * (bottom - top);
  for (let p = Math.round(Math.log10(least)); p <= Math.round(Math.log10(most)); ++p) {
    const at = y(10 ** p);
    svg.append(shape('line', {x1: left, x2: right, y1: at, y2: at, class: p === 0 ? 'limit' : 'grid'}),
               shape('text', {x: left - 6, y: at + 4, 'text-anchor': 'end', class: 'tick'}, String(Number((10 ** p).toPrecision(1)))));
  }
  for (let p = Math.ceil(low); p <= high; ++p) {
    svg.append(shape('line', {x1: x(10 ** p), x2: x(10 ** p), y1: top, y2: bottom, class: 'grid'}),
               shape('text', {x: x(10 ** p), y: bottom + 16, 'text-anchor': 'middle', class: 'tick'}, String(Number((10 ** p).toPrecision(1)))));
  }
  svg.append(shape('text', {x: (left + right) / 2, y: bottom + 36, 'text-anchor': 'middle'}, 'contacts of a step, µs'),
             shape('text', {x: 14, y: (top + bottom) / 2, 'text-anchor': 'middle', transform: `rotate(-90 14 ${(top + bottom) / 2})`}, 'error / limit'));
  svg.append(shape('path', {class: 'front', d: data.front.map((i, n) => `${n ? 'L' : 'M'}${x(cost[i])},${y(data.runs[i].error)}`).join('')}));
  const taken = [];
  const label = (run, at, text) => {
    if (taken.some(t => Math.abs(t[0] - at[0]) < 80 && Math.abs(t[1] - at[1]) < 12)) return;
    taken.push(at);
    const end = at[0] > right - 90;
    svg.append(shape('text', {x: at[0] + (end ? -8 : 8), y: at[1] - 6, class: 'label', 'text-anchor': end ? 'end' : 'start'}, text));
  };
  const named = data.runs.map((r, i) => i).sort((i, j) => (j === data.answer) - (i === data.answer) || (data.front.includes(j) - data.front.includes(i)));
  for (const i of named) {
    const run = data.runs[i], at = [x(cost[i]), y(run.error)], uniform = isUniform(run);
    const mark = shape('path', {class: run.holds ? 'holds' : 'broken', d: symbolPath(uniform ? 'circle' : 'diamond', ...at, uniform ? 4.5 : 3)});
    mark.append(shape('title', {}, `${run.name}: ${exponent(cost[i])} µs, ${run.holds ? 'all needs hold' : failure(run)}`));
    svg.append(mark);
    if (i === data.answer) svg.append(shape('circle', {cx: at[0], cy: at[1], r: 9, class: 'answer'}));
    if (i === data.answer) label(run, at, i === 0 ? 'exact, the answer' : 'the answer');
    else if (uniform) label(run, at, run.name);
  }
}

headline();
if (data.possible) {
  answerTables();
  failures();
}
runTable();
chart();
try {
  startMotion(data.motion);
} catch (e) {
  byId('motion-note').textContent = `The animation needs WebGL, which this browser does not give: ${e.message}`;
}
