// The page: its legend, its tables, and what the two views show.
const data = JSON.parse(byId('data').textContent), {marks} = data, view = makeView(byId('view'));
const truth = data.truth, given = data.configuration, answers = Object.entries(data.answers);
const whole = v => v === null ? '–' : v !== 0 && Math.abs(v) < 1e-3 ? v.toExponential() : String(v);
const vector = v => v === null ? '–' : `(${v.map(c => c === null ? 'nan' : String(c)).join(', ')})`;
const table = (heads, rows, text = []) => element('table', {}, element('thead', {}, element('tr', {},
    ...heads.map((h, i) => element('th', {scope: 'col', class: text.includes(i) ? 'text' : ''}, h)))),
    element('tbody', {}, ...rows.map(r => element('tr', {}, ...r.map((c, i) =>
        c instanceof HTMLTableCellElement ? c : element('td', {class: text.includes(i) ? 'text' : ''}, c))))));
function sign(name, size = 14) {
  const mark = name === null ? truthMark : markOf(name);
  const svg = shape('svg', {viewBox: '-8 -8 16 16', width: size, height: size, style: 'display:inline-block;width:14px;margin-right:.4em', 'aria-hidden': 'true'});
  svg.append(shape('path', {fill: `var(${mark.colour})`, d: symbolPath(mark.symbol, 0, 0, 5.5)}));
  return svg;
}

// What is shown: of the candidates at first those that fail, and our own.
const shown = new Set(answers.filter(([name, a]) => a.status === 'contact' && (name === 'reference' || a.score.outcome !== 'agree'))
    .map(([name]) => name));
let scene, shows;

// Puts the origin of everything into the contact of one of the true normals.
function aim(index) {
  scene = makeScene(given, truth, index);
  aimView(view, scene.normal, scene.across);
  slice.across = scene.across;
  shows = {contact: [], smaller: [smallerBody(scene)], whole: scene.bodies};
  fitView(view, mainBodies(scene));
  fitSlice(mainBodies(scene), scene.normal);
  turnSlice();
}
function turnSlice() {
  const angle = Number(byId('slice-turn').value) * Math.PI / 180;
  slice.across = add(times(scene.across, Math.cos(angle)), cross(scene.normal, scene.across), Math.sin(angle));
  redraw();
}
function redraw() {
  scene.marks = marksOf(scene, truth, answers.filter(([name]) => shown.has(name)));
  drawView(view, scene);
  drawSlice(scene);
}

function legend() {
  byId('legend').replaceChildren(element('span', {}, sign(null), 'truth'), ...answers.map(([name, a]) => {
    const box = element('input', {type: 'checkbox'});
    box.checked = shown.has(name);
    box.disabled = a.status !== 'contact';
    box.addEventListener('change', () => { box.checked ? shown.add(name) : shown.delete(name); redraw(); });
    return element('label', {}, box, sign(name), name, element('span', {class: 'quiet'}, a.score.outcome));
  }));
}
function showAll(all) {
  shown.clear();
  if (all) for (const [name, a] of answers) if (a.status === 'contact') shown.add(name);
  legend();
  redraw();
}

function truthValues() {
  const patches = truth.patch.map(p => p.kind === 'region' ? `a region of area ${exponent(p.area)} m²`
      : p.kind === 'segment' ? `a segment of length ${exponent(p.perimeter)} m` : 'a point');
  definitions('truth-values', [
    ['Signed distance is between', truth.signed_distance.join(' and ')],
    [`Normals (${truth.ties === 'unique' ? 'unique' : `ties: ${truth.ties}`})`, truth.normals.map(vector).join(', ')],
    ['Contact patch', truth.patch.map((p, i) => `${patches[i]} about ${vector(p.centroid)}`).join('; ')],
  ]);
}
function answerTables() {
  const outcome = a => element('td', {class: a.score.outcome === 'agree' ? 'text' : 'text bad'}, a.score.outcome);
  const name = n => element('td', {class: 'text'}, sign(n), n);
  byId('answer-table').append(table(
      ['candidate', 'outcome', 'signed distance', 'depth error', 'normal regret', 'angle, °', 'coverage', 'points', 'normal'],
      answers.map(([n, a]) => [name(n), outcome(a), a.status === 'contact' ? whole(a.signed_distance) : a.status,
          exponent(a.score.depth_error), exponent(a.score.normal_regret), exponent(a.score.normal_angle),
          cutShare(a.score.coverage), String(a.points.length), vector(a.normal)]), [0, 1, 8]));
  byId('reasons').append(...answers.filter(([, a]) => a.reason)
      .map(([n, a]) => element('p', {class: 'quiet'}, `${n}: ${a.reason}`)));
  byId('point-table').append(table(['candidate', 'position', 'depth', 'normal'],
      answers.flatMap(([n, a]) => a.points.map(p => [name(n), vector(p.position), whole(p.depth), vector(p.normal)])), [0, 1, 3]));
}

