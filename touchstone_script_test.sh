#!/usr/bin/env bash
# Runs ./touchstone on a machine that is made up: the package tools, CMake, Ninja and CTest are
# stand-ins which write down how they are called, and no other program of this machine is in PATH.
# shellcheck disable=SC2016 # stand-ins are written with their dollars
set -u
source_folder=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
calls=$folder/calls
tools=$folder/tools
machine_tools="awk bash cat chmod comm dirname env flock grep head ln mkdir mv nproc readlink rm
  rmdir sed sleep sort tail tee touch tr"

# stand_in NAME: its body comes on standard input.
stand_in() {
  { echo '#!/usr/bin/env bash'; cat; } >"$tools/$1"
  chmod +x "$tools/$1"
}

# A machine with every package, run by root, and a clone that was never built.
new_machine() {
  rm -rf "$folder/a b" "$folder/moved" "$tools" "$calls"
  mkdir -p "$folder/a b" "$tools"
  : >"$calls"
  cp "$source_folder/touchstone" "$source_folder"/packages*.txt "$folder/a b/"
  mkdir -p "$folder/a b/candidates/npm"
  cp "$source_folder/candidates/npm/releases.sh" "$folder/a b/candidates/npm/"
  local tool
  for tool in $machine_tools; do ln -s "$(command -v "$tool")" "$tools/$tool"; done
  export CALLS=$calls MISSING=none USER_ID=0 APT_CODE=0 BUILD_CODE=0 SECONDS_OF_WORK=0
  stand_in id <<<'echo "$USER_ID"'
  stand_in dpkg-query <<'BODY'
shift 3 # -W -f FORMAT
for package in "$@"; do [[ " $MISSING " == *" $package "* ]] || echo "$package installed"; done
BODY
  stand_in apt-get <<'BODY'
echo "apt-get $*" >>"$CALLS"
mkdir "$CALLS.apt" || echo "two apt-get at once" >>"$CALLS"
sleep "$SECONDS_OF_WORK"
rmdir "$CALLS.apt"
exit "$APT_CODE"
BODY
  stand_in cmake <<'BODY'
echo "cmake $*" >>"$CALLS"
touch build/release/build.ninja
echo "CMAKE_HOME_DIRECTORY:INTERNAL=$PWD" >build/release/CMakeCache.txt
BODY
  stand_in ninja <<'BODY'
build=$2 # -C BUILD
if [ "$3" = -n ]; then
  [ -x "$build/touchstone" ] && echo "ninja: no work to do."
  exit 0
fi
echo "ninja ${*: -1}" >>"$CALLS"
mkdir "$CALLS.ninja" || echo "two ninja at once" >>"$CALLS"
sleep "$SECONDS_OF_WORK"
rmdir "$CALLS.ninja"
if [ "$BUILD_CODE" -ne 0 ]; then echo "a.cpp:1: error: nonsense"; exit "$BUILD_CODE"; fi
echo "[1/1] Linking"
program='echo "program in $PWD:$(printf " <%s>" "$@")"; exit 7'
printf '#!/usr/bin/env bash\n%s\n' "$program" >"$build/touchstone"
chmod +x "$build/touchstone"
BODY
  stand_in ctest <<<'echo "ctest $*" >>"$CALLS"; echo "100% tests passed"'
}

# call CODE ARGUMENTS…: runs the script; what it printed is in $folder/out and $folder/err.
call() {
  local code=$1 actual
  shift
  (cd "$folder" && PATH=$tools "${script:-$folder/a b/touchstone}" "$@" >out 2>err </dev/null)
  actual=$?
  [ "$actual" -eq "$code" ] || fail "exit code $actual, expected $code"
}

fail() {
  echo "FAILED: $fact: $*"
  cat "$folder/out" "$folder/err" "$calls" 2>/dev/null | head -n 12
  failures=$((failures + 1))
}

has() { grep -qF -e "$2" "$1" || fail "no \"$2\" in $(basename "$1")"; }
has_not() { ! grep -qF -e "$2" "$1" || fail "\"$2\" in $(basename "$1")"; }
times() { [ "$(grep -cF -e "$2" "$calls")" -eq "$1" ] || fail "not $1 times \"$2\""; }

fact="a first call configures and builds, and passes on arguments, folder and exit code"
new_machine
call 7 solve "my file.jsonl" ""
has "$folder/out" "program in $folder: <solve> <my file.jsonl> <>"
[ "$(wc -l <"$folder/out")" -eq 1 ] || fail "more than the program's line on standard output"
times 1 "cmake"
times 1 "ninja touchstone"
times 0 "apt-get"

fact="a second call starts the program and nothing else"
: >"$calls"
call 7 report
[ ! -s "$calls" ] || fail "something was called"
[ ! -s "$folder/err" ] || fail "something was said"

fact="without arguments the program helps"
call 7
has "$folder/out" "<--help>"

fact="a chain of links to the script works from another folder"
ln -sf "$folder/a b/touchstone" "$folder/link"
ln -sf link "$folder/link to link"
script="$folder/link to link" call 7 x
has "$folder/out" "<x>"

