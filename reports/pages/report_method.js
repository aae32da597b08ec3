// How everything was measured, and what the words mean.
// Where a command's clock and ours, or its processor time, differ by more than a tenth.
function clockText(name) {
  const off = report.summary.filter(r => r.candidate === name && r.nanoseconds && r.nanoseconds.floor !== null)
      .map(r => r.nanoseconds).flatMap(t => [t.our_clock, Math.max(t.processor, 1)]).filter(x => Math.abs(x - 1) > 0.1);
  return off.length ? `; the times it gives are doubtful: by our clocks they are ${Math.min(...off).toFixed(2)} to ${Math.max(...off).toFixed(2)} times as long` : '';
}

// How it was measured.
function method() {
  byId('command').append(command(report.command));
  definitions('settings', report.candidates.map(c =>
      [named(c.name, ` ${c.version}`), c.settings + (c.models ? `; models ${c.models}` : '') + clockText(c.name)]));
  const bar = report.tolerance;
  definitions('words', [
    ['size', 'Half of the smallest width of the smaller shape; errors are relative to it (where the bar would be below 1e-13 of the larger shape, to a share of that).'],
    ['normal', 'Unit vector from B to A (the cylinder): the way A moves to come free.'],
    ['normal regret', 'How much deeper the bodies are along the reported normal than along the best one, but no more than if the larger body were a half-space that touches the smaller one, of which that feels what its circumsphere reaches: a normal on a floor costs the same however far the floor extends. It is well defined where several normals tie.'],
    ['error', 'Without more words: of an answer the larger of its depth error and its regret; of a missed contact its depth. Lost: missed, or no answer at all.'],
    ['bias', 'The median of the depth error with its sign: negative where the routine is too deep, positive where it is too shallow.'],
    ['points', 'By how much a contact’s worst point is outside a body in excess of its own depth.'],
    ['coverage', 'The largest factor by which the contact patch (where the bodies\u2019 flat and straight parts meet) may be shrunk about its centroid to lie within the hull of the contact points: 0.5 for three points evenly on a disc\u2019s rim, 0.7 for four. Of a point contact 1. Means are over contacts with a normal within the bar.'],
    ['agree', `Depth, normal regret and the depth of the deepest contact point are within ${bar} of the size, and no point is farther outside a body than its own depth by more; contacts shallower than that may be missed.`],
    ['unseen', 'No contact, though the bodies overlap, by less than the bar: it counts as agreement, but a solver feels nothing.'],
    ['missed', `No contact, though the bodies overlap by more than ${bar} of the size.`],
    ['phantom', `A contact, though they are more than ${bar} of the size further apart than was asked for.`],
    ['shallow, overdeep', 'The depth is too small, too large.'],
    ['wrong-normal', 'The depth is right; the normal is of no unit length or its regret is beyond the bar.'],
    ['no-points, shallow-points, overdeep-points, phantom-points, off-body', 'Depth and normal are right, but there is no contact point (a solver feels nothing); none is as deep as the bodies are (it feels too little); one is deeper; one is further apart than was asked for; one is farther outside a body than its depth.'],
    ['not-finite, failed, unsupported', 'A NaN or infinity in the answer; the candidate says that it could not answer; it has no routine for the pair, which does not count against it.'],
    ['crashed, timed-out', 'The candidate ended its process (a signal, an exception, too much memory), or took longer than 50 ms of processor time, unless asked otherwise; after a first time-out among up to 1,024 configurations, a hundred times its median there, at least a tenth of that. Each candidate has a process of its own.'],
    ['not-asked', 'In a pose class where the candidate had timed out three times (among up to 512 configurations), it was stopped: the further ones of these were not asked. Shares (≥) count them against it; errors are of what was asked.'],
    ['model error, solver error', 'Of a simplified model, or an engine that says how it rounds edges: the true signed distance of what it models against that of the bodies, and its answer against that of what it models. A missed contact whose model is apart is the model’s.'],
    ['time', 'Narrow phase alone, one thread, shapes prepared beforehand, candidates in random turns on the same configurations, each in its own process, which reads the clock itself: median and quartiles of repeated measurements, in each of which the classes’ median counts. p95: each configuration timed singly, with its least time; what 95% of a class keep, and of several classes the longest. Candidates whose quartiles overlap tie (~: with Bullet).'],
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
method();
listSections();
