#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The paper's tables on short lists: its figures next to ours, as text, CSV and HTML; missing sequences have a row of their own.
. "$(dirname "$0")/cli_common.sh"

cat >lake.yaml <<'LIST'
seeds: 1..10
variants: normal every3
sequences:
  winter:
    source: scene:lakeshore:winter
    frames: 0:36
LIST
run_code 0 "$edgevo" table 1 --list lake.yaml --trials 2 -o out
sed 's/^/      /' stdout
check "the paper's rows" "$(grep -c '^| paper: ' out/table1.md)" -eq 6
check "a figure of the paper's" "$(grep -c '^| paper: DSO | 14.2 | 17.4 | 9.3 | 14.7 | 2.5 | 7.7 | 15.9 | 21.7 | 19.9 |' out/table1.md)" -eq 1
check "our row" "$(grep -c '^| \*\*edgevo, canny, rendered\*\* |' out/table1.md)" -eq 1
check "trials and spread" "$(grep -c '^- trials: 2 of each, seeds 1 2; .*least..most' out/table1.md)" -eq 1
check "differences are listed below" "$(grep -c '^What differs from the paper.s setting' out/table1.md)" -eq 1
csv() { awk -F, -v row="$2" -v name="$3" '/^method/ { for (i = 1; i <= NF; ++i) if ($i == name) c = i } index($0, row) == 1 || index($0, "\"" row) == 1 { print }' "$1"; }
check "our row in the CSV" "$(csv out/table1.csv 'edgevo' x | wc -l)" -eq 1
check "our row in the page" "$(grep -c '<tr class="own"><td>edgevo, canny, rendered</td>' out/table1.html)" -eq 1
cp out/table1.md first.md
run_code 0 "$edgevo" table 1 --list lake.yaml --trials 2 -o out
same "table of a second call, which runs nothing" first.md out/table1.md

# Surveys of the user are added, whole and every third frame, by the detectors of the list; without a map their ground truth is marked as
# coarse.
sed 's/^variants.*/&\ndetectors: edge_drawing/' lake.yaml >drawn.yaml
run_code 0 "$edgevo" simulate lakeshore --season spring --frames 0:36 --layout symphony_lake -o archive
rm -r archive/Maps
run_code 0 "$edgevo" table 1 --list drawn.yaml --seeds 3 --data archive -o surveys
check "a row of surveys" "$(grep -c '^| \*\*edgevo, edge_drawing, surveys\*\* |' surveys/table1.md)" -eq 1
check "jobs of the survey" "$(ls -d surveys/150415/normal+edge_drawing/seed3 surveys/150415/every3+edge_drawing/seed3 | wc -l)" -eq 2
check "coarse ground truth is marked" "$(grep -c '^Ground truth of 150415 is coarse' surveys/table1.md)" -eq 1

cat >kitti.yaml <<'LIST'
seeds: 1
sequences:
  kitti00:
    source: sequences/00
  desk:
    source: desk
    frames: 0:25
LIST
run_code 0 "$edgevo" table 2 --list kitti.yaml --data "$scenes" -o two
check "a missing sequence" "$(grep -c '^| 00 | 16.83 | 16.14 | 18.36 | 16.06 | 16.11 | not available |' two/table2.md)" -eq 1
check "an available sequence" "$(grep -c '^| desk | - | - | - | - | - | 0.0' two/table2.md)" -eq 1
run_code 0 "$edgevo" table 2 --list kitti.yaml --data archive -o none
check "without sequences: the figures of the paper only" "$(grep -c 'not available' none/table2.md)" -eq 2

complains "3" "$edgevo" table 3 -o out
complains "nowhere: no such folder" "$edgevo" table 2 --data nowhere -o out
complains "'x' is not a seed" "$edgevo" table 2 --seeds x --data . -o out
complains "none.yaml: cannot be read" "$edgevo" table 1 --list none.yaml -o out
finish
