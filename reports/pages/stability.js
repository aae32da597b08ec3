// Draws a "stability" object (docs/motion.md) into an element: charts of small steps, maps of failure, motions.
function drawStability(into, study) {
  into.hidden = false;
  into.append(element('p', {}, 'What a tiny change of pose does to an answer, near poses that are exactly parallel, perpendicular ' +
      'or touching. Lengths are in sizes of the smaller shape.'));
  const inOrder = results => study.candidates.filter(n => results.some(r => r.candidate === n));
  if (study.amplification) drawSteps(into, study.amplification, inOrder(study.amplification.results));
  if (study.maps) drawMaps(into, study.maps, inOrder(study.maps.poses.flatMap(p => p.results)));
  if (study.sequences) drawMotions(into, study.sequences, inOrder(study.sequences.motions.flatMap(m => m.results)));
}
// The page of `touchstone stability` is this section alone.
function drawStabilityPage() {
  byId('provenance').append(`Touchstone ${data.version}. Same figures again: `, element('code', {}, data.command));
  drawStability(byId('stability'), data);
  for (const part of document.querySelectorAll('details')) part.open = true;
}

// A label and its select box.
function labelledSelect(label, values, change) {
  const list = element('select', {}, ...options(values));
  list.addEventListener('change', change);
  return [element('label', {class: 'long'}, `${label} `, list), list];
}

// The head of a column that tells more on hover and focus.
function explainedHead(text, more) {
  const head = column(text, {class: 'text pose'});
  explain(head, more);
  return head;
}

// Small steps: one chart per pair, one line per candidate.
const stepMeasures = {  // [words, whether a share, the limit]
  amplification: ['change of depth over what the step allows', false, 1],
  hull_excess: ['movement of the points beyond that of the contact patch', false],
  regret: ['regret of the normal', false],
  points_changed: ['share of steps that change the number of points', true],
  missed: ['share of steps that end in a missed contact', true],
};
function drawSteps(into, ladder, names) {
  const classes = [...new Set(ladder.results.map(r => r.class))], pairs = [...new Set(ladder.results.map(r => r.pair))];
  const [measureLabel, measure] = labelledSelect('Show', Object.entries(stepMeasures).map(([k, [words]]) => [k, words]), draw);
  const [classLabel, poseClass] = labelledSelect('in', [['all', 'all of these classes'], ...classes], draw);
  const legend = element('div', {class: 'legend', role: 'group', 'aria-label': 'Candidates shown'});
  showUsual(names);
  shownLegend(legend, names);
  const places = pairs.map(pair => [pair, element('div', {class: 'chart'})]);
  into.append(element('h3', {}, 'Small steps'), element('p', {},
      'Around each configuration A is moved or turned in random directions, by 1e-16 to 1e-1 of the size. ' +
      'The true depth changes by no more than the step; an answer that jumps by a fixed amount, however ' +
      'small the step, is a line that rises to the left.'),
      element('p', {class: 'controls'}, measureLabel, classLabel), legend,
      element('div', {class: 'panels'}, ...places.map(([pair, place]) => element('figure', {}, element('figcaption', {}, dashed(pair)), place))),
      worstSteps(ladder.worst));

  // For each amplitude the largest value, or the mean share; null where nothing was measured.
  function values(pair, name, [, isShare]) {
    const rows = ladder.results.filter(r => r.pair === pair && r.candidate === name && (poseClass.value === 'all' || r.class === poseClass.value));
    return ladder.amplitudes.map((_, i) => {
      const here = rows.map(r => r[measure.value][i]).filter(v => v !== null);
      if (here.length === 0) return null;
      return isShare ? here.reduce((a, b) => a + b, 0) / (rows.length * ladder.count) : Math.max(...here);
    });
  }
  function chart(pair, place) {
    const [words, isShare, limit] = stepMeasures[measure.value];
    const points = names.filter(n => shown.has(n)).reverse().flatMap(name =>  // the first on top
        values(pair, name, stepMeasures[measure.value]).flatMap((v, i) => v === null ? [] : [{...markData(name), x: ladder.amplitudes[i], y: v,
            tip: `${name}, ${dashed(pair)}\nstep ${exponent(ladder.amplitudes[i])}: ${exponent(v)}`}]));
    if (points.length === 0) return place.replaceChildren('Nothing measured.');
    const all = points.map(p => p.y).filter(v => v > 0), low = 10 ** Math.max(isShare ? -3 : -17, Math.floor(Math.log10(Math.min(0.1, ...all))));
    for (const p of points) p.y = Math.max(low, p.y);
    const y = powerAxis('', [low, isShare ? 1 : Math.max(10, ...all)]);
    drawLines(place, `${words} against the amplitude of the step, ${dashed(pair)}`, {height: 250, points, limit,
        x: {...powerAxis('amplitude of the step', ladder.amplitudes), domain: [ladder.amplitudes[0], ladder.amplitudes.at(-1)]},
        y: {...y, label: `(datum.value < ${1.1 * low} ? '≤' : '') + (${powerLabel})`}});
  }
  function draw() { for (const [pair, place] of places) chart(pair, place); }
  keepDrawn(draw);
}
function worstSteps(worst) {
  const rows = worst.filter(w => w.measure === 'amplification' && w.value > 1 + 1e-9).sort((a, b) => b.value - a.value);
  if (rows.length === 0) return '';
  return fold('Worst steps, by change of depth over what the step allows',
      element('div', {class: 'scroll'}, table([...['candidate', 'pair', 'from', 'to'].map(textColumn), 'times'], rows.map(w =>
          [named(w.candidate), w.pair, ...[w.from, w.to].map(id => element('td', {class: 'text wrap'}, element('code', {}, id))), exponent(w.value)]), 'Worst steps')));
}

