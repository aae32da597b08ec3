// Where the candidate that is chosen fails: its worst pose classes, its worst cases with both bodies in 3-D, what it passes as it
// is and fails when turned, what raises its failure rate.
const disagreement = r => `${unasked(r) ? '≤ ' : ''}${percent(1 - agreeing(r))}`;
const classWords = name => name.split('+').flatMap((part, i) => i ? [element('wbr'), `+${part}`] : [part]);
const maxClasses = 8;

function failures() {
  const {candidate, pair, group} = chosen, here = report.results.filter(r => r.candidate === candidate && ofPair(r) && inGroup(r) && supported(r));
  const failing = here.filter(isFailing)
      .sort((a, b) => agreeing(a) - agreeing(b) || quantile(b.severity, 'max') - quantile(a.severity, 'max'));
  const others = otherGroups().map(g => [g, countsOf(chosen, g)]).filter(([, {fail}]) => fail);
  byId('failure-words').replaceChildren(named(candidate, own(candidate)), `, ${pairWords(pair)}, ${group} poses: `,
      here.length === 0 ? 'it has no routine for them.' : failing.length ? `disagrees in ${failing.length} of ${here.length} pose classes.`
          : `agrees with the truth on every configuration of ${here.length} pose classes.`,
      ...(others.length ? [' Elsewhere: ', ...others.flatMap(([g, {fail, of}], i) => [i ? ', ' : '', link(`${fail} of ${of} ${g} classes`, () => choose({group: g}))]),
                           others.length === 1 && others[0][1].fail === 1 ? ' fails.' : ' fail.'] : []), slowTails(here));
  const main = r => Object.entries(r.outcomes).filter(([o]) => isFailure(o)).sort((a, b) => b[1] - a[1])[0][0];
  const rows = failing.slice(0, maxClasses).map(r => {
    const row = element('tr', {}, rowHead(...(pair === 'all' ? [`${otherShape(r.pair)}/`] : []), ...classWords(r.class)), element('td', {}, disagreement(r)),
        outcomeCell(main(r)), element('td', {}, exponent(quantile(r.severity, 'max'))),
        element('td', {class: 'text wrap wide'}, report.classes.find(c => c.pair === r.pair && c.class === r.class).description));
    const worst = r.worst_index === null ? null : `${r.pair}/${r.class}/${report.seed}/${r.worst_index}`;  // null: the answers came in a file
    explain(row, outcomesText(r) + (worst ? '\nClick for the command that shows the worst of them' : ''));
    if (worst) replaysWhenPressed(row, worst, candidate, 'failure-command');
    return row;
  });
  byId('failure-command').replaceChildren(failing.length > maxClasses ? element('p', {class: 'quiet'}, `And ${failing.length - maxClasses} more, in `,
      element('a', {href: '#classes'}, 'Pose classes'), '.') : '');
  byId('failure-table').replaceChildren(rows.length ? table([textColumn('worst pose classes'), 'disagrees', textColumn('mostly'), 'worst error',
      column('what they are', {class: 'text wide'})], rows) : '');
}
function link(text, act) {
  const button = element('button', {type: 'button', class: 'link'}, text);
  button.addEventListener('click', act);
  return button;
}
// The pose classes in which 5% of the queries take more than four medians.
function slowTails(rows) {
  const timed = rows.filter(r => tail(r) !== null), slow = timed.filter(r => r.has_slow_tail).sort((a, b) => tail(b) - tail(a)), [most] = slow;
  return most ? ` Slow tails: in ${slow.length} of ${timed.length} classes 5% of the queries take more than four medians, most in ` +
      `${most.pair}/${most.class} (median ${duration(time(most))}, p95 ${duration(tail(most))}).` : '';
}
follow(failures);