// Every number of the configuration by its path, as in "pose_a.position[2]".
function leaves(value, path = '') {
  if (Array.isArray(value)) return value.flatMap((v, i) => leaves(v, `${path}[${i}]`));
  if (value !== null && typeof value === 'object') {
    return Object.entries(value).flatMap(([key, v]) => leaves(v, path ? `${path}.${key}` : key));
  }
  return [[path, String(value)]];
}
function configuration() {
  const hex = new Map(leaves(data.hexadecimal)), exact = new Map(leaves(data.exact));
  byId('number-table').append(table(['field', 'decimal', 'hexadecimal', 'exact'], leaves(given).map(([path, value]) =>
      path.endsWith('.shape') ? [path, element('td', {class: 'text', colspan: 3}, value)]
          : [path, value, hex.get(path), element('td', {class: 'exact text'}, exact.get(path))]), [0, 1, 2, 3]));
  byId('line').textContent = JSON.stringify({id: data.id, ...given});
  byId('replay').textContent = data.replay;
  for (const button of document.querySelectorAll('[data-copies]')) {
    button.addEventListener('click', () => navigator.clipboard.writeText(byId(button.dataset.copies).textContent).then(
        () => { button.textContent = 'Copied'; }, () => { button.textContent = 'Select and copy'; }));
  }
}

function controls() {
  const onClick = (id, act) => byId(id).addEventListener('click', () => { act(); redraw(); });
  for (const which of ['contact', 'smaller', 'whole']) {
    onClick(`view-${which}`, () => fitView(view, shows[which], scene.reaches.contact));
    // In the slice the depth itself is to be seen, however long the patch is.
    onClick(`slice-${which}`, () => fitSlice(shows[which], scene.normal, scene.reaches.depth));
  }
  onClick('view-in', () => zoomView(view, 2));
  onClick('view-out', () => zoomView(view, 0.5));
  onClick('slice-in', () => zoomSlice(2));
  onClick('slice-out', () => zoomSlice(0.5));
  slice.svg.addEventListener('wheel', e => { e.preventDefault(); zoomSlice(Math.exp(-0.0015 * e.deltaY)); redraw(); }, {passive: false});
  byId('slice-stretch').addEventListener('change', e => { slice.stretch = e.target.checked; redraw(); });
  byId('slice-turn').addEventListener('input', turnSlice);
  byId('slice-normal').append(...truth.normals.map((n, i) => element('option', {value: i}, `${i + 1} of ${truth.normals.length}`)));
  byId('slice-normal').addEventListener('change', e => aim(Number(e.target.value)));
  byId('slice-normal-label').hidden = truth.normals.length === 1;
  byId('show-all').addEventListener('click', () => showAll(true));
  byId('show-none').addEventListener('click', () => showAll(false));
  steerView(view, redraw);
  addEventListener('resize', redraw);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
}

byId('title').textContent = data.id;
byId('description').textContent = data.description;
byId('name-b').textContent = `${given.b.shape} B`;
const distance = Number(truth.signed_distance[0]), failing = answers.filter(([, a]) => !['agree', 'unsupported'].includes(a.score.outcome));
byId('truth-line').textContent = `${distance < 0 ? `${exponent(-distance)} m deep` : `${exponent(distance)} m apart`}; ` +
    (failing.length ? `${failing.length} of ${answers.length} candidates disagree.` : 'all candidates agree.');
legend();
truthValues();
answerTables();
configuration();
controls();
aim(0);
