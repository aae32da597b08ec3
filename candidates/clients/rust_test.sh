#!/usr/bin/env bash
# Builds the example in Rust and scores it: rust_test.sh RUSTC TOUCHSTONE
set -eu
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$1" --edition 2021 -O -D warnings --crate-type cdylib "$here/example.rs" -o my_engine.so
"$2" report --load ./my_engine.so --candidates example-rust --count 20 --out out \
  --pair cylinder-plane,cylinder-sphere --class general-shallow,lying,standing,cap,rim,side \
  >table 2>messages || { cat messages; exit 1; }
grep -Eq 'example-rust +100\.0' table && ! grep -Eq 'example-rust +[0-9]{1,2}\.' table || { cat table; exit 1; }
