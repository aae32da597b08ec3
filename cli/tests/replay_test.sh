#!/usr/bin/env bash
# One configuration again: what is printed, its page, and programs that show it to an engine's maintainers.
. "$(dirname "$0")/prelude.sh"

# A table of the truth and the default candidates, and of those that are named all that they answer. Lines of JSON
# alone, which come last, are longer than a terminal.
expect 0 "^reference (Touchstone's own)$" replay $rim
also '^truth  *-[0-9.e-]*$' '^bullet  *unseen  *none' '^normal (.*), ties: unique; contact patch: point$'
[ "$(sed -n 4p <<<"$printed" | cut -c 1-9)" = candidate ] || failed "replay begins with $printed"
[ "$(wc -l <<<"$printed")" -le 25 ] || failed "replay prints more than 25 lines: $printed"
! grep -q '^  point \|^{' <<<"$printed" || failed "replay prints points unasked"
awk 'length($0) > 80 { exit 1 }' <<<"$printed" || failed "replay is wider than 80 columns"
expect 0 '^ode: contact, agree' replay $rim --candidates reference,ode
also 'reference: contact, agree' '^  point (' '^    depth [0-9.e-]*$' '^truth: signed distance between$' '^{"a":'
grep -v '^{' <<<"$printed" | awk 'length($0) > 80 { exit 1 }' || failed "an answer is wider than 80 columns"
# Variants are asked when they are named, or all candidates.
! "$program" replay $rim | grep -q fcl-indep || failed "replay asks variants unasked"
expect 0 '^fcl-indep  *agree' replay $rim --all-candidates
expect 2 '^error: --.*candidates is given with --.*candidates: must stand without it' \
  replay $rim --all-candidates --candidates bullet
expect 0 "\"id\":\"$rim\"" replay $rim --json
expect 0 'reference: contact' replay <(echo "$printed") --candidates reference
expect 0 'reference: contact' replay $rim --candidates reference --html "$folder/page.html"
page_data "$folder/page.html" | grep -q "$rim" || failed "no page"
expect 2 '--html.*must be a folder that can be written' replay $rim --html /proc/none/page.html
expect 2 '--html.*must be a file, not a folder' replay $rim --html "$folder"
expect 0 . replay $rim --candidates reference --json
echo "$printed" >"$folder/rim.json"
expect 2 '--html is ".*rim.json": must be another file than the input' replay "$folder/rim.json" --html "$folder/rim.json"
expect 2 '--tolerance' replay $rim --tolerance=-1

# Identities, of small steps, of maps and of motions too.
expect 2 'identity.pair' replay cylinder-cone/rim/1/2
expect 2 'identity.class' replay cylinder-box/none/1/2
expect 2 'nosuch.json.*no such file' replay nosuch.json
expect 2 '^error: input is ".*": must be a file, not a folder' replay "$folder"
expect 2 'perturbation.amplitude' replay $rim@1e-99/1/1
expect 2 'map.pose.*standing' replay map/none/1e-8/0/0
expect 2 'sequence.motion.*roll-over-edge' replay sequence/none/0/1
echo '{"configuration":{"a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":1}}}' \
  >"$folder/saved.json"
for identity in map/standing/1e-12/-3/16 sequence/roll-over-edge/113/200 cylinder-box/side-on-face/1/0@1e-8/1/4; do
  expect 0 'reference: contact, agree' replay $identity --candidates reference
done
expect 0 'reference: contact' replay "$folder/saved.json@1e-2/1/0" --candidates reference

# Lines of a file have ids, which are kept; which of several is meant has to be said.
printf '%s\n' '{"id":"one","a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":1}}' \
  '{"id":2,"configuration":{"a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":2}}}' \
  >"$folder/lines.jsonl"
expect 2 '^error: input is ".*/lines.jsonl": must hold one configuration, not 2; .*--id of one, 2$' \
  replay "$folder/lines.jsonl"
