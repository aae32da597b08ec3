#!/usr/bin/env bash
# Installed without an engine, or without node: a line says so, and the rest is there.
. "$(dirname "$0")/prelude.sh"

built=$(dirname "$program")
mkdir "$folder/part" "$folder/part/candidates"
cp "$program" "$folder/part/"
cp "$built"/candidates/touchstone-{*.so,host} "$folder/part/candidates/"
rm -f "$folder"/part/candidates/touchstone-{fcl,robots}.so
program=$folder/part/touchstone
expect 0 '^fcl: skipped; .*libfcl-dev' list candidates
also '^bullet 3'
expect 2 '"fcl-distance": is unavailable; fcl: skipped; was not built; install .*libfcl-dev' \
  replay $rim --candidates fcl-distance
expect 2 'must be one of reference, ' replay $rim --candidates flc
echo '<robot name="arm"/>' >"$folder/arm.urdf"
expect 2 '^error: scene is ".*arm.urdf": needs .*/touchstone-robots.so: ninja plugin_robots builds it$' \
  choose "$folder/arm.urdf"
mv "$folder/part/candidates/touchstone-host" "$folder/part/"
expect 2 '^error: touchstone-host is ".*/candidates/touchstone-host": .*"No such file or directory"; build or install Touchstone again$' \
  replay $rim --candidates bullet
mv "$folder/part/touchstone-host" "$folder/part/candidates/"

# It is on the PATH, and what it prints is run so.
expect 1 "^  echo '{.*}' | touchstone replay - --candidates bullet" check --candidate bullet --pair cylinder-box \
  --class edge-cap --count 1 --law agreement
expect 0 '^  touchstone replay cylinder-' report --pair cylinder-plane --class general-shallow --count 3 \
  --candidates bullet,capsule --out "$folder/report"
! grep -qF ./touchstone - "$folder"/report/report.* <<<"$printed" || failed "there is no ./touchstone to run"

# There no ./touchstone installs what an engine from npm needs.
there=$folder/there
mkdir -p "$there/bin" "$there/lib" "$there/share/touchstone/candidates"
mv "$program" "$there/bin/"
mv "$folder/part/candidates" "$there/lib/touchstone"
cp -r "$source_folder/candidates/npm" "$there/share/touchstone/candidates/"
program=$there/bin/touchstone
without() { PATH=$1 "$program" replay $rim --candidates jolt 2>&1; }
grep -q 'is unavailable: node is not installed; install Debian.s packages nodejs and npm' <<<"$(without /nowhere)" ||
  failed "no remedy without node"
printf '#!/bin/sh\n' >"$there/bin/node" && chmod +x "$there/bin/node"
grep -q "jolt-physics is not in .*; copy package.json and package-lock.json from .*/share/touchstone/candidates/npm into" \
  <<<"$(without "$there/bin")" || failed "no remedy for an engine from npm"

finish
