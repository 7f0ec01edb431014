#!/bin/bash
# The Blender add-on, in Blender without a window.   usage: check_blender.sh TACT   with PYTHONPATH set
set -euo pipefail
if ! command -v blender > /dev/null; then
  echo "check_blender.sh: Blender is missing: scripts/setup.sh blender installs it"
  exit 77  # which ctest takes for skipped
fi
export TACT_PROGRAM=$1 PYTHONDONTWRITEBYTECODE=1
exec blender -b --factory-startup --python-exit-code 1 --python "$(dirname "$0")/run.py"
