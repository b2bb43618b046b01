#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# run.mcap of real runs, by a strict reader (tests/unit/mcap_output/strict_mcap.py): complete, with the poses of the records; of a killed
# run; finished; with images; in real time; and none at all.
. "$(dirname "$0")/cli_common.sh"
sequence=$scenes/street whole=$scenes/runs/street
strict() { /usr/bin/python3 "$here/../unit/mcap_output/strict_mcap.py" "$@"; }
count_of() { strict check "$1" | awk -v t="$2" '$2 == t { n = $1 } END { print n + 0 }'; }

run_code 0 strict check "$whole/run.mcap"
run_code 0 strict cut "$whole/run.mcap" 100
check "poses" "$(count_of "$whole/run.mcap" /edgevo/pose)" -eq "$(grep -c '^[0-9]' "$whole/trajectory_live_tum.txt")"
for topic in /tf /tf_static /edgevo/odometry /edgevo/pose_with_covariance /edgevo/path /edgevo/points /edgevo/edges /edgevo/edge_points /map \
  /rosout /edgevo/is_metric /edgevo/map_changes; do
  check "messages on $topic" "$(count_of "$whole/run.mcap" $topic)" -ge 1
done
check "images" "$(count_of "$whole/run.mcap" /edgevo/camera/image/compressed)" -eq 0

# Times and positions, in the order of time, of run.mcap and of the records: a camera that looks straight ahead.
same_poses() {
  strict table "$1/run.mcap" /edgevo/pose header.stamp.sec header.stamp.nanosec pose.position.x pose.position.y pose.position.z |
    awk '{ printf "%d.%07d %.6f %.6f %.6f\n", $1, $2 / 100, $3 + 1e-9, $4 + 1e-9, $5 + 1e-9 }' | sort -n >written.txt
  awk '/^[0-9]/ { printf "%s %.6f %.6f %.6f\n", $1, $4 + 1e-9, -$2 + 1e-9, -$3 + 1e-9 }' "$1/trajectory_live_tum.txt" | sort -n >records.txt
  worst=$(paste -d ' ' written.txt records.txt | awk '
    function off(a, b) { return a > b ? a - b : b - a }
    $1 != $5 { print 1; exit }
    { for (i = 2; i <= 4; ++i) if (off($i, $(i + 4)) > w) w = off($i, $(i + 4)) }
    END { print w + 0 }')
  below "largest distance from the live poses of $(basename "$1")" "$worst" 3e-6
}
same_poses "$whole"

run_code 0 "$edgevo" run "$sequence" -o images --quiet --frames 0:40 --mcap images
check "images" "$(count_of images/run.mcap /edgevo/camera/image/compressed)" -ge 2
check "cameras, one each" "$(count_of images/run.mcap /edgevo/camera/camera_info)" -eq "$(count_of images/run.mcap /edgevo/camera/image/compressed)"
run_code 0 "$edgevo" run "$sequence" -o again --quiet --frames 0:40 --mcap images
same "run.mcap of the same run with images" images/run.mcap again/run.mcap
run_code 0 "$edgevo" run "$sequence" -o off --quiet --frames 0:40 --mcap off
[ ! -e off/run.mcap ] && ok "no file" || fail "run.mcap in spite of --mcap off"
same "the trajectory with and without" off/trajectory_tum.txt images/trajectory_tum.txt
complains "neither images nor poses nor off" "$edgevo" run "$sequence" -o wrong --mcap all
run_code 0 "$edgevo" run "$sequence" -o realtime --quiet --realtime --frames 0:40
run_code 0 strict check realtime/run.mcap
run_code 0 "$edgevo" run "$sequence" -o metres --quiet --scale factor=2 --frames 0:40
check "metres" "$(strict table metres/run.mcap /edgevo/is_metric data | grep -c True)" -eq 1
same_poses metres

# Killed in its middle: what has ended of the file is whole; finished it is complete.
"$edgevo" run "$sequence" -o killed --quiet >/dev/null 2>&1 &
pid=$!
has_chunks() { [ "$(stat -c %s killed/run.mcap 2>/dev/null || echo 0)" -gt 1000 ] && [ "$(rows killed)" -gt 30 ]; }
eventually has_chunks
kill -KILL $pid
wait $pid 2>/dev/null
run_code 0 strict begun killed/run.mcap
check "chunks of the killed run" "$(cut -d ' ' -f 1 stdout)" -ge 1
run_code 0 "$edgevo" finish killed
run_code 0 strict check killed/run.mcap
same_poses killed
finish
