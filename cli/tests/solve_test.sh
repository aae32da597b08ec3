#!/usr/bin/env bash
# Configurations of one's own, and certificates of their truth.
. "$(dirname "$0")/prelude.sh"

expect 2 '--time-limit' solve --time-limit 0
expect 2 '--width' solve --width 0
expect 2 'could not be opened' solve "$folder/none.jsonl"
# A list takes one argument: what follows is another.
echo '{"a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":1}}' >"$folder/one.jsonl"
expect 0 '"reference":{' solve --candidates reference "$folder/one.jsonl"
# Rows of CSV, and workers, which change nothing.
expect 0 '^1,,reference,' solve --candidates reference,capsule --csv "$folder/one.jsonl"
[ "$("$program" solve --candidates reference,capsule --csv --workers 2 "$folder/one.jsonl")" = "$printed" ] ||
  failed "solve --workers 2 writes something else"
# Nor where a candidate answers by what it was asked before: sessions begin at the same lines.
sed 's/^  answer->status = TS_NONE;/  static int asked; answer->status = TS_CONTACT; answer->point_count = 0;\
  answer->signed_distance = -++asked; if (asked > 0) return;/' \
  "$source_folder/candidates/example/cylinder_plane.c" >"$folder/counts.c"
cc -shared -fPIC -I "$(dirname "$program")/include" "$folder/counts.c" -o "$folder/counts.so" -lm
for _ in {1..600}; do
  echo '{"a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"plane","normal":[0,0,1],"displacement":0}}'
done >"$folder/many.jsonl"
counted() {
  "$program" --load "$folder/counts.so" solve --candidates my-engine --csv --workers "$1" "$folder/many.jsonl"
}
one=$(counted 1)
{ grep -q '^256,.*,contact,-256' <<<"$one" && grep -q '^257,.*,contact,-1.0,' <<<"$one"; } || failed "sessions of solve"
[ "$(counted 3)" = "$one" ] || failed "solve --workers 3 asks in other sessions"
expect 2 'line 1 is without an end: must have at most' solve --workers 2 --candidates reference /dev/zero
# A direction or a matrix in place of a quaternion.
turned='{"a":{"shape":"cylinder","radius":1,"half_length":2},"b":{"shape":"plane","normal":[0,1,0],"displacement":0}'
echo "$turned,\"pose_a\":{\"axis\":\"y\",\"position\":[0,2,0]}}" >"$folder/axis.jsonl"
expect 0 'pose a *.*1, -1, 0, 0\|"orientation":\[1.0,-1.0,0.0,0.0\]' replay "$folder/axis.jsonl" --candidates reference --json
expect 0 '"signed_distance":\["0' solve "$folder/axis.jsonl" --candidates reference
echo "$turned,\"pose_a\":{\"rotation\":[[1,0,0],[0,1,0],[0,0,2]]}}" >"$folder/no_rotation.jsonl"
expect 2 'pose_a.rotation is \[\[1, 0, 0\], .*: must be a rotation to 1e-09, but column 3 has length 2' \
  solve "$folder/no_rotation.jsonl" --candidates reference
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
