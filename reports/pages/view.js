// The 3-D view: an orthographic camera about the contact, on a 2-D canvas. Of a convex body only the
// faces towards the viewer are drawn, which never hide each other; the true normal says which of the
// two bodies is behind. So nothing needs sorting. The one in front is translucent.
const makeView = canvas => ({canvas, right: [1, 0, 0], up: [0, 1, 0], towards: [0, 0, 1], zoom: 1, pan: [0, 0, 0]});

// Looks along the slice plane's normal, a little from the side and from above.
function aimView(view, n, t) {
  view.up = n; view.right = t; view.towards = cross(t, n);
  turnView(view, 0.5, 0.35);
}
function turnView(view, sideways, upwards) {
  const mix = (a, b, angle) => [add(times(a, Math.cos(angle)), b, Math.sin(angle)), add(times(b, Math.cos(angle)), a, -Math.sin(angle))];
  [view.right, view.towards] = mix(view.right, view.towards, sideways);
  [view.up, view.towards] = mix(view.up, view.towards, -upwards);
  view.right = unit(view.right);
  view.up = unit(add(view.up, view.right, -dot(view.up, view.right)));
  view.towards = cross(view.right, view.up);
}

// The box around points, along given axes: its centre and half extents.
function bounds(points, axes) {
  const ends = axes.map(e => points.map(p => dot(p, e))).map(v => [Math.min(...v), Math.max(...v)]);
  return {centre: combine(axes, ends.map(([lo, hi]) => (lo + hi) / 2)), half: ends.map(([lo, hi]) => (hi - lo) / 2)};
}
// All of these bodies; without any, `reach` metres about the contact.
function fitView(view, bodies, reach) {
  const points = bodies.flatMap(b => b.faces.flat());
  view.pan = points.length ? bounds(points, [view.right, view.up, view.towards]).centre : [0, 0, 0];
  view.zoom = 0.9 / (points.length ? Math.max(...points.map(p => length(add(p, view.pan, -1)))) : reach);
}
// The contact stays where it is on the screen.
function zoomView(view, factor) {
  view.zoom *= factor;
  view.pan = times(view.pan, 1 / factor);
}

// A convex polygon's (or a line's) part within a rectangle somewhat larger than the canvas: the
// coordinates of an enlarged body are beyond what a canvas can take.
function clipped(points, width, height) {
  const margin = 20;
  const inside = [p => p[0] + margin, p => width + margin - p[0], p => p[1] + margin, p => height + margin - p[1]];
  for (const room of inside) {
    const next = [];
    points.forEach((q, i) => {
      const p = points[(i + points.length - 1) % points.length], a = room(p), b = room(q);
      if ((a < 0) !== (b < 0)) next.push([0, 1].map(k => p[k] + (q[k] - p[k]) * (a / (a - b))));
      if (b >= 0) next.push(q);
    });
    points = next;
  }
  return points;
}
function tracePath(context, points) {
  context.beginPath();
  points.forEach((p, i) => i ? context.lineTo(...p) : context.moveTo(...p));
}

// `scene`: {bodies: [A, B], normal, marks: [{colour, symbol, position, normal, large}], outlines}.
function drawView(view, scene) {
  const {canvas} = view, ratio = devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext('2d');
  context.scale(ratio, ratio);
  const scale = view.zoom * Math.min(width, height) / 2;
  const across = dot(view.pan, view.right), up = dot(view.pan, view.up);
  const project = p => [width / 2 + scale * (dot(p, view.right) - across), height / 2 - scale * (dot(p, view.up) - up)];
  const style = getComputedStyle(document.documentElement);
  const names = ['--body-a', '--body-b'];
  const order = dot(scene.normal, view.towards) > 0 ? [1, 0] : [0, 1];
  order.forEach((which, rank) => {
    const tint = style.getPropertyValue(names[which]).trim().split(/\s+/).map(Number);
    context.globalAlpha = rank === 0 ? 0.92 : 0.6;
    context.drawImage(paintBody(view, scene.bodies[which], tint, project, width, height, ratio), 0, 0, width, height);
  });
  context.globalAlpha = 1;
  for (const outline of scene.outlines) {
    tracePath(context, clipped(outline.map(project), width, height));
    context.closePath();
    context.lineWidth = 2;
    context.strokeStyle = style.getPropertyValue('--ink');
    context.stroke();
  }
  for (const mark of scene.marks) drawMark(view, context, mark, project, style, width, height);
  drawScale(context, scale, height, style);
}

