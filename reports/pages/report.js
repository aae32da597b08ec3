// The report's data, what all sections ask of it, and the first screen: which engine is right, how fast, and where it fails.
const report = data;
const candidates = report.candidates.map(c => c.name);
showUsual(candidates);
const pairs = [...new Set(report.classes.map(c => c.pair))];
const classGroup = new Map(report.classes.map(c => [`${c.pair}/${c.class}`, c.group]));
const groupOf = r => classGroup.get(`${r.pair}/${r.class}`), inGroup = r => groupOf(r) === chosen.group;
const ofPair = r => chosen.pair === 'all' || r.pair === chosen.pair;
const summary = () => report.summary.filter(r => r.class === chosen.group);
// The pair whose rows are shown: a group of one pair has no row over all.
function summedPair() {
  const here = [...new Set(summary().map(r => r.pair))];
  return chosen.pair === 'all' && here.length === 1 ? here[0] : chosen.pair;
}
// What a figure is over; where that is all pairs, it says so in its title.
const over = (pair = summedPair()) => `${pair === 'all' ? 'all pairs together' : dashed(pair)}, ${chosen.group} poses`;
const summaryOf = (pair, candidate) => summary().find(r => r.pair === pair && r.candidate === candidate);
const coveredText = r => coveredOf(report.summary, r);

// null stands for what was not measured.
const quantile = (q, which) => q === null ? null : q[which];
const time = r => r.nanoseconds === null ? null : r.nanoseconds.median;
const tail = r => r.nanoseconds === null ? null : r.nanoseconds.p95;
const withoutAnswer = ['not-finite', 'failed', 'crashed', 'timed-out'];
const lost = r => withoutAnswer.reduce((sum, o) => sum + (r.outcomes[o] || 0), r.outcomes.missed || 0);
const vector = v => v === null ? '–' : `(${v.map(c => c === null ? 'nan' : plainNumber(c, 6)).join(', ')})`;
const outcomesText = r => Object.entries(r.outcomes).map(([name, n]) => `${name} ${n}`).join(', ') +
    (unasked(r) ? `\n${whole(r.outcomes['timed-out'])} time-outs; ${whole(supported(r) - unasked(r))} of ${whole(supported(r))} asked` : '');
// In how many pose classes of each group a candidate disagrees, of how many it has a routine for, on a pair and on all.
const isFailing = r => supported(r) > 0 && agreeing(r) < 1;
const classCounts = new Map();
for (const r of report.results.filter(supported)) {
  for (const pair of [r.pair, 'all']) {
    const key = `${pair}/${r.candidate}/${groupOf(r)}`, {fail, of} = classCounts.get(key) ?? {fail: 0, of: 0};
    classCounts.set(key, {fail: fail + isFailing(r), of: of + 1});
  }
}
const countsOf = ({pair, candidate}, group) => classCounts.get(`${pair}/${candidate}/${group}`) ?? {fail: 0, of: 0};
const otherGroups = () => Object.keys(groupMeanings).filter(g => g !== chosen.group);
// What is right in the poses that are chosen may fail in others.
function elsewhere(r) {
  const counts = otherGroups().map(g => countsOf(r, g)), sum = key => counts.reduce((n, c) => n + c[key], 0), n = sum('fail');
  return n ? `elsewhere: ${n} of ${sum('of')} ${n === 1 ? 'classes fails' : 'classes fail'}` : '';
}
const isGiven = name => report.candidates.some(c => c.name === name && c.given);  // its answers came in a file
const replayOf = (id, candidate) => `${programOf(candidate)} replay ${id}` + (isGiven(candidate) ? '' : ` --candidates ${candidate}`);
// A press on `target` shows the command that replays `id` in an element.
const replaysWhenPressed = (target, id, candidate, place) =>
    whenPressed(target, () => byId(place).replaceChildren(command(replayOf(id, candidate))));
// What a command's own measurement of its time is worth.
const floorText = ({nanoseconds: t}) => t && t.floor !== null ? `\nof bodies far apart ${whole(t.floor)} ns: what its binding costs; ` +
    `by our clock ${t.our_clock.toFixed(2)} times, processor time ${t.processor.toFixed(2)} times what it says` : '';

// The levels of heated cells: a share that fails; an error, pale at 1e-10 and below, full at 1 and above.
const failed = share => share === 0 ? 0 : 0.15 + 0.85 * Math.sqrt(share);
const decade = v => v <= 0 ? 0 : (Math.log10(v) + 10) / 10;
const notAvailable = () => element('td', {class: 'quiet'}, '–');

