#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Symphony Lake: rendered surveys in an archive, both naming schemes; info, run, eval and import on them, and damaged surveys.
. "$(dirname "$0")/cli_common.sh"

render() { run_code 0 "$edgevo" simulate lakeshore --season "$1" --frames 0:24 --layout "$2" -o archive; }
render winter symphony_lake
render summer symphony_lake_new
check "images of the older naming" "$(ls archive/VBags/160115/0000/0003.jpg | wc -l)" -eq 1
check "images of the newer naming" "$(ls archive/Dataset/2015/150715/0000/00003.jpg | wc -l)" -eq 1
differ "winter and summer" archive/VBags/160115/0000/0003.jpg archive/Dataset/2015/150715/0000/00003.jpg
complains "holds 2 surveys: 150715, 160115; name one of them" "$edgevo" info archive
complains "no survey '160116'; did you mean 160115?" "$edgevo" info archive/160116
survey=archive/VBags/160115
for name in archive/160115 archive/150715; do
  run_code 0 "$edgevo" info --check "$name"
  check "kind" "$(grep -c '^kind  *Symphony Lake$' stdout)" -eq 1
  check "images that decode" "$(grep -c '^check  *all 24 images decode' stdout)" -eq 1
  check "ground truth" "$(grep -c '^ground truth .*optposes.csv (poses of the boat' stdout)" -eq 1
  check "sideways" "$(grep -c '^mount .*looks -\(89\|90\)\.[0-9] deg to the left' stdout)" -eq 1
done

# Run and eval with the map of the survey; the rendered path is known separately.
run_code 0 "$edgevo" run archive/160115 -o out --quiet --seed 1
run_code 0 "$edgevo" eval out/trajectory_tum.txt archive/160115
check "eval names the map" "$(grep -c '^ground truth .*optposes.csv' stdout)" -eq 1
"$edgevo" eval out/trajectory_tum.txt archive/160115 --json >by_map.json || fail "eval --json"
value() { sed -n '/"ate_sim3"/,/}/s/.*"rmse_m": *\([0-9.e+-]*\).*/\1/p' "$1"; }
below "ATE, of a path of 3.2 m whose heave of 3 cm the map does not contain" "$(value by_map.json)" 0.05
run_code 0 "$edgevo" import archive/160115 survey.rawlog
check "ground truth next to the rawlog" "$(grep -vc '^#' survey_groundtruth_tum.txt)" -eq 24
complains "its own source" "$edgevo" run archive/160115 -o "$survey/out" --quiet

# No Maps: a notice, and the coarse truth, said to be coarse.
mv archive/Maps maps
run_code 0 "$edgevo" info archive/160115
check "info says coarse" "$(grep -c '^ground truth  *coarse, by GPS and compass.*no Maps/160115/optposes.csv' stdout)" -eq 1
run_code 0 "$edgevo" eval out/trajectory_tum.txt archive/160115
check "eval says coarse" "$(grep -c '^ground truth .*coarse, by GPS and compass' stdout)" -eq 1

# Damaged surveys: one line and exit code 2 each.
damaged() { rm -rf d && mkdir d && cp -r "$survey" d/160115; }
list=d/160115/image_auxilliary.csv
bad() { complains "$1" "$edgevo" run d/160115 -o never --quiet; }
damaged && sed -i 's/,.*//' $list && bad "image_auxilliary.csv, line 2: has 1 column, fewer than"
damaged && cut -d, -f1-7 $survey/image_auxilliary.csv >$list && bad "7 columns are fewer than the 13 that include the camera; give .*--camera"
run_code 0 "$edgevo" run d/160115 --fov 70 -o few --quiet
damaged && sed -i '5s/, 0, 0$//' $list && bad "line 5: has 14 columns instead of 16"
damaged && sed -i '5s/^[^,]*,[^,]*,/noon, 3,/' $list && bad "line 5: 'noon' is not a time"
damaged && sed -i '6s/, 4.000000,/, four,/' $list && bad "line 6: 'four' is not a number"
damaged && sed -i '2,$d' $list && bad "the survey is empty"
damaged && rm -r d/160115/0000 && bad "none of its 24 images is there"
mkdir -p d/VBags d/Dataset/2016 && mv d/160115 d/VBags && cp -r "$survey" d/Dataset/2016 && bad "two surveys named 160115"
[ ! -e never ] || fail "there is an output for a survey that cannot be read"
damaged && sed -i '10{h;d};11{G}' $list && complains "is not after the frame before" "$edgevo" run d/160115 -o back --quiet --on-bad-frame stop
check "the frames before it are kept" "$(rows back)" -ge 8
damaged && rm d/160115/0000/0007.jpg
complains "0007.jpg: the image is missing" "$edgevo" run d/160115 -o stopped --quiet --on-bad-frame stop
run_code 0 "$edgevo" run d/160115 -o skipped --quiet
check "each frame has its row" "$(rows skipped)" -eq 24
check "the row of the missing one says why" "$(grep -c ',left.out: .*missing or cannot be read' skipped/frames.csv)" -eq 1
cut -d, -f1-2,8-13 $survey/image_auxilliary.csv >$list
complains "holds no ground truth: none: the rows do not state where the camera looks" "$edgevo" eval out/trajectory_tum.txt d/160115
mkdir -p d/Maps/160115 && cp -r maps/160115/optposes.csv d/Maps/160115 && cp $survey/image_auxilliary.csv $list
sed -i '7{h;d};8{G}' d/Maps/160115/optposes.csv
complains "optposes.csv, line 8: its time .* is not after" "$edgevo" eval out/trajectory_tum.txt d/160115

# Writing.
complains "holds neither depth nor correspondences" "$edgevo" simulate lakeshore --layout symphony_lake --depth -o x
complains "'wintr' is not a season" "$edgevo" simulate lakeshore --season wintr --layout symphony_lake -o x
complains "has no seasons" "$edgevo" simulate desk --season winter -o x
complains "is not a name of a survey" "$edgevo" simulate lakeshore --frames 0:2 --layout symphony_lake --survey may -o x
complains "layout" "$edgevo" simulate lakeshore --layout symphony -o x
mkdir -p y/VBags/150715 && echo mine >y/VBags/150715/notes.txt
complains "150715" "$edgevo" simulate lakeshore --frames 0:2 --layout symphony_lake -o y
[ "$(cat y/VBags/150715/notes.txt)" = mine ] || fail "another file was removed"
finish
