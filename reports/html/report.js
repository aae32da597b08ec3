const report = JSON.parse(document.getElementById('data').textContent);
const candidates = report.candidates.map(c => c.name);
const pairs = [...new Set(report.results.map(r => r.pair))];
const colour = name => `var(--c${candidates.indexOf(name) % 8})`;
function swatch(name) {
  return element('span', {class: 'swatch', style: `background:${colour(name)}`, 'aria-hidden': 'true'});
}

// null: not measured.
const whole = x => x === null ? '–' : Math.round(x).toLocaleString('en');
const quantile = (q, which) => q === null ? null : q[which];
const time = r => r.nanoseconds === null ? null : r.nanoseconds.median;
// Of what a candidate has a routine for.
const supported = r => r.count - (r.outcomes.unsupported || 0);
const agreeing = r => (r.outcomes.agree || 0) / supported(r);
// Cut downwards: only a candidate without a failure shows 100%.
const percent = share => share === 1 ? '100%' : (Math.floor(share * 1000 + 1e-6) / 10).toFixed(1) + '%';

function headline() {
  if (report.partial) {
    byId('partial').hidden = false;
    byId('partial').textContent = `Partial: interrupted when ${report.completed.classes} of ` +
        `${report.planned.classes} pose classes were scored and ${report.completed.timed_classes} timed.`;
  }
  const all = report.summary.filter(r => r.pair === 'all');
  const rows = (all.length ? all : report.summary).filter(supported);
  const best = [...rows].sort((a, b) => agreeing(b) - agreeing(a)).slice(0, 5);
  const parts = best.map(r => `${r.candidate} ${all.length ? '' : `(${r.pair}) `}on ${percent(agreeing(r))}`);
  byId('headline').textContent =
      `${whole(report.configurations)} configurations, each with a truth certified to 1e-30 of the larger ` +
      `size. Agreement with the truth within ${report.tolerance} of the smaller size: ${parts.join(', ')}` +
      (rows.length > best.length ? `; ${rows.length - best.length} more below.` : '.');
  byId('provenance').append(`Touchstone ${report.version}, seed ${report.seed}. Same configurations again: `,
      element('code', {}, report.command));
}

function summaryTable() {
  const columns = ['agrees', 'missed', 'depth error, p99', 'depth error, max', 'regret, max',
                   'coverage', 'ns per query', '× Bullet'];
  const head = element('tr', {}, element('th', {class: 'text', scope: 'col'}, 'pair'),
      element('th', {class: 'text', scope: 'col'}, 'candidate'),
      ...columns.map(c => element('th', {scope: 'col'}, c)));
  const body = element('tbody');
  let last = null;
  for (const r of report.summary) {
    if (supported(r) === 0) continue;
    const share = agreeing(r), ratio = r.nanoseconds && r.nanoseconds.ratio_to_bullet;
    body.append(element('tr', r.pair !== last ? {class: 'first'} : {},
        element('th', {scope: 'row'}, r.pair !== last ? r.pair : ''),
        element('td', {class: 'text'}, swatch(r.candidate), r.candidate),
        element('td', {class: share === 1 ? 'good' : ''}, percent(share)),
        element('td', {class: r.outcomes.missed ? 'bad' : ''}, whole(r.outcomes.missed || 0)),
        element('td', {}, exponent(quantile(r.depth_error, 'p99'))),
        element('td', {}, exponent(quantile(r.depth_error, 'max'))),
        element('td', {}, exponent(quantile(r.normal_regret, 'max'))),
        element('td', {}, cutShare(quantile(r.coverage, 'mean'))),
        element('td', {}, whole(time(r))),
        element('td', {}, ratio ? ratio.toFixed(2) : '–')));
    last = r.pair;
  }
  byId('summary-table').append(element('table', {},
      element('caption', {}, 'Agreement, errors and speed'), element('thead', {}, head), body));
}

