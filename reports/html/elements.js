'use strict';
// What the pages have in common.
const byId = id => document.getElementById(id);

// Small builders; text always goes in as text.
function element(name, attributes = {}, ...children) {
  const e = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  e.append(...children.filter(c => c !== null && c !== undefined));
  return e;
}
function shape(name, attributes = {}, text) {
  const e = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  if (text !== undefined) e.textContent = text;
  return e;
}
function definitions(id, entries) {
  byId(id).append(...entries.flatMap(([term, text]) => [element('dt', {}, term), element('dd', {}, text)]));
}

// Marks of candidates, the same on every page: a colour for each engine, a symbol for each of its
// settings. What is not known here shares a colour and gets a symbol by its name.
const symbols = ['circle', 'square', 'triangle', 'diamond', 'cross', 'wedge'];
const engines = [
  ['reference'],
  ['bullet', 'bullet-margin-0', 'bullet-persistent', 'bullet-hull', 'bullet-float', 'bullet-float-margin-0'],
  ['ode', 'ode-mesh'],
  ['fcl', 'fcl-indep', 'fcl-distance'],
  ['libccd-gjk', 'libccd-mpr'],
  ['mujoco'],
  ['capsule', 'capsule-circumscribed', 'spheres', 'prism', 'box-spheres', 'box-capsules'],
];
const truthMark = {colour: '--ink', symbol: 'diamond'};
function markOf(name) {
  const family = name.split(':')[0], engine = engines.findIndex(names => names.includes(family));
  const place = engine >= 0 ? engines[engine].indexOf(family) : [...name].reduce((sum, c) => sum + c.charCodeAt(0), 0);
  return {colour: `--c${engine >= 0 ? engine : engines.length}`, symbol: symbols[place % symbols.length]};
}
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

// Numbers as a person reads them. null: not measured.
function exponent(x) {
  if (x === null) return '–';
  if (x === 0) return '0';
  return Math.abs(x) >= 0.1 && Math.abs(x) < 1000 ? x.toPrecision(2) : x.toExponential(1).replace('+', '');
}
// Cut downwards: only what covers the whole patch shows 1.00.
const cutShare = share => share === null ? '–' : (Math.floor(share * 100 + 1e-6) / 100).toFixed(2);
