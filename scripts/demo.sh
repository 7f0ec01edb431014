#!/bin/bash
# Installs what is missing, builds the program, plays two scenes, says where their pictures, films and pages are.
# usage: scripts/demo.sh
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh program
scripts/build.sh demo

play() {
  echo
  mkdir -p "out/$1"
  rm -f "out/$1"/film.*
  build/release/scenes/tact run "$@" --out "out/$1" --view "out/$1/page.html"
}
show() {
  local film
  film=$(compgen -G "out/$1/film.*" || echo "none: neither ffmpeg nor img2webp is installed (packages ffmpeg and webp)")
  printf '%-18s picture: %s\n%-18s film:    %s\n%-18s page:    %s\n' "$1" "out/$1/sheet.png" "" "$film" "" "out/$1/page.html"
}
play cloth-over-sphere --frames 180 --every 6
play pile --size 30 --frames 240 --every 8
echo
show cloth-over-sphere
show pile
echo
echo "Open a page in a browser: it plays the run, and shows what touches and why."