// Candidates by agreement, then by worst error; of those that are right but for rounding the faster one.
function ranked() {
  const rounding = 1e-12;
  const worst = r => r.severity === null ? Infinity : Math.max(r.severity.max, rounding);
  const slow = r => time(r) === null ? Infinity : time(r);
  return summary().filter(r => r.pair === summedPair() && supported(r))
      .sort((a, b) => agreeing(b) - agreeing(a) || worst(a) - worst(b) || slow(a) - slow(b));
}

// The answer in a sentence: who is right, how fast; the fastest; the yardstick.
function verdict() {
  const all = ranked(), ofAllPairs = all.filter(r => !coveredText(r)), rows = ofAllPairs.length ? ofAllPairs : all, others = rows.filter(r => !own(r.candidate)), list = others.length ? others : rows;
  const perfect = list.filter(r => agreeing(r) === 1).sort((a, b) => time(a) - time(b)), best = perfect.length ? perfect.slice(0, 3) : list.slice(0, 1);
  const fastest = list.filter(r => time(r) !== null).sort((a, b) => time(a) - time(b))[0];
  const told = (r, share = `, ${agreement(r)}`) => [named(r.candidate, own(r.candidate)), share + (time(r) === null ? '' : ` in ${duration(time(r))}`) +
      (elsewhere(r) && ` (${elsewhere(r)})`)];
  const where = `${chosen.group} poses` + (chosen.pair === 'all' ? '' : ` against a ${otherShape(chosen.pair)}`);
  byId('headline').replaceChildren(...(best.length === 0 ? [`No candidate has a routine for ${chosen.pair === 'all' ? 'any of the pairs' : dashed(chosen.pair)}.`]
      : [perfect.length ? `Right in all ${where}: ` : `Most often right in ${where}: `,
         ...best.flatMap((r, i) => [i ? '; ' : '', ...told(r, perfect.length ? '' : undefined)]),
         perfect.length > 3 ? `; and ${perfect.length - 3} more. ` : '. ',
         ...(fastest && !best.includes(fastest) ? [others.length < rows.length ? 'Fastest but for the yardstick: ' : 'Fastest: ', ...told(fastest), '. '] : []),
         ...(others.length ? rows.filter(r => own(r.candidate)) : []).flatMap(r => ['Yardstick: ', ...told(r), '.'])]));
}

// Candidates against pairs.
function answerMatrix() {
  const order = [...new Set([...ranked().map(r => r.candidate), ...candidates])], isWorst = byId('matrix-quantity').value === 'worst';
  matrix(byId('matrix'), manyPairs, order, (pair, name) => {
    const r = summaryOf(pair, name);
    if (!r || supported(r) === 0) return notAvailable();
    const worst = quantile(r.severity, 'max'), share = agreeing(r), right = share === 1 && !isWorst;
    const cell = element('td', {class: right ? 'heat right' : 'heat', ...(right ? {} : {style: heated(isWorst ? 1 + Math.log10(worst) / 16 : failed(1 - share))})},
        isWorst ? exponent(worst) : agreement(r),
        element('small', {}, isWorst ? lost(r) ? `${whole(lost(r))} lost` : '' : duration(time(r))));
    const {fail, of} = countsOf(r, chosen.group);
    explain(cell, [`${name}, ${pairWords(pair)}${coveredText(r)}`, outcomesText(r), `disagrees in ${fail} of ${of} ${chosen.group} pose classes`,
                   elsewhere(r), `worst error ${exponent(worst)}, 99th percentile ${exponent(quantile(r.severity, 'p99'))}`, 'Click for its worst classes and cases'].filter(Boolean).join('\n'));
    whenPressed(cell, () => showFailures(pair, name));
    return cell;
  }, element('span', {}, `${isWorst ? 'Worst error, in sizes, and contacts lost' : `Answers that agree with the truth in depth, normal and points to ${exponent(report.tolerance, 1)} of the size, and median time of a query,`} in ${chosen.group} poses`,
      element('span', {class: 'wide'}, `: ${groupMeanings[chosen.group]}`)));
}
// Goes to the worst classes and cases of a candidate on a pair.
function showFailures(pair, candidate) {
  choose({pair, candidate});
  goTo('failures');
}

