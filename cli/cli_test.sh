#!/usr/bin/env bash
# Runs the program as a person does: cli_test.sh PROGRAM.
set -u
unset COLUMNS
program=$(readlink -f "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

# expect CODE PATTERN ARGUMENTS…: exit code, and a pattern in what is printed.
expect() {
  local code=$1 pattern=$2 printed actual
  shift 2
  printed=$("$program" "$@" 2>&1 </dev/null)
  actual=$?
  if [ "$actual" -ne "$code" ] || ! grep -q -e "$pattern" <<<"$printed"; then
    echo "FAILED: touchstone $*: exit code $actual, expected $code with \"$pattern\":"
    echo "$printed" | head -n 5
    failures=$((failures + 1))
  fi
}

expect 0 'touchstone report' --help
expect 0 'Examples' report --help
expect 0 '^touchstone [0-9]' --version
expect 0 '^engines: .*bullet 3' --version
expect 0 '^libraries: CGAL 5.*, GMP .*, MPFR .*, FLINT .*, Arb .*, Eigen 3' --version
expect 2 '--completion.*bash or zsh' --completion fish
expect 0 '^\.TH touchstone 1' --manual
expect 0 'bullet 3' candidates
expect 2 '^error: subcommand is missing: must be one of report, replay, '
# Usage errors name what was given and the remedy, as all others do.
expect 2 '^error: option is "--cout": must be an option of touchstone report, as --count, .*--help' report --cout 3
expect 2 '^error: option is "--candidats=x": must be .* as --candidates, ' replay --candidats=x
expect 2 '^error: option is "--nosuch"' --nosuch
expect 2 '^error: option is "--laod": .* as --load, ' candidates --laod x.so
expect 2 '^error: argument is "more": must be left out: touchstone replay takes IDENTITY and ' \
  replay cylinder-box/rim-face/1/2 more
expect 2 '^error: argument is "more": must be left out: touchstone candidates takes no more than its name' candidates more
expect 2 '^error: argument is "bullet": must follow an option, as --candidate bullet' check bullet
expect 2 '^error: argument is "bullet": must follow an option, as --candidates bullet' report bullet
expect 2 '^error: subcommand is "help": must be one of report, .*; touchstone --help says what they do' help
expect 2 '^error: --seed is given no value: must be followed by UINT: Same seed' report --seed
expect 2 '^error: --candidates is given no value: must be followed by CANDIDATE' solve --candidates
expect 2 '^error: --load is given no value: must be followed by FILE' --load
expect 2 '^error: --seed is given 2 times: must be given once' report --seed 1 --seed 2
# A shell's variable that is not set: not a run without the option.
for option in '--junit' '--save' '--corpus' '--known'; do
  expect 2 "^error: $option is \"\": must be left out or have a value\$" check --candidate reference "$option" ''
done
expect 2 '^error: --shard is "": must be left out or' campaign --count 1 --shard '' --out "$folder/none"
expect 2 '^error: pair is "": must be left out or' classes ''
# Failures that could not be saved are known before they are looked for.
for command in check search; do
  expect 2 '^error: --save is "/proc/none": must be a folder that can be written to$' $command --candidate reference --save /proc/none
done
expect 2 '^error: --hostile is given a value: must stand alone' check --hostile=bullet
expect 2 '^error: --hostile is given a value: must stand alone' check --hostile=7
expect 2 '^error: --json is given a value: must stand alone' replay cylinder-box/rim-face/1/2 --json=false
expect 2 'report, replay, solve, certify, check, compare, ' nonsense
expect 2 'identity.pair' replay cylinder-cone/rim/1/2
expect 2 'identity.class' replay cylinder-box/none/1/2
expect 2 '^error: input is missing: must be given: pair/class/seed/index' replay
expect 2 'nosuch.json.*no such file' replay nosuch.json
expect 0 'touchstone report --candidates reference' candidates --help
expect 0 '^reference  *contact  *agree ' replay cylinder-box/rim-face/1/2
# One line for each candidate comes first; lines of JSON alone, which come last, are longer than a terminal.
shown=$("$program" replay cylinder-box/rim-face/1/2)
[ "$(sed -n 4p <<<"$shown" | cut -c 1-9)" = candidate ] || { echo "FAILED: replay begins with $shown"; failures=$((failures + 1)); }
if grep -v '^{' <<<"$shown" | awk 'length($0) > 80 { exit 1 }'; then :; else
  echo "FAILED: replay is wider than 80 columns"
  failures=$((failures + 1))
fi
expect 2 'must be one of reference, bullet, ' replay cylinder-box/rim-face/1/2 --candidates no-such-engine
expect 2 'prism:1.* must be' replay cylinder-box/rim-face/1/2 --candidates prism:1
expect 0 'prism:32: ' replay cylinder-box/rim-face/1/2 --candidates prism:8,16,32
expect 2 'must be a plug-in' --load /etc/passwd candidates
echo '{}' >"$folder/p.json"
expect 2 'p.json": must be a plug-in, which is a shared object (.so), or a list of commands, .*\.txt' \
  --load "$folder/p.json" candidates
expect 2 '^error: --candidate is ".*p.json": must be a plug-in' check --candidate "$folder/p.json"
printf '\xef\xbb\xbf# nothing but a byte order mark\n' >"$folder/empty.txt"
expect 2 '^error: --load is ".*empty.txt": must list a command' --load "$folder/empty.txt" candidates
expect 2 '^error: --candidate is ".*empty.txt": must list a command' check --candidate "$folder/empty.txt"
expect 2 '^error: --candidate is "bullet,ode": must be one name, not a list' check --candidate bullet,ode
expect 2 '^error: --candidate is "bulet": must be one of reference, ' search --candidate bulet
for name in ./nope.so nope.so; do
  expect 2 "^error: --candidate is \"$name\": must be a file that is there, or a name that" check --candidate $name
  expect 2 "^error: --candidates is \"$name\": must be a name; a plug-in's file is given by --load" solve --candidates $name
done
# A class and a group that have nothing in common leave nothing to do: no empty result, no "interrupted".
for command in "check --candidate bullet" "search --candidate bullet" stability export report campaign; do
  # shellcheck disable=SC2086
  expect 2 '^error: --group is "everyday": must be of these pose classes, which are degenerate' \
    $command --group everyday --class lying
done
expect 2 '^error: --hostile is given with --group: must stand without it\|^error: --group is given with --hostile' \
  check --candidate bullet --hostile --group everyday
# Input that does not end.
expect 2 '^error: --corpus is "/dev/zero": must have at most 134217728 bytes' check --corpus /dev/zero
expect 2 'line 1 is without an end: must have at most 1048576 bytes' solve /dev/zero
expect 2 'line 1 is without an end' score /dev/zero --name mine --out "$folder/given"
for command in replay certify choose "check --corpus" merge "compare /dev/zero"; do
  # shellcheck disable=SC2086
  expect 2 '^error: .*/dev/zero.* must ' $command /dev/zero
done
expect 2 '^error: input is ".*": must be a file, not a folder' replay "$folder"
expect 2 '--time-limit' solve --time-limit 0
expect 2 '--tolerance' replay cylinder-box/rim-face/1/2 --tolerance=-1
expect 0 'reference: contact, agree' replay cylinder-box/rim-face/1/2
expect 0 '"id":"cylinder-box/rim-face/1/2"' replay cylinder-box/rim-face/1/2 --json
expect 0 'reference: contact' replay cylinder-box/rim-face/1/2 --html "$folder/page.html"
grep -q 'cylinder-box/rim-face/1/2' "$folder/page.html" || { echo "FAILED: no page"; failures=$((failures + 1)); }
expect 2 '--html.*must be a folder that can be written' replay cylinder-box/rim-face/1/2 --html /proc/none/page.html
expect 2 '--html.*must be a file, not a folder' replay cylinder-box/rim-face/1/2 --html "$folder"
expect 2 '--junit.*must be a folder that can be written' check --candidate reference --count 1000000 --junit /proc/none/x.xml
expect 0 'reference: contact' replay <("$program" replay cylinder-box/rim-face/1/2 --json) --candidates reference
expect 2 'could not be opened' solve "$folder/none.jsonl"
expect 2 '--width' solve --width 0
# A list takes one argument: what follows is another.
echo '{"a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":1}}' >"$folder/one.jsonl"
expect 0 '"reference":{' solve --candidates reference "$folder/one.jsonl"
# Test data for others, and the answers of others.
lying="--pair cylinder-plane --class lying"
# shellcheck disable=SC2086
expect 0 '^2 configurations: ' export $lying --count 2 --out "$folder/truth.csv"
[ "$(grep -c '^cylinder-plane/lying/1/[01],degenerate,' "$folder/truth.csv")" = 2 ] ||
  { echo "FAILED: export writes other configurations"; failures=$((failures + 1)); }
# shellcheck disable=SC2086
expect 0 '"id":"cylinder-plane/lying/1/1"' export $lying --count 2
expect 2 '--out is ".*/truth.txt": must end in .jsonl, .csv or .npz' export --out "$folder/truth.txt"
expect 2 '--format is "xml": must be one of' export --format xml
expect 2 '--suite' export --suite --count 3
# shellcheck disable=SC2086
expect 2 '--out.*No space left' export $lying --count 1 --format csv --out /dev/full
printf '{"id":"cylinder-plane/lying/1/0","status":"none"}\nno JSON\n' >"$folder/given.jsonl"
expect 2 'line 2: line is no JSON' score "$folder/given.jsonl" --name mine --out "$folder/given"
grep -q '"configurations": 1,' "$folder/given/report.json" ||
  { echo "FAILED: score loses what is good beside a bad line"; failures=$((failures + 1)); }
sed -i 2d "$folder/given.jsonl"
expect 0 'cylinder-plane, degenerate poses' score "$folder/given.jsonl" --name mine --out "$folder/given"
expect 2 '--name is missing' score "$folder/given.jsonl" --out "$folder/given"
: >"$folder/none.jsonl"
expect 2 'none.jsonl": must have a line that is an answer, as {"id"' score "$folder/none.jsonl" --name mine \
  --out "$folder/given"
rm "$folder/none.jsonl"
expect 2 'missing for 5105 configurations' score "$folder/given.jsonl" --name mine --suite --out "$folder/given"
expect 2 'could not be opened' score "$folder/none.jsonl" --out "$folder/given"
expect 2 '--count' report --count 0
expect 2 '--only is "speed": must be of scores' report --only speed
plane="--pair cylinder-plane --class lying --count 1 --candidates reference --out $folder/only"
for only in scores timing stability experiments; do
  # shellcheck disable=SC2086
  expect 0 '^1 configuration, ' report $plane --only $only
  for part in '"ratio_to_bullet"' '"amplification"' '"experiments": {'; do
    case $only:$part in timing:*ratio* | stability:*ampl* | experiments:*expe*) wanted=0 ;; *) wanted=1 ;; esac
    grep -q "$part" "$folder/only/report.json"
    [ $? -eq $wanted ] || { echo "FAILED: report --only $only, $part"; failures=$((failures + 1)); }
  done
