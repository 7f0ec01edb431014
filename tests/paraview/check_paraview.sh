#!/bin/bash
# The filter for ParaView, in pvpython.   usage: check_paraview.sh TACT   with PYTHONPATH set
set -euo pipefail
if ! command -v pvpython > /dev/null; then
  echo "check_paraview.sh: ParaView is missing: scripts/setup.sh paraview installs it"
  exit 77  # which ctest takes for skipped
fi
here=$(cd "$(dirname "$0")" && pwd)
export TACT_PROGRAM=$1 PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$here/../../bindings/paraview:${PYTHONPATH:-}
exec pvpython --force-offscreen-rendering "$here/test_filter.py"
