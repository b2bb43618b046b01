#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# report.html in a headless browser: every picture decodes and enlarges, every chart has a size and shows its values, the 3D map is
# drawn, rotates and can be picked from, nothing is wider than the window (1200 and 500 pixels), nothing is loaded from elsewhere; with
# ground truth, without it, and for a run that saw nothing. Needs Debian's chromium, which the installer does not install (300 MB);
# checks that need no browser run in any case.
. "$(dirname "$0")/cli_common.sh"
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)

# probe REPORT [WIDTH [SETTINGS]]: opens a copy that writes what it finds into attributes of its body, and leaves the page as the
# browser has it in ./dom.
cat >probe.js <<'EOF'
document.body.dataset.errors = 0;
addEventListener("error", e => { ++document.body.dataset.errors; document.body.dataset.error = e.message; });
addEventListener("load", () => {
  const all = s => [...document.querySelectorAll(s)], size = e => e.getBoundingClientRect(), found = document.body.dataset;
  const press = (e, key, more = {}) => e.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, ...more}));
  found.images = all("img").filter(i => i.complete && i.naturalWidth > 100).length;
  found.drawings = all("svg").filter(e => size(e).width > 0.7 * innerWidth && size(e).height > 10).length;
  found.lines = all("svg .line").filter(e => e.getTotalLength() > 20).length;
  found.sections = all("section").filter(e => size(e).height > 60).length;
  found.contents = all(".contents a").filter(a => document.querySelector(a.getAttribute("href"))).length;
  found.wide = document.documentElement.scrollWidth > innerWidth;
  const texts = all("section *").filter(e => e.textContent.trim() && size(e).width > 0);
  found.smallest = Math.min(...texts.map(e => parseFloat(getComputedStyle(e).fontSize)));
  found.background = getComputedStyle(document.body).backgroundColor;
  found.loaded = performance.getEntriesByType("resource").filter(r => !r.name.startsWith("data:")).length;
  for (const chart of all("[data-chart]").slice(0, 1)) {
    press(chart, "ArrowRight"), press(chart, "ArrowRight");
    found.reading = chart.querySelector("output").textContent;
    found.cursors = all(".cursor").filter(c => !c.hidden).length;
  }
  for (const button of all(".enlarge").slice(0, 1)) {
    button.click();
    found.enlarged = size(document.querySelector("dialog[open] img")).width > size(button).width;
    document.querySelector("dialog").click();
    found.dialogs = all("dialog[open]").length;
  }
  for (const {view} of all(".map3d")) {
    const bytes = () => view.context.getImageData(0, 0, view.canvas.width, view.canvas.height).data;
    const changed = act => {
      view.draw();
      const before = bytes();
      act(), view.draw();
      return bytes().some((v, i) => v !== before[i]);
    };
    view.draw();
    found.vertices = view.map.count;
    found.drawn = view.picture.pixels.reduce((n, p) => n + (p !== 0), 0);
    found.turned = changed(() => press(view.canvas, "ArrowLeft"));
    found.moved = changed(() => press(view.canvas, "ArrowUp", {shiftKey: true}));
    found.moment = view.time;
    found.joined = changed(() => view.map.kind.fill(1, 1, 50));  // lines between the first points
    found.zoomed = changed(() => press(view.canvas, "+"));
    found.recolored = ["sigma", "gray", "time"].filter(name => changed(() => view.paintWith(name))).length;
    const layers = all("[data-layer]").filter(box => size(box).width > 0);
    found.layers = layers.filter(box => changed(() => box.click())).length;
    for (const box of layers) box.click();
    view.paintWith("height");
    press(view.canvas, "0");
    const i = view.map.count >> 1;
    view.view.target = [...view.map.xyz.subarray(3 * i, 3 * i + 3)], view.view.distance *= 0.02;
    press(view.canvas, "Enter");
    found.picked = view.role("picked").textContent;
  }
});
EOF
probe() {
  sed 's|</body></html>||' "$1" >probe.html
  { echo '<script>'; cat probe.js; echo '</script></body></html>'; } >>probe.html
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --window-size="${2:-1200}",900 --blink-settings="${3:-}" \
    --user-data-dir="$work/profile" --dump-dom "file://$work/probe.html" >dom 2>browser.log ||
    fail "the browser: $(tail -n 3 browser.log)"
}
found() { sed -n "s/.*<body[^>]* data-$1=\"\([^\"]*\)\".*/\1/p" dom; }
holds() { if grep -q -e "$2" "$1"; then ok "$1 says '$2'"; else fail "$1 does not say '$2'"; fi; }
alone() { check "references to other files or hosts in $1" "$(grep -c -i -E '(src|href)="[^d#]|url\(|@import|<link|https?:' "$1")" -eq 0; }

ln -s "$scenes/runs/street" street
alone street/report.html
holds street/report.html 'ATE, Sim(3)'
holds street/report.html 'edgevo eval trajectory_tum.txt'
holds street/report.html 'canny_percentile'
holds street/report.html 'grid.yaml from above'
holds street/report.html 'free voxels'
holds street/report.html 'arbitrary'

copy_sequence "$scenes/desk" no_truth 0 40
rm no_truth/groundtruth_tum.txt
run_code 0 "$edgevo" run no_truth -o no_truth_out --quiet --scale factor=2
holds no_truth_out/report.html 'No ground truth is known'
holds no_truth_out/report.html 'metre (scale from factor'

mkdir -p black/images
cp "$scenes/desk/camera.txt" black
for i in 0 1 2 3 4; do
  plain_image 640 480 black/images/$i.pgm
  echo "0.$i" >>black/times.txt
done
run_code 3 "$edgevo" run black -o black_out --quiet
alone black_out/report.html
holds black_out/report.html 'No frame has a pose'

echo "this is no trajectory" >"$work/broken_truth.txt"
copy_sequence "$scenes/desk" broken 0 20
cp broken_truth.txt broken/groundtruth_tum.txt
run_code 0 "$edgevo" run broken -o broken_out --quiet
holds broken_out/report.html 'No comparison with ground truth: .*groundtruth_tum.txt:1'

[ "$failures" -eq 0 ] || finish
[ -n "$browser" ] || skip "report.html in a browser: install chromium (all checks without a browser passed)"
probe street/report.html
check "errors of the scripts" "$(found errors)" -eq 0
check "pictures that the browser shows" "$(found images)" -ge 4
check "drawings" "$(found drawings)" -eq 10
check "lines in them" "$(found lines)" -ge 11
check "sections" "$(found sections)" -eq 9
check "links to them" "$(found contents)" -eq 9
check "wider than the window" "$(found wide | grep -c false)" -eq 1
check "resources loaded from elsewhere" "$(found loaded)" -eq 0
check "a chart shows its values by key" "$(found reading | grep -c '^0.1 s.*estimate [0-9.-]*$')" -eq 1
check "the moment in all charts" "$(found cursors)" -eq 8
check "a picture enlarges" "$(found enlarged | grep -c true)" -eq 1
check "and closes" "$(found dialogs)" -eq 0
check "vertices of the map in 3D" "$(found vertices)" -eq "$(sed -n 's/^element vertex //p' street/edges.ply)"
check "pixels that they cover" "$(found drawn)" -ge 500
check "the frame at the moment of the charts" "$(found moment)" -eq 1
for what in turned moved zoomed joined; do check "the map is $what" "$(found $what | grep -c true)" -eq 1; done
check "colours for other values" "$(found recolored)" -eq 3
check "layers that can be hidden" "$(found layers)" -eq 5
check "a point is read" "$(found picked | grep -c \
  '^x .* m (forward, left, up); ± .* gray [0-9]*; keyframe [0-9]* (frame [0-9]*); colour: height')" -eq 1
check "a bright page" "$(found background | tr -d 'rgb( )' | cut -d, -f1)" -gt 200
probe street/report.html 500 preferredColorScheme=0
check "a dark page where that is preferred" "$(found background | tr -d 'rgb( )' | cut -d, -f1)" -lt 50
check "drawings in a narrow window" "$(found drawings)" -eq 10
check "wider than a narrow window" "$(found wide | grep -c false)" -eq 1
check "smallest text there, px" "$(found smallest | cut -d. -f1)" -ge 12
probe no_truth_out/report.html
check "pictures without ground truth" "$(found images)" -ge 4
check "drawings without ground truth" "$(found drawings)" -eq 9
check "layers without ground truth" "$(found layers)" -eq 4
probe black_out/report.html
check "errors of the scripts of a run that saw nothing" "$(found errors)" -eq 0
check "sections of a run that saw nothing" "$(found sections)" -ge 6
check "pictures of a run that saw nothing" "$(found images)" -eq 0
finish
