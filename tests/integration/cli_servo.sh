#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The closed loop with a fixed latency, hence reproducible: its final pose against ground truth. The bounds are the documented ones:
# 5 mm and 0.5 degree at half a metre from the desk; 1 px.
. "$(dirname "$0")/cli_common.sh"
[ -x "$(dirname "$edgevo")/edgevo-servo" ] || skip "edgevo servo: this build has no ViSP"
value() { sed -n "s/^  $2: *//p" "$1/summary.yaml" | head -n 1; }

complains "'pid' not in\|--law" "$edgevo" servo -o out --law pid
complains "out is required" "$edgevo" servo
complains "latency.*seconds from 0 to 2" "$edgevo" servo -o out --latency soon
complains "latency.*seconds from 0 to 2" "$edgevo" servo -o out --latency -1
complains "scale-error.*number from 0.05 to 20" "$edgevo" servo -o out --scale-error 0
complains "blackout.*number from 0 to 60" "$edgevo" servo -o out --blackout=-1
complains "--light mixt: is not a kind of lighting change.*did you mean mixed" "$edgevo" servo -o out --light mixt
complains "points.*whole number" "$edgevo" servo -o out --points 2
complains "unknown parameter" "$edgevo" servo -o out --set edges.nonsense=1
complains "unknown option --gian; did you mean --gain" "$edgevo" servo -o out --gian=1
check "folders left by commands that cannot run" "$(ls -d out 2>/dev/null | wc -l)" -eq 0
run_code 0 "$edgevo" servo --help
check "help of edgevo servo" "$(grep -c -- '--blackout' stdout)" -ge 1

# At 10 images a second, half of the default, and with a larger gain, to save time.
run_code 0 "$edgevo" servo -o dark --quiet --latency 0.06 --rate 10 --gain 1.6 --law pbvs --light mixed --blackout 1
check "stopped by the blackout" "$(value dark stops)" -ge 1
below "stopped, seconds" 0.7 "$(value dark stopped_s)"
below "PBVS with light changes and blackout, mm" "$(value dark final_mm)" 5
below "PBVS with light changes and blackout, degrees" "$(value dark final_deg)" 0.5
check "rows without a command while it is dark" "$(grep -c 'LOST' dark/servo.csv)" -ge 5
for file in servo.csv start.png taught.png final.png convergence.svg report.html; do
  check "bytes of $file" "$(wc -c <dark/$file)" -gt 1000
done

run_code 0 "$edgevo" servo -o ibvs --quiet --latency 0.06 --rate 10 --gain 1.6 --law ibvs --scale-error 2
below "IBVS with twice the scale, px" "$(value ibvs final_px)" 1
below "IBVS with twice the scale, mm" "$(value ibvs final_mm)" 5
check "never stopped" "$(value ibvs stops)" -eq 0

# Started anew, the goal is reached by the map that the loop before has kept; after darkness in which the camera was carried away, too.
kept=$(cat dark/map.db dark/goal.txt | cksum)
run_code 0 "$edgevo" servo -o again --quiet --latency 0.06 --rate 10 --gain 1.6 --map dark --blackout 5 --carried --limit 40
below "started anew, mm" "$(value again final_mm)" 5
below "started anew, degrees" "$(value again final_deg)" 0.5
check "stopped in the darkness" "$(value again stops)" -ge 2
below "the start is elsewhere, mm" 200 "$(value again start_mm)"
[ "$(cat dark/map.db dark/goal.txt | cksum)" = "$kept" ] && ok "the map is as it was" || fail "the map changed"
[ ! -e again/goal.txt ] && ok "no goal that was not taught" || fail "goal.txt of a loop without teaching"
complains "goal.txt: cannot be opened" "$edgevo" servo -o refused --map "$scenes"
mkdir untaught && echo "# nothing" >untaught/goal.txt
complains "goal.txt: holds no taught pose" "$edgevo" servo -o refused --map untaught
complains "omit --law or --map" "$edgevo" servo -o refused --map dark --law ibvs
complains "another -o" "$edgevo" servo -o dark --map dark
complains "give --map" "$edgevo" servo -o refused --blackout 5 --carried
check "folders left by commands that cannot run" "$(ls -d refused 2>/dev/null | wc -l)" -eq 0
finish
