'use strict';
// What the pages have in common.
const byId = id => document.getElementById(id);
const data = JSON.parse(byId('data').textContent), {marks} = data;

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

// Links to the sections that are shown, in the header.
function listSections() {
  byId('contents').append(...[...document.querySelectorAll('main > section')].filter(s => !s.hidden)
      .map(s => element('a', {href: `#${s.id}`}, s.querySelector('h2').textContent)));
}

// Marks of candidates, the same on every page: what marks.cpp says of each name, as the page's `marks`.
const symbols = ['circle', 'square', 'triangle', 'diamond', 'cross', 'wedge'];
const truthMark = {colour: '--ink', symbol: 'diamond'};
const markOf = name => ({colour: `--c${marks[name][0]}`, symbol: symbols[marks[name][1]]});
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
