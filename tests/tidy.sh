#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Runs clang-tidy with the checks of .clang-tidy on our sources; not part of the tests, since all sources take hours.
#
#   tests/tidy.sh [BUILD]                    all of modules and app
#   tests/tidy.sh [BUILD] FILE...            these files
#   tests/tidy.sh [BUILD] --changed [BASE]   files that differ from BASE, including uncommitted and new ones; headers through the sources
#                                            with the same name. Without BASE: the merge base with origin/main; on main itself HEAD~1
#
# BUILD (default build/dev: each source by itself) was configured by CMake; it need not be built. JOBS=N runs so many at a time (default 1).
# Exit codes: 0 nothing found; 1 findings, each a line "FILE:LINE:COLUMN: warning: ..."; 2 a source could not be read, or wrong use;
# 77 clang-tidy is not installed.
set -eu
cd "$(dirname "$0")/.."

fail() { echo "tidy.sh: $1" >&2; exit 2; }

tidy() {
  for name in clang-tidy-14 clang-tidy; do
    command -v $name >/dev/null && { echo $name; return; }
  done
  echo "SKIPPED: clang-tidy is not installed; share/install_dependencies.sh --tidy" >&2
  exit 77
}

default_base() {
  base=$(git merge-base HEAD origin/main 2>/dev/null || true)
  [ -n "$base" ] && [ "$base" != "$(git rev-parse HEAD)" ] && { echo "$base"; return; }
  echo HEAD~1
}

# Files of C++ that differ from BASE.
changed_files() {
  { git diff --name-only --diff-filter=d "$1" --; git ls-files --others --exclude-standard; } | sort -u |
    grep -E '^(modules|app|tests|share/training)/.*\.(h|cpp)$' || true
}

# Sources that cover the files on stdin: for a header, the source or the test with the same name.
sources_of() {
  while read -r file; do
    case "$file" in
      *.cpp) echo "$file" ;;
      *) name=$(basename "$file" .h); git ls-files "modules/*/$name.cpp" "tests/*/${name}_test.cpp" "app/$name.cpp" ;;
    esac
  done | sort -u
}

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
build=build/dev
case "${1:-}" in --* | "") ;; *) [ -d "$1" ] && { build=$1; shift; } ;; esac
tool=$(tidy) || exit $?
case "${1:-}" in
  --changed)
    base=${2:-$(default_base)}
    git rev-parse --quiet --verify "$base^{commit}" >/dev/null || fail "$base: no such commit"
    changed_files "$base" >"$work/changed"
    set -- $(sources_of <"$work/changed")
    [ $# -gt 0 ] || { echo "no source differs from $base"; exit 0; } ;;
  --*) fail "unknown option $1; see the head of this script" ;;
  "") set -- $(find modules app -name '*.cpp' | sort) ;;
esac
[ -f "$build/CMakeCache.txt" ] || fail "$build is not configured; cmake --preset dev"
cmake -S . -B "$build" -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null

# Warnings about GCC options unknown to clang are irrelevant.
printf '%s\n' "$@" | xargs -P "${JOBS:-1}" -n 1 "$tool" -p "$build" --quiet --extra-arg=-Wno-unknown-warning-option \
  --extra-arg=-Wno-unused-command-line-argument >"$work/all" 2>"$work/messages" || true
grep -E ': (warning|error): ' "$work/all" | sed "s,$PWD/,," | sort -u >"$work/found" || true
# Findings in unchanged headers do not count.
if [ -e "$work/changed" ]; then
  sed 's/$/:/' "$work/changed" | grep -F -f - "$work/found" >"$work/held" || true
  mv "$work/held" "$work/found"
fi
cat "$work/found"
if [ -s "$work/found" ]; then exit 1; fi
if grep -q -i -E 'error (while|reading)|no such file' "$work/messages"; then cat "$work/messages" >&2; exit 2; fi
echo "clang-tidy: nothing found in $# sources"
