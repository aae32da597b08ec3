#!/usr/bin/env bash
# What is printed fits the terminal, or COLUMNS, or 80 columns; colours are for terminals.
# shellcheck disable=SC2086 # commands
. "$(dirname "$0")/prelude.sh"
export LC_ALL=C.UTF-8
can=$source_folder/cli/tests/scenes/can.json

# on_terminal COLUMNS ARGUMENTS: what is seen on a terminal of that width.
on_terminal() { TERM=xterm script -qec "stty cols $1; '$program' $2" /dev/null </dev/null | tr -d '\r'; }
# wider_than COLUMNS TEXT: its lines that are.
wider_than() { grep ".\{$(($1 + 1))\}" <<<"$2"; }

replayed="replay cylinder-box/edge-cap/1/2 --candidates reference,bullet"
[[ $(on_terminal 80 "$replayed") == *$'\e[32mreference'* ]] || failed "no colour on a terminal"
[[ $(NO_COLOR=1 on_terminal 80 "$replayed") != *$'\e'* ]] || failed "colour in spite of NO_COLOR"
[[ $(on_terminal 80 "export --format npz --count 1 $lying") == *'--out is a terminal: must be a file or a pipe for npz'* ]] ||
  failed "npz goes to a terminal"

for command in "" $("$program" --help | sed -n '/^Subcommands/,/^Examples/s/^  \([a-z]*\) .*/\1/p'); do
  # But for examples, which stay whole.
  narrow=$(on_terminal 40 "$command --help")
  [ "$(wc -l <<<"$narrow")" -gt 7 ] || failed "no help of $command"
  wide=$(wider_than 40 "$(grep -v '^  [a-z]* *touchstone \|^  *\(echo\|mpirun\|python3\|"b"\)\|touchstone solve$' <<<"$narrow")")
  [ -z "$wide" ] || failed "$command --help is wider than a terminal of 40 columns: $wide"
done

# What each command prints; but for a long word, as of a path, and JSON.
broken="check --candidate bullet --pair cylinder-box,cylinder-sphere --class edge-cap,cap,concentric --count 1"
"$program" $broken --law agreement --save "$folder/known" >/dev/null
"$program" report $lying --count 1 --candidates reference,bullet --only scores --out "$folder/old" >/dev/null 2>&1
sed 's/"max": [0-9.e-]*/"max": 0.1/' "$folder/old/report.json" >"$folder/worse.json"
commands=("list candidates" "list classes cylinder-box" "$replayed" "$broken" "check --known $folder/known"
  "compare $folder/old/report.json $folder/worse.json"
  "simulate rolling --candidates reference,capsule-circumscribed --step 0.01" "simulate lying --engine ode"
  "check --search --candidate bullet --pair cylinder-cylinder --class perpendicular-t-centred+turned --count 4"
  "stability $rim --candidates reference --count 1 --out $folder/s"
  "choose $can --candidates capsule --disturbances 1 --out $folder/s"
  "report $lying --count 1 --candidates reference,bullet --only scores,timing --out $folder/s"
  "report $lying --count 1 --candidates reference,bullet --only scores,timing --details --out $folder/s")
for command in "${commands[@]}"; do
  shown=$(COLUMNS=40 "$program" $command)
  [ "$(wc -l <<<"$shown")" -gt 3 ] || failed "$command prints nothing"
  wide=$(wider_than 40 "$(grep -v '[^ ]\{30\}' <<<"$shown")")
  [ -z "$wide" ] || failed "$command is wider than COLUMNS=40: $wide"
done
for command in "list candidates" "list classes cylinder-box"; do
  wide=$(wider_than 40 "$(on_terminal 40 "$command" | grep -v '[^ ]\{30\}')")
  [ -z "$wide" ] || failed "$command is wider than a terminal of 40 columns: $wide"
done
for command in "${commands[@]:0:3}" "${commands[@]:6:3}"; do
  wide=$(wider_than 80 "$("$program" $command | grep -v '^{\|[^ ]\{60\}')")
  [ -z "$wide" ] || failed "$command is wider than 80 columns: $wide"
done
[[ $(COLUMNS=40 on_terminal 80 "$broken --law agreement") == *$'\e[0m\n    '[0-9]* ]] ||
  failed "COLUMNS is not heard on a terminal"
[ "$(COLUMNS=many "$program" $replayed)" = "$("$program" $replayed)" ] || failed "COLUMNS=many"

finish
