#!/usr/bin/env bash
# Laws and their smallest failures, which are saved, known, fixed and reported to JUnit's readers.
. "$(dirname "$0")/prelude.sh"

# What takes least, of one law; `agreement` of the reference is the quickest to pass.
cap="--pair cylinder-sphere --class cap --count 1"
edge=(check --candidate bullet --pair cylinder-box --class edge-cap --count 1 --law agreement)

expect 2 '--law.*agreement' check --candidate bullet --law gravity
expect 2 '--class' check --candidate bullet --class nowhere
expect 2 '--corpus.*must be a folder' check --corpus "$folder/none"
mkdir "$folder/empty"
expect 2 '--corpus is ".*/empty": must have a saved failure' check --corpus "$folder/empty"
expect 2 '--known.*must be a folder' check --known "$folder/none"
expect 2 '--junit.*must be a folder that can be written' \
  check --candidate reference --count 1000000 --junit /proc/none/x.xml
# Failures that could not be saved are known before they are looked for.
for search in "" --search; do
  # shellcheck disable=SC2086
  expect 2 '^error: --save is "/proc/none": must be a folder that can be written to$' \
    check $search --candidate reference --save /proc/none
done

# What breaks a law of casts is simplified, saved, replayed and known as a contact's failure is.
casts=(check --candidate bullet --pair cylinder-box --law cast-free --class rim-face,edge-side,edge-cap --count 60)
expect 1 'replay - --candidates bullet$' "${casts[@]}" --save "$folder/casts" --junit "$folder/casts.xml"
also '^  truth: A ' '^cast-free, \|^  cast-free, cylinder-box, '
grep -q '<testcase classname="bullet.cylinder-box" name="cast-free".*<failure ' "$folder/casts.xml" ||
  failed "a cast's failure in JUnit XML"
expect 0 'as expected  bullet, cylinder-box, cast-free' check --corpus "$folder/casts"
expect 0 'cast-free .* nothing new  *known: ' "${casts[@]}" --known "$folder/casts"
expect 0 '^bullet  *\(late\|missed\) ' replay "$(ls "$folder"/casts/*.json | head -n 1)" --candidates bullet
sed -i 's/"cast-free"/"agreement"/' "$(ls "$folder"/casts/*.json | head -n 1)"
expect 2 'law is "agreement": must be one of casts' check --corpus "$folder/casts"
expect 0 '^  cast-free .* passed' check --candidate reference --pair cylinder-box --law cast-free --count 1
expect 2 '--law is "cast-free": must be a law of contacts: ode has no casts' check --candidate ode --law cast-free
# All laws. A line has no blanks at its end.
# shellcheck disable=SC2086
expect 0 'agreement .* passed' check --candidate reference $cap
also ', 1 configuration of each'
! grep -q ' $' <<<"$printed" || failed "check prints blanks at the end of a line"
# What is given twice counts once.
expect 0 'agreement .* passed' check --candidate reference --pair cylinder-sphere --class cap,cap --count 1 \
  --law agreement,agreement
[ "$(grep -c agreement <<<"$printed")" = 1 ] || failed "$ran: a law twice"
expect 2 'must have a routine for a pair' check --candidate libccd-gjk --pair cylinder-plane --count 1
expect 0 'no routine: no law was tried' check --candidate libccd-gjk --pair cylinder-plane,cylinder-sphere \
  --class general --count 1 --law answers --junit "$folder/none.xml"
grep -q 'skipped="1"' "$folder/none.xml" || failed "not skipped in JUnit"
expect 1 'missed *: wrong by [0-9.e-]* of the smaller size' check --candidate box-spheres:8 --class rim-face \
  --count 1 --law agreement
# A distance of exactly -2 is written so, whichever side of it the proven bounds lie.
expect 1 'truth: signed distance -2 m' check --candidate bullet --pair cylinder-sphere --class concentric \
  --count 1 --law agreement

expect 1 'broken by' "${edge[@]}" --save "$folder/corpus" --junit "$folder/junit.xml"
# What is printed of a failure has the numbers of its file, to the last bit.
python3 - "$folder/corpus" "$printed" <<'END' || failed "$ran: prints another configuration than it saves"
import glob, json, re, sys
saved = [json.load(open(file))["configuration"] for file in glob.glob(sys.argv[1] + "/*.json")]
assert json.loads(re.search(r"echo '(\{.*\})' \|", sys.argv[2])[1]) in saved
assert saved[0]["a"]["radius"].startswith("0x")
END
expect 0 'as expected' check --corpus "$folder/corpus"
expect 0 'bullet: .*missed\|bullet: contact, shallow' \
  replay "$(ls "$folder"/corpus/*.json | head -n 1)" --candidates bullet