// What is wrong with a simplified model, and with its solver.
function modelTable() {
  const models = new Map(report.candidates.filter(c => c.models).map(c => [c.name, c.models]));
  const rows = report.summary.filter(r => r.model_error !== null && models.has(r.candidate));
  if (rows.length === 0) return;
  byId('models').hidden = false;
  const columns = ['missed', 'model error, median', 'p99', 'solver error, median', 'p99'];
  const body = element('tbody');
  let last = null;
  for (const r of rows) {
    const name = element('td', {class: 'text', tabindex: 0}, swatch(r.candidate), r.candidate);
    explain(name, models.get(r.candidate));
    body.append(element('tr', r.pair !== last ? {class: 'first'} : {},
        element('th', {scope: 'row'}, r.pair !== last ? r.pair : ''), name,
        element('td', {}, whole(r.outcomes.missed || 0)),
        ...[r.model_error, r.solver_error].flatMap(q => ['median', 'p99'].map(which =>
            element('td', {}, exponent(quantile(q, which)))))));
    last = r.pair;
  }
  byId('model-table').append(element('table', {},
      element('caption', {}, 'Errors of model and solver'), element('thead', {}, element('tr', {},
          element('th', {class: 'text', scope: 'col'}, 'pair'), element('th', {class: 'text', scope: 'col'}, 'candidate'),
          ...columns.map(c => element('th', {scope: 'col'}, c)))), body));
}

// Speed and accuracy: small multiples on common axes.
const floor = 1e-17;
const symbolOf = name => symbols[Math.floor(candidates.indexOf(name) / 8) % symbols.length];
function chart() {
  const rows = report.summary.filter(r => time(r) !== null && r.depth_error !== null);
  if (rows.length === 0) return byId('chart-panels').append('No candidate was timed.');
  const clipped = r => Math.max(r.depth_error.p99, floor);
  const decades = values => [Math.floor(Math.log10(Math.min(...values))), Math.ceil(Math.log10(Math.max(...values)))];
  const widen = ([lo, hi]) => [lo, Math.max(hi, lo + 1)];
  const [x0, x1] = widen(decades(rows.map(time)));
  const [y0, y1] = widen(decades(rows.map(clipped)));
  const shown = candidates.filter(name => rows.some(r => r.candidate === name));
  byId('chart-panels').before(element('div', {class: 'legend'}, ...shown.map(name => {
    const svg = shape('svg', {viewBox: '-8 -8 16 16', style: 'display:inline;width:14px;height:14px;margin-right:.3em;vertical-align:middle', 'aria-hidden': 'true'});
    svg.append(shape('path', {fill: colour(name), d: symbolPath(symbolOf(name), 0, 0, 5.5)}));
    return element('span', {}, svg, name);
  })));
  const panels = [...new Set(report.summary.map(r => r.pair))];
  for (const pair of panels) {
    const here = rows.filter(r => r.pair === pair);
    if (here.length) byId('chart-panels').append(panel(pair, here, {x0, x1, y0, y1, clipped}));
  }
}
function panel(pair, rows, {x0, x1, y0, y1, clipped}) {
  const width = 360, height = 270, left = 46, right = 26, top = 14, bottom = 40;
  const x = v => left + (Math.log10(v) - x0) / (x1 - x0) * (width - left - right);
  const y = v => height - bottom - (Math.log10(v) - y0) / (y1 - y0) * (height - top - bottom);
  const svg = shape('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img',
      'aria-label': `Depth error against time per query, ${pair}; the numbers are in the summary table`});
  for (let d = x0; d <= x1; ++d) {
    const at = x(10 ** d);
    svg.append(shape('line', {class: 'grid', x1: at, x2: at, y1: top, y2: height - bottom}));
    const label = d < 3 ? `${10 ** d} ns` : d < 6 ? `${10 ** (d - 3)} µs` : `${10 ** (d - 6)} ms`;
    svg.append(shape('text', {class: 'tick', x: at, y: height - bottom + 15, 'text-anchor': 'middle'}, label));
  }
  const every = Math.max(1, Math.ceil((y1 - y0) / 8));
  for (let d = y0; d <= y1; d += every) {
    const at = y(10 ** d);
    svg.append(shape('line', {class: 'grid', x1: left, x2: width - right, y1: at, y2: at}));
    svg.append(shape('text', {class: 'tick', x: left - 6, y: at + 4, 'text-anchor': 'end'}, `1e${d}`));
  }
  svg.append(shape('text', {class: 'tick', x: (left + width - right) / 2, y: height - 6, 'text-anchor': 'middle'},
      'time per query'));
  // The front, which treats overlapping spreads of time as a tie (reports/pareto.hpp).
  const sorted = [...rows].sort((a, b) => time(a) - time(b));
  const front = sorted.filter(r => r.pareto);
  const line = rows => rows.map(r => `${x(time(r))},${y(clipped(r))}`).join(' ');
  // The members of a family, in the order of their parameter.
  for (const family of new Set(report.candidates.map(c => c.family))) {
    const members = report.candidates.filter(c => c.family === family)
        .map(c => rows.find(r => r.candidate === c.name)).filter(Boolean);
    if (members.length > 1) svg.append(shape('polyline', {class: 'sweep', points: line(members)}));
  }
  svg.append(shape('polyline', {class: 'front', points: line(front)}));
  // Named are those on the front; labels that would lie on each other are moved down.
  let lowest = -Infinity;
  const labels = [];
  for (const r of [...rows].sort((a, b) => clipped(b) - clipped(a))) {
    const at = y(clipped(r));
    let labelAt = null;
    if (front.includes(r)) lowest = labelAt = Math.max(at + 4, lowest + 13);
    const [symbol, label] = mark(pair, r, x(time(r)), at, labelAt, width);
    svg.append(symbol);
    if (label) labels.push(label);
  }
  svg.append(...labels);
  return element('figure', {}, element('figcaption', {}, pair === 'all' ? 'all pairs' : pair), svg);
}
function mark(pair, r, x, y, labelY, width) {
  const text = `${r.candidate}, ${pair}\nagrees on ${percent(agreeing(r))}, missed ${r.outcomes.missed || 0}\n` +
      `depth error p99 ${exponent(r.depth_error.p99)}, worst ${exponent(r.depth_error.max)}\n` +
      `${whole(time(r))} ns per query (quartiles ${whole(r.nanoseconds.low)} to ${whole(r.nanoseconds.high)})` +
      (r.tied_with.length ? `\nno faster or slower, within the spreads, than ${r.tied_with.join(', ')}` : '');
  const symbol = shape('path', {class: 'mark', tabindex: 0, fill: colour(r.candidate), 'aria-label': text,
      d: symbolPath(symbolOf(r.candidate), x, y, 5.5)});
  explain(symbol, text);
  symbol.addEventListener('click', () => showWorst(pair, r.candidate));
  if (labelY === null) return [symbol];
  const leftwards = x > width * 0.62;
  const label = shape('text', {class: 'label', x: leftwards ? x - 10 : x + 10, y: labelY, 'text-anchor': leftwards ? 'end' : 'start'},
      `${r.candidate} ${percent(agreeing(r))}`);
  return [symbol, label];
}
function explain(target, text) {
  const tip = byId('tooltip');
  const show = () => {
    const box = target.getBoundingClientRect();
    tip.textContent = text;
    tip.hidden = false;
    const x = Math.min(box.right + 8, innerWidth - tip.offsetWidth - 8);
    const y = Math.min(box.bottom + 8, innerHeight - tip.offsetHeight - 8);
    tip.style.left = `${Math.max(8, x)}px`;
    tip.style.top = `${Math.max(8, y)}px`;
  };
  const hide = () => { tip.hidden = true; };
  target.addEventListener('mouseenter', show);
  target.addEventListener('focus', show);
  target.addEventListener('mouseleave', hide);
  target.addEventListener('blur', hide);
}

