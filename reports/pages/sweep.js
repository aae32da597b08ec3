// A cast: A as far along its sweep as a slider says.

// The configuration with A moved by the part t of its sweep, and turned by that of its spin.
function sweptTo(given, t) {
  const {position, orientation: [w, x, y, z]} = given.pose_a, angle = t * length(given.spin ?? [0, 0, 0]);
  const [c, s] = [Math.cos(angle / 2), angle ? times(given.spin, Math.sin(angle / 2) / length(given.spin)) : [0, 0, 0]];
  const q = add(add(times([x, y, z], c), s, w), cross(s, [x, y, z]));
  return {...given, pose_a: {position: add(position, given.sweep, t), orientation: [c * w - dot(s, [x, y, z]), ...q]}};
}
// The slider, at first at t, with a button for the start and each of the stops, [[name, t], …]; calls moved(t) when t changes.
function sweepControl(t, stops, moved) {
  const slider = element('input', {type: 'range', min: 0, max: 1, step: 'any', 'aria-label': 'How far A has moved, as a part of its sweep'});
  const shownPart = element('output');
  const show = to => {
    slider.value = to;
    shownPart.textContent = `${plainNumber(to)} of the sweep`;
  };
  const move = to => {
    show(to);
    moved(to);
  };
  slider.addEventListener('input', () => move(Number(slider.value)));
  show(t);
  return element('fieldset', {class: 'sweep'}, element('legend', {}, 'How far A has moved'), slider, ' ', shownPart,
      element('p', {class: 'controls'}, ...[['start', 0], ...stops].map(([name, at]) => {
        const button = element('button', {type: 'button'}, `${name} ${plainNumber(Number(at.toPrecision(4)))}`);
        button.addEventListener('click', () => move(at));
        return button;
      })));
}
