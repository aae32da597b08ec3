// Charts by Vega, in the page's colours and as wide as their place, and the one tooltip.
byId('credits').textContent = 'Charts by Vega (© 2015–2022 University of Washington Interactive Data Lab, BSD-3-Clause) ' +
    'with parts of D3 (© 2010–2022 Mike Bostock, ISC).';

const chartConfig = {
  axis: {domainColor: 'var(--line)', gridColor: 'var(--line)', tickColor: 'var(--line)', labelColor: 'var(--quiet)',
         titleColor: 'var(--quiet)', titleFontWeight: 'normal', labelFontSize: 11, titleFontSize: 11, grid: true},
  text: {fill: 'var(--ink)', fontSize: 11},
};
// Signals for labels of logarithmic axes.
const powerLabel = "datum.value < 1.1e-18 ? '0' : '1e' + round(log(datum.value) / LN10)";
const timeLabel = "datum.value < 1e3 ? datum.value + ' ns' : datum.value < 1e6 ? datum.value / 1e3 + ' µs' : datum.value / 1e6 + ' ms'";
const decadesOf = (values, step = 1) => {
  const lo = Math.floor(Math.log10(Math.min(...values))), hi = Math.max(lo + 1, Math.ceil(Math.log10(Math.max(...values))));
  const ticks = [];
  for (let d = lo; d <= hi; d += step) ticks.push(10 ** d);
  return {domain: [10 ** lo, 10 ** hi], ticks, count: hi - lo};
};
const powerTicks = values => decadesOf(values, Math.max(1, Math.ceil(decadesOf(values).count / 8)));

// A mark with a datum may have `tip` (shown on hover and focus) and be clicked.
function drawChart(host, spec, onClick = () => {}) {
  if (host.chart) host.chart.finalize();
  host.replaceChildren();
  const full = {$schema: '', autosize: {type: 'fit', contains: 'padding'}, padding: 4, config: chartConfig, ...spec,
                width: Math.max(240, host.clientWidth)};
  const chart = new vega.View(vega.parse(full, chartConfig, {ast: true}), {expr: vega.expressionInterpreter});
  host.chart = chart;
  const datumOf = item => item && item.datum && item.datum.datum ? item.datum.datum : item && item.datum;
  chart.tooltip((handler, event, item, text) => text ? showTip(text, event.clientX, event.clientY) : hideTip());
  chart.addEventListener('click', (event, item) => { if (datumOf(item) && datumOf(item).tip) onClick(datumOf(item)); });
  chart.initialize(host).renderer('svg').hover().runAsync().then(() => reachByKeys(host, onClick));
  return chart;
}
// The symbols of a chart can be reached with the keyboard too.
function reachByKeys(host, onClick) {
  for (const path of host.querySelectorAll('.mark-symbol path')) {
    const datum = path.__data__ && path.__data__.datum;
    if (!datum || !datum.tip) continue;
    path.setAttribute('tabindex', 0);
    path.setAttribute('aria-label', datum.tip);
    path.addEventListener('focus', () => { const box = path.getBoundingClientRect(); showTip(datum.tip, box.right, box.bottom); });
    path.addEventListener('blur', hideTip);
    path.addEventListener('keydown', e => { if (e.key === 'Enter') onClick(datum); });
  }
}

// Charts are drawn again when their width or the choice of candidates changes.
const redrawn = [];
function keepDrawn(draw) {
  redrawn.push(draw);
  draw();
}
let drawnWidth = innerWidth, redrawTimer;
addEventListener('resize', () => {
  if (innerWidth === drawnWidth) return;
  clearTimeout(redrawTimer);
  redrawTimer = setTimeout(() => { drawnWidth = innerWidth; for (const draw of redrawn) draw(); }, 200);
});

function showTip(text, x, y) {
  const tip = byId('tooltip');
  tip.textContent = text;
  tip.hidden = false;
  tip.style.left = `${Math.max(8, Math.min(x + 12, innerWidth - tip.offsetWidth - 8))}px`;
  tip.style.top = `${Math.max(8, Math.min(y + 12, innerHeight - tip.offsetHeight - 8))}px`;
}
function hideTip() { byId('tooltip').hidden = true; }
// Of an element of the page.
function explain(target, text) {
  const show = () => { const box = target.getBoundingClientRect(); showTip(text, box.right - 4, box.bottom - 4); };
  for (const start of ['mouseenter', 'focus']) target.addEventListener(start, show);
  for (const end of ['mouseleave', 'blur']) target.addEventListener(end, hideTip);
}

// Which candidates the charts with a line for each show: the legend's buttons.
const usual = ['reference', 'bullet', 'bullet-margin-0', 'ode', 'fcl', 'fcl-distance', 'libccd-mpr', 'mujoco', 'prism:16', 'capsule'];
const shown = new Set(candidates.length <= 10 ? candidates : [...new Set([...usual, candidates[0]])].filter(c => candidates.includes(c)));
const toggles = [];
function shownLegend(host) {
  for (const name of candidates) {
    const button = element('button', {type: 'button', class: 'toggle', 'aria-pressed': shown.has(name)}, sign(name), name);
    button.addEventListener('click', () => {
      shown.has(name) ? shown.delete(name) : shown.add(name);
      for (const [of, toggle] of toggles) toggle.setAttribute('aria-pressed', shown.has(of));
      for (const draw of redrawn) draw();
    });
    toggles.push([name, button]);
    host.append(button);
  }
}
const markData = name => ({candidate: name, colour: colour(name), symbol: symbolPath(markOf(name).symbol, 0, 0, 1)});
// A line with a mark at each point for each candidate of `points` ({candidate, x, y, colour, symbol, tip}).
const candidateLines = [
  {type: 'group', from: {facet: {name: 'one', data: 'points', groupby: 'candidate'}}, marks: [
    {type: 'line', from: {data: 'one'}, encode: {
      update: {x: {scale: 'x', field: 'x'}, y: {scale: 'y', field: 'y'}, stroke: {field: 'colour'}, strokeWidth: {value: 1.5}}}}]},
  {type: 'symbol', from: {data: 'points'}, encode: {
    enter: {tooltip: {field: 'tip'}, shape: {field: 'symbol'}, fill: {field: 'colour'}},
    update: {x: {scale: 'x', field: 'x'}, y: {scale: 'y', field: 'y'}, size: {value: 22}}, hover: {size: {value: 90}}}},
];
