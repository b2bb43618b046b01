#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# tutorials.sh FOLDER [NAME...]: follows the tutorials of share/doc/tutorials literally, each in FOLDER/NAME: writes the files that they
# show and runs their blocks marked `sh` in order. edgevo must be in the PATH; PREFIX is where it is installed (for
# embedding and servo_loop). Not part of the tests: it takes a quarter of an hour.
# Exit codes: 0 all succeeded; 1 a command failed (named on stderr); 2 bad usage.
set -eu
[ $# -ge 1 ] || { echo "usage: tutorials.sh FOLDER [NAME...]" >&2; exit 2; }
source=$(cd "$(dirname "$0")/.." && pwd)
EDGEVO_SHARE=${EDGEVO_SHARE:-$source/share}
export EDGEVO_SHARE
mkdir -p "$1"
folder=$(cd "$1" && pwd)
shift
[ $# -gt 0 ] || set -- own_camera rawlog planner servo_loop embedding

# Blocks of a page: `sh` to commands.sh; what follows a line "`FILE`:" (or ends in it) to FILE.
extract() {
  awk '/^```/ && !inside { inside = 1; to = $0 == "```sh" ? "commands.sh" : $0 ~ /^```(cpp|cmake)$/ ? file : ""; next }
       /^```/ { inside = 0; file = ""; next }
       inside { if (to != "") print >>to; next }
       /`[A-Za-z_.]+`:$/ { file = $0; sub(/`:$/, "", file); sub(/.*`/, "", file) }' "$1"
}

for name; do
  rm -rf "${folder:?}/$name"
  mkdir "$folder/$name"
  cd "$folder/$name"
  extract "$source/share/doc/tutorials/$name.md"
  sh -eu -x commands.sh >log.txt 2>&1 || { echo "tutorials.sh: $name: failed at: $(tail -n 3 log.txt)" >&2; exit 1; }
  echo "$name: ok"
done
