#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# edgevo run --view: a window that shows the frame with its edges and the map, and reacts to its keys; without a display the run continues.
. "$(dirname "$0")/cli_common.sh"
desk=$scenes/desk
frames=$(ls "$desk/images" | wc -l)
plain=$scenes/runs/desk

unset DISPLAY WAYLAND_DISPLAY
run_code 0 "$edgevo" run "$desk" -o without --view --quiet
check "lines on stderr" "$(wc -l <stderr)" -eq 1
grep -q -e '--view: there is no display (DISPLAY is not set); the run continues without a window' stderr || fail "no message about the display: $(cat stderr)"
same "trajectory without a display" "$plain/trajectory_tum.txt" without/trajectory_tum.txt
DISPLAY=:4999
export DISPLAY
run_code 0 "$edgevo" run "$desk" -o without --frames 0:10 --view --quiet
grep -q -e '--view: the display :4999 does not answer; the run continues' stderr || fail "no message about the display: $(cat stderr)"

start_display
# title: title of the window, as "frame 12 TRACKING, colour: depth (paused)".
title() { xdotool getwindowname "$window"; }
press() { xdotool windowfocus "$window" key "$1"; }
# title_becomes PATTERN: waits until it does.
title_is() { case $(title) in $1) return 0 ;; esac; return 1; }
title_becomes() { eventually title_is "$1"; }

# The whole run, with the window open: the same bytes.
"$edgevo" run "$desk" -o shown --view --quiet >said 2>&1 &
run=$!
window '^edgevo: frame'
press space
title_becomes '*(paused)'
paused=$(title)
case $paused in *TRACKING*paused* | *BOOTSTRAPPING*paused*) ok "paused: $paused" ;; *) fail "not paused: $paused" ;; esac
before=$(title | sed 's/[^0-9]*\([0-9]*\).*/\1/')
press s
title_becomes "*frame $((before + 1)) *"
# One frame further and no more: it was paused meanwhile.
check "frame after a step" "$(title | sed 's/[^0-9]*\([0-9]*\).*/\1/')" -eq $((before + 1))
for step in 2 3 4 5 6 7 8 9; do
  press s
  title_becomes "*frame $((before + step)) *" || fail "no frame $((before + step)): $(title)"
done
shows_points() {
  import -window "$window" depth.png
  [ "$(coloured depth.png 1100x495+0+405)" -ge 500 ]
}
eventually shows_points
check "coloured pixels of the points on the image" "$(coloured depth.png 1100x495+0+405)" -ge 500
check "coloured pixels of the map" "$(coloured depth.png 1100x370+0+30)" -ge 100
press c
title_becomes '*colour: residual*'
case $(title) in *"colour: residual"*) ok "coloured by residual" ;; *) fail "not coloured by residual: $(title)" ;; esac
shows_other_colours() {
  import -window "$window" residual.png
  [ "$(compare-im6.q16 -metric AE -fuzz 10% depth.png residual.png null: 2>&1)" -ge 500 ]
}
eventually shows_other_colours
check "pixels of another colour" "$(compare-im6.q16 -metric AE -fuzz 10% depth.png residual.png null: 2>&1)" -ge 500
press space
wait $run
check "exit code" $? -eq 0
same "trajectory of the shown run" "$plain/trajectory_tum.txt" shown/trajectory_tum.txt
check "output with --quiet" "$(wc -c <said)" -eq 0

# q ends the run: all results up to there.
"$edgevo" run "$desk" -o ended --view --quiet >said 2>&1 &
run=$!
window '^edgevo: frame [1-9][0-9] TRACKING'
xdotool windowfocus "$window" key q
wait $run
check "exit code" $? -eq 0
check "rows of frames.csv" "$(rows ended)" -lt "$frames"
[ -s ended/playback.rawlog ] && ok "results are there" || fail "no results"
finish