done
expect 2 '--pair.*cylinder-box' report --pair cylinder-cone
expect 2 '--class' report --class nowhere --out "$folder/r"
expect 2 '--out' report --out /proc/none
expect 0 'report.html' report --pair cylinder-plane --count 1 --out "$folder/a b"
[ -s "$folder/a b/report.html" ] || { echo "FAILED: no report.html"; failures=$((failures + 1)); }
expect 0 '^1 configuration, ' report --pair cylinder-plane,cylinder-plane --class lying,lying --count 1 \
  --candidates reference --out "$folder/twice"


expect 2 '--count' campaign --count 1.5e0 --out "$folder/c"
expect 2 '--shard.*3/7' campaign --shard 8/7 --out "$folder/c"
expect 0 '^4 configurations' campaign --pair cylinder-sphere --class cap,side --count 2e0 \
  --candidates reference --out "$folder/c"
expect 2 'already holds a campaign, in shard-.*jsonl: ./touchstone campaign .*--class cap,side.*choose another folder' \
  campaign --out "$folder/c"
expect 2 'already holds a campaign, in shard-.*choose another folder' merge "$folder/c" --out "$folder/c"
expect 0 '^4 configurations' merge "$folder/c" --out "$folder/m"
expect 2 'could not be opened' merge "$folder/none" --out "$folder/n"
expect 2 'campaign.json" is the result of a campaign: must be a shard file' merge "$folder/m/campaign.json" --out "$folder/n"
expect 2 '^error: --candidate is missing: must be given: Its name' search
expect 1 'shallow\|overdeep\|missed' search --candidate capsule --pair cylinder-sphere \
  --class general-deep --count 40 --save "$folder/found"
expect 0 'as expected' check --corpus "$folder/found"
expect 0 'capsule: contact, \|capsule: none, ' replay "$(ls "$folder"/found/*.json | head -n 1)" --candidates capsule

expect 2 'must be one of standing, ' simulate juggling
for name in robot.urdf ./scene.json; do
  expect 2 "^error: scene is \"$name\": could not be opened for reading" simulate $name
done
expect 2 '--step.*from 1e-05 to 0.1' simulate rolling --step 0
expect 2 '--workers' simulate rolling --workers 0
expect 2 '--out' simulate rolling --out /proc/none
expect 0 'reference  *=' simulate rolling --candidates reference --step 0.01
expect 0 '"exact":true' simulate rolling --candidates reference --step 0.01 --json --out "$folder/simulated"
grep -q '"rolling"' "$folder/simulated/experiments.json" || { echo "FAILED: no experiments.json"; failures=$((failures + 1)); }
expect 0 'ode+touchstone' simulate lying --engine ode --out "$folder/simulated"
expect 2 '--engine.*must be one of bullet, ' simulate lying --engine havok
expect 2 'must be one number with --engine' simulate lying --engine ode --step 0.01,0.02
expect 2 'no choice of --candidates' simulate lying --engine ode --candidates bullet
expect 2 'is given with --.*: must stand without it' simulate lying --engine ode --record "$folder/recorded.jsonl"
grep -q '"cure"' "$folder/simulated/engines.json" || { echo "FAILED: no engines.json"; failures=$((failures + 1)); }
expect 2 '^error: --candidate is missing: must be given: a name, as bullet' check
# What is given twice counts once.
[ "$("$program" check --candidate reference --pair cylinder-sphere --class cap,cap --count 1 \
  --law agreement,agreement | grep -c agreement)" = 1 ] ||
  { echo "FAILED: check --law agreement,agreement"; failures=$((failures + 1)); }
[ "$("$program" simulate rolling rolling --candidates reference,reference --step 0.01,0.01 |
  grep -c '^ *reference ')" = 1 ] || { echo "FAILED: simulate rolling rolling"; failures=$((failures + 1)); }
expect 2 '--law.*agreement' check --candidate bullet --law gravity
expect 2 '--class' check --candidate bullet --class nowhere
expect 2 '--corpus.*must be a folder' check --corpus "$folder/none"
expect 2 'must have a routine for a pair' check --candidate libccd-gjk --pair cylinder-plane --count 1
expect 0 'no routine: no law was tried' check --candidate libccd-gjk --pair cylinder-plane,cylinder-sphere \
  --class general --count 1 --law answers --junit "$folder/none.xml"
grep -q 'skipped="1"' "$folder/none.xml" || { echo "FAILED: not skipped in JUnit"; failures=$((failures + 1)); }
expect 1 'missed *: wrong by [0-9.e-]* of the smaller size' check --candidate box-spheres:8 --class rim-face \
  --count 1 --law agreement
expect 0 'agreement .* passed' check --candidate reference --pair cylinder-sphere --count 1
expect 1 'broken by' check --candidate bullet --pair cylinder-box --class edge-cap --count 1 \
  --law agreement --save "$folder/corpus" --junit "$folder/junit.xml"
# --json prints, everywhere; a file is the shell's.
"$program" check --candidate bullet --pair cylinder-box --class edge-cap --count 1 --law agreement --json \
  --save "$folder/corpus" --corpus "$folder/corpus" >"$folder/check.json"
