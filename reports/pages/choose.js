// The page of `touchstone choose`: its tables, the chart of error and cost, the motion.
const needs = data.scene.needs, answer = data.runs?.[data.answer];
const exactName = name => name === 'reference' ? 'exact cylinder' : name;
const measured = (value, need) => value === null ? 'the motion becomes absurd' : `${exponent(value)}${need.unit}`;

const wide = text => element('td', {class: 'text wrap'}, text);
const disturbances = count => count === 1 ? 'one disturbance' : `${count} disturbances`;

// Words such as "can stands within 0.5°: 12° at 0.71 s".
function failure(run) {
  const need = needs[run.first_broken], verdict = run.verdicts[run.first_broken];
  return `${need.text}: ${measured(verdict.value, need)} at ${verdict.time.toFixed(2)} s` +
      (verdict.bodies ? `, ${verdict.bodies} first` : '') +
      (run.disturbance ? `, disturbance ${run.disturbance}` : '');
}

// How it was measured: where, the command, and what it did not read of a robot's or world's file.
function origin() {
  const {ignored} = data.scene, unread = fold(`What of the file was not read (${ignored.length})`,
      element('ul', {id: 'ignored'}, ...ignored.map(text => element('li', {}, text))));
  byId('measured').append(byId('provenance'), command(data.command), ...(ignored.length ? [unread] : []));
}

function headline() {
  byId('title').textContent = `What does the scene ${data.scene.name} need?`;
  byId('description').textContent = data.scene.description;
  const exact = data.runs[0], percent = 100 * data.step_saved;
  const instead = (text, of) => text(answer) + (data.answer === 0 ? '' : ` instead of ${text(exact)}`) + of;
  const isCheapest = !data.runs.some(r => r.timed && r.holds && r.models_alone && r.step_microseconds < answer.step_microseconds);
  const microseconds = (member, of) => instead(run => `${exponent(run[member], 3)} µs`, of);
  byId('headline').textContent = !data.possible ? `Not even exact contacts meet the needs of this scene: ${failure(exact)}.`
      : data.worthwhile ? `The ${isCheapest ? 'cheapest' : 'simplest of the cheapest'} models that meet all needs save ${Math.round(percent)}% of a step: ${microseconds('step_microseconds', '.')}`
      : percent > 0 ? `Exact: nothing cheaper that meets all needs saves more than ${(Math.ceil(10 * percent) / 10).toFixed(1)}% of a step.`
      : data.runs.slice(1).some(r => r.holds && r.models_alone) ? 'Exact: no model that meets all needs takes less of a step.'
      : 'Exact: no model meets all needs.';
  for (const text of [data.cheaper_routines, data.long_step]) {
    if (text) byId('headline').textContent += ` ${text}`;
  }
  byId('provenance').textContent = `${data.machine.cpu}, ${data.machine.compiler}. ` +
      `Contacts take ${microseconds('microseconds_per_step', ' of a step, ')}ODE's solver ${microseconds('solver_microseconds_per_step', '; ')}` +
      `a frame of 1/60 s takes ${exponent(data.frame_microseconds)} µs` +
      (data.answer === 0 ? '. ' : ` instead of ${exponent(data.exact_frame_microseconds)} µs with exact contacts. `) +
      `The solver gets ${instead(run => run.points_per_step.toFixed(1), ' contact points a step')}` +
      (data.point_microseconds === null ? '.' : `; a point costs it about ${exponent(data.point_microseconds)} µs.`) +
      ` ${data.unasked}` + (data.scene.disturbances
      ? ` Every run is repeated under ${disturbances(data.scene.disturbances)} (seed ${data.scene.seed}), the answer under five times as many; ` +
        'a need holds if it holds in all, and what breaks one is not run further.' : '');
  origin();
}

// What compares with exact runs is decided as far as these agree with each other.
function needTable(verdicts) {
  const {undecidable} = data.scene, compares = undecidable.length > 0 || needs.some(n => n.spread !== null);
  const row = (cells, spread) => compares ? [...cells, spread] : cells;
  return table(row(['', 'need', 'measured', 'at'], 'exact runs differ by').map(textColumn), [
    ...verdicts.map((v, i) => row([
      element('td', {class: v.holds ? 'good text' : 'bad text'}, v.holds ? 'holds' : 'broken'), wide(v.bodies && !v.holds ? `${needs[i].text} (${v.bodies})` : needs[i].text),
      measured(v.value, needs[i]), `${v.time.toFixed(2)} s`], needs[i].spread === null ? '' : measured(needs[i].spread, needs[i]))),
    ...undecidable.map(u => row([element('td', {class: 'text'}, 'undecidable'), wide(u.text), '', ''], measured(u.spread, u)))],
  'What was measured of each need, and when');
}

