#!/usr/bin/env bash
# A program shows its defect: defect_test.sh FILE CODE. It is compiled by the line in its comment, and ends with that
# exit code.
set -eu
file=$1 code=$2 name=$(basename "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$file" "$folder"
cd "$folder"
compile=$(sed -n 's|^// Compile   \(.*\S\) *$|\1|p' "$name")
eval "${compile%%   (*}"
actual=0
./reproducer || actual=$?
[ "$actual" -eq "$code" ] || { echo "$name: exit code $actual, expected $code" >&2; exit 1; }
