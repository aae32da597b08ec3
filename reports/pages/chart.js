// Charts drawn by Vega in the page's colours, each as wide as the element that holds it.
byId('credits').textContent = 'Charts by Vega (© 2015–2022 University of Washington Interactive Data Lab, BSD-3-Clause) ' +
    'with parts of D3 (© 2010–2022 Mike Bostock, ISC).';
const chartConfig = {
  axis: {domainColor: 'var(--line)', gridColor: 'var(--line)', tickColor: 'var(--line)', labelColor: 'var(--quiet)',
         titleColor: 'var(--quiet)', titleFontWeight: 'normal', labelFontSize: 11, titleFontSize: 11, grid: true},
  text: {fill: 'var(--ink)', fontSize: 11},
};

// Draws a chart into `host`. `label` is its name for screen readers. A mark whose datum has a `tip` shows it on hover and
// focus, and a click on it calls `onClick` with the datum.
function drawChart(host, label, spec, onClick = () => {}) {
  if (host.chart) host.chart.finalize();
  host.replaceChildren();
  host.classList.add('chart');
  const full = {$schema: '', description: label, autosize: {type: 'fit', contains: 'padding'}, padding: 4,
                config: chartConfig, ...spec, width: Math.max(240, host.clientWidth)};
  const chart = new vega.View(vega.parse(full, chartConfig, {ast: true}), {expr: vega.expressionInterpreter});
  host.chart = chart;
  const datumOf = item => item && item.datum && item.datum.datum ? item.datum.datum : item && item.datum;
  chart.tooltip((handler, event, item, text) => text ? showTip(text, event.clientX, event.clientY) : hideTip());
  chart.addEventListener('click', (event, item) => { if (datumOf(item) && datumOf(item).tip) onClick(datumOf(item)); });
  chart.initialize(host).renderer('svg').hover().runAsync().then(() => {
    const svg = host.querySelector('svg');
    for (const name of ['role', 'aria-label', 'aria-roledescription']) host.removeAttribute(name);  // Vega's; the picture has them
    svg.setAttribute('role', 'graphics-document');
    svg.setAttribute('aria-label', label);
    reachByKeys(svg, onClick);
  });
}
// Words in place of a chart.
function clearChart(host, words) {
  if (host.chart) host.chart.finalize();
  host.chart = null;
  host.classList.remove('chart');
  host.replaceChildren(words);
}
// Makes the symbols and bars of a chart one tab stop, within which arrow keys move. Left and right keep to a line, up and
// down change to what other lines have nearby; where there are no lines, every mark is a neighbour.
function reachByKeys(svg, onClick) {
  const datumOf = path => path.__data__ && path.__data__.datum;
  const paths = [...svg.querySelectorAll(':is(.mark-symbol, .mark-rect) path')].filter(p => datumOf(p) && datumOf(p).tip);
  if (paths.length === 0) return;
  for (const path of paths) {
    const {tip} = datumOf(path);
    path.parentElement.setAttribute('role', 'graphics-object');  // Vega makes it a symbol, whose parts would not be read
    path.setAttribute('tabindex', -1);
    path.setAttribute('role', 'graphics-symbol');
    path.setAttribute('aria-label', tip);
    path.addEventListener('focus', () => { const box = path.getBoundingClientRect(); showTip(tip, box.right, box.bottom); });
    path.addEventListener('blur', hideTip);
    path.addEventListener('keydown', e => {
      if (e.key === 'Enter') onClick(datumOf(path));
      if (e.key === 'Escape') hideTip();
    });
  }
  const lineOf = path => datumOf(path).candidate, hasLines = new Set(paths.map(lineOf)).size < paths.length;
  const place = path => { const box = path.getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2]; };
  const ways = {ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [1, -1], ArrowDown: [1, 1], Home: [0, -Infinity], End: [0, Infinity]};
  rove(svg, paths[0], (from, key) => {
    if (!ways[key]) return null;
    const [axis, way] = ways[key], at = new Map(paths.map(p => [p, place(p)])), x = at.get(from)[0];
    const aside = p => Math.abs(at.get(p)[0] - x), nearestOfEachLine = () => [...new Set(paths.map(lineOf))].map(line =>
        line === lineOf(from) ? from : paths.filter(p => lineOf(p) === line).sort((a, b) => aside(a) - aside(b))[0]);
    const list = !hasLines ? [...paths] : axis === 0 ? paths.filter(p => lineOf(p) === lineOf(from)) : nearestOfEachLine();
    list.sort((a, b) => at.get(a)[axis] - at.get(b)[axis]);
    return list[Math.max(0, Math.min(list.length - 1, list.indexOf(from) + way))];
  });
}
// Draws now, and again whenever the width or the choice of candidates changes.
const redrawn = [];
function keepDrawn(draw) {
  redrawn.push(draw);
  draw();
}
function followChart(draw) {
  followers.push(draw);
  keepDrawn(draw);
}
let drawnWidth = innerWidth, redrawTimer;
addEventListener('resize', () => {
  if (innerWidth === drawnWidth) return;
  clearTimeout(redrawTimer);
  redrawTimer = setTimeout(() => { drawnWidth = innerWidth; for (const draw of redrawn) draw(); }, 200);
});

