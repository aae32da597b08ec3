#!/usr/bin/env bash
# The cheapest model that serves a scene or a robot, and what is left in the folder.
. "$(dirname "$0")/prelude.sh"
cp "$source_folder"/cli/tests/scenes/* "$folder"
can=$folder/can.json cart=$folder/cart.urdf

# What takes least.
brief=(--candidates capsule --disturbances 1)

# A scene that is none.
expect 2 'scene.*could not be opened' choose "$folder/none.json"
echo '{"duration":1,"bodies":[{"name":"a","shape":{"shape":"sphere","radius":-1}}]}' >"$folder/bad.json"
expect 2 'bodies\[0\].shape.radius is -1' choose "$folder/bad.json"
expect 2 '--depth' choose "$folder/bad.json" --depth 0
sed 's/"degrees":1/"degrees":200/' "$can" >"$folder/any.json"
expect 2 'needs\[0\].degrees is 200: must be less than 90' choose "$folder/any.json"
sed 's/"name":"can"/"name":" "/' "$can" >"$folder/nameless.json"
expect 2 'bodies\[1\].name is " ": must have a letter' choose "$folder/nameless.json"
# What only the other kind of file knows is refused, not ignored.
for option in "--depth 0.1" "--angle 3" "--count 7"; do
  # shellcheck disable=SC2086
  expect 2 "^error: ${option% *} is given with \".*can.json\": must be left out: a scene's needs" choose "$can" $option
done
expect 2 '^error: --disturbances is given with ".*cart.urdf": must be left out' choose "$cart" --disturbances 3 --count 10
expect 2 '^error: --drive is given with .*cart.urdf": must be left out: sampled poses have no motion' \
  choose "$cart" --count 1 --drive left_wheel=3
for engine in "" "--engine bullet"; do
  # shellcheck disable=SC2086
  expect 2 'must be a robot or world .* with --drive' choose "$folder/bad.json" $engine --drive left_wheel=3
done
# Of a wheel that is refused there is no rate, which nobody gave.
sed 's/radius="0.1"/radius="1e300"/' "$cart" >"$folder/huge.urdf"
expect 2 'huge.urdf: link left\.' choose "$folder/huge.urdf"
cp "$cart" "$folder/G.URDF"
for command in choose "simulate --povray out"; do
  # shellcheck disable=SC2086
  expect 2 "^error: scene is \".*G.URDF\": is XML: the name of a robot must end in .urdf" $command "$folder/G.URDF"
done

# Scenes. The command to make it again has all that was set.
mkdir "$folder/my scenes"
cp "$can" "$folder/my scenes/"
expect 0 "choose '$folder/my scenes/can.json' --candidates capsule --time-limit 9 --disturbances 16 --seed 1\"" \
  choose "$folder/my scenes/can.json" --candidates capsule --time-limit 9 --json --out "$folder/choice"
also 'can stands within 1'
[ -s "$folder/choice/choose.html" ] || failed "no choose.html"
# Neither a file's name of other bytes than text nor one with a control character disturbs what is printed.
odd="$folder/$(printf 'caf\xe9\x1b[2J').json"
cp "$can" "$odd"
expect 0 'can stands within 1' choose "$odd" "${brief[@]}" --out "$folder/odd"
# Nor does one that turns the direction of what follows it: it is shown as digits, and quoted so in commands.
turning="$folder/$(printf 'can\xe2\x80\xaenosj').json"
cp "$can" "$turning"
expect 0 'Page: .*/left\\u202ethgir/choose.html' \
  choose "$can" "${brief[@]}" --out "$folder/$(printf 'left\xe2\x80\xaethgir')"
expect 0 "choose \$'.*/can\\\\\\\\xe2\\\\\\\\x80\\\\\\\\xaenosj.json' --cand" \
  choose "$turning" "${brief[@]}" --json --out "$folder/odd"

# What an earlier choice left is not taken for this one's.
sed 's/"degrees":1/"degrees":1e-30/; s/0.2\]}/0.2],"orientation":[1,0.1,0,0]}/' "$can" >"$folder/fall.json"
mkdir -p "$folder/choice/choose"
touch "$folder/choice/choose/"{fall-99,cart-99-capsule,mine}.json
expect 1 'Not even exact contacts meet the needs of this scene' \
  choose "$folder/fall.json" "${brief[@]}" --out "$folder/choice"
