// The page of `touchstone replay`: a slice through the contact, the legend, tables, and what the two views show.

// The section of both bodies with the plane of the true normal (upwards) and a direction across it.
const slice = {svg: byId('slice'), across: [1, 0, 0], metres: 1, pan: [0, 0, 0], stretch: false};

const sliceWidth = 480, sliceHeight = 360;
// Fits the slice to these bodies or, without any, to `reach` about a point, at first the contact. `metres` is the width shown.
function fitSlice(bodies, n, reach, about = [0, 0, 0]) {
  const points = bodies.flatMap(b => b.faces.flat());
  const {centre, half} = points.length ? bounds(points, [slice.across, n, cross(slice.across, n)])
      : {centre: about, half: [reach, reach]};
  slice.pan = centre;
  slice.metres = 2.2 * Math.max(half[0], half[1] * sliceWidth / sliceHeight);
}
function zoomSlice(factor) {
  slice.metres /= factor;
  slice.pan = times(slice.pan, 1 / factor);
}

// The outline of a body's section for x in [x0, x1], with y limited to [y0, y1]: chords along n, column by column, and
// both ends by bisection, for a section is convex.
function section(body, n, t, [x0, x1], [y0, y1]) {
  const at = x => chord(body, times(t, x), n);
  const columns = 480, xs = [];
  for (let i = 0; i <= columns; ++i) xs.push(x0 + (x1 - x0) * i / columns);
  const own = dot(body.centre, t);  // also of a needle that is thinner than a column
  for (const x of [own, 0]) if (x > x0 && x < x1) xs.push(x);
  xs.sort((a, b) => a - b);
  const hit = xs.filter(x => at(x) !== null);
  if (hit.length === 0) return [];
  const end = (outside, inside) => {
    for (let i = 0; i < 60; ++i) {
      const middle = (outside + inside) / 2;
      if (at(middle) === null) outside = middle; else inside = middle;
    }
    return inside;
  };
  const first = xs.indexOf(hit[0]), last = xs.lastIndexOf(hit[hit.length - 1]);
  if (first > 0) hit.unshift(end(xs[first - 1], xs[first]));
  if (last + 1 < xs.length) hit.push(end(xs[last + 1], xs[last]));
  const cut = y => Math.max(y0, Math.min(y1, y));
  const chords = hit.map(at);
  return [...hit.map((x, i) => [x, cut(chords[i][1])]), ...hit.map((x, i) => [x, cut(chords[i][0])]).reverse()];
}

// Draws the slice of a scene (see makeScene).
function drawSlice(scene) {
  const width = sliceWidth, height = sliceHeight, n = scene.normal, t = slice.across, s = cross(n, t);
  const xScale = width / slice.metres;
  const depth = Math.abs(scene.signedDistance);
  const yScale = slice.stretch && depth > 0 ? Math.max(xScale, height / (8 * depth)) : xScale;
  // Heights are stretched about the contact.
  const panX = dot(slice.pan, t), panY = dot(slice.pan, n) * xScale / yScale;
  const x = v => width / 2 + xScale * (v - panX), y = v => height / 2 - yScale * (v - panY);
  const xRange = [-0.52, 0.52].map(k => panX + k * slice.metres), yRange = [-0.55, 0.55].map(k => panY + k * height / yScale);
  const parts = scene.bodies.map((body, i) => shape('path', {class: 'ab'[i],
      d: section(body, n, t, xRange, yRange).map(([a, b], k) => `${k ? 'L' : 'M'}${x(a).toFixed(2)},${y(b).toFixed(2)}`).join('') + 'z'}));
  for (const mark of scene.marks) {
    const px = x(dot(mark.position, t)), py = y(dot(mark.position, n));
    if (!(px > -40 && px < width + 40 && py > -40 && py < height + 40)) continue;
    const off = Math.abs(dot(mark.position, s)) * xScale > 3;  // pixels
    const reach = mark.large ? 64 : 48;
    const colour = `var(${mark.colour})`;
    parts.push(shape('line', {x1: px, y1: py, x2: px + reach * dot(mark.normal, t), y2: py - reach * dot(mark.normal, n),
                              stroke: colour, 'stroke-width': mark.large ? 2.5 : 1.8}));
    parts.push(shape('path', {d: symbolPath(mark.symbol, px, py, mark.large ? 5 : 4), stroke: colour,
                              fill: off ? 'var(--panel)' : colour, 'stroke-width': 1.4}));
  }
  const across = scaleBar(xScale), up = scaleBar(yScale);
  parts.push(shape('path', {d: `M10,338v6h${across.pixels}v-6`, fill: 'none', stroke: 'var(--ink)', 'stroke-width': 1.5}),
             shape('text', {x: 10, y: 332}, across.text));
  if (yScale !== xScale) {
    parts.push(shape('path', {d: `M464,${344 - up.pixels}h6v${up.pixels}h-6`, fill: 'none', stroke: 'var(--ink)', 'stroke-width': 1.5}),
               shape('text', {x: 460, y: 344, 'text-anchor': 'end'}, `heights: ${up.text}`));
  }
  slice.svg.replaceChildren(...parts);
}

