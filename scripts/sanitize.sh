#!/bin/bash
# Runs tests under the address and undefined-behaviour sanitizers, then under the thread sanitizer.
# usage: scripts/sanitize.sh quick|all
# quick: the ground floor, and wrong use of the interface for C, which must never crash; no threads. all: everything, about
# an hour on 2 cores. The presets optimize little and note lines alone: with -O2 -g the largest units took GCC a quarter
# of an hour each.
set -euo pipefail
cd "$(dirname "$0")/.."
case ${1:-} in
  quick) asan=(base c) ;;
  all) asan=() ;;
  *) echo "usage: scripts/sanitize.sh quick|all" >&2; exit 2 ;;
esac
scripts/setup.sh program tests sanitizers
# Oracles allocate rational numbers from ever other stacks, and the sanitizer keeps each: with the 30 levels that it takes
# by itself, three quarters of their time.
export ASAN_OPTIONS=malloc_context_size=6

# Builds the test programs of some folders, or all, and runs them.
run() {
  local preset=$1 folders=("${@:2}")
  if (( ${#folders[@]} == 0 )); then
    scripts/build.sh "$preset"
    ctest --preset "$preset" -j 2
  else
    scripts/build.sh "$preset" "${folders[@]/#/test_}"
    ctest --preset "$preset" -j 2 -L "^($(IFS='|'; echo "${folders[*]}"))$"
  fi
}
run asan "${asan[@]}"
[[ $1 == quick ]] || run tsan
