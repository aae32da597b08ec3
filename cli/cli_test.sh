#!/usr/bin/env bash
# Runs the program as a person does: cli_test.sh PROGRAM.
set -u
program=$1
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
expect 2 'subcommand is required'
expect 2 'report, replay, solve, certify, check, compare, ' nonsense
expect 2 'identity.pair' replay cylinder-cone/rim/1/2
expect 2 'identity.class' replay cylinder-box/none/1/2
expect 2 'input is required' replay
expect 2 'must be one of reference, bullet, ' replay cylinder-box/rim-face/1/2 --candidates havok
expect 2 'prism:1.* must be' replay cylinder-box/rim-face/1/2 --candidates prism:1
expect 0 'prism:32: ' replay cylinder-box/rim-face/1/2 --candidates prism:8,16,32
expect 2 'must be a plug-in' --candidate /etc/passwd candidates
expect 2 '--time-limit' solve --time-limit 0
expect 2 '--tolerance' replay cylinder-box/rim-face/1/2 --tolerance=-1
expect 0 'reference: contact, agree' replay cylinder-box/rim-face/1/2
expect 0 '"id":"cylinder-box/rim-face/1/2"' replay cylinder-box/rim-face/1/2 --json
expect 0 'reference: contact' replay cylinder-box/rim-face/1/2 --html "$folder/page.html"
grep -q 'cylinder-box/rim-face/1/2' "$folder/page.html" || { echo "FAILED: no page"; failures=$((failures + 1)); }
expect 2 '--html' replay cylinder-box/rim-face/1/2 --html "$folder/none/page.html"
expect 2 'could not be opened' solve "$folder/none.jsonl"
expect 2 '--width' solve --width 0
expect 2 '--count' report --count 0
expect 2 '--pair.*cylinder-box' report --pair cylinder-cone
expect 2 '--class' report --class nowhere --out "$folder/r"
expect 2 '--out' report --out /proc/none
expect 0 'report.html' report --pair cylinder-plane --count 1 --out "$folder/a b"
[ -s "$folder/a b/report.html" ] || { echo "FAILED: no report.html"; failures=$((failures + 1)); }


expect 2 '--count' campaign --count 1.5e0 --out "$folder/c"
expect 2 '--shard.*3/7' campaign --shard 8/7 --out "$folder/c"
expect 0 '^4 configurations' campaign --pair cylinder-sphere --class cap,side --count 2e0 \
  --candidates reference --out "$folder/c"
expect 2 'already holds a campaign' campaign --out "$folder/c"
expect 0 '^4 configurations' merge "$folder/c" --out "$folder/m"
expect 2 'could not be opened' merge "$folder/none" --out "$folder/n"
expect 2 'candidate is required' search
expect 1 'shallow\|overdeep\|missed' search --candidate capsule --pair cylinder-sphere \
  --class general-deep --count 40 --save "$folder/found"
expect 0 'as expected' check --corpus "$folder/found"
expect 0 'capsule: contact, \|capsule: none, ' replay "$(ls "$folder"/found/*.json | head -n 1)" --candidates capsule

expect 2 'must be one of standing, ' simulate juggling
expect 2 '--step.*0.1 s' simulate rolling --step 0
expect 2 '--workers' simulate rolling --workers 0
expect 2 '--out' simulate rolling --out /proc/none
expect 0 'reference  *=' simulate rolling --candidates reference --step 0.01
expect 0 '"exact":true' simulate rolling --candidates reference --step 0.01 --json --out "$folder/simulated"
grep -q '"rolling"' "$folder/simulated/experiments.json" || { echo "FAILED: no experiments.json"; failures=$((failures + 1)); }
expect 2 '--candidate' check
expect 2 '--law.*agreement' check --candidate bullet --law gravity
expect 2 '--class' check --candidate bullet --class nowhere
expect 2 '--corpus.*must be a folder' check --corpus "$folder/none"
expect 0 'agreement .* passed' check --candidate reference --pair cylinder-sphere --count 1
expect 1 'broken by' check --candidate bullet --pair cylinder-box --class edge-cap --count 1 \
  --law agreement --save "$folder/corpus" --junit "$folder/junit.xml" --json "$folder/check.json"
