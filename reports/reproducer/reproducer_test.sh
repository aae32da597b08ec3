#!/usr/bin/env bash
# Writes, compiles (by the line in its comment) and runs reproducers for one engine:
# reproducer_test.sh PROGRAM ENGINE CONFIGURATION OUTCOME … with pairs of a configuration (an
# identity, or FILE.jsonl:ID for a line of a file) and the outcome that its candidate is known for.
set -u
program=$1 engine=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0

fail() {
  echo "FAILED: $engine, $configuration: $*"
  failures=$((failures + 1))
}

while [ $# -gt 0 ]; do
  configuration=$1 outcome=$2
  shift 2
  rm -f "$folder"/*
  if [[ $configuration == *.jsonl:* ]]; then
    grep -F "\"id\":\"${configuration##*:}\"" "${configuration%:*}" >"$folder/line.json"
    configuration=$folder/line.json
  fi
  if ! "$program" replay "$configuration" --emit "$engine" >"$folder/reproducer.cpp"; then
    fail "nothing was written"
    continue
  fi
  compile=$(sed -n 's|^// Compile  ||p' "$folder/reproducer.cpp")
  if ! (cd "$folder" && eval "$compile") || [ ! -x "$folder/reproducer" ]; then
    fail "does not compile by: $compile"
    continue
  fi
  printed=$("$folder/reproducer")
  code=$?
  [ "$outcome" = agree ] && expected=0 || expected=1
  [ "$code" -eq "$expected" ] || fail "exit code $code, expected $expected: $printed"
  seen=$(sed -n 's|^// Seen     ||p' "$folder/reproducer.cpp")
  grep -q ": $outcome\\(,\\|\$\\)" <<<"$seen" || fail "seen: $seen, expected $outcome"
  # To the last bit what the candidate answers.
  answer=$(sed 's/.*, signed distance //' <<<"$seen")
  if grep -q ', signed distance ' <<<"$seen" && ! grep -qF "signed distance $answer," <<<"$printed"; then
    fail "the candidate answers $answer: $printed"
  fi
  # Both bounds of the proof, in plain double arithmetic, agree with the certified distance.
  python3 - "$printed" <<'END' || fail "the proof does not prove the distance: $printed"
import re, sys
number = lambda pattern: float(re.search(pattern, sys.argv[1]).group(1))
truth = number(r"signed distance (\S+) = ")
assert abs(number(r"Their difference is +(\S+)") - truth) < 1e-12 * max(1, abs(truth))
if "no less than" in sys.argv[1]:
    assert 0 <= number(r"no less than (\S+)\.\n") <= -truth + 1e-12
END
done
exit "$failures"
