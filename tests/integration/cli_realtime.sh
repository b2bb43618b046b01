#!/bin/sh
# Tracking and mapping in two threads: every frame has a row, the great majority a pose, and the trajectory is right.
. "$(dirname "$0")/cli_common.sh"
for name in street desk; do
  sequence=$scenes/$name
  frames=$(wc -l <"$sequence/times.txt")
  run_code 0 "$edgevo" run "$sequence" -o $name --realtime --quiet
  check "rows of frames.csv" "$(rows $name)" -eq "$frames"
  check "poses" "$(poses $name)" -ge $((frames * 8 / 10))
  check "mode in summary.yaml" "$(grep -c 'mode: "realtime' $name/summary.yaml)" -eq 1
done
below "ATE in metres on the street (path 45 m)" "$(ate street "$scenes/street")" 0.5
below "ATE in metres at the desk (path 0.5 m)" "$(ate desk "$scenes/desk")" 0.03
finish
