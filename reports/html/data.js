// The report's data, and what all sections ask of it.
const report = unpackReport(JSON.parse(byId('data').textContent)), {marks} = report;

// Lists of like objects come as a schema and rows of their values (page_data.cpp).
function unpackReport(packed) {
  const unpack = (cell, schema) => {
    if (schema === 'string') return packed.strings[cell];
    if (schema === null || cell === null) return cell;
    return Object.fromEntries(Object.keys(schema).map((key, i) => [key, unpack(cell[i], schema[key])]));
  };
  return Object.fromEntries(Object.entries(packed).map(([key, value]) =>
      [key, value !== null && value.rows ? value.rows.map(row => unpack(row, value.schema)) : value]));
}

const candidates = report.candidates.map(c => c.name);
const pairs = [...new Set(report.results.map(r => r.pair))];
const colour = name => `var(${markOf(name).colour})`;
const summaryOf = (pair, candidate) => report.summary.find(r => r.pair === pair && r.candidate === candidate);
// "cylinder-box" among its like.
const otherShape = pair => pair.replace('cylinder-', '');
const dashed = pair => pair.replace('-', '–');

// null: not measured.
const whole = x => x === null ? '–' : Math.round(x).toLocaleString('en');
const quantile = (q, which) => q === null ? null : q[which];
const time = r => r.nanoseconds === null ? null : r.nanoseconds.median;
// Of what a candidate has a routine for.
const supported = r => r.count - (r.outcomes.unsupported || 0);
const agreeing = r => (r.outcomes.agree || 0) / supported(r);
const lost = r => ['not-finite', 'failed', 'crashed', 'timed-out'].reduce((sum, o) => sum + (r.outcomes[o] || 0), 0);
// Cut downwards: only a candidate without a failure shows 100%.
const percent = share => share === 1 ? '100%' : (Math.floor(share * 1000 + 1e-6) / 10).toFixed(1) + '%';
const vector = v => v === null ? '–' : `(${v.map(c => c === null ? 'nan' : c.toPrecision(6)).join(', ')})`;
const outcomesText = r => Object.entries(r.outcomes).map(([name, n]) => `${name} ${n}`).join(', ');

// A candidate's mark and name.
function sign(name) {
  const mark = markOf(name), svg = shape('svg', {class: 'sign', viewBox: '-8 -8 16 16', 'aria-hidden': 'true'});
  svg.append(shape('path', {fill: `var(${mark.colour})`, d: symbolPath(mark.symbol, 0, 0, 5.5)}));
  return svg;
}
const named = (name, ...rest) => element('span', {class: 'named'}, sign(name), name, ...rest);

// Tables, select boxes, cells to press and commands to copy.
const column = (text, attributes = {}) => element('th', {scope: 'col', ...attributes}, text);
const table = (caption, heads, rows) => element('table', {}, element('caption', {}, caption),
    element('thead', {}, element('tr', {}, ...heads)), element('tbody', {}, ...rows));
function choices(id, values, change, selected) {
  byId(id).append(...values.map(v => element('option', {value: v}, v)));
  if (selected !== undefined) byId(id).value = selected;
  byId(id).addEventListener('change', change);
}
// By pointer or keyboard.
function whenPressed(target, act) {
  target.addEventListener('click', act);
  target.addEventListener('keydown', e => { if (e.key === 'Enter') act(); });
}
function command(text) {
  const copy = element('button', {type: 'button'}, 'Copy');
  copy.addEventListener('click', () => navigator.clipboard.writeText(text).then(
      () => { copy.textContent = 'Copied'; }, () => { copy.textContent = 'Select and copy'; }));
  return element('div', {class: 'command'}, element('code', {}, text), copy);
}

// 1e-10 and less is pale, 1 and more is full.
const decade = v => v <= 0 ? 0 : Math.min(1, Math.max(0, (Math.log10(v) + 10) / 10));
const heated = level => `background: color-mix(in srgb, var(--bad) ${Math.round(70 * level)}%, transparent)`;
