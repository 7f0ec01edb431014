#!/bin/bash
# Installs what is missing, builds everything, runs all tests.   usage: scripts/test.sh [arguments of ctest]
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh program tests bench
scripts/build.sh release
ctest --preset release -j 2 "$@"
