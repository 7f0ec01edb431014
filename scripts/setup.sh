#!/bin/bash
# Installs the Debian packages that are missing, nothing else.   usage: scripts/setup.sh GROUP...
# The groups are those of the list below, the one place where packages are named. With all of them in place it needs neither
# rights nor network.
set -euo pipefail

packages_of() {
  case $1 in
    library) echo g++ cmake ninja-build libeigen3-dev libembree-dev pkg-config ;;
    python) echo pybind11-dev python3-dev python3-numpy python3-pip python3-setuptools python3-venv python3-wheel ;;
    program) echo g++ cmake ninja-build libeigen3-dev libembree-dev \
                  libcli11-dev libfmt-dev nlohmann-json3-dev libpng-dev zlib1g-dev libfreetype-dev fonts-dejavu-core webp ;;
    tests) echo libgtest-dev libcgal-dev librapidcheck-dev pybind11-dev python3-dev python3-numpy python3-pytest python3-matplotlib ;;
    bullet) echo libbullet-dev pkg-config ;;
    docs) echo doxygen mkdocs mkdocs-material ;;
    bench) echo libcgal-dev libtbb-dev libfcl-dev libccd-dev libbullet-dev pkg-config gnuplot-nox ;;
    lint) echo clang-format clang-tidy clang libomp-dev ;;
    # Not npm's packages where another node is there, which would be replaced.
    viewer) command -v npm > /dev/null || echo nodejs npm
            echo chromium ;;
    sanitizers) echo clang libclang-rt-14-dev libomp-dev llvm ;;
    *) echo "setup.sh: no group is called $1; there are library, python, program, tests, bullet, docs, bench, lint and sanitizers" >&2; exit 2 ;;
  esac
}

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
installed=" $(dpkg-query -W -f '${Package}:${db:Status-Status} ' 2> /dev/null) "
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
"${as_root[@]}" apt-get update -qq < /dev/null
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" \
  < /dev/null > /dev/null
