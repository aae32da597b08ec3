#!/usr/bin/env bash
# The history of an engine from npm, and two of its releases compared, by the real ones:
# history_test.sh PROGRAM FOLDER-WITH-PACKAGES. Without npm's registry nothing is tested.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
program=$1
export TOUCHSTONE_NPM=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
say() { printf '%s\n' "$*"; }
# shellcheck source=candidates/npm/releases.sh
. "$here/releases.sh"
if [ -z "$(npm_releases jolt-physics)" ]; then
  echo "npm's registry cannot be asked"
  exit 0
fi

failed() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}
# Since 0.20 or before, sides of parallel cylinders are answered wrong.
for release in rapier@0.12 rapier@0.20; do install_release $release "$TOUCHSTONE_NPM/versions"; done
text=$("$program" report --history rapier --candidates rapier@0.12,rapier@0.20 --pair cylinder-cylinder \
  --class parallel-side+turned --count 4 --out "$work")
grep -qE '^rapier@0.12 +100.0 +[0-9]+  -$' <<<"$text" || failed "$text"
grep -qF 'rapier@0.20 broke parallel-side+turned: 100.0% -> ' <<<"$text" || failed "$text"
grep -qF '"engine":"rapier"' "$work/report.json" || failed "no history in report.json"
[ -s "$work/history.html" ] || failed "no page"

text=$("$program" compare rapier@0.12 rapier@0.20) && failed "no regression of 0.20"
grep -q '^rapier: worse on cylinder-cylinder, ' <<<"$text" || failed "$text"
grep -qF 'rapier: version 0.12.0 before, 0.20.0 now.' <<<"$text" || failed "$text"

# A file of tests expects what its release answers, and a program that asks one repeats it.
cd "$work"
asks() { ln -sfn "$TOUCHSTONE_NPM/versions/@dimforge/rapier3d-compat@$1/node_modules" . && node "$2"; }
install_release rapier@0.15 "$TOUCHSTONE_NPM/versions"
for release in 0.12 0.15; do
  "$program" export --as js --engine rapier@$release --limit 9 >contacts.test.mjs
  grep -q "npm install @dimforge/rapier3d-compat@$release &&" contacts.test.mjs || failed "not of $release"
  asks $release contacts.test.mjs >printed || failed "$(cat printed)"
done
"$program" replay cylinder-box/general/1/0 --emit rapier-world@0.12 >reproducer.mjs
seen=$(grep -oP 'signed distance \K[-.0-9e]+' reproducer.mjs)
asks 0.12 reproducer.mjs | grep -qF -- "$seen" || failed "not $seen: $(asks 0.12 reproducer.mjs)"
