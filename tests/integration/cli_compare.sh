#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# edgevo compare: the runs that cli_render.sh left on one page, worst first, with the figures of `edgevo eval` and links to
# their own pages; folders that hold several; incomplete runs; bad input. The sorting of the table is tested in a headless browser, if
# there is one.
. "$(dirname "$0")/cli_common.sh"
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome || true)
holds() { if grep -q -e "$2" "$1"; then ok "$1 says '$2'"; else fail "$1 does not say '$2'"; fi; }
rows_of() { grep -c '<tr><td class="small">' "$1"; }

mkdir all
ln -s "$scenes/runs/street" all/linked  # links are not followed: a folder of runs may contain a link to itself
cp -R "$scenes/runs/street" all/street
cp -R "$scenes/runs/desk" "all/the desk"
run_code 0 "$edgevo" compare all -o pages/page.html
check "rows" "$(rows_of pages/page.html)" -eq 2
holds pages/page.html 'href="../all/the%20desk/report.html"'
holds pages/page.html ">$(printf '%.4f' "$(ate all/street "$scenes/street")")</td>"
check "references to other hosts" "$(grep -c -i -E 'src="[^d]|url\(|@import|<link|https?:' pages/page.html)" -eq 0

# A file of somebody else is not overwritten, an earlier page is.
echo "my notes" >notes.html
complains "notes.html: exists already and is something else; .*--force" "$edgevo" compare all -o notes.html
check "its line" "$(cat notes.html | grep -c 'my notes')" -eq 1
complains "trajectory_tum.txt: exists already" "$edgevo" compare all -o all/street/trajectory_tum.txt
run_code 0 "$edgevo" compare all -o notes.html --force
run_code 0 "$edgevo" compare all -o notes.html

run_code 0 "$edgevo" compare "$scenes/runs/street" all/street -o same.html
holds same.html '2 runs with one ground truth'
run_code 0 "$edgevo" compare all/street -o one.html --truth "$scenes/street/groundtruth_tum.txt"
check "rows of one run" "$(rows_of one.html)" -eq 1

cp -R all/street all/half
rm all/half/summary.yaml
run_code 0 "$edgevo" compare all -o half.html
check "the summary line says so" "$(grep -c '3 runs, of which 1 cannot be compared' stdout)" -eq 1
holds half.html 'is incomplete'
complains 'half: cannot be compared: .*is incomplete' "$edgevo" compare all/half -o none.html
mkdir empty
complains 'empty: holds no results of a run' "$edgevo" compare empty -o none.html
complains 'nowhere: is not a folder' "$edgevo" compare all nowhere -o none.html
complains 'no.txt: cannot be read' "$edgevo" compare all -o none.html --truth no.txt
complains 'cannot be written' "$edgevo" compare all/street -o empty
check "pages written for these" "$(ls none.html 2>/dev/null | wc -l)" -eq 0

[ "$failures" -eq 0 ] || finish
[ -n "$browser" ] || skip "the page in a browser: install chromium (all checks without a browser passed)"
cat >probe.js <<'EOF'
addEventListener("load", () => {
  const found = document.body.dataset, table = document.querySelector(".runs");
  const names = () => [...table.tBodies[0].rows].map(r => r.cells[1].dataset.value).join();
  const click = column => table.tHead.rows[0].cells[column].querySelector("button").click();
  found.first = names();
  click(1), found.up = names();
  click(1), found.down = names();
  click(4), found.ate = names();
  found.wide = document.documentElement.scrollWidth > innerWidth;
});
EOF
sed 's|</body></html>||' half.html >probe.html
{ echo '<script>'; cat probe.js; echo '</script></body></html>'; } >>probe.html
timeout 120 "$browser" --headless --no-sandbox --disable-gpu --window-size=500,900 --user-data-dir="$work/profile" \
  --dump-dom "file://$work/probe.html" >dom 2>browser.log || fail "the browser: $(tail -n 3 browser.log)"
found() { sed -n "s/.*<body[^>]* data-$1=\"\([^\"]*\)\".*/\1/p" dom; }
check "what cannot be compared comes first" "$(found first | grep -c '^half,')" -eq 1
check "sorted by name" "$(found up | grep -c '^half,street,the desk$')" -eq 1
check "the other way round" "$(found down | grep -c '^the desk,street,half$')" -eq 1
check "by error, those without one last" "$(found ate | grep -c ',half$')" -eq 1
check "wider than a narrow window" "$(found wide | grep -c false)" -eq 1
finish
