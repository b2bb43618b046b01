#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Ctrl-C in the middle of a run: it ends within seconds, with all results so far, summary.yaml saying so, and exit code 0.
. "$(dirname "$0")/cli_common.sh"

# A long sequence made of a short one, forward and backward, so that the run cannot end before the signal.
copy_sequence "$scenes/desk" long
frames=$(ls "$scenes/desk/images" | wc -l)
i=$frames
for pass in $(seq 10); do
  for j in $(if [ $((pass % 2)) -eq 1 ]; then seq $((frames - 1)) -1 0; else seq 0 $((frames - 1)); fi); do
    ln -s "$scenes/desk/images/$(printf %06d "$j").png" "long/images/$(printf %06d $i).png"
    i=$((i + 1))
  done
done
awk -v n=$i 'BEGIN { for (i = 0; i < n; ++i) printf "%.6f\n", i / 30 }' >long/times.txt

has_frames() { [ "$(ls "$1/playback_Images" 2>/dev/null | wc -l)" -ge 25 ]; }
for mode in synchronous realtime; do
  option=
  [ $mode = synchronous ] || option=--realtime
  "$edgevo" run long -o $mode $option >stdout 2>stderr &
  pid=$!
  # Waits for some frames, on a machine of any speed: an image of the playback is written (or linked) for each.
  eventually has_frames $mode
  begin=$(date +%s)
  kill -INT $pid
  code=0
  wait $pid || code=$?
  check "exit code after Ctrl-C, $mode" $code -eq 0
  check "seconds that it took to end" $(($(date +%s) - begin)) -le 20
  check "errors" "$(grep -c '^edgevo:' stderr)" -eq 0
  done=$(rows $mode)
  check "the line about it" "$(grep -c "^interrupted after $done frames" stdout)" -eq 1
  check "frames processed" "$done" -ge 25
  check "frames not processed" $((i - done)) -gt 0
  results_kept $mode "$done"
done
finish
