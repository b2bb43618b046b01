#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# edgevo relight: every kind, from folder and rawlog to folder and rawlog, keeps names, times, calibration, gyro and ground truth,
# and is reproducible.
. "$(dirname "$0")/cli_common.sh"

# A sequence whose numbers do not start at 0.
"$edgevo" simulate desk --frames 7:20 --gyro phone -o seq >/dev/null || fail "simulate"
"$edgevo" import seq seq.rawlog >/dev/null || fail "import"
names() { ls "$1" | cksum | cut -d' ' -f1; }
times_of() { "$edgevo" info "$1" | grep -e '^frames' -e '^duration' -e '^rate' -e '^gaps'; }
calibration_of() { "$edgevo" info "$1" | grep -e '^camera' -e '^distortion' -e '^image size'; }

# A rawlog gives the same images as a folder, whatever the kind: tested for three of them.
for kind in drift jumps gamma vignette glare blooming shadows blur noise mixed; do
  sources=seq
  case $kind in drift | noise | mixed) sources="seq seq.rawlog" ;; esac
  for from in $sources; do
    out=$kind-of-folder
    [ $from = seq ] || out=$kind-of-rawlog
    run_code 0 "$edgevo" relight $from -o "$out" --kind $kind --seed 3
    check "same names, $out" "$(names "$out/images")" -eq "$(names seq/images)"
    [ $from = seq.rawlog ] || same "gyro, $out" seq/imu.txt "$out/imu.txt"
    check "samples, $out" "$(wc -l <"$out/imu.txt")" -eq "$(wc -l <seq/imu.txt)"
    for file in times.txt camera.txt groundtruth_tum.txt; do same "$file, $out" seq/$file "$out/$file"; done
  done
  [ "$sources" = seq ] || for image in 000007 000012 000019; do
    same "image $image, $kind, folder and rawlog" $kind-of-folder/images/$image.png $kind-of-rawlog/images/$image.png
  done
  # The first jump comes after more than a second: see the unit tests.
  [ $kind = jumps ] || differ "image, $kind, before and after" seq/images/000015.png $kind-of-folder/images/000015.png
done

# Into a rawlog, twice.
times_of seq.rawlog >times_before
calibration_of seq.rawlog >calibration_before
for from in seq seq.rawlog; do
  run_code 0 "$edgevo" relight $from -o one/x.rawlog --kind mixed --seed 3
  run_code 0 "$edgevo" relight $from -o two/x.rawlog --kind mixed --seed 3
  run_code 0 "$edgevo" relight $from -o other/x.rawlog --kind mixed --seed 4
  same "rawlog of $from again" one/x.rawlog two/x.rawlog
  same "ground truth of $from" seq/groundtruth_tum.txt one/x_groundtruth_tum.txt
  check "same names in the rawlog of $from" "$(names one/x_Images)" -eq "$(names seq/images)"
  for image in 000007 000015 000019; do
    same "image $image of $from again" one/x_Images/$image.png two/x_Images/$image.png
  done
  differ "image of $from, another seed" one/x_Images/000015.png other/x_Images/000015.png
  times_of one/x.rawlog >times_relit
  same "times in the rawlog of $from" times_relit times_before
  calibration_of one/x.rawlog >calibration_relit
  same "calibration in the rawlog of $from" calibration_relit calibration_before
  rm -r one two other
done

# Dropped frames: those that are left keep name, time and every pixel.
run_code 0 "$edgevo" relight "$scenes/desk" -o dropped --kind dropped --seed 1
left=$(ls dropped/images | wc -l)
check "frames that are left" "$left" -lt "$(ls "$scenes/desk/images" | wc -l)"
check "lines of times.txt" "$(wc -l <dropped/times.txt)" -eq "$left"
for image in dropped/images/*; do cmp -s "$image" "$scenes/desk/images/$(basename "$image")" || fail "$image changed"; done
ls dropped/images | sed 's/^0*//; s/\.png$//; s/^$/0/' | while read -r n; do sed -n "$((n + 1))p" "$scenes/desk/times.txt"; done >times_left
same "times of the frames that are left" times_left dropped/times.txt

# Invalid requests.
complains "kind vignet.*did you mean.*vignette\|vignet" "$edgevo" relight seq -o x --kind vignet
complains "is its own source" "$edgevo" relight seq -o ./seq
complains "its own source" "$edgevo" relight seq.rawlog -o seq.rawlog
finish
