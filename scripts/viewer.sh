#!/bin/bash
# The page of `tact view`, which viewer/ holds.   usage: scripts/viewer.sh build | check | test | shots
#   build   makes viewer/page.html from its sources: after every change of them
#   check   is viewer/page.html what the sources give?
#   test    opens pages of all scenes in Chromium and compares what they show with the program's JSON
#   shots   the same, and keeps the pictures that the tests compare with
set -euo pipefail
cd "$(dirname "$0")/../viewer"

missing=()
for program in node npm chromium; do
  command -v "$program" > /dev/null || missing+=("$program")
done
need() {
  (( ${#missing[@]} == 0 )) && return
  echo "viewer.sh: ${missing[*]} missing: scripts/setup.sh viewer installs what is needed"
  exit 77  # which ctest takes for skipped
}
install_packages() {
  [[ node_modules/.package-lock.json -nt package-lock.json ]] && return
  npm ci --ignore-scripts --no-audit --no-fund --loglevel=error
}

case ${1-} in
  build)
    need && install_packages
    node build.mjs page.html ;;
  check)
    need && install_packages
    built=$(mktemp)
    trap 'rm -f "$built"' EXIT
    node build.mjs "$built"
    cmp "$built" page.html || { echo "viewer/page.html is not what its sources give: run scripts/viewer.sh build" >&2; exit 1; } ;;
  test | shots)
    need
    if [[ ! -d node_modules/playwright-core ]]; then
      echo "viewer.sh: the packages of npm are missing: scripts/viewer.sh check fetches them"
      exit 77
    fi
    export TACT_PROGRAM=${TACT_PROGRAM:-$PWD/../build/release/scenes/tact}
    [[ $1 == shots ]] && export TACT_KEEP_SHOTS=1
    node --test --test-reporter=spec test/*.test.mjs ;;
  *)
    sed -n '2,6s/^# \?//p' "$0" >&2
    exit 2 ;;
esac
