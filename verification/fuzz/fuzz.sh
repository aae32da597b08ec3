#!/usr/bin/env bash
# fuzz.sh [OPTION]…: our routines on inputs that libFuzzer makes, which keeps those that reach new
# code. Options are libFuzzer's: -max_total_time=3600, -jobs=2, -seed=7. It begins with the inputs in
# corpus/ and those of earlier runs in build/fuzz/corpus, and ends at the first disagreement, with the
# input in build/fuzz/crash-…; fuzz_case prints its configuration:
#   build/release/verification/fuzz/fuzz_case build/fuzz/crash-… | ./touchstone replay -
# Needs clang and libclang-rt-14-dev (packages-test.txt).
set -euo pipefail
cd "$(dirname "$0")/../.."
cmake --preset fuzz >/dev/null
ninja -C build/fuzz distance_fuzz >&2
mkdir -p build/fuzz/corpus
exec build/fuzz/verification/fuzz/distance_fuzz -artifact_prefix=build/fuzz/ -max_len=192 \
  -print_final_stats=1 "$@" build/fuzz/corpus verification/fuzz/corpus
