// The page of `touchstone compare`: what changed beyond the limits, and speed and accuracy before and now.
const {comparison, before, after} = data, {limits} = comparison;
const names = [...new Set([...before, ...after].map(r => r.candidate))];

const beyond = comparison.changes.filter(c => c.beyond_limits);
const verdicts = ['worse', 'slower', 'better', 'faster'];
function words() {
  const counts = verdicts.map(v => [v, new Set(beyond.filter(c => c.verdict === v).map(c => `${c.pair}/${c.class}/${c.candidate}`)).size]);
  byId('headline').textContent = beyond.length === 0 ? 'Nothing beyond the limits.' :
      counts.filter(([, n]) => n).map(([v, n]) => `${n} ${v}`).join(', ') + '.';
  byId('remarks').append(...comparison.remarks.map(r => element('li', {}, r)));
  byId('baseline').textContent = limits.baseline;
  byId('limits').textContent = `${comparison.compared} rows of pair, class and candidate were compared. ` +
      `An error may grow ${limits.error_factor} times, a time ${limits.time_factor} times (as a multiple of ` +
      `${limits.baseline}'s, by the nearest ends of the spreads), and ${percent(limits.agreement)} of the agreement must be kept. ` +
      `${comparison.changes.length - beyond.length} smaller changes are not listed.`;
}
function value(c, which) {
  if (c.measure === 'has a routine') return c[which] ? 'yes' : 'no';
  if (c.measure.startsWith('agreement')) return (100 * c[which]).toFixed(1) + '%';
  return c.measure === 'instructions' ? whole(c[which]) : exponent(c[which]);
}
function changeTable() {
  if (beyond.length === 0) return;
  byId('change-table').append(table([...['', 'pair', 'class', 'candidate', 'measure'].map(textColumn), 'before', 'now', 'factor'],
      verdicts.flatMap(v => beyond.filter(c => c.verdict === v)).map(c => [
        element('td', {class: 'text ' + (c.verdict === 'worse' || c.verdict === 'slower' ? 'bad' : 'good')}, c.verdict),
        c.pair, c.class, named(c.candidate), c.measure, value(c, 'before'), value(c, 'after'),
        c.factor === null ? '–' : '× ' + exponent(c.factor, 3)]),
      `${beyond.length} changes; a factor is what is now, divided by what was, where an error below 1e-14 counts as that, ` +
      'and of the patch not covered a share below 0.01'));
}

// A chart of each pair, on the same axes.
function placesOf(summary) {
  const rows = summary.filter(r => r.class === group);
  return rows.flatMap(r => {
    const base = rows.find(s => s.pair === r.pair && s.candidate === limits.baseline);
    if (!r.nanoseconds || !r.depth_error || !base || !base.nanoseconds) return [];
    const time = limits.baseline === 'bullet' && r.nanoseconds.ratio_to_bullet ||
        r.nanoseconds.median / base.nanoseconds.median;
    return [{pair: r.pair, candidate: r.candidate, covers: coveredOf(rows, r), x: time, y: Math.max(r.depth_error.p99, 1e-17), front: r.pareto}];
  });
}
const legend = element('div', {class: 'legend'});
byId('chart-panels').before(legend);
function charts() {
  const was = placesOf(before), is = placesOf(after), all = [...was, ...is], host = byId('chart-panels');
  redrawn.length = 0;
  host.replaceChildren();
  if (all.length === 0) return host.append(`No times relative to ${limits.baseline}.`);
  legend.replaceChildren(...names.filter(n => all.some(p => p.candidate === n)).map(n => named(n)));
  const x = {title: `time, × ${limits.baseline}`, ...decadesOf(all.map(p => p.x)), label: `'× ' + (${numberLabel})`};
  const y = powerAxis('depth error, p99 (sizes)', all.map(p => p.y));
  const pairs = [...new Set(all.map(p => p.pair))].sort((a, b) => (b === 'all') - (a === 'all'));
  const places = pairs.map(pair => [pair, element('div', {class: 'chart'})]);
  host.append(...places.map(([pair, place]) => pairPanel(pair, place)));
  const of = (list, pair) => list.filter(p => p.pair === pair);
  for (const [pair, place] of places) keepDrawn(() => changeChart(place, pair, of(was, pair), of(is, pair), x, y));
}
function changeChart(place, pair, was, is, x, y) {
  // A movement is measured in shares of the axes; below one in a hundred the old mark is left out.
  const moved = (a, b) => a && b ? Math.hypot(...[[x, 'x'], [y, 'y']].map(([{domain}, k]) => Math.log(a[k] / b[k]) / Math.log(domain[1] / domain[0]))) : 1;
  const points = names.flatMap((name, i) => {
    const [old, now] = [was, is].map(list => list.find(p => p.candidate === name)), latest = now || old;
    if (!latest) return [];
    const way = moved(old, now), mark = markData(name), where = p => p ? `depth error p99 ${exponent(p.y)}, × ${exponent(p.x, 3)}` : 'not measured';
    const tip = `${name}, ${dashed(pair)}\nbefore: ${where(old)}\nnow: ${where(now)}`;
    const label = {label: name + latest.covers, weight: latest.front ? 'bold' : 'normal', order: latest.front ? i : way > 0.05 ? 100 + i : 1000 + i};
    return [...(old && way > 0.01 ? [{...mark, ...old, tip, label: '', order: 2000 + i, ...(!now && label), fill: 'var(--panel)', stroke: colour(name), size: 55}] : []),
            ...(now ? [{...mark, ...now, tip, ...label, size: 55}] : [])];
  });
  const front = list => list.filter(p => p.front).sort((a, b) => a.x - b.x);
  const moves = names.map(n => [was, is].map(list => list.find(p => p.candidate === n))).filter(([a, b]) => a && b && moved(a, b) > 0.01).flat();
  drawScatter(place, `Depth error against time, before and now, ${dashed(pair)}`, {height: panelHeight(pair), x, y, points, lines: [
    {rows: front(was), dash: [4, 3], width: 1.2}, {rows: front(is), colour: 'var(--ink)', width: 1.2}, {rows: moves, by: 'candidate', width: 0.8}]});
}
words();
changeTable();
groupControl(byId('groups'), [...new Set([...before, ...after].map(r => r.class))]);
keepGrouped(charts);
listSections();
