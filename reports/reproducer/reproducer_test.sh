#!/usr/bin/env bash
# Writes and runs programs for one engine, by the line in their comment:
# reproducer_test.sh PROGRAM "OPTIONS" ENGINE LANGUAGE CONFIGURATION OUTCOME … with pairs of a
# configuration (an identity, FILE.jsonl:ID for a line of a file, or the line), or a cast, and the outcome that
# its candidate is known for. OPTIONS are Touchstone's own, those that add a candidate. Packages of npm
# are found in TOUCHSTONE_NPM.
set -u
program=$1 options=$2 engine=$3 language=$4
shift 4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

fail() {
  echo "FAILED: $engine, $configuration: $*"
  failures=$((failures + 1))
}

# Stands in for Python's package mujoco, asking that of npm.
stand_in_for_mujoco() {
  cat >"$folder/mujoco.py" <<'END'
import json, pathlib, subprocess
from types import SimpleNamespace

class MjModel:
    @staticmethod
    def from_xml_string(xml):
        return SimpleNamespace(xml=xml)

def MjData(model):
    return SimpleNamespace(ncon=0, contact=[])

def mj_kinematics(model, data):
    pass

def mj_collision(model, data):
    script = """import start from '@mujoco/mujoco';
        import fs from 'node:fs';
        const mujoco = await start(), model = mujoco.MjModel.from_xml_string(String(fs.readFileSync(0)));
        const data = new mujoco.MjData(model);
        mujoco.mj_kinematics(model, data);
        mujoco.mj_collision(model, data);
        console.log(JSON.stringify(Array.from({length: data.ncon}, (_, i) => data.contact.get(i)).map(
          c => ({dist: c.dist, pos: [...c.pos], frame: [...c.frame], geom: [c.geom1, c.geom2]}))));"""
    file = pathlib.Path(__file__).with_name("ask.mjs")
    file.write_text(script)
    printed = subprocess.run(["node", file], input=model.xml, capture_output=True, text=True, check=True)
    data.contact = [SimpleNamespace(**c) for c in json.loads(printed.stdout)]
    data.ncon = len(data.contact)
END
}

# prepare: compiles what needs it, and makes the packages be found, as the file's comment says.
prepare() {
  local compile
  case $language in
    c++)
      compile=$(sed -n 's|^// Compile  ||p' "$folder/reproducer")
      mv "$folder/reproducer" "$folder/reproducer.cpp"
      source=$folder/reproducer.cpp
      (cd "$folder" && eval "$compile") && [ -x "$folder/reproducer" ] ||
        { fail "does not compile by: $compile"; return 1; }
      run() { "$folder/reproducer" "$@"; }
      ;;
    javascript)
      mv "$folder/reproducer" "$folder/reproducer.mjs"
      source=$folder/reproducer.mjs
      local package
      package=$(sed -n 's|^// Run      npm install \(.*\)@\(.*\) && node reproducer.mjs|\1 \2|p' "$source")
      grep -qF "\"version\": \"${package#* }\"" "$TOUCHSTONE_NPM/node_modules/${package% *}/package.json" ||
        { fail "no such package: $package"; return 1; }
      mkdir -p "$folder/node_modules/$(dirname "${package% *}")"
      ln -sfn "$TOUCHSTONE_NPM/node_modules/${package% *}" "$folder/node_modules/${package% *}"
      run() { node "$folder/reproducer.mjs" "$@"; }
      ;;
    python)
      mv "$folder/reproducer" "$folder/reproducer.py"
      source=$folder/reproducer.py
      if grep -q '^import mujoco' "$source" && ! python3 -c 'import mujoco' 2>/dev/null; then
        stand_in_for_mujoco
        ln -sfn "$TOUCHSTONE_NPM/node_modules" "$folder/node_modules"
      fi
      run() { python3 -B "$folder/reproducer.py" "$@" 2>/dev/null; }
      ;;
  esac
}

# Makes the program take the truth for its engine's answer where it is given an argument.
plant_a_right_engine() {
  local js='{ distance: trueDistance, normal: trueNormals[0], points: [{ position: middle, normal: trueNormals[0], depth: -trueDistance }] }'
  local cpp='  answer.kind = Answer::contact;\n  answer.distance = true_distance;\n  answer.normal = vector(true_normals[0]);\n  answer.points = {{vector(middle), answer.normal, -true_distance}};\n'
  if grep -q 'A moves by this much' "$folder/reproducer"; then
    js='(earliest > latest ? null : { fraction: trueFraction, normal: trueNormals[0] })'
    cpp='  answer = {earliest <= latest, true_fraction, vector(true_normals[0])};\n'
  fi
  sed -i -e "s|  const answer = ask();|  const answer = process.argv[2] ? $js : ask();|" \
    -e 's|^        answer = ask()|        answer = Answer(true_distance, true_normals[0], [Point(middle, true_normals[0], -true_distance)]) if sys.argv[1:] else ask()|' \
    -e 's|^  const Answer answer = ask();|  const Answer answer = count > 1 ? truth() : ask();|' "$folder/reproducer"
  [ "$language" = c++ ] || return 0
  sed -i "s|^int main() {|Answer truth() {\n  Answer answer;\n$cpp  return answer;\n}\nint main(int count, char**) {|" "$folder/reproducer"
}

