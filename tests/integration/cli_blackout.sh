#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# 40 black images within a sequence: the run ends normally, the black frames are LOST, tracking resumes, earlier poses are kept.
. "$(dirname "$0")/cli_common.sh"
sequence=$scenes/desk
set -- $(sed -n '/^[^#]/{p;q;}' "$sequence/camera.txt")
width=$9
shift 9
height=$1

mkdir -p black/images
cp "$sequence/camera.txt" black
i=0
add() {  # add FILE EXTENSION
  ln -s "$1" "black/images/$(printf %06d $i).$2"
  i=$((i + 1))
}
plain_image "$width" "$height" black.pgm
images=$(ls "$sequence/images")
for image in $(echo "$images" | head -30); do add "$sequence/images/$image" png; done
for unused in $(seq 40); do add "$work/black.pgm" pgm; done
for image in $(echo "$images" | tail -n +31); do add "$sequence/images/$image" png; done
awk -v n=$i 'BEGIN { for (i = 0; i < n; ++i) printf "%.6f\n", 100 + i / 30 }' >black/times.txt

run_code 0 "$edgevo" run black -o out --quiet
run_code 0 "$edgevo" run "$sequence" -o before --quiet --frames 0:30
check "rows of frames.csv" "$(rows out)" -eq $i
check "lost frames among the black ones" "$(in_state out LOST 30 69)" -ge 38
check "frames tracked before" "$(in_state out TRACKING 0 29)" -ge 22
check "lost frames before" "$(in_state out LOST 0 29)" -eq 0
check "frames tracked after" "$(in_state out TRACKING 70 99)" -ge 20
check "last frame tracked" "$(in_state out TRACKING 99 99)" -eq 1
check "a reason in the note of the first lost frame" "$(awk -F, 'NR == 32 { print length($9) }' out/frames.csv)" -gt 5

# The earlier poses are kept, as many as those of a run that ends there.
poses_to() { grep '^[0-9]' "$1/trajectory_tum.txt" | awk -v end="$2" '$1 < end' | wc -l; }
check "poses before the black frames" "$(poses_to out 100.9999)" -eq "$(poses before)"
check "poses in the black frames" "$(grep '^[0-9]' out/trajectory_tum.txt | awk '$1 > 100.9999 && $1 < 102.3332' | wc -l)" -eq 0
check "poses that are not numbers" "$(grep -ci nan out/trajectory_tum.txt)" -eq 0
finish
