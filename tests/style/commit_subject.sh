#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Checks that the subject of a commit message has the form "area: imperative subject", at most 72 characters, and is followed by an empty
# line.
#
#   tests/style/commit_subject.sh FILE      the message, as git passes it to a commit-msg script
#   tests/style/commit_subject.sh --check   tests the check itself
#
# Messages that git writes itself (merges, reverts, fixup! and squash!) pass. Exit codes: 0 valid; 1 not valid, with the reason.
set -eu

complain() {
  echo "commit message: $1" >&2
  echo "  wanted: \"area: imperative subject\", at most 72 characters; then an empty line and the reason (CONTRIBUTING.md)" >&2
  return 1
}

# check_message FILE
check_message() {
  subject=$(grep -v '^#' "$1" | sed -n 1p)
  second=$(grep -v '^#' "$1" | sed -n 2p)
  length=$(printf '%s' "$subject" | LC_ALL=C.UTF-8 wc -m)
  case "$subject" in "Merge "* | "Revert \""* | "fixup! "* | "squash! "*) return 0 ;; esac
  printf '%s\n' "$subject" | grep -q -E '^[a-z][a-z0-9_]*(, [a-z][a-z0-9_]*)*: [^ ]' || { complain "\"$subject\" names no area"; return 1; }
  [ "$length" -le 72 ] || { complain "the subject has $length characters"; return 1; }
  case "$subject" in *.) complain "the subject ends with a full stop"; return 1 ;; esac
  [ -z "$second" ] || { complain "the second line is not empty"; return 1; }
}

check_itself() {
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  long=$(printf 'mapping: %064d' 0)
  for good in 'mapping: drop a point that no keyframe matches' 'edges, alignment: name the level' 'Revert "doc: x"' "${long%0}"; do
    printf '%s\n\nWhy.\n' "$good" >"$work/message"
    check_message "$work/message" || { echo "FAILED: refused: $good"; exit 1; }
  done
  for bad in 'Rules: words' 'mapping:drop' 'no area' 'doc: say so.' "$long"; do
    printf '%s\n' "$bad" >"$work/message"
    check_message "$work/message" 2>"$work/complaint" && { echo "FAILED: accepted: $bad"; exit 1; }
  done
  printf 'doc: say so\nand more\n' >"$work/message"
  check_message "$work/message" 2>"$work/complaint" && { echo "FAILED: accepted: no empty line"; exit 1; }
  echo "good subjects pass, bad ones do not"
}

case "${1:-}" in
  --check) check_itself ;;
  "") echo "usage: tests/style/commit_subject.sh FILE" >&2; exit 2 ;;
  *) check_message "$1" ;;
esac