// Pose classes: a table whose cells are coloured by one quantity.
const quantities = {
  fail: {value: r => 1 - agreeing(r), text: r => agreeing(r) === 1 ? '0' : (100 * (1 - agreeing(r))).toFixed(1) + '%',
         level: v => v === 0 ? 0 : 0.12 + 0.88 * v},
  depth: {value: r => quantile(r.depth_error, 'p99'), text: r => exponent(quantile(r.depth_error, 'p99')),
          level: v => decade(v)},
  regret: {value: r => quantile(r.normal_regret, 'p99'), text: r => exponent(quantile(r.normal_regret, 'p99')),
           level: v => decade(v)},
  coverage: {value: r => quantile(r.coverage, 'mean'), text: r => cutShare(quantile(r.coverage, 'mean')),
             level: v => 1 - v},
  time: {value: time, text: r => whole(time(r)), level: v => Math.min(1, Math.max(0, (Math.log10(v) - 1) / 4))},
};
// 1e-10 and less is white, 1 and more is full.
function decade(v) { return v <= 0 ? 0 : Math.min(1, Math.max(0, (Math.log10(v) + 10) / 10)); }
function classTable() {
  const pair = byId('class-pair').value, quantity = quantities[byId('class-quantity').value];
  const body = element('tbody');
  for (const c of report.classes.filter(c => c.pair === pair)) {
    const name = element('th', {scope: 'row', tabindex: 0}, c.class);
    explain(name, c.description);
    const row = element('tr', {}, name);
    for (const candidate of candidates) {
      const r = report.results.find(s => s.pair === pair && s.class === c.class && s.candidate === candidate);
      row.append(classCell(c, r, quantity));
    }
    body.append(row);
  }
  byId('class-table').replaceChildren(element('table', {},
      element('caption', {}, `${pair}: ${byId('class-quantity').selectedOptions[0].text}`),
      element('thead', {}, element('tr', {}, element('th', {class: 'text', scope: 'col'}, 'pose class'),
          ...candidates.map(c => element('th', {scope: 'col'}, swatch(c), c)))), body));
}
function classCell(c, r, quantity) {
  if (!r || supported(r) === 0) return element('td', {class: 'heat'}, '–');
  const value = quantity.value(r);
  const level = value === null ? 0 : quantity.level(value);
  const cell = element('td', {class: 'heat', tabindex: 0,
      style: `background: color-mix(in srgb, var(--bad) ${Math.round(70 * level)}%, transparent)`}, quantity.text(r));
  const outcomes = Object.entries(r.outcomes).map(([name, n]) => `${name} ${n}`).join(', ');
  explain(cell, `${r.candidate}, ${c.class}\n${c.description}\n${outcomes}\n` +
      `depth error median ${exponent(quantile(r.depth_error, 'median'))}, worst ${exponent(quantile(r.depth_error, 'max'))}\n` +
      `normal angle p99 ${r.normal_angle === null ? '–' : r.normal_angle.p99.toPrecision(2) + '°'}, ${whole(time(r))} ns\n` +
      `patch covered: mean ${cutShare(quantile(r.coverage, 'mean'))}, least ${cutShare(quantile(r.coverage, 'min'))}`);
  return cell;
}

