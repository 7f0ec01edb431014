#!/bin/bash
# The Debian package of a shared library is named after its SONAME, as Debian's policy (8.1) asks: libtact.so.1.0 is in
# libtact1.0.   usage: check_soname.sh LIBRARY CPACK_CONFIG
set -euo pipefail
soname=$(objdump -p "$1" | awk '$1 == "SONAME" {print $2}')
package=$(sed -n 's/^set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME "\(.*\)")$/\1/p' "$2")
echo "SONAME $soname, package $package"
[[ -n $package && $package == "${soname/.so./}" ]]
