#!/usr/bin/env bash
# Where results go: folders that another run is writing into, output that is lost, files that cannot be written.
# shellcheck disable=SC2086 # commands
. "$(dirname "$0")/prelude.sh"
cp "$source_folder"/cli/tests/scenes/* "$folder"
can=$folder/can.json
line='{"id":"one","a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":1}}'
echo "$line" >"$folder/line.jsonl"
echo '{"id":"cylinder-plane/lying/1/0","status":"none"}' >"$folder/given.jsonl"

# One run at a time writes into a folder; what only reads is not kept out, nor are other folders.
mkdir "$folder/busy"
exec 8<"$folder/busy"
flock 8
for command in report stability "campaign --count 1" "campaign --count 1 --shard 1/2" "score -" "choose $can" \
  "simulate lying" "simulate lying --engine ode"; do
  expect 2 "^error: --out is \"$folder/busy\": must be a folder that no other run of Touchstone is using; wait .* by --out\$" \
    $command --out "$folder/busy"
done
expect 2 '^error: --povray is ".*busy": must be .* another folder by --povray$' simulate "$can" --povray "$folder/busy"
expect 2 '^error: --figures is ".*busy": must be .* another folder by --figures$' \
  report --out "$folder/free" --figures "$folder/busy"
cp "$folder/line.jsonl" "$folder/busy/"
expect 0 '"id"' solve "$folder/busy/line.jsonl" --candidates capsule
brief="--candidates capsule --disturbances 0"
expect 0 'choose.html' choose "$can" $brief --out "$folder/busy/within"
exec 8<&-
expect 0 'choose.html' choose "$can" $brief --out "$folder/busy"

# Output that is lost is an error that says so, whatever the command and wherever it is lost.
lost() {
  { [ "$1" -eq 2 ] && grep -q 'standard output' "$folder/lost.log"; } ||
    failed "$2: exit code $1: $(head -n 3 "$folder/lost.log")"
}
deep="check --search --candidate capsule --pair cylinder-sphere --class general-deep --count 40"
expect 1 . $deep --save "$folder/found"
one="--candidates reference --count 1"
for command in "list candidates" --help --version --manual "--completion bash" "replay $rim --candidates reference" \
  "replay $rim --candidates reference --json" "replay $rim --emit bullet" \
  "solve $folder/line.jsonl --candidates reference" "replay --certify $rim" "export $lying --count 1" \
  "score $folder/given.jsonl --name mine --out $folder/lost" "check --corpus $folder/found" \
  "simulate rolling --candidates reference --step 0.01" \
  "check --search --candidate reference --pair cylinder-sphere --class cap --count 4" \
  "stability $rim $one --out $folder/lost" "report $lying $one --only scores --out $folder/lost"; do
  "$program" $command >/dev/full 2>"$folder/lost.log" </dev/null
  lost $? "touchstone $command > /dev/full"
done
# A pipe whose reader has ended.
exec 9> >(true)
wait $!
for command in "list candidates" "solve $folder/line.jsonl --candidates reference"; do
  "$program" $command >&- 2>"$folder/lost.log" </dev/null
  lost $? "touchstone $command >&-"
  (trap '' PIPE; exec "$program" $command >&9 2>"$folder/lost.log" </dev/null)
  lost $? "touchstone $command | true, without SIGPIPE"
done
# It ends the program quietly, as it does others.
env --default-signal=PIPE "$program" --manual >&9 2>"$folder/lost.log"
[ $? -eq 141 ] || failed "| true"
[ ! -s "$folder/lost.log" ] || failed "| true is not quiet"
exec 9>&-

# Results that took long to find are printed even where their file cannot be written.
mkdir -p "$folder/blocked"/{choose,report,stability}.json
blocked() {
  local found=$1
  shift
  expect 2 "$found" "$@"
  also '^error: --[a-z]* is .*: could not be written'
}
blocked 'can stands within' choose "$can" $brief --out "$folder/blocked"
blocked 'The default cylinder\|default cylinder, ' \
  choose "$can" --engine ode --disturbances 0 --out "$folder/blocked"
blocked 'left on right\|cylinder .* on cylinder' \
  choose "$folder/cart.urdf" --count 2 --candidates capsule --out "$folder/blocked"
blocked '^1 configuration, ' report $lying $one --only scores --out "$folder/blocked"
blocked '^1 answer, ' score "$folder/given.jsonl" --name mine --out "$folder/blocked"
blocked 'depth x' stability $rim $one --out "$folder/blocked"
expect 0 . report $lying $one --only scores --out "$folder/r"
blocked 'compared' compare "$folder"/r/report.json "$folder"/r/report.json --html /dev/full
for saved in "$folder"/found/*.json; do mkdir -p "$folder/taken/$(basename "$saved")"; done
expect 2 '^found: ' $deep --save "$folder/taken"
also '^error: --save is ".*/taken/capsule-'
# Standard error is where errors go; without it the exit code still tells.
"$program" replay nonsense 2>&-
[ $? -eq 2 ] || failed "2>&-"
"$program" replay nonsense 2>/dev/full
[ $? -eq 2 ] || failed "2>/dev/full"
expect 2 '--html.*No space left' replay $rim --html /dev/full --candidates reference

finish
