#!/bin/bash
# Installs what is missing, builds the program, plays two scenes.   usage: scripts/demo.sh
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh program
scripts/build.sh demo
play() {
  echo
  build/release/scenes/tact run "$@" --frames 120 --out "out/$1"
}
play cloth-over-sphere
play pile --size 30
echo
echo "pictures: out/cloth-over-sphere and out/pile"
