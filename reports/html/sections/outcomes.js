// What became of every configuration.
const outcomeColours = {agree: 'var(--good)', missed: 'var(--c1)', phantom: 'var(--c3)', shallow: 'var(--c4)',
  overdeep: 'var(--c6)', 'wrong-normal': 'var(--c0)', 'shallow-points': 'var(--c8)', 'overdeep-points': 'var(--c9)',
  'phantom-points': 'var(--c10)', 'not-finite': 'var(--ink)', failed: 'var(--c7)', crashed: 'var(--c2)', 'timed-out': 'var(--c5)',
  unsupported: 'var(--line)'};
function outcomeBars() {
  const pair = byId('outcome-pair').value, seen = Object.keys(outcomeColours).filter(o => report.summary.some(r => r.outcomes[o]));
  const legend = element('div', {class: 'legend'}, ...seen.map(o => element('span', {},
      element('span', {class: 'swatch', style: `background:${outcomeColours[o]}`, 'aria-hidden': 'true'}), o)));
  const rows = report.summary.filter(r => r.pair === pair && supported(r)).map(r => {
    const bar = element('div', {class: 'bar', role: 'img', 'aria-label': outcomesText(r)});
    for (const o of seen) {
      const n = r.outcomes[o] || 0;
      if (n === 0) continue;
      const part = element('div', {style: `width:${100 * n / r.count}%;background:${outcomeColours[o]}`});
      explain(part, `${r.candidate}, ${dashed(r.pair)}\n${o}: ${whole(n)} of ${whole(r.count)}`);
      bar.append(part);
    }
    return element('div', {class: 'outcome-row'}, named(r.candidate), bar);
  });
  byId('outcome-bars').replaceChildren(legend, ...rows);
}
choices('outcome-pair', summaryPairs, outcomeBars);
outcomeBars();
