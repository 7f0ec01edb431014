#!/bin/bash
# Is all code formatted as .clang-format says, does Clang compile the library without a warning, and does
# clang-tidy find nothing in the library that .clang-tidy names?
# usage: scripts/lint.sh quick|all
# quick: clang-tidy reads the folders in which a mistake is hardest to see, about a minute on 2 cores. all: every source of
# the library but the kernels, which are plain loops over instructions that clang-tidy knows nothing about.
set -euo pipefail
cd "$(dirname "$0")/.."
case ${1:-} in
  quick) folders=(engine/pair narrowphase/hull) ;;
  all) folders=(engine broadphase narrowphase) ;;
  *) echo "usage: scripts/lint.sh quick|all" >&2; exit 2 ;;
esac
scripts/setup.sh program lint

echo "clang-format"
find engine broadphase narrowphase mpi scenes bench tests bindings examples \( -name '*.h' -o -name '*.cpp' -o -name '*.inl' \) \
  -not -path '*/build/*' -print0 | xargs -0 clang-format --dry-run -Werror

embree=3
[[ -d /usr/include/embree4 ]] && embree=4
flags=(-std=c++20 -fopenmp -I. -Iengine/include -Iengine/base/include -Ibindings/c/include -isystem /usr/include/eigen3
       -DTACT_EMBREE_MAJOR=$embree)

echo "clang"
# Twelve of a folder at a time, as in CMakePresets.json: it halves the reading of headers. Of the two ways to build trees,
# which have the same names, one is read.
read_together() { printf '#include "%s"\n' "$@" | clang++ -x c++ -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Werror $flags -; }
export -f read_together
{
  find engine broadphase narrowphase -type d -not -name kernels | sort | while read -r folder; do
    find "$folder" -maxdepth 1 -name '*.cpp' -not -name '*_median.cpp' | sort | xargs -r -n 12
  done
  find bindings/c -name '*.cpp' -not -path '*/build/*'
} | flags="${flags[*]}" xargs -I {} -P "$(nproc)" bash -c 'read_together {}'

echo "clang-tidy: ${folders[*]}"
find "${folders[@]}" -name '*.cpp' -not -path '*/kernels/*' -print0 | sort -z |
  xargs -0 -n 4 -P "$(nproc)" sh -c 'flags=$1; shift; exec clang-tidy --quiet "$@" -- $flags' sh "${flags[*]}"
