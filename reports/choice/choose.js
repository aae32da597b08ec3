const data = JSON.parse(byId('data').textContent);
const needs = data.scene.needs, answer = data.runs[data.answer];
const percent = x => `${Math.round(100 * x)}%`;
const exactName = name => name === 'reference' ? 'exact cylinder' : name;
const measured = (value, need) => value === null ? 'the motion becomes absurd' : `${exponent(value)}${need.unit}`;

function table(heads, rows) {
  return element('table', {}, element('thead', {}, element('tr', {}, ...heads.map(h => element('th', {scope: 'col', class: 'text'}, h)))),
      element('tbody', {}, ...rows.map(r => element('tr', {}, ...r.map(c =>
          c instanceof HTMLTableCellElement ? c : element('td', {class: typeof c === 'number' ? '' : 'text'}, String(c)))))));
}
const wide = text => element('td', {class: 'text wrap'}, text);

// "can stands within 0.5°: 12° at 0.71 s"
function failure(run) {
  const need = needs[run.first_broken], verdict = run.verdicts[run.first_broken];
  return `${need.text}: ${measured(verdict.value, need)} at ${verdict.time.toFixed(2)} s`;
}

function headline() {
  byId('title').textContent = `What does the scene ${data.scene.name} need?`;
  byId('description').textContent = data.scene.description;
  const exact = data.runs[0].microseconds_per_step;
  byId('headline').textContent = !data.possible ? 'Not even exact contacts meet the needs of this scene.'
      : data.exact_is_cheapest
          ? `The exact cylinder is itself the cheapest model that meets all needs: contacts take ${exponent(exact)} µs of a step.`
          : `The cheapest models that meet all needs save ${percent(data.time_saved)} of the contacts' time: ` +
            `${exponent(answer.microseconds_per_step)} µs of a step instead of ${exponent(exact)} µs.`;
  byId('provenance').textContent = `${data.command}; ${data.machine.cpu}, ${data.machine.compiler}. ` +
      `The rest of a step, solver and harness, takes ${exponent(data.rest_of_step_microseconds)} µs.`;
}

function answerTables() {
  byId('kind-table').append(table(['pairs', 'model', 'ns a query', 'ns exactly', 'queries', 'next cheaper one breaks a need'],
      data.kinds.map(k => [wide(`${k.name} (${k.bodies})`), exactName(k.chosen), Math.round(k.nanoseconds), Math.round(k.exact_nanoseconds),
          k.asked, k.next_cheaper === null ? 'there is none' : `${k.next_cheaper.name}, ${Math.round(k.next_cheaper.nanoseconds)} ns`])));
  byId('need-table').append(table(['', 'need', 'measured', 'at'], answer.verdicts.map((v, i) => [
      element('td', {class: v.holds ? 'good text' : 'bad text'}, v.holds ? 'holds' : 'broken'), needs[i].text,
      measured(v.value, needs[i]), `${v.time.toFixed(2)} s`])));
}

function replayLine(evidence) {
  const command = element('code', {}, evidence.replay), button = element('button', {type: 'button'}, 'Copy');
  button.addEventListener('click', () => navigator.clipboard.writeText(evidence.replay).then(
      () => { button.textContent = 'Copied'; }, () => { button.textContent = 'Select and copy'; }));
  return element('div', {class: 'command'}, command, button);
}
function failures() {
  const list = byId('failure-list');
  for (const kind of data.kinds.filter(k => k.next_cheaper !== null)) {
    const run = data.runs[kind.next_cheaper.run], e = run.evidence;
    list.append(element('article', {}, element('h3', {}, `${kind.next_cheaper.name} for ${kind.name}`),
        element('p', {}, failure(run)),
        e && element('p', {}, `${e.bodies} at ${e.time.toFixed(2)} s: ${e.wrong}.`), e && replayLine(e)));
  }
  if (!list.children.length) list.append(element('p', {}, 'No cheaper model has a routine for any of these pairs.'));
}