function answerTables() {
  byId('kind-table').append(table([textColumn('pairs'), textColumn('model'), 'bytes a shape', 'ns a query', 'ns exactly', column('queries', {class: 'wide'}), textColumn('next cheaper one')],
      data.kinds.map(k => [wide(`${k.name} (${k.bodies})`), exactName(k.chosen) + (k.is_sphere ? ', here a sphere' : ''), whole(k.bytes), whole(k.nanoseconds), whole(k.exact_nanoseconds),
          whole(k.asked), wide(k.next_cheaper === null ? 'there is none' : `${k.next_cheaper.name}, ${whole(k.next_cheaper.nanoseconds)} ns, ` +
            (data.runs[k.next_cheaper.run].holds ? `holds: ${exponent(data.runs[k.next_cheaper.run].step_microseconds, 3)} µs a step` : 'breaks a need'))]), 'Times of a query, median'));
  byId('need-table').append(needTable(answer.verdicts));
}

function failures() {
  const list = byId('failure-list');
  for (const kind of data.kinds.filter(k => k.next_cheaper !== null && !data.runs[k.next_cheaper.run].holds)) {
    const run = data.runs[kind.next_cheaper.run], e = run.evidence;
    list.append(element('article', {}, element('h3', {}, `${kind.next_cheaper.name} for ${kind.name}`),
        element('p', {}, failure(run)), command(run.render),
        e && element('p', {}, `${e.bodies} at ${e.time.toFixed(2)} s: ${e.wrong}.`), e && command(e.replay)));
  }
  if (!list.children.length) list.append(element('p', {}, 'No model with a cheaper query breaks a need.'));
}

// Whether a run has one candidate for all pairs; runs of the search have longer names.
const isUniform = run => !run.name.includes(' ') && run.name !== 'combination';
function runTable() {
  const rows = models => data.runs.filter(r => isUniform(r) && r.models_alone === models);
  const drawn = (runs, title) => table([textColumn('model'), 'a step, µs', 'contacts, µs', 'points', 'error / limit', 'held', textColumn('breaks first'), textColumn('worst answer before')],
      runs.map(r => [r.name, exponent(r.step_microseconds, 3), exponent(r.microseconds_per_step, 3), r.points_per_step.toFixed(1),
          element('td', {class: r.holds ? 'good' : 'bad'}, r.error === null ? 'absurd' : exponent(r.error)),
          `${r.held} of ${r.trials}`, wide(r.holds ? '' : failure(r)), wide(r.evidence ? `${r.evidence.bodies}: ${r.evidence.wrong}` : '')]), title);
  byId('run-table').append(drawn(rows(true), 'Each run with one model'));
  if (rows(false).length) byId('run-table').append(element('h3', {}, 'Routines, which are no models'), drawn(rows(false), 'Each run with one routine'));
  if (data.too_slow.length) byId('too-slow').textContent = `Not run, because their queries alone would take more than 3 s: ${data.too_slow.join(', ')}. `;
  if (data.same_as_sphere.length) byId('too-slow').textContent += `The same as spheres:1 here: ${data.same_as_sphere.join(', ')}.`;
}

// Names in the chart: of few runs all, of many those that one looks for, so that they do not hide each other.
const lookedFor = ['exact', 'capsule', 'spheres:8', 'prism:16', 'bullet', 'ode', 'mujoco'];
const isNamed = (run, i) => data.runs.filter(isUniform).length <= 24 || data.front.includes(i) || lookedFor.includes(run.name);

// Error and cost of all runs. A run whose motion became absurd is drawn at the top.
function costChart() {
  const errors = data.runs.map(r => r.error).filter(e => e > 0 && e < 1e4).concat(1);
  const cost = data.runs.map(r => r.step_microseconds);
  const low = 10 ** Math.floor(Math.log10(Math.max(1e-3, Math.min(...errors)))), high = 10 ** Math.ceil(Math.log10(2 * Math.max(...errors)));
  const at = i => ({x: cost[i], y: Math.min(high, Math.max(low, data.runs[i].error === null ? high : data.runs[i].error))});
  const points = data.runs.map((run, i) => {
    const uniform = isUniform(run), isAnswer = i === data.answer;
    return {...at(i), fill: `var(${run.holds ? '--good' : '--bad'})`, stroke: null, size: uniform ? 60 : 30,
            symbol: symbolPath(!run.models_alone ? 'square' : uniform ? 'circle' : 'diamond', 0, 0, 1),
            label: isAnswer ? (i === 0 ? 'exact, the answer' : 'the answer') : uniform && isNamed(run, i) ? run.name : '',
            weight: isAnswer ? 'bold' : 'normal', order: isAnswer ? -2 : data.front.includes(i) ? -1 : i,
            tip: `${run.name}\n${exponent(cost[i])} µs, ${run.holds ? 'all needs hold' : failure(run)}`};
  });
  if (data.possible) points.unshift({...at(data.answer), fill: 'none', stroke: 'var(--ink)', size: 320, symbol: symbolPath('circle', 0, 0, 1), label: '', order: 1e6});
  drawScatter(byId('front'), 'Error of each run against its cost', {height: 420, points, limit: 1, lines: [{rows: data.front.map(at)}],
      x: {title: 'a step, µs', domain: [Math.min(...cost) * 0.8, Math.max(...cost) * 1.3], ticks: decadesOf(cost).ticks, label: numberLabel},
      y: {title: 'error / limit', domain: [low, high], ticks: decadesOf([low, high]).ticks, label: numberLabel}});
}

