// The report's tables: all numbers, Drake's protocol, pose classes, contact points, experiments, outcomes.

const millimetres = metres => metres === null ? 'refuses' : `${exponent(1000 * metres)}`;
function drakeProtocol() {
  const protocol = report.drake_protocol;
  if (!protocol) return byId('drake-table').append(
      report.candidates.some(c => c.given) ? 'Not measured: the answers came in a file.' : 'Not measured: the run was interrupted.');
  const published = query => element('tr', {class: 'pinned published'}, rowHead(`Drake, ${query === 'penetration' ? 'point pair' : 'signed distance'}`),
      ...protocol.pairs.map(p => element('td', {}, millimetres(p.published[query]))));
  const rows = candidates.map(name => [rowHead(named(name)),
      ...protocol.pairs.map(p => drakeCell(p, protocol.results.find(r => r.pair === p.pair && r.candidate === name)))]);
  byId('drake-table').append(table([textColumn('query'), ...pairs.map(p => column(otherShape(p)))], [published('penetration'), published('signed_distance'), ...rows],
      'Cylinder against …: worst error, millimetres'));
}
function drakeCell(pair, r) {
  if (supported(r) === 0) return notAvailable();
  const cell = element('td', {class: 'heat',
      style: heated(r.max_error === null ? 1 : decade(1e3 * r.max_error))}, r.max_error === null ? '–' : millimetres(r.max_error),
      lost(r) ? element('small', {}, `${lost(r)} lost`) : null);
  const worst = r.worst === null ? null : pair.configurations[r.worst];
  explain(cell, `${r.candidate}, ${dashed(r.pair)}, ${r.count} poses\n${outcomesText(r)}` + (worst ? `\nworst: ${worst.description}\nClick for the command` : ''));
  if (worst) {
    whenPressed(cell, () => byId('drake-command').replaceChildren(
        element('p', {}, `${r.candidate}, ${worst.description}:`),
        command(`echo '${JSON.stringify(worst.configuration)}' | ${programOf(r.candidate)} replay - --candidates ${r.candidate}`)));
  }
  return cell;
}
drakeProtocol();

// A candidate's name, with the pairs that its row over all of them is over.
const namedOver = r => [named(r.candidate), coveredText(r) ? element('small', {class: 'quiet'}, coveredText(r)) : null];

// Agreement, errors and speed of one pair at a time; and the errors of simplified models.
function summaryTable() {
  const wide = text => column(text, {class: 'wide'});
  const heads = [textColumn('candidate'), 'agrees', 'wrong yes/no', 'error, p99', wide('error, max'), wide('bias'), wide('regret, p99'),
                 'points, p99', wide('coverage'), 'ns', wide('ns, p95'), wide('× Bullet')];
  const rows = ranked().map(r => {
    const share = agreeing(r), ratio = r.nanoseconds && r.nanoseconds.ratio_to_bullet;
    return [rowHead(...namedOver(r)), element('td', {class: share === 1 ? 'good' : '', 'data-value': share}, agreement(r)),
            element('td', {class: r.outcomes.missed || r.outcomes.phantom ? 'bad' : '', 'data-value': (r.outcomes.phantom || 0) + (r.outcomes.missed || 0)},
                `${whole(r.outcomes.phantom || 0)} / ${whole(r.outcomes.missed || 0)}`),
            exponent(quantile(r.depth_error, 'p99')), element('td', {class: 'wide'}, exponent(quantile(r.depth_error, 'max'))),
            biasText(r), exponent(quantile(r.normal_regret, 'p99')), exponent(quantile(r.point_error, 'p99')), cutShare(quantile(r.coverage, 'mean')), timeCell(r),
            element('td', {class: 'wide'}, whole(tail(r))),
            ratio ? (r.tied_with.includes('bullet') ? '~' : '') + ratio.toFixed(2) : '–'];
  });
  byId('summary-table').replaceChildren(table(heads, rows,
      `Agreement, errors of the reported contacts, nanoseconds per query, ${pairWords(chosen.pair)}, ${chosen.group} poses`));
}

function timeCell(r) {
  const t = r.nanoseconds;
  if (!t || t.floor === null) return whole(time(r));
  const cell = element('td', {}, whole(time(r)), element('small', {}, `floor ${whole(t.floor)}`));
  explain(cell, `${r.candidate}, ${dashed(r.pair)}: ${whole(time(r))} ns` + floorText(r));
  return cell;
}
const biasText = r => r.bias === null ? '–' : `${r.bias.median > 0 ? '+' : ''}${exponent(r.bias.median)}`;

