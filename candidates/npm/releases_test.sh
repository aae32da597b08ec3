#!/usr/bin/env bash
# Which releases of npm's engines are found and installed, with an npm that only plays.
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat >"$work/npm" <<'END'
#!/usr/bin/env bash
[ -e "$(dirname "$0")/offline" ] && exit 1
case $1 in
  view) printf '["0.1.0","0.9.0","0.10.0","0.10.3","0.10.4-beta.1","0.11.0","1.0.0"]\n' ;;
  install) while [ "$1" != --prefix ]; do shift; done; mkdir -p "$2/node_modules"; echo "$3" >"$2/asked" ;;
esac
END
chmod +x "$work/npm"
PATH=$work:$PATH
say() { printf 'touchstone: %s\n' "$*" >&2; }
# shellcheck source=candidates/npm/releases.sh
. "$here/releases.sh"

failed() {
  printf 'FAILED: %s\n' "$*"
  exit 1
}
is() { [ "$2" = "$3" ] || failed "$1: \"$2\", not \"$3\""; }

named=$(named_npm_engines report --candidates reference,rapier@0.14,jolt-margin:0.01@0.30 \
  --candidates=physx --out out/jolt)
is "those named" "$(paste -s -d ' ' <<<"$named")" "jolt-margin:0.01@0.30 physx rapier@0.14"
is "none" "$(named_npm_engines report --candidates reference --out rapier.html)" ""

is "a history" "$(history_releases report --history jolt-world --seed 2)" \
  jolt-world@0.1,jolt-world@0.9,jolt-world@0.10,jolt-world@0.11,jolt-world@1.0
is "a choice" "$(history_releases report --history=jolt --candidates=jolt@1,jolt@2)" ""
is "of no engine from npm" "$(history_releases report --history bullet)" ""

to=$work/versions
install_release rapier-world@0.10 "$to" 2>/dev/null
is "the newest" "$(cat "$to/@dimforge/rapier3d-compat@0.10/asked")" @dimforge/rapier3d-compat@0.10.3
install_release jolt@0.1 "$to" 2>/dev/null  # not 0.10
is "whole numbers" "$(cat "$to/jolt-physics@0.1/asked")" jolt-physics@0.1.0
install_release jolt@0.10.4-beta.1 "$to" 2>/dev/null
is "a trial" "$(cat "$to/jolt-physics@0.10.4-beta.1/asked")" jolt-physics@0.10.4-beta.1

text=$(install_release jolt-margin:0.01@0.9.5 "$to" 2>&1) && failed "0.9.5 is no release"
is "an unknown one" "$text" 'error: the engine is "jolt-margin:0.01@0.9.5": must be a release of jolt-physics; the nearest are 0.1.0, 0.9.0, 0.10.0, 0.10.3'
text=$(install_release havok@7 "$to" 2>&1) && failed "7 is no release"
is "one above all" "${text##*; }" "the nearest are 0.11.0, 1.0.0"

touch "$work/offline"
install_release jolt@0.10.4-beta.1 "$to"
install_release jolt@0.1 "$to"
is "kept" "$(cat "$to/jolt-physics@0.1/asked")" jolt-physics@0.1.0
