#!/usr/bin/env bash
# The manual page and the completions say what --help says: descriptions_test.sh PROGRAM
set -u
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
failed() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

"$program" --manual >"$folder/touchstone.1"
"$program" --completion bash >"$folder/touchstone.bash"
"$program" --completion zsh >"$folder/_touchstone"
groff -man -Tutf8 -ww -z "$folder/touchstone.1" 2>"$folder/warnings" && [ ! -s "$folder/warnings" ] ||
  failed "groff: $(head -n 3 "$folder/warnings")"
# shellcheck disable=SC1091
. "$folder/touchstone.bash" || failed "bash reads no completion"

# completed WORD…: what bash offers for the last word.
completed() {
  COMP_WORDS=(touchstone "$@")
  COMP_CWORD=$#
  _touchstone
  printf '%s\n' "${COMPREPLY[@]}"
}
# The first column of a list of --help: words at the start of lines that are indented by two.
options_of() { sed -n 's/^  \(-[^ ]*\).*/\1/p' | tr , '\n'; }

commands=$("$program" --help | sed -n '/^Subcommands/,/^Examples/s/^  \([a-z]*\) .*/\1/p')
[ "$(wc -l <<<"$commands")" -ge 6 ] || failed "--help lists no subcommands"
[ "$(completed '')" = "$commands" ] || failed "subcommands: $(completed '')"
[ "$(completed rep)" = "$(grep '^rep' <<<"$commands")" ] || failed "rep: $(completed rep)"
for command in "" $commands; do
  # shellcheck disable=SC2086
  long=$("$program" $command --help | LC_ALL=C.UTF-8 awk 'length($0) > 80')
  [ -z "$long" ] || failed "$command --help is wider than 80 columns: $long"
done
for command in $commands; do
  grep -q "^\.SS \"touchstone $command\"" "$folder/touchstone.1" || failed "no manual of $command"
  offered=$(completed "$command" -)
  page=$(sed -n "/^\.SS \"touchstone $command\"/,/^\.S[SH]/p" "$folder/touchstone.1" | tr -d '\\')
  zsh=$(sed -n "/^    $command) _arguments/,/;;/p" "$folder/_touchstone")
  for option in $("$program" "$command" --help | options_of); do
    grep -qx -e "$option" <<<"$offered" || failed "bash: $command $option"
    grep -q -e "^fB.*$option" <<<"$page" || failed "manual: $command $option"
    grep -q -e "'$option\[" <<<"$zsh" || failed "zsh: $command $option"
  done
done
[ -z "$(completed report --out '')" ] || failed "a value is completed as something but a file"
[ -z "$(completed --candidate '')" ] || failed "a plug-in is completed as something but a file"
[ "$(completed check --cor)" = --corpus ] || failed "check --cor: $(completed check --cor)"
if command -v zsh >/dev/null && ! zsh -n "$folder/_touchstone"; then failed "zsh reads no completion"; fi
exit "$failures"