expect 2 '^error: argument is "check.json": must be left out; --json prints on standard output.*> check.json' \
  check --candidate bullet --json check.json
"$program" search --candidate capsule --pair cylinder-sphere --class general-deep --count 4 --json |
  python3 -m json.tool >"$folder/found.json" || { echo "FAILED: search --json is no JSON"; failures=$((failures + 1)); }
expect 0 'as expected' check --corpus "$folder/corpus"
# A distance of exactly -2 is written so, whichever side of it the proven bounds lie.
expect 1 'truth: signed distance -2 m' check --candidate bullet --pair cylinder-sphere --class concentric \
  --count 1 --law agreement
expect 0 'bullet: .*missed\|bullet: contact, shallow' replay "$(ls "$folder"/corpus/*.json | head -n 1)" --candidates bullet
sed -i 's/"missed"/"overdeep"/; s/"shallow"/"overdeep"/' "$folder"/corpus/*.json
expect 1 'changed' check --corpus "$folder/corpus"
echo '{' > "$folder/corpus/broken.json"
expect 2 'broken.json' check --corpus "$folder/corpus"
# Known failures are expected, new ones are not; a fixed one is told; what cannot be asked fails the run.
rm -r "$folder/corpus"
edges=(check --candidate bullet --pair cylinder-box --class edge-cap,edge-side --count 3 --law agreement)
expect 1 'start with the first' "${edges[@]}" --save "$folder/known"
expect 0 'causes of failures are known' "${edges[@]}" --known "$folder/known"
expect 0 'as expected' check --known "$folder/known"
cp -r "$folder/known" "$folder/less" && rm "$(ls "$folder"/less/*.json | head -n 1)"
expect 1 'broken by' "${edges[@]}" --known "$folder/less" --junit "$folder/less.xml"
grep -q 'failures="1"' "$folder/less.xml" || { echo "FAILED: JUnit XML of a new failure"; failures=$((failures + 1)); }
cp -r "$folder/known" "$folder/other" && sed -i 's/"candidate": "bullet"/"candidate": "reference"/' "$folder"/other/*.json
expect 0 'fixed  *reference' check --known "$folder/other" --junit "$folder/fixed.xml"
grep -q 'failures="0"' "$folder/fixed.xml" || { echo "FAILED: JUnit XML of a fixed failure"; failures=$((failures + 1)); }
expect 1 'broken by' "${edges[@]}" --known "$folder/other"
sed -i 's/"candidate": "reference"/"candidate": "no-such-engine"/' "$folder"/other/*.json
expect 1 'skipped  *no-such-engine' check --known "$folder/other"
expect 1 'candidate is not installed' check --known "$folder/other"
expect 0 'skipped  *no-such-engine' check --corpus "$folder/other"
expect 0 'candidate is not installed' check --corpus "$folder/other"
expect 2 '--known.*must be a folder' check --known "$folder/none"
# A plug-in's file names its first candidate, and a known name comes before a file of that name.
plugin=$(dirname "$program")/candidates/testing/touchstone-sabotage.so
expect 1 '^misdeed:[0-9]* 1, seed' check --candidate "$plugin" --pair cylinder-sphere --class cap --count 1 \
  --law agreement --save "$folder/engine" --junit "$folder/engine.xml"
expect 1 'as expected  misdeed:' check --candidate "$plugin" --corpus "$folder/engine" \
  --pair cylinder-sphere --class cap --count 1 --law agreement
# What is not finite is named; a line has no blanks at its end.
expect 1 '^  answer: signed distance .* normal \[nan,' --load "$plugin" check --candidate misdeed:11 \
  --pair cylinder-sphere --class cap --count 1 --law answers
"$program" check --candidate reference --pair cylinder-sphere --class cap --count 1 --law answers | grep ' $' &&
  { echo "FAILED: check prints blanks at the end of a line"; failures=$((failures + 1)); }
touch "$folder/bullet"
pushd "$folder" >/dev/null || exit 1
expect 0 'agreement .* passed' check --candidate bullet --pair cylinder-sphere --class cap --count 1 \
  --law agreement
popd >/dev/null || exit 1
python3 - "$folder" <<'END' || { echo "FAILED: JUnit XML or JSON of check"; failures=$((failures + 1)); }
import json, sys, xml.etree.ElementTree as tree
suite = tree.parse(sys.argv[1] + "/junit.xml").getroot()[0]
assert suite.get("failures") == "1" and suite[0][0].tag == "failure"
assert suite[0].get("classname") == "bullet.cylinder-box"
assert 0 < float(suite[0].get("time")) <= float(suite.get("time"))
plugin = tree.parse(sys.argv[1] + "/engine.xml").getroot()[0]
assert plugin[0].get("classname").startswith("misdeed:"), plugin[0].get("classname")
assert json.load(open(sys.argv[1] + "/check.json"))["laws"][0]["broken"] == 1
END

expect 2 'scene.*could not be opened' choose "$folder/none.json"
echo '{"duration":1,"bodies":[{"name":"a","shape":{"shape":"sphere","radius":-1}}]}' > "$folder/bad.json"
expect 2 'bodies\[0\].shape.radius is -1' choose "$folder/bad.json"
expect 2 '--depth' choose "$folder/bad.json" --depth 0
# A robot: two wheels on an axle, and what is asked of it.
cat > "$folder/cart.urdf" <<'URDF'
<robot name="cart"><link name="base"><collision><origin xyz="0 0 0.1"/><geometry><box size="0.2 0.2 0.02"/></geometry></collision></link>
<joint name="left_wheel" type="continuous"><parent link="base"/><child link="left"/><origin xyz="0 0.2 0" rpy="-1.5708 0 0"/><axis xyz="0 0 1"/></joint>
<link name="left"><collision><geometry><cylinder radius="0.1" length="0.05"/></geometry></collision></link>
<joint name="right_wheel" type="continuous"><parent link="base"/><child link="right"/><origin xyz="0 -0.2 0" rpy="-1.5708 0 0"/><axis xyz="0 0 1"/></joint>
<link name="right"><collision><geometry><cylinder radius="0.1" length="0.05"/></geometry></collision></link>
<transmission name="t"/></robot>
URDF
expect 0 'left  *0' simulate "$folder/cart.urdf" --duration 0.1 --drive left_wheel=3 --drive right_wheel=loose
expect 0 'warning: .*cart.urdf: transmission t: not read' simulate "$folder/cart.urdf" --duration 0.1
expect 0 'left and ground' choose "$folder/cart.urdf" --duration 0.1 --disturbances 1 --candidates capsule --out "$folder/cart"
expect 0 'cylinder .* on cylinder ' choose "$folder/cart.urdf" --count 5 --candidates reference --out "$folder/cart"
expect 2 '^error: --drive is "left_whel": must be a joint that moves, as left_wheel, right_wheel$' \
  simulate "$folder/cart.urdf" --drive left_whel=3
expect 2 '^error: --drive is "left_wheel": must be a joint and its rate, as in left_wheel=5$' \
  simulate "$folder/cart.urdf" --drive left_wheel
expect 2 '^error: --drive is "fast": must be a number' simulate "$folder/cart.urdf" --drive left_wheel=fast
expect 2 '^error: --model-path is .*none": must be a folder$' simulate "$folder/cart.urdf" --model-path "$folder/none"
expect 2 'must be a robot or world .* with --drive' choose "$folder/bad.json" --drive left_wheel=3
expect 2 'must be a robot or world .* with --drive' choose "$folder/bad.json" --engine bullet --drive left_wheel=3
expect 2 '^error: --drive is "wheel": must be given one rate, not several' simulate "$folder/cart.urdf" --drive wheel=5,wheel=loose
expect 0 '^cart in bullet 3' \
  choose "$folder/cart.urdf" --engine bullet --duration 0.1 --disturbances 1 --drive left_wheel=3 --out "$folder/cart"
expect 0 "cart.urdf --drive 'left_wheel=3' --duration 0.1 --engine bullet --disturbances 1 --seed 1\"" \
  choose "$folder/cart.urdf" --engine bullet --duration 0.1 --disturbances 1 --drive left_wheel=3 --json --out "$folder/cart"
expect 2 '^error: --engine is "unity": must be one of bullet' choose "$folder/cart.urdf" --engine unity --duration 0.1
# What an engine's world does not have is named before anything is run.
cat >"$folder/loop.sdf" <<'SDF'
<sdf version="1.7"><model name="loop">
<link name="a"><collision name="a"><geometry><cylinder><radius>0.1</radius><length>0.2</length></cylinder></geometry></collision></link>
<link name="b"><pose>1 0 0 0 0 0</pose><collision name="b"><geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link>
<joint name="one" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>
<joint name="two" type="revolute"><parent>world</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>
<joint name="three" type="revolute"><parent>world</parent><child>a</child><axis><xyz>0 0 1</xyz></axis></joint>
</model></sdf>
SDF
expect 2 'must not be there with --engine: the world of mujoco has trees of joints' choose "$folder/loop.sdf" --engine mujoco
# A robot in millimetres weighs too little for its size.
sed 's/radius="0.1" length="0.05"/radius="100" length="50"/; s/<link name="left">/&<inertial><mass value="1"\/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"\/><\/inertial>/' \
  "$folder/cart.urdf" >"$folder/millimetres.urdf"
expect 2 '^error: .*millimetres.urdf: link left.density is .*: are these in kilograms and metres?' \
  simulate "$folder/millimetres.urdf"
# An inertia that no body can have is named; the run goes on.
sed 's/<link name="left">/&<inertial><mass value="1"\/><inertia ixx="1" iyy="1" izz="3" ixy="0" ixz="0" iyz="0"\/><\/inertial>/' \
  "$folder/cart.urdf" >"$folder/placeholder.urdf"
expect 0 'warning: .*link left: its inertia, of which one principal moment is larger than the sum of the others' \
  simulate "$folder/placeholder.urdf" --duration 0.1
expect 0 "^Data: $folder/cart/choose.json" choose "$folder/cart.urdf" --count 2 --candidates capsule --out "$folder/cart"
expect 2 'scene is .*none.urdf": .*could not be opened' simulate "$folder/none.urdf"
sed 's/<cylinder radius="0.1" length="0.05"/<sphere radius="0.1"/' "$folder/cart.urdf" > "$folder/balls.urdf"
expect 2 'must have a cylinder that moves and touches something: see --drive' \
  choose "$folder/balls.urdf" --duration 0.1 --candidates capsule --out "$folder/cart"
expect 2 '--every' render "$folder/bad.json" --every 0
cat > "$folder/can.json" <<'END'
{"duration":0.3,"bodies":[
 {"name":"ground","shape":{"shape":"plane","normal":[0,0,1],"displacement":0},"fixed":true},
 {"name":"can","shape":{"shape":"cylinder","radius":0.1,"half_length":0.2},"pose":{"position":[0,0,0.2]}}],
 "needs":[{"need":"stands","body":"can","degrees":1}]}
END
sed 's/"degrees":1/"degrees":200/' "$folder/can.json" >"$folder/any.json"
expect 2 'needs\[0\].degrees is 200: must be less than 90' choose "$folder/any.json"
sed 's/"name":"can"/"name":" "/' "$folder/can.json" >"$folder/nameless.json"
expect 2 'bodies\[1\].name is " ": must have a letter' choose "$folder/nameless.json"
# What only the other kind of file knows is refused, not ignored.
for option in "--depth 0.1" "--angle 3" "--count 7"; do
  # shellcheck disable=SC2086
  expect 2 "^error: ${option% *} is given with \".*can.json\": must be left out: a scene's needs" choose "$folder/can.json" $option
done
robot=$(dirname "$0")/../simulation/scenes/gripper.urdf
expect 2 '^error: --disturbances is given with ".*gripper.urdf": must be left out' choose "$robot" --disturbances 3 --count 10
cp "$robot" "$folder/G.URDF"
for command in choose render; do
  expect 2 "^error: scene is \".*G.URDF\": is XML: the name of a robot must end in .urdf" $command "$folder/G.URDF"
done
# One thing is no plural.
sed 's/"duration":0.3/"duration":0.0042/' "$folder/can.json" >"$folder/brief.json"
expect 0 ': 1 of 1 configuration near' simulate "$folder/brief.json" --count 1 --record "$folder/recorded.jsonl"
expect 0 '^1 frame\. ' render "$folder/can.json" --every 1 --out "$folder/frame"
expect 0 '^1 configuration: ' export $lying --count 1 --out "$folder/one.csv"
expect 0 '^1 pose class × 1 = 1 configuration, 1 candidate; ' campaign $lying --count 1 --candidates reference --out "$folder/one"
expect 0 '^1 configuration, ' report $lying --count 1 --candidates reference --only scores --out "$folder/one"
expect 0 ', 1 configuration of each' check --candidate reference $lying --count 1 --law agreement
expect 0 'can: 3 of 72 configurations' simulate "$folder/can.json" --count 3 --record "$folder/recorded.jsonl"
expect 0 '"id":"can/can and ground/' solve --candidates reference "$folder/recorded.jsonl"
expect 0 'truth: signed distance' replay "$folder/recorded.jsonl" --candidates reference
expect 2 '--record.*needs scene files' simulate --record "$folder/recorded.jsonl"
expect 2 '--record' simulate "$folder/can.json" --record /proc/none/recorded.jsonl
expect 2 'is given with --record: must stand without it' simulate "$folder/can.json" --record "$folder/r.jsonl" --out "$folder"
expect 2 'scene.*could not be opened' simulate "$folder/none.json" --record "$folder/recorded.jsonl"
expect 0 'can stands within 1' choose "$folder/can.json" --candidates capsule --out "$folder/choice"
# Neither a file's name of other bytes than text nor one with a control character disturbs what is printed.
odd="$folder/$(printf 'caf\xe9\x1b[2J').json"
cp "$folder/can.json" "$odd"
expect 0 'can stands within 1' choose "$odd" --candidates capsule --out "$folder/odd"
expect 0 '^caf? \[2J: 3 of 72' simulate "$odd" --count 3 --record "$folder/odd.jsonl"
# Nor does one that turns the direction of what follows it: it is shown as digits, and quoted so in commands.
turning="$folder/$(printf 'can\xe2\x80\xaenosj').json"
cp "$folder/can.json" "$turning"
expect 0 '^can   nosj: 3 of 72' simulate "$turning" --count 3 --record "$folder/odd.jsonl"
expect 0 'Page: .*/left\\u202ethgir/choose.html' choose "$folder/can.json" --candidates capsule --out "$folder/$(printf 'left\xe2\x80\xaethgir')"
expect 0 "choose \$'.*/can\\\\\\\\xe2\\\\\\\\x80\\\\\\\\xaenosj.json' --cand" choose "$turning" --candidates capsule --json --out "$folder/odd"
expect 2 'file is ".*none\\u2066": could not be opened' solve "$folder/$(printf 'none\xe2\x81\xa6')"
sed "s/\"can\"/\"c\xe2\x80\xaen\"/" "$folder/can.json" > "$folder/named.json"
expect 2 'bodies\[.*\].name is "c\\u202en": must be without characters that are not seen' simulate "$folder/named.json"
echo '{"id":"x\u202e\u001b","a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":1}}' > "$folder/turned.jsonl"
expect 0 '"id":"x\\u202e\\u001b"' solve "$folder/turned.jsonl" --candidates capsule
mkdir "$folder/my scenes"
cp "$folder/can.json" "$folder/my scenes/"
expect 0 "choose '$folder/my scenes/can.json' --candidates capsule --time-limit 0.1 --memory-limit 1024 --disturbances 16 --seed 1\"" \
  choose "$folder/my scenes/can.json" --candidates capsule --time-limit 0.1 --json --out "$folder/choice"