fact="a clone that moved is configured anew"
mv "$folder/a b" "$folder/moved"
script="$folder/moved/touchstone" call 7 x
times 1 "cmake --fresh"

fact="what reads robots is built once a robot's file is named"
new_machine
call 7 choose conveyor
times 0 "ninja plugin_robots"
endings=$(grep -o '"\.[a-z]*"' "$source_folder/simulation/scenes/robot_file.cpp" | tr -d '"')
[ "$(wc -w <<<"$endings")" -ge 6 ] || fail "robot_file.cpp names fewer endings than six: $endings"
for ending in $endings; do
  new_machine
  call 7 choose --package-path . "my arm$ending"
  times 1 "ninja plugin_robots"
done

fact="missing packages, and only they, are installed by root and named"
new_machine
MISSING="libode-dev ninja-build" call 7 x
has "$folder/err" "installing libode-dev ninja-build"
times 1 "apt-get update"
times 1 "apt-get install -q -y --no-install-recommends libode-dev ninja-build"
has_not "$calls" "sudo"

fact="what only tests need is installed for tests"
new_machine
MISSING="libode-dev chromium-driver" call 7 x
times 1 "apt-get install -q -y --no-install-recommends libode-dev"
has_not "$calls" "chromium"
MISSING="chromium-driver" call 0 test
times 1 "apt-get install -q -y --no-install-recommends chromium-driver"
has "$calls" "ctest"

fact="tests run without what only some of them need"
new_machine
MISSING="chromium" APT_CODE=100 call 0 test
has "$folder/err" "tests that need them will fail"
has "$calls" "ctest"

fact="a failed installation ends the call"
new_machine
MISSING="libode-dev" APT_CODE=100 call 2 x
times 0 "cmake"

fact="a user without sudo is given the one command"
new_machine
MISSING="libode-dev" USER_ID=1000 call 2 x
has "$folder/err" "apt-get update && apt-get install --no-install-recommends -y libode-dev"
[ ! -s "$calls" ] || fail "something was called"

fact="a user with sudo installs through it"
new_machine
stand_in sudo <<<'echo "sudo $*" >>"$CALLS"; exec "$@"'
MISSING="libode-dev" USER_ID=1000 call 7 x
times 1 "sudo env DEBIAN_FRONTEND=noninteractive apt-get install"

fact="a system without apt goes on"
new_machine
rm "$tools/apt-get" "$tools/dpkg-query"
call 7 x
has "$folder/err" "packages.txt"

fact="a failed build shows the compiler's error"
new_machine
BUILD_CODE=1 call 2 x
has "$folder/err" "a.cpp:1: error: nonsense"
has "$folder/err" "build.log"

fact="two calls at once install and build one after the other"
new_machine
SECONDS_OF_WORK=0.2 # in which calls that did not wait would meet
(cd "$folder" && MISSING="libode-dev" PATH=$tools "$folder/a b/touchstone" one >/dev/null 2>&1) &
MISSING="libode-dev" call 7 two
wait $!
has_not "$calls" "at once"
times 1 "cmake"
times 1 "ninja touchstone"

fact="in a clone that cannot be written to, nothing is built and no tool's words are shown"
new_machine
mkdir -p "$folder/a b/build/release/.lock" # what even root cannot write to
call 2 report
has "$folder/err" "touchstone: nothing can be built here: "
has "$folder/err" "cannot be written to; clone into a folder of your own"
[ "$(wc -l <"$folder/err")" -eq 1 ] || fail "more than one line"
[ ! -s "$calls" ] || fail "something was called"

fact="there the program that is built already runs, and tests do not"
printf '#!/usr/bin/env bash\necho "program <$1>"; exit 7\n' >"$folder/a b/build/release/touchstone"
chmod +x "$folder/a b/build/release/touchstone"
call 7 report
has "$folder/out" "program <report>"
call 7
has "$folder/out" "program <--help>"
call 2 test
has "$folder/err" "cannot be written to"

fact="test builds everything and hands its arguments to CTest"
new_machine
call 0 test -R "near parallel"
times 1 "ninja all"
has "$calls" "-R near parallel"
has "$calls" "-LE ^long$ -R"
[ "$(tail -n 1 "$folder/out")" = "100% tests passed" ] || fail "CTest's line is not the last"

fact="test --all leaves no test out"
new_machine
call 0 test --all -R "near parallel"
grep -q "^ctest .*-R near parallel" "$calls" || fail "not CTest's arguments: $(cat "$calls")"
! grep -qe "-LE\|--all" "$calls" || fail "tests are left out: $(cat "$calls")"

fact="python builds the module and hands its arguments to a Python that finds it"
new_machine
PYTHONPATH=/mine call 3 python -c 'import os, sys; print(os.environ["PYTHONPATH"], sys.argv[1]); sys.exit(3)' "a b"
times 1 "ninja python_module"
has "$folder/out" "$folder/a b/build/release/python:/mine a b"

exit "$failures"
