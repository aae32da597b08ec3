#!/usr/bin/env bash
# Experiments, scenes and robots that are run; configurations recorded from them; their frames.
. "$(dirname "$0")/prelude.sh"
cp "$source_folder"/cli/tests/scenes/* "$folder"
can=$folder/can.json cart=$folder/cart.urdf pedestal=$folder/pedestal.json

# Experiments.
expect 2 'must be one of standing, ' simulate juggling
expect 2 '--step.*from 1e-05 to 0.1' simulate rolling --step 0
expect 2 '--workers' simulate rolling --workers 0
expect 2 '--out' simulate rolling --out /proc/none
# What is given twice counts once.
expect 0 'reference  *=' simulate rolling rolling --candidates reference,reference --step 0.01,0.01
[ "$(grep -c '^ *reference ' <<<"$printed")" = 1 ] || failed "$ran: an experiment twice"
expect 0 '"exact":true' simulate rolling --candidates reference --step 0.01 --json --out "$folder/simulated"
grep -q '"rolling"' "$folder/simulated/experiments.json" || failed "no experiments.json"
expect 0 'ode+touchstone' simulate lying --engine ode --out "$folder/simulated"
grep -q '"cure"' "$folder/simulated/engines.json" || failed "no engines.json"
expect 2 '--engine.*must be one of bullet, ' simulate lying --engine havok
expect 2 'must be one number with --engine' simulate lying --engine ode --step 0.01,0.02
expect 2 '^error: --candidates is given with --engine: must stand without it' simulate lying --engine ode --candidates bullet
expect 2 'is given with --.*: must stand without it' simulate lying --engine ode --record "$folder/recorded.jsonl"

# What belongs to experiments alone, to scenes alone, to a recording alone.
expect 2 '^error: --disturbance is given: must be with scene files, robots or worlds' simulate rolling --disturbance 2
expect 2 '^error: --drive is given: must be with scene files, robots or worlds' simulate rolling --drive wheel=1
expect 2 '^error: --step is given: must be with experiments, not with scene files' simulate "$pedestal" --step 0.01
expect 2 '^error: --count is given: must stand beside --record' simulate "$pedestal" --count 5
expect 2 '^error: --seed is given: must stand beside --record or --disturbance' simulate "$pedestal" --seed 5
expect 2 '--record.*needs scene files' simulate --record "$folder/recorded.jsonl"
expect 2 '--record' simulate "$can" --record /proc/none/recorded.jsonl
expect 2 'is given with --record: must stand without it' simulate "$can" --record "$folder/r.jsonl" --out "$folder"
for name in robot.urdf ./scene.json "$folder/none.urdf"; do
  expect 2 "^error: scene is \"$name\": could not be opened for reading" simulate "$name"
done
expect 2 'scene.*could not be opened' simulate "$folder/none.json" --record "$folder/recorded.jsonl"

# Scenes.
expect 0 . simulate "$pedestal"
as_written=$(tail -n 1 <<<"$printed")
expect 0 . simulate "$pedestal" --disturbance 0
[ "$(tail -n 1 <<<"$printed")" = "$as_written" ] || failed "disturbance 0 is not the scene as it is written"
expect 0 '^pedestal, capsule, disturbance 2 of seed 3$' \
  simulate "$pedestal" --candidates capsule --disturbance 2 --seed 3
# Who has no routine for a pair does not let its bodies fall through each other.
for name in fcl-distance libccd-gjk; do
  expect 2 "^error: candidate is \"$name\": must have a routine for cylinder-plane" simulate "$can" --candidates $name
  expect 2 "^error: candidate is \"$name\": must have a routine for cylinder-plane" \
    simulate "$can" --contacts $name --povray "$folder/render"
done
expect 0 'can: 3 of 72 configurations' simulate "$can" --count 3 --record "$folder/recorded.jsonl"
expect 0 '"id":"can/can and ground/' solve --candidates reference "$folder/recorded.jsonl"
id=$(sed -n 's/.*"id":"\([^"]*\)".*/\1/p' "$folder/recorded.jsonl" | head -n 1)
expect 0 'truth: signed distance' replay "$folder/recorded.jsonl" --id "$id" --candidates reference
# One thing is no plural.
sed 's/"duration":0.3/"duration":0.0042/' "$can" >"$folder/brief.json"
expect 0 ': 1 of 1 configuration near' simulate "$folder/brief.json" --count 1 --record "$folder/brief.jsonl"
# A file's name of other bytes than text, with a control character, or with one that turns the direction of what
# follows it, disturbs nothing that is printed.
odd="$folder/$(printf 'caf\xe9\x1b[2J').json" turning="$folder/$(printf 'can\xe2\x80\xaenosj').json"
cp "$folder/brief.json" "$odd"
cp "$folder/brief.json" "$turning"
expect 0 '^caf? \[2J: 1 of 1' simulate "$odd" --count 1 --record "$folder/odd.jsonl"
expect 0 '^can   nosj: 1 of 1' simulate "$turning" --count 1 --record "$folder/odd.jsonl"
sed "s/\"can\"/\"c\xe2\x80\xaen\"/" "$can" >"$folder/named.json"
expect 2 'bodies\[.*\].name is "c\\u202en": must be without characters that are not seen' simulate "$folder/named.json"

