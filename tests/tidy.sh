#!/bin/sh
# clang-tidy with the checks of .clang-tidy over our sources; not part of the tests, since all of them take hours.
#
#   tests/tidy.sh [BUILD]              all of modules and app
#   tests/tidy.sh [BUILD] FILE...      these
#
# BUILD (default build/dev: each source by itself) was configured by CMake; it need not be built. JOBS=N runs so many at a time (default 1).
# Exit codes: 0 nothing found; 1 findings, each a line "FILE:LINE:COLUMN: warning: ..."; 77 clang-tidy is not installed.
set -eu
cd "$(dirname "$0")/.."
build=build/dev
[ $# -gt 0 ] && [ -d "$1" ] && { build=$1; shift; }
command -v clang-tidy >/dev/null || { echo "SKIPPED: clang-tidy is not installed (package clang-tidy)" >&2; exit 77; }
[ -f "$build/CMakeCache.txt" ] || { echo "tidy.sh: $build is not configured; cmake --preset dev" >&2; exit 2; }
cmake -S . -B "$build" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
[ $# -gt 0 ] || set -- $(find modules app -name '*.cpp' | sort)

found=$(mktemp)
trap 'rm -f "$found"' EXIT
# GCC's options that clang does not know say nothing about the code.
printf '%s\n' "$@" | xargs -P "${JOBS:-1}" -n 1 clang-tidy -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option \
  --extra-arg=-Wno-unused-command-line-argument 2>/dev/null | grep -E ': (warning|error): ' | sort -u > "$found" || true
sed "s,$PWD/,," "$found"
[ ! -s "$found" ]
