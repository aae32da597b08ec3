// The worst error of every candidate on every pair, and once more by Drake's protocol.
const perPair = first => [column(first, {class: 'text'}), ...pairs.map(p => column(otherShape(p)))];

function worstErrors() {
  const rows = candidates.map(name => element('tr', {}, element('th', {scope: 'row'}, named(name)),
      ...pairs.map(pair => worstErrorCell(summaryOf(pair, name)))));
  byId('worst-error-table').append(table('Cylinder against …: worst error, in sizes', perPair('candidate'), rows));
}
function worstErrorCell(r) {
  if (!r || supported(r) === 0) return element('td', {class: 'quiet'}, '–');
  const worst = quantile(r.severity, 'max'), cell = element('td', {class: 'heat', tabindex: 0, style: heated(Math.max(0, 1 + Math.log10(worst) / 16))},
      exponent(worst), r.outcomes.missed || lost(r) ? element('small', {}, `${whole((r.outcomes.missed || 0) + lost(r))} lost`) : null);
  explain(cell, `${r.candidate}, ${dashed(r.pair)}\n${outcomesText(r)}\nworst error ${exponent(worst)}, 99th percentile ` +
      `${exponent(quantile(r.severity, 'p99'))}\nClick for its worst cases`);
  whenPressed(cell, () => showWorst(r.pair, r.candidate));
  return cell;
}

const millimetres = metres => metres === null ? 'refuses' : `${exponent(1000 * metres)}`;
function drakeProtocol() {
  const protocol = report.drake_protocol;
  if (!protocol) return byId('drake-table').append('Not measured: the run was interrupted.');
  const published = query => element('tr', {class: 'published'}, element('th', {scope: 'row'}, `Drake, ${query === 'penetration' ? 'point pair' : 'signed distance'}`),
      ...protocol.pairs.map(p => element('td', {}, millimetres(p.published[query]))));
  const rows = candidates.map(name => element('tr', {}, element('th', {scope: 'row'}, named(name)),
      ...protocol.pairs.map(p => drakeCell(p, protocol.results.find(r => r.pair === p.pair && r.candidate === name)))));
  byId('drake-table').append(table('Cylinder against …: worst error, millimetres', perPair('query'),
      [published('penetration'), published('signed_distance'), ...rows]));
}
function drakeCell(pair, r) {
  if (supported(r) === 0) return element('td', {class: 'quiet'}, '–');
  const missed = r.outcomes.missed || 0, cell = element('td', {class: 'heat', tabindex: 0,
      style: heated(r.max_error === null ? 1 : decade(1e3 * r.max_error))}, r.max_error === null ? '–' : millimetres(r.max_error),
      missed || lost(r) ? element('small', {}, `${missed + lost(r)} lost`) : null);
  const worst = r.worst === null ? null : pair.configurations[r.worst];
  explain(cell, `${r.candidate}, ${dashed(r.pair)}, ${r.count} poses\n${outcomesText(r)}` + (worst ? `\nworst: ${worst.description}\nClick for the command` : ''));
  if (worst) {
    whenPressed(cell, () => byId('drake-command').replaceChildren(
        element('p', {}, `${r.candidate}, ${worst.description}:`),
        command(`echo '${JSON.stringify(worst.configuration)}' | ./touchstone replay - --candidates ${r.candidate}`)));
  }
  return cell;
}
worstErrors();
drakeProtocol();
