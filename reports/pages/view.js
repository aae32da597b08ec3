// 3-D views of convex bodies on a 2-D canvas, drawn from far to near. Only the faces towards the viewer are drawn; those of a
// convex body never hide each other. A 2-D canvas keeps the full precision of doubles, so that a contact can be enlarged
// until their rounding shows, and a page may hold any number of them; browsers allow only a few WebGL contexts.

// A view. The point `pan` is shown in the middle of the canvas; there, a metre is `zoom` times half of the canvas's smaller
// side. `lens` is the tangent of half the angle of view; 0 means orthographic.
const makeView = canvas => ({canvas, right: [1, 0, 0], up: [0, 1, 0], towards: [0, 0, 1], zoom: 1, pan: [0, 0, 0], lens: 0});

// Aims at a contact with its normal n upwards, slightly from the side and from above; t is a direction across n.
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

// The bounding box of points along given axes: its centre and half extents.
function bounds(points, axes) {
  const ends = axes.map(e => points.map(p => dot(p, e))).map(v => [Math.min(...v), Math.max(...v)]);
  return {centre: combine(axes, ends.map(([lo, hi]) => (lo + hi) / 2)), half: ends.map(([lo, hi]) => (hi - lo) / 2)};
}
// Fits the view to these bodies or, without any, to `reach` metres about a point, at first the contact.
function fitView(view, bodies, reach, about = [0, 0, 0]) {
  const points = bodies.flatMap(b => b.faces.flat());
  view.pan = points.length ? bounds(points, [view.right, view.up, view.towards]).centre : about;
  view.zoom = 0.9 / (points.length ? Math.max(...points.map(p => length(add(p, view.pan, -1)))) : reach);
}
// What a view shows at first of a needle, or of a coin seen on its edge, which would be a hair beside the other body:
// {reach, about}, so that it takes a seventh of the view, about its point of contact; null where all bodies are well seen.
function closeUp(view, scene) {
  // A body's outline is thinnest across the picture of one of its axes, or along it.
  const directionsOf = body => body.axes.flatMap(e => [cross(view.towards, e), add(e, view.towards, -dot(e, view.towards))]).filter(d => length(d) > 1e-9).map(unit);
  const widths = scene.bodies.map(b => b.shape.shape === 'plane' ? Infinity : Math.min(...directionsOf(b).map(n => extentAlong(b, n))));
  const thin = widths[0] < widths[1] ? 0 : 1, reach = 6 * widths[thin];
  if (reach > 0.375 * Math.max(...mainBodies(scene).map(b => scene.radii[scene.bodies.indexOf(b)]))) return null;
  return {reach, about: times(scene.normal, (thin === 0 ? 0.5 : -0.5) * scene.signedDistance)};
}
// Zooms about the contact, which keeps its place on the screen.
function zoomView(view, factor) {
  view.zoom *= factor;
  view.pan = times(view.pan, 1 / factor);
}

// The part of a convex polygon or line where `room` is not negative.
function cut(points, room) {
  const kept = [];
  points.forEach((q, i) => {
    const p = points[(i + points.length - 1) % points.length], a = room(p), b = room(q);
    if ((a < 0) !== (b < 0)) kept.push(p.map((x, k) => x + (q[k] - x) * (a / (a - b))));
    if (b >= 0) kept.push(q);
  });
  return kept;
}
function tracePath(context, points) {
  context.beginPath();
  points.forEach((p, i) => i ? context.lineTo(...p) : context.moveTo(...p));
}

