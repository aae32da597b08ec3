// Agreement, errors and speed of one pair at a time; and the errors of simplified models.
function summaryTable() {
  const pair = byId('summary-pair').value;
  const heads = [column('candidate', {class: 'text'}), column('agrees'), column('missed'), column('error, p99'),
                 column('error, max'), column('regret, max', {class: 'wide'}), column('coverage', {class: 'wide'}), column('ns'),
                 column('× Bullet', {class: 'wide'})];
  const rows = report.summary.filter(r => r.pair === pair && supported(r)).map(r => {
    const share = agreeing(r), ratio = r.nanoseconds && r.nanoseconds.ratio_to_bullet;
    return element('tr', {}, element('th', {scope: 'row'}, named(r.candidate)),
        element('td', {class: share === 1 ? 'good' : ''}, percent(share)),
        element('td', {class: r.outcomes.missed ? 'bad' : ''}, whole(r.outcomes.missed || 0)),
        element('td', {}, exponent(quantile(r.depth_error, 'p99'))),
        element('td', {}, exponent(quantile(r.depth_error, 'max'))),
        element('td', {class: 'wide'}, exponent(quantile(r.normal_regret, 'max'))),
        element('td', {class: 'wide'}, cutShare(quantile(r.coverage, 'mean'))),
        element('td', {}, whole(time(r))),
        element('td', {class: 'wide'}, ratio ? (r.tied_with.includes('bullet') ? '~' : '') + ratio.toFixed(2) : '–'));
  });
  byId('summary-table').replaceChildren(table('Agreement, depth error of the reported contacts, nanoseconds per query', heads, rows));
}

// What is wrong with a simplified model, and with its solver.
const modelled = report.summary.filter(r => r.model_error !== null && report.candidates.some(c => c.name === r.candidate && c.models));
function modelTable() {
  const rows = modelled.filter(r => r.pair === byId('model-pair').value).map(r => {
    const name = element('th', {scope: 'row', tabindex: 0}, named(r.candidate));
    explain(name, report.candidates.find(c => c.name === r.candidate).models);
    return element('tr', {}, name, ...[r.model_error, r.solver_error].flatMap(q => ['median', 'p99'].map(which =>
        element('td', {}, exponent(quantile(q, which))))));
  });
  byId('model-table').replaceChildren(table('Errors of model and solver', [column('candidate', {class: 'text'}),
      column('model, median'), column('p99'), column('solver, median'), column('p99')], rows));
}
const summaryPairs = [...new Set(report.summary.map(r => r.pair))].reverse();
choices('summary-pair', summaryPairs, summaryTable);
summaryTable();
if (modelled.length) {
  byId('models').hidden = false;
  choices('model-pair', summaryPairs.filter(p => modelled.some(r => r.pair === p)), modelTable);
  modelTable();
}
