#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A street through a lens with k1 = 0.01 that the camera file does not contain: the run finds it and the scale does not drift;
# `edgevo calibrate` writes a correct camera file that other programs can use. At two thirds of the street's image size, to save time.
. "$(dirname "$0")/cli_common.sh"

sed '/^camera:/,/^motion:/{
  s/width: .*/width: 827/; s/height: .*/height: 251/; s/f\([xy]\): .*/f\1: 479.24/; s/cx: .*/cx: 404.6/; s/cy: .*/cy: 123.3/
  s/^  noise_sigma:.*/&\n  k1: 0.01/
}' "$here/../../datasets/scenes/street.yaml" >street_k1.yaml
run_code 0 "$edgevo" simulate street_k1.yaml --frames 0:130 -o clip
check "the renderer's lens has k1 0.01" "$(grep -v '^#' clip/camera.txt | awk '{ print ($5 == 0.01) }')" -eq 1
awk '!/^#/ { $5 = 0 } { print }' clip/camera.txt >pinhole.txt
run_code 0 "$edgevo" run clip --camera pinhole.txt -o run --quiet
check "the correction is applied" "$(sed -n '/^self_calibration:/,/^[a-z]/p' run/summary.yaml | grep -c 'state: "applied"')" -eq 1
below "ATE in metres (path 120 m)" "$(ate run clip)" 0.2
below "local scale: largest difference from the mean" "$(awk '/"relative"/ { d = log($2 + 0); if (d < 0) d = -d; if (d > most) most = d; ++n }
  END { if (n >= 5) print most + 0 }' eval.json)" 0.02

run_code 0 "$edgevo" calibrate run -o camera.yaml
sed 's/^/      /' stdout
k1=$(sed -n '/^distortion_coefficients:/,/data:/s/.*data: \[\([^,]*\),.*/\1/p' camera.yaml)
below "k1 found" "$k1" 0.012
below "k1 found, from below" 0.008 "$k1"
check "before and after on stdout" "$(grep -c '^  before \|^  after ' stdout)" -eq 2
check "the standard deviation on stdout" "$(grep -c 'residual k1 .* +- 0.0' stdout)" -eq 1

# With the corrected file as --camera there is nothing left to find.
run_code 0 "$edgevo" run clip --camera camera.yaml -o corrected --frames 0:12 --quiet
check "k1 of the camera file in the second run" "$(sed -n '/^camera:/,/^[a-z]*:/s/^  k1: 0.0\(0[89]\|1[01]\).*/ok/p' corrected/summary.yaml | wc -l)" -eq 1
run_code 0 "$edgevo" calibrate run --camera pinhole.txt -o other.yaml
check "--camera that the run used: the same result" "$(cmp camera.yaml other.yaml && echo same)" = same
complains "clip/camera.txt: is another camera than that of the run: points differ by up to" \
  "$edgevo" calibrate run --camera clip/camera.txt -o none.yaml

# A file whose focal length is a fifth too short, through two turns: it is corrected, and the new file has the true one.
sed '/^  k1: 0.01$/d' street_k1.yaml >street_turns.yaml
run_code 0 "$edgevo" simulate street_turns.yaml --frames 100:200 -o turns
awk '!/^#/ { $1 = 0.8 * $1; $2 = 0.8 * $2 } { print }' turns/camera.txt >short.txt
run_code 0 "$edgevo" run turns --camera short.txt -o longer --edge-map off
check "the log says so" "$(grep -c 'self-calibration: focal length .* off the file.s, corrected' stderr)" -ge 1
check "the focal length is applied" "$(grep -c '  focal: "applied"' longer/summary.yaml)" -eq 1
below "ATE in metres (path 83 m; 1.8 with camera.refine=none)" "$(ate longer turns)" 0.6
run_code 0 "$edgevo" calibrate longer -o longer.yaml
check "the focal length on stdout" "$(grep -c 'focal length .* off the file.s, by corners' stdout)" -eq 1
fx=$(sed -n '/^camera_matrix:/,/data:/s/.*data: \[\([^,]*\),.*/\1/p' longer.yaml)
below "focal length found (479)" "$fx" 520
below "focal length found, from below" 430 "$fx"

