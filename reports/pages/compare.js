const {comparison, before, after} = data;
const limits = comparison.limits;
const names = [...new Set([...before, ...after].map(r => r.candidate))];
const colour = name => `var(${markOf(name).colour})`;
const symbolOf = name => markOf(name).symbol;

// Words and table.
const beyond = comparison.changes.filter(c => c.beyond_limits);
const verdicts = ['worse', 'slower', 'better', 'faster'];
const counts = verdicts.map(v => [v, new Set(beyond.filter(c => c.verdict === v)
    .map(c => `${c.pair}/${c.class}/${c.candidate}`)).size]);
byId('headline').textContent = beyond.length === 0 ? 'Nothing beyond the limits.' :
    counts.filter(([, n]) => n).map(([v, n]) => `${n} ${v}`).join(', ') + '.';
byId('remarks').append(...comparison.remarks.map(r => element('li', {}, r)));
byId('baseline').textContent = limits.baseline;
byId('limits').textContent = `${comparison.compared} rows of pair, class and candidate were compared. ` +
    `An error may grow ${limits.error_factor} times, a time ${limits.time_factor} times (as a multiple of ` +
    `${limits.baseline}'s, by the nearest ends of the spreads), and ${limits.agreement} of the agreement must be kept. ` +
    `${comparison.changes.length - beyond.length} smaller changes are not listed.`;
function value(c, which) {
  if (c.measure === 'has a routine') return c[which] ? 'yes' : 'no';
  if (c.measure === 'agreement') return (100 * c[which]).toFixed(1) + '%';
  return c.measure === 'instructions' ? String(Math.round(c[which])) : exponent(c[which]);
}
if (beyond.length) {
  const rows = verdicts.flatMap(v => beyond.filter(c => c.verdict === v)).map(c => element('tr', {},
      element('td', {class: 'text ' + (c.verdict === 'worse' || c.verdict === 'slower' ? 'bad' : 'good')}, c.verdict),
      element('td', {class: 'text'}, c.pair), element('td', {class: 'text'}, c.class),
      element('td', {class: 'text'}, c.candidate), element('td', {class: 'text'}, c.measure),
      element('td', {}, value(c, 'before')), element('td', {}, value(c, 'after')),
      element('td', {}, c.factor === null ? '–' : '× ' + c.factor.toPrecision(3))));
  const heads = ['', 'pair', 'class', 'candidate', 'measure', 'before', 'now', 'factor'];
  byId('change-table').append(element('table', {}, element('thead', {}, element('tr', {},
      ...heads.map((h, i) => element('th', {scope: 'col', class: i < 5 ? 'text' : ''}, h)))),
      element('tbody', {}, ...rows)));
}

// Charts: one for each pair, on common axes.
const floor = 1e-17;
function places(rows) {
  return rows.flatMap(r => {
    const of = rows.find(s => s.pair === r.pair && s.candidate === limits.baseline);
    if (!r.nanoseconds || !r.depth_error || !of || !of.nanoseconds) return [];
    const time = limits.baseline === 'bullet' && r.nanoseconds.ratio_to_bullet ||
        r.nanoseconds.median / of.nanoseconds.median;
    return [{pair: r.pair, name: r.candidate, time, error: Math.max(r.depth_error.p99, floor), front: r.pareto}];
  });
}
const old = places(before), now = places(after), all = [...old, ...now];
const decades = values => {
  const lo = Math.floor(Math.log10(Math.min(...values))), hi = Math.ceil(Math.log10(Math.max(...values)));
  return [lo, Math.max(hi, lo + 1)];
};
function panel(pair, [x0, x1], [y0, y1]) {
  const width = 360, height = 270, left = 46, right = 26, top = 14, bottom = 40;
  const x = p => left + (Math.log10(p.time) - x0) / (x1 - x0) * (width - left - right);
  const y = p => height - bottom - (Math.log10(p.error) - y0) / (y1 - y0) * (height - top - bottom);
  const svg = shape('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img',
      'aria-label': `Depth error against time, before and now, ${pair}`});
  const text = (x, y, anchor, words) => shape('text', {class: 'tick', x, y, 'text-anchor': anchor}, words);
  for (let d = x0; d <= x1; ++d) {
    const at = x({time: 10 ** d});
    svg.append(shape('line', {class: 'grid', x1: at, x2: at, y1: top, y2: height - bottom}),
        text(at, height - bottom + 15, 'middle', `× ${d < 0 ? (10 ** d).toFixed(-d) : 10 ** d}`));
  }
  for (let d = y0; d <= y1; d += Math.max(1, Math.ceil((y1 - y0) / 8))) {
    const at = y({error: 10 ** d});
    svg.append(shape('line', {class: 'grid', x1: left, x2: width - right, y1: at, y2: at}),
        text(left - 6, at + 4, 'end', `1e${d}`));
  }
  svg.append(text((left + width - right) / 2, height - 6, 'middle', `time, × ${limits.baseline}`));
  const sides = [[old, 'before'], [now, 'after']].map(([list, side]) => [list.filter(p => p.pair === pair), side]);
  for (const [here, side] of sides) {
    const front = here.filter(p => p.front).sort((a, b) => a.time - b.time);
    svg.append(shape('polyline', {class: side, points: front.map(p => `${x(p)},${y(p)}`).join(' ')}));
  }
  for (const name of names) {
    const [was, is] = sides.map(([here]) => here.find(p => p.name === name));
    const way = was && is ? Math.hypot(x(is) - x(was), y(is) - y(was)) : 0, moved = way > 3;
    if (moved) svg.append(shape('line', {class: 'move', x1: x(was), y1: y(was), x2: x(is), y2: y(is)}));
    const mark = (p, fill) => svg.append(shape('path', {...fill, d: symbolPath(symbolOf(name), x(p), y(p), 4.5)}));
    if (was && (moved || !is)) mark(was, {class: 'hollow', stroke: colour(name)});
    if (is) mark(is, {fill: colour(name)});
    const shown = is || was;
    if (shown && (way > 20 || !was || !is || shown.front)) {
      const leftwards = x(shown) > width * 0.62;
      svg.append(shape('text', {class: 'label', x: x(shown) + (leftwards ? -8 : 8), y: y(shown) + 4,
          'text-anchor': leftwards ? 'end' : 'start'}, name));
    }
  }
  return element('figure', {}, element('figcaption', {}, pair === 'all' ? 'all pairs' : pair), svg);
}
if (all.length === 0) {
  byId('chart-panels').append(`No times relative to ${limits.baseline}.`);
} else {
  const xs = decades(all.map(p => p.time)), ys = decades(all.map(p => p.error));
  byId('chart-panels').before(element('div', {class: 'legend'}, ...names.filter(n => all.some(p => p.name === n)).map(n => {
    const svg = shape('svg', {viewBox: '-8 -8 16 16', style: 'display:inline;width:14px;height:14px;margin-right:.3em;vertical-align:middle', 'aria-hidden': 'true'});
    svg.append(shape('path', {fill: colour(n), d: symbolPath(symbolOf(n), 0, 0, 5.5)}));
    return element('span', {}, svg, n);
  })));
  for (const pair of new Set(all.map(p => p.pair))) byId('chart-panels').append(panel(pair, xs, ys));
}
