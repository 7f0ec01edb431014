#!/bin/bash
# Builds a wheel of the Python package, installs it into a fresh environment and runs the start page's example there.
# usage: scripts/wheels.sh [x86-64|aarch64]     this machine's kind of processor, or ARM with 64 bits under qemu-user
# A wheel is for one version of Python, Debian's, and for Linux with this machine's C library or a newer one. Beside those
# two it needs numpy and zlib: it has the compiler's libraries in it, and neither Embree nor OpenMP, without which the
# answers are the same. Wheels go to build/wheels.
set -euo pipefail
cd "$(dirname "$0")/.."
kind=${1:-$(uname -m | tr _ -)}
case $kind in
  x86-64 | aarch64) ;;
  *)
    sed -n '2,6s/^# \?//p' "$0" >&2
    exit 2 ;;
esac
scripts/setup.sh library python
wheels=$PWD/build/wheels
work=$wheels/$kind
mkdir -p "$work"
if command -v ccache > /dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
options="-DTACT_PYTHON_ALONE=ON -DTACT_WITH_EMBREE=OFF -DTACT_WITH_OPENMP=OFF -DTACT_WITH_MPI=OFF -DTACT_UNITY_BUILD=ON"
emulator=()

# Debian's packages of arm64, laid out in a folder: installed, they would take the place of this machine's own.
lay_out_arm64() {
  local python
  python=python$(/usr/bin/python3 -c 'import sys; print(*sys.version_info[:2], sep=".")')
  scripts/setup.sh aarch64
  root=$work/root
  if [[ ! -x $root/usr/bin/$python ]]; then
    mkdir -p "$work/debs"
    (cd "$work/debs" && apt-get download -qq "$python-minimal:arm64" "lib$python-minimal:arm64" "lib$python-stdlib:arm64" \
      "lib$python-dev:arm64" python3-numpy:arm64 libblas3:arm64 liblapack3:arm64 libgfortran5:arm64 libexpat1:arm64 \
      libffi8:arm64 libssl3:arm64 zlib1g:arm64 zlib1g-dev:arm64 libfmt9:arm64 libfmt-dev:arm64)
    for package in "$work"/debs/*.deb; do
      dpkg -x "$package" "$root"
    done
  fi
  libraries=$root/usr/lib/aarch64-linux-gnu
  emulator=(env PYTHONPATH="$root/usr/lib/python3/dist-packages:/usr/lib/python3/dist-packages"
    qemu-aarch64 -E LD_LIBRARY_PATH="$libraries/blas:$libraries/lapack:$libraries:$root/lib/aarch64-linux-gnu")
  interpreter=$root/usr/bin/$python
  options+=" --toolchain $PWD/cmake/platforms/aarch64.cmake -DCMAKE_FIND_ROOT_PATH=$root -DCMAKE_CXX_FLAGS='-isystem $root/usr/include'"
  options+=" -DZLIB_LIBRARY=$root/lib/aarch64-linux-gnu/libz.so.1"
  options+=" -DPython3_EXECUTABLE=/usr/bin/python3 -DPython3_INCLUDE_DIR=$root/usr/include/$python"  # CMake runs the former
}

interpreter=/usr/bin/python3
[[ $kind == "$(uname -m | tr _ -)" ]] || lay_out_arm64
run() {
  "${emulator[@]}" "$@"
}

# Pip would start Python itself, which an emulator has to start.
log=$work/build.log
c_library=$(getconf GNU_LIBC_VERSION)
platform=${c_library#glibc }
platform=manylinux_${platform/./_}_${kind/-/_}
rm -f "$wheels"/tact-*"_${kind/-/_}.whl"
if ! (cd bindings/python && TACT_CMAKE_OPTIONS=$options run "$interpreter" setup.py egg_info --egg-base "$work" \
    build --build-base "$work/build" bdist_wheel --plat-name "$platform" --bdist-dir "$work/files" --dist-dir "$wheels") > "$log" 2>&1; then
  cat "$log" >&2
  exit 1
fi
wheel=$(ls "$wheels"/tact-*"_${kind/-/_}.whl")
echo "built ${wheel#"$PWD/"}: $(stat -c %s "$wheel") bytes"

rm -rf "$work/env"
run "$interpreter" -m venv --system-site-packages --without-pip "$work/env"
run "$work/env/bin/python" -m pip install --quiet --no-index --no-warn-script-location "$wheel"
module=$(run "$work/env/bin/python" -c 'import tact._tact; print(tact._tact.__file__)')
if [[ $module != "$work/env/"* ]]; then
  echo "not the wheel's module was imported but $module" >&2
  exit 1
fi
if readelf -d "$module" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | grep -vE '^(libc\.so\.6|libm\.so\.6|libz\.so\.1|ld-linux-.*)$' >&2; then
  echo "is needed by the wheel, which a machine may not have" >&2
  exit 1
fi
run "$work/env/bin/python" examples/start/python/first.py
