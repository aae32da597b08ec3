// The page of `touchstone compare`: what changed beyond the limits, and speed and accuracy before and now.
const {comparison, before, after} = data, {limits} = comparison;
const rows = [...before, ...after], names = [...new Set(rows.map(r => r.candidate))];
const pairs = [...new Set([...rows, ...comparison.changes].map(r => r.pair))].filter(p => p !== 'all');

const beyond = comparison.changes.filter(c => c.beyond_limits);
const verdicts = ['worse', 'slower', 'better', 'faster'], isRegression = c => c.verdict === 'worse' || c.verdict === 'slower';
// Verdicts of a candidate on a pair or on all, with the number of classes.
const ofCell = (pair, name) => beyond.filter(c => c.candidate === name && (pair === 'all' || c.pair === pair));
// Rows over a group count where no class of it was compared.
const isOfGroup = c => c.class in groupMeanings;
function classesOf(changes) {
  const classes = changes.filter(c => !isOfGroup(c));
  return new Set((classes.length ? classes : changes).map(c => `${c.pair}/${c.class}`)).size;
}
const counted = n => `${n} ${beyond.every(isOfGroup) ? n === 1 ? 'group' : 'groups' : n === 1 ? 'class' : 'classes'}`;
const rowOf = (summary, pair, name) => summary.find(r => r.class === chosen.group && r.pair === pair && r.candidate === name && supported(r));
// "86.0% → 71.0%", or what both are.
const agreements = (old, now) => [...new Set([old, now].filter(Boolean).map(agreement))].join(' → ');

// Who changed most, on which pair: "Worse: bullet on cylinder–box (12 classes; everyday agreement 86.0% → 71.0%)."
function verdict() {
  const told = v => {
    const cells = pairs.flatMap(pair => names.map(name => [pair, name, classesOf(ofCell(pair, name).filter(c => c.verdict === v))])).filter(c => c[2]);
    return cells.length === 0 ? [] : [`${v[0].toUpperCase()}${v.slice(1)}: `, ...cells.sort((a, b) => b[2] - a[2]).slice(0, 3).flatMap(([pair, name, n], i) => {
      const both = [before, after].map(s => rowOf(s, pair, name)), agrees = both.every(Boolean) ? agreements(...both) : '';
      return [i ? ', ' : '', named(name), ` on ${dashed(pair)} (${counted(n)}${agrees.includes('→') ? `; ${chosen.group} agreement ${agrees}` : ''})`];
    }), cells.length > 3 ? ` and ${cells.length - 3} more. ` : '. '];
  };
  byId('headline').replaceChildren(...(beyond.length === 0 ? ['Nothing beyond the limits.'] : verdicts.flatMap(told)));
}
function changeMatrix() {
  matrix(byId('matrix'), manyPairs, names, (pair, name) => {
    const old = rowOf(before, pair, name), now = rowOf(after, pair, name), changes = ofCell(pair, name);
    if (!old && !now && !changes.length) return element('td', {class: 'quiet'}, '–');
    const counts = verdicts.map(v => [v, classesOf(changes.filter(c => c.verdict === v))]).filter(([, n]) => n);
    const isBad = changes.some(isRegression), cell = element('td', {class: !isBad && counts.length ? 'heat right' : 'heat', ...(isBad && {style: heated(0.6)})},
        agreements(old, now) || '–', element('small', {}, !now ? 'only before' : !old ? 'only now' : counts.map(([v, n]) => `${n} ${v}`).join(', ')));
    explain(cell, `${name}, ${pairWords(pair)}\nbefore: ${old ? agreement(old) : '–'}; now: ${now ? agreement(now) : '–'}` +
        counts.map(([v, n]) => `\n${v}: ${counted(n)}`).join('') + '\nClick for its changes');
    whenPressed(cell, () => {
      choose({pair, candidate: name});
      goTo('changes');
    });
    return cell;
  }, `Answers that agree with the truth in ${chosen.group} poses; pose classes beyond the limits in all`);
}
function value(c, which) {
  if (c.measure === 'has a routine') return c[which] ? 'yes' : 'no';
  if (c.measure.startsWith('agreement')) return (100 * c[which]).toFixed(1) + '%';
  return c.measure === 'instructions' ? whole(c[which]) : exponent(c[which]);
}
function changeTable() {
  const shown = beyond.filter(c => (chosen.pair === 'all' || c.pair === chosen.pair) && (chosen.candidate === 'all' || c.candidate === chosen.candidate));
  byId('change-table').replaceChildren(shown.length === 0 ? 'None.' : table(
      [...['', 'pair', 'class', 'candidate', 'measure'].map(textColumn), 'before', 'now', 'factor'],
      verdicts.flatMap(v => shown.filter(c => c.verdict === v)).map(c => [
        element('td', {class: isRegression(c) ? 'text bad' : 'text good'}, c.verdict),
        c.pair, c.class, named(c.candidate), c.measure, value(c, 'before'), value(c, 'after'),
        c.factor === null ? '–' : '× ' + exponent(c.factor, 3)]),
      `${shown.length} changes; a factor is what is now, divided by what was, where an error below 1e-14 counts as that, ` +
      'and of the patch not covered a share below 0.01'));
}

