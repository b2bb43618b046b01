#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs the distribution packages that edgevo is built from (Debian 12 names). Quiet and quick when all is there.
#
#   share/install_dependencies.sh            install what is missing (as root, or through sudo)
#   share/install_dependencies.sh --checks   the same, and what checks and documents the sources (doxygen, clang-format, gcovr)
#   share/install_dependencies.sh --tidy     the same, and clang-tidy with the compiler that it needs (tests/tidy.sh; 230 MB)
#   share/install_dependencies.sh --workflow  the same, and the engine of `edgevo bench` (share/workflow)
#   share/install_dependencies.sh --core     only what the odometry as a library needs (cmake --preset core)
#   share/install_dependencies.sh --list     print the package names, one a line, and do nothing
#
# Exit codes: 0 all is there; 2 this system is not known, or the packages could not be installed.
set -eu

# compiler and tools | mathematics, images, JSON
CORE_PACKAGES="
build-essential cmake ninja-build git
libeigen3-dev libopencv-dev libceres-dev zlib1g-dev nlohmann-json3-dev
"
# data sets, camera files | bags of ROS, run.mcap and the reader of its tests | the Python package | its tests |
# MRPT, ViSP, OctoMap and the tools that open our files | command line, tests | planners (for a test) | plots of `edgevo study` | tests of what opens a window | manual pages and packages
PACKAGES="$CORE_PACKAGES
libexif-dev libsqlite3-dev libxml2-dev libdeflate-dev
libbz2-dev liblz4-dev libzstd-dev python3
pybind11-dev python3-dev python3-numpy
python3-opencv mypy
libmrpt-maps-dev libmrpt-gui-dev libmrpt-hwdrivers-dev mrpt-apps
libvisp-dev liboctomap-dev octomap-tools
libcli11-dev libgtest-dev libgmock-dev libbenchmark-dev
libompl-dev libfcl-dev libmrpt-nav-dev
gnuplot-nox
xvfb xdotool imagemagick
help2man file
"
# The site of the documentation | the form of the sources (tests/format.sh) | what the tests execute (tests/coverage.sh)
CHECK_PACKAGES="
doxygen graphviz
clang-format-14
gcovr
"

fail() {
  echo "install_dependencies.sh: $1" >&2
  exit 2
}

# Any other build of gnuplot will do, and would be removed by this one.
is_installed() {
  if [ "$1" = gnuplot-nox ] && command -v gnuplot >/dev/null; then return 0; fi
  [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

missing_packages() {
  for package in $PACKAGES; do
    is_installed "$package" || echo "$package"
  done
}

# Debian 12 is what edgevo is developed on; what is newer may work.
check_system() {
  [ -r /etc/os-release ] || fail "this system is not known (no /etc/os-release); edgevo needs Debian 12 or newer"
  . /etc/os-release
  case "${ID:-unknown} ${VERSION_ID:-testing}" in
    "debian 12") ;;
    "debian 1"[3-9] | "debian testing" | "ubuntu 2"[3-9].*)
      echo "install_dependencies.sh: edgevo was tried on Debian 12 only, not on ${PRETTY_NAME:-this system}" >&2 ;;
    *) fail "${PRETTY_NAME:-this system} is not known; edgevo needs Debian 12 or newer. Packages: see --list" ;;
  esac
}

run_as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    fail "neither root nor sudo; ask an administrator for: apt-get install --no-install-recommends $missing"
  fi
}

apt() {
  run_as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0 "$@" >/dev/null ||
    fail "apt-get $1 failed; see the lines above, and check the network and /etc/apt"
}

while :; do
  case "${1:-}" in
    --core) PACKAGES=$CORE_PACKAGES ;;
    --checks) PACKAGES="$PACKAGES$CHECK_PACKAGES" ;;
    --tidy) PACKAGES="$PACKAGES clang-tidy-14" ;;
    --workflow) PACKAGES="$PACKAGES snakemake" ;;
    *) break ;;
  esac
  shift
done
if [ "${1:-}" = --list ]; then
  printf '%s\n' $PACKAGES
  exit 0
fi
[ $# -eq 0 ] || fail "unknown option $1; see the head of this script"

command -v dpkg-query >/dev/null || { check_system; fail "dpkg-query is missing"; }
missing=$(missing_packages | tr '\n' ' ')
[ -z "$missing" ] && exit 0
check_system
echo "Installing: $missing" >&2
apt update
apt install -y --no-install-recommends $missing