// The motion of a run beside one that holds under the same disturbance, from shortly before they part.
function startMotion(motion) {
  const select = element('select', {id: 'other'}), {runs} = motion, before = 0.1;  // seconds
  byId('right-caption').append(element('label', {}, 'With ', select));
  describeMotions('The scene with models that meet its needs', 'The scene with the models that are selected');
  const listed = runs.map((r, i) => [i, r.name]).filter(([i]) => runs[i].listed);
  select.append(...options(listed));
  const chosen = () => runs[select.value];
  const describe = () => {
    byId('other-note').textContent = chosen().note;
    byId('other-command').replaceChildren(...(chosen().command === null ? [] : [command(chosen().command)]));
  };
  const begin = () => {
    describe();
    byId('left-caption').textContent = `With ${runs[chosen().beside].name}`;
    byId('scrub').value = Math.max(0, (chosen().from ?? 0) - before);
    byId('scrub').dispatchEvent(new Event('input'));
  };
  // A run that failed is what one wants to see first.
  select.value = (listed.find(([i]) => runs[i].from !== null) ?? listed[0])[0];
  playMotions(() => ({motion, pair: [runs[chosen().beside], chosen()]}));
  select.addEventListener('change', begin);
  if (!/[#&]t=/.test(location.hash)) begin();
  else describe();
}

// The page of `touchstone choose --engine`.
function drawEngineChoice() {
  const {engine, settings, sizes} = data, usual = settings[0], best = data.answer === null ? null : settings[data.answer];
  const shown = best ?? settings[data.nearest], broken = shown.verdicts.filter(v => !v.holds).length;
  const microseconds = s => s.step_microseconds === null ? '' : exponent(s.step_microseconds);
  byId('title').textContent = `Which shape does the scene ${data.scene.name} need in ${engine.name}?`;
  byId('description').textContent = data.scene.description;
  byId('headline').textContent = best === null ? `No shape in ${engine.name} meets all needs, not even with our routines installed. ${shown.name} comes nearest, and breaks ${broken} of ${shown.verdicts.length}.`
      : data.answer === 0 ? `${engine.name}’s default cylinder: no other of its shapes that meets all needs takes less than nine tenths of its ${microseconds(best)} µs a step.`
      : `${best.name}: ${microseconds(best)} µs a step instead of ${microseconds(usual)} µs` +
        (usual.holds ? '; the default cylinder meets all needs, too.' : `. The default cylinder breaks: ${usual.failure}.`);
  byId('provenance').textContent = `${engine.name} ${engine.version}: ${engine.settings}. ${data.machine.cpu}, ${data.machine.compiler}. ` +
      (data.scene.disturbances ? `Every run is repeated under ${disturbances(data.scene.disturbances)} (seed ${data.scene.seed}), the answer under five times as many.` : '') +
      (data.unasked ? ` ${data.unasked}` : '') +
      (data.scene.not_judged.length ? ` Not judged, for ${engine.name} ended a run with our routines (${data.scene.exact_end}): ${data.scene.not_judged.join(', ')}.` : '') +
      (data.scene.left_out.length ? ` Left out, for an engine’s normals are not judged: ${data.scene.left_out.join(', ')}.` : '');
  origin();
  byId('answer-note').textContent = best === null ? 'The shape of each size of cylinder that comes nearest, and the lines that make it.'
      : 'The cheapest shape of each size of cylinder with which a whole run in the engine’s own world meets all needs, and the lines that make it.';
  for (const size of sizes) {
    byId('kind-table').append(element('h3', {}, `${size.name} (${size.bodies}): ${size.shape}`), element('pre', {}, size.lines));
  }
  byId('need-table').append(needTable(shown.verdicts));
  byId('chart').remove();
  byId('failures').remove();
  byId('runs-title').textContent = 'All settings that were run';
  byId('runs-note').textContent = 'Times of a step of the engine: its contacts, its solver, its integration. What broke a need was not timed, but for the default and our routines.';
  byId('run-table').append(table([textColumn('setting'), 'µs a step', 'contact points', 'error / limit', 'held', textColumn('breaks first')],
      settings.map(s => [s.name, microseconds(s), s.points.toFixed(1),
          element('td', {class: s.holds ? 'good' : 'bad'}, s.error === null ? 'absurd' : exponent(s.error)), `${s.held} of ${s.trials}`,
          wide(s.failure ?? '')]), 'Each setting of the engine'));
}

if (data.engine) {
  drawEngineChoice();
} else {
  headline();
  if (data.possible) {
    answerTables();
    failures();
  }
  runTable();
  keepDrawn(costChart);
}
startMotion(data.motion);
listSections();
