#!/bin/sh
# A source that breaks in the middle: one line, exit code 2, and the results of the frames before it are there.
. "$(dirname "$0")/cli_common.sh"
desk=$scenes/desk

# broken SOURCE WORDS: 20 good frames, then the fault.
broken() {
  rm -rf out
  complains "$2" "$edgevo" run "$1" -o out --quiet
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

# Rawlogs. The images lie beside them, so that the objects are small.
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

# Cut in its compressed form, the rawlog loses some of its last objects as well: what came whole is kept.
"$edgevo" import "$desk" whole.rawlog --frames 0:40 >/dev/null || fail "import"
head -c $(($(wc -c <whole.rawlog) * 9 / 10)) whole.rawlog >cut_gz.rawlog
rm -rf out
complains "cut_gz.rawlog.*the file is cut short" "$edgevo" run cut_gz.rawlog -o out --quiet
check "rows of frames.csv" "$(rows out)" -ge 20
results_kept out "$(rows out)"

# The same faults on the way into a rawlog: what came before is a rawlog that plays.
complains "images/$image: the image does not decode" "$edgevo" import text text.rawlog
run_code 0 "$edgevo" info text.rawlog --check
check "frames that came through" "$(grep -c '^frames  *20' stdout)" -eq 1
complains "images/$image: the image does not decode" "$edgevo" info text --check
finish
