#!/usr/bin/env bash
# Reports, their parts, and what has changed from one to another.
# shellcheck disable=SC2086 # pair and class
. "$(dirname "$0")/prelude.sh"

expect 2 '--count' report --count 0
expect 2 '--only is "speed": must be of scores' report --only speed
expect 2 '--pair.*cylinder-box' report --pair cylinder-cone
expect 2 '--class' report --class nowhere --out "$folder/r"
expect 2 '--out' report --out /proc/none
for only in scores timing casts stability experiments; do
  expect 0 '^1 configuration, ' report $lying --count 1 --candidates bullet --only $only --out "$folder/only"
  for part in '"ratio_to_bullet"' '"wrong_by_motion"' '"amplification"' '"experiments": {'; do
    case $only:$part in timing:*ratio* | casts:*wrong* | stability:*ampl* | experiments:*expe*) wanted=0 ;; *) wanted=1 ;; esac
    grep -q "$part" "$folder/only/report.json"
    [ $? -eq $wanted ] || failed "report --only $only, $part"
  done
done
# The first screen of the default candidates, and all that there is.
expect 0 "^reference (Touchstone's own)$" report --count 1 --group everyday --only scores --out "$folder/screen"
also '^Findings$' '^bullet-margin-0 ' '^  ./touchstone replay cylinder-[a-z+0-9/-]*$'
[ "$(wc -l <<<"$printed")" -le 42 ] || failed "a report prints more than 40 lines and its progress: $printed"
! grep -q 'fcl-indep\|all pairs' <<<"$printed" || failed "a report prints details unasked"
expect 0 '^all pairs, everyday poses$' report --count 1 --pair cylinder-plane,cylinder-sphere --class general \
  --only scores --candidates reference,capsule --details --out "$folder/screen"
also '^Worst failure of each candidate'
# A person's own configurations, by their ids.
for id in 1 two; do
  echo '{"id":"'$id'","a":{"shape":"cylinder","radius":1,"half_length":1},"b":{"shape":"box","half_extents":[1,1,1]},
    "pose_a":{"orientation":[1,0,1,1]}}' | tr -d '\n'
  echo
done >"$folder/poses.jsonl"
own=(report --configurations "$folder/poses.jsonl" --candidates reference,bullet)
expect 0 '^bullet: shallow in 2 of 2 given poses of cylinder-box' "${own[@]}" --out "$folder/own"
also '^2 configurations, ' "^  ./touchstone replay $folder/poses.jsonl --id \(1\|two\)$" '^candidate *given'
expect 0 'bullet' replay "$folder/poses.jsonl" --id two
expect 0 '^No change[.]$' compare "$folder/own/report.json" "$folder/own/report.json"
expect 2 '^error: --configurations is ".*poses.jsonl": leaves no choice of --pair, --class, --group or --count' \
  "${own[@]}" --count 3
expect 2 '^error: .*: line 1: line is no JSON' report --configurations <(echo rubbish) --candidates reference
expect 2 '^error: --configurations is "/dev/null": must have a configuration' report --configurations /dev/null
# What is given twice counts once.
expect 0 '^1 configuration, ' report --pair cylinder-plane,cylinder-plane --class lying,lying --count 1 \
  --candidates reference --only scores --out "$folder/twice"

expect 0 'report.html' report $lying --count 1 --candidates reference,bullet --only scores,timing --out "$folder/a b"
[ -s "$folder/a b/report.html" ] || failed "no report.html"
r="$folder/a b/report.json"
expect 0 '^No change[.]$' compare "$r" "$r" --html "$folder/compare.html"
also '100% of what agreed must agree still'
page_data "$folder/compare.html" | grep -q 'cylinder-plane' || failed "no page of compare"
expect 0 '"changes":\[\]' compare "$r" "$r" --json
python3 - "$r" "$folder/worse.json" <<'END'
import json, sys
report = json.load(open(sys.argv[1]))
row = next(r for r in report["results"] if r["class"] == "lying" and r["candidate"] == "bullet")
row["depth_error"] = {q: v if q == "histogram" else 3 * v + 1e-3 for q, v in row["depth_error"].items()}
json.dump(report, open(sys.argv[2], "w"))
END
expect 1 '^bullet: worse on cylinder-plane, 1 class, depth error' compare "$r" "$folder/worse.json"
expect 0 'smaller changes' compare "$r" "$folder/worse.json" --max-error-factor 1e300
expect 0 '^bullet: better on cylinder-plane, 1 class, ' compare "$folder/worse.json" "$r"
expect 0 '"fail_on":\["accuracy","time"\]' compare "$r" "$r" --json --fail-on time
expect 2 "must have two releases in --candidates, as rapier@1.0,rapier@1.1" report --history rapier --candidates reference
expect 2 "NEW is .ode.: must be a report.json, as OLD, or both must be releases of one engine" compare rapier@0.20 ode
expect 2 "@dimforge/rapier3d-compat@99 is not in" compare rapier@99 rapier@0.21
expect 2 '--fail-on is "speed": must be accuracy' compare "$r" "$r" --fail-on speed
expect 2 '--max-error-factor is "0.5"' compare "$r" "$r" --max-error-factor 0.5
expect 2 '--html' compare "$r" "$r" --html "$folder/none/compare.html"
cp "$r" "$folder/kept.json"
expect 2 '--html is ".*kept.json": must be another file than the input' compare "$r" "$folder/kept.json" \
  --html "$folder/kept.json"
cmp -s "$r" "$folder/kept.json" || failed "a page replaces the report that it is about"
# What is no report.
expect 2 'none.json.*could not be opened' compare "$r" "$folder/none.json"
echo '<testsuites/>' >"$folder/junit.xml"
expect 2 'junit.xml.*is no JSON' compare "$folder/junit.xml" "$r"
"$program" replay --certify $rim >"$folder/proof.json"
expect 2 'proof.json": must be the report.json of touchstone report, but has schema "touchstone-cert' \
  compare "$folder/proof.json" "$r"
expect 0 . campaign $lying --count 1 --candidates reference --out "$folder/c"
expect 2 'campaign.json": must be the report.json of touchstone report, but has schema "touchstone-camp' \
  compare "$r" "$folder/c/campaign.json"
# Another count, and one report has another pair as well: the groups of the common pair are compared.
expect 0 '2 configurations' report --candidates reference --count 1 --pair cylinder-plane,cylinder-sphere \
  --class lying,cap --only scores --out "$folder/both"
expect 0 '2 configurations' report --candidates reference --count 2 $lying --only scores --out "$folder/one"
expect 0 'compared' compare "$folder/both/report.json" "$folder/one/report.json"

finish
