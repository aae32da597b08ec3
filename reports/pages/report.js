// The report's data, what all sections ask of it, and the findings.
const report = data;
const candidates = report.candidates.map(c => c.name);
showUsual(candidates);
const pairs = [...new Set(report.classes.map(c => c.pair))];
// What is shown is of the group of pose classes that is chosen at the top of the page.
const classGroup = new Map(report.classes.map(c => [`${c.pair}/${c.class}`, c.group]));
groupControl(byId('groups'), [...new Set(report.summary.map(r => r.class))]);
const inGroup = r => classGroup.get(`${r.pair}/${r.class}`) === group;
const summary = () => report.summary.filter(r => r.class === group);
const summaryOf = (pair, candidate) => summary().find(r => r.pair === pair && r.candidate === candidate);
const classesOf = pair => report.classes.filter(c => c.pair === pair && c.group === group);
const coveredText = r => coveredOf(report.summary, r);
// "box" for "cylinder-box".
const otherShape = pair => pair.replace('cylinder-', '');

// null stands for what was not measured.
const quantile = (q, which) => q === null ? null : q[which];
const time = r => r.nanoseconds === null ? null : r.nanoseconds.median;
const tail = r => r.nanoseconds === null ? null : r.nanoseconds.p95;
const hasSlowTail = r => tail(r) !== null && tail(r) > 4 * time(r);  // as in timing.hpp
// Where a candidate was stopped after time-outs, what it was not asked counts against it: it agrees on at least so many.
const unasked = r => r.outcomes['not-asked'] || 0;
const agreeing = r => ((r.outcomes.agree || 0) + (r.outcomes.unseen || 0)) / supported(r);
const agreement = r => (unasked(r) ? '≥ ' : '') + percent(agreeing(r));
const withoutAnswer = ['not-finite', 'failed', 'crashed', 'timed-out'];
const lost = r => withoutAnswer.reduce((sum, o) => sum + (r.outcomes[o] || 0), 0);
const vector = v => v === null ? '–' : `(${v.map(c => c === null ? 'nan' : plainNumber(c, 6)).join(', ')})`;
// The pose classes of any group in which a candidate disagrees.
const isFailing = r => supported(r) > 0 && agreeing(r) < 1;
const failingOf = candidate => report.results.filter(r => r.candidate === candidate && isFailing(r));
const outcomesText = r => Object.entries(r.outcomes).map(([name, n]) => `${name} ${n}`).join(', ') +
    (unasked(r) ? `\n${whole(r.outcomes['timed-out'])} time-outs; ${whole(supported(r) - unasked(r))} of ${whole(supported(r))} asked` : '');

// Fills a select box of the page and listens to it.
function choices(id, values, change, selected) {
  byId(id).append(...options(values));
  if (selected !== undefined) byId(id).value = selected;
  byId(id).addEventListener('change', change);
}
// The level of a heated cell: pale at 1e-10 and below, full at 1 and above.
const decade = v => v <= 0 ? 0 : (Math.log10(v) + 10) / 10;

// The findings answer what most readers ask first.
function findings() {
  if (report.partial) {
    byId('partial').hidden = false;
    byId('partial').textContent = `Partial: interrupted when ${report.completed.classes} of ` +
        `${report.planned.classes} pose classes were scored and ${report.completed.timed_classes} timed.`;
  }
  const routines = candidates.filter(name => report.summary.some(r => r.candidate === name && supported(r)));
  const isOne = routines.length === 1, right = routines.filter(name => failingOf(name).length === 0).length;
  byId('headline').textContent = `${whole(report.configurations)} configurations of ${pairs.length} ` +
      `${pairs.length === 1 ? 'pair' : 'pairs'} of shapes, ${routines.length} contact ${isOne ? 'routine' : 'routines'}, ` +
      `each answer held against a truth certified to 1e-30 of the larger size. ` +
      (isOne ? right ? 'It agrees in every pose class.' : `It disagrees in ${failingOf(routines[0]).length} of ${report.results.filter(supported).length} pose classes.`
             : `${right} of them ${right === 1 ? 'agrees' : 'agree'} in every pose class.`);
  byId('provenance').append(`Touchstone ${report.version}, seed ${report.seed}, ${report.machine.cpu}.`);
  choices('finding-candidate', candidates, failuresOf, candidates.find(c => c !== 'reference'));
  keepGrouped(() => {
    const here = pairs.filter(pair => summary().some(r => r.pair === pair));
    byId('finding-accuracy').replaceChildren(...here.map(pair => element('li', {}, ...accuracyOf(pair))));
    byId('finding-cost').replaceChildren(...here.map(pair => element('li', {}, ...costOf(pair))));
    failuresOf();
  });
  contrastsFound();
}

// Candidates by agreement, then by worst error; of those that are right but for rounding the faster one.
function ranked(pair) {
  const rounding = 1e-12;
  const worst = r => r.severity === null ? Infinity : Math.max(r.severity.max, rounding);
  const slow = r => time(r) === null ? Infinity : time(r);
  return summary().filter(r => r.pair === pair && supported(r))
      .sort((a, b) => agreeing(b) - agreeing(a) || worst(a) - worst(b) || slow(a) - slow(b));
}
// What is right here may fail in another group of poses.
const brief = r => {
  const others = failingOf(r.candidate).filter(f => f.pair === r.pair && !inGroup(f)).length;
  return `agrees on ${agreement(r)}, worst error ${exponent(quantile(r.severity, 'max'))}` +
      (agreeing(r) === 1 && others ? `; elsewhere ${others} pose ${others === 1 ? 'class fails' : 'classes fail'}` : '');
};
function link(text, act) {
  const button = element('button', {type: 'button', class: 'link'}, text);
  button.addEventListener('click', act);
  return button;
}

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
  const against = (words, r) => [`; ${words}, `, named(r.candidate), `, ${whole(time(r))} ns (${exponent(time(r) / time(first))} times that, ` +
      `agrees on ${agreement(r)})`];
  return [element('b', {}, dashed(pair)), ': ', named(first.candidate), ` takes ${whole(time(first))} ns`,
          tail(first) === null ? '' : `, 95% of the queries in each pose class at most ${whole(tail(first))} ns`,
          ...(second ? against('the next most accurate', second) : []),
          ...(asFast(first) ? ['; none is faster'] : second && asFast(second) ? ['; none is faster than that'] : against('the fastest', fastest)), '.'];
}