[ -s "$folder/choice/choose.html" ] || { echo "FAILED: no choose.html"; failures=$((failures + 1)); }
sed 's/"degrees":1/"degrees":1e-30/; s/0.2\]}/0.2],"orientation":[1,0.1,0,0]}/' "$folder/can.json" > "$folder/fall.json"
expect 1 'Not even exact contacts meet the needs of this scene' choose "$folder/fall.json" --candidates capsule --out "$folder/choice"
# What an earlier choice left is not taken for this one's.
touch "$folder/choice/choose/fall-99.json" "$folder/choice/choose/cart-99-capsule.json" "$folder/choice/choose/mine.json"
expect 1 'Not even' choose "$folder/fall.json" --candidates capsule --out "$folder/choice"
"$program" choose "$folder/cart.urdf" --depth 1 --angle 90 --count 2 --candidates capsule --out "$folder/choice" >/dev/null 2>&1
left=$(cd "$folder/choice" && ls -1 choose.* choose/*99* choose/mine.json 2>/dev/null | tr '\n' ' ')
[ "$left" = "choose.json choose/mine.json " ] || { echo "FAILED: of earlier choices there is $left"; failures=$((failures + 1)); }
# The command that choose.json has for a run that breaks a need makes that run again: the tilt of the can is
# the one that was measured. As it is written the can balances on the pole of its capsule.
cat > "$folder/pedestal.json" <<'END'
{"duration":0.8,"bodies":[
 {"name":"pedestal","shape":{"shape":"cylinder","radius":0.03,"half_length":0.1},"pose":{"position":[0,0,-0.1]},"fixed":true},
 {"name":"can","shape":{"shape":"cylinder","radius":0.03,"half_length":0.06},"pose":{"position":[0,0,0.06]}}],
 "needs":[{"need":"stands","body":"can","degrees":2}]}
END
expect 0 'render .*pedestal.json --contacts capsule --disturbance [0-9]* --seed 3$' choose "$folder/pedestal.json" \
  --candidates capsule --seed 3 --out "$folder/again"
python3 - "$program" "$folder/again" <<'END' || failures=$((failures + 1))
import json, math, pathlib, re, shlex, subprocess, sys
program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
choice = json.loads((folder / "choose.json").read_text())
run = next(r for r in choice["runs"] if r["name"] == "capsule")
assert not run["holds"] and run["disturbance"] > 0, run
command = shlex.split(run["render"])
assert command[0] == "./touchstone" and run["render"] in (folder / "choose.html").read_text()
subprocess.run([program, *command[1:], "--every", str(choice["scene"]["step"]), "--out", folder / "frames"],
               check=True, stdout=subprocess.DEVNULL)
verdict, largest, first = run["verdicts"][0], 0, None
for i, frame in enumerate(sorted((folder / "frames").glob("frame-*.inc"))):
    axis_z = float(re.findall(r"matrix <(.*)>", frame.read_text())[1].split(",")[8])
    tilt = math.degrees(math.acos(min(1, abs(axis_z))))
    largest = max(largest, tilt)
    if first is None and tilt > verdict["limit"]: first = i * choice["scene"]["step"]
# Frames have nine digits.
if abs(largest - verdict["value"]) > 1e-5 or abs(first - verdict["time"]) > 1e-9:
    sys.exit(f"FAILED: {run['render']} leans by {largest}, {first} s, not {verdict}")
END
simulated=$("$program" simulate "$folder/pedestal.json" --disturbance 0)
[ "$(tail -n 1 <<<"$simulated")" = "$("$program" simulate "$folder/pedestal.json" | tail -n 1)" ] ||
  { echo "FAILED: disturbance 0 is not the scene as it is written"; failures=$((failures + 1)); }
expect 0 '^pedestal, capsule, disturbance 2 of seed 3$' simulate "$folder/pedestal.json" --candidates capsule --disturbance 2 --seed 3
expect 2 '^error: --disturbance is given: must be with scene files, robots or worlds' simulate rolling --disturbance 2
expect 2 '^error: --drive is given: must be with scene files, robots or worlds' simulate rolling --drive wheel=1
expect 2 '^error: --step is given: must be with experiments, not with scene files' simulate "$folder/pedestal.json" --step 0.01
expect 2 '^error: --count is given: must be with --record' simulate "$folder/pedestal.json" --count 5
expect 2 '^error: --seed is given: must be with --record or --disturbance' simulate "$folder/pedestal.json" --seed 5
expect 2 '^error: --drive is given with .*cart.urdf": must be left out: sampled poses have no motion' \
  choose "$folder/cart.urdf" --count 1 --drive left_wheel=3
expect 2 '--contacts is "no-such-engine": must be one of reference' render "$folder/can.json" --contacts no-such-engine
expect 0 '4 frames' render "$folder/can.json" --every 0.1 --out "$folder/frames"
[ -s "$folder/frames/frame-00004.inc" ] || { echo "FAILED: no frame"; failures=$((failures + 1)); }
expect 0 '2 frames' render "$folder/can.json" --every 0.2 --out "$folder/frames"
[ ! -e "$folder/frames/frame-00003.inc" ] || { echo "FAILED: frames of an earlier run are left"; failures=$((failures + 1)); }

# One run at a time writes into a folder; what only reads is not kept out, nor are other folders.
mkdir "$folder/busy"
exec 8<"$folder/busy"
flock 8
busy="^error: --out is \"$folder/busy\": must be a folder that no other run of Touchstone is using; wait .* by --out\$"
expect 2 "$busy" report --out "$folder/busy"
expect 2 "$busy" stability --out "$folder/busy"
expect 2 "$busy" campaign --count 1 --out "$folder/busy"
expect 2 "$busy" campaign --count 1 --shard 1/2 --out "$folder/busy"
expect 2 "$busy" score - --out "$folder/busy"
expect 2 "$busy" choose "$folder/can.json" --out "$folder/busy"
expect 2 "$busy" render "$folder/can.json" --out "$folder/busy"
expect 2 "$busy" simulate lying --out "$folder/busy"
expect 2 "$busy" simulate lying --engine ode --out "$folder/busy"
expect 2 '^error: --figures is ".*busy": must be .* another folder by --figures$' report --out "$folder/free" --figures "$folder/busy"
cp "$folder/recorded.jsonl" "$folder/busy/"
expect 0 '"id"' solve "$folder/busy/recorded.jsonl" --candidates capsule
expect 0 'choose.html' choose "$folder/can.json" --candidates capsule --out "$folder/busy/within"
exec 8<&-
expect 0 'choose.html' choose "$folder/can.json" --candidates capsule --out "$folder/busy"

# Installed without an engine: a line says so, and the rest is there.
mkdir "$folder/part" "$folder/part/candidates"
cp "$program" "$folder/part/"
cp "$(dirname "$program")"/candidates/touchstone-{*.so,host} "$folder/part/candidates/"
rm -f "$folder/part/candidates/touchstone-fcl.so"
listed=$("$folder/part/touchstone" candidates)
if ! grep -q "^fcl: skipped; .*libfcl-dev" <<<"$listed" || ! grep -q "^bullet 3" <<<"$listed"; then
  echo "FAILED: an engine that is not there is not skipped with a line"
  failures=$((failures + 1))
fi

expect_part() {
  if "$folder/part/touchstone" replay cylinder-box/rim-face/1/2 --candidates "$1" 2>&1 | grep -q "$2"; then return; fi
  echo "FAILED: --candidates $1 without its engine does not say \"$2\""
  failures=$((failures + 1))
}
expect_part fcl-distance '"fcl-distance": is unavailable; fcl: skipped; was not built; install .*libfcl-dev'
expect_part flc 'must be one of reference, '
mv "$folder/part/candidates/touchstone-host" "$folder/part/"
expect_part bullet '^error: touchstone-host is ".*/candidates/touchstone-host": .*"No such file or directory"; build or install Touchstone again$'
mv "$folder/part/touchstone-host" "$folder/part/candidates/"

line=$("$program" replay cylinder-box/general-deep/3/4 | grep '^{' | tail -n 1)
"$program" solve --audit <<<"$line" | grep -q '"audit":{"primal_dual_gap":null,"signed_distance":\["-' ||
  { echo "FAILED: solve --audit shows no enclosure of the second oracle"; failures=$((failures + 1)); }

expect 2 'identity.class' certify cylinder-box/none/1/2
expect 2 '--width' certify cylinder-box/rim-face/1/2 --width 0
expect 2 '--cells' certify cylinder-box/rim-face/1/2 --cells -1
expect 2 'standard input is no JSON' certify -
# There no ./touchstone installs what an engine from npm needs.
mkdir -p "$folder/there/bin" "$folder/there/lib" "$folder/there/share/touchstone/candidates"
cp "$program" "$folder/there/bin/"
cp -r "$folder/part/candidates" "$folder/there/lib/touchstone"
cp -r "$(dirname "$0")/../candidates/npm" "$folder/there/share/touchstone/candidates/"
PATH=/nowhere "$folder/there/bin/touchstone" replay cylinder-box/rim-face/1/2 --candidates jolt 2>&1 |
  grep -q 'is unavailable: node is not installed; install Debian.s packages nodejs and npm' ||
  { echo "FAILED: no remedy without node"; failures=$((failures + 1)); }
printf '#!/bin/sh\n' >"$folder/there/bin/node" && chmod +x "$folder/there/bin/node"
PATH="$folder/there/bin" "$folder/there/bin/touchstone" replay cylinder-box/rim-face/1/2 --candidates jolt 2>&1 |
  grep -q "jolt-physics is not in .*; copy package.json and package-lock.json from .*/share/touchstone/candidates/npm into" ||
  { echo "FAILED: no remedy for an engine from npm"; failures=$((failures + 1)); }
expect 0 '"schema":"touchstone-certificate-1"' certify cylinder-box/rim-face/1/2
if [ "$("$program" certify - <<<"$line")" != "$("$program" certify cylinder-box/general-deep/3/4)" ]; then
  echo "FAILED: certify proves something else of a line than of its identity"
  failures=$((failures + 1))
fi

"$program" certify cylinder-box/rim-face/1/2 >"$folder/proof.json"
r="$folder/a b/report.json"
expect 0 'No change' compare "$r" "$r" --html "$folder/compare.html"
grep -q 'cylinder-plane' "$folder/compare.html" || { echo "FAILED: no page of compare"; failures=$((failures + 1)); }
expect 0 '"changes":\[\]' compare "$r" "$r" --json
python3 - "$r" "$folder/worse.json" <<'END'
import json, sys
report = json.load(open(sys.argv[1]))
row = next(r for r in report["results"] if r["class"] == "lying" and r["candidate"] == "bullet")
row["depth_error"] = {q: v if q == "histogram" else 3 * v + 1e-3 for q, v in row["depth_error"].items()}
json.dump(report, open(sys.argv[2], "w"))
END
expect 1 'cylinder-plane/lying  bullet' compare "$r" "$folder/worse.json"
expect 2 '--fail-on is "speed": must be accuracy' compare "$r" "$r" --fail-on speed
expect 0 '"fail_on":\["accuracy","time"\]' compare "$r" "$r" --json --fail-on time
expect 0 'smaller changes' compare "$r" "$folder/worse.json" --max-error-factor 1e300
expect 0 '100% of what agreed must agree still' compare "$r" "$r"
expect 2 'campaign.json": must be the report.json of touchstone report, but has schema "touchstone-camp' \
  compare "$r" "$folder/c/campaign.json"
expect 0 'Better: 1' compare "$folder/worse.json" "$r"
expect 2 'none.json.*could not be opened' compare "$r" "$folder/none.json"
expect 2 'junit.xml.*is no JSON' compare "$folder/junit.xml" "$r"
expect 2 'proof.json": must be the report.json of touchstone report, but has schema "touchstone-cert' compare "$folder/proof.json" "$r"
expect 2 '--max-error-factor is "0.5"' compare "$r" "$r" --max-error-factor 0.5
expect 2 '--html' compare "$r" "$r" --html "$folder/none/compare.html"
# Another count, and one report has another pair as well: the groups of the common pair are compared.
expect 0 '2 configurations' report --candidates reference --count 1 --pair cylinder-plane,cylinder-sphere \
  --class lying,cap --only scores --out "$folder/both"
expect 0 '2 configurations' report --candidates reference --count 2 --pair cylinder-plane --class lying \
  --only scores --out "$folder/one"
expect 0 'compared' compare "$folder/both/report.json" "$folder/one/report.json"

# A file's name cannot become a line of a program, or of what is printed.
lines="$folder/$(printf 'x\n#error\n').json"
echo '{"a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":1}}' > "$lines"
for way in "" "--emit bullet"; do
  if "$program" replay "$lines" --candidates bullet $way | grep -q '^#error'; then
    echo "FAILED: a file's name is a line of its own with replay $way"; failures=$((failures + 1))
  fi
done
expect 2 '--emit.*no-such-engine.*must be one of bullet, ode, fcl, libccd, mujoco' \
  replay cylinder-box/rim-face/1/2 --emit no-such-engine
expect 2 '--emit.*libccd.*half-space' replay cylinder-plane/general-deep/1/2 --emit libccd
expect 2 '--emit.*havok.*half-space' replay cylinder-plane/general-deep/1/2 --emit havok
expect 2 '--emit.*bullet:3.*takes no number' replay cylinder-box/rim-face/1/2 --emit bullet:3
expect 2 '--language.*must be c++ for bullet' replay cylinder-box/rim-face/1/2 --emit bullet --language python
expect 2 '--language.*must be javascript or c++ for jolt' replay cylinder-box/rim-face/1/2 --emit jolt --language c
expect 2 '--language.*must stand beside --emit' replay cylinder-box/rim-face/1/2 --language c++
expect 0 'npm install jolt-physics@' replay cylinder-box/rim-face/1/2 --emit jolt
expect 0 'TEST_CASE("TestCollideCylinderVsBox")' replay cylinder-box/rim-face/1/2 --emit jolt-margin:0.01 --language c++
expect 0 'touchstone-bullet.so' replay cylinder-box/rim-face/1/2 --emit bullet-margin-0
expect 2 'identity.class' replay cylinder-box/none/1/2 --emit bullet
expect 2 'standard input is no JSON' replay - --emit bullet
expect 2 '^error: --.* is given with --.*: must stand without it' replay cylinder-box/rim-face/1/2 --emit bullet --json
expect 0 '#include <BulletCollision' replay cylinder-box/rim-face/1/2 --emit bullet
echo '{"configuration":{"a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":1}}}' \
  >"$folder/saved.json"
expect 0 'btSphereShape shape_b' replay "$folder/saved.json" --emit bullet

expect 2 '--part.*amplification, maps, sequences' stability --part nothing --out "$folder/s"
expect 2 '--count' stability --count 0
expect 2 '--class' stability --class nowhere
expect 2 '--part' stability cylinder-box/rim-face/1/2 --part maps
expect 2 'leaves no choice' stability cylinder-box/rim-face/1/2 --pair cylinder-box
expect 2 'identity.class' stability cylinder-box/none/1/2
expect 0 'depth x' stability cylinder-plane/standing/1/0 --candidates reference,ode --count 2 --out "$folder/s"
[ -s "$folder/s/stability.html" ] || { echo "FAILED: no stability.html"; failures=$((failures + 1)); }
expect 0 'touchstone stability' stability --help
expect 2 'perturbation.amplitude' replay cylinder-box/rim-face/1/2@1e-99/1/1
expect 2 'map.pose.*standing' replay map/none/1e-8/0/0
expect 2 'sequence.motion.*roll-over-edge' replay sequence/none/0/1
expect 0 'reference: contact, agree' replay map/standing/1e-12/-3/16
expect 0 'reference: contact, agree' replay sequence/roll-over-edge/113/200
expect 0 'reference: contact, agree' replay cylinder-box/side-on-face/1/0@1e-8/1/4
expect 0 'reference: contact' replay "$folder/saved.json@1e-2/1/0"

# A replayed configuration goes through solve to the same truth.
truth_of() { sed 's/.*"truth":\({[^}]*}\).*/\1/'; }
replayed=$("$program" replay cylinder-capsule/general-deep/3/4 --json | truth_of)
line=$("$program" replay cylinder-capsule/general-deep/3/4 | grep '^{' | tail -n 1)
solved=$("$program" solve --width 1e-30 <<<"$line" | truth_of)
if [ -z "$solved" ] || [ "$solved" != "$replayed" ]; then
  echo "FAILED: solve gives another truth than replay: $solved instead of $replayed"
  failures=$((failures + 1))
fi

# Output that is lost is an error that says so, whatever the command and wherever it is lost.
lost() {
  local code=$1 how=$2 printed
  if [ "$code" -ne 2 ] || ! grep -q 'standard output' "$folder/lost.log"; then
    echo "FAILED: $how: exit code $code: $(head -n 3 "$folder/lost.log")"
    failures=$((failures + 1))
  fi
}
rim=cylinder-box/rim-face/1/2
"$program" replay $rim --json >"$folder/replayed.json"
"$program" replay $rim | grep '^{' | tail -n 1 >"$folder/line.jsonl"
for command in candidates --help --version --manual "--completion bash" "replay $rim" \
  "replay $rim --json" "replay $rim --emit bullet" "solve $folder/line.jsonl" "certify $rim" \
  "export $lying --count 1" "score $folder/given.jsonl --name mine --out $folder/lost" \
  "check --corpus $folder/found" "simulate rolling --candidates reference --step 0.01" \
  "search --candidate reference --pair cylinder-sphere --class cap --count 4" \
  "stability $rim --candidates reference --count 1 --out $folder/lost" \
  "report --candidates reference --pair cylinder-plane --class lying --count 1 --out $folder/lost"; do
  # shellcheck disable=SC2086
  "$program" $command >/dev/full 2>"$folder/lost.log" </dev/null
  lost $? "touchstone $command > /dev/full"
done
for command in candidates "solve $folder/line.jsonl"; do
  # shellcheck disable=SC2086
  "$program" $command >&- 2>"$folder/lost.log" </dev/null
  lost $? "touchstone $command >&-"
  # shellcheck disable=SC2086
  (trap '' PIPE; "$program" $command 2>"$folder/lost.log" </dev/null; echo $? >"$folder/code") | true
  lost "$(cat "$folder/code")" "touchstone $command | true, without SIGPIPE"
done
# A reader that has had enough ends the program quietly, as it does others.
"$program" --manual 2>"$folder/lost.log" | true
case ${PIPESTATUS[0]} in 0 | 141) ;; *) echo "FAILED: | true"; failures=$((failures + 1)) ;; esac
[ -s "$folder/lost.log" ] && { echo "FAILED: | true is not quiet"; failures=$((failures + 1)); }
# Results that took long to find are printed even where their file cannot be written.
mkdir -p "$folder/blocked"/{choose,report,stability}.json
blocked() {
  local found=$1
  shift
  expect 2 "$found" "$@"
  expect 2 '^error: --[a-z]* is .*: could not be written' "$@"
}
blocked 'can stands within' choose "$folder/can.json" --candidates capsule --disturbances 0 --out "$folder/blocked"
blocked 'The default cylinder\|default cylinder, ' choose "$folder/can.json" --engine ode --disturbances 0 --out "$folder/blocked"
blocked 'left on right\|cylinder .* on cylinder' choose "$folder/cart.urdf" --count 2 --candidates capsule --out "$folder/blocked"
blocked '^1 configuration, ' report $lying --count 1 --candidates reference --only scores --out "$folder/blocked"
blocked '^1 answer, ' score "$folder/given.jsonl" --name mine --out "$folder/blocked"
blocked 'depth x' stability $rim --candidates reference --count 1 --out "$folder/blocked"
blocked 'compared' compare "$r" "$r" --html /dev/full
for saved in "$folder"/found/*.json; do mkdir -p "$folder/taken/$(basename "$saved")"; done
for found in '^severity: ' '^error: --save is ".*/taken/capsule-'; do
  expect 2 "$found" search --candidate capsule --pair cylinder-sphere --class general-deep --count 40 --save "$folder/taken"
