// Speed and accuracy: small multiples on common axes.
const floor = 1e-17;
const shownError = r => Math.max(r.depth_error.p99, floor);
const chartable = r => time(r) !== null && r.depth_error !== null;

// Overlapping spreads of time are a tie (reports/pareto.hpp).
const paretoFront = rows => rows.filter(r => r.pareto).sort((a, b) => time(a) - time(b));

function speedAccuracy() {
  const rows = report.summary.filter(chartable), host = byId('chart-panels');
  if (rows.length === 0) return host.append('No candidate was timed.');
  byId('chart-legend').append(...candidates.filter(name => rows.some(r => r.candidate === name)).map(name => named(name)));
  const scales = {x: decadesOf(rows.map(time)), y: powerTicks(rows.map(shownError))};
  for (const pair of [...new Set(rows.map(r => r.pair))].reverse()) {
    const place = element('div', {class: 'chart'});
    host.append(element('figure', {}, element('figcaption', {}, pair === 'all' ? 'all pairs' : dashed(pair)), place));
    keepDrawn(() => drawChart(place, speedSpec(rows.filter(r => r.pair === pair), scales), r => showWorst(pair, r.candidate)));
  }
}
function speedSpec(rows, {x, y}) {
  const front = paretoFront(rows);
  const datum = (r, i) => ({...markData(r.candidate), x: time(r), y: shownError(r), order: front.includes(r) ? i : 1000 + i,
      label: `${r.candidate} ${percent(agreeing(r))}`, weight: front.includes(r) ? 'bold' : 'normal',
      tip: `${r.candidate}, ${dashed(r.pair)}\nagrees on ${percent(agreeing(r))}, missed ${r.outcomes.missed || 0}\n` +
           `depth error p99 ${exponent(r.depth_error.p99)}, worst ${exponent(r.depth_error.max)}\n` +
           `${whole(time(r))} ns per query (quartiles ${whole(r.nanoseconds.low)} to ${whole(r.nanoseconds.high)})` +
           (r.tied_with.length ? `\nno faster or slower, within the spreads, than ${r.tied_with.join(', ')}` : '') +
           `\nClick for its worst cases`});
  // The members of a family, in the order of their parameter.
  const members = report.candidates.map(c => ({family: c.family, row: rows.find(r => r.candidate === c.name)})).filter(m => m.row);
  const line = {x: {scale: 'x', field: 'x'}, y: {scale: 'y', field: 'y'}};
  return {
    height: 300,
    data: [{name: 'rows', values: rows.map(datum)}, {name: 'front', values: front.map(datum)},
           {name: 'members', values: members.map(m => ({family: m.family, x: time(m.row), y: shownError(m.row)}))}],
    scales: [{name: 'x', type: 'log', domain: x.domain, range: 'width'}, {name: 'y', type: 'log', domain: y.domain, range: 'height'}],
    axes: [{orient: 'bottom', scale: 'x', values: x.ticks, title: 'time per query', encode: {labels: {update: {text: {signal: timeLabel}}}}},
           {orient: 'left', scale: 'y', values: y.ticks, title: 'depth error, p99 (sizes)', encode: {labels: {update: {text: {signal: powerLabel}}}}}],
    marks: [
      {type: 'group', from: {facet: {name: 'family', data: 'members', groupby: 'family'}}, marks: [
        {type: 'line', from: {data: 'family'}, encode: {update: {...line, stroke: {value: 'var(--quiet)'}, strokeWidth: {value: 0.8}}}}]},
      {type: 'line', from: {data: 'front'}, encode: {
        update: {...line, stroke: {value: 'var(--quiet)'}, strokeDash: {value: [4, 3]}}}},
      {type: 'symbol', name: 'marks', from: {data: 'rows'}, encode: {
        enter: {tooltip: {field: 'tip'}, cursor: {value: 'pointer'}, shape: {field: 'symbol'}, fill: {field: 'colour'}},
        update: {...line, size: {value: 30}}, hover: {size: {value: 110}}}},
      // Only labels that find room are shown; those of the front choose first. The style sheet makes them
      // smaller than what room is sought for.
      {type: 'text', from: {data: 'marks'}, encode: {
        enter: {text: {field: 'datum.label'}, fontWeight: {field: 'datum.weight'}, fontSize: {value: 13}, fill: {value: 'var(--ink)'}}},
        transform: [{type: 'label', size: {signal: '[width, height]'}, offset: [7], padding: 0, avoidMarks: ['marks'],
                     anchor: ['right', 'left', 'top-right', 'bottom-right', 'top-left', 'bottom-left', 'top', 'bottom'],
                     sort: {field: 'datum.datum.order'}}]},
    ],
  };
}
speedAccuracy();
// How the errors are distributed: cumulative of several candidates, and one candidate's histogram.
function distributionRow(candidate) {
  const pair = byId('distribution-pair').value, poseClass = byId('distribution-class').value;
  return (poseClass === 'all' ? report.summary : report.results)
      .find(r => r.pair === pair && r.class === poseClass && r.candidate === candidate);
}
// Half decades [lower, upper, count], with zeros below all others.
const zeroAt = 1e-18;
function binsOf(q) {
  const h = q.histogram, bins = h.counts.map((n, i) => [10 ** ((h.first + i) / 2), 10 ** ((h.first + i + 1) / 2), n]);
  return h.zero ? [[zeroAt, 10 ** -17.5, h.zero], ...bins.map(([a, b, n]) => [Math.max(a, 10 ** -17.5), Math.max(b, 1e-17), n])] : bins;
}
// Contacts that should have been reported count too: they never come below any error.
const reportedOf = q => q.histogram.zero + q.histogram.counts.reduce((a, b) => a + b, 0);
const owed = r => reportedOf(r.depth_error) + (r.outcomes.missed || 0) + lost(r);