# --json prints, everywhere; a file is the shell's.
"$program" "${edge[@]}" --json --save "$folder/corpus" --corpus "$folder/corpus" >"$folder/check.json"
sed -i 's/"missed"/"overdeep"/; s/"shallow"/"overdeep"/' "$folder"/corpus/*.json
expect 1 'changed' check --corpus "$folder/corpus"
echo '{' >"$folder/corpus/broken.json"
expect 2 'broken.json' check --corpus "$folder/corpus"

# What engines are not built for has to be asked for.
tried() { # OPTIONS…: of one law
  "$program" check --candidate reference --pair cylinder-plane --count 1 --law answers --json "$@" |
    python3 -c 'import json, sys; c = json.load(sys.stdin); print(c["laws"][0]["tried"], *c["groups"])'
}
usual=$(tried)
[ "$usual" = "$(tried --group everyday,degenerate,recorded)" ] || failed "check takes other groups: $usual"
[ "${usual%% *}" -lt "$(tried --group everyday,degenerate,recorded,extreme | cut -d ' ' -f 1)" ] ||
  failed "check takes extreme poses unasked"
expect 0 ' of everyday, degenerate, recorded poses, tolerance' \
  check --candidate reference --pair cylinder-plane --count 1 --law answers
# What is met every day comes first, whatever the pair.
expect 1 'first met in extreme poses' check --candidate capsule --pair cylinder-plane,cylinder-box --count 3 \
  --class general+coin,edge-cap --law agreement
[ "$(grep -o 'first met in [a-z]*' <<<"$printed" | head -n 1)" = "first met in everyday" ] ||
  failed "$ran: an extreme pose comes first"

# Known failures are expected, new ones are not; a fixed one is told; what cannot be asked fails the run.
edges=(check --candidate bullet --pair cylinder-box --class edge-cap,edge-side --count 3 --law agreement)
expect 1 'start with the first' "${edges[@]}" --save "$folder/known"
expect 0 'causes of failures are known' "${edges[@]}" --known "$folder/known" --junit "$folder/known.xml"
also 'agreement .* nothing new  *known: '
grep -q 'failures="0"' "$folder/known.xml" || failed "JUnit XML of known failures"
[ "$(grep -c '<skipped message="known: ' "$folder/known.xml")" = "$(($(ls "$folder/known" | wc -l) + 1))" ] ||
  failed "known failures look like successes in JUnit XML"
expect 0 'as expected' check --known "$folder/known"
cp -r "$folder/known" "$folder/less" && rm "$(ls "$folder"/less/*.json | head -n 1)"
expect 1 'broken by' "${edges[@]}" --known "$folder/less" --junit "$folder/less.xml"
grep -q 'failures="1"' "$folder/less.xml" || failed "JUnit XML of a new failure"
grep -q '<failure .*message="[^"]*; known: ' "$folder/less.xml" || failed "JUnit XML of new and known failures"
cp -r "$folder/known" "$folder/other" && sed -i 's/"candidate": "bullet"/"candidate": "reference"/' "$folder"/other/*.json
expect 0 'fixed  *reference' check --known "$folder/other" --junit "$folder/fixed.xml"
grep -q 'failures="0"' "$folder/fixed.xml" || failed "JUnit XML of a fixed failure"
expect 1 'broken by' "${edges[@]}" --known "$folder/other"
sed -i 's/"candidate": "reference"/"candidate": "no-such-engine"/' "$folder"/other/*.json
for option in --known=1 --corpus=0; do
  expect "${option#*=}" 'skipped  *no-such-engine' check "${option%=*}" "$folder/other"
  also 'candidate is not installed'
done

# A plug-in's file names its first candidate, and a known name comes before a file of that name.
plugin=$(dirname "$program")/candidates/testing/touchstone-sabotage.so
# shellcheck disable=SC2086
expect 1 '^misdeed:[0-9]* 1, seed' check --candidate "$plugin" $cap --law agreement --save "$folder/engine" \
  --junit "$folder/engine.xml"
# shellcheck disable=SC2086
expect 1 'as expected  misdeed:' check --candidate "$plugin" --corpus "$folder/engine" $cap --law agreement
# What is not finite is named.
# shellcheck disable=SC2086
expect 1 '^  answer: signed distance .* normal \[nan,' --load "$plugin" check --candidate misdeed:11 $cap --law answers
touch "$folder/bullet"
pushd "$folder" >/dev/null || exit 1
# shellcheck disable=SC2086
expect 0 'agreement .* passed' check --candidate bullet $cap --law agreement
popd >/dev/null || exit 1
python3 - "$folder" <<'END' || failed "JUnit XML or JSON of check"
import json, sys, xml.etree.ElementTree as tree
suite = tree.parse(sys.argv[1] + "/junit.xml").getroot()[0]
assert suite.get("failures") == "1" and suite[0][0].tag == "failure"
assert suite[0].get("classname") == "bullet.cylinder-box"
assert 0 < float(suite[0].get("time")) <= float(suite.get("time"))
plugin = tree.parse(sys.argv[1] + "/engine.xml").getroot()[0]
assert plugin[0].get("classname").startswith("misdeed:"), plugin[0].get("classname")
assert json.load(open(sys.argv[1] + "/check.json"))["laws"][0]["broken"] == 1
END

# What a search finds is saved alike.
deep=(check --search --candidate capsule --pair cylinder-sphere --class general-deep)
expect 1 'shallow\|overdeep\|missed' "${deep[@]}" --count 40 --save "$folder/found"
also "replay - --candidates capsule" '^cylinder-sphere points .* 1 *1$'
expect 0 'as expected' check --corpus "$folder/found"
expect 0 'capsule: contact, \|capsule: none, ' replay "$(ls "$folder"/found/*.json | head -n 1)" --candidates capsule
"$program" "${deep[@]}" --count 4 --json | python3 -m json.tool >"$folder/found.json" ||
  failed "check --search --json is no JSON"

finish
