#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A source that breaks in the middle: one line, exit code 2, and the results of the earlier frames. A single bad image is skipped,
# unless --on-bad-frame stop.
. "$(dirname "$0")/cli_common.sh"
desk=$scenes/desk

# broken SOURCE WORDS: 20 good frames, then the fault.
broken() {
  rm -rf out
  complains "$2" "$edgevo" run "$1" -o out --quiet --on-bad-frame stop
  results_kept out 20
}
image=000020.png

copy_sequence "$desk" text 0 30
rm text/images/$image
echo "this is text" >text/images/$image
broken text "images/$image: the image does not decode; "

copy_sequence "$desk" cut 0 30
rm cut/images/$image
head -c 1000 "$desk/images/$image" >cut/images/$image
broken cut "images/$image: the image does not decode: .*cut short"

copy_sequence "$desk" size 0 30
rm size/images/$image
plain_image 320 240 size/images/$image.pgm
mv size/images/$image.pgm size/images/000020.pgm
broken size "000020.pgm.*the image is 320x240, but the camera model is for 640x480"

copy_sequence "$desk" times 0 30
awk 'NR == 21 { print 0.1; next } { print }' "$desk/times.txt" | head -30 >times/times.txt
broken times "frame 20.*its time 0.1000000 s is not after"

copy_sequence "$desk" gone 0 30
ln -sf /nowhere/$image gone/images/$image
broken gone "images/$image: the image"

# skips SOURCE WORDS: by default the run continues after the bad image; frames.csv and summary.yaml name it.
skips() {
  rm -rf out
  run_code 0 "$edgevo" run "$1" -o out
  check "rows, $1" "$(rows out)" -eq 30
  check "its row" "$(sed -n 22p out/frames.csv | grep -c "^20,.*,left.out: .*$2")" -eq 1
  check "rows of skipped frames" "$(grep -c ',left.out: ' out/frames.csv)" -eq 1
  check "poses after it" "$(tail -9 out/frames.csv | awk -F, '$4 >= 0' | wc -l)" -eq 9
  check "summary.yaml" "$(grep -c "left.out: .1 frame(s) .*$2" out/summary.yaml)" -eq 1
  check "the line on stdout" "$(grep -c "^1 of 30 frames skipped; the first: .*$2" stdout)" -eq 1
  check "images of the playback" "$(ls out/playback_Images | wc -l)" -eq 29
}
skips text "the image does not decode"
skips size "the image is 320x240"
skips gone "the image is missing"
skips times "its time 0.1000000 s is not after the frame before"
"$edgevo" import "$desk" bad.rawlog --frames 0:30 >/dev/null || fail "import"
cp text/images/$image bad_Images/$image
skips bad.rawlog "the image does not decode"
run_code 0 "$edgevo" run text -o out --quiet --realtime
check "rows in two threads" "$(rows out)" -eq 30
check "latency of a skipped frame" "$(sed -n 22p out/frames.csv | cut -d, -f11 | tr -d '\n' | wc -c)" -eq 0

# Rawlogs with external images, so that the objects are small.
"$edgevo" import "$desk" whole.rawlog --frames 0:20 >/dev/null || fail "import"
ln -s whole_Images tail_Images
gzip -dc <whole.rawlog >whole.raw
size=$(wc -c <whole.raw)
for name in cut_gz cut_raw unknown garbage; do ln -s whole_Images ${name}_Images; done

# Twenty whole objects and a part of the next.
{ cat whole.raw; head -c $((size / 40)) whole.raw; } >cut_raw.rawlog
broken cut_raw.rawlog "cut_raw.rawlog.*after 20 objects: the file is cut short"
# An object is written as: 0x80 + length of the name, name, version, content, 0x88.
{ cat whole.raw; printf '\232ns::CObservationOfTomorrow\000\001\002\003\210'; cat whole.raw; } | gzip >unknown.rawlog
broken unknown.rawlog "unknown.rawlog.*after 20 objects: .*unknown class 'ns::CObservationOfTomorrow'"
{ cat whole.raw; echo "garbage that goes on for a while and longer than that"; } | gzip >garbage.rawlog
broken garbage.rawlog "garbage.rawlog.*after 20 objects: "

# Truncated in its compressed form, a rawlog also loses some of its last objects; the complete ones are kept.
"$edgevo" import "$desk" whole.rawlog --frames 0:40 --force >/dev/null || fail "import"
head -c $(($(wc -c <whole.rawlog) * 9 / 10)) whole.rawlog >cut_gz.rawlog
rm -rf out
complains "cut_gz.rawlog.*the file is cut short" "$edgevo" run cut_gz.rawlog -o out --quiet
check "rows of frames.csv" "$(rows out)" -ge 20
results_kept out "$(rows out)"

# The same faults during an import: the earlier frames make a valid rawlog.
complains "images/$image: the image does not decode" "$edgevo" import text text.rawlog
run_code 0 "$edgevo" info text.rawlog --check
check "frames imported" "$(grep -c '^frames  *20' stdout)" -eq 1
complains "images/$image: the image does not decode" "$edgevo" info text --check
finish
