// Pose classes: a table whose cells are coloured by one quantity, of all candidates on one pair or of
// one candidate on all pairs.
const quantities = {
  fail: {value: r => 1 - agreeing(r), text: r => agreeing(r) === 1 ? '0' : (100 * (1 - agreeing(r))).toFixed(1) + '%',
         level: v => v === 0 ? 0 : 0.12 + 0.88 * v},
  worst: {value: r => quantile(r.severity, 'max'), text: r => exponent(quantile(r.severity, 'max')), level: decade},
  depth: {value: r => quantile(r.depth_error, 'p99'), text: r => exponent(quantile(r.depth_error, 'p99')), level: decade},
  regret: {value: r => quantile(r.normal_regret, 'p99'), text: r => exponent(quantile(r.normal_regret, 'p99')), level: decade},
  coverage: {value: r => quantile(r.coverage, 'mean'), text: r => cutShare(quantile(r.coverage, 'mean')), level: v => 1 - v},
  time: {value: time, text: r => whole(time(r)), level: v => Math.min(1, Math.max(0, (Math.log10(v) - 1) / 4))},
};
const resultAt = new Map(report.results.map(r => [`${r.pair}/${r.class}/${r.candidate}`, r]));

function classTable() {
  const candidate = byId('class-candidate').value, pair = byId('class-pair').value;
  const quantity = quantities[byId('class-quantity').value], what = byId('class-quantity').selectedOptions[0].text;
  const ofOne = candidate !== 'all';
  byId('class-pair').parentElement.hidden = ofOne;
  const classes = [...new Map(report.classes.filter(c => ofOne || c.pair === pair).map(c => [c.class, c])).values()];
  const columns = ofOne ? pairs.map(p => [p, candidate]) : candidates.map(c => [pair, c]);
  const rows = classes.map(c => {
    const name = element('th', {scope: 'row', tabindex: 0}, c.class);
    explain(name, c.description);
    return element('tr', {}, name, ...columns.map(([p, k]) => classCell(c, resultAt.get(`${p}/${c.class}/${k}`), quantity)));
  });
  byId('class-table').replaceChildren(table(`${ofOne ? candidate : dashed(pair)}: ${what}`,
      [column('pose class', {class: 'text'}), ...columns.map(([p, k]) => ofOne ? column(otherShape(p)) : column(named(k), {class: 'slanted'}))], rows));
}
function classCell(c, r, quantity) {
  if (!r || supported(r) === 0) return element('td', {class: 'quiet'}, '–');
  const value = quantity.value(r), level = value === null ? 0 : quantity.level(value);
  const cell = element('td', {class: 'heat', tabindex: 0, style: heated(level)}, quantity.text(r));
  explain(cell, `${r.candidate}, ${dashed(r.pair)}, ${c.class}\n${c.description}\n${outcomesText(r)}\n` +
      `depth error median ${exponent(quantile(r.depth_error, 'median'))}, worst ${exponent(quantile(r.depth_error, 'max'))}\n` +
      `normal angle p99 ${r.normal_angle === null ? '–' : r.normal_angle.p99.toPrecision(2) + '°'}, ${whole(time(r))} ns\n` +
      `patch covered: mean ${cutShare(quantile(r.coverage, 'mean'))}, least ${cutShare(quantile(r.coverage, 'min'))}`);
  whenPressed(cell, () => showWorst(r.pair, r.candidate));
  return cell;
}
choices('class-pair', pairs, classTable, pairs[pairs.length - 1]);
choices('class-candidate', ['all', ...candidates], classTable, candidates.find(c => c !== 'reference') || candidates[0]);
byId('class-quantity').addEventListener('change', classTable);
classTable();