done
# Standard error is where errors go; without it the exit code still tells.
"$program" replay nonsense 2>&-
[ $? -eq 2 ] || { echo "FAILED: 2>&-"; failures=$((failures + 1)); }
"$program" replay nonsense 2>/dev/full
[ $? -eq 2 ] || { echo "FAILED: 2>/dev/full"; failures=$((failures + 1)); }
expect 2 '--html.*No space left' replay $rim --html /dev/full --candidates reference

# Input that cannot be read is an error, not an empty file: a folder, or a closed standard input.
for command in solve "score - --name mine --out $folder/lost" "replay -" "certify -"; do
  # shellcheck disable=SC2086
  "$program" $command <"$folder" >/dev/null 2>"$folder/lost.log"
  lost_input=$?
  # shellcheck disable=SC2086
  "$program" $command <&- >/dev/null 2>>"$folder/lost.log"
  [ "$lost_input $? $(grep -c 'is "*standard input"*: could not be read' "$folder/lost.log")" = "2 2 2" ] ||
    { echo "FAILED: touchstone $command without standard input"; failures=$((failures + 1)); }
done

# Every number of every option is read alike: refused by its name, with the range.
for number in -1 nan "" 0x1.8p-1z; do
  for option in "campaign --count" "report --count" "report --seed" "report --workers" \
    "solve --width" "solve --time-limit" "solve --memory-limit" "solve --tolerance" \
    "solve --threshold" "campaign --checkpoint" "certify $rim --cells" "certify $rim --width" \
    "compare a b --max-error-factor" "compare a b --max-time-factor" "compare a b --min-agree" \
    "render a --every" "simulate --step" "simulate --count" "simulate --seed" "choose a --depth" "choose a --angle" "choose a --count" \
    "choose a --seed" "search --candidate bullet --count" "stability --count" "export --count" "export --threshold"; do
    # shellcheck disable=SC2086
    expect 2 "${option##* } is \".*\": must be a .*number from .* to " $option "$number" --out "$folder/none"
  done