// What letters alone would not tell.
const poseWords = {t: 't: a cap across a side', x: 'x: sides that cross'};
// Maps of failure: one row per candidate, one column per critical pose.
function drawMaps(into, maps, names) {
  const place = element('div', {class: 'scroll'});
  const shown = element('p', {class: 'command', role: 'status'}, 'Point at a pixel for its outcome; click for the command that replays it (with the keyboard, Enter: the middle).');
  const [label, zoom] = labelledSelect('Zoom', maps.zooms.map((z, i) => [i, z]), draw);
  zoom.value = Math.max(0, maps.zooms.indexOf('1e-8'));
  const seen = Object.entries(maps.letters).filter(([letter]) =>
      maps.poses.some(p => p.results.some(r => r.maps.some(m => m.includes(letter))))).map(([, outcome]) => outcome);
  into.append(fold('Maps of failure', element('p', {},
      'Each picture surrounds an exactly degenerate pose, in its middle, with tiny changes of two kinds: tilts, ' +
      'turns (radians) or offsets up to the zoom. A colour is what became of the answer; few points: right, but ' +
      'covering less than 0.3 of the contact patch.'),
      element('p', {class: 'controls'}, label), outcomeLegend(seen), place, shown));
  const show = (result, pixel) => shown.replaceChildren(`${result.candidate}, ${maps.letters[pixel.letter]}: `,
      element('code', {}, `${programOf(result.candidate)} replay ${pixel.name} --candidates ${result.candidate}`));
  function draw() {
    const heads = maps.poses.map(p => explainedHead(poseWords[p.pose] || p.pose, `${p.description} Across: ${p.columns}. Up: ${p.rows}.`));
    place.replaceChildren(table([textColumn('candidate'), ...heads], names.map(name => [rowHead(named(name)), ...maps.poses.map(p => {
      const result = p.results.find(r => r.candidate === name);
      const picture = result ? mapPicture(maps, p, result, Number(zoom.value), show) : '–', cell = element('td', {class: 'map-cell'}, picture);
      if (result) cell.addEventListener('keydown', e => { if (e.key === 'Enter') picture.showMiddle(); });
      return cell;
    })]), `Zoom ${maps.zooms[zoom.value]}`));
  }
  draw();
  onThemeChange(draw);
}
function mapPicture(maps, pose, result, zoom, show) {
  const side = 2 * maps.reach / maps.stride + 1;
  const letters = result.maps[zoom].replace(/(\d+)(\D)/g, (_, n, letter) => letter.repeat(n));  // "3m2." is mmm..
  const counts = Object.entries(maps.letters).map(([letter, outcome]) => [outcome, letters.split(letter).length - 1]).filter(c => c[1]);
  const pixel = Math.max(2, Math.min(4, Math.floor(112 / side)));  // nine maps side by side fit the page
  const canvas = element('canvas', {class: 'map', width: side, height: side, role: 'img', style: `width:${pixel * side}px;height:${pixel * side}px`,
    'aria-label': `Map of failure, ${result.candidate}, ${pose.pose}, zoom ${maps.zooms[zoom]}; pixels: ${counts.map(c => c.join(' ')).join(', ')}`});
  const context = canvas.getContext('2d'), style = getComputedStyle(document.documentElement);
  [...letters].forEach((letter, i) => {
    context.fillStyle = style.getPropertyValue(outcomeColour(maps.letters[letter]));
    context.fillRect(i % side, Math.floor(i / side), 1, 1);
  });
  const pixelAt = (column, row) => ({letter: letters[row * side + column],
    name: `map/${pose.pose}/${maps.zooms[zoom]}/${column * maps.stride - maps.reach}/${maps.reach - row * maps.stride}`});
  const at = event => {
    const box = canvas.getBoundingClientRect();
    const column = Math.min(side - 1, Math.floor((event.clientX - box.left) / box.width * side));
    const row = Math.min(side - 1, Math.floor((event.clientY - box.top) / box.height * side));
    return pixelAt(column, row);
  };
  canvas.addEventListener('mousemove', event => { canvas.title = `${maps.letters[at(event).letter]}  ${at(event).name}`; });
  canvas.addEventListener('click', event => show(result, at(event)));
  canvas.showMiddle = () => show(result, pixelAt((side - 1) / 2, (side - 1) / 2));
  return canvas;
}

