#!/bin/bash
# Installs the Debian packages that are missing, nothing else.   usage: scripts/setup.sh GROUP... | --help
# The groups are those of the two lists below, the one place where packages are named. With all of them in place it needs
# neither rights nor network.
set -euo pipefail

help() {
  cat <<'END'
usage: scripts/setup.sh GROUP...
Installs the Debian packages that are missing. The groups:
  library     the library, for C++ and C: cmake -B build
  python      the Python package: pip install bindings/python
  program     the program tact and its scenes: -DTACT_BUILD_PROGRAM=ON
  tests       the tests, with program: -DTACT_BUILD_TESTS=ON
  bench       the libraries that the benchmarks measure against, with program: -DTACT_BUILD_BENCH=ON
  notebook    what notebooks show and read, with python: Jupyter, meshio, tqdm
  paraview    ParaView, for the filter and its tests: bindings/paraview
  mpi         worlds over many ranks: tact::mpi, which is built where these are
  blender     Blender, for the add-on and its tests: bindings/blender
  packages    what makes Debian packages, with library, program, python, mpi: packaging/README.md
  bullet      the example of Bullet's soft bodies
  docs        the manual: scripts/docs.sh
  viewer      the page of `tact view` from its sources: scripts/viewer.sh
  lint        scripts/lint.sh
  sanitizers  scripts/sanitize.sh, scripts/fuzz.sh
  aarch64     scripts/cross.sh aarch64: a compiler and an emulator for ARM, libraries of Debian's architecture arm64
  windows     scripts/cross.sh windows: MinGW-w64 and Wine
  libcxx      scripts/cross.sh libcxx: Clang with its own standard library
  wasm        scripts/cross.sh wasm, scripts/wasm.sh: emscripten, for the npm package; its tests with viewer
END
}

packages_of() {
  case $1 in
    library) echo g++ cmake ninja-build libeigen3-dev libembree-dev pkg-config ;;
    python) echo libfmt-dev nlohmann-json3-dev zlib1g-dev pybind11-dev python3-dev python3-numpy python3-pip python3-setuptools python3-venv python3-wheel ;;
    program) echo g++ cmake ninja-build libeigen3-dev libembree-dev \
                  libcli11-dev libfmt-dev nlohmann-json3-dev libpng-dev zlib1g-dev libfreetype-dev fonts-dejavu-core webp ;;
    tests) echo libgtest-dev libcgal-dev libboost-dev librapidcheck-dev pybind11-dev python3-dev python3-numpy python3-pytest python3-matplotlib python3-scipy ;;
    mpi) echo libopenmpi-dev openmpi-bin libtrilinos-zoltan-dev python3-mpi4py ;;
    blender) echo blender python3-numpy python3-pytest xvfb xauth ;;
    notebook) echo jupyter-nbconvert python3-nbclient python3-nbformat python3-ipykernel python3-meshio python3-h5py python3-matplotlib python3-tqdm ;;
    paraview) echo paraview python3-paraview python3-numpy python3-pytest python3-meshio ;;
    packages) echo dpkg-dev file ;;
    bullet) echo libbullet-dev pkg-config ;;
    docs) echo doxygen mkdocs mkdocs-material ;;
    bench) echo libcgal-dev libtbb-dev libfcl-dev libccd-dev libbullet-dev pkg-config gnuplot-nox ;;
    lint) echo clang-format clang-tidy clang libomp-dev ;;
    # Not npm's packages where another node is there, which would be replaced.
    viewer) command -v npm > /dev/null || echo nodejs npm
            echo chromium ;;
    sanitizers) echo clang libclang-rt-14-dev libomp-dev llvm ;;
    aarch64) echo g++-aarch64-linux-gnu cmake ninja-build qemu-user libeigen3-dev libembree-dev:arm64 libgomp1:arm64 \
                  libgtest-dev:arm64 libcgal-dev libboost-dev libgmp-dev:arm64 libmpfr-dev:arm64 librapidcheck-dev:arm64 ;;
    windows) echo g++-mingw-w64-x86-64-posix cmake ninja-build wine wine64 libeigen3-dev googletest ;;
    libcxx) echo clang libc++-dev libc++abi-dev cmake ninja-build libeigen3-dev ;;
    wasm) command -v npm > /dev/null || echo npm
          echo emscripten cmake ninja-build libeigen3-dev ;;
    *) printf 'setup.sh: no group is called %s\n\n%s\n' "$1" "$(help)" >&2; exit 2 ;;
  esac
}

if (( $# == 0 )); then
  help >&2
  exit 2
fi
if [[ $1 == --help || $1 == -h ]]; then
  help
  exit 0
fi

wanted=()
for group in "$@"; do
  packages=$(packages_of "$group")
  read -ra names <<< "${packages//$'\n'/ }"
  wanted+=("${names[@]}")
done

if ! command -v apt-get > /dev/null; then
  echo "setup.sh: this is not Debian; what is needed is called there: ${wanted[*]}" >&2
  exit 0
fi
# What is foreign has its architecture behind its name.
here=$(dpkg --print-architecture)
installed=" $(dpkg-query -W -f '${Package}:${Architecture}:${db:Status-Status} ' 2> /dev/null | sed "s/:\(all\|$here\):/:/g") "
missing=()
for name in "${wanted[@]}"; do
  [[ $installed == *" $name:installed "* || " ${missing[*]} " == *" $name "* ]] || missing+=("$name")
done
(( ${#missing[@]} == 0 )) && exit 0

as_root=()
if (( EUID != 0 )); then
  if ! command -v sudo > /dev/null; then
    echo "setup.sh: run it as root or install sudo; missing are: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "installing ${missing[*]}"
if [[ ${missing[*]} == *:arm64* ]]; then
  "${as_root[@]}" dpkg --add-architecture arm64
fi
"${as_root[@]}" apt-get update -qq < /dev/null
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" \
  < /dev/null > /dev/null