// The errors of a model, be it a simplified one or a body with rounded edges, and of its solver.
const modelled = report.summary.filter(r => r.model_error !== null);
function modelTable() {
  const rows = modelled.filter(r => r.class === chosen.group && r.pair === summedPair()).map(r => {
    const name = rowHead(...namedOver(r));
    explain(name, meaningOf(r.candidate));
    return [name, ...[r.model_error, r.solver_error].flatMap(q => ['median', 'p99'].map(which => exponent(quantile(q, which))))];
  });
  byId('model-table').replaceChildren(table([textColumn('candidate'), 'model, median', 'p99', 'solver, median', 'p99'], rows,
      `Errors of model and solver, ${pairWords(chosen.pair)}, ${chosen.group} poses`));
}
follow(summaryTable);
byId('models').hidden = modelled.length === 0;
follow(modelTable);

// Pose classes: a table whose cells are coloured by one quantity, of all candidates on the pair that is chosen or, on all pairs,
// of the candidate.
const quantities = {
  fail: {value: r => 1 - agreeing(r), text: r => agreeing(r) === 1 ? '0' : disagreement(r), level: failed},
  worst: {value: r => quantile(r.severity, 'max'), text: r => exponent(quantile(r.severity, 'max')), level: decade},
  depth: {value: r => quantile(r.depth_error, 'p99'), text: r => exponent(quantile(r.depth_error, 'p99')), level: decade},
  regret: {value: r => quantile(r.normal_regret, 'p99'), text: r => exponent(quantile(r.normal_regret, 'p99')), level: decade},
  coverage: {value: r => quantile(r.coverage, 'mean'), text: r => cutShare(quantile(r.coverage, 'mean')), level: v => 1 - v},
  time: {value: time, text: r => whole(time(r)), level: v => (Math.log10(v) - 1) / 4},
  tail: {value: tail, text: r => whole(tail(r)), level: v => (Math.log10(Math.max(v, 10)) - 1) / 4},
};
const resultAt = new Map(report.results.map(r => [`${r.pair}/${r.class}/${r.candidate}`, r]));

function classTable() {
  const {candidate, pair} = chosen, ofOne = pair === 'all';
  const quantity = quantities[byId('class-quantity').value], what = byId('class-quantity').selectedOptions[0].text;
  const classes = [...new Map(report.classes.filter(c => c.group === chosen.group && ofPair(c)).map(c => [c.class, c])).values()];
  const columns = ofOne ? pairs.map(p => [p, candidate]) : candidates.map(c => [pair, c]);
  const rows = classes.map(c => {
    const name = rowHead(...classWords(c.class));
    explain(name, c.description);
    return [name, ...columns.map(([p, k]) => classCell(c, resultAt.get(`${p}/${c.class}/${k}`), quantity))];
  });
  byId('class-table').replaceChildren(table([textColumn('pose class'),
      ...columns.map(([p, k]) => ofOne ? otherShape(p) : column(named(k), {class: 'slanted'}))], rows, `${ofOne ? candidate : dashed(pair)}: ${what}`));
}
function classCell(c, r, quantity) {
  if (!r || supported(r) === 0) return notAvailable();
  const value = quantity.value(r), level = value === null ? 0 : quantity.level(value);
  const cell = element('td', {class: 'heat', style: heated(level)}, quantity.text(r));
  explain(cell, `${r.candidate}, ${dashed(r.pair)}, ${c.class}\n${c.description}\n${outcomesText(r)}\n` +
      `worst error ${exponent(quantile(r.severity, 'max'))}, depth error p99 ${exponent(quantile(r.depth_error, 'p99'))}, regret p99 ` +
      `${exponent(quantile(r.normal_regret, 'p99'))}\npatch covered: mean ${cutShare(quantile(r.coverage, 'mean'))}; ${whole(time(r))} ns, p95 ${whole(tail(r))} ns` +
      (r.worst_index === null ? '' : `\nworst: ${r.pair}/${r.class}/${report.seed}/${r.worst_index}`));
  whenPressed(cell, () => showFailures(r.pair, r.candidate));
  return cell;
}
byId('class-quantity').addEventListener('change', classTable);
follow(classTable);

