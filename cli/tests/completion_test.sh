#!/usr/bin/env bash
# The manual page and the completions say what --help says.
. "$(dirname "$0")/prelude.sh"

"$program" --manual >"$folder/touchstone.1"
"$program" --completion bash >"$folder/touchstone.bash"
"$program" --completion zsh >"$folder/_touchstone"
grep -q '^\.TH touchstone 1' "$folder/touchstone.1" || failed "the manual page has no title"
{ groff -k -man -Tutf8 -ww -z "$folder/touchstone.1" 2>"$folder/warnings" && [ ! -s "$folder/warnings" ]; } ||
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
  help=$("$program" $command --help)
  wide=$(LC_ALL=C.UTF-8 grep '.\{81\}' <<<"$help")
  [ -z "$wide" ] || failed "$command --help is wider than 80 columns: $wide"
  [ -n "$command" ] || continue
  grep -q "^\.SS \"touchstone $command\"" "$folder/touchstone.1" || failed "no manual of $command"
  offered=$(completed "$command" -)
  page=$(sed -n "/^\.SS \"touchstone $command\"/,/^\.S[SH]/p" "$folder/touchstone.1" | tr -d '\\' | grep '^fB')
  zsh=$(sed -n "/^    $command) _arguments/,/;;/p" "$folder/_touchstone")
  for option in $(options_of <<<"$help"); do
    [[ $'\n'$offered$'\n' == *$'\n'"$option"$'\n'* ]] || failed "bash: $command $option"
    [[ $page == *"$option"* ]] || failed "manual: $command $option"
    [[ $zsh == *"'${option}["* ]] || failed "zsh: $command $option"
  done
done
[ "$(completed report --pair cylinder-b)" = cylinder-box ] || failed "pairs: $(completed report --pair cylinder-b)"
[ "$(completed report --pair cylinder-box,cylinder-p)" = cylinder-box,cylinder-plane ] || failed "a second pair"
[ "$(completed replay --candidates fcl-d)" = fcl-distance ] || failed "candidates: $(completed replay --candidates fcl-d)"
[ "$(completed report --class rim-r)" = rim-rim ] || failed "pose classes: $(completed report --class rim-r)"
[ "$(completed check --law sm)" = small-steps ] || failed "laws: $(completed check --law sm)"
grep -q -e "'--group\[.*:GROUP:_sequence compadd - .*everyday" "$folder/_touchstone" || failed "zsh: groups"
[ -z "$(completed report --out '')" ] || failed "a value is completed as something but a file"
[ -z "$(completed --load '')" ] || failed "a plug-in is completed as something but a file"
[ "$(completed check --cor)" = --corpus ] || failed "check --cor: $(completed check --cor)"
if command -v zsh >/dev/null && ! zsh -n "$folder/_touchstone"; then failed "zsh reads no completion"; fi

finish
