#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Checks whether a change altered results: compares two runs (output folders of `edgevo run`), or two folders with runs of the same names.
#
#   tests/same_bytes.sh BEFORE AFTER
#
# Trajectories, points, lines and octrees must be identical bytes, frames.csv identical except for its times. Both runs must be synchronous
# (without --realtime), with the same seed, on the same machine. Exit codes: 0 identical; 1 different, with a list; 2 nothing to
# compare.
set -eu
[ $# -eq 2 ] || { echo "usage: tests/same_bytes.sh BEFORE AFTER" >&2; exit 2; }
for folder in "$1" "$2"; do [ -d "$folder" ] || { echo "same_bytes.sh: $folder: no such folder" >&2; exit 2; }; done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The columns of times come last.
untimed() { cut -d, -f1-10 "$1"; }

# differences BEFORE AFTER: a line for each file of a run that differs.
differences() {
  for file in trajectory_tum.txt trajectory_kitti.txt trajectory_live_tum.txt trajectory_vehicle_tum.txt scale.csv edges.ply \
    edge_segments.csv edges.bt edges.ot edges_color.ot; do
    [ -e "$1/$file" ] || [ -e "$2/$file" ] || continue
    cmp -s "$1/$file" "$2/$file" || echo "$2/$file differs"
  done
  untimed "$1/frames.csv" >"$work/before"
  untimed "$2/frames.csv" >"$work/after"
  cmp -s "$work/before" "$work/after" || echo "$2/frames.csv differs, times ignored"
}

runs() { (cd "$1" && find . -name frames.csv | sed 's|/frames.csv$||; s|^\./||' | sort); }

runs "$1" >"$work/runs"
runs "$2" >"$work/other_runs"
[ -s "$work/runs" ] || { echo "same_bytes.sh: no run in $1: a run holds a frames.csv" >&2; exit 2; }
diff "$work/runs" "$work/other_runs" >"$work/missing" || { echo "not in both folders:"; grep '^[<>]' "$work/missing"; exit 1; }
while read -r run; do differences "$1/$run" "$2/$run"; done <"$work/runs" >"$work/found"
cat "$work/found"
if [ -s "$work/found" ]; then exit 1; fi
echo "$(wc -l <"$work/runs") runs are the same"
