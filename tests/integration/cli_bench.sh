#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# A small benchmark, twice: the second call runs nothing; incomplete jobs and changed lists are run again; errors in lists name the line.
. "$(dirname "$0")/cli_common.sh"

cat >list.yaml <<'EOF'
seeds: 1 7
variants: backward normal every2+glare
sequences:
  desk:
    source: scene:desk
    frames: 0:30
  recorded:
    source: desk
    frames: 0:25
    variants: normal
EOF
run_code 0 "$edgevo" bench list.yaml -o out --data "$scenes"
sed 's/^/      /' stdout
check "jobs run" "$(grep -c '^8 jobs: 8 run, 0 done before' stdout)" -eq 1
check "rows of table.csv" "$(grep -c '^desk,\|^recorded,' out/table.csv)" -eq 4
check "rows of table.md" "$(grep -c '^| desk |\|^| recorded |' out/table.md)" -eq 4
check "header of table.csv" "$(grep -c '^# \(edgevo\|machine\|trials\|parameters\): .' out/table.csv)" -eq 4
column() { awk -F, -v row="$1" -v name="$2" '/^sequence,/ { for (i = 1; i <= NF; ++i) if ($i == name) c = i }
  $1 "," $2 == row { print $c }' out/table.csv; }
below "median ATE, % of the path" "$(column desk,normal ate_percent_median)" 2
below "the same backward" "$(column desk,backward ate_percent_median)" 2
check "every second frame" "$(rows out/desk/every2+glare/seed7)" -eq 15
check "completion" "$(column recorded,normal completion_percent_median | cut -d. -f1)" -ge 80
below "the maximum over the seeds is not less than the median" "$(column desk,normal ate_m_median)" "$(column desk,normal ate_m_worst)1"

# What an input was taken for, as run says it.
mkdir ms
ln -s "$scenes/desk/images" ms/images
cp "$scenes/desk/camera.txt" ms/camera.txt
awk '{ printf "%d\n", 1000 * $1 }' "$scenes/desk/times.txt" >ms/times.txt
printf 'seeds: 7\nsequences:\n  slow:\n    source: ms\n    frames: 0:8\n' >ms.yaml
run_code 0 "$edgevo" bench ms.yaml -o ms_out --data .
check "the unit of the times is said" "$(grep -c '^edgevo: slow: times: in milliseconds' stderr)" -eq 1

# The same figures as run and eval give.
run_code 0 "$edgevo" run "$scenes/desk" --frames 0:25 --seed 7 -o single --quiet
same "trajectory of run and of bench" single/trajectory_tum.txt out/recorded/normal/seed7/trajectory_tum.txt
below "ATE of eval and of bench, their difference" "$(awk -v a="$(ate single "$scenes/desk")" -v b="$(sed -n 's/^ate_m: //p' out/recorded/normal/seed7/result.yaml)" \
  'BEGIN { print (a - b) * (a - b) }')" 1e-12

# All runs on one page: one row per job, the seeds of a variant overlaid.
run_code 0 "$edgevo" compare out -o out/compare.html
check "rows of the page" "$(grep -c '<tr><td class="small"><svg' out/compare.html)" -eq 8
check "overlays of a sequence" "$(grep -c '<h2>recorded: 2 runs with one ground truth</h2>' out/compare.html)" -eq 1
check "jobs that were compared with it" "$(grep -c '<b>8</b><span>compared with ground truth' out/compare.html)" -eq 1

cp out/table.csv first.csv
cp out/table.md first.md
run_code 0 "$edgevo" bench list.yaml -o out --data "$scenes"
check "nothing is run the second time" "$(grep -c '^8 jobs: 0 run, 8 done before' stdout)" -eq 1
same "table.csv" first.csv out/table.csv
same "table.md" first.md out/table.md

rm out/recorded/normal/seed7/job.yaml  # as after a killed job
sed 's/    frames: 0:30/    frames: 0:20/; s/seeds: .*/seeds: 7/' list.yaml >changed.yaml
run_code 0 "$edgevo" bench changed.yaml -o out --data "$scenes"
check "jobs that changed or were incomplete run again" "$(grep -c '^4 jobs: 4 run' stdout)" -eq 1

# Settings: one row for each variant without and with each setting, and the parameters in job.yaml.
printf 'seeds: 7\nset:\n  few: mapping.window.max_points=200 alignment.min_visible=50\nsequences:\n  desk:\n    source: scene:desk\n    frames: 0:25\n' >set.yaml
run_code 0 "$edgevo" bench set.yaml -o set
check "rows of a list with a setting" "$(grep -c '^desk,normal\(+few\)\?,1,0,' set/table.csv)" -eq 2
check "the table describes the setting" "$(grep -c '^# settings: few: mapping.window.max_points=200 alignment.min_visible=50' set/table.csv)" -eq 1
check "max_points by default" "$(grep -c '^ *max_points: 2000' set/desk/normal/seed7/job.yaml)" -eq 1
check "max_points as set" "$(grep -c '^ *max_points: 200$' set/desk/normal+few/seed7/job.yaml)" -eq 1
if cmp -s set/desk/normal/seed7/trajectory_tum.txt set/desk/normal+few/seed7/trajectory_tum.txt; then fail "the setting changes nothing"; fi
sed 's/max_points=200/max_points=300/' set.yaml >set2.yaml
run_code 0 "$edgevo" bench set2.yaml -o set
check "only jobs with the changed value run again" "$(grep -c '^2 jobs: 1 run, 1 done before' stdout)" -eq 1

# A broken sequence does not prevent the others from running; the table says what is missing.
copy_sequence "$scenes/desk" broken
printf 'x' >bad.png && rm broken/images/000010.png && cp bad.png broken/images/000010.png
printf 'seeds: 7\nsequences:\n  broken:\n    source: broken\n  desk:\n    source: %s\n    frames: 0:30\n' "$scenes/desk" >half.yaml
complains "1 of 2 jobs are done; first failure: .*000010.png" "$edgevo" bench half.yaml -o out
check "the table says so" "$(grep -c '^| broken | normal | 0 of 1 |' out/table.md)" -eq 1

# Interrupted: one line, a table of the jobs so far, and no job is lost or run twice.
sed 's/^seeds: .*/seeds: 1..40/' half.yaml | grep -v broken >long.yaml
"$edgevo" bench long.yaml -o cut >stdout 2>stderr </dev/null &
pid=$!
eventually sh -c 'ls cut/desk/normal/*/job.yaml >/dev/null 2>&1'
kill -TERM $pid
code=0
wait $pid || code=$?
check "exit code of an interrupted benchmark" "$code" -eq 2
check "one line about it" "$(grep -c '^edgevo: cut: interrupted: [0-9]* of 40 jobs are done; run the same command again' stderr)" -eq 1
ended=$(ls cut/desk/normal/*/job.yaml | wc -l)
check "jobs done in the table" "$(grep -c "^| desk | normal | $ended of 40 |" cut/table.md)" -eq 1
seed=$(ls -d cut/desk/normal/*/job.yaml | head -n 1 | sed 's|.*/seed||; s|/.*||')
sed "s/^seeds: .*/seeds: $seed/" long.yaml >first_job.yaml
run_code 0 "$edgevo" bench first_job.yaml -o cut
check "finished jobs do not run again" "$(grep -c '^1 jobs: 0 run, 1 done before' stdout)" -eq 1

# An engine that never ends at SIGTERM, as Snakemake 7 may when the signal meets a lock of its own.
mkdir deaf
printf '#!/bin/sh\ntrap "" TERM\ntrap "exit 1" INT\ntouch %s/waits\nwhile :; do sleep 0.1; done\n' "$work" >deaf/snakemake
chmod +x deaf/snakemake
PATH="$work/deaf:$PATH" "$edgevo" bench long.yaml -o ended >stdout 2>stderr </dev/null &
pid=$!
eventually test -e waits
kill -TERM $pid
eventually sh -c "! kill -0 $pid 2>/dev/null"
if kill -0 $pid 2>/dev/null; then
  fail "a benchmark whose engine waits for ever does not end"
  kill -KILL $pid
fi
wait $pid
check "exit code where the engine waits for ever" $? -eq 2

# The scenes of a day: the rule gives a number, which the table names and another day repeats.
printf 'scene_seed: days_since 2026-01-01\nseeds: 7\nsequences:\n  cars:\n    source: scene:parked_cars\n    frames: 0:12\n' >unseen.yaml
days=$((($(date -u +%s) - $(date -u -d 2026-01-01 +%s)) / 86400))
run_code 0 "$edgevo" bench unseen.yaml -o unseen
drawn=$(sed -n 's/^# seed of all scenes: //p' unseen/table.csv)
check "seed by the rule" "$drawn" -ge "$days"  # midnight may have passed
check "and no later" "$drawn" -le "$((days + 1))"
run_code 0 "$edgevo" bench unseen.yaml -o unseen --scene-seed "$drawn"
check "the same scene is not run again" "$(grep -c '^1 jobs: 0 run, 1 done before' stdout)" -eq 1
cp unseen/cars/normal/groundtruth_tum.txt drawn.txt
run_code 0 "$edgevo" bench unseen.yaml -o unseen --scene-seed 5
check "another scene is" "$(grep -c '^1 jobs: 1 run, 0 done before' stdout)" -eq 1
check "the table names it" "$(grep -c '^- seed of all scenes: 5$' unseen/table.md)" -eq 1
if cmp -s drawn.txt unseen/cars/normal/groundtruth_tum.txt; then fail "--scene-seed changes no scene"; fi
printf 'sequences:\n  desk:\n    source: %s\n' "$scenes/desk" >recorded.yaml
complains "--scene-seed: the list renders no scene" "$edgevo" bench recorded.yaml -o none --scene-seed 5

bad_list() {
  pattern=$1
  printf "$2" >bad.yaml
  complains "$pattern" "$edgevo" bench bad.yaml -o none
}
complains "none.yaml: cannot be read" "$edgevo" bench none.yaml -o none
bad_list "bad.yaml:3: there is no scene 'stret'\|bad.yaml:3: there is no scene" 'sequences:\n  a:\n    source: scene:stret\n'
bad_list "bad.yaml:3: there is no 'nowhere'.*--data" 'sequences:\n  a:\n    source: nowhere\n'
bad_list "bad.yaml:2: unknown variant 'glaer'; did you mean 'glare'" '# x\nvariants: normal glaer\nsequences:\n  a:\n    source: scene:desk\n'
bad_list "bad.yaml:1: 'five' is not a seed" 'seeds: five\nsequences:\n  a:\n    source: scene:desk\n'
bad_list "bad.yaml:1: 'today' is not a date" 'scene_seed: days_since today\nsequences:\n  a:\n    source: scene:desk\n'
bad_list "bad.yaml:4: unknown parameter.*did you mean 'sequences.a.source'" 'sequences:\n  a:\n    source: scene:desk\n    sourc: x\n'
bad_list "bad.yaml:3: --frames '9'.*A:B" 'sequences:\n  a:\n    source: scene:desk\n    frames: 9\n'
bad_list "bad.yaml:3: params.yaml: cannot be read" 'sequences:\n  a:\n    source: scene:desk\n    params: params.yaml\n'
bad_list "bad.yaml:2: --set mapping.windw.keyframes=9.*did you mean 'mapping.window.keyframes'" 'set:\n  a: mapping.windw.keyframes=9\nsequences:\n  a:\n    source: scene:desk\n'
check "outputs of these" "$(ls -d none 2>/dev/null | wc -l)" -eq 0
finish
