// The section of both bodies with the plane of the true normal (upwards) and a direction across it.
const slice = {svg: document.getElementById('slice'), across: [1, 0, 0], metres: 1, pan: [0, 0, 0], stretch: false};

const sliceWidth = 480, sliceHeight = 360;
// As for the 3-D view; `metres` is the width.
function fitSlice(bodies, n, reach) {
  const points = bodies.flatMap(b => b.faces.flat());
  const {centre, half} = points.length ? bounds(points, [slice.across, n, cross(slice.across, n)])
      : {centre: [0, 0, 0], half: [reach, reach]};
  slice.pan = centre;
  slice.metres = 2.2 * Math.max(half[0], half[1] * sliceWidth / sliceHeight);
}
function zoomSlice(factor) {
  slice.metres /= factor;
  slice.pan = times(slice.pan, 1 / factor);
}

// The outline of a body's section for x from x0 to x1: its chords along n, column by column, and
// its two ends by bisection (a section is convex). y is cut off below y0 and above y1.
function section(body, n, t, [x0, x1], [y0, y1]) {
  const at = x => chord(body, times(t, x), n);
  const columns = 480, xs = [];
  for (let i = 0; i <= columns; ++i) xs.push(x0 + (x1 - x0) * i / columns);
  const own = dot(body.centre, t);  // also of a needle that is thinner than a column
  for (const x of [own, 0]) if (x > x0 && x < x1) xs.push(x);
  xs.sort((a, b) => a - b);
  const hit = xs.filter(x => at(x) !== null);
  if (hit.length === 0) return [];
  const end = (outside, inside) => {
    for (let i = 0; i < 60; ++i) {
      const middle = (outside + inside) / 2;
      if (at(middle) === null) outside = middle; else inside = middle;
    }
    return inside;
  };
  const first = xs.indexOf(hit[0]), last = xs.lastIndexOf(hit[hit.length - 1]);
  if (first > 0) hit.unshift(end(xs[first - 1], xs[first]));
  if (last + 1 < xs.length) hit.push(end(xs[last + 1], xs[last]));
  const cut = y => Math.max(y0, Math.min(y1, y));
  const chords = hit.map(at);
  return [...hit.map((x, i) => [x, cut(chords[i][1])]), ...hit.map((x, i) => [x, cut(chords[i][0])]).reverse()];
}

// `scene` as for the 3-D view, and `signedDistance`.
function drawSlice(scene) {
  const width = sliceWidth, height = sliceHeight, n = scene.normal, t = slice.across, s = cross(n, t);
  const xScale = width / slice.metres;
  const depth = Math.abs(scene.signedDistance);
  const yScale = slice.stretch && depth > 0 ? Math.max(xScale, height / (8 * depth)) : xScale;
  // Stretched about the contact's height.
  const panX = dot(slice.pan, t), panY = dot(slice.pan, n) * xScale / yScale;
  const x = v => width / 2 + xScale * (v - panX), y = v => height / 2 - yScale * (v - panY);
  const xRange = [-0.52, 0.52].map(k => panX + k * slice.metres), yRange = [-0.55, 0.55].map(k => panY + k * height / yScale);
  const parts = scene.bodies.map((body, i) => shape('path', {class: 'ab'[i],
      d: section(body, n, t, xRange, yRange).map(([a, b], k) => `${k ? 'L' : 'M'}${x(a).toFixed(2)},${y(b).toFixed(2)}`).join('') + 'z'}));
  for (const mark of scene.marks) {
    const px = x(dot(mark.position, t)), py = y(dot(mark.position, n));
    if (!(px > -40 && px < width + 40 && py > -40 && py < height + 40)) continue;
    const off = Math.abs(dot(mark.position, s)) * xScale > 3;  // pixels
    const reach = mark.large ? 64 : 48;
    const colour = `var(${mark.colour})`;
    parts.push(shape('line', {x1: px, y1: py, x2: px + reach * dot(mark.normal, t), y2: py - reach * dot(mark.normal, n),
                              stroke: colour, 'stroke-width': mark.large ? 2.5 : 1.8}));
    parts.push(shape('path', {d: symbolPath(mark.symbol, px, py, mark.large ? 5 : 4), stroke: colour,
                              fill: off ? 'var(--panel)' : colour, 'stroke-width': 1.4}));
  }
  const across = scaleBar(xScale), up = scaleBar(yScale);
  parts.push(shape('path', {d: `M10,338v6h${across.pixels}v-6`, fill: 'none', stroke: 'var(--ink)', 'stroke-width': 1.5}),
             shape('text', {x: 10, y: 332}, across.text));
  if (yScale !== xScale) {
    parts.push(shape('path', {d: `M464,${344 - up.pixels}h6v${up.pixels}h-6`, fill: 'none', stroke: 'var(--ink)', 'stroke-width': 1.5}),
               shape('text', {x: 460, y: 344, 'text-anchor': 'end'}, `heights: ${up.text}`));
  }
  slice.svg.replaceChildren(...parts);
}
