#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A run through the rendered street: run, eval, every output file, and the stock tools on all of them.
. "$(dirname "$0")/cli_common.sh"
sequence=$scenes/street
frames=$(wc -l <"$sequence/times.txt")

run_code 0 "$edgevo" run "$sequence" -o out/new/folder
out=out/new/folder
check "the line on stdout with the counts" "$(grep -c "^$frames frames, .* with a pose" stdout)" -eq 1
check "progress without a terminal" "$(tr -cd '\r' <stderr | wc -c)" -eq 0

for file in trajectory_tum.txt trajectory_live_tum.txt frames.csv keyframes.simplemap playback.rawlog scene.3Dscene edges.ply \
  edges.bt edges.ot summary.yaml; do
  check "bytes of $file" "$(wc -c <"$out/$file")" -gt 200
done
check "images of the playback" "$(ls "$out/playback_Images" | wc -l)" -ge "$frames"

# Every frame has a row, and a pose from the bootstrap on.
check "rows of frames.csv" "$(rows $out)" -eq "$frames"
awk -F, 'NR > 1 && $1 != NR - 2 { exit 1 }' $out/frames.csv && ok "rows in order" || fail "frame numbers in frames.csv"
first=$(awk -F, 'NR > 1 && $4 >= 0 { print $1; exit }' $out/frames.csv)
check "first frame with a pose" "$first" -le 10
check "poses from the bootstrap on" "$(poses $out)" -eq $((frames - first))
check "lost frames" "$(in_state $out LOST)" -eq 0
check "rows with the time of edge detection" "$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "ms_edges") c = i }
  NR > 1 && $c > 0' $out/frames.csv | wc -l)" -eq "$frames"

# Accuracy: a loose bound that still shows when something broke (the path is 45 m long).
below "ATE in metres" "$(ate $out "$sequence")" 0.15
check "matched poses in eval --json" "$(sed -n 's/.*"matched_poses": *\([0-9]*\).*/\1/p' eval.json)" -eq "$(poses $out)"
check "input frames that eval read next to the trajectory" "$(sed -n 's/.*"input_frames": *\([0-9]*\).*/\1/p' eval.json)" -eq "$frames"
below "ATE in metres at the desk (path 0.5 m)" "$(ate "$scenes/runs/desk" "$scenes/desk")" 0.003
run_code 0 "$edgevo" eval $out/trajectory_tum.txt "$sequence/groundtruth_tum.txt"
check "ATE in the table" "$(grep -c '^ATE RMSE' stdout)" -eq 2
# The folder of the run: its single frames as well, against the ground truth that it recorded.
run_code 0 "$edgevo" eval $out
check "ATE of the folder" "$(grep -c '^ATE RMSE' stdout)" -eq 2
check "frames evaluated, live and final" "$(awk '($1 == "live" || $1 == "final") && $2 > 40 { n += $3 == 0 && $4 == "-" } END { print n }' stdout)" -eq 2
run_code 0 "$edgevo" eval $out "$scenes/runs/desk"
check "rows of two runs and of both" "$(grep -c "^$out \|/runs/desk \|^all " stdout)" -eq 3
# The map against the rendered scene: figures, why edges are missing, a page of its own.
run_code 0 "$edgevo" eval $out/edges.ply street --why --page map.html --picture map.png
check "rows of the map's table" "$(grep -c '^within 10 m \|^kerbs \|^poles \|^along the motion \|^no line of it ' stdout)" -ge 6
check "pictures of the map's page" "$(grep -c '<img' map.html)" -eq 6
check "references to other files in the map's page" "$(grep -c -i -E '(src|href)="[^d#]|url\(|@import|<link|https?:' map.html)" -eq 0
check "bytes of the picture" "$(wc -c <map.png)" -gt 10000
complains "SCENE: is missing" "$edgevo" eval $out/edges.ply
complains "no_such_scene" "$edgevo" eval $out/edges.ply no_such_scene --page other.html
check "pages after a mistake" "$(ls other.html 2>/dev/null | wc -l)" -eq 0
complains "is no map: --why" "$edgevo" eval $out/trajectory_tum.txt "$sequence/groundtruth_tum.txt" --why
complains "GROUNDTRUTH: is missing" "$edgevo" eval $out/trajectory_tum.txt
complains "is no folder of a run" "$edgevo" eval $out/trajectory_tum.txt "$sequence/groundtruth_tum.txt" --truth-sigma-m 0.1

# summary.yaml: counts, and the effective parameters, which can be read again.
value() { sed -n "/^$1:/,/^[a-z]/s/^  $2: *//p" $out/summary.yaml; }
check "frames in summary.yaml" "$(value frames total)" -eq "$frames"
check "poses in summary.yaml" "$(value frames with_pose)" -eq "$(poses $out)"
check "segments in summary.yaml" "$(value trajectory segments)" -eq 1
check "keyframes in summary.yaml" "$(value trajectory keyframes)" -eq "$(awk -F, 'NR > 1 && $5 == 1' $out/frames.csv | wc -l)"
check "vertices of edges.ply" "$(sed -n 's/^element vertex //p' $out/edges.ply | tr -d '\r')" -eq $(($(value map points_exported) + $(value map line_vertices)))
check "lines in edge_segments.csv" $(($(wc -l <$out/edge_segments.csv) - 1)) -eq "$(value map lines)"
check "vertices of lines for each point" $(($(value map line_vertices) / $(value map points_exported))) -ge 2
check "not metric" "$(value scale metric | grep -c false)" -eq 1
below "memory in MB" "$(value memory peak_mb)" 2000
grep -q '^not_written: \[\]' $out/summary.yaml && ok "nothing unwritten" || fail "not_written in summary.yaml"
sed -n '/^parameters:/,$s/^  //p' $out/summary.yaml >effective.yaml
check "effective parameters" "$(grep -c : effective.yaml)" -gt 20
run_code 0 "$edgevo" run "$sequence" -o again --params effective.yaml --quiet
same "trajectory with the effective parameters of the first run" $out/trajectory_tum.txt again/trajectory_tum.txt
check "words on stderr with --quiet" "$(cat stdout stderr | wc -c)" -eq 0

if "$here/stock_tools.sh" $out >stock.log 2>&1; then ok "stock tools: $(grep -c '^ok' stock.log) checks"; else
  cat stock.log
  fail "stock tools"
fi
finish