done
for option in "campaign --count" "report --count" "report --workers" "stability --count" \
  "search --candidate bullet --count" "check --count" "certify $rim --cells"; do
  # shellcheck disable=SC2086
  expect 2 "${option##* } is \"1e15\": must be a whole number from" $option 1e15
done
expect 2 'must be at most .*campaign scores any number' report --count 1e7 --out "$folder/none"

# Names of any length, and what only begins as a configuration, a scene or a report.
cp "$r" "$folder/report.json"
long=$(printf 'x%.0s' {1..10000})
for command in replay solve score choose render merge certify stability "check --corpus" "compare $folder/report.json" \
  "report --out" "replay $rim --html" "check --candidate reference --law" "report --class" "search --candidate"; do
  # shellcheck disable=SC2086
  expect 2 'xxx\.\.\.' $command "$long"
done
expect 2 'input' replay "$rim$(printf '@1e-8/1/4%.0s' {1..10000})"
body='{"shape":"cylinder","radius":1,"half_length":1}'
twice='{"a":{"shape":"sphere","radius":1,"radius":2},"b":'$body'}'
echo "$twice" >"$folder/twice.json"
printf '{"a":{"shape":"sphere","radius":1},"b":%s}\0x' "$body" >"$folder/nul.json"
printf '{"a":%.0s' {1..100000} >"$folder/deep.json"
printf '{"a":{"shape":"sphere","radius":1e400},"b":%s}' "$body" >"$folder/large.json"
expect 2 'a.radius is given twice' replay "$folder/twice.json"
expect 2 'nul.json is no JSON' replay "$folder/nul.json"
for file in twice nul deep large; do
  for command in replay choose certify "compare $folder/report.json"; do
    # shellcheck disable=SC2086
    expect 2 'error: ' $command "$folder/$file.json"
    # shellcheck disable=SC2086
    "$program" $command "$folder/$file.json" 2>&1 | grep -q 'json.exception' &&
      { echo "FAILED: $command $file.json shows the library's words"; failures=$((failures + 1)); }
  done
  expect 2 '"field"' solve "$folder/$file.json"