function distribution() {
  const quantity = byId('distribution-quantity').value, points = [];
  for (const name of candidates.filter(c => shown.has(c))) {
    const r = distributionRow(name), q = r && r[quantity];
    if (!q) continue;
    let sum = 0;
    for (const [, upper, n] of binsOf(q)) {
      sum += n;
      points.push({...markData(name), x: upper, y: sum / owed(r),
          tip: `${name}\n${percent(sum / owed(r))} of contacts within ${exponent(upper)}\n${whole(owed(r) - reportedOf(r.depth_error))} of ${whole(owed(r))} not reported`});
    }
  }
  cumulative(points);
  histogram(quantity);
}
const shareAxis = {orient: 'left', scale: 'y', format: '%', tickCount: 5};
const errorAxis = ticks => ({orient: 'bottom', scale: 'x', values: ticks, title: 'error (sizes)', encode: {labels: {update: {text: {signal: powerLabel}}}}});
function cumulative(points) {
  if (points.length === 0) return byId('distribution-cumulative').replaceChildren('No contacts.');
  const x = decadesOf(points.map(p => p.x), 3);
  drawChart(byId('distribution-cumulative'), {height: 280, data: [{name: 'points', values: points}],
      scales: [{name: 'x', type: 'log', domain: x.domain, range: 'width'}, {name: 'y', domain: [0, 1], range: 'height'}],
      axes: [errorAxis(x.ticks), {...shareAxis, title: 'share of contacts with at most this error'}], marks: candidateLines});
}
function histogram(quantity) {
  const name = byId('distribution-candidate').value, r = distributionRow(name), q = r && r[quantity];
  if (!q) return byId('distribution-histogram').replaceChildren('No contacts.');
  const bars = binsOf(q).filter(([, , n]) => n).map(([a, b, n]) => ({a, b, y: n / owed(r),
      tip: `${name}\n${whole(n)} of ${whole(owed(r))} contacts\nerror ${a < 1e-17 ? 'zero' : `${exponent(a)} to ${exponent(b)}`}`}));
  const x = decadesOf(bars.flatMap(b => [b.a, b.b]), 3);
  drawChart(byId('distribution-histogram'), {height: 280, data: [{name: 'bars', values: bars}],
      scales: [{name: 'x', type: 'log', domain: x.domain, range: 'width'},
               {name: 'y', domain: {data: 'bars', field: 'y'}, zero: true, nice: true, range: 'height'}],
      axes: [errorAxis(x.ticks), {...shareAxis, title: 'share of contacts'}],
      marks: [{type: 'rect', from: {data: 'bars'}, encode: {
        enter: {tooltip: {field: 'tip'}, fill: {value: colour(name)}, stroke: {value: 'var(--panel)'}},
        update: {x: {scale: 'x', field: 'a'}, x2: {scale: 'x', field: 'b'}, y: {scale: 'y', field: 'y'}, y2: {scale: 'y', value: 0}, fillOpacity: {value: 0.85}},
        hover: {fillOpacity: {value: 1}}}}]});
}
function distributionClasses() {
  const pair = byId('distribution-pair').value;
  byId('distribution-class').replaceChildren(...['all', ...report.classes.filter(c => c.pair === pair).map(c => c.class)]
      .map(v => element('option', {value: v}, v)));
}
choices('distribution-pair', summaryPairs, () => { distributionClasses(); distribution(); });
distributionClasses();
for (const id of ['distribution-class', 'distribution-quantity']) byId(id).addEventListener('change', distribution);
choices('distribution-candidate', candidates, distribution, candidates.find(c => c !== 'reference'));
shownLegend(byId('distribution-legend'));
keepDrawn(distribution);
// Error against what it may depend on.
const variables = {
  tilt: 'angle of the cylinder’s axis from parallel or perpendicular to an axis of B (radians)',
  depth: 'true penetration (sizes)',
  aspect: 'largest over smallest half extent of the more extreme body',
  distance: 'distance from the origin (larger sizes)',
};
function trends() {
  const variable = byId('trend-variable').value, pair = byId('trend-pair').value, quantity = byId('trend-quantity').value;
  const entries = report.trends.filter(t => t.pair === pair && t.variable === variable && shown.has(t.candidate));
  const share = quantity === 'missed', value = b => share ? b.missed / b.count : Math.max(b[quantity], zeroAt);
  // Zero is one decade below the smallest.
  const decades = entries.flatMap(t => t.bins).map(b => b.decade).filter(d => d !== null);
  const at = b => b.decade === null ? Math.min(...decades, 0) - 1 : b.decade;
  const points = entries.flatMap(t => t.bins.map(b => ({...markData(t.candidate), x: at(b), y: value(b),
      tip: `${t.candidate}, ${b.decade === null ? `${variable} zero` : `${variable} 1e${b.decade} to 1e${b.decade + 1}`}\n` +
           `${whole(b.count)} configurations, missed ${whole(b.missed)}\nerror median ${exponent(b.median)}, worst ${exponent(b.max)}`})));
  const host = byId('trend-chart');
  byId('trend-caption').textContent = `${variable}: ${variables[variable]}`;
  if (points.length === 0) return host.replaceChildren(`${dashed(pair)} has no ${variable}, or no candidate is chosen.`);
  const xs = [...new Set(points.map(p => p.x))].sort((a, b) => a - b), hasZero = entries.some(t => t.bins.some(b => b.decade === null));
  const y = powerTicks(points.map(p => Math.max(p.y, zeroAt)));
  const labels = `datum.value == ${hasZero ? xs[0] : 1e9} ? '0' : '1e' + datum.value`;
  drawChart(host, {height: 320, data: [{name: 'points', values: points}],
      scales: [{name: 'x', type: 'point', domain: xs, range: 'width', padding: 0.5},
               share ? {name: 'y', domain: [0, 1], range: 'height'} : {name: 'y', type: 'log', domain: y.domain, range: 'height'}],
      axes: [{orient: 'bottom', scale: 'x', title: `${variable}, from`, labelOverlap: true, encode: {labels: {update: {text: {signal: labels}}}}},
             share ? {...shareAxis, title: 'share of configurations missed'}
                   : {orient: 'left', scale: 'y', values: y.ticks, title: `error, ${quantity === 'max' ? 'worst' : 'median'} (sizes)`,
                      encode: {labels: {update: {text: {signal: powerLabel}}}}}],
      marks: candidateLines}, p => showWorst(pair, p.candidate));
}
choices('trend-pair', [...pairs].reverse(), trends);
for (const id of ['trend-variable', 'trend-quantity']) byId(id).addEventListener('change', trends);
shownLegend(byId('trend-legend'));
keepDrawn(trends);
