#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The documentation builds without warnings: every public symbol is documented, every reference resolves, and every link between
# pages leads to an existing page. Usage: doxygen_clean.sh DOXYFILE FOLDER
set -eu
doxyfile=$1 folder=$2
command -v doxygen >/dev/null || { echo "SKIPPED: doxygen is not installed; share/install_dependencies.sh --checks" >&2; exit 77; }

rm -rf "$folder" && mkdir -p "$folder"
# Class diagrams would take most of the time and cannot fail.
{ cat "$doxyfile"; echo "HAVE_DOT = NO"; echo "OUTPUT_DIRECTORY = $folder"; } > "$folder/Doxyfile"
doxygen "$folder/Doxyfile" 2>"$folder/warnings" || true
if [ -s "$folder/warnings" ]; then
  echo "doxygen warns; fix the lines below, then: cmake --build BUILD --target doc" >&2
  sort -u "$folder/warnings" >&2
  exit 1
fi
[ -s "$folder/html/index.html" ] || { echo "doxygen made no index.html" >&2; exit 1; }

# Links and pictures of the pages; the pages of symbols are checked by doxygen.
cd "$folder/html"
missing=$(grep -oHE '(href|src)="[^"#:]+["#]' index.html md_*.html share_*.html modules_*.html 2>/dev/null |
  sed 's/:\(href\|src\)="/ /; s/["#]$//' | sort -u | while read -r page target; do
    [ -e "$target" ] || echo "$page: $target is not there"
  done)
[ -z "$missing" ] || { echo "$missing" >&2; exit 1; }
