#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Configures a build folder as the demo, the tests and the packages do, so that none of them compiles again what another has compiled:
# what changes the command of a compiler is decided here only.
#
#   share/configure.sh FOLDER [OPTION of cmake ...]
#
# A folder that is already configured keeps its choice of ccache, precompiled headers and warnings. Warnings are errors with CI=true and with
# GCC 12, which edgevo is developed with.
set -eu
cd "$(dirname "$0")/.."
folder=$1
shift

# The value of a variable in the cache of the folder; nothing if it has none.
cached() { sed -n "s/^$1:[A-Z]*=//p" "$folder/CMakeCache.txt" 2>/dev/null || true; }

if [ -e "$folder/CMakeCache.txt" ]; then
  launcher=$(cached CMAKE_CXX_COMPILER_LAUNCHER) without_pch=$(cached CMAKE_DISABLE_PRECOMPILE_HEADERS)
else
  launcher=ccache without_pch=OFF
fi
command -v "$launcher" >/dev/null || launcher=
# ccache and precompiled headers are incompatible (a cached header crashes GCC 12); either saves about the same time.
[ -z "$launcher" ] || without_pch=ON
warnings=$(cached EDGEVO_WARNINGS_AS_ERRORS)
if [ "${CI:-}" = true ]; then
  warnings=ON
elif [ -z "$warnings" ]; then
  case $("${CXX:-c++}" -dumpfullversion 2>/dev/null || true) in 12.*) warnings=ON ;; *) warnings=OFF ;; esac
fi

# Unity build (eight sources at once): half the time. The preset dev checks that each source compiles alone.
exec cmake -S . -B "$folder" -G Ninja -DCMAKE_UNITY_BUILD=ON -DEDGEVO_WARNINGS_AS_ERRORS=$warnings \
  -DCMAKE_CXX_COMPILER_LAUNCHER="$launcher" -DCMAKE_DISABLE_PRECOMPILE_HEADERS="${without_pch:-OFF}" "$@"
