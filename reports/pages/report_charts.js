// The report's charts of errors: their distributions, what they depend on.
// The distribution of errors: cumulative for several candidates, a histogram for one.
const distributionRow = candidate => summaryOf(summedPair(), candidate);
// Bins of half a decade, [lower, upper, count]; errors of zero are in a bin below all others.
function binsOf(q) {
  const h = q.histogram, bins = h.counts.map((n, i) => [10 ** ((h.first + i) / 2), 10 ** ((h.first + i + 1) / 2), n]);
  return h.zero ? [[zeroAt, 10 ** -17.5, h.zero], ...bins.map(([a, b, n]) => [Math.max(a, 10 ** -17.5), Math.max(b, 1e-17), n])] : bins;
}
// The contacts that should have been reported; a missed one is below no error.
const reportedOf = q => q.histogram.zero + q.histogram.counts.reduce((a, b) => a + b, 0);
const owed = r => reportedOf(r.depth_error) + lost(r);

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
  if (points.length === 0) return clearChart(byId('distribution-cumulative'), 'No contacts.');
  drawLines(byId('distribution-cumulative'), `Cumulative distribution of the error of the ${errorName()}`, {points,
      x: errorAxis(points.map(p => p.x)), y: shareAxis('share of contacts with at most this error')});
}
function histogram(quantity) {
  const name = chosen.candidate, r = distributionRow(name), q = r && r[quantity];
  byId('histogram-candidate').textContent = `${name}, ${over()}`;
  if (!q) return clearChart(byId('distribution-histogram'), 'No contacts.');
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
byId('distribution-quantity').addEventListener('change', distribution);
shownLegend(byId('error-legend'), candidates);
followChart(distribution);

// Error against the variables that it may depend on.
const variables = {
  tilt: 'angle of the cylinder’s axis from parallel or perpendicular to an axis of B (radians)',
  depth: 'true penetration (sizes)',
  aspect: 'largest over smallest half extent of the more extreme body',
  distance: 'distance from the origin (larger sizes)',
};
// Nothing is counted over all pairs here: then the one on which the candidate agrees least.
function trendPair() {
  const [least] = summary().filter(r => r.candidate === chosen.candidate && r.pair !== 'all' && supported(r)).sort((a, b) => agreeing(a) - agreeing(b));
  return chosen.pair !== 'all' ? chosen.pair : least?.pair ?? pairs[0];
}
function trends() {
  const variable = byId('trend-variable').value, pair = trendPair(), quantity = byId('trend-quantity').value;
  const entries = report.trends.filter(t => t.pair === pair && t.group === chosen.group && t.variable === variable && shown.has(t.candidate));
  const share = quantity === 'missed', value = b => share ? b.missed / b.count : Math.max(b[quantity], zeroAt);
  // Zero is one decade below the smallest.
  const decades = entries.flatMap(t => t.bins).map(b => b.decade).filter(d => d !== null);
  const at = b => b.decade === null ? Math.min(...decades, 0) - 1 : b.decade;
  const points = entries.flatMap(t => t.bins.map(b => ({...markData(t.candidate), x: at(b), y: value(b),
      tip: `${t.candidate}, ${b.decade === null ? `${variable} zero` : `${variable} 1e${b.decade} to 1e${b.decade + 1}`}\n` +
           `${whole(b.count)} configurations, missed ${whole(b.missed)}\nerror median ${exponent(b.median)}, worst ${exponent(b.max)}`})));
  const host = byId('trend-chart');
  byId('trend-caption').textContent = `${over(pair)}, ${variable}: ${variables[variable]}`;
  if (points.length === 0) return clearChart(host, `${dashed(pair)} has no ${variable}, or no candidate is chosen.`);
  // Every decade has its place, whether it holds a value or not.
  const places = points.map(p => p.x), first = Math.min(...places);
  const xs = Array.from({length: Math.max(...places) - first + 1}, (_, i) => first + i), hasZero = entries.some(t => t.bins.some(b => b.decade === null));
  const what = share ? 'share of configurations missed' : `error, ${quantity === 'max' ? 'worst' : 'median'} (sizes)`;
  const label = `datum.value == ${hasZero ? xs[0] : 1e9} ? '0' : '1e' + datum.value`;
  drawLines(host, `${what} against ${variable}, ${dashed(pair)}`, {height: 320, points,
      x: {title: `${variable}, from`, type: 'point', domain: xs, label, labelOverlap: true},
      y: share ? shareAxis(what) : powerAxis(what, points.map(p => p.y))}, p => showFailures(pair, p.candidate));
}
for (const id of ['trend-variable', 'trend-quantity']) byId(id).addEventListener('change', trends);
followChart(trends);
