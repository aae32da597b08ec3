#!/usr/bin/env bash
# Installs the packages of package-lock.json, once: install.sh [FOLDER, by default build/npm]. The engines
# look for them there, or in the folder that TOUCHSTONE_NPM names. Needs node 18 or later and npm.
set -eu
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=${1:-$here/../../build/npm}
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "$0: node and npm are not installed (on Debian: apt-get install nodejs npm)" >&2
  exit 1
fi
# npm writes node_modules/.package-lock.json last.
if cmp -s "$here/package-lock.json" "$folder/package-lock.json" &&
    [ -e "$folder/node_modules/.package-lock.json" ]; then
  exit 0
fi
echo "Installing the engines of npm in $folder" >&2
mkdir -p "$folder"
cp "$here/package.json" "$here/package-lock.json" "$folder/"
(cd "$folder" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error >&2)
