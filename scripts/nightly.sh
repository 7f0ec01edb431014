#!/bin/bash
# What is too long for every change: the long tests against their oracles, with new seeds each night; the scenes until
# they rest; the tests with the plainer instruction sets, with assertions on, against a shared library, without Embree
# and OpenMP and under the sanitizers; clang-tidy over the whole library; the fuzzing of the readers and of the
# interface for C, an hour each.
# usage: scripts/nightly.sh [SECONDS of fuzzing a format, 3600 if not given]
set -euo pipefail
cd "$(dirname "$0")/.."
export TACT_LONG_SEED=${TACT_LONG_SEED:-$(date +%Y%m%d)}
echo "TACT_LONG_SEED=$TACT_LONG_SEED plays this night's seeds again"
scripts/setup.sh program tests bench sanitizers blender mpi notebook paraview
scripts/build.sh release
TACT_LONG_CGAL_PAIRS=100000000 TACT_LONG_RATIONAL_PAIRS=1000000 build/release/tests/long/test_predicates_long
TACT_LONG_HULL_PAIRS=1000000 build/release/tests/long/test_directions_long
TACT_LONG_MOTION_QUERIES=10000000 TACT_LONG_REACH_QUERIES=1000000 TACT_LONG_WAYS=5000 build/release/tests/long/test_motion_long
TACT_LONG_QUERIES=1000000 build/release/tests/long/test_queries_long
cmake --build build/release --target test_body_queries_long
TACT_LONG_OVERLAPS=2000 TACT_LONG_TURNS=1000000 build/release/tests/long/test_body_queries_long
TACT_LONG_POINT_PAIRS=5000 TACT_LONG_EXACT_POINT_PAIRS=20000 build/release/tests/long/test_points_long
TACT_LONG_CROSSINGS=10000 TACT_LONG_THROWS=2000 build/release/tests/long/test_crossings_long
TACT_LONG_SELF_SEEDS=100 build/release/tests/long/test_self_long
for test in faults call_sequences; do
  TACT_LONG_SECONDS=900 build/release/tests/long/test_${test}_long
done
TACT_LONG_FAULTS_LEFT_OUT=0 TACT_LONG_SECONDS=300 build/release/tests/long/test_faults_long
TACT_LONG_STENCILS=100000 build/release/tests/long/test_solver_long
TACT_SOAK_STEPS=1000000 build/release/tests/long/test_soak_long
TACT_LONG_SCENES_FULL=1 build/release/tests/long/test_scenes_long
TACT_PRINTED_IN_FULL=1 build/release/tests/test_scenes --gtest_filter='PrintedCommands.*'
TACT_LONG_SAVED_SEEDS=300 TACT_LONG_STATES=50000 build/release/tests/test_engine --gtest_filter='*Saved*'
# One rank beside one world; then more, whose digests are to be the same. What fails on one rank, fails elsewhere on more.
on_ranks() {
  OMPI_MCA_mpi_yield_when_idle=1 mpirun --oversubscribe --allow-run-as-root -n "$1" build/release/tests/test_mpi \
    --full "${@:2}" | tee /dev/stderr | grep -v '^failures' | sed 's/ on [0-9]* ranks//'
}
alone=$(on_ranks 1)
for ranks in 2 3 4 8; do
  diff <(echo "$alone") <(on_ranks $ranks --many-only)
done
for set in scalar avx2; do
  for layer in broadphase narrowphase engine; do
    TACT_INSTRUCTION_SET=$set build/release/tests/test_$layer --gtest_brief=1
  done
done
build/release/bench/tact-bench stability
ctest --preset release -R 'python.(blender|example_files)$'
ctest --preset release -L night
tests/mpi/same_bytes.sh build/release/mpi/program/tact-mpi 300 500 1 2 4 8
build/release/bench/tact-bench mpi
scripts/lint.sh all
scripts/build.sh debug
ctest --preset debug -j 2
scripts/build.sh shared
ctest --preset shared -j 2
scripts/build.sh plain
ctest --preset plain -j 2
scripts/setup.sh wasm viewer
scripts/viewer.sh check
scripts/cross.sh wasm
scripts/wasm.sh test
scripts/sanitize.sh all
scripts/fuzz.sh "${1:-3600}"
scripts/cross.sh libcxx
scripts/cross.sh aarch64 tests
scripts/cross.sh windows tests
scripts/wheels.sh x86-64
scripts/wheels.sh aarch64
