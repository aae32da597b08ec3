// The page of `touchstone report --history`: agreement and time over the releases of an engine, and what each changed.
const {history: {engine, steps}, releases, summary, versions} = data;
const numberOf = name => name.slice(engine.length + 1);
const rowOf = (pair, name) => summary.find(r => r.pair === pair && r.class === 'everyday' && r.candidate === name && supported(r));
const pairs = ['all', ...new Set(summary.map(r => r.pair).filter(p => p !== 'all'))].filter(p => releases.some(name => rowOf(p, name)));
// A pair's mark: that of all pairs in ink.
const pairMark = pair => ({colour: pair === 'all' ? '--ink' : `--c${pairs.indexOf(pair)}`, symbol: symbols[pairs.indexOf(pair) % symbols.length]});
const hasMended = step => step.after > step.before;
const share = x => (100 * x).toFixed(1) + '%';
const changeText = step => `${share(step.before)} → ${share(step.after)}`;

function draw(id, label, y, valueOf, textOf) {
  const points = pairs.flatMap(pair => releases.flatMap(name => {
    const row = rowOf(pair, name), value = row && valueOf(row), {colour, symbol} = pairMark(pair);
    return value === undefined || value === null ? [] : [{candidate: pair, x: numberOf(name), y: value, tip: `${name} (${versions[name]}), ${pairWords(pair)}\n${textOf(row)}`,
      fill: `var(${colour})`, line: `var(${colour})`, stroke: null, width: pair === pairs[0] ? 2.5 : 1.5, symbol: symbolPath(symbol, 0, 0, 1)}];
  }));
  if (points.length === 0) return clearChart(byId(id), 'Not measured.');
  drawLines(byId(id), label, {height: 260, x: {title: 'release', type: 'point', domain: releases.map(numberOf)}, y: y(points.map(p => p.y)), points});
}
function drawHistory() {
  // From the tenth below the lowest.
  draw('agreement-chart', `Agreement of the releases of ${engine}`, values => ({...shareAxis('answered right'),
    domain: [Math.floor(Math.min(...values) * 10 - 1e-9) / 10, 1]}), agreeing, agreement);
  draw('time-chart', `Times of the releases of ${engine}`, values => ({title: 'median time', ...decadesOf(values),
    label: "datum.value < 1000 ? datum.value + ' ns' : datum.value / 1000 + ' µs'"}), r => r.nanoseconds?.median, r => duration(r.nanoseconds.median));
}
function changeTables() {
  const cell = (pair, mended) => {
    const all = steps.filter(s => s.pair === pair && hasMended(s) === mended), [first] = all;
    if (!first) return element('td', {class: 'text quiet'}, 'none');
    return element('td', {class: mended ? 'text good' : 'text bad'}, `${first.candidate}: ${first.class}, ${changeText(first)}`,
        element('small', {}, all.length > 1 ? ` and ${all.length - 1} more` : ''));
  };
  byId('first-table').replaceChildren(table(['pair', 'first broken', 'first mended'].map(textColumn),
      pairs.filter(p => p !== 'all').map(p => [dashed(p), cell(p, false), cell(p, true)]),
      'A class counts as broken or mended where a twentieth or more of its answers became wrong, or right, from one release to the next'));
  if (steps.length === 0) return;
  byId('steps').append(fold(`All ${steps.length} changes`, element('div', {class: 'scroll'}, table(
      [...['release', 'pair', 'class', ''].map(textColumn), 'before', 'then'], steps.map(s => [
        s.candidate, dashed(s.pair), s.class, element('td', {class: hasMended(s) ? 'text good' : 'text bad'}, hasMended(s) ? 'mended' : 'broke'),
        share(s.before), share(s.after)]), 'In the order of releases'))));
}

const [first, last] = [releases[0], releases[releases.length - 1]], ends = [first, last].map(name => rowOf(pairs[0], name));
byId('headline').textContent = `${engine}, ${releases.length} releases, ${numberOf(first)} to ${numberOf(last)}` +
    (ends.every(Boolean) ? `: ${agreement(ends[0])} of everyday poses answered right, then ${agreement(ends[1])}.` : '.');
byId('provenance').textContent = `touchstone ${data.version}: ${data.command}`;
byId('legend').append(...pairs.map(p => element('span', {}, symbolSign(pairMark(p)), pairWords(p))));
keepDrawn(drawHistory);
changeTables();
listSections();
