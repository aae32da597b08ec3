#!/usr/bin/env bash
# The scene files beside make_scenes.py are what it writes: make_scenes_test.sh PYTHON.
set -eu
here=$(dirname "$0")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" "$here/make_scenes.py" "$folder"
for made in "$folder"/*.json; do
  diff "$made" "$here/$(basename "$made")"
done
