#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Well-formed but hopeless input: nothing to see, too few images, images of one pixel. Exit code 3 with one line, a row for every
# frame and all files, never a crash.
. "$(dirname "$0")/cli_common.sh"

# sequence NAME WIDTH HEIGHT FRAMES: black images.
sequence() {
  mkdir -p "$1/images"
  plain_image "$2" "$3" "$1.pgm"
  for i in $(seq -f %06.0f 0 $(($4 - 1))); do ln -s "$work/$1.pgm" "$1/images/$i.pgm"; done
  awk -v n="$4" 'BEGIN { for (i = 0; i < n; ++i) print i / 10 }' >"$1/times.txt"
  awk -v w="$2" -v h="$3" 'BEGIN { print w, w, w / 2, h / 2, 0, 0, 0, 0, w, h }' >"$1/camera.txt"
}
# hopeless SOURCE FRAMES [OPTION...]
hopeless() {
  source=$1 count=$2
  shift 2
  rm -rf out
  run_code 3 "$edgevo" run "$source" -o out --quiet "$@"
  check "lines on stderr" "$(wc -l <stderr)" -eq 1
  grep -q "^edgevo: tracking failed for most of .*; mostly: ....." stderr && ok "  $(cat stderr)" || fail "message: $(cat stderr)"
  check "rows" "$(rows out)" -eq "$count"
  check "rows with the reason in the note" "$(awk -F, 'NR > 1 && length($9) > 5' out/frames.csv | wc -l)" -gt 0
  for file in trajectory_tum.txt edges.ply edges.bt edges.ot keyframes.simplemap playback.rawlog scene.3Dscene; do
    [ -s out/$file ] || fail "$file is missing or empty"
  done
  check "summary.yaml has the count" "$(sed -n '/^frames:/,/^[a-z]/s/^  total: //p' out/summary.yaml)" -eq "$count"
}

sequence black 320 240 30
"$edgevo" run black -o out >both 2>&1
check "the reason is the last line of a log" "$(tail -n 1 both | grep -c '^edgevo: tracking failed for most of')" -eq 1
hopeless black 30
hopeless black 30 --realtime
hopeless black 30 --detector edge_drawing
run_code 3 "$edgevo" run black -o forgotten --forget --quiet
run_code 3 "$edgevo" finish forgotten
check "the reason, from finish" "$(grep -c '^edgevo: tracking failed for most of forgotten; mostly: .' stderr)" -eq 1
complains "out: has no point that is certain enough for a map; run a longer sequence" "$edgevo" map out -o map
sequence dot 1 1 5
hopeless dot 5
hopeless dot 5 --detector edge_drawing
sequence row 64 1 5
hopeless row 5
sequence column 1 64 5
hopeless column 5
hopeless "$scenes/desk" 1 --frames 0:1
hopeless "$scenes/desk" 2 --frames 0:2
hopeless "$scenes/desk" 2 --frames 0:2 --realtime

# A camera that does not move: no parallax, hence no map, and no wrong one either.
copy_sequence "$scenes/desk" still 0 1
for i in $(seq -f %06.0f 1 19); do ln -s "$scenes/desk/images/000000.png" still/images/$i.png; done
awk 'BEGIN { for (i = 0; i < 20; ++i) print i / 10 }' >still/times.txt
hopeless still 20
check "poses of a camera that does not move" "$(grep -c '^[0-9]' out/trajectory_tum.txt)" -eq 0
finish
