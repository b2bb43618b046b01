#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Checks that the sources are formatted by .clang-format and that no line of C++ exceeds 110 columns.
#
#   tests/format.sh          lists each violation, exit code 1
#   tests/format.sh --fix    formats the files in place
#   tests/format.sh --files  lists the files that are checked
#
# Needs clang-format 14 (other versions break lines in other places). Exit code 77: it is not installed.
set -eu
cd "$(dirname "$0")/.."
columns=$(sed -n 's/^ColumnLimit: *//p' .clang-format)

files() { find modules app tests share/examples -name '*.h' -o -name '*.cpp' | sort; }

formatter() {
  for name in clang-format-14 clang-format; do
    command -v $name >/dev/null && $name --version | grep -q 'version 14\.' && { echo $name; return; }
  done
  echo "SKIPPED: clang-format 14 is not installed; share/install_dependencies.sh --checks" >&2
  exit 77
}

long_lines() {
  # Texts in other languages (raw strings) are left alone; a character of several bytes is one column.
  files | xargs awk -v most="$columns" '
    FNR == 1 { raw = 0 }
    { line = $0; gsub(/[\200-\277]/, "", line) }
    !raw && match(line, /R"[a-z]*\(/) { raw = 1; end = ")" substr(line, RSTART + 2, RLENGTH - 3) "\"" }
    !raw && length(line) > most { print FILENAME ":" FNR ": " length(line) " columns, " most " at most"; bad = 1 }
    raw && index(line, end) { raw = 0 }
    END { exit bad }'
}

case "${1:-}" in
  --files) files ;;
  --fix)
    tool=$(formatter) || exit $?
    files | xargs "$tool" -i
    files | xargs "$tool" -i  # some comments need a second pass
    long_lines ;;
  "")
    tool=$(formatter) || exit $?
    status=0
    files | xargs -P 2 -n 40 "$tool" --dry-run -Werror --ferror-limit=1 || status=1
    long_lines || status=1
    [ $status -eq 0 ] || echo "format.sh: not formatted; tests/format.sh --fix does most of it" >&2
    exit $status ;;
  *)
    echo "format.sh: unknown option $1; see the head of this script" >&2
    exit 2 ;;
esac
