// The report's charts: speed and accuracy, distributions of errors, what errors depend on.
const minChartedError = 1e-17;
const chartedError = r => Math.max(r.depth_error.p99, minChartedError);
// The median or, as chosen, what 95% of the queries keep.
const chartedTime = () => byId('chart-time').value === 'p95' ? tail : time;
const chartable = r => chartedTime()(r) !== null && r.depth_error !== null;
const timeLabel = "datum.value < 1e3 ? datum.value + ' ns' : datum.value < 1e6 ? datum.value / 1e3 + ' µs' : datum.value / 1e6 + ' ms'";

// Speed and accuracy: a chart of each pair, on the same axes.
const panels = [];
function speedAccuracy() {
  const rows = summary().filter(chartable), host = byId('chart-panels');
  for (const draw of panels.splice(0)) redrawn.splice(redrawn.indexOf(draw), 1);
  host.replaceChildren();
  byId('chart-legend').replaceChildren();
  if (rows.length === 0) return host.append('No candidate was timed.');
  byId('chart-legend').append(...candidates.filter(name => rows.some(r => r.candidate === name)).map(name => named(name)));
  const x = {title: `time per query${chartedTime() === tail ? ', p95' : ''}`, ...decadesOf(rows.map(chartedTime())), label: timeLabel};
  const y = powerAxis('depth error, p99 (sizes)', rows.map(chartedError));
  const places = [...new Set(rows.map(r => r.pair))].reverse().map(pair => [pair, element('div', {class: 'chart'})]);
  // All places exist before the first chart is drawn, so that each has its final width.
  host.append(...places.map(([pair, place]) => pairPanel(pair, place)));
  for (const [pair, place] of places) {
    const draw = () => speedChart(place, pair, rows.filter(r => r.pair === pair), x, y);
    panels.push(draw);
    keepDrawn(draw);
  }
}
function speedChart(place, pair, rows, x, y) {
  // Candidates whose spreads of time overlap tie (reports/statistics.hpp).
  // The front is that of the medians.
  const charted = chartedTime(), front = charted === time ? rows.filter(r => r.pareto).sort((a, b) => time(a) - time(b)) : [];
  const at = r => ({x: charted(r), y: chartedError(r)});
  const points = rows.map((r, i) => ({...markData(r.candidate), ...at(r), order: front.includes(r) ? i : 1000 + i,
      label: `${r.candidate}${runsText(r.candidate)}${coveredText(r)} ${agreement(r)}`, weight: front.includes(r) ? 'bold' : 'normal',
      tip: `${r.candidate}, ${dashed(r.pair)}${coveredText(r)}\nagrees on ${agreement(r)}, missed ${r.outcomes.missed || 0}\n` +
           `depth error p99 ${exponent(r.depth_error.p99)}, worst ${exponent(r.depth_error.max)}\n` +
           `${whole(time(r))} ns per query (quartiles ${whole(r.nanoseconds.low)} to ${whole(r.nanoseconds.high)})` +
           (tail(r) === null ? '' : `\n95% of the queries in each pose class at most ${whole(tail(r))} ns`) +
           floorText(r) +
           (r.tied_with.length ? `\nno faster or slower, within the spreads, than ${r.tied_with.join(', ')}` : '') +
           `\nClick for its worst cases`}));
  // The members of a family, in the order of their parameter.
  const members = report.candidates.map(c => ({family: c.family, row: rows.find(r => r.candidate === c.name)})).filter(m => m.row);
  drawScatter(place, `Depth error against time per query, ${dashed(pair)}`, {height: panelHeight(pair), x, y, points, lines: [
    {rows: members.map(m => ({family: m.family, ...at(m.row)})), by: 'family', width: 0.8},
    ...(front.length ? [{rows: front.map(at), dash: [4, 3]}] : [])]}, r => showWorst(pair, r.candidate));
}
byId('chart-time').addEventListener('change', speedAccuracy);
keepGrouped(speedAccuracy);

