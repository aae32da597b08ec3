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
