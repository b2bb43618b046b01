#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# map.db of real runs: the keyframes of the run, the same bytes for the same run, `edgevo info` with a picture; of a killed run what it
# had, finished later; none where it is switched off. Reading changes nothing.
. "$(dirname "$0")/cli_common.sh"
sequence=$scenes/street whole=$scenes/runs/street

# value NAME: of the last `edgevo info`.
value() { sed -n "s/^$1  *//p" stdout; }
# state_of FOLDER: names, sizes and sums of all files.
state_of() { (cd "$1" && ls -l map.db* | awk '{ print $5, $NF }' && cat map.db* | cksum); }

run_code 0 "$edgevo" info "$whole/map.db" -o map.png
check "keyframes of the run" "$(value keyframes | cut -d ' ' -f 1)" -eq "$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "keyframe") c = i } NR > 1 { n += $c } END { print n }' "$whole/frames.csv")"
check "bytes a keyframe" "$(($(stat -c %s "$whole/map.db") / $(value keyframes | cut -d ' ' -f 1)))" -le 40000
check "state" "$([ "$(value state)" = finished ] && echo 1)" -eq 1
check "a PNG" "$(head -c 4 map.png | tail -c 3 | grep -c PNG)" -eq 1
complains "only a map has a picture" "$edgevo" info "$sequence" -o map.png

for out in one two; do run_code 0 "$edgevo" run "$sequence" -o $out --quiet --frames 0:60; done
same "map.db of the same run" one/map.db two/map.db
run_code 0 "$edgevo" run "$sequence" -o off --quiet --frames 0:60 --loops off
[ ! -e off/map.db ] && ok "no map" || fail "map.db in spite of --loops off"
run_code 0 "$edgevo" run "$sequence" -o realtime --quiet --realtime
run_code 0 "$edgevo" info realtime/map.db
check "keyframes of a realtime run" "$(value keyframes | cut -d ' ' -f 1)" -ge 5
run_code 0 "$edgevo" run "$sequence" -o metres --quiet --scale factor=2 --frames 0:60
run_code 0 "$edgevo" info metres/map.db
check "metres" "$(value unit | grep -c '^metre')" -eq 1

"$edgevo" run "$sequence" -o killed --quiet >/dev/null 2>&1 &
pid=$!
has_keyframes() { [ "$(stat -c %s killed/map.db-wal 2>/dev/null || echo 0)" -gt 100000 ]; }
eventually has_keyframes
kill -KILL $pid
wait $pid 2>/dev/null
before=$(state_of killed)
run_code 0 "$edgevo" info killed/map.db
check "state of a killed run" "$([ "$(value state)" = interrupted ] && echo 1)" -eq 1
check "keyframes of a killed run" "$(value keyframes | cut -d ' ' -f 1)" -ge 1
[ "$(state_of killed)" = "$before" ] && ok "reading changes nothing" || fail "files of the map changed"
run_code 0 "$edgevo" finish killed
run_code 0 "$edgevo" info killed/map.db
check "state once finished" "$([ "$(value state)" = finished ] && echo 1)" -eq 1
check "files of the map" "$(ls killed | grep -c '^map.db')" -eq 1

# A run in the map of another one: its frame and unit, and the file as it was.
before=$(state_of metres)
run_code 0 "$edgevo" run "$sequence" -o placed --frames 0:60 --seed 2 --map metres
check "found in the map" "$(grep -c 'frames found in metres, whose.*(metres)' stdout)" -eq 1
check "places in the map" "$(grep -c '^place,,,-1,' placed/graph.csv)" -ge 3
[ "$(state_of metres)" = "$before" ] && ok "the map is as it was" || fail "the map changed"
# awk: largest distance of the poses of both, of a path of 44 m.
check "frame and unit of the map" "$(paste -d ' ' metres/trajectory_tum.txt placed/trajectory_tum.txt | grep -v '#' | awk '{ d = sqrt(($2 - $10)^2 + ($3 - $11)^2 + ($4 - $12)^2); if (d > most) most = d } END { print NR == 50 && most < 0.1 }')" -eq 1
# Located before it has a map of its own: four frames of a slow camera make none, eight do.
run_code 0 "$edgevo" run "$scenes/desk" -o slow --quiet
run_code 0 "$edgevo" run "$scenes/desk" -o short --frames 20:24 --seed 2 --map slow
check "said" "$(grep -c '^2 frames found in slow, whose' stdout)" -eq 1
check "frames located" "$(grep -c '^place,,,-1,' short/graph.csv)" -eq 2
check "keyframes of its own" "$(awk -F, 'NR > 1 && $5 == 1' short/frames.csv | wc -l)" -eq 0
run_code 0 "$edgevo" run "$scenes/desk" -o longer --frames 20:40 --seed 2 --map slow
check "keyframes of its own" "$(awk -F, 'NR > 1 && $5 == 1' longer/frames.csv | wc -l)" -ge 5
# near_slow FILE: rows in it that are within 0.1 units, of some 10 to what is seen, of the pose in the map at that time.
near_slow() { awk '/^#/ { next } FNR == NR { x[$1] = $2; y[$1] = $3; z[$1] = $4; next } $1 in x { n += sqrt(($2 - x[$1])^2 + ($3 - y[$1])^2 + ($4 - z[$1])^2) < 0.1 } END { print n }' slow/trajectory_tum.txt "$1"; }
check "poses at their place in the map, of two located frames" "$(near_slow short/trajectory_tum.txt)" -eq 2
check "of a run that goes on" "$(near_slow longer/trajectory_tum.txt)" -ge 18
check "live, from the first one on" "$(near_slow longer/trajectory_live_tum.txt)" -ge 18
complains "omit it" "$edgevo" run "$sequence" -o refused --scale factor=3 --map metres
complains "with --forget" "$edgevo" run "$sequence" -o refused --forget --map metres
complains "map.db" "$edgevo" run "$sequence" -o refused --map nowhere
[ ! -e refused ] && ok "nothing is written" || fail "a refused run wrote"

head -c 30000 "$whole/map.db" >cut.db
run_code 0 "$edgevo" info cut.db
check "a warning about the rest" "$(grep -c 'damaged or cut off' stderr)" -eq 1
: >map.db
complains "is empty" "$edgevo" info map.db
finish
