#!/usr/bin/env bash
# Configurations of one's own, and certificates of their truth.
. "$(dirname "$0")/prelude.sh"

expect 2 '--time-limit' solve --time-limit 0
expect 2 '--width' solve --width 0
expect 2 'could not be opened' solve "$folder/none.jsonl"
# A list takes one argument: what follows is another.
echo '{"a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":1}}' >"$folder/one.jsonl"
expect 0 '"reference":{' solve --candidates reference "$folder/one.jsonl"
# What turns the direction of what follows it is shown as digits.
expect 2 'file is ".*none\\u2066": could not be opened' solve "$folder/$(printf 'none\xe2\x81\xa6')"
sed 's/^{/{"id":"x\\u202e\\u001b",/' "$folder/one.jsonl" >"$folder/turned.jsonl"
expect 0 '"id":"x\\u202e\\u001b"' solve "$folder/turned.jsonl" --candidates capsule

# What replay prints last is a line for solve, which finds the same truth, and to be certified.
truth_of() { sed 's/.*"truth":\({[^}]*}\).*/\1/'; }
identity=cylinder-capsule/general-deep/3/4
replayed=$("$program" replay $identity --candidates reference --json | truth_of)
line=$("$program" replay $identity --candidates reference | grep '^{' | tail -n 1)
solved=$("$program" solve --width 1e-30 --candidates reference <<<"$line" | truth_of)
{ [ -n "$solved" ] && [ "$solved" = "$replayed" ]; } ||
  failed "solve gives another truth than replay: $solved instead of $replayed"
"$program" solve --audit --candidates reference <<<"$line" |
  grep -q '"audit":{"primal_dual_gap":null,"signed_distance":\["-' ||
  failed "solve --audit shows no enclosure of the second oracle"
expect 0 '"schema":"touchstone-certificate-1"' replay --certify $identity
[ "$("$program" replay --certify - <<<"$line")" = "$printed" ] ||
  failed "replay --certify proves something else of a line than of its identity"
expect 2 'identity.class' replay --certify cylinder-box/none/1/2
expect 2 '--width' replay --certify $rim --width 0
expect 2 '--cells' replay --certify $rim --cells -1
expect 2 '^error: --width is given: must stand beside --certify' replay $rim --width 1e-12
expect 2 '^error: --candidates is given with --certify: must stand without it' \
  replay --certify $rim --candidates reference
expect 2 'standard input is no JSON' replay --certify -

finish