expect 2 'must hold one configuration, not 2' replay "$folder/lines.jsonl@1e-2/1/0"
expect 2 'must hold one configuration, not 2' stability "$folder/lines.jsonl"
expect 2 'must hold one configuration, not 2' replay --certify "$folder/lines.jsonl"
expect 2 '^error: --id is "three": must be one of one, 2$' replay "$folder/lines.jsonl" --id three
expect 2 '^error: --id is "one": must be of a line of a file$' replay $rim --id one
expect 2 'nosuch.jsonl.*there is no such file' replay "$folder/nosuch.jsonl" --id one
expect 0 '^one$' replay "$folder/lines.jsonl" --id one --candidates reference
also '"id":"one"'
expect 0 '"radius":2' replay "$folder/lines.jsonl" --id 2 --candidates reference --json
also '"id":"2"' "replay $folder/lines.jsonl --id 2"
expect 0 '^// Asked .*lines.jsonl, id 2$' replay "$folder/lines.jsonl" --id 2 --emit bullet
sed 's/"id":2/"id":null/' "$folder/lines.jsonl" >"$folder/null.jsonl"
expect 0 '"radius":2' replay "$folder/null.jsonl" --id null --candidates reference --json
sed 's/"id":2/"id":[2]/' "$folder/lines.jsonl" >"$folder/list.jsonl"
expect 2 '^error: id is \[2\]: must be a string, a number, true, false or null' replay "$folder/list.jsonl" --id one
head -n 1 "$folder/lines.jsonl" >"$folder/line.jsonl"
expect 0 '^one$' replay "$folder/line.jsonl" --candidates reference
cat "$folder/line.jsonl" "$folder/line.jsonl" >"$folder/twice.jsonl"
expect 2 '^error: --id is "one": must be of one line, not of 2$' replay "$folder/twice.jsonl" --id one
(cat "$folder/line.jsonl" && echo nonsense) >"$folder/bad.jsonl"
expect 2 '^error: .*/bad.jsonl: line 2 is no JSON' replay "$folder/bad.jsonl" --id one
# What ends in a backslash does not make the next line of a program a part of its comment.
sed 's/"one"/"one\\\\"/' "$folder/line.jsonl" >"$folder/backslash.jsonl"
expect 0 '^// Asked .*, id one\\\.$' replay "$folder/backslash.jsonl" --emit ode

# A cast: when it touches first; what knows no casts says so.
echo '{"id":"c","a":{"shape":"cylinder","radius":0.5,"half_length":1},"pose_a":{"position":[0,0,5]},"b":{"shape":"sphere","radius":1},"sweep":[0,0,-9]}' \
  >"$folder/cast.jsonl"
expect 0 'cast: A touches B first when it has gone 0.3333' replay "$folder/cast.jsonl"
also '^ *agree  *touch  *0.3333' '"sweep":\[0.0,0.0,-9.0\]'
expect 0 '"cast":{"answers":{"reference":{"fraction":0.3333' replay "$folder/cast.jsonl" --json --candidates reference
echo "$printed" >"$folder/saved_cast.json"
expect 0 'cast: A touches B first when it has gone 0.3333' replay "$folder/saved_cast.json" --candidates reference
expect 0 '^// True     A touches B first when it has gone 0.3333' replay "$folder/cast.jsonl" --emit bullet
also 'btCollisionWorld::objectQuerySingle(' '^// Seen     Bullet .*: agree, touch at 0.3333'
expect 2 '^error: --emit is "ode": must be one of bullet, .*jolt.*, whose programs know casts of cylinder-sphere$' \
  replay "$folder/cast.jsonl" --emit ode
expect 2 '^error: spin is given: must be left out: --emit knows no turns' replay <(sed 's/"sweep"/"spin":[1,0,0],&/' "$folder/cast.jsonl") --emit bullet
graze='{"a":{"shape":"cylinder","radius":0.5,"half_length":1},"pose_a":{"position":[-3,0,1.5],"axis":"y"},"b":{"shape":"sphere","radius":1},"pose_b":{"position":[0.001,0,0]},"sweep":[7,0.1,0]}'
expect 2 '^error: sweep is of a graze of which no proof' replay <(echo "$graze") --emit bullet
expect 0 '"schema":"touchstone-cast-certificate-1"' replay "$folder/cast.jsonl" --certify
expect 0 '"spin":\["0x1p+0","0x0p+0","0x0p+0"\]' replay <(sed 's/"sweep"/"spin":[1,0,0],&/' "$folder/cast.jsonl") --certify
expect 2 '^error: spin is 101.*: must be at most 100' replay <(sed 's/"sweep"/"spin":[101,0,0],&/' "$folder/cast.jsonl") --certify
expect 2 '^error: sweep is of bodies that touch or overlap: must start' replay <(sed 's/0,0,5/0,0,1/' "$folder/cast.jsonl") --certify
expect 2 '^error: sweep is .*must be left out: stability knows no casts' stability "$folder/cast.jsonl"
expect 2 'sweep\[1\] is \[\]: must be' replay <(sed 's/\[0,0,-9\]/[0,[],1]/' "$folder/cast.jsonl")

