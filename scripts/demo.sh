#!/bin/bash
# Installs what is missing, builds the program, plays two scenes, says where their pictures and films are.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh program
scripts/build.sh demo
play() {
  echo
  rm -f "out/$1"/film.*
  build/release/scenes/tact run "$@" --frames 120 --out "out/$1"
}
play cloth-over-sphere
play pile --size 30
echo
for scene in cloth-over-sphere pile; do
  echo "picture: out/$scene/sheet.png"
  for film in "out/$scene"/film.*; do
    if [[ -e $film ]]; then echo "film:    $film"; fi
  done
done
