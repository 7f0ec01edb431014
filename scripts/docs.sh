#!/bin/bash
# Builds the manual into build/docs/site and checks every link in it.   usage: scripts/docs.sh
# Open build/docs/site/index.html. Installs what is missing (group docs of scripts/setup.sh).
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh docs
pages=build/docs/pages
rm -rf build/docs
mkdir -p build/docs
cp -r docs/pages $pages
mkdir -p $pages/pictures
/usr/bin/python3 docs/pictures.py $pages/pictures
/usr/bin/python3 docs/rule_pictures.py $pages/pictures
cp scenes/pictures.png $pages/pictures/scenes.png
cp bench/results/rivals/rivals.png bench/results/error/error_{hulls,meshes}.png bench/results/idle/skipped.png \
   bench/results/scaling/scaling_{growth,strong}.png $pages/pictures/
# The page to try tact is made by emscripten, a build of its own: where it was not made, a page says how.
mkdir -p $pages/try
try=build/cross/wasm/try.html
[[ -f $try ]] || try=docs/try/not_built.html
cp $try $pages/try/index.html
# Old headers say `//` where Doxygen reads `///`: both count.
doxygen docs/Doxyfile
mkdocs build --quiet --config-file docs/mkdocs.yml
/usr/bin/python3 docs/check_site.py build/docs/site
