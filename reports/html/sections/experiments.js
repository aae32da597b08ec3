// Rigid-body experiments with an answer on paper: the error of every candidate in every experiment,
// and the numbers of one experiment. Errors below what an experiment resolves are equal.
const experimentCell = {
  text: r => r.outcome === 'unsupported' ? '–' : r.exact ? 'held' : r.error === null || r.outcome === 'unsound' ? 'lost' : exponent(r.error),
  // From what the experiment resolves (pale) to wrong by all (full).
  style: (r, resolution) => r.exact ? '' : heated(r.error === null ? 1
      : Math.min(1, 0.2 + 0.8 * Math.max(0, 1 - Math.log(r.error) / Math.log(resolution)))),
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
function experimentTables(data) {
  const of = (experiment, name) => data.results.find(r => r.experiment === experiment.name && r.candidate === name && r.step === data.steps[0]);
  const rows = candidates.map(name => element('tr', {}, element('th', {scope: 'row'}, named(name)),
      ...data.experiments.map(e => {
        const r = of(e, name), cell = element('td', {class: r.exact ? 'heat good' : r.outcome === 'unsupported' ? 'quiet' : 'heat', tabindex: 0,
            style: experimentCell.style(r, e.resolution[0])}, experimentCell.text(r));
        explain(cell, experimentTip(r, e, 0));
        cell.addEventListener('click', () => { byId('experiment-name').value = e.name; one(); });
        return cell;
      })));
  const resolved = element('tr', {class: 'quiet'}, element('th', {scope: 'row'}, 'resolves'),
      ...data.experiments.map(e => element('td', {}, exponent(e.resolution[0]))));
  byId('experiment-errors').append(table('Error of each experiment in its own unit; held: below what the experiment resolves, where all are equal',
      [column('candidate', {class: 'text'}), ...data.experiments.map(e => column(e.name))], [resolved, ...rows]));

  function one() {
    const e = data.experiments.find(x => x.name === byId('experiment-name').value);
    byId('experiment-statement').textContent = `${e.statement} Value: ${e.quantity}; on paper ${exponent(e.expected[0])}. ` +
        `Error in ${e.unit}; errors below ${exponent(e.resolution[0])} are equal: the experiment resolves no more.`;
    const measured = candidates.map(name => of(e, name)).filter(r => r.outcome !== 'unsupported');
    byId('experiment-table').replaceChildren(table('One experiment', [column('candidate', {class: 'text'}), column('value'), column('error'),
      column('points'), column('flicker'), column('one point', {class: 'wide'}), column('energy gained', {class: 'wide'}), column('ns per query'), column('µs per step')],
      measured.map(r => element('tr', {}, element('th', {scope: 'row'}, named(r.candidate)),
          element('td', {}, exponent(r.value)), element('td', {class: r.exact ? 'good' : ''}, r.exact ? `held (${exponent(r.error)})` : experimentCell.text(r)),
          element('td', {}, r.points.toFixed(1)), element('td', {}, percent(r.flicker)),
          element('td', {class: 'wide'}, percent(r.single)), element('td', {class: 'wide'}, exponent(r.energy_gained)),
          element('td', {}, whole(r.nanoseconds)), element('td', {}, whole(r.microseconds_per_step))))));
    byId('experiment-command').replaceChildren(command(`./touchstone simulate ${e.name} --step ${data.steps[0]}`));
  }
  choices('experiment-name', data.experiments.map(e => e.name), one);
  one();
}
if (report.experiments) {
  byId('experiments').hidden = false;
  experimentTables(report.experiments);
}
