#!/usr/bin/env bash
# Compiles the lines that `choose --engine` prints, and compares what they make with the shapes in the
# engine's own world: engine_lines_test.sh ENGINE_LINES_PROGRAM REFERENCE_FOLDER REFERENCE_LIBRARY ENGINE
set -eu
program=$1 reference=$2 library=$3 engine=$4
case $engine in
  bullet) flags=$(pkg-config --cflags --libs bullet-float64) ;;
  ode) flags=$(pkg-config --cflags --libs ode) ;;
  mujoco) flags=-lmujoco ;;
esac
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" "$engine" >"$folder/lines.cpp"
ln -s "$reference" "$folder/touchstone"  # as it is installed
eigen=$(pkg-config --cflags eigen3)
cd "$folder"
# shellcheck disable=SC2086 # several words
g++ -std=c++20 lines.cpp -o lines -I . $eigen "$library" $flags
./lines
