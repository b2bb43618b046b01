#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes the pictures of the documentation from a rendered street: share/doc/pictures/make.sh [EDGEVO]
# Needs Xvfb, xdotool and ImageMagick (share/install_dependencies.sh), and chromium for the report and the map. Some minutes; no display.
#   run.gif            `edgevo run --view`: path and map from above, the frame with its edges by inverse depth (blue far, red near)
#   edge_map.png       the finished map of lines in report.html: from above, from behind, from the side
#   report.png         the upper part of report.html
#   rawlogviewer.png   RawLogViewer's "map from odometry" of playback.rawlog
#   sceneviewer.png    SceneViewer3D's first view of scene.3Dscene
#   servo.png          `edgevo servo`: the view at the start and at the end
set -eu
here=$(cd "$(dirname "$0")" && pwd)
edgevo=$(realpath "${1:-$here/../../../build/release/bin/edgevo}")
work=$(mktemp -d)
trap 'kill $xvfb 2>/dev/null || true; rm -rf "$work"' EXIT
cd "$work"

Xvfb -displayfd 3 -nolisten tcp -screen 0 1280x1000x24 3>display 2>xvfb.log &
xvfb=$!
until [ -s display ]; do kill -0 $xvfb && sleep 0.2; done
DISPLAY=:$(cat display) LIBGL_ALWAYS_SOFTWARE=1 GDK_BACKEND=x11 HOME=$work
export DISPLAY LIBGL_ALWAYS_SOFTWARE GDK_BACKEND HOME

# window TITLE: waits for a window whose title holds that regular expression, and prints its number.
window() { until xdotool search --name "$1" 2>/dev/null | tail -1 | grep .; do sleep 0.5; done; }
key() { xdotool windowfocus "$view" key "$1"; }
# The number of the frame that the window shows.
shown() { xdotool getwindowname "$view" | sed 's/.*frame \([0-9]*\).*/\1/'; }

animate() {
  "$edgevo" run street -o run --view --quiet &
  run=$!
  view=$(window '^edgevo: frame')
  key space
  until xdotool getwindowname "$view" | grep -q paused; do sleep 0.2; done
  while last=$(shown) && [ "$last" -lt 70 ]; do
    key s
    until [ "$(shown)" -gt "$last" ]; do sleep 0.1; done
    [ $((last % 2)) -eq 0 ] || import -window "$view" "frame$(printf %03d "$last").png"
  done
  key space
  wait $run
  convert-im6.q16 -delay 15 -loop 0 frame*.png -resize 520x +dither -colors 32 -layers OptimizeTransparency "$here/run.gif"
}

# small COLOURS NAME: few colours, so that a picture stays below 100 kB.
small() { convert-im6.q16 - +dither -colors "$1" "PNG8:$here/$2.png"; }

report() {
  chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --virtual-time-budget=8000 --window-size=1300,3400 \
    --screenshot=report.png "file://$work/run/report.html" 2>/dev/null
  convert-im6.q16 report.png -crop 1040x3300+130+0 +repage -resize 620x png:- | small 48 report
}

# The windows of MRPT's programs, as their test leaves them.
windows() {
  tests=$here/../../../tests/integration
  "$tests/cli_render.sh" "$edgevo" scenes
  mkdir shots
  "$tests/cli_windows.sh" "$edgevo" scenes shots
  convert-im6.q16 shots/rawlogviewer_map.png -crop 810x467+28+0 +repage png:- | small 32 rawlogviewer
  convert-im6.q16 shots/sceneviewer.png -crop 1185x940+84+26 +repage -resize 800x png:- | small 48 sceneviewer
}

servo() {
  "$edgevo" servo --latency cpu -o servo --quiet
  convert-im6.q16 servo/start.png servo/final.png +append -resize 900x png:- | small 48 servo
}

# map_from AZIMUTH ELEVATION DISTANCE: the map of run/report.html alone, degrees, times the distance at which it begins.
map_from() {
  cp run/report.html view.html
  cat >>view.html <<EOF
<script>addEventListener('load', () => {
  const map = document.querySelector('.map3d'), view = map.view, degree = Math.PI / 180;
  map.style.cssText += ';position:fixed;inset:0;z-index:9;margin:0';
  setTimeout(() => view.goTo({azimuth: $1 * degree, elevation: $2 * degree, distance: $3 * view.start.distance}), 100);
});</script>
EOF
  chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --window-size=900,700 --virtual-time-budget=4000 \
    --screenshot="view_$2.png" "file://$work/view.html" 2>/dev/null
}

three_views() {
  map_from 180 90 0.6
  map_from 235 30 0.35
  map_from 90 8 0.3
  convert-im6.q16 view_90.png view_30.png view_8.png -crop 900x490+0+66 +repage -resize 640x +dither -colors 48 \
    -append "$here/edge_map.png"
}

"$edgevo" simulate street --frames 0:75 -o street
animate
report
windows
servo
three_views
ls -l "$here"
