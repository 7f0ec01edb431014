#!/bin/bash
# Runs programs and says whether all print the same.   usage: equal_answers.sh PROGRAM...
set -euo pipefail
expected=$("$1")
printf '%s\n' "$expected"
for program in "$@"; do
  answer=$("$program")
  if [[ "$answer" != "$expected" ]]; then
    printf 'not so %s:\n%s\n' "$program" "$answer"
    exit 1
  fi
done