function failuresOf() {
  const candidate = byId('finding-candidate').value;
  const failing = failingOf(candidate).filter(inGroup)
      .sort((a, b) => agreeing(a) - agreeing(b) || quantile(b.severity, 'max') - quantile(a.severity, 'max'));
  byId('finding-failures').replaceChildren(...(failing.length === 0
      ? [element('li', {}, `${candidate} agrees with the truth on every ${group} configuration that it has a routine for.`)]
      : pairs.map(pair => {
        const here = failing.filter(r => r.pair === pair);
        if (here.length === 0) return null;
        const main = r => Object.entries(r.outcomes).filter(([o]) => isFailure(o)).sort((a, b) => b[1] - a[1])[0][0];
        return element('li', {}, element('b', {}, dashed(pair)), `: disagrees in ${here.length} of ${classesOf(pair).length} ${group} pose classes, most in `,
            ...here.slice(0, 3).flatMap((r, i) => [i ? ', ' : '', `${r.class} (${unasked(r) ? '≤ ' : ''}${percent(1 - agreeing(r))}, ${main(r)})`]),
            '. ', link('See its worst cases', () => showWorst(pair, candidate)));
      }).filter(Boolean)), ...failuresElsewhere(candidate), ...slowTailsOf(candidate));
}

// How many pose classes of the other groups fail, each a link to its group.
function failuresElsewhere(candidate) {
  const groupOf = r => classGroup.get(`${r.pair}/${r.class}`), count = (rows, g) => rows.filter(r => groupOf(r) === g).length;
  const all = report.results.filter(r => r.candidate === candidate && supported(r)), failing = failingOf(candidate);
  const others = Object.keys(groupMeanings).filter(g => g !== group && count(failing, g) > 0);
  if (others.length === 0) return [];
  return [element('li', {}, element('b', {}, 'elsewhere'), ': disagrees in ', ...others.flatMap((g, i) => [i ? ', ' : '',
      link(`${count(failing, g)} of ${count(all, g)} ${g} pose classes`, () => showGroup(g))]), '.')];
}

// The pose classes in which 5% of a candidate's queries take more than four medians.
function slowTailsOf(candidate) {
  const timed = report.results.filter(r => r.candidate === candidate && inGroup(r) && tail(r) !== null);
  const slow = timed.filter(hasSlowTail).sort((a, b) => tail(b) - tail(a));
  if (slow.length === 0) return [];
  return [element('li', {}, element('b', {}, 'slow tails'), `: in ${slow.length} of ${timed.length} ${group} pose classes 5% of the queries take more than four medians, most in `,
      ...slow.slice(0, 3).flatMap((r, i) => [i ? ', ' : '', `${r.pair}/${r.class} (median ${whole(time(r))} ns, p95 ${whole(tail(r))} ns)`]), '.')];
}

// What a command's own measurement of its time is worth.
const floorText = ({nanoseconds: t}) => t && t.floor !== null ? `\nof bodies far apart ${whole(t.floor)} ns: what its binding costs; ` +
    `by our clock ${t.our_clock.toFixed(2)} times, processor time ${t.processor.toFixed(2)} times what it says` : '';

// What candidates pass as it is and fail with one modifier (factors.hpp).
const agreed = rate => 1 - rate.failed / rate.count;
const wholePercent = share => `${Math.floor(100 * share + 1e-9)}%`;
const isGiven = name => report.candidates.some(c => c.name === name && c.given);  // its answers came in a file
const replayOf = (id, candidate) => `${programOf(candidate)} replay ${id}` + (isGiven(candidate) ? '' : ` --candidates ${candidate}`);
// Every moving body is turned, so that all everyday arrangements that fail turned are shown, as far as there is room; of
// others the worst, where few of those fail. The table "Exact against turned" has all.
function contrastsFound() {
  const maxOfEach = 12, enough = 3, drop = c => agreed(c.plain) - agreed(c.modified);
  const rarity = c => c.modifier !== 'turned' ? 2 : classGroup.get(`${c.pair}/${c.arrangement}+turned`) === 'everyday' ? 0 : 1;
  const items = candidates.flatMap(name => {
    const failing = report.contrasts.filter(c => c.candidate === name && c.fails).sort((a, b) => rarity(a) - rarity(b) || drop(b) - drop(a));
    if (failing.length === 0) return [];
    const shownOnes = failing.filter((c, i) => i < enough || i < maxOfEach && rarity(c) === 0), left = failing.length - shownOnes.length;
    return [element('li', {}, named(name), element('ul', {}, ...shownOnes.map(c => element('li', {},
            `${dashed(c.pair)}, ${c.plain_class}: agrees in ${wholePercent(agreed(c.plain))}, ${c.modifier} in ${wholePercent(agreed(c.modified))}. `,
            element('code', {}, replayOf(c.worst, name)))),
        left ? element('li', {class: 'quiet'}, `and ${left} more, `, element('a', {href: '#contrasts'}, 'in the table')) : null))];
  });
  byId('finding-contrasts-part').hidden = items.length === 0;
  byId('finding-contrasts').append(...items);
}
findings();
