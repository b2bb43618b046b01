#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tracking and mapping in two threads: every frame has a row, the great majority a pose, the trajectory is accurate, and latencies and
# late or dropped frames are reported.
. "$(dirname "$0")/cli_common.sh"

# realtime OUT KEY: a number of `realtime:` in summary.yaml.
realtime() { sed -n "/^realtime:/,/^[a-z]/s/^ *$2: //p" "$1/summary.yaml"; }
# keeps_up OUT FRAMES: sums and percentiles are there and agree with frames.csv.
keeps_up() {
  check "mode in summary.yaml" "$(grep -c 'mode: "realtime' "$1/summary.yaml")" -eq 1
  # A machine that is too slow for a pace drops frames rather than fall behind.
  delivered=$(realtime "$1" handed.over)
  check "frames delivered or dropped" $((delivered + $(realtime "$1" dropped))) -eq "$2"
  check "frames delivered late" "$(realtime "$1" late)" -le "$2"
  # The largest latency in the column is the reported one, and the percentiles are in order.
  largest=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "latency_ms") c = i } NR > 1 { n += $c != ""; if ($c + 0 > m) m = $c + 0 }
    END { printf "%d %.3f", n, m }' "$1/frames.csv")
  [ "$largest" = "$delivered $(realtime "$1" max)" ] && ok "latencies in frames.csv: $largest" || fail "latencies: $largest, reported: $(realtime "$1" max)"
  figures="$(realtime "$1" p50) $(realtime "$1" p95) $(realtime "$1" p99) $(realtime "$1" max)"
  echo "0 $figures" | awk '{ exit !(NF == 5 && $1 < $2 && $2 <= $3 && $3 <= $4 && $4 <= $5) }' && ok "percentiles $figures" || fail "percentiles: $figures"
}

for name in street desk; do
  sequence=$scenes/$name
  frames=$(wc -l <"$sequence/times.txt")
  pace=
  [ $name = street ] || pace='--pace 10'
  run_code 0 "$edgevo" run "$sequence" -o $name --realtime $pace --quiet
  check "rows of frames.csv" "$(rows $name)" -eq "$frames"
  check "poses" "$(poses $name)" -ge $((frames * 8 / 10))
  keeps_up $name "$frames"
done
below "ATE in metres on the street (path 45 m)" "$(ate street "$scenes/street")" 0.5
below "ATE in metres at the desk (path 0.5 m)" "$(ate desk "$scenes/desk")" 0.03
check "street without a pace" "$(grep -c 'pace: "none' street/summary.yaml)" -eq 1
check "pace of the desk" "$(grep -c 'pace: "10 frames a second"' desk/summary.yaml)" -eq 1
below "frames per second at the desk: not above its pace" "$(realtime desk frames_per_second)" 11

# By its own times, half as fast: reported at the end of the run.
run_code 0 "$edgevo" run "$scenes/desk" -o own --realtime --pace 0.5x --frames 0:20
check "the final lines report the latencies" "$(grep -c "pace the source's own times.*; reached .* frames delivered late, [0-9]* dropped" stdout)" -eq 1
check "frames without a pace dropped" "$(realtime street dropped)" -eq 0
complains 'requires --realtime' "$edgevo" run "$scenes/desk" -o out --pace 30
complains "pace 'fast': is not a pace" "$edgevo" run "$scenes/desk" -o out --realtime --pace fast
finish
