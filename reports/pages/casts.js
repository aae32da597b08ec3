// Casts: how often a candidate is right about when A touches first, by pair and group, and its worst cases.
function castMatrix() {
  const {results, worst} = report.casts, here = r => r.group === chosen.group;
  let shown = [];
  byId('cast-words').hidden = !results.some(here);
  const names = candidates.filter(n => results.some(r => here(r) && r.candidate === n));
  const totals = (rows, key) => {
    const sums = {};
    for (const [name, n] of rows.flatMap(r => Object.entries(r[key]))) sums[name] = (sums[name] ?? 0) + n;
    return sums;
  };
  const listed = sums => Object.entries(sums).map(([name, n]) => `${name} ${n}`).join(', ');
  matrix(byId('cast-matrix'), manyPairs, names, (pair, name) => {
    const of = list => list.filter(r => here(r) && r.candidate === name && (pair === 'all' || r.pair === pair));
    const rows = of(results), count = rows.reduce((sum, r) => sum + r.count, 0);
    if (count === 0) return notAvailable();
    const outcomes = totals(rows, 'outcomes'), right = (outcomes.agree ?? 0) / count;
    const {agree, ...wrong} = outcomes, most = Object.entries(wrong).sort((a, b) => b[1] - a[1])[0];
    const cell = element('td', {class: right === 1 ? 'heat right' : 'heat', ...(right === 1 ? {} : {style: heated(failed(1 - right))})},
        percent(right), element('small', {}, most ? `${most[1]} ${most[0]}` : ''));
    if (name === chosen.candidate && pair === chosen.pair) shown = of(worst);
    const largest = Math.max(...rows.map(r => r.distance_max ?? 0)), worse = of(worst);
    explain(cell, [`${name}, ${pairWords(pair)}: ${listed(outcomes)} of ${count}`, most ? `wrong by motion: ${listed(totals(rows, 'wrong_by_motion'))}` : '',
                   `largest distance left at a touch, or passed into: ${exponent(largest)} sizes`, worse.length ? 'Click for its worst cases' : ''].filter(Boolean).join('\n'));
    if (worse.length) whenPressed(cell, () => showWorstCasts(worse));
    return cell;
  }, `Casts that are right in touch and normal to ${exponent(report.tolerance, 1)} of the size, in ${chosen.group} poses`);
  if (shown.length) showWorstCasts(shown); else byId('cast-worst').replaceChildren();
}
// The worst of them with a picture in which A moves, and how to see the others.
function showWorstCasts(cases) {
  const badness = w => w.outcome === 'failed' ? Infinity : Math.max(Math.abs(w.distance ?? 0), w.normal_regret ?? 0);
  const [worst, ...others] = [...cases].sort((a, b) => badness(b) - badness(a));
  const words = w => `${w.candidate}: ${w.outcome}${w.distance === null ? '' : `, ${exponent(w.distance)} sizes`}`;
  byId('cast-worst').replaceChildren(element('div', {class: 'case'}, caseView(worst), element('div', {}, words(worst), command(worst.replay),
      ...others.map(w => element('div', {}, words(w), command(w.replay))))));
}
if (report.casts && report.casts.results.length) {
  byId('casts').hidden = false;
  follow(castMatrix);
}
