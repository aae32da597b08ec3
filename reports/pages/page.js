'use strict';
// What all pages share: builders of elements, marks of candidates, outcomes, numbers, the contents, the tooltip, keys.
const byId = id => document.getElementById(id);
const data = JSON.parse(byId('data').textContent), {marks, runs = {}, program, programs = {}} = data;

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
// Lists the visible sections in the bar that stays in sight, and marks the one that is being read.
function listSections() {
  const sections = [...document.querySelectorAll('main > section')].filter(s => !s.hidden);
  const links = new Map(sections.map(s => [s, element('a', {href: `#${s.id}`}, s.querySelector('h2').textContent)]));
  const contents = byId('contents'), bar = byId('bar');
  contents.append(...links.values());
  const isRead = new IntersectionObserver(entries => {
    for (const {target, isIntersecting} of entries) {
      const link = links.get(target);
      if (!isIntersecting) { link.removeAttribute('aria-current'); continue; }
      link.setAttribute('aria-current', 'true');
      contents.scrollLeft = link.offsetLeft - contents.clientWidth / 3;  // on a phone the contents are one line
    }
  }, {rootMargin: '-30% 0px -69.9% 0px'});  // a line at three tenths of the window
  for (const s of sections) isRead.observe(s);
  new ResizeObserver(() => { document.documentElement.style.scrollPaddingTop = `${bar.offsetHeight + 8}px`; }).observe(bar);
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
// How Touchstone is started, so that it knows a candidate.
const programOf = name => programs[name] || program;
const symbolSign = ({colour, symbol}) => shape('svg', {class: 'sign', viewBox: '-8 -8 16 16', 'aria-hidden': 'true'},
    shape('path', {fill: `var(${colour})`, d: symbolPath(symbol, 0, 0, 5.5)}));
const sign = name => symbolSign(markOf(name));
// A candidate that does not run as native code is marked so wherever its name stands.
const runsText = name => runs[name] ? ` (${runs[name]})` : '';
const own = name => name === 'reference' ? ' (Touchstone’s own)' : '';
// What a name stands for in a report, whose candidates its data lists.
function meaningOf(name) {
  const c = data.candidates?.find(c => c.name === name);
  return !c ? '' : c.models ? `${name} models ${c.models}` : `${name} ${c.version}: ${c.settings}`;
}
const named = (name, ...rest) => element('span', {class: 'named'}, sign(name), name + runsText(name), ...rest);

// Outcomes, in the order of legends; each has one colour everywhere, a variable of the style sheet.
const outcomes = ['agree', 'unseen', 'few-points', 'missed', 'phantom', 'shallow', 'overdeep', 'wrong-normal', 'shallow-points', 'overdeep-points',
  'phantom-points', 'off-body', 'no-points', 'not-finite', 'failed', 'crashed', 'timed-out', 'not-asked', 'unsupported'];
const outcomeColour = outcome => `--outcome-${outcome}`;
const isFailure = outcome => !['agree', 'unseen', 'unsupported', 'not-asked'].includes(outcome);
const swatch = outcome => element('span', {class: 'swatch', style: `background:var(${outcomeColour(outcome)})`, 'aria-hidden': 'true'});
const outcomeLegend = names => element('div', {class: 'legend'}, ...names.map(o => element('span', {}, swatch(o), o)));

// Numbers as a person reads them, with two significant digits or as many as asked: 0.012 is 1.2e-2, 620 is 620, 6200 is
// 6.2e3. null: not measured.
function exponent(x, digits = 2) {
  if (x === null) return '–';
  const rounded = Number(x.toPrecision(digits)), size = Math.abs(rounded);
  if (size === 0) return '0';
  if (size < 0.1 || size >= 1000) return x.toExponential(digits - 1).replace('+', '');
  return size >= 10 ** digits ? String(rounded) : x.toPrecision(digits);
}
// A number to be calculated with: all of its digits or as many as asked, with an exponent outside of [1e-3, 1e6).
function plainNumber(x, digits) {
  const size = Math.abs(x);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return x.toExponential(digits && digits - 1).replace('+', '');
  return digits ? x.toPrecision(digits) : String(x);
}
const whole = x => x === null ? '–' : Math.round(x).toLocaleString('en');
// Both round down, so that 1.00 means the whole patch and 100% no failure.
const cutShare = share => share === null ? '–' : (Math.floor(share * 100 + 1e-6) / 100).toFixed(2);
const percent = share => share === 1 ? '100%' : (Math.floor(share * 1000 + 1e-6) / 10).toFixed(1) + '%';
const dashed = pair => pair.replace('-', '–');
const pairWords = pair => pair === 'all' ? 'all pairs' : dashed(pair);
// "box" for "cylinder-box".
const otherShape = pair => pair.replace('cylinder-', '');
// A time in nanoseconds, for people.
const duration = ns => ns === null ? '–' : ns < 999.5 ? `${whole(ns)} ns` : ns < 999500 ? `${exponent(ns / 1e3)} µs` : `${exponent(ns / 1e6)} ms`;

// The number of configurations that a candidate has a routine for.
const supported = r => r.count - (r.outcomes.unsupported || 0);
// The share that agrees. Where a candidate was stopped after time-outs, what it was not asked counts against it: it agrees on
// at least so many.
const unasked = r => r.outcomes['not-asked'] || 0;
const agreeing = r => ((r.outcomes.agree || 0) + (r.outcomes.unseen || 0)) / supported(r);
const agreement = r => (unasked(r) ? '≥ ' : '') + percent(agreeing(r));
// " (5 of 6 pairs)" beside a candidate in a row over all pairs that is over these alone.
function coveredOf(summary, r) {
  if (!r || r.pair !== 'all') return '';
  const ofPairs = summary.filter(s => s.class === r.class && s.candidate === r.candidate && s.pair !== 'all');
  const covered = ofPairs.filter(supported).length;
  return covered === ofPairs.length ? '' : ` (${covered} of ${ofPairs.length} pairs)`;
}

// What few ask for, folded; printed it is open.
const fold = (title, ...children) => element('details', {}, element('summary', {}, title), ...children);
addEventListener('beforeprint', () => { for (const d of document.querySelectorAll('details')) d.open = true; });
// A command with a button that copies it.
function command(text) {
  const copy = element('button', {type: 'button'}, 'Copy');
  copy.addEventListener('click', () => navigator.clipboard.writeText(text).then(
      () => { copy.textContent = 'Copied'; }, () => { copy.textContent = 'Select and copy'; }));
  return element('div', {class: 'command'}, element('code', {}, text), copy);
}
// Calls `act` when an element is clicked, or Enter or the space bar is pressed on it.
function whenPressed(target, act) {
  target.addEventListener('click', act);
  target.addEventListener('keydown', e => {
    if (e.key !== 'Enter' && e.key !== ' ') return;
    e.preventDefault();
    act();
  });
}
// Makes many elements within `host` one tab stop: Tab reaches one of them, at first `first`, and keys lead on to the
// others. `next` gives the neighbour of an element to which a key leads, if there is one.
function rove(host, first, next) {
  let current = first;
  const makeCurrent = item => {
    current.setAttribute('tabindex', -1);
    current = item;
    current.setAttribute('tabindex', 0);
  };
  makeCurrent(first);
  host.addEventListener('focusin', e => { if (e.target.hasAttribute('tabindex')) makeCurrent(e.target); });
  host.addEventListener('keydown', e => {
    const item = e.altKey || e.ctrlKey || e.metaKey ? null : next(current, e.key);
    if (!item) return;
    e.preventDefault();
    makeCurrent(item);
    item.focus();
  });
}
// Makes buttons in a row one tab stop.
function roveButtons(host, buttons) {
  const ways = {ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1, Home: -Infinity, End: Infinity};
  for (const b of buttons) b.setAttribute('tabindex', -1);
  if (buttons.length) rove(host, buttons[0], (b, key) => ways[key] && buttons[Math.max(0, Math.min(buttons.length - 1, buttons.indexOf(b) + ways[key]))]);
}

// What a page is about, chosen at its top: a group of pose classes, for no number over all of them means anything, and, where
// a page offers them, a pair and a candidate. `followers` draw anew what depends on that.
const groupMeanings = {
  everyday: 'sizes within 1:20, turned at random, shallow, resting or apart',
  degenerate: 'exact, near-exact and symmetric',
  extreme: 'extreme proportions, scales, distances and depths',
  recorded: 'as scenes have produced them',
  given: 'your own, from a file',
};
const chosen = {group: null}, choosers = [], followers = [];
function follow(draw) {
  followers.push(draw);
  draw();
}
function choose(change) {
  Object.assign(chosen, change);
  for (const update of [...choosers, ...followers]) update();
}
function offerGroups(groups) {
  const host = byId('groups');
  const buttons = groups.map(g => element('button', {type: 'button', value: g}, g));
  const choice = element('span', {class: 'choice', role: 'toolbar', 'aria-label': 'Poses'}, ...buttons);
  for (const b of buttons) b.addEventListener('click', () => choose({group: b.value}));
  choosers.push(() => { for (const b of buttons) b.setAttribute('aria-pressed', b.value === chosen.group); });
  roveButtons(choice, buttons);
  host.hidden = groups.length === 0;
  host.append(element('span', {class: 'wide'}, 'Poses: '), choice);
  choose({group: groups[0] ?? null});
}
// A select box of [value, text] beside the groups; with one value there is nothing to choose.
function offer(what, label, values, first = values[0]?.[0]) {
  const list = element('select', {id: what, 'aria-label': label}, ...options(values));
  list.addEventListener('change', () => choose({[what]: list.value}));
  choosers.push(() => { list.value = chosen[what]; });
  if (values.length > 1) byId('groups').append(element('label', {}, element('span', {class: 'wide'}, `${label}: `), list));
  choose({[what]: first});
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
  target.classList.add('explained');
  for (const start of ['mouseenter', 'focusin']) target.addEventListener(start, show);
  for (const end of ['mouseleave', 'focusout']) target.addEventListener(end, hideTip);
}
// All pairs together, where there are several, and each alone.
function offerPairs(pairs) {
  const offered = pairs.length > 1 ? ['all', ...pairs] : pairs;
  offer('pair', 'Pair', offered.map(p => [p, pairWords(p)]));
  return offered;
}
// Goes to a section, whose title takes the keyboard there.
function goTo(id) {
  const title = byId(id).querySelector('h2');
  title.scrollIntoView();
  title.focus();
}
