// Speed and accuracy: small multiples on common axes.
const floor = 1e-17;
const shownError = r => Math.max(r.depth_error.p99, floor);
const chartable = r => time(r) !== null && r.depth_error !== null;

// Overlapping spreads of time are a tie (reports/pareto.hpp).
const paretoFront = rows => rows.filter(r => r.pareto).sort((a, b) => time(a) - time(b));

function speedAccuracy() {
  const rows = report.summary.filter(chartable), host = byId('chart-panels');
  if (rows.length === 0) return host.append('No candidate was timed.');
  byId('chart-legend').append(...candidates.filter(name => rows.some(r => r.candidate === name)).map(name => named(name)));
  const scales = {x: decadesOf(rows.map(time)), y: powerTicks(rows.map(shownError))};
  for (const pair of [...new Set(rows.map(r => r.pair))].reverse()) {
    const place = element('div', {class: 'chart'});
    host.append(element('figure', {}, element('figcaption', {}, pair === 'all' ? 'all pairs' : dashed(pair)), place));
    keepDrawn(() => drawChart(place, speedSpec(rows.filter(r => r.pair === pair), scales), r => showWorst(pair, r.candidate)));
  }
}
function speedSpec(rows, {x, y}) {
  const front = paretoFront(rows);
  const datum = (r, i) => ({...markData(r.candidate), x: time(r), y: shownError(r), order: front.includes(r) ? i : 1000 + i,
      label: `${r.candidate} ${percent(agreeing(r))}`, weight: front.includes(r) ? 'bold' : 'normal',
      tip: `${r.candidate}, ${dashed(r.pair)}\nagrees on ${percent(agreeing(r))}, missed ${r.outcomes.missed || 0}\n` +
           `depth error p99 ${exponent(r.depth_error.p99)}, worst ${exponent(r.depth_error.max)}\n` +
           `${whole(time(r))} ns per query (quartiles ${whole(r.nanoseconds.low)} to ${whole(r.nanoseconds.high)})` +
           (r.tied_with.length ? `\nno faster or slower, within the spreads, than ${r.tied_with.join(', ')}` : '') +
           `\nClick for its worst cases`});
  // The members of a family, in the order of their parameter.
  const members = report.candidates.map(c => ({family: c.family, row: rows.find(r => r.candidate === c.name)})).filter(m => m.row);
  const line = {x: {scale: 'x', field: 'x'}, y: {scale: 'y', field: 'y'}};
  return {
    height: 300,
    data: [{name: 'rows', values: rows.map(datum)}, {name: 'front', values: front.map(datum)},
           {name: 'members', values: members.map(m => ({family: m.family, x: time(m.row), y: shownError(m.row)}))}],
    scales: [{name: 'x', type: 'log', domain: x.domain, range: 'width'}, {name: 'y', type: 'log', domain: y.domain, range: 'height'}],
    axes: [{orient: 'bottom', scale: 'x', values: x.ticks, title: 'time per query', encode: {labels: {update: {text: {signal: timeLabel}}}}},
           {orient: 'left', scale: 'y', values: y.ticks, title: 'depth error, p99 (sizes)', encode: {labels: {update: {text: {signal: powerLabel}}}}}],
    marks: [
      {type: 'group', from: {facet: {name: 'family', data: 'members', groupby: 'family'}}, marks: [
        {type: 'line', from: {data: 'family'}, encode: {update: {...line, stroke: {value: 'var(--quiet)'}, strokeWidth: {value: 0.8}}}}]},
      {type: 'line', from: {data: 'front'}, encode: {
        update: {...line, stroke: {value: 'var(--quiet)'}, strokeDash: {value: [4, 3]}}}},
      {type: 'symbol', name: 'marks', from: {data: 'rows'}, encode: {
        enter: {tooltip: {field: 'tip'}, cursor: {value: 'pointer'}, shape: {field: 'symbol'}, fill: {field: 'colour'}},
        update: {...line, size: {value: 30}}, hover: {size: {value: 110}}}},
      // Only labels that find room are shown; those of the front choose first. The style sheet makes them
      // smaller than what room is sought for.
      {type: 'text', from: {data: 'marks'}, encode: {
        enter: {text: {field: 'datum.label'}, fontWeight: {field: 'datum.weight'}, fontSize: {value: 13}, fill: {value: 'var(--ink)'}}},
        transform: [{type: 'label', size: {signal: '[width, height]'}, offset: [7], padding: 0, avoidMarks: ['marks'],
                     anchor: ['right', 'left', 'top-right', 'bottom-right', 'top-left', 'bottom-left', 'top', 'bottom'],
                     sort: {field: 'datum.datum.order'}}]},
    ],
  };
}
speedAccuracy();