// Contact points: their number and coverage, beside the numbers of the thesis that added cylinders to the pe
// rigid-body engine (its figures 4-6, 16-19 and 21-28).
const thesisCases = [
  ['cylinder-plane', 'standing', 'standing on a plane', '3'],
  ['cylinder-plane', 'lying', 'lying on a plane', '2'],
  ['cylinder-plane', 'general+shallow', 'tilted on a plane', '1'],
  ['cylinder-sphere', 'general+shallow', 'a sphere anywhere', '1'],
  ['cylinder-capsule', 'parallel-side', 'a capsule alongside', '2'],
  ['cylinder-capsule', 'cap-on-side', 'a capsule across the cap', '2'],
  ['cylinder-capsule', 'perpendicular-x', 'a capsule crossed', '1'],
  ['cylinder-cylinder', 'parallel-side', 'side by side', '2'],
  ['cylinder-cylinder', 'cap-on-side', 'a side across the cap', '2'],
  ['cylinder-cylinder', 'cap-on-cap-centred', 'cap on cap, one within the other', '3'],
  ['cylinder-cylinder', 'cap-on-cap-offset', 'cap on cap, overlapping', '4'],
  ['cylinder-cylinder', 'rim-rim', 'rim on rim', '1'],
  ['cylinder-box', 'side-on-face', 'side on a face', '2'],
  ['cylinder-box', 'cap-on-face-centred', 'standing on a face', 'up to 8'],
  ['cylinder-box', 'cap-on-face-offset', 'standing over an edge', 'up to 8'],
  ['cylinder-box', 'rim-face', 'rim on a face', '1'],
];
// "2", or "1–8" where a class gives several.
function pointCounts(r) {
  const counts = Object.keys(r.points).map(Number);
  if (counts.length === 0) return 'none';
  const lo = Math.min(...counts), hi = Math.max(...counts);
  return lo === hi ? String(lo) : `${lo}–${hi}`;
}
function manifold() {
  const {candidate} = chosen, other = own(candidate) ? candidates.find(c => !own(c)) : candidates.includes('reference') ? 'reference' : null;
  const compared = [candidate, ...(other ? [other] : [])];
  const rows = thesisCases.filter(([pair, poseClass]) => ofPair({pair}) && resultAt.has(`${pair}/${poseClass}/${candidate}`)).map(([pair, poseClass, words, points]) => {
    const name = rowHead(words);
    explain(name, `${dashed(pair)}, class ${poseClass}`);
    return [name, points, ...compared.flatMap(c => manifoldCells(resultAt.get(`${pair}/${poseClass}/${c}`)))];
  });
  byId('manifold-table').replaceChildren(rows.length === 0 ? 'None of the thesis’s cases was run.' : table(
      [textColumn('case'), 'thesis', ...compared.flatMap(c => [column(named(c)), 'coverage'])], rows, 'Contact points, and mean coverage of the patch'));
}
function manifoldCells(r) {
  if (!r || supported(r) === 0) return [notAvailable(), notAvailable()];
  const mean = quantile(r.coverage, 'mean'), points = element('td', {}, pointCounts(r));
  explain(points, `${r.candidate}: ${Object.entries(r.points).map(([n, count]) => `${count} × ${n} points`).join(', ') || 'no contacts'}`);
  return [points, element('td', mean === null ? {} : {class: 'heat', style: heated(1 - mean)}, cutShare(mean))];
}
follow(manifold);