# Runs without a result of self-calibration, and folders that are no run.
complains "too short.*longer sequence" "$edgevo" calibrate corrected -o none.yaml
run_code 0 "$edgevo" run clip -o off --frames 0:12 --set camera.refine=none --quiet
complains "self-calibration was off" "$edgevo" calibrate off -o none.yaml
check "no camera file from these" "$(ls none.yaml 2>/dev/null | wc -l)" -eq 0
complains "summary.yaml: cannot be read.*folder that a finished" "$edgevo" calibrate clip -o none.yaml
sed 's/^  fx: .*/  fx: wide/' run/summary.yaml >off/summary.yaml
complains "summary.yaml:[0-9]*: camera.fx: 'wide' is not a number" "$edgevo" calibrate off -o none.yaml
grep -v '^  state:' run/summary.yaml >off/summary.yaml
complains "state of self_calibration" "$edgevo" calibrate off -o none.yaml
complains "image size is not that of the run" "$edgevo" calibrate run --camera "$scenes/desk/camera.txt" -o none.yaml
complains "no/such/camera.yaml" "$edgevo" calibrate run -o no/such/camera.yaml

# From the motion, without a board: of a hand-held camera nearly the right one; a short recording and a straight drive are refused.
sed '/^camera:/,/^motion:/{
  s/width: .*/width: 320/; s/height: .*/height: 240/; s/fx: .*/fx: 258.65/; s/fy: .*/fy: 258.25/; s/cx: .*/cx: 159.05/; s/cy: .*/cy: 127.4/
}' "$here/../../datasets/scenes/desk.yaml" >hand.yaml
run_code 0 "$edgevo" simulate hand.yaml --frames 0:220 -o hand
run_code 0 "$edgevo" calibrate hand --from-motion -o found.yaml
check "a line a round" "$(grep -c '^round [0-9]*: focal length .* px +- .* keyframes' stdout)" -ge 2
check "standard deviations" "$(grep -c '^f .* +- .* px, cx .* k1 .* (one standard deviation)' stdout)" -eq 1
below "error of the focal length in per cent" "$(sed -n 's/^f \([0-9.]*\) .*/\1/p' stdout | awk '{ d = 100 * ($1 / 258.65 - 1); print d < 0 ? -d : d }')" 4
run_code 0 "$edgevo" run hand --camera found.yaml -o by_found --quiet
complains "hand: makes no map of 20 keyframes" "$edgevo" calibrate hand --from-motion --frames 0:20 -o none.yaml
complains "clip: the motion does not determine the focal length" "$edgevo" calibrate clip --from-motion -o none.yaml
check "no camera file from these" "$(ls none.yaml 2>/dev/null | wc -l)" -eq 0
# The same at the start of a run; where the motion does not show it, a doubt says so.
run_code 0 "$edgevo" run hand --camera auto -o by_auto
check "what it is and rests on" "$(grep -c 'camera: found, f .* px (by the motion over .* keyframes, +- .* %; k1 ' stderr)" -eq 1
below "error of the focal length in per cent" "$(sed -n 's/^  fx: //p' by_auto/summary.yaml | awk '{ d = 100 * ($1 / 258.65 - 1); print d < 0 ? -d : d }')" 4
run_code 0 "$edgevo" run hand --camera by_auto/camera.yaml -o by_file --quiet
same "trajectory with the camera file that was written" by_auto/trajectory_tum.txt by_file/trajectory_tum.txt
run_code 0 "$edgevo" run clip --camera auto --frames 0:12 -o assumed
check "the doubt" "$(grep -c '^WARNING: Input, camera: assumed, f .* not observable: .*It is a guess' stderr)" -eq 1
check "no camera file of a guess" "$(ls assumed/camera.yaml 2>/dev/null | wc -l)" -eq 0
complains "camera:0 cannot be played again; record it first" "$edgevo" run camera:0 --camera auto -o none

# From images of a board, seen by a camera of 400 px without a lens from twelve sides (more: tests/unit/calibration).
awk 'BEGIN { print "P2 288 216 255"
  for (y = 0; y < 216; ++y) for (x = 0; x < 288; ++x) { i = int(x / 24); j = int(y / 24)
    print (i > 0 && i < 11 && j > 0 && j < 8 && (i + j) % 2 == 0) ? 25 : 230 } }' >board.pgm
