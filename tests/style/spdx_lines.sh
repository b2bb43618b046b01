#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Each source file names its licence in its first line (the second, after "#!").
#
#   tests/style/spdx_lines.sh           lists the files that do not, exit code 1
#   tests/style/spdx_lines.sh --files   lists the files that are checked
#
# All sources are under this licence, those that link ViSP (GPL) as well: see the note in LICENSE.
set -eu
cd "$(dirname "$0")/../.."
licence='SPDX-License-Identifier: BSD-3-Clause'

files() {
  find .ci app modules share tests CMakeLists.txt \( -name '*.h' -o -name '*.cpp' -o -name '*.cmake' -o -name CMakeLists.txt -o -name '*.sh' \
    -o -name '*.py' -o -name '*.awk' -o -name Snakefile -o -path .ci/run \) -type f | sort
}

[ "${1:-}" = --files ] && { files; exit 0; }
files | xargs awk -v licence="$licence" '
  FNR == 1 { file = FILENAME; due = /^#!/ ? 2 : 1 }
  FNR == due && ($0 == "// " licence || $0 == "# " licence) { named[file] = 1 }
  END {
    for (i = 1; i < ARGC; ++i)
      if (!(ARGV[i] in named)) { print ARGV[i] ": the first line must be: " licence " (as a comment)"; bad = 1 }
    exit bad
  }'