// Rigid-body experiments with an answer on paper: the error of every candidate in every experiment,
// and the numbers of one experiment. Errors below what an experiment resolves are equal.
const experimentCell = {
  text: r => r.outcome === 'unsupported' ? '–' : r.exact ? 'held' : r.error === null || r.outcome === 'unsound' ? 'lost' : exponent(r.error),
  key: r => r.outcome === 'unsupported' ? '' : r.exact ? 0 : r.error === null || r.outcome === 'unsound' ? Infinity : r.error,
  // Pale at the experiment's resolution, full at an error of 1.
  style: (r, resolution) => r.exact ? '' : heated(r.error === null ? 1
      : 0.2 + 0.8 * Math.max(0, 1 - Math.log(r.error) / Math.log(resolution))),
};
function experimentTip(r, experiment, k) {
  if (r.outcome === 'unsupported') return `${r.candidate} has no routine for a pair in it`;
  const details = Object.entries(r.details).map(([name, value]) => `\n${name} ${exponent(value)}`).join('');
  return `${r.candidate}, ${experiment.name}\nerror ${exponent(r.error)} ${experiment.unit}, resolved to ${exponent(experiment.resolution[k])}` +
      `\nvalue ${exponent(r.value)}, on paper ${exponent(experiment.expected[k])}${details}` +
      `\n${r.points.toFixed(1)} contact points, changing in ${percent(r.flicker)} of the steps` +
      `\none point in ${percent(r.single)}, none in ${percent(r.without)}` +
      (r.failures ? `\n${r.failures} answers failed` : '');
}
function experimentTables({experiments, results, steps}) {
  const of = (experiment, name) => results.find(r => r.experiment === experiment.name && r.candidate === name && r.step === steps[0]);
  const rows = candidates.map(name => [rowHead(named(name)),
      ...experiments.map(e => {
        const r = of(e, name), cell = element('td', {class: r.exact ? 'heat good' : r.outcome === 'unsupported' ? 'quiet' : 'heat',
            'data-value': experimentCell.key(r), style: experimentCell.style(r, e.resolution[0])}, experimentCell.text(r));
        explain(cell, experimentTip(r, e, 0));
        whenPressed(cell, () => {
          byId('experiment-name').value = e.name;
          byId('experiment').open = true;
          one();
        });
        return cell;
      })]);
  const resolved = element('tr', {class: 'pinned quiet'}, rowHead('resolves'),
      ...experiments.map(e => element('td', {}, exponent(e.resolution[0]))));
  byId('experiment-errors').append(table([textColumn('candidate'), ...experiments.map(e => e.name)], [resolved, ...rows],
      'Error of each experiment in its own unit; held: below what the experiment resolves, where all are equal'));

  function one() {
    const e = experiments.find(x => x.name === byId('experiment-name').value);
    byId('experiment-statement').textContent = `${e.statement} Value: ${e.quantity}; on paper ${exponent(e.expected[0])}. ` +
        `Error in ${e.unit}; errors below ${exponent(e.resolution[0])} are equal: the experiment resolves no more.`;
    const measured = candidates.map(name => of(e, name)).filter(r => r.outcome !== 'unsupported');
    byId('experiment-table').replaceChildren(table([textColumn('candidate'), 'value', 'error', 'points', column('flicker', {class: 'wide'}),
        column('one point', {class: 'wide'}), column('energy gained', {class: 'wide'}), 'ns per query', 'µs per step'],
      measured.map(r => [rowHead(named(r.candidate)), exponent(r.value),
          element('td', {class: r.exact ? 'good' : '', 'data-value': r.error ?? ''}, r.exact ? `held (${exponent(r.error)})` : experimentCell.text(r)),
          r.points.toFixed(1), percent(r.flicker), percent(r.single), exponent(r.energy_gained),
          whole(r.nanoseconds), whole(r.microseconds_per_step)]), 'One experiment'));
    byId('experiment-command').replaceChildren(command(`${program} simulate ${e.name} --step ${steps[0]}`));
  }
  byId('experiment-name').append(...options(experiments.map(e => e.name)));
  byId('experiment-name').addEventListener('change', one);
  one();
}
if (report.experiments) {
  byId('experiments').hidden = false;
  experimentTables(report.experiments);
}

if (report.engines) drawEngines(report.engines);
byId('motion').hidden = !report.casts && !report.experiments && !report.engines;
if (report.stability) drawStability(byId('stability'), report.stability);

// How often each arrangement occurs in the recorded scenes, and how far the bodies are tilted out of it.
function recordedTable(recorded) {
  const byArrangement = new Map();
  for (const r of recorded) {
    const key = `${r.pair} ${r.arrangement}`;
    if (!byArrangement.has(key)) byArrangement.set(key, {...r, share: 0, tilts: []});
    byArrangement.get(key).share += r.share;
    if (r.tilt !== null) byArrangement.get(key).tilts.push(r);
  }
  const tilt = k => k === 15 ? 'exact' : `1e-${k}`;
  const rows = [...byArrangement.values()].sort((x, y) => pairs.indexOf(x.pair) - pairs.indexOf(y.pair) || y.share - x.share)
      .map(({pair, arrangement, share, tilts}) => [rowHead(otherShape(pair)), arrangement, percent(share),
          element('td', {class: 'text wrap'}, ...tilts.sort((x, y) => x.tilt - y.tilt)
              .flatMap((t, i) => [i ? ', ' : '', element('span', {class: 'unbroken'}, `${tilt(t.tilt)}: ${percent(t.share / share)}`)]), tilts.length ? '' : '–')]);
  byId('recorded-table').append(table([textColumn('pair'), textColumn('arrangement'), 'share', textColumn('tilts out of it')], rows,
      'Arrangements in recorded scenes'));
}
if (report.recorded && report.recorded.length) {
  byId('recorded').hidden = false;
  recordedTable(report.recorded);
}

// The outcomes of all configurations, as bars.
function outcomeBars() {
  const seen = outcomes.filter(o => report.summary.some(r => r.outcomes[o]));
  const rows = ranked().map(r => {
    const bar = element('div', {class: 'bar', role: 'img', 'aria-label': outcomesText(r)});
    for (const o of seen) {
      const n = r.outcomes[o] || 0;
      if (n === 0) continue;
      const part = element('div', {style: `width:${100 * n / r.count}%;background:var(${outcomeColour(o)})`});
      explain(part, `${r.candidate}, ${dashed(r.pair)}\n${o}: ${whole(n)} of ${whole(r.count)}`);
      bar.append(part);
    }
    return element('div', {class: 'outcome-row'}, named(r.candidate), bar);
  });
  byId('outcome-bars').replaceChildren(outcomeLegend(seen), ...rows);
}
follow(outcomeBars);
