#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Reports which lines and branches of modules and app the unit tests execute, by module. Not part of the tests: it builds everything
# without optimisation in build/coverage.
#
#   tests/coverage.sh                     builds, runs the unit tests, prints the table
#   tests/coverage.sh --all               the same with all tests, including those of the programs
#   tests/coverage.sh --report [BUILD]    the table of an earlier run (default build/coverage)
#
# The page with each line is BUILD/coverage/index.html. JOBS=N runs so many compilers at a time. Branches are those that a condition of
# the source makes; those that exceptions make are not counted. Exit codes: 0 done, 1 a test failed; 77 gcovr is not installed.
set -eu
cd "$(dirname "$0")/.."
build=build/coverage
tests="-L unit"
run=yes
case "${1:-}" in
  "") ;;
  --all) tests= ;;
  --report) run=; build=${2:-$build} ;;
  *) echo "coverage.sh: unknown option $1; see the head of this script" >&2; exit 2 ;;
esac
command -v gcovr >/dev/null || { echo "SKIPPED: gcovr is not installed; share/install_dependencies.sh --checks" >&2; exit 77; }

status=0
if [ -n "$run" ]; then
  cmake --preset coverage
  cmake --build "$build" --parallel "${JOBS:-$(nproc)}"
  find "$build" -name '*.gcda' -delete  # counts of an earlier run
  ctest --test-dir "$build" --output-on-failure --parallel 2 $tests || status=1
fi

mkdir -p "$build/coverage"
gcovr --root . --object-directory "$build" --filter 'modules/' --filter 'app/' --exclude-throw-branches \
  --exclude-unreachable-branches --gcov-ignore-parse-errors --csv "$build/coverage/files.csv" --html-details "$build/coverage/index.html"

# The table by module from that by file; gcovr's columns: filename,line_total,line_covered,line_percent,branch_total,branch_covered,...
awk -F, '
  function share(covered, total) { return total ? sprintf("%5.1f %%", 100 * covered / total) : "      -" }
  function row(name, n) { printf "%-20s %8d %s %10d %s\n", name, lines[n], share(lines_hit[n], lines[n]), branches[n], share(branches_hit[n], branches[n]) }
  NR == 1 { next }
  {
    split($1, part, "/"); name = part[1] == "app" ? "app" : part[2]
    if (!(name in lines)) names[++count] = name
    for (i = 1; i <= 2; ++i) {
      n = i == 1 ? name : "all"
      lines[n] += $2; lines_hit[n] += $3; branches[n] += $5; branches_hit[n] += $6
    }
  }
  END {
    print "module                  lines covered   branches covered"
    for (i = 1; i <= count; ++i) row(names[i], names[i])
    row("all", "all")
  }' "$build/coverage/files.csv"
exit $status
