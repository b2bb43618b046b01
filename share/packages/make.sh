#!/bin/sh
# Makes the Debian packages of edgevo; works from a bare clone. They lie in build/packages/*.deb.
#
#   share/packages/make.sh
#   apt install ./build/packages/edgevo_*.deb      the program; README.md beside this script says what the others are
#
# DEBFULLNAME and DEBEMAIL name who makes them. JOBS=N sets how many compilers run at a time (default: as many as cores).
# Exit code 0: they are made, and lintian, where it is installed, finds no error.
set -eu
cd "$(dirname "$0")/../.."
folder=build/packages
command -v ccache >/dev/null && launcher=ccache without_pch=ON || { launcher='' without_pch=OFF; }  # see tests/run.sh

share/install_dependencies.sh
# What does not depend on when it was made: dates are those of the commit.
export SOURCE_DATE_EPOCH="${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}"
cmake -S . -B $folder -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DEDGEVO_SANITIZE= \
  -DEDGEVO_BUILD_TESTS=OFF -DEDGEVO_BUILD_BENCHMARKS=OFF -DEDGEVO_SCENES_OF_SOURCES=OFF -DCMAKE_UNITY_BUILD=ON \
  -DCMAKE_CXX_COMPILER_LAUNCHER=$launcher -DCMAKE_DISABLE_PRECOMPILE_HEADERS=$without_pch
cmake --build $folder --parallel "${JOBS:-$(nproc)}"
rm -f $folder/*.deb
(cd $folder && cpack)
if command -v lintian >/dev/null; then share/packages/check.sh $folder/*.deb; fi
ls -l $folder/*.deb
