#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Generates manual pages and bash completion from --help:
#   share/packages/manuals.sh EDGEVO OUT      writes OUT/man1/edgevo*.1.gz and OUT/completions/edgevo
# Needs help2man. Sub-commands are those that EDGEVO lists; a build without ViSP has no page for `servo`.
set -eu
export LC_ALL=C
edgevo=$1 out=$2
here=$(cd "$(dirname "$0")" && pwd)
version=$("$edgevo" --version | sed -n '1s/^edgevo //p')

help_of() { "$edgevo" "$@" --help; }
# Below "Subcommands:", two spaces, a name.
commands=$(help_of | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\{1,\}\) .*/\1/p')
pages=$(for name in $commands; do [ "$name" = help ] || ! help_of "$name" >/dev/null 2>&1 || echo "$name"; done)

# page NAME SUMMARY [COMMAND]: COMMAND is empty for the program itself.
page() {
  help2man --no-info --section 1 --manual "User Commands" --source "edgevo $version" --version-string "$version" \
    --name "$2" --include "$here/edgevo.h2m" "$edgevo${3:+ $3}" |
    sed "s/^\.TH [^ ]*/.TH $(echo "$1" | tr '[:lower:]' '[:upper:]')/; s/^edgevo [a-z]* \\\\-/$1 \\\\-/" | gzip -9n >"$out/man1/$1.1.gz"
}

options_of() { help_of "$@" | sed -n 's/^  \(-[^ ]*\).*/\1/p' | tr , '\n' | grep '^--' | tr '\n' ' '; }

completion() {
  cat <<END
# bash completion of edgevo $version, generated from its --help
_edgevo() {
  local word=\${COMP_WORDS[COMP_CWORD]} commands="$(echo $commands)" options=
  COMPREPLY=()
  if [ "\$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=(\$(compgen -W "\$commands --help --version" -- "\$word"))
    return
  fi
  case \${COMP_WORDS[1]} in
    help) COMPREPLY=(\$(compgen -W "\$commands" -- "\$word")) ;;
END
  for name in $pages; do echo "    $name) options=\"$(options_of "$name")\" ;;"; done
  cat <<'END'
  esac
  case $word in
    -*) COMPREPLY=($(compgen -W "$options" -- "$word")) ;;
  esac
}
complete -o default -F _edgevo edgevo
END
}

rm -rf "$out"
mkdir -p "$out/man1" "$out/completions"
page edgevo "monocular edge visual odometry"
for name in $pages; do page "edgevo-$name" "$(help_of "$name" | head -1)" "$name"; done
completion >"$out/completions/edgevo"
