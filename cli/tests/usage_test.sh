#!/usr/bin/env bash
# What the program says of itself, and of options and names that it does not know.
. "$(dirname "$0")/prelude.sh"

expect 0 '^touchstone [0-9]' --version
also '^engines: .*bullet 3' '^libraries: CGAL 5.*, GMP .*, MPFR .*, FLINT .*, Arb .*, Eigen 3'
expect 0 'touchstone report' --help
expect 0 'Examples' report --help
expect 0 'touchstone report --candidates reference' list --help
expect 0 'touchstone stability' stability --help
expect 0 'bullet 3' list candidates
expect 2 '--completion.*bash or zsh' --completion fish
expect 2 '^error: subcommand is missing: must be one of report, replay, '
expect 2 'report, replay, solve, check, compare, ' nonsense
# Usage errors name what was given and the remedy, as all others do.
expect 2 '^error: option is "--cout": must be an option of touchstone report, as --count, .*--help' report --cout 3
expect 2 '^error: option is "--candidats=x": must be .* as --candidates, ' replay --candidats=x
expect 2 '^error: option is "--nosuch"' --nosuch
expect 2 '^error: option is "--laod": .* as --load, ' list --laod x.so
expect 2 '^error: argument is "more": must be left out: touchstone replay takes IDENTITY and ' replay $rim more
expect 2 '^error: argument is "more": must be left out: touchstone list takes LIST, PAIR and options' \
  list classes cylinder-box more
expect 2 '^error: pair is "cylinder-box": must be left out' list candidates cylinder-box
expect 2 '^error: what is "engines": must be candidates or classes' list engines
expect 2 '^error: argument is "bullet": must follow an option, as --candidate bullet' check bullet
expect 2 '^error: argument is "bullet": must follow an option, as --candidates bullet' report bullet
expect 2 '^error: subcommand is "help": must be one of report, .*; touchstone --help says what they do' help
expect 2 '^error: --seed is given no value: must be followed by UINT: Same seed' report --seed
expect 2 '^error: --candidates is given no value: must be followed by CANDIDATE' solve --candidates
expect 2 '^error: --load is given no value: must be followed by FILE' --load
expect 2 '^error: --seed is given 2 times: must be given once' report --seed 1 --seed 2
expect 2 '^error: --hostile is given a value: must stand alone' check --hostile=bullet
expect 2 '^error: --hostile is given a value: must stand alone' check --hostile=7
expect 2 '^error: --json is given a value: must stand alone' replay $rim --json=false
expect 2 '^error: argument is "check.json": must be left out; --json prints on standard output.*> check.json' \
  check --candidate bullet --json check.json
expect 2 '^error: input is missing: must be given: pair/class/seed/index' replay
expect 2 '^error: --candidate is missing: must be given: a name, as bullet' check
expect 2 '^error: --candidate is missing: must be given: a name' check --search
expect 2 '^error: --law is given with --search: must stand without it' check --search --candidate bullet --law answers
expect 2 '^error: --goal is given: must stand beside --search' check --candidate bullet --goal time
# What was a command once says what it is now.
while read -r old now; do
  expect 2 "^error: subcommand is \"$old\": $old is now \`touchstone $now\`\$" "$old" --help
done <<'END'
candidates list candidates
certify replay --certify
classes list classes
merge campaign --merge
render simulate --povray
search check --search
END
plugin=$(dirname "$program")/candidates/testing/touchstone-sabotage.so
expect 2 'touchstone list candidates.$' --load "$plugin" candidates
# A shell's variable that is not set: not a run without the option.
for option in --junit --save --corpus --known; do
  expect 2 "^error: $option is \"\": must be left out or have a value\$" check --candidate reference "$option" ''
done
expect 2 '^error: --shard is "": must be left out or' campaign --count 1 --shard '' --out "$folder/none"
expect 2 '^error: pair is "": must be left out or' list classes ''

# Candidates: a name, a list of names, a plug-in's file, a list of commands.
expect 2 'must be one of reference, bullet, ' replay $rim --candidates no-such-engine
expect 2 'prism:1.* must be' replay $rim --candidates prism:1
expect 0 'prism:32: ' replay $rim --candidates prism:8,16,32
expect 2 'must be a plug-in' --load /etc/passwd list candidates
echo '{}' >"$folder/p.json"
expect 2 'p.json": must be a plug-in, which is a shared object (.so), or a list of commands, .*\.txt' \
  --load "$folder/p.json" list candidates
expect 2 '^error: --candidate is ".*p.json": must be a plug-in' check --candidate "$folder/p.json"
printf '\xef\xbb\xbf# nothing but a byte order mark\n' >"$folder/empty.txt"
expect 2 '^error: --load is ".*empty.txt": must list a command' --load "$folder/empty.txt" list candidates
expect 2 '^error: --candidate is ".*empty.txt": must list a command' check --candidate "$folder/empty.txt"
expect 2 '^error: --candidate is "bullet,ode": must be one name, not a list' check --candidate bullet,ode
expect 2 '^error: --candidate is "bulet": must be one of reference, ' check --search --candidate bulet
expect 2 '^error: --goal is "depth": must be one of distance, normal, points, hull, time$' \
  check --search --candidate bullet --goal distance,depth
expect 2 '^error: --candidate is libccd-gjk: must have a routine for a pair' \
  check --search --candidate libccd-gjk --pair cylinder-plane --count 1
for name in ./nope.so nope.so; do
  expect 2 "^error: --candidate is \"$name\": must be a file that is there, or a name that" check --candidate $name
  expect 2 "^error: --candidates is \"$name\": must be a name; a plug-in's file is given by --load" solve --candidates $name
done

# A class and a group that have nothing in common leave nothing to do: no empty result, no "interrupted".
for command in "check --candidate bullet" "check --search --candidate bullet" stability export report campaign; do
  # shellcheck disable=SC2086
  expect 2 '^error: --group is "everyday": must be of these pose classes, which are degenerate' \
    $command --group everyday --class lying
done
expect 2 '^error: --hostile is given with --group: must stand without it\|^error: --group is given with --hostile' \
  check --candidate bullet --hostile --group everyday

# Every number of every option is read alike, and refused by its name, with the range.
refused() {
  # shellcheck disable=SC2086
  expect 2 "${1##* } is \".*\": must be a .*number from .* to " $1 "$2" --out "$folder/none"
}
for option in "campaign --count" "report --count" "report --seed" "report --workers" \
  "solve --width" "solve --time-limit" "solve --memory-limit" "solve --tolerance" \
  "solve --threshold" "campaign --checkpoint" "replay --certify $rim --cells" "replay --certify $rim --width" \
  "compare a b --max-error-factor" "compare a b --max-time-factor" "compare a b --min-agree" \
  "simulate --povray a b --every" "simulate --step" "simulate --count" "simulate --seed" "choose a --depth" \
  "choose a --angle" "choose a --count" "choose a --seed" "check --search --candidate bullet --count" \
  "stability --count" "export --count" "export --threshold"; do
  refused "$option" -1
done
# The three ways to hold a number: a count, a number, a list of numbers.
for option in "campaign --count" "solve --width" "simulate --step"; do
  for number in nan "" 0x1.8p-1z; do refused "$option" "$number"; done
done
for option in "campaign --count" "report --count" "report --workers" "stability --count" \
  "check --search --candidate bullet --count" "check --count" "replay --certify $rim --cells"; do
  # shellcheck disable=SC2086
  expect 2 "${option##* } is \"1e15\": must be a whole number from" $option 1e15
done
expect 2 'must be at most .*campaign scores any number' report --count 1e7 --out "$folder/none"

finish
