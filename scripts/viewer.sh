#!/bin/bash
# The page of `tact view`, which viewer/ holds.   usage: scripts/viewer.sh build | sums | check | test | shots
# viewer/page.html is kept in the tree, since the program is built without node and without the network, and what makes the
# page comes from npm. page.sha256 tells from which sources it was made.
#   build   makes viewer/page.html and page.sha256 from the sources: after every change of them
#   sums    compares page and sources with page.sha256, without node: ctest runs it
#   check   the same, then makes the page once more and compares every byte
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

sums() {
  LC_ALL=C sha256sum build.mjs package.json package-lock.json src/* page.html
}
compare_sums() {
  diff page.sha256 <(sums) && return
  echo "viewer/page.html is not of these sources, see the sums above: run scripts/viewer.sh build" >&2
  exit 1
}

case ${1-} in
  build)
    need && install_packages
    node build.mjs page.html
    sums > page.sha256 ;;
  sums)
    compare_sums ;;
  check)
    compare_sums
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
    sed -n '2,9s/^# \?//p' "$0" >&2
    exit 2 ;;
esac
