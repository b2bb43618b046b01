#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# The engine of edgevo bench: killed in the middle and called again, it gives the same table and runs no trial twice; a failed run is a
# row; a cluster (a fake sbatch that runs the job) gives the same; without the engine it does not crash.
. "$(dirname "$0")/cli_common.sh"

cat >list.yaml <<'EOF'
seeds: 1 2
variants: normal backward
sequences:
  desk:
    source: scene:desk
    frames: 0:16
EOF
# untimed FILE.csv: without the columns of times, which stand before the last one.
untimed_table() { awk -F, '!/^#/ { $(NF - 2) = $(NF - 1) = "-"; print }' OFS=, "$1" >"$1.untimed"; }
ends() { cat "$1"/workflow/jobs/desk/*/*.log 2>/dev/null | grep -c ': ended, '; }

run_code 0 "$edgevo" bench list.yaml -o whole --cores 2
check "trials that ran" "$(ends whole)" -eq 4
check "time of each job is kept" "$(ls whole/workflow/jobs/desk/*/*.time | wc -l)" -eq 4
check "the scene was rendered once" "$(ls whole/workflow/scenes/*.time | wc -l)" -eq 1
check "and its images are gone" "$(ls whole/workflow/scenes/*/clip.yaml 2>/dev/null | wc -l)" -eq 0
check "rows of the page of all runs" "$(grep -c '<tr><td class="small">' whole/report.html)" -eq 4
untimed_table whole/table.csv

# Killed when the first trial is done: the program, its engine and the running job.
"$edgevo" bench list.yaml -o killed >stdout 2>stderr </dev/null &
pid=$!
for i in $(seq 600); do [ "$(ends killed)" -ge 1 ] && break; sleep 0.1; done
kill -9 $pid
wait $pid 2>/dev/null
for process in $(grep -l -a -e "$work/killed/workflow/list.yaml" /proc/[0-9]*/cmdline 2>/dev/null | cut -d/ -f3); do
  kill -9 "$process" 2>/dev/null
done
first=$(ls killed/desk/*/*/job.yaml | head -n 1)
stamp=$(stat -c '%i %y' "$first")
check "some are still to do" "$(ls killed/desk/*/*/job.yaml | wc -l)" -lt 4
run_code 0 "$edgevo" bench list.yaml -o killed
check "finished trials did not run again" "$(stat -c '%i %y' "$first" | grep -c -x -F "$stamp")" -eq 1
check "each trial ended once" "$(ends killed)" -eq 4
untimed_table killed/table.csv
same "the table" whole/table.csv.untimed killed/table.csv.untimed
for job in whole/desk/*/seed*; do same "${job#whole/}" "$job/trajectory_tum.txt" "killed/${job#whole/}/trajectory_tum.txt"; done
run_code 0 "$edgevo" bench list.yaml -o killed
check "a third call runs nothing" "$(grep -c '^4 jobs: 0 run, 4 done before' stdout)" -eq 1

# A cluster: sbatch starts the given script and prints a number, sacct reports how it ended.
mkdir bin queue
cat >bin/sbatch <<'EOF'
#!/bin/sh
for script; do :; done
number=$(ls "$QUEUE" | wc -l)
echo RUNNING >"$QUEUE/$number"
( sh "$script" >/dev/null 2>&1 && echo COMPLETED >"$QUEUE/$number" || echo FAILED >"$QUEUE/$number" ) >/dev/null 2>&1 &
echo "$*" >>"$QUEUE.requested"
echo "$number"
EOF
cat >bin/sacct <<'EOF'
#!/bin/sh
while [ $# -gt 0 ]; do [ "$1" = -j ] && cat "$QUEUE/$2"; shift; done
EOF
chmod +x bin/*
sed 's/seeds: 1 2/seeds: 1/; s/ backward//' list.yaml >one.yaml
printf '  broken:\n    source: broken\n' >>one.yaml
copy_sequence "$scenes/desk" broken 0 12
rm broken/images/000010.png
printf x >broken/images/000010.png
run_code 2 env PATH="$work/bin:$PATH" QUEUE="$work/queue" "$edgevo" bench one.yaml -o cluster --profile slurm --cores 2
check "one line says what failed" "$(grep -c '^edgevo: cluster: 1 of 2 jobs are done; first failure: .*000010.png' stderr)" -eq 1
check "a failed run is a row" "$(grep -c '^| broken | normal | 0 of 1 |' cluster/table.md)" -eq 1
same "a run of the cluster" whole/desk/normal/seed1/trajectory_tum.txt cluster/desk/normal/seed1/trajectory_tum.txt
check "requests for threads and memory" "$(grep -c -e '--cpus-per-task 1 --mem 1500' queue.requested)" -eq 2

run_code 0 "$edgevo" bench list.yaml -o dry --dry-run
check "a dry run lists the jobs" "$(grep -c '^run  *4' stdout)" -eq 1
check "and runs nothing" "$(ls -d dry/desk 2>/dev/null | wc -l)" -eq 0
mkdir empty
complains "snakemake: is not installed.*install_dependencies.sh --workflow" env PATH="$work/empty" "$edgevo" bench list.yaml -o none
complains "no such profile" "$edgevo" bench list.yaml -o none --profile nowhere
printf 'seeds: 1\nsequences:\n  workflow:\n    source: scene:desk\n' >named.yaml
complains "named.yaml:4: a sequence cannot be called workflow" "$edgevo" bench named.yaml -o none
finish
