#!/bin/bash
# WebAssembly: the npm package of bindings/js and the page to try tact.   usage: scripts/wasm.sh package | page | test
#   package   builds build/cross/wasm/tact/bindings/js/package
#   page      that, and build/cross/wasm/try.html from docs/try: one file, which scripts/docs.sh takes into the manual
#   test      both, then the package under node, installed into a fresh folder and bundled into a page, and the page to
#             try in Chromium, with the pictures a second that are seen there
# Exit status 77, with a line that says so, where emscripten, node, Chromium or the packages of viewer/ are missing. That its
# answers are those of x86-64 says scripts/cross.sh wasm.
set -euo pipefail
cd "$(dirname "$0")/.."
case ${1-} in
  package | page | test) ;;
  *)
    sed -n '2,9s/^# \?//p' "$0" >&2
    exit 2 ;;
esac

missing=()
for program in em++ node npm cmake ninja; do
  command -v "$program" > /dev/null || missing+=("$program")
done
[[ $1 != test ]] || command -v chromium > /dev/null || missing+=(chromium)
if (( ${#missing[@]} > 0 )); then
  echo "wasm.sh: ${missing[*]} missing: scripts/setup.sh wasm viewer installs what is needed"
  exit 77
fi
if [[ $1 != package && ! -d viewer/node_modules/esbuild ]]; then
  echo "wasm.sh: the packages of npm are missing: scripts/viewer.sh check fetches them"
  exit 77
fi

build=build/cross/wasm
if command -v ccache > /dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
[[ -f $build/build.ninja ]] || cmake -S tests/engine/other_build -B $build -G Ninja -DCMAKE_BUILD_TYPE=Release -DTACT_UNITY_BUILD=ON \
  --toolchain "$PWD/cmake/platforms/wasm.cmake" > /dev/null
cmake --build $build --target tact_js_package
[[ $1 != package ]] || exit 0
node docs/try/build.mjs $build/tact/bindings/js/package $build/try.html
[[ $1 == test ]] || exit 0
TACT_PACKAGE=$PWD/$build/tact/bindings/js/package TACT_TRY_PAGE=$PWD/$build/try.html \
  node --test --test-reporter=spec bindings/js/test/*.test.mjs docs/try/test/*.test.mjs
