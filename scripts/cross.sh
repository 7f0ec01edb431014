#!/bin/bash
# Builds the library for another platform and says whether its answers have the bits that they have on x86-64 Linux.
set -euo pipefail
cd "$(dirname "$0")/.."

help() {
  cat <<'TEXT'
usage: scripts/cross.sh PLATFORM [hashes|tests]
Installs what it needs, builds tact for another platform and runs it there. The platforms:
  aarch64   ARM with 64 bits: GCC for Linux, with Embree and OpenMP, under qemu-user
  windows   Windows with 64 bits: MinGW-w64, as a static library and as a DLL, without Embree and OpenMP, under Wine
  wasm      WebAssembly with registers of 128 bits and one thread: Debian's emscripten, under node; scripts/wasm.sh
            builds the npm package and tests it
  libcxx    this machine, but Clang with libc++ and without Embree and OpenMP, as Apple's tools are
and what runs:
  hashes    the library and hash_program: every scene's hashes, and a last line with one number for all (the default)
  tests     that, then the tests of base, broadphase, narrowphase, engine and C (not for libcxx), as far as their
            libraries are to be had there; what is left out is named with its reason
Builds go to build/cross/PLATFORM. Exit status 1 if a hash differs or a test fails.
TEXT
}

case ${1:-} in
  aarch64 | windows | wasm | libcxx) platform=$1 ;;
  -h | --help) help; exit 0 ;;
  *) help >&2; exit 2 ;;
esac
case ${2:-hashes} in
  hashes | tests) wanted=${2:-hashes} ;;
  *) help >&2; exit 2 ;;
esac
scripts/setup.sh "$platform"
if command -v ccache > /dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
export WINEPREFIX=${WINEPREFIX:-$PWD/build/cross/wine} WINEDEBUG=${WINEDEBUG:--all}
toolchain=$PWD/cmake/platforms/$platform.cmake

# build FOLDER SOURCE TARGETS [OPTION...]: configures and builds below build/cross.
build() {
  local log folder=build/cross/$1
  mkdir -p build/cross
  log=$(mktemp)
  if ! cmake -S "$2" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DTACT_UNITY_BUILD=ON \
      --toolchain "$toolchain" "${@:4}" > "$log" 2>&1; then
    cat "$log" >&2
    exit 1
  fi
  grep -E 'tact[^:]*: ' "$log" || true
  rm -f "$log"
  # shellcheck disable=SC2086  # targets are several words
  cmake --build "$folder" --target $3
}

# Runs a program of the platform.
run() {
  case $platform in
    aarch64) qemu-aarch64 "$@" ;;  # with the system's libraries: with -L, those of the compiler, qemu 7.2 starts no threads
    windows) WINEPATH="Z:$PWD/$(dirname "$1")/tact/engine" /usr/lib/wine/wine64 "$1.exe" "${@:2}" ;;  # where the DLL is
    wasm) node --no-experimental-fetch "$1.js" "${@:2}" ;;  # this emscripten would fetch a file as from a server
    libcxx) "$@" ;;
  esac
}

# hashes NAME [OPTION...]: by the build of that name, of the library alone or, for tests, of everything that they need.
hashes() {
  local program=build/cross/$1/hash_program
  if [[ $1 == *-tests ]]; then
    build "$1" . hash_program -DTACT_BUILD_TESTS=ON "${@:2}"
    program=build/cross/$1/tests/hash_program
  else
    build "$1" tests/engine/other_build hash_program "${@:2}"
  fi
  echo "$1: hash_program"
  run "$program" 1
  echo "$1: with two threads"
  run "$program" 2 | tail -n 1
  if [[ $platform == aarch64 ]]; then
    echo "$1: the same without NEON"
    TACT_INSTRUCTION_SET=scalar run "$program" 1 | tail -n 1
  fi
}

name=$platform
if [[ $wanted == tests && $platform =~ ^(aarch64|windows)$ ]]; then
  name=$platform-tests
fi
hashes "$name"
if [[ $platform == windows ]]; then
  hashes windows-dll -DBUILD_SHARED_LIBS=ON
fi
[[ $wanted == tests ]] || exit 0

if [[ $platform == wasm ]]; then
  exec scripts/wasm.sh test
fi
if [[ $platform == libcxx ]]; then
  echo "libcxx: no tests; Debian has GoogleTest, CGAL and RapidCheck for the other standard library alone" >&2
  exit 2
fi
folders=(base broadphase narrowphase engine c)
filter='*'
if [[ $platform == aarch64 ]]; then
  echo "aarch64: without the death tests, which start their program again: qemu-user cannot do that"
  filter='-*DeathTest.*'
fi
build "$name" . "${folders[*]/#/test_}"
# suite FOLDER: its test program, a part on each core at a time.
suite() {
  local program=build/cross/$name/tests/test_$1 parts=() status=0 part
  for (( part = 0; part < $(nproc); ++part )); do
    GTEST_TOTAL_SHARDS=$(nproc) GTEST_SHARD_INDEX=$part run "$program" --gtest_brief=1 --gtest_filter="$filter" > "$program.$part.log" 2>&1 &
    parts+=($!)
  done
  for part in "${!parts[@]}"; do
    wait "${parts[part]}" || status=1
    cat "$program.$part.log"
  done
  return $status
}
failed=()
for folder in "${folders[@]}"; do
  echo "$platform: the tests of $folder"
  suite "$folder" || failed+=("$folder")
done
if (( ${#failed[@]} > 0 )); then
  echo "$platform: tests fail in ${failed[*]}" >&2
  exit 1
fi