// The distribution of errors: cumulative for several candidates, a histogram for one.
const distributionRow = candidate => summaryOf(byId('distribution-pair').value, candidate);
// Bins of half a decade, [lower, upper, count]; errors of zero are in a bin below all others.
function binsOf(q) {
  const h = q.histogram, bins = h.counts.map((n, i) => [10 ** ((h.first + i) / 2), 10 ** ((h.first + i + 1) / 2), n]);
  return h.zero ? [[zeroAt, 10 ** -17.5, h.zero], ...bins.map(([a, b, n]) => [Math.max(a, 10 ** -17.5), Math.max(b, 1e-17), n])] : bins;
}
// The contacts that should have been reported; a missed one is below no error.
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
          tip: `${name}${coveredText(r)}\n${percent(sum / owed(r))} of contacts within ${exponent(upper)}\n${whole(owed(r) - reportedOf(r.depth_error))} of ${whole(owed(r))} not reported`});
    }
  }
  cumulative(points);
  histogram(quantity);
}
const errorAxis = values => ({title: 'error (sizes)', ...decadesOf(values, 3), label: powerLabel});
const errorName = () => byId('distribution-quantity').selectedOptions[0].text;
function cumulative(points) {
  if (points.length === 0) return byId('distribution-cumulative').replaceChildren('No contacts.');
  drawLines(byId('distribution-cumulative'), `Cumulative distribution of the error of the ${errorName()}`, {points,
      x: errorAxis(points.map(p => p.x)), y: shareAxis('share of contacts with at most this error')});
}
function histogram(quantity) {
  const name = byId('distribution-candidate').value, r = distributionRow(name), q = r && r[quantity];
  if (!q) return byId('distribution-histogram').replaceChildren('No contacts.');
  const bars = binsOf(q).filter(([, , n]) => n).map(([a, b, n]) => ({a, b, y: n / owed(r),
      tip: `${name}\n${whole(n)} of ${whole(owed(r))} contacts\nerror ${a < 1e-17 ? 'zero' : `${exponent(a)} to ${exponent(b)}`}`}));
  const y = {...shareAxis('share of contacts'), domain: [0, Math.max(...bars.map(b => b.y))], nice: true};
  drawChart(byId('distribution-histogram'), `Histogram of the error of the ${errorName()} of ${name}`, {height: 280, data: [{name: 'bars', values: bars}],
      ...axes(errorAxis(bars.flatMap(b => [b.a, b.b])), y),
      marks: [{type: 'rect', from: {data: 'bars'}, encode: {
        enter: {tooltip: {field: 'tip'}, fill: {value: colour(name)}, stroke: {value: 'var(--panel)'}},
        update: {x: {scale: 'x', field: 'a'}, x2: {scale: 'x', field: 'b'}, y: {scale: 'y', field: 'y'}, y2: {scale: 'y', value: 0}, fillOpacity: {value: 0.85}},
        hover: {fillOpacity: {value: 1}}}}]});
}
choices('distribution-pair', summaryPairs, distribution);
byId('distribution-quantity').addEventListener('change', distribution);
choices('distribution-candidate', candidates, distribution, candidates.find(c => c !== 'reference'));
shownLegend(byId('distribution-legend'), candidates);
keepDrawn(distribution);
grouped.push(distribution);

// Error against the variables that it may depend on.
const variables = {
  tilt: 'angle of the cylinder’s axis from parallel or perpendicular to an axis of B (radians)',
  depth: 'true penetration (sizes)',
  aspect: 'largest over smallest half extent of the more extreme body',
  distance: 'distance from the origin (larger sizes)',
};
function trends() {
  const variable = byId('trend-variable').value, pair = byId('trend-pair').value, quantity = byId('trend-quantity').value;
  const entries = report.trends.filter(t => t.pair === pair && t.group === group && t.variable === variable && shown.has(t.candidate));
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
  // Every decade has its place, whether it holds a value or not.
  const places = points.map(p => p.x), first = Math.min(...places);
  const xs = Array.from({length: Math.max(...places) - first + 1}, (_, i) => first + i), hasZero = entries.some(t => t.bins.some(b => b.decade === null));
  const what = share ? 'share of configurations missed' : `error, ${quantity === 'max' ? 'worst' : 'median'} (sizes)`;
  const label = `datum.value == ${hasZero ? xs[0] : 1e9} ? '0' : '1e' + datum.value`;
  drawLines(host, `${what} against ${variable}, ${dashed(pair)}`, {height: 320, points,
      x: {title: `${variable}, from`, type: 'point', domain: xs, label, labelOverlap: true},
      y: share ? shareAxis(what) : powerAxis(what, points.map(p => p.y))}, p => showWorst(pair, p.candidate));
}
choices('trend-pair', [...pairs].reverse(), trends);
for (const id of ['trend-variable', 'trend-quantity']) byId(id).addEventListener('change', trends);
shownLegend(byId('trend-legend'), candidates);
keepDrawn(trends);
grouped.push(trends);
