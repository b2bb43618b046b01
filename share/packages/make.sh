#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Builds the Debian packages of edgevo in build/packages/*.deb; works from a bare clone.
#
#   share/packages/make.sh
#   apt install ./build/packages/edgevo_*.deb      the program; for the others see README.md next to this script
#
# DEBFULLNAME and DEBEMAIL name the maintainer. JOBS=N sets how many compilers run at a time (default: as many as cores).
# Exit code 0: built, without errors by lintian if it is installed.
set -eu
cd "$(dirname "$0")/../.."
folder=build/packages

share/install_dependencies.sh
# For reproducible packages: dates are those of the commit.
export SOURCE_DATE_EPOCH="${SOURCE_DATE_EPOCH:-$(git log -1 --format=%ct 2>/dev/null || date +%s)}"
share/configure.sh $folder -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX=/usr -DEDGEVO_SANITIZE= \
  -DEDGEVO_BUILD_TESTS=OFF -DEDGEVO_BUILD_BENCHMARKS=OFF -DEDGEVO_SCENES_OF_SOURCES=OFF
cmake --build $folder --parallel "${JOBS:-$(nproc)}"
rm -f $folder/*.deb
(cd $folder && cpack)
if command -v lintian >/dev/null; then share/packages/check.sh $folder/*.deb; fi
ls -l $folder/*.deb
