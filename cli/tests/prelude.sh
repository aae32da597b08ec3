# shellcheck shell=bash
# shellcheck disable=SC2034 # what the scripts read
# What the scripts of this folder share. Each runs the program as a person does, for one subject:
# SUBJECT_test.sh PROGRAM. It begins by reading this file and ends with `finish`.
set -u
unset COLUMNS
program=$(readlink -f "$1")
source_folder=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/../..")
folder=$(mktemp -d)
here=$(mktemp -d)  # in which no other script writes the folder `out`
trap 'rm -rf "$folder" "$here"' EXIT
cd "$here" || exit 1
failures=0

# One configuration, and one cheap pose class.
rim=cylinder-box/rim-face/1/2
lying="--pair cylinder-plane --class lying"

failed() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# expect CODE PATTERN ARGUMENTS…: exit code, and a pattern in what is printed.
expect() {
  local code=$1 pattern=$2 actual
  shift 2
  printed=$("$program" "$@" 2>&1 </dev/null)
  actual=$?
  ran="touchstone $*"
  [ "$actual" -eq "$code" ] || failed "$ran: exit code $actual, expected $code: $(head -n 5 <<<"$printed")"
  also "$pattern"
}

# also PATTERN…: these are in what the last of these commands printed.
also() {
  local pattern
  for pattern in "$@"; do
    grep -q -e "$pattern" <<<"$printed" ||
      failed "$ran: prints no \"$pattern\": $(head -n 5 <<<"$printed")"
  done
}

# page_data PAGE: prints what the page's script reads.
page_data() { python3 "$source_folder/cli/tests/page_data.py" "$1"; }

finish() { exit $((failures > 0)); }