// The worst cases, each with both bodies.
const atOnce = 2;
let galleryCount = atOnce;
function gallery() {
  const cases = report.worst.filter(w => w.group === chosen.group && ofPair(w) && w.candidate === chosen.candidate);
  const rank = w => !isFailure(w.outcome) ? 2 : withoutAnswer.includes(w.outcome) ? 0 : 1;  // as is_worse in tally.hpp
  cases.sort((a, b) => rank(a) - rank(b) || b.severity - a.severity);
  undrawn = [];
  const more = element('button', {type: 'button'}, `Show ${cases.length - galleryCount} more`);
  more.addEventListener('click', () => { galleryCount = Infinity; gallery(); });
  byId('worst-cases').replaceChildren(...cases.slice(0, galleryCount).map(worstCase), ...(cases.length > galleryCount ? [more] : []));
}
const metres = d => plainNumber(d, 7);
function worstCase(w) {
  const rows = Object.entries(w.answers).map(([name, a]) => [rowHead(named(name)),
      outcomeCell(a.score.outcome),
      a.signed_distance === null ? a.status : metres(a.signed_distance), exponent(a.score.depth_error),
      exponent(a.score.normal_regret), exponent(a.score.normal_angle), String(a.points.length), cutShare(a.score.coverage)]);
  const wide = text => column(text, {class: 'wide'});
  const heads = [textColumn('candidate'), textColumn('outcome'), 'signed distance', 'error', wide('regret'), wide('angle, °'), wide('points'), wide('coverage')];
  const reasons = Object.entries(w.answers).filter(([, a]) => a.reason);
  return element('article', {},
      element('h3', {}, named(w.candidate), ': ', swatch(w.outcome), w.outcome, element('span', {class: 'quiet'}, ` ${dashed(w.pair)}, ${w.class}`)),
      element('div', {class: 'case'}, caseView(w), element('div', {},
          element('p', {}, `True signed distance ${metres(Number(w.truth.signed_distance[0]))} m, ` +
              (w.truth.ties === 'unique' ? 'one optimal normal: ' : `optimal normals (${w.truth.ties}): `) +
              w.truth.normals.slice(0, 2).map((n, i) => `${vector(n)}, contact patch a ${w.truth.patch[i].kind}`).join('; ') +
              (w.truth.normals.length > 2 ? '; …' : '.')),
          element('div', {class: 'scroll'}, table(heads, rows)),
          ...reasons.map(([name, a]) => element('p', {class: 'quiet'}, `${name}: ${a.reason}`)),
          element('p', {class: 'quiet'}, 'See it again, in numbers; with --html page.html also enlarged and in section:'),
          command(w.replay),
          ...(isGiven(w.candidate) || !isFailure(w.outcome) ? [] : [
            element('p', {class: 'quiet'}, 'A program for its maintainers that shows this alone:'),
            command(`${w.replay} --emit ${w.candidate}`)]),
          fold('Configuration', element('pre', {}, JSON.stringify(w.configuration))))));
}

// A case is drawn when it comes into sight or is printed. A cast has a slider, at first where A touches.
let undrawn = [];
addEventListener('beforeprint', () => { for (const draw of undrawn) draw(); });
function caseView(w) {
  const canvas = element('canvas', {tabindex: 0, role: 'img', 'aria-label': `Both bodies of ${w.id} with the contact points of the truth and the answers`});
  const draw = () => {
    inSight.disconnect();
    undrawn = undrawn.filter(other => other !== draw);
    const view = makeView(canvas);
    let scene;
    const place = (configuration, marked = true) => {
      scene = makeScene(configuration, w.truth, 0, w.faces);
      scene.marks = marked ? marksOf(scene, w.truth, Object.entries(w.answers ?? {})) : [];
    };
    const {sweep} = w.configuration, start = w.touch ?? w.fraction ?? 0, moveTo = t => place(sweptTo(w.configuration, t), w.touch !== null);
    if (sweep) moveTo(start); else place(w.configuration);
    aimView(view, scene.normal, scene.across);
    const thin = closeUp(view, scene), views = [['Whole bodies', () => fitView(view, mainBodies(scene))],
      ['Contact', () => fitView(view, [], scene.reaches.contact)], ...(thin ? [['Thin body', () => fitView(view, [], thin.reach, thin.about)]] : [])];
    let at = thin ? 2 : 0;
    views[at][1]();
    const redraw = () => drawContact(view, scene);
    if (sweep) {
      const stops = [...(w.touch === null ? [] : [['truth', w.touch]]), ...(w.fraction === null ? [] : [[w.outcome === 'missed' ? `${w.candidate}: never` : w.candidate, w.fraction]])];
      figure.append(sweepControl(start, stops, t => { moveTo(t); redraw(); }));
    }
    steerView(view, redraw);
    onThemeChange(redraw);
    redraw();
    const offerNext = () => { other.textContent = views[(at + 1) % views.length][0]; };
    offerNext();
    other.addEventListener('click', () => {
      at = (at + 1) % views.length;
      views[at][1]();
      offerNext();
      redraw();
    });
  };
  const inSight = new IntersectionObserver(entries => { if (entries.some(e => e.isIntersecting)) draw(); }, {rootMargin: '200px'});
  inSight.observe(canvas);
  undrawn.push(draw);
  const other = element('button', {type: 'button'}, 'Contact');
  const figure = element('figure', {}, canvas, element('p', {class: 'controls quiet'}, other, element('span', {class: 'body-a'}, 'cylinder A'),
      element('span', {class: 'body-b'}, nameOfB(w.configuration.b)), element('span', {}, '◆ truth; drag to turn')));
  return figure;
}
follow(() => {
  galleryCount = atOnce;
  gallery();
});

