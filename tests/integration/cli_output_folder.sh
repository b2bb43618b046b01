#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Nothing is destroyed: an earlier run is kept until the next one has results, nothing is written into a data set, and other files are
# left untouched.
. "$(dirname "$0")/cli_common.sh"
desk=$scenes/desk
run() { "$edgevo" run "$@" --quiet; }
images() { ls "$1/playback_Images" | wc -l; }
# unchanged FOLDER: as it was when `remember` saw it.
content_of() { (cd "$1" && find . -type f -o -type l | sort | while read -r f; do echo "$f $(cksum <"$f")"; done); }
remember() { content_of "$1" >remembered; }
unchanged() { content_of "$1" >now; same "$1 is as it was" remembered now; }

# A run that never starts leaves the earlier one untouched.
run "$desk" -o out --frames 0:30 || fail "run"
remember out
copy_sequence "$desk" torn 0 20
rm torn/images/000000.png
head -c 1000 "$desk/images/000000.png" >torn/images/000000.png
complains "images/000000.png: the image does not decode" run torn -o out
unchanged out
echo "500 500 160 100 0 0 0 0 320 200" >small.txt
complains "the image is 640x480, but the camera model is for 320x200, of another shape" run "$desk" -o out --camera small.txt
complains "'7' is out of range" run "$desk" -o out --set edges.canny_percentile=7
complains "recorded no odometry" run "$desk" -o out --scale odometry
unchanged out
complains "images/000000.png: the image does not decode" run torn -o fresh
check "folders left by a run that never started" "$(ls -d fresh 2>/dev/null | wc -l)" -eq 0

# A run without poses is written, and the earlier one is kept next to it until there is a run with poses.
mkdir -p black/images
plain_image 640 480 black.pgm
for i in 0 1 2 3 4 5 6 7; do ln -s "$work/black.pgm" black/images/$i.pgm && echo "0.$i"; done >black/times.txt
cp "$desk/camera.txt" black
cp out/trajectory_tum.txt good.txt
run_code 3 run black -o out
check "the message names the folder of the earlier run" "$(grep -c 'the earlier run is kept in out/earlier_run' stderr)" -eq 1
same "trajectory of the earlier run" good.txt out/earlier_run/trajectory_tum.txt
check "rows of the run without poses" "$(rows out)" -eq 8

# The next run removes both; files of the user are kept.
echo "by hand" >out/notes.txt
run_code 0 run "$desk" -o out --frames 0:25
check "images of this run alone" "$(images out)" -eq 25
check "earlier runs" "$(ls -d out/earlier_run 2>/dev/null | wc -l)" -eq 0
check "the user's file" "$(cat out/notes.txt | grep -c 'by hand')" -eq 1

# Folders with other files.
mkdir thesis && echo "years" >thesis/thesis.tex
remember thesis
complains "thesis: contains other files already (thesis.tex); give another -o, or --force" run "$desk" -o thesis
complains "thesis: contains other files" "$edgevo" study -o thesis --pairs 2
complains "thesis: contains other files" "$edgevo" simulate desk -o thesis
complains "thesis: contains other files" "$edgevo" relight "$desk" -o thesis
complains "thesis: contains other files" "$edgevo" map out -o thesis
[ ! -x "$(dirname "$edgevo")/edgevo-servo" ] || complains "thesis: contains other files" "$edgevo" servo -o thesis
unchanged thesis
run_code 0 run "$desk" -o thesis --frames 0:12 --force
check "other files after --force" "$(cat thesis/thesis.tex)" = years

# Other files, and maps of another run.
"$edgevo" import "$desk" clip.rawlog --frames 0:5 >/dev/null || fail "import"
cksum clip.rawlog clip_Images/* >before
complains "clip.rawlog: exists already; give another name, or --force" "$edgevo" import "$desk" clip.rawlog
complains "clip.rawlog: exists already" "$edgevo" simulate desk -o clip.rawlog
complains "clip.rawlog: exists already" "$edgevo" relight "$desk" -o clip.rawlog
mv clip.rawlog kept.rawlog
complains "clip_Images: contains other files" "$edgevo" import "$desk" clip.rawlog
mv kept.rawlog clip.rawlog
cksum clip.rawlog clip_Images/* >after
same "rawlog and its images" before after
run_code 0 "$edgevo" import "$desk" clip.rawlog --frames 0:6 --force
complains "out: contains other files" "$edgevo" map thesis -o out
complains "out/summary.yaml: exists already" "$edgevo" calibrate out -o out/summary.yaml

# No output into its own source or around it, by whatever name.
cp -r "$desk" same
ln -s same alias
mkdir apart && cp same/camera.txt same/times.txt apart && ln -s ../same/images apart/images
remember same
for out in same/images same same/out alias/images ./same/../same/images; do
  complains "its own source same, which writing would change; give a folder outside the source" run same -o $out
done
complains "same/images/out: lies inside its own source" run apart -o same/images/out
complains "alias: holds its own source" run alias/images -o alias --camera same/camera.txt
complains "holds its own source" run same -o .
complains "its own source" "$edgevo" import same same/x.rawlog
complains "its own source" "$edgevo" import clip.rawlog clip.rawlog --force
complains "its own source" "$edgevo" relight same -o same/images --force
complains "its own source" run clip.rawlog -o clip_Images --force
complains "its own source" run out/playback.rawlog -o out
printf 'seeds: 1\nsequences:\n  same:\n    source: same\n' >list.yaml
complains "its own source" "$edgevo" bench list.yaml -o same/bench
unchanged same

# A self-contained folder, and one that moves together with its source.
run_code 0 run same -o alone --frames 0:12 --copy-images
check "links in a self-contained folder" "$(find alone -type l | wc -l)" -eq 0
same "an image of it" same/images/000011.png alone/playback_Images/frame_000011.png
mkdir tree && mv same tree
run_code 0 run tree/same -o tree/out --frames 0:12
mv tree moved
same "an image of a tree that moved" moved/same/images/000011.png moved/out/playback_Images/frame_000011.png
finish
