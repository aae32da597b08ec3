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
