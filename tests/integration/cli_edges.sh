#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Edge detectors: each runs without further options, is reproducible, and gives the same through the files of `edgevo edges`; invalid
# models and images and wrong sizes are refused with one line.
. "$(dirname "$0")/cli_common.sh"
sequence=$scenes/street
scaled="--image-scale 0.5" # forests take half a second a frame of full size
part="--frames 0:30 $scaled"
frames=30
run_code 0 "$edgevo" run "$sequence" $part -o run_canny --quiet

for detector in edge_drawing structured network combined:structured combined:network; do
  out=run_$(echo $detector | tr : _)
  run_code 0 "$edgevo" run "$sequence" $part -o "$out" --quiet --detector $detector
  check "frames with a pose, $detector" "$(poses "$out")" -eq "$(poses run_canny)"
  below "ATE in metres, $detector (at most twice Canny's)" "$(ate "$out" "$sequence")" "$(ate run_canny "$sequence" | awk '{ print 2 * $1 }')"
  grep -q "detector: .*$detector" "$out/summary.yaml" && ok "summary.yaml names $detector" || fail "no $detector in summary.yaml"
done

# ---- reproducible, and through files ----
mv run_network first_network
mv run_structured first_structured
for detector in structured network; do
  run_code 0 "$edgevo" run "$sequence" $part -o again_$detector --quiet --detector $detector
  same "trajectory, $detector again" first_$detector/trajectory_tum.txt again_$detector/trajectory_tum.txt
  same "points, $detector again" first_$detector/edges.ply again_$detector/edges.ply
  run_code 0 "$edgevo" edges "$sequence" $part -o edges_$detector --detector $detector
  check "images of $detector" "$(ls edges_$detector/*.png | wc -l)" -eq "$frames"
  check "contact sheet of $detector, bytes" "$(wc -c <edges_$detector/contact_sheet.jpg)" -gt 10000
  run_code 0 "$edgevo" run "$sequence" $part -o files_$detector --quiet --detector precomputed --edge-folder edges_$detector
  same "trajectory from files of $detector" first_$detector/trajectory_tum.txt files_$detector/trajectory_tum.txt
done
run_code 0 "$edgevo" run "$sequence" $part -o files_combined --quiet --detector combined:precomputed --set edges.folder=edges_network
same "trajectory combined with files" run_combined_network/trajectory_tum.txt files_combined/trajectory_tum.txt

# A rawlog has images of the same names; scaled images are known by their numbers.
run_code 0 "$edgevo" import "$sequence" log/seq.rawlog
run_code 0 "$edgevo" run log/seq.rawlog -o from_log --quiet --frames 0:20 $scaled --detector precomputed --edge-folder edges_network
run_code 0 "$edgevo" edges "$sequence" -o few --detector structured $scaled --frames 5:8 --jobs 1
check "images of a part" "$(ls few/*.png | tr '\n' ' ' | grep -c '000005.*000007.png $')" -eq 1

# ---- resumed ----
cp -r edges_network part
rm part/000003.png part/000017.png
printf 'cut' >part/000017.png.part
run_code 0 "$edgevo" edges "$sequence" $part -o part --detector network --jobs 1
check "images from before" "$(grep -c "$((frames - 2)) of them from before" stdout)" -eq 1
for name in 000003 000017; do same "image $name" edges_network/$name.png part/$name.png; done
complains "another source, size, detector or model" "$edgevo" edges "$sequence" -o part --detector structured
complains "another source, size, detector or model" "$edgevo" edges "$scenes/desk" -o part --detector network
complains "contains other files" "$edgevo" edges "$sequence" -o "$scenes/runs/street" --detector network
complains "reads such images" "$edgevo" edges "$sequence" -o x --detector precomputed
complains "source" "$edgevo" edges "$sequence" -o "$sequence/images"
run_code 0 "$edgevo" edges "$sequence" -o of_canny --detector canny --frames 0:3
check "images of Canny's pixels" "$(ls of_canny/*.png | wc -l)" -eq 3

# ---- invalid models ----
short() { complains "$1" "$edgevo" run "$sequence" -o x --quiet --frames 0:5 --detector "$2" --edge-model "$3"; }
forest=$(ls "$(dirname "$edgevo")"/../share/edgevo/models/structured_forest.yml.gz)
network=$(ls "$(dirname "$edgevo")"/../share/edgevo/models/edge_network.onnx)
echo "no model" >text.yml.gz
cp text.yml.gz text.onnx
cp "${network%.onnx}.yaml" text.yaml
short "not a structured forest" structured text.yml.gz
short "not a usable network" network text.onnx
head -c 5000 "$forest" >cut.yml.gz
head -c 5000 "$network" >cut.onnx
cp text.yaml cut.yaml
short "cut.yml.gz: " structured cut.yml.gz
short "not a usable network" network cut.onnx
short "nowhere.yml.gz" structured nowhere.yml.gz
short "nowhere" network nowhere.onnx
gzip -dc "$forest" >good.yml
awk '/^childs:/ { in_childs = 1 } in_childs && /\[/ && !done { sub(/\[ *[0-9]+/, "[ 99999999"); done = 1 } { print }' good.yml >child.yml
short "child 99999999 is out of range" structured child.yml
described() { cp "$network" other.onnx; sed "$1" "${network%.onnx}.yaml" >other.yaml; }
described 's/^output:.*/output: nothing/'
short "'nothing'" network other.onnx
described 's/^size:.*/size: fixed 64x64/'
short "takes images of 64x64" network other.onnx
described 's/^size:/szie:/'
short "szie.*size" network other.onnx
complains "did you mean network" "$edgevo" run "$sequence" -o x --detector netwrok

# ---- invalid images ----
wrong() { complains "$1" "$edgevo" run "$sequence" $scaled -o x --quiet --detector precomputed --edge-folder "$2"; }
cp -r edges_network missing && rm missing/000000.png
wrong "missing/000000.png: cannot be read" missing
cp -r edges_network other_size && cp of_canny/000000.png other_size/000000.png
wrong "other_size/000000.png: is .*, the image " other_size
cp -r edges_network cut && head -c 2000 edges_network/000000.png >cut/000000.png
wrong "cut/000000.png: the image does not decode" cut
wrong "nowhere: is not a folder" nowhere
complains "edges.folder: is not given" "$edgevo" run "$sequence" -o x --detector precomputed
# In the middle: the results so far are kept.
cp -r edges_network broken && rm broken/000020.png
wrong "broken/000020.png" broken
check "rows of frames.csv up to there" "$(rows x)" -eq 20
finish