// Of a cast the views show the truth where A touches, if it does, with A as far along its sweep as the slider says.
const view = makeView(byId('view'));
const cast = data.cast, castAnswers = Object.entries(cast?.answers ?? {}), touches = Boolean(cast?.truth.there);
const truth = touches ? cast.truth.there : data.truth, given = data.configuration, answers = Object.entries(data.answers);
const touch = cast ? Number(cast.truth.fraction[1]) : 0;
let part = touch;
const shortest = v => v === null ? '–' : plainNumber(v);
const vectorCell = v => element('td', {class: 'text wrap'}, vector(v));
const vector = v => v === null ? '–' : `(${v.map(c => c === null ? 'nan' : plainNumber(c)).join(', ')})`;

// The candidates shown: at first those that fail, and our own.
const shown = new Set(answers.filter(([name, a]) => a.status === 'contact' && (name === 'reference' || a.score.outcome !== 'agree'))
    .map(([name]) => name));
let scene, shows;

// Moves the origin to the contact of the true normal `index`.
function place(index) {
  scene = makeScene(cast ? sweptTo(given, part) : given, truth, index, data.faces);
  shows = {contact: [], smaller: [smallerBody(scene)], whole: scene.bodies};
}
function aim(index) {
  place(index);
  aimView(view, scene.normal, scene.across);
  slice.across = scene.across;
  const thin = closeUp(view, scene), bodies = thin ? [] : mainBodies(scene);
  fitView(view, bodies, thin?.reach, thin?.about);
  fitSlice(bodies, scene.normal, thin?.reach, thin?.about);
  turnSlice();
}
function turnSlice() {
  const angle = Number(byId('slice-turn').value) * Math.PI / 180;
  slice.across = add(times(scene.across, Math.cos(angle)), cross(scene.normal, scene.across), Math.sin(angle));
  redraw();
}
function redraw() {
  scene.marks = touches || !cast ? marksOf(scene, truth, cast ? [] : answers.filter(([name]) => shown.has(name))) : [];
  drawContact(view, scene);
  drawSlice(scene);
}

function legend() {
  byId('legend').replaceChildren(element('span', {}, symbolSign(truthMark), 'truth'), ...answers.map(([name, a]) => {
    const box = element('input', {type: 'checkbox'});
    box.checked = shown.has(name);
    box.disabled = a.status !== 'contact';
    box.addEventListener('change', () => { box.checked ? shown.add(name) : shown.delete(name); redraw(); });
    return element('label', {}, box, sign(name), name, element('span', {class: 'quiet'}, swatch(a.score.outcome), a.score.outcome));
  }));
}
function showAll(all) {
  shown.clear();
  if (all) for (const [name, a] of answers) if (a.status === 'contact') shown.add(name);
  legend();
  redraw();
}

// The slider, and what candidates answer.
function sweepControls() {
  const stops = [[`truth: ${cast.truth.status}`, touch], ...castAnswers.filter(([, a]) => a.fraction !== undefined)
      .map(([name, a]) => [`${name}: ${a.status}`, a.fraction])];
  byId('sweep').append(sweepControl(part, stops, to => {
    part = to;
    place(Number(byId('slice-normal').value || 0));
    redraw();
  }));
  byId('cast-table').append(table([textColumn('candidate'), textColumn('outcome'), textColumn('answer'), 'fraction', 'left there', 'regret', textColumn('normal')],
      castAnswers.map(([n, a]) => [named(n), element('td', {class: 'text'}, a.score.outcome), element('td', {class: 'text'}, a.reason ? `${a.status}: ${a.reason}` : a.status),
          shortest(a.fraction ?? null), exponent(a.score.distance), exponent(a.score.normal_regret), vectorCell(a.normal ?? null)]),
      'When A touches first; what is left is the signed distance there, relative to the smaller size'));
  byId('casts').hidden = false;
  document.querySelector('fieldset.legend').style.display = 'none';
  document.querySelector('#answers h2').textContent = 'Answers before A moves';
  if (touches) document.querySelector('#truth h2').textContent = 'Truth where A touches';
}

