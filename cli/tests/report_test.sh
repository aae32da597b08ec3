#!/usr/bin/env bash
# Reports, their parts, and what has changed from one to another.
# shellcheck disable=SC2086 # pair and class
. "$(dirname "$0")/prelude.sh"

expect 2 '--count' report --count 0
expect 2 '--only is "speed": must be of scores' report --only speed
expect 2 '--pair.*cylinder-box' report --pair cylinder-cone
expect 2 '--class' report --class nowhere --out "$folder/r"
expect 2 '--out' report --out /proc/none
for only in scores timing stability experiments; do
  expect 0 '^1 configuration, ' report $lying --count 1 --candidates reference --only $only --out "$folder/only"
  for part in '"ratio_to_bullet"' '"amplification"' '"experiments": {'; do
    case $only:$part in timing:*ratio* | stability:*ampl* | experiments:*expe*) wanted=0 ;; *) wanted=1 ;; esac
    grep -q "$part" "$folder/only/report.json"
    [ $? -eq $wanted ] || failed "report --only $only, $part"
  done
done
# What is given twice counts once.
expect 0 '^1 configuration, ' report --pair cylinder-plane,cylinder-plane --class lying,lying --count 1 \
  --candidates reference --only scores --out "$folder/twice"

expect 0 'report.html' report $lying --count 1 --candidates reference,bullet --only scores,timing --out "$folder/a b"
[ -s "$folder/a b/report.html" ] || failed "no report.html"
r="$folder/a b/report.json"
expect 0 'No change' compare "$r" "$r" --html "$folder/compare.html"
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
expect 1 'cylinder-plane/lying  bullet' compare "$r" "$folder/worse.json"
expect 0 'smaller changes' compare "$r" "$folder/worse.json" --max-error-factor 1e300
expect 0 'Better: 1' compare "$folder/worse.json" "$r"
expect 0 '"fail_on":\["accuracy","time"\]' compare "$r" "$r" --json --fail-on time
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