// Vega's scale and axis. `label` is an expression for the text of a tick; `rest` is passed on to the axis.
function axis(name, {title, domain, ticks, label, type = 'log', nice = false, ...rest}) {
  const across = name === 'x';
  return {scale: {name, type, domain, range: across ? 'width' : 'height', ...(type === 'point' ? {padding: 0.5} : {nice, zero: false})},
          axis: {orient: across ? 'bottom' : 'left', scale: name, title, ...(ticks && {values: ticks}),
                 ...(label && {encode: {labels: {update: {text: {signal: label}}}}}), ...rest}};
}
function axes(x, y) {
  const both = [axis('x', x), axis('y', y)];
  return {scales: both.map(a => a.scale), axes: both.map(a => a.axis)};
}
// The decades that enclose the values, with a tick at every `step`-th of them.
function decadesOf(values, step = 1) {
  const lo = Math.floor(Math.log10(Math.min(...values))), hi = Math.max(lo + 1, Math.ceil(Math.log10(Math.max(...values))));
  const ticks = [];
  for (let d = lo; d <= hi; d += step) ticks.push(10 ** d);
  return {domain: [10 ** lo, 10 ** hi], ticks};
}
// An error of zero is drawn below all others.
const zeroAt = 1e-18;
const powerLabel = "datum.value < 1.1e-18 ? '0' : '1e' + round(log(datum.value) / LN10)";
function powerAxis(title, values) {
  const count = decadesOf(values).ticks.length - 1;
  return {title, ...decadesOf(values, Math.max(1, Math.ceil(count / 8))), label: powerLabel};
}
// Numbers as `exponent` writes them, on an axis of a few decades.
const numberLabel = "datum.value >= 0.1 && datum.value < 1000 ? format(datum.value, '~g') : '1e' + round(log(datum.value) / LN10)";
const shareAxis = title => ({title, type: 'linear', domain: [0, 1], format: '%', tickCount: 5});

// Marks of data that has x and y.
const place = {x: {scale: 'x', field: 'x'}, y: {scale: 'y', field: 'y'}};
// A line through the rows of `data`, or one for each value of `by`, as `look` says.
function lineMarks(data, by, look, name) {
  const line = from => ({type: 'line', from: {data: from}, interactive: false, encode: {update: {...place, ...look}}});
  const part = `${data}-part`;
  return {name, ...(by ? {type: 'group', from: {facet: {name: part, data, groupby: by}}, marks: [line(part)]} : line(data))};
}
// A dashed horizontal line.
const limitMark = y => ({name: 'limit', type: 'rule', interactive: false, encode: {update: {x: {value: 0}, x2: {signal: 'width'},
    y: {scale: 'y', value: y}, stroke: {value: 'var(--quiet)'}, strokeDash: {value: [5, 4]}}}});
