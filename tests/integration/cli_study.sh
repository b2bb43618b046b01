#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# `edgevo study` and `edgevo simulate --correspondences`: a small study, its files, the same bytes twice, and bad input.
. "$(dirname "$0")/cli_common.sh"
study() { "$edgevo" study --pairs 2 --points 200 --max-distance 3 --frames 0:18 "$@"; }

run_code 0 study -o a
run_code 0 study -o b
run_code 0 study -o c --seed 2

# Times are in the last three columns of the curves; everything else is the same for the same seed.
for curve in search_length patch_size frame_distance residuals variants; do
  for run in a b c; do cut -d, -f1-15 "$run/$curve.csv" >"$run/$curve.untimed"; done
  same "$curve" a/$curve.untimed b/$curve.untimed
  differ "$curve with another seed" a/$curve.untimed c/$curve.untimed
done
for table in end_point_error match_errors confidence confidence_areas; do same "$table" a/$table.csv b/$table.csv; done
same "script of the plots" a/plots.gnuplot c/plots.gnuplot

check "rows of search_length.csv: 7 settings, 3 costs, 2 lights" "$(wc -l <a/search_length.csv)" -eq 43
check "rows of patch_size.csv: 6 sizes, 3 costs, 2 lights" "$(wc -l <a/patch_size.csv)" -eq 37
check "rows of frame_distance.csv: 3 distances, 8 methods, 2 lights" "$(wc -l <a/frame_distance.csv)" -eq 49
check "conclusions on the paper's observations" "$(grep -c '^### [1-4].*here.*\*\*' a/study.md)" -eq 4
drift() { awk -F, -v l="$1" -v m="$2" '$1 == l && $2 == m && $3 == 1 { print $7 }' a/frame_distance.csv; }
below "drift of gradient patches, one frame apart, %" "$(drift normal gradient)" 3
below "the same under changed light" "$(drift changed gradient)" 3
if command -v gnuplot >/dev/null; then
  for plot in paramstudy direction time match_errors confidence; do
    check "bytes of $plot.png" "$(wc -c <a/$plot.png)" -gt 20000
    check "$plot.svg is one" "$(grep -c '</svg>' a/$plot.svg)" -eq 1
  done
else
  grep -q "gnuplot-nox" stdout && ok "says how to get the plots" || fail "no plots and no message about them"
fi

complains "no-scene" "$edgevo" study -o d --scene no-scene
complains "nowhere: is not a folder of a Virtual KITTI" "$edgevo" study -o d --source nowhere
complains "needs 17 frames, there are 5" "$edgevo" study -o d --frames 0:5
complains "frames 0:9999 are not in it" "$edgevo" study -o d --frames 0:9999
complains "distance 4: is more than the largest distance, 3" study -o d --distance 4
complains "\-\-noise.*from 0 to 0.5" study -o d --noise 7
complains "dark" study -o d --light dark
complains "\-\-pairs.*whole number" study -o d --pairs 0
check "folders left by commands that cannot run" "$(ls -d d 2>/dev/null | wc -l)" -eq 0
: >file
complains "file: is a file" study -o file

# Exact correspondences of rendered frames.
run_code 0 "$edgevo" simulate corridor --frames 10:13 -o corridor --correspondences
check "files for three frames" "$(ls corridor/correspondences | wc -l)" -eq 2
check "rows with a position in the next frame" "$(grep -c ',1$' corridor/correspondences/000010.csv)" -gt 1000
complains "need two frames of it" "$edgevo" simulate corridor --frames 10:11 -o one --correspondences
complains "a rawlog does not hold correspondences" "$edgevo" simulate corridor --frames 10:13 -o c.rawlog --correspondences
complains "rolling shutter" "$edgevo" simulate corridor --frames 10:13 -o one --correspondences --rolling-shutter 0.02
finish
