#!/bin/bash
# The add-on in a window of Blender, under Xvfb: undo, Esc, and a picture of it.
# usage: check_window.sh [PICTURE.png]   with PYTHONPATH set
set -euo pipefail
for program in blender xvfb-run; do
  if ! command -v $program > /dev/null; then
    echo "check_window.sh: $program is missing: scripts/setup.sh blender installs it"
    exit 77  # which ctest takes for skipped
  fi
done
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export TACT_PICTURE=${1:-$folder/window.png} PYTHONDONTWRITEBYTECODE=1 LIBGL_ALWAYS_SOFTWARE=1
xvfb-run -a -s "-screen 0 1360x900x24" blender --factory-startup --enable-event-simulate -p 0 0 1360 900 --python "$here/window.py"
[[ -s $TACT_PICTURE ]]