function truthValues() {
  const patches = truth.patch.map(p => p.kind === 'region' ? `a region of area ${exponent(p.area)} m²`
      : p.kind === 'segment' ? `a segment of length ${exponent(p.perimeter)} m` : 'a point');
  definitions('truth-values', [
    ...(cast ? [[`A touches B: ${cast.truth.status}; as a part of the sweep, between`, cast.truth.fraction.join(' and ')]] : []),
    ['Signed distance is between', truth.signed_distance.join(' and ')],
    [`Normals (${truth.ties === 'unique' ? 'unique' : `ties: ${truth.ties}`})`, truth.normals.map(vector).join(', ')],
    ['Contact patch', truth.patch.map((p, i) => `${patches[i]} about ${vector(p.centroid)}`).join('; ')],
  ]);
}
function answerTables() {
  byId('answer-table').append(table([textColumn('candidate'), textColumn('outcome'), 'signed distance', 'depth error',
      'regret', 'angle, °', 'cover', 'points', 'off by', textColumn('normal')],
      answers.map(([n, a]) => [named(n), outcomeCell(a.score.outcome), a.status === 'contact' ? shortest(a.signed_distance) : a.status,
          exponent(a.score.depth_error), exponent(a.score.normal_regret),
          exponent(a.score.normal_angle), cutShare(a.score.coverage), String(a.points.length), exponent(a.score.point_error),
          vectorCell(a.normal)]), 'Answers and their scores'));
  byId('reasons').append(...answers.filter(([, a]) => a.reason)
      .map(([n, a]) => element('p', {class: 'quiet'}, `${n}: ${a.reason}`)));
  byId('point-table').append(table([textColumn('candidate'), textColumn('position'), 'depth', textColumn('normal')],
      answers.flatMap(([n, a]) => a.points.map(p => [named(n), vectorCell(p.position), shortest(p.depth), vectorCell(p.normal)])), 'Positions and depths in metres'));
}

// Every number of the configuration with its path, such as "pose_a.position[2]".
function leaves(value, path = '') {
  if (Array.isArray(value)) return value.flatMap((v, i) => leaves(v, `${path}[${i}]`));
  if (value !== null && typeof value === 'object') {
    return Object.entries(value).flatMap(([key, v]) => leaves(v, path ? `${path}.${key}` : key));
  }
  return [[path, String(value)]];
}
function configuration() {
  const hex = new Map(leaves(data.hexadecimal)), exact = new Map(leaves(data.exact));
  byId('number-table').append(table(['field', 'decimal', 'hexadecimal', 'exact'].map(textColumn), leaves(given).map(([path, value]) =>
      path.endsWith('.shape') ? [path, element('td', {class: 'text', colspan: 3}, value)]
          : [path, value, hex.get(path), element('td', {class: 'exact text'}, exact.get(path))]), 'Every number of the configuration'));
  byId('line').append(command(JSON.stringify({id: data.id, ...given})));
  byId('replay').append(command(data.replay));
}

function controls() {
  const onClick = (id, act) => byId(id).addEventListener('click', () => { act(); redraw(); });
  for (const which of ['contact', 'smaller', 'whole']) {
    onClick(`view-${which}`, () => fitView(view, shows[which], scene.reaches.contact));
    // The slice shows the depth itself, however long the patch is.
    onClick(`slice-${which}`, () => fitSlice(shows[which], scene.normal, scene.reaches.depth));
  }
  onClick('view-in', () => zoomView(view, 2));
  onClick('view-out', () => zoomView(view, 0.5));
  onClick('slice-in', () => zoomSlice(2));
  onClick('slice-out', () => zoomSlice(0.5));
  slice.svg.addEventListener('wheel', e => { e.preventDefault(); zoomSlice(Math.exp(-0.0015 * e.deltaY)); redraw(); }, {passive: false});
  byId('slice-stretch').addEventListener('change', e => { slice.stretch = e.target.checked; redraw(); });
  byId('slice-turn').addEventListener('input', turnSlice);
  byId('slice-normal').append(...options(truth.normals.map((n, i) => [i, `${i + 1} of ${truth.normals.length}`])));
  byId('slice-normal').addEventListener('change', e => aim(Number(e.target.value)));
  byId('slice-normal-label').hidden = truth.normals.length === 1;
  byId('show-all').addEventListener('click', () => showAll(true));
  byId('show-none').addEventListener('click', () => showAll(false));
  steerView(view, redraw);
  addEventListener('resize', redraw);
  onThemeChange(redraw);
}

byId('title').textContent = data.id;
byId('description').textContent = data.description;
byId('name-b').textContent = nameOfB(given.b);
const distance = Number(truth.signed_distance[0]), judged = cast ? castAnswers : answers;
const failing = judged.filter(([, a]) => isFailure(a.score.outcome)), byOutcome = new Map();
for (const [name, a] of failing) byOutcome.set(a.score.outcome, [...byOutcome.get(a.score.outcome) ?? [], name]);
const fact = !cast ? `${exponent(Math.abs(distance))} m ${distance < 0 ? 'deep' : 'apart'}`
    : {touch: `A touches B at ${plainNumber(touch, 4)} of its sweep`, never: 'A never touches B', 'from-start': 'A touches B before it moves'}[cast.truth.status] ?? 'No proof tells whether A touches B';
byId('headline').textContent = `${fact}; ` + (failing.length ? `${failing.length} of ${judged.length} candidates disagree: ` +
    [...byOutcome].sort(([a], [b]) => outcomes.indexOf(a) - outcomes.indexOf(b)).map(([outcome, names]) => `${outcome} ${names.join(', ')}`).join('; ') + '.' : judged.length ? 'all candidates agree.' : 'no candidate has such casts.');
legend();
truthValues();
answerTables();
configuration();
controls();
if (cast) sweepControls();
aim(0);
listSections();
