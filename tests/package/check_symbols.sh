#!/bin/bash
# What a library shows to the linker.   usage: check_symbols.sh exports libtact.so | kernels libtact.a
#   exports  every symbol that the shared library defines is tact's, in C++ or C
#   kernels  the files compiled for one instruction set define no weak symbol: the linker could take such a copy for
#            everyone's, and the program would stop on a machine without those instructions
set -euo pipefail
what=$1
library=$2
case $what in
  exports)
    symbols=$(nm -DC --defined-only "$library" | cut -d' ' -f3-)
    needed='^tact::World::detect\(\)'
    wrong=$(grep -vE '^((typeinfo|typeinfo name|vtable) for )?tact::|^tact_[a-z_]+$' <<< "$symbols" || true)
    ;;
  kernels)
    symbols=$(nm -AC --defined-only "$library" 2> /dev/null | grep -E ':[a-z_]*_avx[0-9a-z]*\.cpp\.o:')
    needed=' [A-Z] tact::'
    wrong=$(grep -E ' [WVu] ' <<< "$symbols" || true)
    ;;
  *)
    echo "check_symbols.sh: exports or kernels, not $what" >&2
    exit 2
    ;;
esac
if ! grep -qE "$needed" <<< "$symbols"; then
  echo "$library: $needed is missing"
  exit 1
fi
if [[ -n "$wrong" ]]; then
  echo "$library must not show:"
  echo "$wrong"
  exit 1
fi
echo "$library: $(wc -l <<< "$symbols") symbols, as it should be"
