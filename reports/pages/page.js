'use strict';
// What all pages share: builders of elements, marks of candidates, numbers, tables, the tooltip.
const byId = id => document.getElementById(id);
const data = JSON.parse(byId('data').textContent), {marks, runs = {}, programs = {}} = data;

// Builders of elements. Strings become text, never markup.
function fillElement(e, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  e.append(...children.filter(c => c !== null && c !== undefined));
  return e;
}
const element = (name, attributes = {}, ...children) => fillElement(document.createElement(name), attributes, children);
const shape = (name, attributes = {}, ...children) =>
    fillElement(document.createElementNS('http://www.w3.org/2000/svg', name), attributes, children);
function definitions(id, entries) {
  byId(id).append(...entries.flatMap(([term, text]) => [element('dt', {}, term), element('dd', {}, text)]));
}
// Options of a select box: values or [value, text].
const options = values => values.map(v => Array.isArray(v) ? element('option', {value: v[0]}, v[1]) : element('option', {value: v}, v));
// Lists the visible sections in the header.
function listSections() {
  byId('contents').append(...[...document.querySelectorAll('main > section')].filter(s => !s.hidden)
      .map(s => element('a', {href: `#${s.id}`}, s.querySelector('h2').textContent)));
}

// Marks of candidates: the colour and symbol that mark_of in C++ gives each name.
const symbols = ['circle', 'square', 'triangle', 'diamond', 'cross', 'wedge'];
const truthMark = {colour: '--ink', symbol: 'diamond'};
const markOf = name => ({colour: `--c${marks[name][0]}`, symbol: symbols[marks[name][1]]});
const colour = name => `var(${markOf(name).colour})`;
function symbolPath(kind, x, y, s) {
  switch (kind) {
    case 'square': return `M${x - s},${y - s}h${2 * s}v${2 * s}h${-2 * s}z`;
    case 'triangle': return `M${x},${y - 1.2 * s}l${1.2 * s},${2.1 * s}h${-2.4 * s}z`;
    case 'wedge': return `M${x},${y + 1.2 * s}l${1.2 * s},${-2.1 * s}h${-2.4 * s}z`;
    case 'cross': return `M${x - s},${y - .35 * s}h${.65 * s}v${-.65 * s}h${.7 * s}v${.65 * s}h${.65 * s}v${.7 * s}h${-.65 * s}v${.65 * s}h${-.7 * s}v${-.65 * s}h${-.65 * s}z`;
    case 'diamond': return `M${x},${y - 1.4 * s}l${1.4 * s},${1.4 * s}l${-1.4 * s},${1.4 * s}l${-1.4 * s},${-1.4 * s}z`;
    default: return `M${x - s},${y}a${s},${s} 0 1,0 ${2 * s},0a${s},${s} 0 1,0 ${-2 * s},0`;
  }
}
// How Touchstone is started so that it knows a candidate.
const programOf = name => programs[name] || './touchstone';
const symbolSign = ({colour, symbol}) => shape('svg', {class: 'sign', viewBox: '-8 -8 16 16', 'aria-hidden': 'true'},
    shape('path', {fill: `var(${colour})`, d: symbolPath(symbol, 0, 0, 5.5)}));
const sign = name => symbolSign(markOf(name));
// A candidate that does not run as native code is marked so wherever its name stands.
const runsText = name => runs[name] ? ` (${runs[name]})` : '';
const named = (name, ...rest) => element('span', {class: 'named'}, sign(name), name + runsText(name), ...rest);

// The colour of an outcome, as a variable of the style sheet.
const outcomeColours = {agree: '--agree', 'few-points': '--few-points', missed: '--c1', phantom: '--c3', shallow: '--c4',
  overdeep: '--c6', 'wrong-normal': '--c0', 'shallow-points': '--c8', 'overdeep-points': '--c9', 'phantom-points': '--c10',
  'not-finite': '--ink', failed: '--c7', crashed: '--bad', 'timed-out': '--timed-out', unsupported: '--line'};
const isFailure = outcome => outcome !== 'agree' && outcome !== 'unsupported';
const outcomeLegend = outcomes => element('div', {class: 'legend'}, ...outcomes.map(o => element('span', {},
    element('span', {class: 'swatch', style: `background:var(${outcomeColours[o]})`, 'aria-hidden': 'true'}), o)));

