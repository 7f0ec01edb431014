#!/bin/bash
# Each group of packages that scripts/setup.sh knows stands in its help and in the manual, and no other.
# usage: check_setup_groups.sh PROJECT
set -euo pipefail
cd "$1"
known=$(sed -n '/^packages_of()/,/^}/s/^    \([a-z]*\)) .*/\1/p' scripts/setup.sh | sort)
helped=$(scripts/setup.sh --help | sed -n 's/^  \([a-z]*\) .*/\1/p' | sort)
told=$(sed -n 's/^| `\([a-z]*\)` | .*/\1/p' docs/pages/start/cpp.md | sort)
diff <(echo "$known") <(echo "$helped")
diff <(echo "$known") <(echo "$told")
(( $(wc -l <<< "$known") > 5 ))
