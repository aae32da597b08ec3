// Draws a "stability" object (docs/stability.md) into an element: charts of small steps, maps of
// failure, motions.
function drawStability(into, data) {
  const colour = name => `var(${markOf(name).colour})`;
  const dashes = ['', '7 3', '2 3', '9 3 2 3', '4 2', '1 4'];
  // As its line is drawn.
  const stroke = name => ({stroke: colour(name), fill: 'none', 'stroke-width': name === 'reference' ? 3 : 1.5,
    'stroke-dasharray': dashes[symbols.indexOf(markOf(name).symbol)]});
  const mark = name => {
    const svg = shape('svg', {viewBox: '0 0 26 8', style: 'display:inline;width:26px;height:8px;margin-right:.35em;vertical-align:middle', 'aria-hidden': 'true'});
    svg.append(shape('path', {d: 'M0,4h26', ...stroke(name)}));
    return svg;
  };
  const select = (label, options, change) => {
    const list = element('select', {style: 'max-width:100%'}, ...options.map(([value, text]) => element('option', {value}, text)));
    list.addEventListener('change', change);
    return [element('label', {style: 'max-width:100%'}, `${label} `, list), list];
  };
  const command = name => `./touchstone replay ${name}`;
  const heat = share => `color-mix(in srgb, var(--bad) ${Math.round(70 * Math.min(1, Math.max(0, share)))}%, var(--panel))`;
  into.append(element('h2', {}, 'Stability'), element('p', {},
      'What a tiny change of pose does to an answer, near poses that are exactly parallel, perpendicular ' +
      'or touching. Lengths are in sizes of the smaller shape.'));
  if (data.amplification) drawLadder(data.amplification);
  if (data.maps) drawMaps(data.maps);
  if (data.sequences) drawMotions(data.sequences);

  // Small steps: one chart a pair, a line a candidate.
  function drawLadder(ladder) {
    const measures = {
      amplification: ['change of depth over what the step allows', 1],
      hull_excess: ['movement of the points beyond that of the contact patch', null],
      regret: ['regret of the normal', null],
      points_changed: ['share of steps that change the number of points', null],
      missed: ['share of steps that end in a missed contact', null],
    };
    const charts = element('div', {class: 'panels'}), worst = element('div');
    const names = data.candidates.filter(n => ladder.results.some(r => r.candidate === n));
    const off = new Set();
    const classes = [...new Set(ladder.results.map(r => r.class))];
    const [measureLabel, measure] = select('Show', Object.entries(measures).map(([k, v]) => [k, v[0]]), draw);
    const [classLabel, klass] = select('in', [['all', 'all of these classes'], ...classes.map(c => [c, c])], draw);
    const legend = element('div', {class: 'legend'}, ...names.map(name => {
      const box = element('input', {type: 'checkbox', checked: ''});
      box.addEventListener('change', () => { off[box.checked ? 'delete' : 'add'](name); draw(); });
      return element('label', {}, box, ' ', mark(name), name);
    }));
    into.append(element('h3', {}, 'Small steps'), element('p', {},
        'Around each configuration A is moved or turned in random directions, by 1e-16 to 1e-1 of the size. ' +
        'The true depth changes by no more than the step; an answer that jumps by a fixed amount, however ' +
        'small the step, is a line that rises to the left.'),
        element('p', {class: 'controls'}, measureLabel, classLabel), legend, charts, worst);

    function values(pair, name) {
      const rows = ladder.results.filter(r => r.pair === pair && r.candidate === name &&
          (klass.value === 'all' || r.class === klass.value));
      if (rows.length === 0) return null;
      return ladder.amplitudes.map((_, i) => {
        const here = rows.map(r => r[measure.value][i]).filter(v => v !== null);
        if (here.length === 0) return null;
        if (measure.value !== 'points_changed' && measure.value !== 'missed') return Math.max(...here);
        return here.reduce((a, b) => a + b, 0) / (rows.length * ladder.count);
      });
    }
    function draw() {
      const pairs = [...new Set(ladder.results.map(r => r.pair))];
      charts.replaceChildren(...pairs.map(pair => {
        const lines = names.filter(n => !off.has(n)).map(n => [n, values(pair, n)]).filter(l => l[1]);
        return lines.length ? chart(pair, lines) : '';
      }));
    }
    function chart(pair, lines) {
      const width = 380, height = 250, left = 46, right = 18, top = 8, bottom = 34;
      const share = measure.value === 'points_changed' || measure.value === 'missed';
      const least = share ? -3 : -17;
      const all = lines.flatMap(l => l[1]).filter(v => v !== null && v > 0).map(Math.log10);
      const low = Math.max(least, Math.floor(Math.min(-1, ...all))), high = share ? 0 : Math.ceil(Math.max(1, ...all));
      const first = Math.log10(ladder.amplitudes[0]), last = Math.log10(ladder.amplitudes.at(-1));
      const x = v => left + (Math.log10(v) - first) / (last - first) * (width - left - right);
      const y = v => height - bottom - (Math.max(low, Math.log10(v)) - low) / (high - low) * (height - top - bottom);
      const svg = shape('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img',
          'aria-label': `${pair}: ${measures[measure.value][0]} against the amplitude of the step`});
      const every = Math.ceil((high - low) / 6);
      for (let e = low; e <= high; e += every) {
        svg.append(shape('line', {class: 'grid', x1: left, x2: width - right, y1: y(10 ** e), y2: y(10 ** e)}),
            shape('text', {class: 'tick', x: left - 4, y: y(10 ** e) + 4, 'text-anchor': 'end'},
                e === low ? `≤1e${e}` : `1e${e}`));
      }
      for (let e = first; e <= last; e += 3) {
        svg.append(shape('text', {class: 'tick', x: x(10 ** e), y: height - bottom + 14, 'text-anchor': 'middle'}, `1e${Math.round(e)}`));
      }
      svg.append(shape('text', {class: 'tick', x: (left + width - right) / 2, y: height - 6, 'text-anchor': 'middle'}, 'amplitude of the step'));
      if (measures[measure.value][1]) svg.append(shape('line', {class: 'front', x1: left, x2: width - right, y1: y(1), y2: y(1)}));
      for (const [name, line] of lines.reverse()) {  // the first on top
        const points = line.flatMap((v, i) => v === null ? [] : [`${x(ladder.amplitudes[i]).toFixed(1)},${y(v).toFixed(1)}`]);
        const path = shape('polyline', {points: points.join(' '), ...stroke(name)});
        path.append(shape('title', {}, `${name}: largest ${exponent(Math.max(...line.filter(v => v !== null)))}`));
        svg.append(path);
      }
      return element('figure', {}, element('figcaption', {}, pair), svg);
    }
    draw();
    const rows = ladder.worst.filter(w => w.measure === 'amplification' && w.value > 1 + 1e-9)
        .sort((a, b) => b.value - a.value);
    if (rows.length === 0) return;
    worst.append(element('details', {}, element('summary', {}, 'Worst steps, by change of depth over what the step allows'),
        element('div', {class: 'scroll'}, element('table', {}, element('thead', {}, element('tr', {},
            ...['candidate', 'pair', 'from', 'to'].map(h => element('th', {class: 'text', scope: 'col'}, h)),
            element('th', {scope: 'col'}, 'times'))), element('tbody', {}, ...rows.map(w => element('tr', {},
            element('td', {class: 'text'}, mark(w.candidate), w.candidate), element('td', {class: 'text'}, w.pair),
            element('td', {class: 'text'}, element('code', {}, w.from)), element('td', {class: 'text'}, element('code', {}, w.to)),
            element('td', {}, exponent(w.value)))))))));
  }

  // Maps: a row a candidate, a column a critical pose.
  function drawMaps(maps) {
    const colours = {agree: '#cfe8d8', missed: '#d55e00', phantom: '#cc79a7', shallow: '#e6c229', overdeep: '#7a5195',
      'wrong-normal': '#0072b2', 'shallow-points': '#a6761d', 'overdeep-points': '#66558c', 'phantom-points': '#e7a3c8', 'few-points': '#9ad0f0', 'not-finite': '#000000', failed: '#777777', crashed: '#009e73', 'timed-out': '#00c8b0'};
    const side = 2 * maps.reach / maps.stride + 1, scale = 4;
    const table = element('div', {class: 'scroll'});
    const shown = element('p', {class: 'command', role: 'status'}, 'Point at a pixel for its outcome; click for the command that replays it.');
    const [label, zoom] = select('Zoom', maps.zooms.map((z, i) => [i, z]), draw);
    zoom.value = Math.max(0, maps.zooms.indexOf('1e-8'));
    const seen = Object.entries(maps.letters).filter(([letter]) =>
        maps.poses.some(p => p.results.some(r => r.maps.some(m => m.includes(letter)))));
    // "3m2." is mmm..
    const unpacked = runs => runs.replace(/(\d+)(\D)/g, (_, n, letter) => letter.repeat(n));
    into.append(element('h3', {}, 'Maps of failure'), element('p', {},
        'Each picture surrounds an exactly degenerate pose, in its middle, with tiny changes of two kinds: tilts, ' +
        'turns (radians) or offsets up to the zoom. A colour is what became of the answer; few points: right, but ' +
        'covering less than 0.3 of the contact patch.'),
        element('p', {class: 'controls'}, label),
        element('div', {class: 'legend'}, ...seen.map(([, meaning]) => element('span', {},
            element('span', {class: 'swatch', style: `background:${colours[meaning]}`, 'aria-hidden': 'true'}), meaning))),
        table, shown);

    function picture(pose, result) {
      const letters = unpacked(result.maps[zoom.value]);
      const counts = seen.map(([letter, meaning]) => [meaning, letters.split(letter).length - 1]).filter(c => c[1]);
      const canvas = element('canvas', {width: side, height: side, role: 'img',
        style: `width:${side * scale}px;height:${side * scale}px;image-rendering:pixelated;display:block`,
        'aria-label': `${result.candidate}, ${pose.pose}: ${counts.map(c => c.join(' ')).join(', ')}`});
      const context = canvas.getContext('2d');
      [...letters].forEach((letter, i) => {
        context.fillStyle = colours[maps.letters[letter]];
        context.fillRect(i % side, Math.floor(i / side), 1, 1);
      });
      const at = event => {
        const box = canvas.getBoundingClientRect();
        const column = Math.min(side - 1, Math.floor((event.clientX - box.left) / box.width * side));
        const row = Math.min(side - 1, Math.floor((event.clientY - box.top) / box.height * side));
        return {letter: letters[row * side + column],
          name: `map/${pose.pose}/${maps.zooms[zoom.value]}/${column * maps.stride - maps.reach}/${maps.reach - row * maps.stride}`};
      };
      canvas.addEventListener('mousemove', event => { canvas.title = `${maps.letters[at(event).letter]}  ${at(event).name}`; });
      canvas.addEventListener('click', event => {
        const pixel = at(event);
        shown.replaceChildren(`${result.candidate}, ${maps.letters[pixel.letter]}: `,
            element('code', {}, `${command(pixel.name)} --candidates ${result.candidate}`));
      });
      return canvas;
    }
    function draw() {
      const names = data.candidates.filter(n => maps.poses.some(p => p.results.some(r => r.candidate === n)));
      const head = element('tr', {}, element('th', {class: 'text', scope: 'col'}, ''), ...maps.poses.map(p =>
          element('th', {scope: 'col', class: 'text', style: 'white-space:normal;font-size:.78rem',
            title: `${p.description} Across: ${p.columns}. Up: ${p.rows}.`}, p.pose)));
      table.replaceChildren(element('table', {}, element('thead', {}, head), element('tbody', {}, ...names.map(name =>
          element('tr', {}, element('th', {scope: 'row'}, name), ...maps.poses.map(p => {
            const result = p.results.find(r => r.candidate === name);
            return element('td', {style: 'padding:.12rem .2rem'}, result ? picture(p, result) : '–');
          }))))));
    }
    draw();
  }

  // Motions: a row a candidate, a column a motion.
  function drawMotions(sequences) {
    const measures = {
      jump: ['largest change of depth beyond the true one', r => r.jump],
      hull_excess: ['largest movement of the points beyond that of the contact patch', r => r.hull_excess],
      hull: ['largest movement of the points', r => r.hull],
      points_changed: ['steps that change the number of points', r => r.points_changed],
      missed: ['missed contacts', r => r.missed],
      wrong: ['answers that do not agree', r => r.wrong],
    };
    const step = (motion, i) => `sequence/${motion.motion}/${i}/${sequences.steps}`;
    const table = element('div', {class: 'scroll'});
    const [label, measure] = select('Show', Object.entries(measures).map(([k, v]) => [k, v[0]]), draw);
    into.append(element('h3', {}, 'Motions'), element('p', {},
        `Slow motions through degenerate poses in ${sequences.steps} steps, in which depth and contact points should ` +
        'change as smoothly as the truth does. Hover over a cell for the step.'),
        element('p', {class: 'controls'}, label), table);
    function draw() {
      const of = measures[measure.value][1];
      const names = data.candidates.filter(n => sequences.motions.some(m => m.results.some(r => r.candidate === n)));
      const head = element('tr', {}, element('th', {class: 'text', scope: 'col'}, ''), ...sequences.motions.map(m =>
          element('th', {scope: 'col', class: 'text', style: 'white-space:normal;font-size:.78rem', title: m.description}, m.motion)));
      const truth = element('tr', {}, element('th', {scope: 'row'}, 'truth, a step'), ...sequences.motions.map(m =>
          element('td', {}, measure.value === 'jump' ? exponent(m.truth.depth) : measure.value.startsWith('hull') ? exponent(m.truth.patch) : '')));
      const rows = names.map(name => element('tr', {}, element('th', {scope: 'row'}, name), ...sequences.motions.map(m => {
        const result = m.results.find(r => r.candidate === name);
        const value = result ? of(result) : null;
        if (value === null) return element('td', {}, '–');
        if (typeof value === 'number') {
          return element('td', {style: `background:${heat(value / sequences.steps)}`}, String(value));
        }
        const size = value.value > 0 ? (Math.log10(value.value) + 6) / 6 : 0;
        return element('td', {style: `background:${heat(size)}`, title: `${step(m, value.step - 1)} to\n${step(m, value.step)}`}, exponent(value.value));
      })));
      table.replaceChildren(element('table', {}, element('thead', {}, head), element('tbody', {}, truth, ...rows)));
    }
    draw();
  }
}

// The page of `touchstone stability` is this section alone.
function drawStabilityPage() {
  byId('provenance').append(`Touchstone ${data.version}. Same figures again: `, element('code', {}, data.command));
  drawStability(byId('stability'), data);
}
