#!/bin/bash
# Installs what is missing, builds the program and the tests, runs all tests but those labelled `night`.   usage: scripts/test.sh [arguments of ctest]
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh program tests bullet mpi
scripts/build.sh test
ctest --preset test -j 2 -LE night "$@"
