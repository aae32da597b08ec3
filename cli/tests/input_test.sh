#!/usr/bin/env bash
# Input that does not end, cannot be read, or is not what it begins as.
# shellcheck disable=SC2086 # commands
. "$(dirname "$0")/prelude.sh"

expect 2 '^error: --corpus is "/dev/zero": must have at most 134217728 bytes' check --corpus /dev/zero
expect 2 'line 1 is without an end: must have at most 1048576 bytes' solve /dev/zero
expect 2 'line 1 is without an end' score /dev/zero --name mine --out "$folder/given"
for command in replay "replay --certify" choose "campaign --merge" "compare /dev/zero"; do
  expect 2 '^error: .*/dev/zero.* must ' $command /dev/zero
done
# Input that cannot be read is an error, not an empty file: a folder, or a closed standard input.
for command in solve "score - --name mine --out $folder/lost" "replay -" "replay --certify -"; do
  "$program" $command <"$folder" >/dev/null 2>"$folder/lost.log"
  lost_input=$?
  "$program" $command <&- >/dev/null 2>>"$folder/lost.log"
  [ "$lost_input $? $(grep -c 'is "*standard input"*: could not be read' "$folder/lost.log")" = "2 2 2" ] ||
    failed "touchstone $command without standard input"
done

# Names of any length, and what only begins as a configuration, a scene or a report.
r=$folder/report.json
"$program" report $lying --count 1 --candidates reference --only scores --out "$folder" >/dev/null 2>&1
long=$(printf 'x%.0s' {1..10000})
for command in replay solve score choose "simulate --povray out" "campaign --merge" "replay --certify" stability "check --corpus" "compare $r" \
  "report --out" "replay $rim --html" "check --candidate reference --law" "report --class" "check --search --candidate"; do
  expect 2 'xxx\.\.\.' $command "$long"
done
expect 2 'input' replay "$rim$(printf '@1e-8/1/4%.0s' {1..10000})"
body='{"shape":"cylinder","radius":1,"half_length":1}'
printf '{"a":{"shape":"sphere","radius":1,"radius":2},"b":%s}\n' "$body" >"$folder/twice.json"
printf '{"a":{"shape":"sphere","radius":1},"b":%s}\0x' "$body" >"$folder/nul.json"
printf '{"a":%.0s' {1..100000} >"$folder/deep.json"
printf '{"a":{"shape":"sphere","radius":1e400},"b":%s}' "$body" >"$folder/large.json"
for file in twice nul deep large; do
  case $file in twice) why='a.radius is given twice' ;; nul) why='nul.json is no JSON' ;; *) why='error: ' ;; esac
  expect 2 "$why" replay "$folder/$file.json"
  for command in replay choose "replay --certify" "compare $r"; do
    [ "$command" = replay ] || expect 2 'error: ' $command "$folder/$file.json"
    ! grep -q 'json.exception' <<<"$printed" || failed "$command $file.json shows the library's words"
  done
  expect 2 '"field"' solve "$folder/$file.json"
done
python3 - "$folder" <<'END'
import json, pathlib, sys
folder = pathlib.Path(sys.argv[1])
report = json.loads((folder / "report.json").read_text())
report["results"][0]["outcomes"] = None
(folder / "null.json").write_text(json.dumps(report))
END
expect 2 'results\[0\].outcomes is null: must be an object' compare "$folder/null.json" "$r"
can=$source_folder/cli/tests/scenes/can.json
sed 's/"duration":0.3/"duration":0.3,"gravity":[0,0,-1e200]/' "$can" >"$folder/heavy.json"
expect 2 'gravity\[2\] is -1e+200' choose "$folder/heavy.json"
sed 's/"name":"can",/&"angular_velocity":[1e200,0,0],/' "$can" >"$folder/spun.json"
expect 2 'bodies\[1\].angular_velocity\[0\] is 1e+200: must lie between' choose "$folder/spun.json"
expect 2 'angular_velocity' simulate "$folder/spun.json" --povray "$folder/frames"

finish