# A robot: two wheels on an axle, and what is asked of it.
expect 0 'left  *0' simulate "$cart" --duration 0.1 --drive left_wheel=3 --drive right_wheel=loose
also 'warning: .*cart.urdf: transmission t: not read'
expect 2 '^error: --drive is "left_whel": must be a joint that moves, as left_wheel, right_wheel$' \
  simulate "$cart" --drive left_whel=3
expect 2 '^error: --drive is "left_wheel": must be a joint and its rate, as in left_wheel=5$' \
  simulate "$cart" --drive left_wheel
expect 2 '^error: --drive is "fast": must be a number' simulate "$cart" --drive left_wheel=fast
expect 2 '^error: --drive is "wheel": must be given one rate, not several' \
  simulate "$cart" --drive wheel=5,wheel=loose
expect 2 '^error: --model-path is .*none": must be a folder$' simulate "$cart" --model-path "$folder/none"
# A robot in millimetres weighs too little for its size.
inertia() {
  echo "s/<link name=\"left\">/&<inertial><mass value=\"1\"\/><inertia ixx=\"1\" iyy=\"1\" izz=\"$1\"" \
    "ixy=\"0\" ixz=\"0\" iyz=\"0\"\/><\/inertial>/"
}
sed "s/radius=\"0.1\" length=\"0.05\"/radius=\"100\" length=\"50\"/; $(inertia 1)" "$cart" >"$folder/millimetres.urdf"
expect 2 '^error: .*millimetres.urdf: link left.density is .*: are these in kilograms and metres?' \
  simulate "$folder/millimetres.urdf"
# An inertia that no body can have is named; the run goes on.
sed "$(inertia 3)" "$cart" >"$folder/placeholder.urdf"
expect 0 'warning: .*link left: its inertia, of which one principal moment is larger than the sum of the others' \
  simulate "$folder/placeholder.urdf" --duration 0.1

# Frames.
expect 2 '--every' simulate "$can" --povray "$folder/frame" --every 0
expect 2 '^error: --every is given: must stand beside --povray' simulate "$can" --every 0.1
expect 2 '^error: --povray is ".*": must be with one scene file' simulate "$can" "$can" --povray "$folder/frame"
expect 2 '--contacts is "no-such-engine": must be one of reference' \
  simulate "$can" --povray "$folder/frame" --contacts no-such-engine
expect 0 '^1 frame\. ' simulate "$can" --every 1 --povray "$folder/frame"
expect 0 '4 frames' simulate "$can" --every 0.1 --povray "$folder/frames"
[ -s "$folder/frames/frame-00004.inc" ] || failed "no frame"
expect 0 '2 frames' simulate "$can" --every 0.2 --povray "$folder/frames"
[ ! -e "$folder/frames/frame-00003.inc" ] || failed "frames of an earlier run are left"

finish