// Clears the canvas and returns what drawing needs: {view, context, width, height, ratio, scale: pixels per metre, project: a
// point to pixels, polygon: a polygon's visible part in pixels, sees: whether the viewer is on the outer side of the plane
// n·x = at}; null if the canvas has no size.
function startFrame(view) {
  const {canvas, right, up, towards, pan, zoom, lens} = view, ratio = devicePixelRatio || 1;
  const width = canvas.clientWidth, height = canvas.clientHeight, scale = zoom * Math.min(width, height) / 2;
  if (!(width > 0 && height > 0)) return null;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext('2d');
  context.scale(ratio, ratio);
  const [panRight, panUp, panTowards] = [right, up, towards].map(e => dot(pan, e));
  const nearness = p => lens * zoom * (dot(p, towards) - panTowards);  // 1 at the viewer
  const project = p => {
    const s = scale / (1 - nearness(p));
    return [width / 2 + s * (dot(p, right) - panRight), height / 2 - s * (dot(p, up) - panUp)];
  };
  // An enlarged body has coordinates that are too large for a canvas, so everything is clipped.
  const margin = 20;
  const sides = [p => p[0] + margin, p => width + margin - p[0], p => p[1] + margin, p => height + margin - p[1]];
  const within = (points, room) => points.every(p => room(p) >= 0) ? points : cut(points, room);
  const polygon = points => sides.reduce(within, (lens ? within(points, p => 0.98 - nearness(p)) : points).map(project));
  const sees = lens ? (n, at) => dot(n, add(pan, towards, 1 / (lens * zoom))) > at : n => dot(n, towards) > 0;
  return {view, context, width, height, ratio, scale, project, polygon, sees};
}

// Paints a body. `look`: {tint: [r, g, b], pale: the colour of stripes, light: the direction towards it, opacity, shadows:
// bodies that cast a shadow on it, outline: the colour of outlines of faces}.
function paintBody(frame, body, look) {
  if (!(look.opacity < 1)) return paintFaces(frame, frame.context, body, look);
  // A layer of its own makes the body translucent as a whole.
  const layer = frame.view.layer = frame.view.layer || document.createElement('canvas');
  layer.width = frame.context.canvas.width;
  layer.height = frame.context.canvas.height;
  const context = layer.getContext('2d');
  context.scale(frame.ratio, frame.ratio);
  paintFaces(frame, context, body, look);
  frame.context.globalAlpha = look.opacity;
  frame.context.drawImage(layer, 0, 0, frame.width, frame.height);
  frame.context.globalAlpha = 1;
}
function paintFaces(frame, context, body, {tint, pale = tint, light, shadows = [], outline = null}) {
  body.faces.forEach((face, i) => {
    const n = body.outward[i];
    if (!frame.sees(n, dot(n, face[0]))) return;
    const points = frame.polygon(face);
    if (points.length < 3) return;
    const shade = 0.62 + 0.42 * Math.max(0, dot(n, light));
    const colour = (body.stripe[i] ? pale : tint).map(c => Math.min(255, Math.round(c * shade)));
    context.fillStyle = context.strokeStyle = `rgb(${colour.join(' ')})`;
    tracePath(context, points);
    context.closePath();
    context.fill();
    context.stroke();  // closes the seams between faces
    if (shadows.length) paintShadows(frame, context, points, face[0], n, light, shadows);
    if (!outline) return;
    context.strokeStyle = outline;
    tracePath(context, points);
    context.closePath();
    context.stroke();
  });
  context.strokeStyle = `rgb(${tint.map(c => Math.round(c * 0.5)).join(' ')} / .55)`;
  for (const edge of body.edges) {
    for (let i = 1; i < edge.length; ++i) {
      const line = frame.polygon([edge[i - 1], edge[i]]);
      if (line.length < 2) continue;
      tracePath(context, line);
      context.stroke();
    }
  }
}
// All corners of a body: two opposite ones of each face.
const cornersOf = ({faces}) => faces.flatMap(f => [f[0], f[2]]);
// Paints the shadows of bodies on a face through `at` with normal n; `points` is the face on the canvas.
function paintShadows(frame, context, points, at, n, light, bodies) {
  const fall = dot(n, light);
  if (fall < 0.05) return;
  const path = new Path2D();
  for (const body of bodies) {
    const shadow = [];
    for (const p of cornersOf(body)) {
      const height = dot(n, p) - dot(n, at);
      if (height >= 0) shadow.push(add(p, light, -height / fall));
    }
    const outline = frame.polygon(shadow.length < 3 ? [] : hull(shadow, n));
    outline.forEach((p, i) => i ? path.lineTo(...p) : path.moveTo(...p));
    if (outline.length) path.closePath();
  }
  context.save();
  tracePath(context, points);
  context.clip();
  context.fillStyle = 'rgb(0 0 0 / .25)';
  context.fill(path);  // one path: shadows that overlap are not darker there
  context.restore();
}
// The convex hull of points in a plane with normal n (A. M. Andrew, Information Processing Letters 9, 1979).
function hull(points, n) {
  const right = across(n), up = cross(n, right);
  const flat = points.map(p => [dot(p, right), dot(p, up), p]).sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = list => {
    const chain = [];
    for (const c of list) {
      while (chain.length > 1) {
        const [a, b] = chain.slice(-2);
        if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0) break;
        chain.pop();
      }
      chain.push(c);
    }
    return chain.slice(0, -1);
  };
  return [...half(flat), ...half(flat.reverse())].map(c => c[2]);
}

