// How it was measured.
function method() {
  byId('command').append(command(report.command));
  definitions('settings', report.candidates.map(c =>
      [named(c.name, ` ${c.version}`), c.settings + (c.models ? `; models ${c.models}` : '')]));
  const bar = report.tolerance;
  definitions('words', [
    ['size', 'Half of the smallest width of the smaller shape; errors are relative to it (where the bar would be below 1e-13 of the larger shape, to a share of that).'],
    ['normal', 'Unit vector from B to A (the cylinder): the way A moves to come free.'],
    ['normal regret', 'How much deeper the bodies are along the reported normal than along the best one. It is well defined where several normals tie.'],
    ['error', 'Without more words: of an answer the larger of its depth error and its regret; of a missed contact its depth. Lost: missed, or no answer at all.'],
    ['coverage', 'The largest factor by which the contact patch (where the bodies\u2019 flat and straight parts meet) may be shrunk about its centroid to lie within the hull of the contact points: 0.5 for three points evenly on a disc\u2019s rim, 0.7 for four. Of a point contact 1. Means are over contacts with a normal within the bar.'],
    ['agree', `Depth and normal regret within ${bar} of the size; contacts shallower than that may be missed.`],
    ['missed', `No contact, though the bodies overlap by more than ${bar} of the size.`],
    ['phantom', `A contact, though they are more than ${bar} of the size further apart than was asked for.`],
    ['shallow, overdeep', 'The depth is too small, too large.'],
    ['wrong-normal', 'The depth is right; the normal is of no unit length or its regret is beyond the bar.'],
    ['shallow-points, overdeep-points, phantom-points', 'Depth and normal are right, but no contact point is as deep as the bodies are (a solver feels too little, or nothing); one is deeper; one is further apart than was asked for.'],
    ['not-finite, failed, unsupported', 'A NaN or infinity in the answer; the candidate says that it could not answer; it has no routine for the pair, which does not count against it.'],
    ['crashed, timed-out', 'The candidate ended its process (a signal, an exception, too much memory), or took longer than 50 ms of processor time, unless asked otherwise. Each candidate has a process of its own.'],
    ['model error, solver error', 'Of a simplified model: the true signed distance of what it models against that of the cylinder, and its answer against that of what it models.'],
    ['time', 'Narrow phase alone, one thread, shapes prepared beforehand, candidates in random turns on the same configurations, each in its own process, which reads the clock itself: median and quartiles of repeated measurements, in each of which the classes’ median counts. Candidates whose quartiles overlap tie (~: with Bullet).'],
  ]);
  const m = report.machine, o = report.oracle_microseconds;
  definitions('machine', [
    ['machine', `${m.cpu}, ${m.cores} cores, ${m.os}`],
    ['compiler', m.compiler],
    ['seed', String(report.seed)],
    ['oracle', o === null ? '–' : `median ${whole(o.median)} µs, 99th percentile ${whole(o.p99)} µs per configuration`],
    ['run', `${whole(report.wall_seconds)} s`],
  ]);
}
// Links to the sections there are.
function contents() {
  byId('contents').append(...[...document.querySelectorAll('main > section')].filter(s => !s.hidden)
      .map(s => element('a', {href: `#${s.id}`}, s.querySelector('h2').textContent)));
}
method();
contents();
