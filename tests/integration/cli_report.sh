#!/bin/sh
# report.html in a headless browser: every picture decodes, every chart has a size, nothing is wider than the window, nothing is loaded
# from elsewhere; with ground truth, without it, and for a run that saw nothing. Needs Debian's chromium, which the installer leaves out
# (300 MB); checks that need no browser are made in any case.
. "$(dirname "$0")/cli_common.sh"
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)

# probe REPORT: opens a copy that writes what it finds into attributes of its body, and leaves the page as the browser has it in ./dom.
probe() {
  sed 's|</body>|<script>addEventListener("load", () => {\
    const all = s => [...document.querySelectorAll(s)], size = e => e.getBoundingClientRect();\
    document.body.dataset.images = all("img").filter(i => i.complete \&\& i.naturalWidth > 100).length;\
    document.body.dataset.drawings = all("svg").filter(e => size(e).width > 500 \&\& size(e).height > 10).length;\
    document.body.dataset.lines = all("svg .line").filter(e => e.getTotalLength() > 20).length;\
    document.body.dataset.sections = all("section").filter(e => size(e).height > 60).length;\
    document.body.dataset.wide = document.documentElement.scrollWidth > innerWidth;\
    document.body.dataset.loaded = performance.getEntriesByType("resource").filter(r => !r.name.startsWith("data:")).length;\
  })</script></body>|' "$1" >probe.html
  timeout 120 "$browser" --headless --no-sandbox --disable-gpu --window-size=1200,900 --user-data-dir="$work/profile" \
    --dump-dom "file://$work/probe.html" >dom 2>browser.log || fail "the browser: $(tail -n 3 browser.log)"
}
found() { sed -n "s/.*<body[^>]* data-$1=\"\([^\"]*\)\".*/\1/p" dom; }
holds() { if grep -q -e "$2" "$1"; then ok "$1 says '$2'"; else fail "$1 does not say '$2'"; fi; }
alone() { check "references to other files or hosts in $1" "$(grep -c -i -E '(src|href)="[^d#]|url\(|@import|<link|<script' "$1")" -eq 0; }

run_code 0 "$edgevo" run "$scenes/street" -o street --quiet --frames 0:40
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
[ -n "$browser" ] || skip "report.html in a browser: install chromium (what needs no browser holds)"
probe street/report.html
check "pictures that the browser shows" "$(found images)" -ge 4
check "drawings" "$(found drawings)" -eq 9
check "lines in them" "$(found lines)" -ge 10
check "sections" "$(found sections)" -eq 8
check "wider than the window" "$(found wide | grep -c false)" -eq 1
check "resources loaded from elsewhere" "$(found loaded)" -eq 0
probe no_truth_out/report.html
check "pictures without ground truth" "$(found images)" -ge 4
check "drawings without ground truth" "$(found drawings)" -eq 9
probe black_out/report.html
check "sections of a run that saw nothing" "$(found sections)" -ge 6
check "pictures of a run that saw nothing" "$(found images)" -eq 0
finish
