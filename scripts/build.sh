#!/bin/bash
# Configures and builds a preset of CMakePresets.json, or some targets of it.   usage: scripts/build.sh PRESET [TARGET...]
# A second run has nothing to do and takes a second. ccache is used if it is there.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=$1
targets=("${@:2}")
if command -v ccache > /dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! cmake --preset "$preset" > "$log" 2>&1; then
  cat "$log" >&2
  exit 1
fi
echo "building preset $preset"
cmake --build --preset "$preset" ${targets:+--target "${targets[@]}"}
