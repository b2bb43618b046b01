#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Maps that are joined, and one that grows: a run is placed in either half of the joined map; misuse; a map that is extended by two runs in
# one light, by one in another; kill -9.
. "$(dirname "$0")/cli_common.sh"
sequence=$scenes/street

# value NAME MAP: of `edgevo info`.
value() { "$edgevo" info "$2" | sed -n "s/^$1  *//p" | cut -d ' ' -f 1; }
# sum_of FILE
sum_of() { cksum <"$1"; }
# placed RUN: keyframes of it that were found in a map.
placed() { grep -c '^place,,,-1,' "$1/graph.csv"; }

run_code 0 "$edgevo" run "$sequence" -o first --quiet --frames 0:34
run_code 0 "$edgevo" run "$sequence" -o second --quiet --frames 16:50 --scale factor=3
before="$(sum_of first/map.db) $(sum_of second/map.db)"
run_code 0 "$edgevo" join first second/map.db -o both.db
check "what was found" "$(grep -c '^both.db: .* found in the first' stdout)" -eq 1
[ "$(sum_of first/map.db) $(sum_of second/map.db)" = "$before" ] && ok "both are as they were" || fail "join changed a map"
check "keyframes of both" "$(value keyframes both.db)" -eq "$(($(value keyframes first/map.db) + $(value keyframes second/map.db)))"
run_code 0 "$edgevo" join first second -o again.db
same "the same maps joined again" both.db again.db
run_code 0 "$edgevo" info both.db -o both.png
check "no other files" "$(ls | grep -c '^both.db')" -eq 1

for half in 0:20 30:50; do
  run_code 0 "$edgevo" run "$sequence" -o "in_$half" --quiet --frames $half --seed 2 --map both.db
  check "keyframes of $half found in the joined map" "$(placed "in_$half")" -ge 3
done
# awk: the first camera of the second half, which is 30 frames after the origin; a frame is 0.88 m.
start=$(awk '!/#/ { print sqrt($2^2 + $3^2 + $4^2); exit }' in_30:50/trajectory_tum.txt)
end=$(awk '!/#/ { d = sqrt($2^2 + $3^2 + $4^2) } END { print d }' first/trajectory_tum.txt)
below "where the second half begins, of the end of the first map" "$(awk -v a="$start" -v b="$end" 'BEGIN { print a / b - 30 / 33 < 0 ? 30 / 33 - a / b : a / b - 30 / 33 }')" 0.03

complains "is there already" "$edgevo" join first second -o both.db
complains "is there already" "$edgevo" join first second -o first/map.db
complains "once more" "$edgevo" join first first/map.db -o c.db
complains "nowhere" "$edgevo" join first nowhere -o c.db
run_code 0 "$edgevo" run "$scenes/desk" -o desk --quiet --frames 0:30
complains "another camera\|fewer than three" "$edgevo" join first desk -o c.db
run_code 0 "$edgevo" simulate corridor --frames 0:25 -o corridor
run_code 0 "$edgevo" run corridor -o elsewhere --quiet
complains "another camera\|fewer than three of its places" "$edgevo" join first elsewhere -o c.db
head -c 5000 first/map.db >cut.db
complains "cut.db" "$edgevo" join cut.db second -o c.db
complains "out is required" "$edgevo" join first second
[ ! -e c.db ] && ok "nothing is written" || fail "a refused join wrote"

# ---- a map that grows ----
extend() { run_code 0 "$edgevo" run "$@" --quiet --map first --extend; }
cp first/map.db small.db
complains "extend.*requires.*map\|--map" "$edgevo" run "$sequence" -o refused --extend
complains "omit --scale" "$edgevo" run "$sequence" -o refused --map first --extend --scale factor=2
complains "loops off" "$edgevo" run "$sequence" -o refused --map first --extend --loops off
complains "another -o" "$edgevo" run "$sequence" -o first --map first
[ ! -e refused ] && ok "nothing is written" || fail "a refused run wrote"
run_code 0 "$edgevo" run "$sequence" -o once --map first --seed 2
same "a run that only localises" first/map.db small.db
extend "$sequence" -o one --seed 3
grown=$(value keyframes first/map.db)
check "keyframes once extended" "$grown" -gt "$(value keyframes small.db)"
for seed in 4 5; do extend "$sequence" -o one --seed $seed --force; done
check "keyframes after three runs in one light, of 105 % of those after one" "$(($(value keyframes first/map.db) * 100))" -le "$((grown * 105))"
run_code 0 "$edgevo" run "$sequence" -o at_the_end --quiet --frames 34:50 --map first
check "keyframes found in what was added" "$(placed at_the_end)" -ge 3

# kill_while_it_writes FILE COMMAND...: as soon as its new file is there; true if it was killed before that had its name.
kill_while_it_writes() {
  made=$1.new
  shift
  "$@" >/dev/null 2>&1 &
  pid=$!
  while [ ! -e "$made" ] && kill -0 $pid 2>/dev/null; do :; done
  kill -KILL $pid 2>/dev/null
  wait $pid 2>/dev/null
  [ -e "$made" ]
}
grown=$(value keyframes first/map.db)
in_time=0
for try in 1 2 3 4 5 6 7 8 9 10; do
  [ $in_time -ge 2 ] && break
  rm -rf killed
  cp small.db first/map.db
  if kill_while_it_writes first/map.db "$edgevo" run "$sequence" -o killed --quiet --seed 3 --map first --extend; then
    in_time=$((in_time + 1))
    same "the map of a run that was killed while it wrote" small.db first/map.db
  else
    check "keyframes of a map that had its name" "$(value keyframes first/map.db)" -eq "$grown"
  fi
done
check "runs killed while they wrote" $in_time -ge 1
run_code 0 "$edgevo" run "$sequence" -o after_all --quiet --seed 3 --map first --extend
check "keyframes once it is not killed" "$(value keyframes first/map.db)" -eq "$grown"

# The system kills a program whose file grows beyond a limit, here where a share of the joined map is written.
blocks=$(($(stat -c %s both.db) / 512))
for share in 5 30 60 95; do
  sh -c 'ulimit -f "$1"; shift; exec "$@"' sh $((blocks * share / 100)) "$edgevo" join small.db second -o killed.db >/dev/null 2>&1
  check "killed by a signal at $share %" $? -gt 128
  [ ! -e killed.db ] && ok "no map" || fail "half of a map at $share %"
done
run_code 0 "$edgevo" join small.db second -o killed.db
same "the map once it is not killed" killed.db both.db
finish