// Bodies from far to near. Of two that overlap on the canvas, the nearer is on the viewer's side of a plane between them.
function farToNear(frame, bodies) {
  const boxes = bodies.map(body => {
    const points = cornersOf(body).map(frame.project);
    return [0, 1].map(k => points.map(p => p[k])).map(v => [Math.min(...v), Math.max(...v)]);
  });
  const overlap = (a, b) => [0, 1].every(k => a[k][0] <= b[k][1] && b[k][0] <= a[k][1]);
  const behind = bodies.map(() => []);
  bodies.forEach((a, i) => {
    for (let k = 0; k < i; ++k) {
      if (!overlap(boxes[i], boxes[k])) continue;
      const {normal, at} = planeBetween(a, bodies[k]);
      if (frame.sees(normal, at)) behind[i].push(k); else behind[k].push(i);
    }
  });
  const {towards} = frame.view, left = new Set(bodies.keys());
  const byDepth = [...left].sort((i, k) => dot(bodies[i].centre, towards) - dot(bodies[k].centre, towards));
  const result = [];
  while (left.size) {
    const free = byDepth.filter(i => left.has(i));
    const next = free.find(i => behind[i].every(k => !left.has(k)));
    left.delete(next === undefined ? free[0] : next);  // a cycle is broken at its farthest body
    result.push(bodies[next === undefined ? free[0] : next]);
  }
  return result;
}

// Lets drag, wheel, pinch and arrow keys move the view, and redraws after each.
function steerView(view, redraw, turn = turnView, zoom = zoomView) {
  const {canvas} = view, held = new Map();
  const spread = () => { const [a, b] = [...held.values()]; return Math.hypot(a[0] - b[0], a[1] - b[1]); };
  canvas.addEventListener('pointerdown', e => { held.set(e.pointerId, [e.clientX, e.clientY]); canvas.setPointerCapture(e.pointerId); });
  canvas.addEventListener('pointermove', e => {
    if (!held.has(e.pointerId)) return;
    const [x, y] = held.get(e.pointerId), before = held.size === 2 ? spread() : 0;
    held.set(e.pointerId, [e.clientX, e.clientY]);
    if (held.size === 2) zoom(view, spread() / Math.max(1, before));
    else turn(view, (x - e.clientX) * 0.01, (e.clientY - y) * 0.01);
    redraw();
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, e => held.delete(e.pointerId));
  canvas.addEventListener('wheel', e => { e.preventDefault(); zoom(view, Math.exp(-0.0015 * e.deltaY)); redraw(); }, {passive: false});
  const keys = {ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]};
  canvas.addEventListener('keydown', e => {
    if (!keys[e.key]) return;
    e.preventDefault();
    turn(view, ...keys[e.key]);
    redraw();
  });
}
// The view of a contact.

