#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Times that cannot be right: a clock that was set back, a frame twice, two that changed places, one without a time; in a folder, a
# rawlog and a live recording. One bad time costs its frame, a clock that was set back three; nothing ends because of them.
#   cli_times.sh EDGEVO SCENES DAMAGE_TIMES [SET_BACK_CLOCK]
. "$(dirname "$0")/cli_common.sh"
damage_times=$(realpath -m "$3")
clock=${4:+$(realpath -m "$4")}
desk=$scenes/desk street=$scenes/street
copy_sequence "$desk" whole 0 40
run_code 0 "$edgevo" run whole -o whole_out --quiet
poses_of_all=$(poses whole_out)

# increasing FILE: the times of a trajectory increase.
increasing() { check "times of $1 that do not increase" "$(awk '/^[0-9]/ { if (n++ && $1 + 0 <= last) ++bad; last = $1 + 0 } END { print bad + 0 }' "$1")" -eq 0; }
# skips_bad SOURCE SKIPPED ROWS WORDS: the run has a row for each frame and SKIPPED fewer with a pose at most; rows, summary.yaml and
# closing line say what was skipped and why.
skips_bad() {
  rm -rf out
  run_code 0 "$edgevo" run "$1" -o out
  check "rows, $1" "$(rows out)" -eq "$3"
  check "skipped frames" "$(grep -c ',left.out: ' out/frames.csv)" -eq "$2"
  check "rows that say why" "$(grep -c ",left.out: .*$4" out/frames.csv)" -ge 1
  check "poses" "$(poses out)" -ge $((poses_of_all - $2))
  check "summary.yaml" "$(grep -c "left.out: .$2 frame(s)" out/summary.yaml)" -eq 1
  check "the closing line" "$(grep -c "^$2 of $3 frames skipped; the first: " stdout)" -eq 1
  check "segments" "$(awk -F, '$4 > 0' out/frames.csv | grep -c -v '^index')" -eq 0
  increasing out/trajectory_tum.txt
  increasing out/trajectory_live_tum.txt
  run_code 2 "$edgevo" run "$1" -o stopped --quiet --on-bad-frame stop
  check "line that says why it stopped" "$(grep -c '^edgevo: .*time.*; give each frame a time after' stderr)" -eq 1
  rm -rf stopped
}
# said SOURCE: `run` and `info` say beforehand that the clock was set back.
said() {
  check "run's warning" "$(grep -c '^WARNING: Input, clock: set back at frame 20' stderr_of_run)" -eq 1
  run_code 0 "$edgevo" info "$1"
  check "info's line" "$(grep -c '^clock  *set back at frame 20' stdout)" -eq 1
}

# In a folder.
damaged() { copy_sequence "$desk" "$1" 0 40 && awk "$2" whole/times.txt >"$1/times.txt"; }
damaged back 'NR > 20 { $1 = sprintf("%.7f", $1 - 0.5) } { print $1 }'
damaged twice 'NR == 21 { print last; next } { print; last = $1 }'
damaged swap 'NR == 20 { held = $1; next } NR == 21 { print; print held; next } { print }'
damaged none 'NR == 21 { print "nan"; next } { print }'
damaged zero 'NR == 21 { print "0"; next } { print }'
damaged future 'NR == 21 { print "1e6"; next } { print }'
skips_bad back 3 40 "the clock was set back by [0-9.]* s 2 frames before: from here on [0-9.]* s are added to all times"
"$edgevo" run back -o out --force >/dev/null 2>stderr_of_run
said back
# Whoever takes the offset off again has the trajectory of the times as they were written.
offset=$(sed -n 's/.*from here on \([0-9.]*\) s are added.*/\1/p' out/frames.csv | head -1)
check "poses at the times of the folder, less the offset" "$(awk -v o="$offset" 'NR == FNR { known[sprintf("%.4f", $1)] = 1; next }
  /^[0-9]/ { if (!(sprintf("%.4f", $1) in known) && !(sprintf("%.4f", $1 - o) in known)) ++odd } END { print odd + 0 }' back/times.txt out/trajectory_tum.txt)" -eq 0