// On a canvas of its own, so that it is translucent as a whole.
function paintBody(view, body, tint, project, width, height, ratio) {
  const layer = document.createElement('canvas');
  layer.width = Math.round(width * ratio);
  layer.height = Math.round(height * ratio);
  const context = layer.getContext('2d');
  context.scale(ratio, ratio);
  const light = unit(add(add(view.towards, view.up, 0.6), view.right, -0.4));
  body.faces.forEach((face, i) => {
    const n = body.outward[i];
    if (dot(n, view.towards) <= 0) return;
    const points = clipped(face.map(project), width, height);
    if (points.length < 3) return;
    const shade = 0.62 + 0.42 * Math.max(0, dot(n, light));
    context.fillStyle = context.strokeStyle = `rgb(${tint.map(c => Math.min(255, Math.round(c * shade))).join(' ')})`;
    tracePath(context, points);
    context.closePath();
    context.fill();
    context.stroke();  // closes the seams between faces
  });
  context.strokeStyle = `rgb(${tint.map(c => Math.round(c * 0.5)).join(' ')} / .55)`;
  for (const edge of body.edges) {
    for (let i = 1; i < edge.length; ++i) {
      const line = clipped([project(edge[i - 1]), project(edge[i])], width, height);
      if (line.length < 2) continue;
      tracePath(context, line);
      context.stroke();
    }
  }
  return layer;
}

// A point, and an arrow along its normal of a fixed length on the screen.
function drawMark(view, context, mark, project, style, width, height) {
  const [x, y] = project(mark.position);
  if (!(x > -50 && x < width + 50 && y > -50 && y < height + 50)) return;
  const size = mark.large ? 72 : 54;
  const dx = size * dot(mark.normal, view.right), dy = -size * dot(mark.normal, view.up);
  context.strokeStyle = context.fillStyle = style.getPropertyValue(mark.colour);
  context.lineWidth = mark.large ? 3 : 2;
  tracePath(context, [[x, y], [x + dx, y + dy]]);
  context.stroke();
  const reach = Math.hypot(dx, dy);
  if (reach > 8) {
    const [ex, ey] = [dx / reach * 8, dy / reach * 8];
    tracePath(context, [[x + dx + ex, y + dy + ey], [x + dx - ey / 2, y + dy + ex / 2], [x + dx + ey / 2, y + dy - ex / 2]]);
    context.fill();
  }
  const path = new Path2D(symbolPath(mark.symbol, x, y, mark.large ? 5 : 4));
  context.fill(path);
  context.strokeStyle = style.getPropertyValue('--panel');
  context.lineWidth = 1;
  context.stroke(path);
}

// The largest of 1, 2, 5, 10, … metres that is at most 100 pixels.
function scaleBar(pixelsPerMetre) {
  const decade = 10 ** Math.floor(Math.log10(100 / pixelsPerMetre));
  const metres = decade * [5, 2, 1].find(f => f * decade * pixelsPerMetre <= 100.001);
  return {pixels: metres * pixelsPerMetre, text: `${metres >= 0.01 && metres < 1e4 ? +metres.toPrecision(1) : metres.toExponential(0).replace('+', '')} m`};
}
function drawScale(context, scale, height, style) {
  const {pixels, text} = scaleBar(scale);
  context.strokeStyle = context.fillStyle = style.getPropertyValue('--ink');
  context.lineWidth = 1.5;
  tracePath(context, [[10, height - 16], [10, height - 10], [10 + pixels, height - 10], [10 + pixels, height - 16]]);
  context.stroke();
  context.font = '12px system-ui, "DejaVu Sans", sans-serif';
  context.fillText(text, 10, height - 20);
}

