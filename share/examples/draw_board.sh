# SPDX-License-Identifier: BSD-3-Clause
# sh draw_board.sh: draws a chessboard with 9x6 inner corners from twelve sides into the folder board, in place of photographs, as seen by
# a camera with a focal length of 400 px and images of 480x360. Needs ImageMagick. Used by share/doc/tutorials/own_camera.md.
set -eu
awk 'BEGIN { print "P2 288 216 255"
  for (y = 0; y < 216; ++y) for (x = 0; x < 288; ++x) { i = int(x / 24); j = int(y / 24)
    print (i > 0 && i < 11 && j > 0 && j < 8 && (i + j) % 2 == 0) ? 25 : 230 } }' >board.pgm
view() {  # YAW PITCH X Y Z: projections of the corners of the picture
  awk -v a="$1" -v b="$2" -v tx="$3" -v ty="$4" -v tz="$5" 'BEGIN { a *= 0.0174533; b *= 0.0174533
    for (k = 0; k < 4; ++k) { X = k % 2 ? 288 : 0; Y = k > 1 ? 216 : 0; x = (X - 144) / 800; y = (Y - 108) / 800
      p = x * cos(a) + y * sin(b) * sin(a) + tx; q = y * cos(b) + ty; r = -x * sin(a) + y * sin(b) * cos(a) + tz
      printf "%d,%d %.4f,%.4f ", X, Y, 400 * p / r + 240, 400 * q / r + 180 } }'
}
mkdir -p board
while read -r name pose; do
  convert board.pgm -virtual-pixel background -background gray45 -define distort:viewport=480x360+0+0 \
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
