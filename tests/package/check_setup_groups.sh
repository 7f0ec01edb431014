#!/bin/bash
# Each group of packages that scripts/setup.sh knows stands in its help and in the manual, and no other; every text that
# names groups names such; and the Python package is installed in one way, wherever that is told.
# usage: check_setup_groups.sh PROJECT
set -euo pipefail
cd "$1"
known=$(sed -n '/^packages_of()/,/^}/s/^    \([a-z0-9]*\)) .*/\1/p' scripts/setup.sh | sort)
helped=$(scripts/setup.sh --help | sed -n 's/^  \([a-z0-9]*\) .*/\1/p' | sort)
told=$(sed -n 's/^| `\([a-z0-9]*\)` | .*/\1/p' docs/pages/start/cpp.md | sort)
diff <(echo "$known") <(echo "$helped")
diff <(echo "$known") <(echo "$told")
(( $(wc -l <<< "$known") > 5 ))

texts=(-r --include=*.md --include=*.sh --exclude-dir=build --exclude-dir=node_modules --exclude-dir=env .)
while read -r line; do
  for word in ${line#scripts/setup.sh}; do
    grep -qx -- "$word" <<< "$known" || { echo "no group is called $word: $line"; exit 1; }
  done
done < <(grep -hoE 'scripts/setup\.sh( [a-z0-9]+)+( *($|[`#;)]))' "${texts[@]}" .ci/run | sed -E 's/[`#;) ]+$//')

installs() { grep -E -A2 '^scripts/setup.sh .*python' "$1"; }
(( $(installs bindings/python/README.md | wc -l) == 3 ))
diff <(installs bindings/python/README.md) <(installs docs/pages/start/python.md)
# Another Python may stand before Debian's, for which the packages are.
! grep -rnE --include=*.md --exclude-dir=build '(^|[^/])python3 -m venv' .
