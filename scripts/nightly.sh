#!/bin/bash
# What is too long for every change: a hundred million hard triangle pairs, a million of hulls, ten million of moving
# features, a million questions, five thousand pairs of bodies with contact points, a hundred sets of folded sheets, a
# soak of a million steps, the scenes until they rest, a thousand cases of every kind of hardship, hundreds of worlds saved and restored, clang-tidy over the
# whole library, the tests with assertions on, against a shared library and under the sanitizers, and the fuzzing of the
# readers.
# usage: scripts/nightly.sh [SECONDS of fuzzing a format, 600 if not given]
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh program tests bench sanitizers
scripts/build.sh release
TACT_LONG_CGAL_PAIRS=100000000 TACT_LONG_RATIONAL_PAIRS=1000000 build/release/tests/long/test_predicates_long
TACT_LONG_HULL_PAIRS=1000000 build/release/tests/long/test_directions_long
TACT_LONG_MOTION_QUERIES=10000000 build/release/tests/long/test_motion_long
TACT_LONG_QUERIES=1000000 build/release/tests/long/test_queries_long
TACT_LONG_POINT_PAIRS=5000 build/release/tests/long/test_points_long
TACT_LONG_SELF_SEEDS=100 build/release/tests/long/test_self_long
TACT_SOAK_STEPS=1000000 build/release/tests/long/test_soak_long
TACT_LONG_SCENES_FULL=1 build/release/tests/long/test_scenes_long
TACT_LONG_SAVED_SEEDS=300 TACT_LONG_STATES=50000 build/release/tests/test_engine --gtest_filter='*Saved*'
for set in scalar avx2; do
  TACT_INSTRUCTION_SET=$set build/release/tests/test_engine --gtest_brief=1
done
build/release/bench/tact-bench stability
scripts/lint.sh all
scripts/build.sh debug
ctest --preset debug -j 2
scripts/build.sh shared
ctest --preset shared -j 2
scripts/sanitize.sh all
scripts/fuzz.sh "${1:-600}"