done
python3 - "$r" "$folder" <<'END'
import json, sys
report = json.load(open(sys.argv[1]))
row = report["results"][0]
row["outcomes"] = None
json.dump(report, open(sys.argv[2] + "/null.json", "w"))
END
expect 2 'results\[0\].outcomes is null: must be an object' compare "$folder/null.json" "$r"
sed 's/"duration":0.3/"duration":0.3,"gravity":[0,0,-1e200]/' "$folder/can.json" >"$folder/heavy.json"
expect 2 'gravity\[2\] is -1e+200' choose "$folder/heavy.json"
sed 's/"name":"can",/&"angular_velocity":[1e200,0,0],/' "$folder/can.json" >"$folder/spun.json"
expect 2 'bodies\[1\].angular_velocity\[0\] is 1e+200: must lie between' choose "$folder/spun.json"
expect 2 'angular_velocity' render "$folder/spun.json"

# The manual page and the completions say what --help says.
failed() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}
"$program" --manual >"$folder/touchstone.1"
"$program" --completion bash >"$folder/touchstone.bash"
"$program" --completion zsh >"$folder/_touchstone"
groff -man -Tutf8 -ww -z "$folder/touchstone.1" 2>"$folder/warnings" && [ ! -s "$folder/warnings" ] ||
  failed "groff: $(head -n 3 "$folder/warnings")"