const symbolMarks = (data, size, hovered, name) => ({type: 'symbol', name, from: {data}, encode: {
  enter: {tooltip: {field: 'tip'}, shape: {field: 'symbol'}, fill: {field: 'fill'}, stroke: {field: 'stroke'}},
  update: {...place, size: {signal: `datum.size || ${size}`}}, hover: {size: {signal: `datum.size || ${hovered}`}}}});
const markData = name => ({candidate: name, fill: colour(name), stroke: null, line: colour(name),
                           width: name === 'reference' ? 2.5 : 1.5, symbol: symbolPath(markOf(name).symbol, 0, 0, 1)});

// A line with a symbol at each point for each candidate of `points`: markData with x, y, tip.
function drawLines(host, label, {height = 280, x, y, points, limit}, onClick) {
  drawChart(host, label, {height, data: [{name: 'points', values: points}], ...axes(x, y), marks: [
    ...(limit ? [limitMark(limit)] : []),
    lineMarks('points', 'candidate', {stroke: {field: 'line'}, strokeWidth: {field: 'width'}}),
    symbolMarks('points', 22, 90)]}, onClick);
}

// A chart of points {x, y, symbol, fill, stroke, size, tip, label, weight, order} and of lines {rows, by, dash, colour,
// width} beneath them. Only labels that find room are shown, near the mark or somewhat farther off; labels of a lower order
// are placed first. A line without rows is left out: labels cannot avoid a mark that has no items.
const labelPlaces = ['right', 'left', 'top-right', 'bottom-right', 'top-left', 'bottom-left', 'top', 'bottom'];
function drawScatter(host, label, {height = 300, x, y, points, lines: given, limit}, onClick) {
  const lines = given.filter(({rows}) => rows.length > 0);
  drawChart(host, label, {height, data: [{name: 'points', values: points}, ...lines.map(({rows}, i) => ({name: `line-${i}`, values: rows}))],
    ...axes(x, y), marks: [
      ...(limit ? [limitMark(limit)] : []),
      ...lines.map(({by, dash, colour = 'var(--quiet)', width = 1}, i) => lineMarks(`line-${i}`, by,
          {stroke: {value: colour}, strokeWidth: {value: width}, ...(dash && {strokeDash: {value: dash}})}, `lines-${i}`)),
      symbolMarks('points', 30, 110, 'marks'),
      // The style sheet shows labels smaller than the size that they are placed with.
      {type: 'text', from: {data: 'marks'}, interactive: false, encode: {enter: {text: {field: 'datum.label'}, fontWeight: {field: 'datum.weight'},
                                                    fontSize: {value: 13}, fill: {value: 'var(--ink)'}}},
       transform: [{type: 'label', size: {signal: '[width, height]'}, offset: [...labelPlaces.map(() => 7), ...labelPlaces.map(() => 20)], padding: 0, avoidMarks: ['marks', ...(limit ? ['limit'] : []), ...lines.map((_, i) => `lines-${i}`)],
                    anchor: [...labelPlaces, ...labelPlaces],
                    sort: {field: 'datum.datum.order'}}]},
    ]}, onClick);
}

const panelHeight = () => innerWidth > 640 ? 420 : 300;

// The candidates whose lines are shown, chosen by the buttons of any legend.
const usual = ['reference', 'bullet', 'bullet-margin-0', 'ode', 'fcl', 'fcl-distance', 'libccd-mpr', 'mujoco', 'prism:16', 'capsule'];
const shown = new Set(), toggles = [];
function showUsual(names) {
  for (const name of names) if (names.length <= 10 || name === names[0] || usual.includes(name)) shown.add(name);
}
function shownLegend(host, names) {
  for (const name of names) {
    const button = element('button', {type: 'button', class: 'toggle', 'aria-pressed': shown.has(name)}, sign(name), name);
    button.addEventListener('click', () => {
      shown.has(name) ? shown.delete(name) : shown.add(name);
      for (const [of, toggle] of toggles) toggle.setAttribute('aria-pressed', shown.has(of));
      for (const draw of redrawn) draw();
    });
    toggles.push([name, button]);
    host.append(button);
  }
  host.setAttribute('role', 'toolbar');
  roveButtons(host, [...host.children]);
}
