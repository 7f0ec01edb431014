#!/bin/bash
# A plain `cmake -B build` needs the packages of the library alone, and builds it alone, with warnings that are no errors.
# usage: check_fresh_checkout.sh CMAKE SOURCE BUILD GENERATOR COMPILER
set -euo pipefail
cmake=$1 source=$2 build=$3 generator=$4 compiler=$5
options=()
for package in CGAL CLI11 Freetype GTest MPI PkgConfig PNG Python3 ZLIB fcl fmt nlohmann_json pybind11 rapidcheck; do
  options+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
"$cmake" --fresh --no-warn-unused-cli -S "$source" -B "$build" -G "$generator" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "${options[@]}"
commands=$build/compile_commands.json
others=$(sed -n "s|^ *\"file\": \"$source/\(.*\)\".*|\1|p" "$commands" | grep -vE '^(engine|broadphase|narrowphase|bindings/c)/' || true)
if [[ -n $others ]]; then
  printf 'not of the library, but built:\n%s\n' "$others"
  exit 1
fi
if ! grep -q engine/step.cpp "$commands" || grep -q -- -Werror "$commands"; then
  echo "the library is not built, or its warnings are errors: $commands"
  exit 1
fi