# shellcheck disable=SC1091
. "$folder/touchstone.bash" || failed "bash reads no completion"

# completed WORD…: what bash offers for the last word.
completed() {
  COMP_WORDS=(touchstone "$@")
  COMP_CWORD=$#
  _touchstone
  printf '%s\n' "${COMPREPLY[@]}"
}
# The first column of a list of --help: words at the start of lines that are indented by two.
options_of() { sed -n 's/^  \(-[^ ]*\).*/\1/p' | tr , '\n'; }

# on_terminal COLUMNS ARGUMENTS: what is seen on a terminal of that width.
on_terminal() { TERM=xterm script -qec "stty cols $1; '$program' $2" /dev/null </dev/null; }
[[ $(on_terminal 80 "replay cylinder-box/rim-face/1/2 --candidates reference") == *$'\e[32magree'* ]] ||
  failed "no colour on a terminal"
[[ $(NO_COLOR=1 on_terminal 80 "replay cylinder-box/rim-face/1/2 --candidates reference") != *$'\e'* ]] ||
  failed "colour in spite of NO_COLOR"
replayed_rim="replay cylinder-box/edge-cap/1/2 --candidates reference,bullet"
for command in "" $("$program" --help | sed -n '/^Subcommands/,/^Examples/s/^  \([a-z]*\) .*/\1/p'); do
  # But for examples, which stay whole.
  narrow=$(on_terminal 40 "$command --help" | tr -d '\r')
  [ "$(wc -l <<<"$narrow")" -gt 7 ] || failed "no help of $command"
  wide=$(grep -v '^  [a-z]* *touchstone \|^  *\(echo\|mpirun\|python3\|"b"\)\|touchstone solve$' <<<"$narrow" |
    LC_ALL=C.UTF-8 grep '.\{41\}')
  [ -z "$wide" ] || failed "$command --help is wider than a terminal of 40 columns: $wide"
done
for command in candidates "classes cylinder-box"; do
  # But for a long word, as of a path.
  wide=$(on_terminal 40 "$command" | tr -d '\r' | grep -v '[^ ]\{30\}' | LC_ALL=C.UTF-8 grep '.\{41\}')
  [ -z "$wide" ] || failed "$command is wider than a terminal of 40 columns: $wide"
done
broken="check --candidate bullet --pair cylinder-box,cylinder-sphere --class edge-cap,cap,concentric --count 2"
changed="compare $folder/report.json $folder/worse.json"
for command in "$replayed_rim" "$broken" "$changed" "check --known $folder/known" \
  "simulate rolling --candidates reference,capsule-circumscribed --step 0.01" "simulate lying --engine ode" \
  "search --candidate bullet --pair cylinder-cylinder --class perpendicular-t-centred+turned --count 4" \
  "stability cylinder-box/rim-face/1/2 --candidates reference --count 1 --out $folder/s" \
  "choose $folder/can.json --candidates capsule --disturbances 1 --out $folder/s" \
  "report --pair cylinder-plane --class lying --count 1 --candidates reference,bullet --out $folder/s"; do
  # shellcheck disable=SC2086
  printed=$(COLUMNS=40 "$program" $command)
  [ "$(wc -l <<<"$printed")" -gt 3 ] || failed "$command prints nothing"
  wide=$(grep -v '[^ ]\{30\}' <<<"$printed" | LC_ALL=C.UTF-8 grep '.\{41\}')
  [ -z "$wide" ] || failed "$command is wider than COLUMNS=40: $wide"
done
[[ $(COLUMNS=40 on_terminal 80 "$broken --law agreement" | tr -d '\r') == *$'\e[0m\n    '[0-9]* ]] ||
  failed "COLUMNS is not heard on a terminal"
[ "$(COLUMNS=many "$program" $replayed_rim)" = "$("$program" $replayed_rim)" ] || failed "COLUMNS=many"
[[ $(on_terminal 80 "export --format npz --count 1 $lying") == *'--out is a terminal: must be a file or a pipe for npz'* ]] ||
  failed "npz goes to a terminal"
for command in candidates "classes cylinder-box" "$replayed_rim" \
  "simulate rolling --candidates reference,capsule-circumscribed --step 0.01" "simulate lying --engine ode" \
  "search --candidate bullet --pair cylinder-cylinder --class perpendicular-t-centred+turned --count 4"; do
  # shellcheck disable=SC2086
  wide=$("$program" $command | grep -v '^{\|[^ ]\{60\}' | LC_ALL=C.UTF-8 grep '.\{81\}')
  [ -z "$wide" ] || failed "$command is wider than 80 columns: $wide"
done

commands=$("$program" --help | sed -n '/^Subcommands/,/^Examples/s/^  \([a-z]*\) .*/\1/p')
[ "$(wc -l <<<"$commands")" -ge 6 ] || failed "--help lists no subcommands"
[ "$(completed '')" = "$commands" ] || failed "subcommands: $(completed '')"
[ "$(completed rep)" = "$(grep '^rep' <<<"$commands")" ] || failed "rep: $(completed rep)"
for command in "" $commands; do
  # shellcheck disable=SC2086
  long=$("$program" $command --help | LC_ALL=C.UTF-8 grep '.\{81\}')
  [ -z "$long" ] || failed "$command --help is wider than 80 columns: $long"
done
for command in $commands; do
  grep -q "^\.SS \"touchstone $command\"" "$folder/touchstone.1" || failed "no manual of $command"
  offered=$(completed "$command" -)
  page=$(sed -n "/^\.SS \"touchstone $command\"/,/^\.S[SH]/p" "$folder/touchstone.1" | tr -d '\\')
  zsh=$(sed -n "/^    $command) _arguments/,/;;/p" "$folder/_touchstone")
  for option in $("$program" "$command" --help | options_of); do
    grep -qx -e "$option" <<<"$offered" || failed "bash: $command $option"
    grep -q -e "^fB.*$option" <<<"$page" || failed "manual: $command $option"
    grep -q -e "'$option\[" <<<"$zsh" || failed "zsh: $command $option"
  done
done
[ "$(completed report --pair cylinder-b)" = cylinder-box ] || failed "pairs: $(completed report --pair cylinder-b)"
[ "$(completed report --pair cylinder-box,cylinder-p)" = cylinder-box,cylinder-plane ] || failed "a second pair"
[ "$(completed replay --candidates fcl-d)" = fcl-distance ] || failed "candidates: $(completed replay --candidates fcl-d)"
[ "$(completed report --class rim-r)" = rim-rim ] || failed "pose classes: $(completed report --class rim-r)"
[ "$(completed check --law sm)" = small-steps ] || failed "laws: $(completed check --law sm)"
grep -q -e "'--group\[.*:GROUP:_sequence compadd - .*everyday" "$folder/_touchstone" || failed "zsh: groups"
[ -z "$(completed report --out '')" ] || failed "a value is completed as something but a file"
[ -z "$(completed --load '')" ] || failed "a plug-in is completed as something but a file"
[ "$(completed check --cor)" = --corpus ] || failed "check --cor: $(completed check --cor)"
if command -v zsh >/dev/null && ! zsh -n "$folder/_touchstone"; then failed "zsh reads no completion"; fi
exit "$failures"
