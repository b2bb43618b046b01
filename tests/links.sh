#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Checks that every relative link in the pages (*.md) leads to an existing file and heading.
#
#   tests/links.sh [FOLDER]    the repository by default; lists broken links, exit code 1
#   tests/links.sh --check     tests the check itself on correct and wrong pages
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

pages() {
  (cd "$1" && find . \( -name build -o -name out -o -name shared -o -name '.?*' \) -prune -o -name '*.md' -print | sed 's|^\./||' | sort)
}

# Lines "H page slug" for headings and "L page line target file anchor" for links ("-" for none); code is skipped.
# Slugs are GitHub's: lower case, no punctuation, hyphens for blanks, "-1" for the second of a kind.
scan() {
  (cd "$1" && xargs awk '
    function plain(path,    parts, n, i, k, kept) {  # without "." and ".."
      n = split(path, parts, "/"); k = 0
      for (i = 1; i <= n; i++) if (parts[i] == "..") k--; else if (parts[i] != "." && parts[i] != "") kept[++k] = parts[i]
      path = kept[1]; for (i = 2; i <= k; i++) path = path "/" kept[i]
      return path
    }
    function report(target,    path, anchor, folder) {
      if (target ~ /^mailto:|:\/\//) return
      path = target; sub(/#.*/, "", path); anchor = target ~ /#/ ? substr(target, index(target, "#") + 1) : "-"
      folder = FILENAME; if (!sub(/[^\/]*$/, "", folder)) folder = ""
      print "L", FILENAME, FNR, target, (path == "" ? FILENAME : plain(folder path)), anchor
    }
    FNR == 1 { fenced = 0 }
    /^ *```/ { fenced = !fenced; next }
    fenced { next }
    /^#+ / {
      slug = tolower($0); sub(/^#+ +/, "", slug)
      while (match(slug, /\]\([^)]*\)/)) slug = substr(slug, 1, RSTART) substr(slug, RSTART + RLENGTH)
      gsub(/[^-a-z0-9_ ]/, "", slug); gsub(/ /, "-", slug)
      n = seen[FILENAME, slug]++
      print "H", FILENAME, (n ? slug "-" n : slug)
    }
    {
      text = $0; gsub(/`[^`]*`/, "", text)
      while (match(text, /\]\([^)]*\)/)) {
        report(substr(text, RSTART + 2, RLENGTH - 3))
        text = substr(text, RSTART + RLENGTH)
      }
    }' /dev/null)
}

# broken FOLDER: a line for each link that leads nowhere.
broken() {
  pages "$1" | scan "$1" >"$work/found"
  grep '^H ' "$work/found" >"$work/headings" || true
  grep '^L ' "$work/found" | while read -r _ page line target path anchor; do
    [ -e "$1/$path" ] || { echo "$page:$line: $target: no such file"; continue; }
    [ "$anchor" = - ] || grep -q -x -F "H $path $anchor" "$work/headings" || echo "$page:$line: $target: no such heading"
  done
}

check_itself() {
  mkdir -p "$work/pages/sub"
  printf '# One `two`, three\n## Same\n## Same\n[a](sub/b.md#its-head) [b](#one-two-three) [c](#same-1) `[d](nowhere.md)`\n' >"$work/pages/a.md"
  printf '# Its head\n[up](../a.md) [gone](../c.md) [no head](../a.md#two)\n```\n[code](nowhere.md)\n```\n' >"$work/pages/sub/b.md"
  printf 'sub/b.md:2: ../c.md: no such file\nsub/b.md:2: ../a.md#two: no such heading\n' >"$work/expected"
  broken "$work/pages" >"$work/result"
  diff "$work/expected" "$work/result"
}

if [ "${1:-}" = --check ]; then check_itself; exit; fi
broken "${1:-$here}" >"$work/list"
cat "$work/list"
if [ -s "$work/list" ]; then exit 1; fi
echo "$(grep -c '^L ' "$work/found") links of $(pages "${1:-$here}" | wc -l) pages are valid"