// Motions: one row per candidate, one column per motion.
const motionMeasures = {
  jump: ['largest change of depth beyond the true one', r => r.jump],
  hull_excess: ['largest movement of the points beyond that of the contact patch', r => r.hull_excess],
  hull: ['largest movement of the points', r => r.hull],
  points_changed: ['steps that change the number of points', r => r.points_changed],
  missed: ['missed contacts', r => r.missed],
  wrong: ['answers that do not agree', r => r.wrong],
};
function drawMotions(into, sequences, names) {
  const step = (motion, i) => `sequence/${motion.motion}/${i}/${sequences.steps}`;
  const place = element('div', {class: 'scroll'});
  const [label, measure] = labelledSelect('Show', Object.entries(motionMeasures).map(([k, v]) => [k, v[0]]), draw);
  into.append(fold('Slow motions through degenerate poses', element('p', {},
      `Slow motions through degenerate poses in ${sequences.steps} steps, in which depth and contact points should ` +
      'change as smoothly as the truth does. Hover over a cell for the step.'),
      element('p', {class: 'controls'}, label), place));
  function cell(m, result) {
    const value = result ? motionMeasures[measure.value][1](result) : null;
    if (value === null) return element('td', {}, '–');
    if (typeof value === 'number') return element('td', {style: heated(value / sequences.steps)}, String(value));
    const shown = element('td', {style: heated(value.value > 0 ? (Math.log10(value.value) + 6) / 6 : 0)}, exponent(value.value));
    explain(shown, `${step(m, value.step - 1)} to\n${step(m, value.step)}`);
    return shown;
  }
  function draw() {
    const heads = sequences.motions.map(m => explainedHead(m.motion, m.description));
    const truth = sequences.motions.map(m => element('td', {}, measure.value === 'jump' ? exponent(m.truth.depth)
        : measure.value.startsWith('hull') ? exponent(m.truth.patch) : ''));
    place.replaceChildren(table([textColumn('candidate'), ...heads], [element('tr', {class: 'pinned'}, rowHead('truth, a step'), ...truth),
        ...names.map(name => [rowHead(named(name)), ...sequences.motions.map(m => cell(m, m.results.find(r => r.candidate === name)))])],
        `Each motion: ${motionMeasures[measure.value][0]}`));
  }
  draw();
}