// Every arrangement alone against the same one turned or tilted: on one pair all, on all pairs those that a candidate fails.
const agreed = rate => 1 - rate.failed / rate.count;
function contrastTable() {
  const isTurned = byId('contrast-modifier').value === 'turned', nameOf = c => (chosen.pair === 'all' ? `${otherShape(c.pair)}/` : '') + c.arrangement;
  const entries = report.contrasts.filter(c => ofPair(c) && (c.modifier === 'turned') === isTurned);
  const at = new Map(entries.map(c => [`${nameOf(c)}/${c.candidate}`, c])), here = candidates.filter(name => entries.some(c => c.candidate === name));
  const arrangements = [...new Set(entries.filter(c => chosen.pair !== 'all' || c.fails).map(nameOf))];
  const failing = report.contrasts.filter(c => ofPair(c) && c.candidate === chosen.candidate && c.fails).length;
  byId('contrast-count').textContent = `${chosen.candidate}: ${failing || 'nothing'}`;
  byId('contrast-command').replaceChildren();
  const rows = arrangements.map(a => [rowHead(a), ...here.map(name => contrastCell(at.get(`${a}/${name}`)))]);
  byId('contrast-table').replaceChildren(rows.length === 0 ? 'Nothing of which both was asked.' : table(
      [textColumn('arrangement'), ...here.map(name => column(named(name), {class: 'slanted'}))], rows,
      `${pairWords(chosen.pair)}: agreement alone, ${isTurned ? 'turned' : 'tilted'}, in percent`));
}
function contrastCell(c) {
  if (!c) return notAvailable();
  const alone = agreed(c.plain), modified = agreed(c.modified), cell = element('td', {class: 'heat', 'data-value': modified - alone, style: heated(Math.max(0, alone - modified))},
      element('span', c.fails ? {class: 'strong'} : {}, `${Math.floor(100 * alone)} → ${Math.floor(100 * modified)}`));
  explain(cell, `${c.candidate}, ${dashed(c.pair)}, ${c.arrangement}\nalone: agrees on ${percent(alone)} of ${whole(c.plain.count)}\n` +
      `${c.modifier}: on ${percent(modified)} of ${whole(c.modified.count)}\nchance of as many failures there by accident: ${exponent(c.chance)}` +
      (c.worst ? '\nClick for the worst failure' : ''));
  if (c.worst) replaysWhenPressed(cell, c.worst, c.candidate, 'contrast-command');
  return cell;
}
byId('contrast-modifier').addEventListener('change', contrastTable);
byId('contrasts').hidden = report.contrasts.length === 0;
follow(contrastTable);

// What raises a candidate's failure rate most (factors.hpp).
function factorTable() {
  const {candidate, group} = chosen, entries = report.factors.filter(f => f.candidate === candidate && f.group === group && ofPair(f));
  byId('factor-command').replaceChildren();
  const rows = entries.map(f => {
    const row = element('tr', {}, rowHead(dashed(f.pair)), element('td', {class: 'text'}, f.name),
        element('td', {}, percent(f.with.failed / f.with.count)), element('td', {}, percent(f.without)), element('td', {class: 'text wide'}, f.kind));
    explain(row, `${f.kind} ${f.name}: ${whole(f.with.failed)} of ${whole(f.with.count)} fail\nworst: ${f.worst}\nClick for the command`);
    replaysWhenPressed(row, f.worst, candidate, 'factor-command');
    return row;
  });
  byId('factor-table').replaceChildren(rows.length === 0 ? `Nothing raises the failure rate of ${candidate} beyond chance in ${group} poses.` : table(
      [textColumn('pair'), textColumn('what'), 'fails with it', 'without', column('kind', {class: 'text wide'})], rows, `${candidate}, ${group} poses`));
}
follow(factorTable);