# Programs.
expect 0 '#include <BulletCollision' replay $rim --emit bullet
expect 0 'btSphereShape shape_b' replay "$folder/saved.json" --emit bullet
# Every setting of an engine of Debian has a program of the engine alone, but for those that are models or motions.
for variant in bullet-margin-0 bullet-float bullet-float-margin-0 fcl-indep fcl-distance libccd-mpr; do
  expect 0 '^#include <\(Bullet\|fcl\|ccd\)' replay $rim --emit $variant
  ! grep -q 'touchstone-.*so' <<<"$printed" || failed "$ran loads a plug-in"
done
expect 0 '^#include <coal/collision.h>' replay $rim --emit coal
expect 0 'touchstone-bullet.so' replay $rim --emit bullet-persistent
expect 0 'npm install jolt-physics@' replay $rim --emit jolt
expect 0 'TEST_CASE("TestCollideCylinderVsBox")' replay $rim --emit jolt-margin:0.01 --language c++
also 'on the numbers below, before they are rounded to float'
apart='{"a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":1},"pose_b":{"position":[0,0,2.25]}}'
expect 0 'They are 0.25 apart, which is within what was asked for' replay <(echo "$apart") --threshold 0.5 --emit jolt --language c++
huge='{"a": {"shape": "cylinder", "radius": 1e300, "half_length": 1}, "b": {"shape": "sphere", "radius": 1}}'
expect 2 '--emit.*"jolt": .*no float holds 1e+300' replay <(echo "$huge") --emit jolt --language c++
expect 2 '--emit.*"jolt": .*no float holds 1e-300' replay <(echo "${huge/1e300/1e-300}") --emit jolt --language c++
expect 2 '--emit.*jolt-margin:-1.*from 0 to 1' replay $rim --emit jolt-margin:-1
expect 2 '--emit.*no-such-engine.*must be one of bullet, .*ode, .*fcl, .*libccd, .*mujoco' replay $rim --emit no-such-engine
expect 2 '--emit.*libccd.*half-space' replay cylinder-plane/general-deep/1/2 --emit libccd
expect 2 '--emit.*havok.*half-space' replay cylinder-plane/general-deep/1/2 --emit havok
# A program knows convex bodies, or is not written.
tip='{"a":{"shape":"cylinder","radius":0.5,"half_length":1},"pose_a":{"position":[0.1,0.05,1.95]},"b":{"shape":"convex","vertices":[[-1,-1,0],[1,-1,0],[0,1.5,0],[0,0,1]]}}'
expect 0 'btConvexHullShape shape_b' replay <(echo "$tip") --emit bullet
for engine in mujoco jolt havok; do
  expect 2 "^error: --emit is \"$engine\": must be one of bullet, .*fcl, .*libccd-mpr, or another candidate of a plug-in, that knows convex bodies" \
    replay <(echo "$tip") --emit $engine
done
expect 2 '--emit.*"bullet.touchstone".*routine for cylinder-convex' replay <(echo "$tip") --emit bullet+touchstone
expect 2 '--emit.*bullet:3.*takes no number' replay $rim --emit bullet:3
expect 2 '--language.*must be c++ for bullet' replay $rim --emit bullet --language python
expect 2 '--language.*must be javascript or c++ for jolt' replay $rim --emit jolt --language c
expect 2 '--language.*must stand beside --emit' replay $rim --language c++
expect 2 'identity.class' replay cylinder-box/none/1/2 --emit bullet
expect 2 'standard input is no JSON' replay - --emit bullet
expect 2 '^error: --.* is given with --.*: must stand without it' replay $rim --emit bullet --json

# A file's name cannot become a line of a program, or of what is printed.
lines="$folder/$(printf 'x\n#error\n').json"
cp "$folder/saved.json" "$lines"
for way in "--candidates bullet" "--emit bullet"; do
  # shellcheck disable=SC2086
  expect 0 . replay "$lines" $way
  ! grep -q '^#error' <<<"$printed" || failed "a file's name is a line of its own with replay $way"
done

finish
