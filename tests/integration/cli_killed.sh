#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# kill -9 in the middle of a run: the recovery log is on disk, `edgevo finish` writes all files from it, the stock tools open them, and
# no other run overwrites it meanwhile.
. "$(dirname "$0")/cli_common.sh"
sequence=$scenes/street whole=$scenes/runs/street

# A long sequence that starts as the short one, played forward and backward, so that the run cannot end before the signal.
copy_sequence "$sequence" long
n=$(ls "$sequence/images" | wc -l)
last=$(tail -n 1 "$sequence/times.txt")
i=$n
for pass in 1 2 3 4 5 6; do
  for j in $(if [ $((pass % 2)) -eq 1 ]; then seq $((n - 1)) -1 0; else seq 0 $((n - 1)); fi); do
    ln -s "$sequence/images/$(printf %06d "$j").png" "long/images/$(printf %06d $i).png"
    i=$((i + 1))
  done
done
awk -v t="$last" -v n=$((i - n)) 'BEGIN { for (k = 1; k <= n; ++k) printf "%.6f\n", t + k / 30 }' >>long/times.txt

has_rows() { [ "$(cat "$out/frames.csv" 2>/dev/null | wc -l)" -gt "$wanted" ]; }
# killed OUT ROWS [OPTION...]: starts a run and kills it once it has that many rows.
killed() {
  out=$1 wanted=$2
  shift 2
  "$edgevo" run long -o "$out" --quiet "$@" >/dev/null 2>&1 &
  pid=$!
  eventually has_rows
  kill -KILL $pid
  wait $pid 2>/dev/null
}

# count_if_other OUT: the trajectory of a finished run without loops is that of a run that ended there. A kill between the writes of the
# events and of the window, a few thousandths of the time, costs the window: one may differ.
others=0
count_if_other() {
  rm -rf ended
  run_code 0 "$edgevo" run long -o ended --quiet --loops off --frames 0:"$(rows "$1")"
  cmp "$1/trajectory_tum.txt" ended/trajectory_tum.txt || others=$((others + 1))
}

killed cut 45
streamed=$(rows cut)
check "rows of frames.csv while it ran" "$streamed" -ge 45
check "poses while it ran" "$(grep -c '^[0-9]' cut/trajectory_live_tum.txt)" -ge 30
complains "cut: the run in it was interrupted .*; .edgevo finish cut. writes them; --force starts over" "$edgevo" run long -o cut --quiet
check "rows after that" "$(rows cut)" -eq "$streamed"

run_code 0 "$edgevo" finish cut
check "the line on stdout with the counts" "$(grep -c "^$streamed frames, .* with a pose" stdout)" -eq 1
results_kept cut "$streamed"
check "summary.yaml says how it ended" "$(grep -c "cut.off: .*after $streamed frames" cut/summary.yaml)" -eq 1
[ -s cut/report.html ] && ok "report" || fail "no report"
check "unfinished files" "$(ls cut | grep -c unfinished)" -eq 0
count_if_other cut
# Up to that point it equals the run that was not killed.
common=$(awk -v n="$streamed" -v m="$n" 'BEGIN { print (n < m ? n : m) }')
until=$(sed -n "${common}p" long/times.txt)
for run in cut "$whole"; do awk -v t="$until" '/^[0-9]/ && $1 <= t + 1e-6' "$run/trajectory_live_tum.txt" >"poses_$(basename "$run").txt"; done
same "live poses of the first $common frames" poses_cut.txt poses_street.txt
made=$(awk -F, -v n="$streamed" 'NR > 1 && $1 < n && $5 == 1' "$whole/frames.csv" | wc -l)
check "keyframes of the map, of $made that were made in the first $n frames" \
  "$(sed -n '/^trajectory:/,/^[a-z]/s/^  keyframes: //p' cut/summary.yaml)" -ge "$made"
below "ATE in metres (path 45 m there and back)" "$(ate cut "$sequence")" 0.3
if "$here/stock_tools.sh" cut >stock.log 2>&1; then ok "stock tools: $(grep -c '^ok' stock.log) checks"; else
  cat stock.log
  fail "stock tools"
fi
complains "cut: holds no interrupted run" "$edgevo" finish cut
run_code 0 "$edgevo" run "$sequence" -o cut --quiet --frames 0:15
check "rows of the next run" "$(rows cut)" -eq 15

# Killed at random moments: no keyframe that is named in the rows (column 10) is missing in the map (column 5).
moment=$(od -An -N2 -tu2 /dev/urandom)
for kill in $(seq "${EDGEVO_TEST_KILLS:-3}"); do
  moment=$(((moment * 75 + 74) % 65537))
  killed "random$kill" $((12 + moment % 100)) --loops off
  run_code 0 "$edgevo" finish "random$kill"
  check "rows of a run that was killed" "$(rows "random$kill")" -ge 12
  check "keyframes in the map" "$(awk -F, 'NR > 1 && $5 == 1' "random$kill/frames.csv" | wc -l)" -ge 5
  check "keyframes that are missing in it" \
    "$(awk -F, 'NR > 1 && $10 != "" && $10 != "return" && $5 == 0' "random$kill/frames.csv" | wc -l)" -le 1
  check "points of its map" "$(sed -n '/^element vertex/s/.* //p' "random$kill/edges.ply" 2>/dev/null | head -n 1)" -gt 500
  count_if_other "random$kill"
  [ -z "${EDGEVO_TEST_KILLS:-}" ] || "$here/stock_tools.sh" "random$kill" >stock.log 2>&1 || fail "stock tools: $(grep -m 1 FAIL stock.log)"
  rm -rf "random$kill"
done
check "trajectories of these that differ from that of a run that ended there" "$others" -le 1

# With loops: the places that were recognised before the kill hold. Those of the keyframes in the window are recognised by no one: a run
# that ends there recognises them, and its trajectory is another.
killed loops 150
run_code 0 "$edgevo" finish loops
made=$(awk -F, 'NR > 1 && $5 == 1' loops/frames.csv | wc -l)
check "keyframes of map.db, of $made" "$("$edgevo" info loops/map.db | sed -n 's/^keyframes *\([0-9]*\) .*/\1/p')" -ge $((made - 1))
check "links of the map to its own past" "$(grep -c '^place,' loops/graph.csv)" -ge 5
below "ATE in metres of the way there" "$(ate loops "$sequence")" 0.3

# In two threads, with a scale; started over with --force.
killed threads 30 --realtime --scale factor=2
run_code 0 "$edgevo" finish threads
check "metres" "$(sed -n '/^scale:/,/^[a-z]/s/^  metric: //p' threads/summary.yaml | grep -c true)" -eq 1
killed again 20
run_code 0 "$edgevo" run "$sequence" -o again --quiet --frames 0:15 --force
check "rows of a run started over" "$(rows again)" -eq 15
check "files left of the earlier run" "$(ls -d again/unfinished_run.bin again/earlier_run 2>/dev/null | wc -l)" -eq 0

# While a run is in progress, nothing else finishes it or writes to its folder.
"$edgevo" run long -o busy --quiet >/dev/null 2>&1 &
pid=$!
eventually [ -s busy/unfinished_run.bin ]
complains "busy: its run is still in progress" "$edgevo" finish busy
complains "busy: another run is writing there" "$edgevo" run "$sequence" -o busy --quiet --force
kill -INT $pid
wait $pid
check "exit code of that run" $? -eq 0
finish
