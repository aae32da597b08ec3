#!/usr/bin/env bash
# A program shows its defect: defect_test.sh FILE CODE. It is compiled by the line in its comment, or run with the
# package of that version in TOUCHSTONE_NPM, and ends with that exit code.
set -eu
file=$1 code=$2 name=$(basename "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$file" "$folder"
cd "$folder"
compile=$(sed -n 's|^// Compile   \(.*\S\) *$|\1|p' "$name")
if [ -n "$compile" ]; then
  eval "${compile%%   (*}"
  run=(./reproducer)
else
  package=$(sed -n 's|^// Run       npm install \(.*\)@\(.*\) && .*|\1 \2|p' "$name")
  grep -qF "\"version\": \"${package#* }\"" "$TOUCHSTONE_NPM/node_modules/${package% *}/package.json"
  ln -s "$TOUCHSTONE_NPM/node_modules" node_modules
  run=(node "$name")
fi
actual=0
"${run[@]}" || actual=$?
[ "$actual" -eq "$code" ] || { echo "$name: exit code $actual, expected $code" >&2; exit 1; }
