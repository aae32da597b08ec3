// Contact points: how many, against the thesis's cases, and what they cover. The thesis is the one that
// added cylinders to the pe rigid-body engine; its figures 4-6 and 16-19 and 21-28 say how many.
const thesisCases = [
  ['cylinder-plane', 'standing', 'standing on a plane', '3'],
  ['cylinder-plane', 'lying', 'lying on a plane', '2'],
  ['cylinder-plane', 'general-shallow', 'tilted on a plane', '1'],
  ['cylinder-sphere', 'general-shallow', 'a sphere anywhere', '1'],
  ['cylinder-capsule', 'parallel-side', 'a capsule alongside', '2'],
  ['cylinder-capsule', 'cap-on-side', 'a capsule across the cap', '2'],
  ['cylinder-capsule', 'perpendicular-x', 'a capsule crossed', '1'],
  ['cylinder-cylinder', 'parallel-side', 'side by side', '2'],
  ['cylinder-cylinder', 'cap-on-side', 'a side across the cap', '2'],
  ['cylinder-cylinder', 'cap-on-cap-centred', 'cap on cap, one within the other', '3'],
  ['cylinder-cylinder', 'cap-on-cap-offset', 'cap on cap, overlapping', '4'],
  ['cylinder-cylinder', 'rim-rim', 'rim on rim', '1'],
  ['cylinder-box', 'side-on-face', 'side on a face', '2'],
  ['cylinder-box', 'cap-on-face-centred', 'standing on a face', 'up to 8'],
  ['cylinder-box', 'cap-on-face-offset', 'standing over an edge', 'up to 8'],
  ['cylinder-box', 'rim-face', 'rim on a face', '1'],
];
// "2", or "1–8" where a class gives several.
function pointCounts(r) {
  const counts = Object.keys(r.points).map(Number);
  if (counts.length === 0) return 'none';
  const lo = Math.min(...counts), hi = Math.max(...counts);
  return lo === hi ? String(lo) : `${lo}–${hi}`;
}
function manifold() {
  const candidate = byId('manifold-candidate').value;
  const other = candidate === 'reference' ? candidates.find(c => c !== 'reference') : candidates.includes('reference') ? 'reference' : null;
  const compared = [candidate, ...(other ? [other] : [])];
  const rows = thesisCases.filter(([pair, poseClass]) => resultAt.has(`${pair}/${poseClass}/${candidate}`)).map(([pair, poseClass, words, points]) => {
    const name = element('th', {scope: 'row', tabindex: 0}, `${words}`);
    explain(name, `${dashed(pair)}, class ${poseClass}`);
    return element('tr', {}, name, element('td', {}, points), ...compared.flatMap(c => manifoldCells(resultAt.get(`${pair}/${poseClass}/${c}`))));
  });
  byId('manifold-table').replaceChildren(rows.length === 0 ? 'None of the thesis’s cases was run.' : table('Contact points, and mean coverage of the patch',
      [column('case', {class: 'text'}), column('thesis'), ...compared.flatMap(c => [column(named(c)), column('coverage')])], rows));
}
function manifoldCells(r) {
  if (!r || supported(r) === 0) return [element('td', {class: 'quiet'}, '–'), element('td', {class: 'quiet'}, '–')];
  const mean = quantile(r.coverage, 'mean'), points = element('td', {tabindex: 0}, pointCounts(r));
  explain(points, `${r.candidate}: ${Object.entries(r.points).map(([n, count]) => `${count} × ${n} points`).join(', ') || 'no contacts'}`);
  return [points, element('td', mean === null ? {} : {class: 'heat', style: heated(1 - mean)}, cutShare(mean))];
}
choices('manifold-candidate', candidates, manifold, candidates.find(c => c !== 'reference') || candidates[0]);
manifold();