const outcomeColours = {agree: 'var(--good)', missed: 'var(--c1)', phantom: 'var(--c3)', shallow: 'var(--c4)',
  overdeep: 'var(--c6)', 'wrong-normal': 'var(--c0)', 'not-finite': 'var(--ink)', failed: 'var(--c7)', crashed: 'var(--c2)', 'timed-out': 'var(--c5)',
  unsupported: 'var(--line)'};
function outcomeBars() {
  const seen = Object.keys(outcomeColours).filter(o => report.summary.some(r => r.outcomes[o]));
  const legend = element('div', {class: 'legend'}, ...seen.map(o => element('span', {},
      element('span', {class: 'swatch', style: `background:${outcomeColours[o]}`, 'aria-hidden': 'true'}), o)));
  const rows = report.summary.filter(supported).map(r => {
    const bar = element('div', {class: 'bar', role: 'img',
        'aria-label': seen.map(o => `${o} ${r.outcomes[o] || 0}`).join(', ')});
    for (const o of seen) {
      const n = r.outcomes[o] || 0;
      if (n === 0) continue;
      const part = element('div', {style: `width:${100 * n / r.count}%;background:${outcomeColours[o]}`});
      explain(part, `${r.candidate}, ${r.pair}\n${o}: ${whole(n)} of ${whole(r.count)}`);
      bar.append(part);
    }
    return element('div', {class: 'outcome-row'}, element('span', {}, `${r.pair}, ${r.candidate}`), bar);
  });
  byId('outcome-bars').append(legend, ...rows);
}

// Worst cases.
function worstCases() {
  const pair = byId('worst-pair').value, candidate = byId('worst-candidate').value;
  const shown = report.worst.filter(w => (pair === 'all' || w.pair === pair) &&
      (candidate === 'all' || w.candidate === candidate));
  shown.sort((a, b) => (a.outcome === 'agree') - (b.outcome === 'agree') || b.severity - a.severity);
  byId('worst-cases').replaceChildren(...(shown.length ? shown.map(worstCase) : ['None.']));
}
function worstCase(w) {
  const copy = element('button', {type: 'button'}, 'Copy');
  copy.addEventListener('click', () => navigator.clipboard.writeText(w.replay).then(
      () => { copy.textContent = 'Copied'; }, () => { copy.textContent = 'Select and copy'; }));
  const reasons = Object.entries(w.answers).filter(([, a]) => a.reason);
  const rows = Object.entries(w.answers).map(([name, a]) => element('tr', {},
      element('td', {class: 'text'}, swatch(name), name), element('td', {class: 'text'}, a.score.outcome),
      element('td', {}, a.signed_distance === null ? a.status : String(a.signed_distance)),
      element('td', {class: 'text'}, vector(a.normal)), element('td', {}, String(a.points.length)),
      element('td', {}, cutShare(a.score.coverage)),
      element('td', {}, exponent(a.score.depth_error)), element('td', {}, exponent(a.score.normal_regret))));
  const heads = ['candidate', 'outcome', 'signed distance', 'normal', 'points', 'coverage', 'depth error', 'normal regret'];
  return element('article', {},
      element('h3', {}, `${w.candidate}: ${w.outcome} `, element('code', {}, w.id)),
      element('div', {class: 'command'}, element('code', {}, w.replay), copy),
      element('p', {class: 'quiet'}, `Truth: signed distance within [${w.truth.signed_distance.join(', ')}], ` +
          `${w.truth.ties === 'unique' ? 'one optimal normal' : `optimal normals: ${w.truth.ties}`}, ` +
          w.truth.normals.slice(0, 3).map((n, i) => `${vector(n)} (contact patch: ${w.truth.patch[i].kind})`).join(', ') +
          (w.truth.normals.length > 3 ? ', …' : '')),
      element('div', {class: 'scroll'}, element('table', {}, element('thead', {}, element('tr', {},
          ...heads.map((h, i) => element('th', {scope: 'col', class: [0, 1, 3].includes(i) ? 'text' : ''}, h)))),
          element('tbody', {}, ...rows))),
      ...reasons.map(([name, a]) => element('p', {class: 'quiet'}, `${name}: ${a.reason}`)),
      element('details', {}, element('summary', {}, 'Configuration'),
          element('pre', {}, JSON.stringify(w.configuration))));
}
function vector(v) {
  return v === null ? '–' : `(${v.map(c => c === null ? 'nan' : c.toPrecision(6)).join(', ')})`;
}
function showWorst(pair, candidate) {
  byId('worst-pair').value = pair;
  byId('worst-candidate').value = candidate;
  worstCases();
  byId('worst').scrollIntoView();
}