while [ $# -gt 0 ]; do
  configuration=$1 outcome=$2
  shift 2
  rm -rf "${folder:?}"/*
  if [[ $configuration == {* ]]; then
    echo "$configuration" >"$folder/line.json"
    configuration=$folder/line.json
  elif [[ $configuration == *.jsonl:* ]]; then
    grep -F "\"id\":\"${configuration##*:}\"" "${configuration%:*}" >"$folder/line.json"
    configuration=$folder/line.json
  fi
  # No engine fails for the time that a slow machine takes.
  # shellcheck disable=SC2086 # several words
  if ! eval "\"$program\" $options replay \"$configuration\" --emit \"$engine\" --language $language --time-limit 60" \
    >"$folder/reproducer"; then
    fail "nothing was written"
    continue
  fi
  case $outcome in agree | unseen) expected=0 ;; *) expected=1 ;; esac
  [ "$expected" -eq 0 ] || plant_a_right_engine
  prepare || continue
  printed=$(run)
  code=$?
  [ "$code" -eq "$expected" ] || fail "exit code $code, expected $expected: $printed"
  verdict="WRONG: ${outcome//-/ }"
  case $outcome in
    agree) verdict='Right within the tolerance$' ;;
    unseen) verdict='Right within the tolerance, but unseen' ;;
    not-finite) verdict="WRONG: not a finite number" ;;
    failed) verdict="WRONG: the engine" ;;
  esac
  grep -q "^$verdict" <<<"$(tail -n 1 <<<"$printed")" || fail "expected $outcome: $(tail -n 1 <<<"$printed")"
  seen=$(sed -n 's/^\(\/\/\|#\) Seen     //p' "$source")
  grep -q ": $outcome\\(,\\|\$\\)" <<<"$seen" || fail "seen: $seen, expected $outcome"
  # libccd's program repeats the candidate libccd-gjk.
  candidate=${engine/%libccd/libccd-gjk}
  answers=$(eval "\"$program\" $options replay \"$configuration\" --json --candidates \"$candidate\" --time-limit 60")
  python3 - "$seen" "$printed" "$answers" <<'END' || fail "see above: $printed"
import json, re, sys
seen, printed, answers = sys.argv[1:]
number = lambda pattern, text=printed: float(re.search(pattern, text).group(1))
if "of the sweep, normal" in printed:
    # To the last bit what the candidate answers to the cast.
    [given] = json.loads(answers)["cast"]["answers"].values()
    said = re.search(r"touch at (\S+) of the sweep, normal \((\S+), (\S+), (\S+)\)", printed)
    assert [float(x) for x in said.groups()] == [given["fraction"], *given["normal"]], "not the candidate's cast"
if "of its sweep" in printed:
    # The clearance ends at the true touch, at a point of both bodies.
    if "It ends at" in printed:
        truth = number(r"when it has gone (\S+) of its sweep")
        assert abs(number(r"It ends at (\S+),") - truth) < 1e-12, "no proof"
        for of_body in re.search(r"within A by (\S+) and within B by (\S+),", printed).groups():
            assert abs(float(of_body)) < 1e-12, "no point of both bodies"
    if "It never ends" in printed:
        assert number(r"at the start (\S+),") > 0 and number(r"end of the sweep +(\S+),") > 0, "no proof"
    sys.exit()
# To the last bit what the candidate answers.
if ", signed distance " in seen:
    answer = number(r", signed distance (\S+)$", seen)
    assert number(r"contact, signed distance (\S+),") == answer, f"not the candidate's answer {answer}"
    [given] = json.loads(answers)["answers"].values()
    expected = [(*point["position"], point["depth"]) for point in given["points"]]
    points = re.findall(r"^Point \((\S+), (\S+), (\S+)\)\n  of depth (\S+) is", printed, re.M)
    points = [tuple(map(float, point)) for point in points]
    if not any(x is None for point in expected for x in point):
        assert points == expected, f"not the candidate's points {expected}"
# Both bounds of the proof, in plain double arithmetic, agree with the certified distance.
truth = number(r"\(signed distance ([^ )]+)")
assert abs(number(r"The first less the others? is +(\S+), up") - truth) < 1e-12 * max(1, abs(truth)), "no proof"
if "no less than" in printed:
    assert 0 <= number(r"no less than (\S+)\.\n") <= -truth + 1e-12, "no proof of the depth"
END
  [ "$expected" -eq 0 ] && continue
  printed=$(run right) || fail "a right engine is judged wrong: $printed"
done
exit "$failures"
