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