// Drag, wheel, pinch and keys; `redraw` after each.
function steerView(view, redraw) {
  const {canvas} = view, held = new Map();
  const spread = () => { const [a, b] = [...held.values()]; return Math.hypot(a[0] - b[0], a[1] - b[1]); };
  canvas.addEventListener('pointerdown', e => { held.set(e.pointerId, [e.clientX, e.clientY]); canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener('pointermove', e => {
    if (!held.has(e.pointerId)) return;
    const [x, y] = held.get(e.pointerId), before = held.size === 2 ? spread() : 0;
    held.set(e.pointerId, [e.clientX, e.clientY]);
    if (held.size === 2) zoomView(view, spread() / Math.max(1, before));
    else turnView(view, (x - e.clientX) * 0.01, (e.clientY - y) * 0.01);
    redraw();
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, e => held.delete(e.pointerId));
  canvas.addEventListener('wheel', e => { e.preventDefault(); zoomView(view, Math.exp(-0.0015 * e.deltaY)); redraw(); }, {passive: false});
  const keys = {ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]};
  canvas.addEventListener('keydown', e => {
    if (!keys[e.key]) return;
    e.preventDefault();
    turnView(view, ...keys[e.key]);
    redraw();
  });
}
// What the views show of one configuration with its truth, about the contact along one true normal:
// {bodies, normal, contact, outlines, across, signedDistance, radii, reaches: {depth, contact}}.
function makeScene(given, truth, index) {
  const n = unit(truth.normals[index]), contact = truth.patch[index].centroid;
  const largest = s => s.shape === 'plane' ? 0 : Math.max(s.radius || 0, (s.half_length || 0) +
      (s.shape === 'capsule' ? s.radius : 0), ...(s.half_extents || []));
  const reach = 1.5 * largest(given.a);
  const bodies = [makeBody(given.a, given.pose_a, contact, reach), makeBody(given.b, given.pose_b, contact, reach)];
  const radii = bodies.map(b => { const all = b.faces.flat(); const c = bounds(all, b.axes).centre; return Math.max(...all.map(p => length(add(p, c, -1)))); });
  const outline = truth.patch[index].outline.map(p => add(p, contact, -1));
  const signedDistance = Number(truth.signed_distance[0]), most = Math.max(...radii);
  // Rounding shows below a few units in the last place of the position.
  const depth = Math.min(most, Math.max(5 * Math.abs(signedDistance), 1e-14 * Math.max(most, length(contact))));
  const reaches = {depth, contact: Math.min(most, Math.max(depth, 1.3 * Math.max(0, ...outline.map(length))))};
  const u = combine(axesOf(given.pose_a.orientation), [0, 0, 1]);
  return {bodies, normal: n, contact, outlines: outline.length > 1 ? [outline] : [], signedDistance, radii, reaches,
          across: across(n, u, add(bodies[1].centre, bodies[0].centre, -1))};
}
// The bodies to show at first: both, unless one would be too small to see.
function mainBodies({bodies, radii}) {
  return Math.min(...radii) > Math.max(...radii) / 20 ? bodies : [smallerBody({bodies, radii})];
}
const smallerBody = ({bodies, radii}) => bodies[radii[0] < radii[1] ? 0 : 1];

const finite = v => v !== null && v.every(c => c !== null);
// The points of answers ([name, answer] each) and the truth's, with their normals.
function marksOf(scene, truth, answers) {
  const result = [];
  for (const [name, a] of answers) {
    for (const p of a.status === 'contact' ? a.points : []) {
      const normal = finite(p.normal) ? p.normal : a.normal;
      if (!finite(p.position) || !finite(normal)) continue;
      result.push({...markOf(name), position: add(p.position, scene.contact, -1), normal, large: false});
    }
  }
  truth.normals.forEach((normal, i) => result.push({...truthMark, normal, large: true,
      position: add(truth.patch[i].centroid, scene.contact, -1)}));
  return result;
}
