#!/bin/bash
# Installs what is missing, builds the program, plays two scenes.   usage: scripts/demo.sh
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh program
scripts/build.sh demo
for scene in cloth-over-sphere pile; do
  echo
  build/release/scenes/tact run "$scene" --frames 120 --out "out/$scene"
done
echo
echo "pictures: out/cloth-over-sphere and out/pile"