// Speed against accuracy, on the pair that is chosen.
const minChartedError = 1e-17;
const timeLabel = "datum.value < 1e3 ? datum.value + ' ns' : datum.value < 1e6 ? datum.value / 1e3 + ' µs' : datum.value / 1e6 + ' ms'";
function speedChart() {
  const charted = byId('chart-time').value === 'p95' ? tail : time, place = byId('speed-chart');
  const rows = summary().filter(r => r.pair === summedPair() && charted(r) !== null && r.depth_error !== null);
  if (rows.length === 0) return clearChart(place, 'No candidate was timed.');
  // The front is that of the medians; candidates whose spreads of time overlap tie (reports/statistics.hpp).
  const front = charted === time ? rows.filter(r => r.pareto).sort((a, b) => time(a) - time(b)) : [];
  byId('front-words').hidden = front.length < 2;
  const at = r => ({x: charted(r), y: Math.max(r.depth_error.p99, minChartedError)});
  const points = rows.map((r, i) => ({...markData(r.candidate), ...at(r), order: front.includes(r) ? i : 1000 + i,
      label: `${r.candidate}${runsText(r.candidate)}${coveredText(r)}`, weight: front.includes(r) ? 'bold' : 'normal',
      tip: `${r.candidate}, ${pairWords(r.pair)}${coveredText(r)}\nagrees on ${agreement(r)}, missed ${r.outcomes.missed || 0}\n` + (elsewhere(r) && `${elsewhere(r)}\n`) +
           `depth error p99 ${exponent(r.depth_error.p99)}, worst ${exponent(r.depth_error.max)}\n` +
           `${whole(time(r))} ns per query (quartiles ${whole(r.nanoseconds.low)} to ${whole(r.nanoseconds.high)})` +
           (tail(r) === null ? '' : `\n95% of the queries in each pose class at most ${whole(tail(r))} ns`) +
           floorText(r) +
           (r.tied_with.length ? `\nno faster or slower, within the spreads, than ${r.tied_with.join(', ')}` : '') +
           `\nClick for its worst classes and cases`}));
  // The members of a family, in the order of their parameter.
  const members = report.candidates.map(c => ({family: c.family, row: rows.find(r => r.candidate === c.name)})).filter(m => m.row);
  drawScatter(place, `Depth error against time per query, ${over()}`, {height: panelHeight(), points,
      x: {title: `time per query${charted === tail ? ', p95' : ''}`, ...decadesOf(rows.map(charted)), label: timeLabel},
      y: powerAxis('depth error, p99 (sizes)', points.map(p => p.y)), lines: [
        {rows: members.map(m => ({family: m.family, ...at(m.row)})), by: 'family', width: 0.8},
        ...(front.length ? [{rows: front.map(at), dash: [4, 3]}] : [])]}, p => showFailures(chosen.pair, p.candidate));
}

if (report.partial) {
  byId('partial').hidden = false;
  byId('partial').textContent = `Partial: interrupted when ${report.completed.classes} of ` +
      `${report.planned.classes} pose classes were scored and ${report.completed.timed_classes} timed.`;
}
const routines = candidates.filter(name => report.summary.some(r => r.candidate === name && supported(r)));
const alwaysRight = routines.filter(name => !report.results.some(r => r.candidate === name && isFailing(r))).length;
byId('extent').textContent = `${whole(report.configurations)} configurations, each answer held against a truth certified to 1e-30 of the larger size; of ` +
    `${routines.length} ${routines.length === 1 ? 'candidate' : 'candidates'} ${alwaysRight} ${alwaysRight === 1 ? 'agrees' : 'agree'} in every pose class of all groups. ` +
    `Touchstone ${report.version}, seed ${report.seed}, ${report.machine.cpu}.`;
byId('findings').hidden = report.findings.length === 0;
byId('findings').querySelector('ul').append(...report.findings.map(f => element('li', {}, sign(f.candidate), f.text, command(f.command))));
offerGroups([...new Set(report.summary.map(r => r.class))]);
const manyPairs = offerPairs(pairs);
offer('candidate', 'Candidate', candidates.map(c => [c, c]), candidates.find(c => !own(c)) ?? candidates[0]);
follow(() => { for (const e of document.querySelectorAll('.over')) e.textContent = over(); });
follow(verdict);
follow(answerMatrix);
followChart(speedChart);
byId('matrix-quantity').addEventListener('change', answerMatrix);
byId('chart-time').addEventListener('change', speedChart);
