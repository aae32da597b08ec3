#!/usr/bin/env bash
# Test data for others, and the answers of others.
# shellcheck disable=SC2086 # pair and class
. "$(dirname "$0")/prelude.sh"

expect 0 '^1 configuration: ' export $lying --count 1 --out "$folder/one.csv"
expect 0 '^2 configurations: ' export $lying --count 2 --out "$folder/truth.csv"
[ "$(grep -c '^cylinder-plane/lying/1/[01],degenerate,' "$folder/truth.csv")" = 2 ] ||
  failed "export writes other configurations"
expect 0 '"id":"cylinder-plane/lying/1/1"' export $lying --count 2
expect 2 '--out is ".*/truth.txt": must end in .jsonl, .csv or .npz' export --out "$folder/truth.txt"
expect 2 '--format is "xml": must be one of' export --format xml
expect 2 '--suite' export --suite --count 3
expect 2 '--suite-2 is "all": must be one of smoke, everyday, hard, casts' export --suite-2 all
expect 2 '--format is .*: must be csv for --suite-2 casts' export --suite-2 casts --format npz
expect 0 '^cylinder-capsule/jolt-2103,degenerate,' export --suite-2 casts
expect 0 '^TEST_F(CylinderPlane, Lying)' export --as gtest --engine bullet --pair cylinder-plane
expect 0 'TEST_CASE("TestCollideCylinderVsSphereRim" \* doctest::should_fail())' export --as doctest --engine jolt --pair cylinder-sphere
also '^		CHECK(collector.HadHit());'  # Jolt's doctest has no REQUIRE: its exceptions are off
expect 2 '--as is "xml": must be one of gtest, boost, unittest, doctest, js, rust, mjcf' export --as xml --engine ode
expect 2 '--engine is "ode": must be one of mujoco, mujoco3, mujoco3-single for --as mjcf' export --as mjcf --engine ode
expect 2 '--engine is "ode": must be one of jolt, .* for --as js' export --as js --engine ode
expect 2 '--engine is missing: must name the engine' export --as gtest
expect 2 '--engine is "rapier@99": is unavailable: .*@dimforge/rapier3d-compat@99 is not in' export --as js --engine rapier@99
expect 2 '--engine is "rapier-world@0.13": must be rapier-world or rapier@ and a release' export --as js --engine rapier-world@0.13
expect 2 '--pair is "cylinder-plane": must be one that havok knows' export --as js --engine havok --pair cylinder-plane
expect 2 '--out.*No space left' export $lying --count 1 --format csv --out /dev/full

printf '{"id":"cylinder-plane/lying/1/0","status":"none"}\nno JSON\n' >"$folder/given.jsonl"
expect 2 "^error: $folder/given.jsonl: line 2: line is no JSON" score "$folder/given.jsonl" --name mine --out "$folder/given"
grep -q '"configurations": 1,' "$folder/given/report.json" ||
  failed "score loses what is good beside a bad line"
sed -i 2d "$folder/given.jsonl"
expect 0 '^candidate degen' score "$folder/given.jsonl" --name mine --out "$folder/given"
expect 2 '^error: --name is missing' score "$folder/given.jsonl" --out "$folder/given"
echo '{"id":"cylinder-plane/lying/1/0","status":"unsupported"}' >"$folder/unsupported.jsonl"
expect 0 '^Nothing was scored: mine answers "unsupported" to every configuration' \
  score "$folder/unsupported.jsonl" --name mine --out "$folder/given"
# Ids are as `solve` takes them; what cannot be used is told with its file.
echo '{"id":0,"a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"sphere","radius":1}}' >"$folder/poses.jsonl"
echo '{"id":0,"status":"none"}' >"$folder/own.jsonl"
own=(score "$folder/own.jsonl" --configurations "$folder/poses.jsonl" --name mine --out "$folder/given")
expect 0 '^candidate given' "${own[@]}"
expect 0 '"id":0' solve "$folder/poses.jsonl" --candidates reference
sed -i 's/0,/[0],/' "$folder/poses.jsonl"
expect 2 "^error: $folder/poses.jsonl: line 1: id is \[0\]: must be a string, a number, true, false or null" "${own[@]}"
echo '{"candidate":"a b"}' | cat - "$folder/given.jsonl" >"$folder/named.jsonl"
expect 2 "^error: $folder/named.jsonl: line 1: candidate is \"a b\": must be at most 100" score "$folder/named.jsonl" \
  --out "$folder/given"
expect 2 'missing for 5105 configurations' score "$folder/given.jsonl" --name mine --suite --out "$folder/given"
expect 2 'could not be opened' score "$folder/none.jsonl" --out "$folder/given"
: >"$folder/none.jsonl"
expect 2 'none.jsonl": must have a line that is an answer, as {"id"' score "$folder/none.jsonl" --name mine \
  --out "$folder/given"

finish
