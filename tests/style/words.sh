#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Keeps home-made terms out of the project: tests/style/words.txt lists each with the term to use instead.
#
#   tests/style/words.sh           checks sources, tests and pages; lists what it finds, exit code 1
#   tests/style/words.sh FILE...   checks these files only
#   tests/style/words.sh --check   tests the check itself on planted words
set -eu
here=$(cd "$(dirname "$0")/../.." && pwd)
list=$here/tests/style/words.txt
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The files to check. The changelog is exempt: it describes the past.
files() {
  (cd "$here" && find README.md CONTRIBUTING.md CMakeLists.txt app modules tests params datasets share -type f \
    \( -name '*.h' -o -name '*.cpp' -o -name '*.md' -o -name '*.sh' -o -name '*.py' -o -name '*.cmake' -o -name '*.txt' \
    -o -name '*.yaml' -o -name '*.js' -o -name '*.html' \) \
    ! -path 'tests/style/words.*' | sort)
}

# find_words FILE...: a line `FILE:LINE: "word": use TERM` for each. Words inside identifiers count, too: a line is searched as it is, and
# with its identifiers split (is_asked, CornerWitness).
find_words() {
  grep -v '^#' "$list" | perl -e '
    my @banned;
    while (<STDIN>) { chomp; my ($word, $term) = split /\t/; push @banned, [qr/(?<![A-Za-z0-9_])(?:$word)(?![A-Za-z0-9_])/i, $term] if $term; }
    for my $path (@ARGV) {
      open(my $file, "<", $path) or die "words.sh: $path: cannot be read\n";
      while (my $line = <$file>) {
        my $split = $line;
        # Keys of files keep their names, and so do the pages of the lab.
        $split =~ s/["`][a-z0-9_]+["`]|\d{4}-\d\d-\d\d_\w+//g;
        $split =~ s/(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Za-z0-9])_+(?=[A-Za-z0-9])/ /g;
        for my $b (@banned) {
          print "$path:$.: \"$&\": use $b->[1]\n" if $line =~ $b->[0] || ($split ne $line && $split =~ $b->[0]);
        }
      }
    }' "$@"
}

check_itself() {
  printf 'The point is lent.\nA silent talent.\nUsualStep usual;\nbool is_lent;\n' >"$work/planted.txt"
  cat >"$work/expected" <<END
$work/planted.txt:1: "lent": use tentative point
$work/planted.txt:3: "UsualStep": use median-motion prior
$work/planted.txt:4: "lent": use tentative point
END
  find_words "$work/planted.txt" >"$work/found"
  diff "$work/expected" "$work/found"
}

if [ "${1:-}" = --check ]; then check_itself; exit; fi
cd "$here"
if [ $# -gt 0 ]; then find_words "$@" >"$work/found"; else files | xargs tests/style/words.sh >"$work/found" || true; fi
cat "$work/found"
if [ -s "$work/found" ]; then exit 1; fi