// Runs with one candidate for all pairs; searches have longer names.
const isUniform = run => !run.name.includes(' ') && run.name !== 'combination';
function runTable() {
  byId('run-table').append(table(['model', 'µs of a step', 'error / limit', 'breaks first', 'worst answer before'],
      data.runs.filter(isUniform).map(r => [r.name, Number(r.microseconds_per_step.toPrecision(3)),
          element('td', {class: r.holds ? 'good' : 'bad'}, r.error === null ? 'absurd' : exponent(r.error)),
          wide(r.holds ? '' : failure(r)), wide(r.evidence ? `${r.evidence.bodies}: ${r.evidence.wrong}` : '')])));
  if (data.too_slow.length) byId('too-slow').textContent = `Not run, because their queries alone would take more than 3 s: ${data.too_slow.join(', ')}.`;
}

function chart() {
  const svg = byId('front'), left = 58, right = 740, top = 14, bottom = 372;
  const errors = data.runs.map(r => r.error).filter(e => e > 0 && e < 1e4).concat(1);
  const least = 10 ** Math.floor(Math.log10(Math.max(1e-3, Math.min(...errors)))), most = 10 ** Math.ceil(Math.log10(2 * Math.max(...errors)));
  const cost = data.runs.map(r => r.microseconds_per_step);
  const low = Math.log10(Math.min(...cost) * 0.8), high = Math.log10(Math.max(...cost) * 1.3);
  const x = c => left + (Math.log10(c) - low) / (high - low) * (right - left);
  const clamped = e => Math.min(most, Math.max(least, e === null ? most : e));
  const y = e => bottom - (Math.log10(clamped(e)) - Math.log10(least)) / Math.log10(most / least) * (bottom - top);
  for (let p = Math.round(Math.log10(least)); p <= Math.round(Math.log10(most)); ++p) {
    const at = y(10 ** p);
    svg.append(shape('line', {x1: left, x2: right, y1: at, y2: at, class: p === 0 ? 'limit' : 'grid'}),
               shape('text', {x: left - 6, y: at + 4, 'text-anchor': 'end', class: 'tick'}, String(Number((10 ** p).toPrecision(1)))));
  }
  for (let p = Math.ceil(low); p <= high; ++p) {
    svg.append(shape('line', {x1: x(10 ** p), x2: x(10 ** p), y1: top, y2: bottom, class: 'grid'}),
               shape('text', {x: x(10 ** p), y: bottom + 16, 'text-anchor': 'middle', class: 'tick'}, String(Number((10 ** p).toPrecision(1)))));
  }
  svg.append(shape('text', {x: (left + right) / 2, y: bottom + 36, 'text-anchor': 'middle'}, 'contacts of a step, µs'),
             shape('text', {x: 14, y: (top + bottom) / 2, 'text-anchor': 'middle', transform: `rotate(-90 14 ${(top + bottom) / 2})`}, 'error / limit'));
  svg.append(shape('path', {class: 'front', d: data.front.map((i, n) => `${n ? 'L' : 'M'}${x(cost[i])},${y(data.runs[i].error)}`).join('')}));
  const taken = [];
  const label = (run, at, text) => {
    if (taken.some(t => Math.abs(t[0] - at[0]) < 80 && Math.abs(t[1] - at[1]) < 12)) return;
    taken.push(at);
    const end = at[0] > right - 90;
    svg.append(shape('text', {x: at[0] + (end ? -8 : 8), y: at[1] - 6, class: 'label', 'text-anchor': end ? 'end' : 'start'}, text));
  };
  const named = data.runs.map((r, i) => i).sort((i, j) => (j === data.answer) - (i === data.answer) || (data.front.includes(j) - data.front.includes(i)));
  for (const i of named) {
    const run = data.runs[i], at = [x(cost[i]), y(run.error)], uniform = isUniform(run);
    const mark = shape('path', {class: run.holds ? 'holds' : 'broken', d: symbolPath(uniform ? 'circle' : 'diamond', ...at, uniform ? 4.5 : 3)});
    mark.append(shape('title', {}, `${run.name}: ${exponent(cost[i])} µs, ${run.holds ? 'all needs hold' : failure(run)}`));
    svg.append(mark);
    if (i === data.answer) svg.append(shape('circle', {cx: at[0], cy: at[1], r: 9, class: 'answer'}));
    if (i === data.answer) label(run, at, i === 0 ? 'exact, the answer' : 'the answer');
    else if (uniform) label(run, at, run.name);
  }
}

headline();
if (data.possible) {
  answerTables();
  failures();
}
runTable();
chart();
try {
  startMotion(data.motion);
} catch (e) {
  byId('motion-note').textContent = `The animation needs WebGL, which this browser does not give: ${e.message}`;
}