// What the views show of one configuration, about the contact along the true normal `index`, with the faces of a hull:
// {bodies, normal, contact, outlines, across, signedDistance, radii, reaches: {depth, contact}}.
function makeScene(given, truth, index, facesOfB) {
  const n = unit(truth.normals[index]), contact = truth.patch[index].centroid;
  const largest = s => s.shape === 'plane' ? 0 : Math.max(s.radius || 0, (s.half_length || 0) +
      (s.shape === 'capsule' ? s.radius : 0), ...(s.half_extents || []));
  const reach = 1.5 * largest(given.a);
  const bodies = [makeBody(given.a, given.pose_a, contact, reach), makeBody({...given.b, faces: facesOfB}, given.pose_b, contact, reach)];
  const radii = bodies.map(b => { const all = b.faces.flat(); const c = bounds(all, b.axes).centre; return Math.max(...all.map(p => length(add(p, c, -1)))); });
  const outline = truth.patch[index].outline.map(p => add(p, contact, -1));
  const signedDistance = Number(truth.signed_distance[0]), largestRadius = Math.max(...radii);
  // Below a few units in the last place of the position only rounding shows.
  const depth = Math.min(largestRadius, Math.max(5 * Math.abs(signedDistance), 1e-14 * Math.max(largestRadius, length(contact))));
  const reaches = {depth, contact: Math.min(largestRadius, Math.max(depth, 1.3 * Math.max(0, ...outline.map(length))))};
  const u = combine(axesOf(given.pose_a.orientation), [0, 0, 1]);
  return {bodies, normal: n, contact, outlines: outline.length > 1 ? [outline] : [], signedDistance, radii, reaches,
          across: across(n, u, add(bodies[1].centre, bodies[0].centre, -1))};
}
// "box B"; all bodies are drawn with sharp edges.
const nameOfB = ({shape, rounding}) => `${shape} B${rounding ? ', drawn without its rounding' : ''}`;
// The bodies shown at first: both, unless one of them would be too small to see.
function mainBodies({bodies, radii}) {
  return Math.min(...radii) > Math.max(...radii) / 20 ? bodies : [smallerBody({bodies, radii})];
}
const smallerBody = ({bodies, radii}) => bodies[radii[0] < radii[1] ? 0 : 1];

const finite = v => v !== null && v.every(c => c !== null);
// Marks for the contact points and normals of the answers, a list of [name, answer], and of the truth.
function marksOf(scene, truth, answers) {
  const result = [];
  for (const [name, a] of answers) {
    for (const p of a.status === 'contact' ? a.points : []) {
      const normal = p.normal && finite(p.normal) ? p.normal : a.normal;
      if (!finite(p.position) || !finite(normal)) continue;
      result.push({...markOf(name), position: add(p.position, scene.contact, -1), normal, large: false});
    }
  }
  truth.normals.forEach((normal, i) => result.push({...truthMark, normal, large: true,
      position: add(truth.patch[i].centroid, scene.contact, -1)}));
  return result;
}

// Draws a scene with its marks, [{colour, symbol, position, normal, large}]. The true normal tells which body is behind;
// the one in front is translucent.
function drawContact(view, scene) {
  const frame = startFrame(view);
  if (frame === null) return;
  const {context} = frame, style = getComputedStyle(document.documentElement);
  const light = unit(add(add(view.towards, view.up, 0.6), view.right, -0.4));
  const tints = ['--body-a', '--body-b'].map(name => style.getPropertyValue(name).trim().split(/\s+/).map(Number));
  const order = dot(scene.normal, view.towards) > 0 ? [1, 0] : [0, 1];
  order.forEach((which, rank) => paintBody(frame, scene.bodies[which], {tint: tints[which], light, opacity: rank === 0 ? 0.92 : 0.6}));
  for (const outline of scene.outlines) {
    tracePath(context, frame.polygon(outline));
    context.closePath();
    context.lineWidth = 2;
    context.strokeStyle = style.getPropertyValue('--ink');
    context.stroke();
  }
  for (const mark of scene.marks) drawMark(frame, mark, style);
  drawScale(frame, style);
}
// Draws a contact point and its normal, an arrow with a fixed length on the screen.
function drawMark({view, context, project, width, height}, mark, style) {
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

// The largest of 1, 2, 5, 10, … metres that takes at most 100 pixels.
function scaleBar(pixelsPerMetre) {
  const decade = 10 ** Math.floor(Math.log10(100 / pixelsPerMetre));
  const metres = decade * [5, 2, 1].find(f => f * decade * pixelsPerMetre <= 100.001);
  return {pixels: metres * pixelsPerMetre, text: `${metres >= 0.01 && metres < 1e4 ? +metres.toPrecision(1) : metres.toExponential(0).replace('+', '')} m`};
}
function drawScale({context, scale, height}, style) {
  const {pixels, text} = scaleBar(scale);
  context.strokeStyle = context.fillStyle = style.getPropertyValue('--ink');
  context.lineWidth = 1.5;
  tracePath(context, [[10, height - 16], [10, height - 10], [10 + pixels, height - 10], [10 + pixels, height - 16]]);
  context.stroke();
  context.font = '12px system-ui, "DejaVu Sans", sans-serif';
  context.fillText(text, 10, height - 20);
}
