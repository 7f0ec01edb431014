#!/bin/bash
# What a program compiled against one version hangs on besides the source: the sizes of public types, and the functions
# that the shared library has. Both are held by lists. A list changes only where the SONAME does, or by lines that are
# new; docs/pages/compatibility.md says what that means. How to make a list anew: UPDATE=1 check_abi.sh ...
# usage: check_abi.sh sizes COMPILER FLAG... | functions libtact.so
set -euo pipefail
shopt -s inherit_errexit
folder=$(dirname "$0")
project=$(cd "$folder/../.." && pwd)
what=$1
shift

# Types of tact/solver/ are compiled into the program alone, and templates have no size.
headers_of_cpp() {
  ls "$project"/engine/include/tact/*.h "$project"/engine/base/include/tact/*.h
}
# shellcheck disable=SC2016  # the dollars are awk's
types_of_cpp() {
  headers_of_cpp | xargs awk '/^(struct|class)( TACT_API)? [A-Z][A-Za-z0-9]*( final)?( : .*)? \{$/ && last !~ /^template/ {
    print $2 == "TACT_API" ? $3 : $2 } { last = $0 }'
}
types_of_c() {
  sed -nE 's/^\} (tact_[a-z_]+);$/\1/p' "$project"/bindings/c/include/tact/*.h
}

sizes() {
  local program
  program=$(mktemp -d)
  # shellcheck disable=SC2064  # its name is that of now
  trap "rm -rf '$program'" EXIT  # of the subshell
  {
    echo '#include <cstdio>'
    { headers_of_cpp; ls "$project"/bindings/c/include/tact/*.h; } | sed 's/.*/#include "&"/'
    echo 'int main() {'
    types_of_cpp | LC_ALL=C sort -u | sed 's/.*/std::printf("%s %zu\\n", "tact::&", sizeof(tact::&));/'
    types_of_c | LC_ALL=C sort -u | sed 's/.*/std::printf("%s %zu\\n", "&", sizeof(&));/'
    echo '}'
  } > "$program/sizes.cpp"
  "$@" -I"$project/engine/include" -I"$project/engine/base/include" -I"$project/bindings/c/include" \
    "$program/sizes.cpp" -o "$program/sizes"
  "$program/sizes"
}

case $what in
  sizes) now=$(sizes "$@") ;;
  functions)
    # What the program and tact_mpi of the same version use besides is in no public header.
    now=$(nm -DC --defined-only "$1" | cut -d' ' -f3- | grep -vE '^tact::(WorldParts|FacetOutcomeFinder)::|^tact::plane_turn' |
      LC_ALL=C sort -u) ;;
  *)
    sed -n 's/^# usage: /usage: /p' "$0" >&2
    exit 2 ;;
esac
list=$folder/abi/$what.txt
if [[ -n ${UPDATE-} ]]; then
  echo "$now" > "$list"
fi
diff "$list" <(echo "$now")
echo "$what: $(wc -l < "$list") lines, as in $list"
