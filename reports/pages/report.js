// The report's data, and what all sections ask of it.
const report = unpackReport(data);

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
// What most readers ask first, answered from the data.
function findings() {
  if (report.partial) {
    byId('partial').hidden = false;
    byId('partial').textContent = `Partial: interrupted when ${report.completed.classes} of ` +
        `${report.planned.classes} pose classes were scored and ${report.completed.timed_classes} timed.`;
  }
  const all = report.summary.filter(r => r.pair === 'all'), rows = (all.length ? all : report.summary).filter(supported);
  byId('headline').textContent = `${whole(report.configurations)} configurations of ${pairs.length} ` +
      `${pairs.length === 1 ? 'pair' : 'pairs'} of shapes, ${new Set(rows.map(r => r.candidate)).size} contact routines, ` +
      `each answer held against a truth certified to 1e-30 of the larger size.`;
  byId('provenance').append(`Touchstone ${report.version}, seed ${report.seed}, ${report.machine.cpu}.`);
  byId('finding-accuracy').append(...pairs.map(pair => element('li', {}, ...accuracyOf(pair))));
  byId('finding-cost').append(...pairs.map(pair => element('li', {}, ...costOf(pair))));
  choices('finding-candidate', candidates, failuresOf, candidates.find(c => c !== 'reference'));
  failuresOf();
}

// First those that answer everything, then by agreement, then by the worst error.
function ranked(pair) {
  const worst = r => r.severity === null ? Infinity : r.severity.max;
  return report.summary.filter(r => r.pair === pair && supported(r))
      .sort((a, b) => agreeing(b) - agreeing(a) || worst(a) - worst(b));
}
const brief = r => `agrees on ${percent(agreeing(r))}, worst error ${exponent(quantile(r.severity, 'max'))}`;
const link = (text, act) => {
  const button = element('button', {type: 'button', class: 'link'}, text);
  button.addEventListener('click', act);
  return button;
};

function accuracyOf(pair) {
  const [first, second] = ranked(pair);
  if (!first) return [element('b', {}, dashed(pair)), ': no candidate has a routine for it.'];
  return [element('b', {}, dashed(pair)), ': ', named(first.candidate), ` (${brief(first)})`,
          ...(second ? ['; next ', named(second.candidate), ` (${brief(second)})`] : []), '.'];
}

function costOf(pair) {
  const timed = ranked(pair).filter(r => time(r) !== null), [first, second] = timed;
  if (!first) return [element('b', {}, dashed(pair)), ': not timed.'];
  const fastest = [...timed].sort((a, b) => time(a) - time(b))[0];
  const asFast = r => r === fastest || fastest.tied_with.includes(r.candidate);  // within the spreads
  const against = (words, r) => [`; ${words}, `, named(r.candidate), `, ${whole(time(r))} ns (${(time(r) / time(first)).toPrecision(2)} times that, ` +
      `agrees on ${percent(agreeing(r))})`];
  return [element('b', {}, dashed(pair)), ': ', named(first.candidate), ` takes ${whole(time(first))} ns`,
          ...(second ? against('the next most accurate', second) : []),
          ...(asFast(first) ? ['; none is faster'] : second && asFast(second) ? ['; none is faster than that'] : against('the fastest', fastest)), '.'];
}

function failuresOf() {
  const candidate = byId('finding-candidate').value;
  const failing = report.results.filter(r => r.candidate === candidate && supported(r) && agreeing(r) < 1)
      .sort((a, b) => agreeing(a) - agreeing(b) || quantile(b.severity, 'max') - quantile(a.severity, 'max'));
  const classes = pair => report.classes.filter(c => c.pair === pair).length;
  byId('finding-failures').replaceChildren(...(failing.length === 0
      ? [element('li', {}, `${candidate} agrees with the truth on every configuration that it has a routine for.`)]
      : pairs.map(pair => {
        const here = failing.filter(r => r.pair === pair);
        if (here.length === 0) return null;
        const main = r => Object.entries(r.outcomes).filter(([o]) => o !== 'agree').sort((a, b) => b[1] - a[1])[0][0];
        return element('li', {}, element('b', {}, dashed(pair)), `: disagrees in ${here.length} of ${classes(pair)} pose classes, most in `,
            ...here.slice(0, 3).flatMap((r, i) => [i ? ', ' : '', `${r.class} (${percent(1 - agreeing(r))}, ${main(r)})`]),
            '. ', link('See its worst cases', () => showWorst(pair, candidate)));
      }).filter(Boolean)));
}
findings();