function method() {
  definitions('settings', report.candidates.map(c =>
      [`${c.name} ${c.version}`, c.settings + (c.models ? `; models ${c.models}` : '')]));
  const bar = report.tolerance;
  definitions('words', [
    ['size', 'Half of the smallest width of the smaller shape; errors are relative to it.'],
    ['normal', 'Unit vector from B to A (the cylinder): the way A moves to come free.'],
    ['normal regret', 'How much deeper the bodies are along the reported normal than along the best one. It is well defined where several normals tie.'],
    ['coverage', 'The largest factor by which the contact patch (where the bodies\u2019 flat and straight parts meet) may be shrunk about its centroid to lie within the hull of the contact points: 0.5 for three points evenly on a disc\u2019s rim, 0.7 for four. Of a point contact 1. Means are over contacts with a normal within the bar.'],
    ['agree', `Depth and normal regret within ${bar} of the size; contacts shallower than that may be missed.`],
    ['missed', `No contact, though the bodies overlap by more than ${bar} of the size.`],
    ['phantom', `A contact, though they are more than ${bar} of the size further apart than was asked for.`],
    ['shallow, overdeep', 'The depth is too small, too large.'],
    ['wrong-normal', 'The depth is right; the normal is of no unit length or its regret is beyond the bar.'],
    ['not-finite, failed, unsupported', 'A NaN or infinity in the answer; the candidate says that it could not answer; it has no routine for the pair, which does not count against it.'],
    ['crashed, timed-out', 'The candidate ended its process (a signal, an exception, too much memory), or took longer than 50 ms of processor time, unless asked otherwise. Each candidate has a process of its own.'],
    ['model error, solver error', 'Of a simplified model: the true signed distance of what it models against that of the cylinder, and its answer against that of what it models.'],
    ['time', 'Narrow phase alone, one thread, shapes prepared beforehand, candidates in random turns on the same configurations, each in its own process, which reads the clock itself: median and quartiles of repeated measurements, in each of which the classes’ median counts. Candidates whose quartiles overlap tie.'],
  ]);
  const m = report.machine, o = report.oracle_microseconds;
  definitions('machine', [
    ['machine', `${m.cpu}, ${m.cores} cores, ${m.os}`],
    ['compiler', m.compiler],
    ['oracle', o === null ? '–' : `median ${whole(o.median)} µs, 99th percentile ${whole(o.p99)} µs per configuration`],
    ['run', `${whole(report.wall_seconds)} s`],
  ]);
}

function choices(id, values, change) {
  byId(id).append(...values.map(v => element('option', {value: v}, v)));
  byId(id).addEventListener('change', change);
}
headline();
summaryTable();
modelTable();
chart();
choices('class-pair', pairs, classTable);
byId('class-quantity').addEventListener('change', classTable);
if (pairs.length) { byId('class-pair').value = pairs[pairs.length - 1]; classTable(); }
outcomeBars();
choices('worst-pair', ['all', ...pairs], worstCases);
choices('worst-candidate', ['all', ...candidates], worstCases);
worstCases();
method();
