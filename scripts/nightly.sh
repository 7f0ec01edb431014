#!/bin/bash
# What is too long for every change: millions of hard triangle pairs, the tests with assertions on and under the sanitizers,
# and the fuzzing of the mesh readers.   usage: scripts/nightly.sh [SECONDS of fuzzing a format, 600 if not given]
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh program tests sanitizers
scripts/build.sh test
TACT_LONG_CGAL_PAIRS=100000000 TACT_LONG_RATIONAL_PAIRS=1000000 build/release/tests/long/test_predicates_long
for preset in debug asan tsan; do
  scripts/build.sh "$preset"
  ctest --preset "$preset" -j 2
done
scripts/fuzz.sh "${1:-600}"