"$program" choose "$cart" --depth 1 --angle 90 --count 2 --candidates capsule --out "$folder/choice" >/dev/null 2>&1
left=$(cd "$folder/choice" && ls -1 choose.* choose/*99* choose/mine.json 2>/dev/null | tr '\n' ' ')
[ "$left" = "choose.json choose/mine.json " ] || failed "of earlier choices there is $left"

# Robots: in motion, and by sampled poses.
expect 0 'left and ground' choose "$cart" --duration 0.1 "${brief[@]}" --out "$folder/cart"
# Its wheels roll, also in the command that makes a run again; of a robot without wheels the joints are named.
also '; driven: left_wheel=3.14, right_wheel=3.14$'
expect 0 "simulate [^ ]*cart.urdf --drive 'left_wheel=3.14,right_wheel=3.14' --duration 0.1 --povray out/render --contacts" \
  choose "$cart" --duration 0.1 "${brief[@]}" --json --out "$folder/cart"
expect 0 '; driven: left_wheel=0$' choose "$cart" --drive left_wheel=0 --duration 0.1 "${brief[@]}" --out "$folder/cart"
sed 's/type="continuous"/type="revolute"/; s/<axis xyz="0 0 1"\/>/&<limit lower="-1" upper="1" effort="9" velocity="9"\/>/' \
  "$cart" >"$folder/legs.urdf"
expect 0 '; no joint is driven, and what rests needs$' \
  choose "$folder/legs.urdf" --duration 0.1 "${brief[@]}" --out "$folder/cart"
also '^little: see --drive, of left_wheel, right_wheel$'
expect 0 'cylinder .* on cylinder ' choose "$cart" --count 5 --candidates reference --out "$folder/cart"
also "^Data: $folder/cart/choose.json"
driven=(choose "$cart" --engine bullet --duration 0.1 --disturbances 1 --drive left_wheel=3 --out "$folder/cart")
expect 0 '^cart in bullet 3' "${driven[@]}"
expect 0 "cart.urdf --drive 'left_wheel=3' --duration 0.1 --engine bullet --disturbances 1 --seed 1\"" "${driven[@]}" --json
expect 2 '^error: --engine is "unity": must be one of bullet' choose "$cart" --engine unity --duration 0.1
# What an engine's world does not have is named before anything is run.
expect 2 'must not be there with --engine: the world of mujoco has trees of joints' \
  choose "$folder/loop.sdf" --engine mujoco
sed 's/<cylinder radius="0.1" length="0.05"/<sphere radius="0.1"/' "$cart" >"$folder/balls.urdf"
expect 2 'must have a cylinder that moves and touches something: see --drive' \
  choose "$folder/balls.urdf" --duration 0.1 "${brief[@]}" --out "$folder/cart"

# The command that choose.json has for a run that breaks a need makes that run again: the tilt of the can is
# the one that was measured. As it is written the can balances on the pole of its capsule.
expect 0 'simulate .*pedestal.json --povray out/render --contacts capsule --disturbance [0-9]* --seed 3$' \
  choose "$folder/pedestal.json" --candidates capsule --seed 3 --out "$folder/again"
page_data "$folder/again/choose.html" >"$folder/again/page.json"
python3 - "$program" "$folder/again" <<'END' || failed "a run that breaks a need is not made again"
import json, math, pathlib, re, shlex, subprocess, sys
program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
choice = json.loads((folder / "choose.json").read_text())
run = next(r for r in choice["runs"] if r["name"] == "capsule")
assert not run["holds"] and run["disturbance"] > 0, run
command = shlex.split(run["render"])
assert command[0] == "./touchstone" and run["render"] in (folder / "page.json").read_text()
command[command.index("--povray") + 1] = folder / "frames"
subprocess.run([program, *command[1:], "--every", str(choice["scene"]["step"])], check=True, stdout=subprocess.DEVNULL)
verdict, largest, first = run["verdicts"][0], 0, None
for i, frame in enumerate(sorted((folder / "frames").glob("frame-*.inc"))):
    axis_z = float(re.findall(r"matrix <(.*)>", frame.read_text())[1].split(",")[8])
    tilt = math.degrees(math.acos(min(1, abs(axis_z))))
    largest = max(largest, tilt)
    if first is None and tilt > verdict["limit"]: first = i * choice["scene"]["step"]
# Frames have nine digits.
if abs(largest - verdict["value"]) > 1e-5 or abs(first - verdict["time"]) > 1e-9:
    sys.exit(f"{run['render']} leans by {largest}, {first} s, not {verdict}")
END

finish