# view YAW PITCH X Y Z: projections of the four corners of the picture.
view() {
  awk -v a="$1" -v b="$2" -v tx="$3" -v ty="$4" -v tz="$5" 'BEGIN { a *= 0.0174533; b *= 0.0174533
    for (k = 0; k < 4; ++k) { X = k % 2 ? 288 : 0; Y = k > 1 ? 216 : 0; x = (X - 144) / 800; y = (Y - 108) / 800
      p = x * cos(a) + y * sin(b) * sin(a) + tx; q = y * cos(b) + ty; r = -x * sin(a) + y * sin(b) * cos(a) + tz
      printf "%d,%d %.4f,%.4f ", X, Y, 400 * p / r + 240, 400 * q / r + 180 } }'
}
mkdir board
while read -r name pose; do
  convert-im6.q16 board.pgm -virtual-pixel background -background gray45 -define distort:viewport=480x360+0+0 \
    -distort Perspective "$(view $pose)" -colorspace Gray "board/$name.png"
done <<END
a -30 -28 0 0 0.5
b 0 -28 0.02 0 0.5
c 30 -25 0 0.03 0.5
d -32 2 0.05 0 0.45
e 2 1 -0.03 0 0.45
f 30 0 -0.02 0.02 0.45
g -28 28 0 0.02 0.5
h 3 30 0.02 -0.02 0.5
i 28 26 0 0 0.5
j -15 10 -0.12 -0.07 0.6
k 15 -10 0.12 0.08 0.6
l -10 -15 0.12 -0.08 0.6
END
run_code 0 "$edgevo" calibrate board --chessboard 9x6 -o board.yaml
sed 's/^/      /' stdout
check "the residuals of all lenses" "$(grep -c '^residuals by lens: plumb_bob [0-9.]* px, fisheye [0-9.]* px, rational [0-9.]* px' stdout)" -eq 1
below "difference of the focal length from 400 px" "$(sed -n 's/^fx \([0-9.]*\) .*/\1/p' stdout | awk '{ d = $1 - 400; print d < 0 ? -d : d }')" 4
check "the picture of its residuals" "$(convert-im6.q16 board.png -format %w info:)" -eq 1000
run_code 0 "$edgevo" info board --camera board.yaml
run_code 0 "$edgevo" calibrate board --chessboard 9x6 --model fisheye --format kalibr -o fisheye.yaml
check "a camchain of Kalibr" "$(grep -c 'distortion_model: equidistant' fisheye.yaml)" -eq 1
"$edgevo" info fisheye.yaml >info.txt || fail "info on the camchain"
check "its lens" "$(grep -c '^distortion .*kannala_brandt' info.txt)" -eq 1
complains "model.*fish" "$edgevo" calibrate board --chessboard 9x6 --model fish -o none.yaml
# Photos of another size are skipped and named; without a size that most have nothing is chosen.
cp -r board mixed
for name in a g; do convert-im6.q16 "board/$name.png" -extent 481x360 "mixed/$name.png"; done
run_code 0 "$edgevo" calibrate mixed --chessboard 9x6 -o mixed.yaml
check "the line that names them" "$(grep -c '^skipped: 2 of 12 images, which are not 480x360: a.png (481x360), g.png (481x360)' stdout)" -eq 1
below "focal length without them, difference from 400 px" "$(sed -n 's/^fx \([0-9.]*\) .*/\1/p' stdout | awk '{ d = $1 - 400; print d < 0 ? -d : d }')" 6
for name in b c d e; do convert-im6.q16 "board/$name.png" -extent 481x360 "mixed/$name.png"; done
complains "the images: have several sizes, none that of most: 6 of 481x360, 6 of 480x360" "$edgevo" calibrate mixed --chessboard 9x6 -o none.yaml
complains "the board is in none of 12 images; check its size" "$edgevo" calibrate "$scenes/desk/images" --chessboard 9x6 --every 5 -o none.yaml
complains "chessboard 9: is not COLUMNSxROWS" "$edgevo" calibrate "$scenes/desk/images" --chessboard 9 -o none.yaml
complains "dictionary 4x4_5: is unknown; did you mean 4x4_50" "$edgevo" calibrate "$scenes/desk/images" --charuco 7x5 --square 0.03 --marker 0.02 \
  --dictionary 4x4_5 -o none.yaml
check "no camera file from these" "$(ls none.yaml none.png 2>/dev/null | wc -l)" -eq 0
finish