// Numbers as a person reads them. null: not measured.
function exponent(x) {
  if (x === null) return '–';
  if (x === 0) return '0';
  return Math.abs(x) >= 0.1 && Math.abs(x) < 1000 ? x.toPrecision(2).replace('+', '') : x.toExponential(1).replace('+', '');
}
const whole = x => x === null ? '–' : Math.round(x).toLocaleString('en');
// Both round down, so that 1.00 means the whole patch and 100% no failure.
const cutShare = share => share === null ? '–' : (Math.floor(share * 100 + 1e-6) / 100).toFixed(2);
const percent = share => share === 1 ? '100%' : (Math.floor(share * 1000 + 1e-6) / 10).toFixed(1) + '%';
const dashed = pair => pair.replace('-', '–');

// Tables. A head is a string or a cell; a row is an element or a list of strings and cells. A string takes the class
// of its column's head.
const column = (text, attributes = {}) => element('th', {scope: 'col', ...attributes}, text);
const textColumn = text => column(text, {class: 'text'});
const rowHead = (...children) => element('th', {scope: 'row'}, ...children);
function table(heads, rows, caption) {
  const columns = heads.map(h => h instanceof Element ? h : column(h));
  const cell = (c, i) => c instanceof HTMLTableCellElement ? c : element('td', {class: columns[i].className}, c);
  return element('table', {}, caption && element('caption', {}, caption),
      element('thead', {}, element('tr', {}, ...columns)),
      element('tbody', {}, ...rows.map(r => r instanceof Element ? r : element('tr', {}, ...r.map(cell)))));
}
const outcomeCell = outcome => element('td', {class: isFailure(outcome) ? 'text bad' : 'text'}, outcome);
// The background of a cell: pale at 0, full at 1.
const heated = level => `background: color-mix(in srgb, var(--heat) ${Math.round(70 * Math.min(1, Math.max(0, level)))}%, transparent)`;

// A command with a button that copies it.
function command(text) {
  const copy = element('button', {type: 'button'}, 'Copy');
  copy.addEventListener('click', () => navigator.clipboard.writeText(text).then(
      () => { copy.textContent = 'Copied'; }, () => { copy.textContent = 'Select and copy'; }));
  return element('div', {class: 'command'}, element('code', {}, text), copy);
}
// Calls `act` when an element is clicked or Enter is pressed on it.
function whenPressed(target, act) {
  target.addEventListener('click', act);
  target.addEventListener('keydown', e => { if (e.key === 'Enter') act(); });
}

// Groups of pose classes: one is shown at a time, for no number over all of them means anything. `grouped` holds what is
// drawn anew when another is chosen.
const groupMeanings = {
  everyday: 'sizes within 1:20, turned at random, shallow, resting or apart',
  degenerate: 'exact, near-exact and symmetric',
  extreme: 'extreme proportions, scales, distances and depths',
  recorded: 'as scenes have produced them',
};
let group = null;
const grouped = [];
function keepGrouped(draw) {
  grouped.push(draw);
  draw();
}
function groupControl(host, groups) {
  group = groups[0] ?? null;
  host.hidden = group === null;
  const meaning = element('span', {class: 'quiet wide'});
  const buttons = groups.map(g => element('button', {type: 'button', value: g}, g));
  const choose = chosen => {
    group = chosen;
    meaning.textContent = groupMeanings[group] ?? '';
    for (const b of buttons) b.setAttribute('aria-pressed', b.value === group);
  };
  for (const b of buttons) b.addEventListener('click', () => { choose(b.value); for (const draw of grouped) draw(); });
  host.append(element('span', {}, 'Poses: '), element('span', {class: 'choice', role: 'group', 'aria-label': 'Poses'}, ...buttons), meaning);
  choose(group);
}
const onThemeChange = act => matchMedia('(prefers-color-scheme: dark)').addEventListener('change', act);

// The tooltip, one for the page.
function showTip(text, x, y) {
  const tip = byId('tooltip');
  tip.textContent = text;
  tip.hidden = false;
  tip.style.left = `${Math.max(8, Math.min(x + 12, innerWidth - tip.offsetWidth - 8))}px`;
  tip.style.top = `${Math.max(8, Math.min(y + 12, innerHeight - tip.offsetHeight - 8))}px`;
}
function hideTip() { byId('tooltip').hidden = true; }
function explain(target, text) {
  const show = () => { const box = target.getBoundingClientRect(); showTip(text, box.right - 4, box.bottom - 4); };
  for (const start of ['mouseenter', 'focus']) target.addEventListener(start, show);
  for (const end of ['mouseleave', 'blur']) target.addEventListener(end, hideTip);
}