// Speed against accuracy, before and now, on the pair that is chosen.
function placesOf(summary) {
  const rows = summary.filter(r => r.class === chosen.group && r.pair === chosen.pair), base = rows.find(s => s.candidate === limits.baseline);
  return rows.filter(r => r.nanoseconds && r.depth_error && base?.nanoseconds).map(r => ({
    candidate: r.candidate, covers: coveredOf(summary, r), y: Math.max(r.depth_error.p99, 1e-17), front: r.pareto,
    x: limits.baseline === 'bullet' && r.nanoseconds.ratio_to_bullet || r.nanoseconds.median / base.nanoseconds.median}));
}
function changeChart() {
  const was = placesOf(before), is = placesOf(after), all = [...was, ...is], place = byId('speed-chart'), pair = pairWords(chosen.pair);
  byId('chart-pair').textContent = pair;
  if (all.length === 0) return clearChart(place, `No times relative to ${limits.baseline}.`);
  const x = {title: `time, × ${limits.baseline}`, ...decadesOf(all.map(p => p.x)), label: `'× ' + (${numberLabel})`};
  const y = powerAxis('depth error, p99 (sizes)', all.map(p => p.y));
  // A movement is measured in shares of the axes; below one in a hundred the old mark is left out.
  const moved = (a, b) => a && b ? Math.hypot(...[[x, 'x'], [y, 'y']].map(([{domain}, k]) => Math.log(a[k] / b[k]) / Math.log(domain[1] / domain[0]))) : 1;
  const both = names.map(name => [name, ...[was, is].map(list => list.find(p => p.candidate === name))]);
  const points = both.flatMap(([name, old, now], i) => {
    const latest = now || old;
    if (!latest) return [];
    const way = moved(old, now), mark = markData(name), where = p => p ? `depth error p99 ${exponent(p.y)}, × ${exponent(p.x, 3)}` : 'not measured';
    const tip = `${name}, ${pair}\nbefore: ${where(old)}\nnow: ${where(now)}`;
    const label = {label: name + latest.covers, weight: latest.front ? 'bold' : 'normal', order: latest.front ? i : way > 0.05 ? 100 + i : 1000 + i};
    return [...(old && way > 0.01 ? [{...mark, ...old, tip, label: '', order: 2000 + i, ...(!now && label), fill: 'var(--panel)', stroke: colour(name), size: 55}] : []),
            ...(now ? [{...mark, ...now, tip, ...label, size: 55}] : [])];
  });
  const front = list => list.filter(p => p.front).sort((a, b) => a.x - b.x);
  drawScatter(place, `Depth error against time, before and now, ${pair}`, {height: panelHeight(), x, y, points, lines: [
    {rows: front(was), dash: [4, 3], width: 1.2}, {rows: front(is), colour: 'var(--ink)', width: 1.2},
    {rows: both.filter(([, a, b]) => a && b && moved(a, b) > 0.01).flatMap(([, ...marks]) => marks), by: 'candidate', width: 0.8}]});
}

byId('remarks').append(...comparison.remarks.map(r => element('li', {}, r)));
byId('baseline').textContent = limits.baseline;
byId('limits').textContent = `${comparison.compared} rows of pair, class and candidate were compared. ` +
    `An error may grow ${limits.error_factor} times, a time ${limits.time_factor} times (as a multiple of ` +
    `${limits.baseline}'s, by the nearest ends of the spreads), and ${percent(limits.agreement)} of the agreement must be kept. ` +
    `${comparison.changes.length - beyond.length} smaller changes are not listed.`;
offerGroups([...new Set(rows.map(r => r.class))]);
const manyPairs = offerPairs(pairs);
offer('candidate', 'Candidate', [['all', 'all candidates'], ...names.map(n => [n, n])]);
follow(verdict);
follow(changeMatrix);
follow(changeTable);
followChart(changeChart);
listSections();
