// The section "Inside the engines": every experiment in each engine's own world, with the engine's contacts and with ours.
const cureWords = {
  held: 'held: within what the experiment resolves, and the body rests where it should',
  nearer: 'at least ten times nearer to the answer on paper',
  solver: 'held with the engine’s solver at its best: its defaults limit, not the contacts',
  alike: 'as near as the engine’s own contacts, also with the solver at its best',
  open: 'neither held nor ten times nearer',
};
const wasMeasured = r => r.outcome === 'measured';
const errorOf = r => wasMeasured(r) && r.error !== null ? exponent(r.error) : r.outcome === 'measured' ? 'lost' : r.outcome;
const stillMoves = r => r.last_motion >= r.last_time - 0.5;
// What is held rests in the mean, though single steps may move it.
const restOf = (r, experiment) => !experiment.rests ? '–' : !stillMoves(r) ? `${r.last_motion.toFixed(2)} s` :
    r.exact ? 'jitters, at rest in the mean' : 'never';

// A cell with both errors; green where ours is held.
function cureCell(r, experiment) {
  if (!r) return element('td', {}, '');
  const cell = element('td', {class: r.cure === 'held' ? 'heat good' : 'heat', tabindex: 0,
      style: r.cure === 'open' ? heated(1) : ''}, `${r.own.exact ? 'held' : errorOf(r.own)} → ${r.cured.exact ? 'held' : errorOf(r.cured)}${r.cure === 'solver' ? ' *' : ''}`);
  explain(cell, `${experiment.name} in ${r.engine}\nits own contacts: error ${errorOf(r.own)}\nours: ${errorOf(r.cured)}` +
      (r.best ? `\nours, solver at its best${r.best.step < r.cured.step ? ', half the step' : ''}: ${errorOf(r.best)}` : '') +
      `\nresolved to ${exponent(experiment.resolution[0])} ${experiment.unit}\n${cureWords[r.cure]}`);
  return cell;
}
function engineRows(r, experiment) {
  const runs = [[r.engine, r.own], [`${r.engine} with ours`, r.cured]];
  if (r.best) runs.push([`… solver at its best${r.best.step < r.cured.step ? ', half the step' : ''}`, r.best]);
  return runs.map(([name, run]) => {
    if (!('error' in run)) return [rowHead(name), element('td', {colspan: 8, class: 'text bad'}, run.reason)];
    return [rowHead(name), exponent(run.value), element('td', {class: run.exact ? 'good' : ''}, errorOf(run)), restOf(run, experiment),
        exponent(run.energy_gained), run.points.toFixed(1), percent(run.flicker), percent(run.single),
        exponent(run.microseconds_per_step)];
  });
}
// Fills the section; `data`: the member `engines` of report.json.
function drawEngines({engines, experiments, results, step}) {
  const section = byId('engines'), of = (e, engine) => results.find(r => r.experiment === e.name && r.engine === engine.name);
  const count = cure => results.filter(r => r.cure === cure).length;
  section.hidden = false;
  section.append(element('p', {},
      `Each engine steps its own world, in steps of ${exponent(step)} s: its broad phase, its solver, its defaults; first with its own ` +
      'contacts, then with our routines installed by one call. A cell has the error before and after; held (green): within what the ' +
      'experiment resolves, and the body rests where it should. *: held once the engine’s solver is at its best, so that its defaults are what limits. ' +
      `Of ${results.length}, ${count('held')} are held, ${count('nearer')} at least ten times nearer, ${count('solver')} limited by the ` +
      `solver’s defaults, ${count('alike')} alike with both contacts, ${count('open')} open.`));
  const select = element('select', {id: 'engine-experiment'}), statement = element('p', {class: 'quiet'}), one = element('div', {class: 'scroll'});
  const where = element('div', {}), inFull = fold('One experiment in each engine, in full',
      element('p', {class: 'controls'}, element('label', {}, 'The experiment ', select)), statement, one, where);
  const show = () => {
    const e = experiments.find(x => x.name === select.value);
    statement.textContent = `${e.statement} Value: ${e.quantity}; on paper ${exponent(e.expected[0])}. ` +
        `Error in ${e.unit}; resolved to ${exponent(e.resolution[0])}.`;
    one.replaceChildren(table([textColumn('engine'), 'value', 'error', e.rests ? 'rests after' : 'rests', 'energy gained', 'points', 'flicker',
        'one point', 'µs per step'], engines.flatMap(engine => of(e, engine) ? engineRows(of(e, engine), e) : []), 'One experiment in each engine'));
    where.replaceChildren(command(`${program} simulate ${e.name} --engine ${engines.map(x => x.name).join()} --step ${step}`));
  };
  const rows = experiments.map(e => [rowHead(e.name), exponent(e.resolution[0]), ...engines.map(engine => {
    const cell = cureCell(of(e, engine), e);
    whenPressed(cell, () => { select.value = e.name; inFull.open = true; show(); });
    return cell;
  })]);
  select.append(...options(experiments.map(e => e.name)));
  select.addEventListener('change', show);
  const settings = element('dl', {}, ...engines.flatMap(e => [element('dt', {}, `${e.name} ${e.version}`),
      element('dd', {}, `${e.settings}. Solver at its best: ${e.best_settings}.`)]));
  section.append(element('div', {class: 'scroll'}, table([textColumn('experiment'), 'resolves', ...engines.map(e => e.name)], rows,
          'Error before and after')), inFull, fold('How each engine was run', settings));
  show();
}

// The page of `touchstone simulate --engine`: two runs in motion, then the section.
function drawEnginesPage() {
  byId('headline').textContent = 'Every run is the engine’s own world; the two differ by one line, which installs exact contacts of cylinders.';
  byId('provenance').textContent = data.command;
  drawEngines(data.engines);
  const select = element('select', {id: 'scene'}), {motions} = data;
  byId('motion').hidden = motions.length === 0;
  if (motions.length) {
    select.append(...options(motions.map((m, i) => [i, `${m.experiment} in ${m.engine}`])));
    byId('motion').querySelector('.controls').prepend(element('label', {}, 'Experiment ', select));
    describeMotions('The experiment with the engine’s own contacts', 'The experiment with our contacts in the engine');
    const captions = () => {
      const {engine} = motions[select.value];
      byId('left-caption').textContent = `${engine}, its own contacts`;
      byId('right-caption').textContent = `${engine} with our contacts`;
    };
    captions();
    const draw = playMotions(() => ({motion: motions[select.value], pair: motions[select.value].runs}));
    select.addEventListener('change', () => { captions(); draw(); });
  }
  listSections();
}
