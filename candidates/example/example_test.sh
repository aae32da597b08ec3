#!/usr/bin/env bash
# Does what a user does: installs Touchstone somewhere, builds the example against the installed
# header alone, and scores it. example_test.sh BUILD-FOLDER COMPILER
set -eu
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cmake --install "$1" --prefix "$folder/prefix" >/dev/null
cp "$here/cylinder_plane.c" "$folder/"
cd "$folder"
"$2" -std=c11 -O2 -Wall -Wextra -Werror -shared -fPIC -I prefix/include cylinder_plane.c \
  -o my_engine.so -lm

touchstone=$folder/prefix/bin/touchstone
"$touchstone" list candidates | grep -q '^reference '  # the installed plug-ins are found
"$touchstone" --load ./my_engine.so list candidates | grep -A 1 '^my-engine 1.0' |
  grep -qx '  cylinder against plane'
"$touchstone" report --load ./my_engine.so --candidates reference,my-engine \
  --pair cylinder-plane --class touching-tilted,general-shallow,lying,standing --count 20 --out out \
  >table 2>messages || { cat messages; exit 1; }
grep -Eq 'my-engine +100\.0' table || { cat table; exit 1; }
grep -q -- '--load' out/report.json  # its worst cases can be replayed