expect 0 'as expected' check --corpus "$folder/corpus"
expect 0 'bullet: .*missed\|bullet: contact, shallow' replay "$(ls "$folder"/corpus/*.json | head -n 1)" --candidates bullet
sed -i 's/"missed"/"overdeep"/; s/"shallow"/"overdeep"/' "$folder"/corpus/*.json
expect 1 'changed' check --corpus "$folder/corpus"
echo '{' > "$folder/corpus/broken.json"
expect 2 'broken.json' check --corpus "$folder/corpus"
python3 - "$folder" <<'END' || { echo "FAILED: JUnit XML or JSON of check"; failures=$((failures + 1)); }
import json, sys, xml.etree.ElementTree as tree
suite = tree.parse(sys.argv[1] + "/junit.xml").getroot()[0]
assert suite.get("failures") == "1" and suite[0][0].tag == "failure"
assert json.load(open(sys.argv[1] + "/check.json"))["laws"][0]["broken"] == 1
END

expect 2 'scene.*could not be opened' choose "$folder/none.json"
echo '{"duration":1,"bodies":[{"name":"a","shape":{"shape":"sphere","radius":-1}}]}' > "$folder/bad.json"
expect 2 'bodies\[0\].shape.radius is -1' choose "$folder/bad.json"
expect 2 -- '--depth' choose "$folder/bad.json" --depth 0
expect 2 -- '--every' render "$folder/bad.json" --every 0
expect 2 -- '--contacts\|must be one of reference' render "$folder/bad.json" --contacts havok
cat > "$folder/can.json" <<'END'
{"duration":0.3,"bodies":[
 {"name":"ground","shape":{"shape":"plane","normal":[0,0,1],"displacement":0},"fixed":true},
 {"name":"can","shape":{"shape":"cylinder","radius":0.1,"half_length":0.2},"pose":{"position":[0,0,0.2]}}],
 "needs":[{"need":"stands","body":"can","degrees":1}]}
END
expect 0 'can stands within 1' choose "$folder/can.json" --candidates capsule --out "$folder/choice"
[ -s "$folder/choice/choose.html" ] || { echo "FAILED: no choose.html"; failures=$((failures + 1)); }
sed 's/"degrees":1/"degrees":1e-30/; s/0.2\]}/0.2],"orientation":[1,0.1,0,0]}/' "$folder/can.json" > "$folder/fall.json"
expect 1 'Not even exact contacts' choose "$folder/fall.json" --candidates capsule --out "$folder/choice"
expect 0 '4 frames' render "$folder/can.json" --every 0.1 --out "$folder/frames"
[ -s "$folder/frames/frame-00004.inc" ] || { echo "FAILED: no frame"; failures=$((failures + 1)); }

# Installed without an engine: a line says so, and the rest is there.
mkdir "$folder/part" "$folder/part/candidates"
cp "$program" "$folder/part/"
cp "$(dirname "$program")"/candidates/touchstone-*.so "$folder/part/candidates/"
rm -f "$folder/part/candidates/touchstone-fcl.so"
listed=$("$folder/part/touchstone" candidates)
if ! grep -q "^fcl: skipped; .*libfcl-dev" <<<"$listed" || ! grep -q "^bullet 3" <<<"$listed"; then
  echo "FAILED: an engine that is not there is not skipped with a line"
  failures=$((failures + 1))
fi

line=$("$program" replay cylinder-box/general-deep/3/4 | grep '^{' | tail -n 1)
"$program" solve --audit <<<"$line" | grep -q '"audit":{"primal_dual_gap":null,"signed_distance":\["-' ||
  { echo "FAILED: solve --audit shows no enclosure of the second oracle"; failures=$((failures + 1)); }

expect 2 'identity.class' certify cylinder-box/none/1/2
expect 2 '--width' certify cylinder-box/rim-face/1/2 --width 0
expect 2 '--cells' certify cylinder-box/rim-face/1/2 --cells -1
expect 2 'standard input is no JSON' certify -
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
expect 0 'smaller changes' compare "$r" "$folder/worse.json" --max-error-factor 1e300
expect 0 'Better: 1' compare "$folder/worse.json" "$r"
expect 2 'none.json.*could not be opened' compare "$r" "$folder/none.json"
expect 2 'junit.xml.*is no JSON' compare "$folder/junit.xml" "$r"
expect 2 'proof.json: schema is .* must be 1' compare "$folder/proof.json" "$r"
expect 2 '--max-error-factor is 0.5' compare "$r" "$r" --max-error-factor 0.5
expect 2 '--html' compare "$r" "$r" --html "$folder/none/compare.html"

expect 2 '--emit.*havok.*must be one of bullet, ode, fcl, libccd, mujoco' \
  replay cylinder-box/rim-face/1/2 --emit havok
expect 2 '--emit.*libccd.*half-space' replay cylinder-plane/general-deep/1/2 --emit libccd
expect 2 'identity.class' replay cylinder-box/none/1/2 --emit bullet
expect 2 'standard input is no JSON' replay - --emit bullet
expect 2 'excludes' replay cylinder-box/rim-face/1/2 --emit bullet --json
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

exit "$failures"
