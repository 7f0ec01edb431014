#!/bin/bash
# Each header of the kernels compiles by itself, for each instruction set.   usage: headers_compile_alone.sh COMPILER
set -uo pipefail
cd "$(dirname "$0")/../../.."
compiler=$1
avx2="-DTACT_KERNELS_AVX2 -mavx2 -mfma -mbmi -mbmi2 -mpopcnt"
avx512="-DTACT_KERNELS_AVX512 -mavx512f -mavx512dq -mavx512vl -mavx512bw -mavx512vbmi -mavx512vbmi2 -mbmi -mbmi2 -mpopcnt"
simd128="-DTACT_KERNELS_SIMD128"
sets=("" "$simd128")
[[ $(uname -m) == x86_64 ]] && sets+=("$avx2" "$avx512")
checked=0
failed=0
for header in {narrowphase,broadphase}/kernels/*.{h,inl} narrowphase/distance/{rounding.h,*.inl} engine/base/simd128.h; do
  for set in "${sets[@]}"; do
    [[ $header == *_simd128.h && $set != "$simd128" ]] && continue
    [[ $header == *_avx2.h && $set != "$avx2" || $header == *_avx512.h && $set != "$avx512" ]] && continue
    # shellcheck disable=SC2086  # a set is several options
    if ! $compiler -std=c++20 $set -fsyntax-only -I. -Iengine/include -Iengine/base/include -x c++ -include "$header" /dev/null; then
      echo "$header does not compile by itself with the options '$set'"
      ((++failed))
    fi
    ((++checked))
  done
done
echo "$checked compiled, $failed failed"
((checked > 0 && failed == 0))
