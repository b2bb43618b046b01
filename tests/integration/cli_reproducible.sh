#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The same input gives the same bytes: twice, through a rawlog, and for a part of the frames with the source's own numbers.
. "$(dirname "$0")/cli_common.sh"
sequence=$scenes/desk
frames=$(wc -l <"$sequence/times.txt")

run_code 0 "$edgevo" run "$sequence" -o one --quiet --seed 3
run_code 0 "$edgevo" run "$sequence" -o two --quiet --seed 3
cp -r "$scenes/runs/desk" other  # the default seed
for run in one two other; do untimed $run; done
same "trajectory, same seed" one/trajectory_tum.txt two/trajectory_tum.txt
same "live trajectory, same seed" one/trajectory_live_tum.txt two/trajectory_live_tum.txt
same "frames.csv without times, same seed" one/frames_untimed.csv two/frames_untimed.csv
same "points, same seed" one/edges.ply two/edges.ply
differ "trajectory, another seed" one/trajectory_tum.txt other/trajectory_tum.txt
differ "frames.csv without times, another seed" one/frames_untimed.csv other/frames_untimed.csv

run_code 0 "$edgevo" import "$sequence" rawlog/seq.rawlog
check "external images of the rawlog" "$(ls rawlog/seq_Images | wc -l)" -eq "$frames"
run_code 0 "$edgevo" info rawlog/seq.rawlog --check
check "frames that info finds" "$(grep -c "^frames  *$frames" stdout)" -eq 1
run_code 0 "$edgevo" run rawlog/seq.rawlog -o from_rawlog --quiet --seed 3
untimed from_rawlog
same "trajectory through a rawlog" one/trajectory_tum.txt from_rawlog/trajectory_tum.txt
same "frames.csv without times through a rawlog" one/frames_untimed.csv from_rawlog/frames_untimed.csv

# Parts of the source keep its numbers and times.
numbers() { awk -F, 'NR > 1 { print $1 }' "$1/frames.csv"; }
run_code 0 "$edgevo" run "$sequence" -o part --quiet --frames 10:40
numbers part >numbers
seq 10 39 | cmp -s - numbers && ok "--frames keeps the numbers" || fail "--frames: $(tr '\n' ' ' <numbers)"
check "poses with --frames" "$(poses part)" -ge 25
run_code 0 "$edgevo" run "$sequence" -o third --quiet --every 3
numbers third >numbers
seq 0 3 $((frames - 1)) | cmp -s - numbers && ok "--every keeps the numbers" || fail "--every: $(tr '\n' ' ' <numbers)"
check "poses with --every 3" "$(poses third)" -ge 16
below "ATE in metres with --every 3 (path 0.5 m)" "$(ate third "$sequence")" 0.02
awk -F, 'NR > 1 { printf "%.4f\n", $2 }' third/frames.csv >times
awk 'NR % 3 == 1 { printf "%.4f\n", $1 }' "$sequence/times.txt" | cmp -s - times && ok "--every keeps the times" || fail "times with --every"
finish