skips_bad twice 1 40 "is not after the frame before"
skips_bad swap 1 40 "is not after the frame before"
skips_bad none 1 40 "it has no time"
skips_bad zero 1 40 "is not after the frame before"
skips_bad future 1 40 "is after that of the next frame"
damaged first 'NR == 1 { print "-"; next } { print }'
skips_bad first 1 40 "it has no time"
run_code 0 "$edgevo" run back -o live --quiet --realtime --pace 1x
check "rows with --realtime" "$(rows live)" -eq 40

# In a rawlog.
"$edgevo" import whole whole.rawlog >/dev/null || fail "import"
for fault in back twice swap none; do
  ln -s whole_Images r${fault}_Images
  "$damage_times" whole.rawlog r$fault.rawlog $fault || fail "damage_times $fault"
done
skips_bad rback.rawlog 3 40 "the clock was set back by"
skips_bad rtwice.rawlog 1 41 "is not after the frame before"
skips_bad rswap.rawlog 1 40 "is not after the frame before"
skips_bad rnone.rawlog 1 40 "it has no time"

# In rawlog-grabber.
[ -n "$clock" ] || finish
plugin=$(cd "$(dirname "$edgevo")/../lib" && pwd)/edgevo_mrpt_plugin.so
command -v rawlog-grabber >/dev/null || { fail "rawlog-grabber is missing; install mrpt-apps"; finish; }
mkfifo keys
# grab INI: records until the source ends; leaves the output in grabbed and the name in $rawlog.
grab() {
  rm -rf edges_*
  exec 3<>keys
  timeout --foreground 120 rawlog-grabber -p "$plugin" "$1" <&3 >grabbed 2>&1 &
  grabber=$!
  [ $# -lt 2 ] || "$2"
  wait $grabber
  check "rawlog-grabber's exit code" $? -eq 0
  exec 3<&-
  rawlog=$(ls edges_*.rawlog)
}
says() { if grep -q -e "$1" grabbed; then ok "says: $1"; else fail "no '$1' in: $(tail -5 grabbed)"; fi; }
for fault in back twice swap none; do
  sed "s|^rawlog_file = .*|rawlog_file = r$fault.rawlog|" "$here/../../share/rawlog_grabber_rawlog.ini" >edgevo.ini
  grab edgevo.ini
  says "frame .* left out: "
  says "end of the input, after 4[01] frames"
  run_code 0 "$edgevo" run "$rawlog" -o out --quiet --force
done

# A camera, whose clock is set back after a few images: all images are in the rawlog at the times that other sensors have, too. Ten
# images a second: the clock is set back by another process, which may be late.
sed "s|^process_rate = .*|process_rate = 10|; s|^image_dir_url = .*|image_dir_url = $street/images|; s|^calibration_file = .*|calibration_file = $street/camera.txt|" \
  "$here/../../share/rawlog_grabber_folder.ini" >edgevo.ini
frames=$(ls "$street/images" | wc -l)
ten_images() { [ "$(ls edges_*_Images 2>/dev/null | wc -l)" -ge 10 ]; }
set_back() { eventually ten_images && : >set_back; }
export LD_PRELOAD="$clock" EDGEVO_TEST_SET_BACK="$PWD/set_back"
grab edgevo.ini set_back
unset LD_PRELOAD EDGEVO_TEST_SET_BACK
says "left out: the clock was set back by 2[0-9.]* s"
says "after $frames frames, .* 3 left out"
run_code 0 "$edgevo" info "$rawlog"
check "images in the rawlog" "$(sed -n 's/^frames  *//p' stdout)" -eq "$frames"
run_code 0 "$edgevo" run "$rawlog" -o out --quiet --force
check "rows of the recording" "$(rows out)" -eq "$frames"
increasing out/trajectory_tum.txt
finish
