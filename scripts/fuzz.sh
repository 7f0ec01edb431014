#!/usr/bin/env bash
# Fuzzes the readers of meshes and recordings and the interface for C, under the address and undefined-behaviour
# sanitizers, so many seconds for each format; by default all of them.   usage: scripts/fuzz.sh SECONDS [FORMAT]...
# What it learns stays in build/fuzz/corpus; the corpus of the tree is only read. It ends at the first finding and leaves
# the input that shows it in build/fuzz.
set -euo pipefail
seconds=${1:?usage: scripts/fuzz.sh SECONDS [FORMAT]...}
shift
formats=("$@")
(( ${#formats[@]} > 0 )) || formats=(obj off ply stl vtp vtk recording state c)
root=$(cd "$(dirname "$0")/.." && pwd)
build=$root/build/fuzz
"$root/scripts/setup.sh" sanitizers program tests

mkdir -p "$root/build"
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++ \
  -DTACT_SANITIZE=fuzzer-no-link,address,undefined -DTACT_BUILD_FUZZERS=ON -DTACT_BUILD_PROGRAM=ON -DTACT_BUILD_TESTS=ON \
  >"$build.log" 2>&1 || { cat "$build.log"; exit 1; }
ninja -C "$build" "${formats[@]/#/fuzz_}"

for format in "${formats[@]}"; do
  mkdir -p "$build/corpus/$format"
  "$build/tests/fuzz/fuzz_$format" -max_total_time="$seconds" -max_len=4096 -timeout=10 -rss_limit_mb=1024 \
    -malloc_limit_mb=256 -print_final_stats=1 -dict="$root/tests/fuzz/dictionary.txt" \
    -artifact_prefix="$build/$format-" "$build/corpus/$format" "$root/tests/fuzz/corpus/$format" \
    >"$build/$format.log" 2>&1 || { tail -40 "$build/$format.log"; echo "a finding in $format: $build/$format.log"; exit 1; }
  echo "$format: no finding in $seconds s, $(awk '/number_of_executed_units/ {print $2}' "$build/$format.log") inputs"
done
