#!/usr/bin/python3
"""Which rules of the method carry weight: each is taken out of every run in which it acts.

    share/bench/ablate.py run  -o OUT [--list share/bench/ablation.yaml] [--data DIR] [--jobs N] [--seeds 1,2] [--rules A,B]
    share/bench/ablate.py run  -o OUT --together A,B,...     the rules named, out all at once
    share/bench/ablate.py table -o OUT                       figures of what has run, as Markdown

Needs a build with -DEDGEVO_ABLATION=ON (--program, default build/ablation/bin/edgevo) and python3-yaml. For each run of the list
the program first runs as it is and counts how often each rule acted (core/rule.h). A rule that never acted there cannot change
that run and costs none. A call again goes on where the last one ended.

  OUT/base/SEQUENCE-VARIANT-SEED/        what `edgevo bench` leaves, and rules.csv: name, calls
  OUT/without/RULE/SEQUENCE-VARIANT-SEED/
"""
import argparse
import concurrent.futures
import csv
import filecmp
import os
import pathlib
import statistics
import subprocess
import sys

import yaml

TOGETHER = "together"


class Job:
    """One sequence under one variant with one seed."""

    def __init__(self, name, sequence, variant, seed):
        self.name, self.sequence, self.variant, self.seed = name, sequence, variant, seed

    @property
    def key(self):
        return f"{self.name}-{self.variant}-{self.seed}"

    def result_folder(self, folder):
        return folder / self.key / self.name / self.variant / f"seed{self.seed}"

    def one_job_list(self):
        return yaml.safe_dump({"seeds": str(self.seed), "sequences": {self.name: {**self.sequence, "variants": self.variant}}})


def seeds_of(text):
    first, _, last = str(text).partition("..")
    return list(range(int(first), int(last) + 1)) if last else [int(s) for s in str(text).split()]


def jobs_of(path, only_seeds):
    bench = yaml.safe_load(path.read_text())
    seeds = only_seeds or seeds_of(bench["seeds"])
    return [Job(name, {k: v for k, v in s.items() if k != "variants"}, variant, seed)
            for seed in seeds
            for name, s in bench["sequences"].items()
            for variant in s.get("variants", bench["variants"]).split()]


def run(args, job, folder, without):
    """True where the job has ended, now or before."""
    place = folder / job.key
    if (job.result_folder(folder) / "job.yaml").exists():
        return True
    place.mkdir(parents=True, exist_ok=True)
    rules = place / "rules.csv"
    rules.unlink(missing_ok=True)
    # Parameter files are sought beside the list.
    one = args.list.parent / f".ablate-{os.getpid()}-{job.key}-{without.replace(',', '_').replace(' ', '_')}.yaml"
    one.write_text(job.one_job_list())
    environment = {**os.environ, "EDGEVO_WITHOUT": without, "EDGEVO_RULES": str(rules)}
    try:
        done = subprocess.run([args.program, "bench", one, "-o", place, "--data", args.data], env=environment,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    finally:
        one.unlink()
    if done.returncode != 0:
        print(f"{job.key} without '{without}': {done.stderr.strip().splitlines()[-1:]}", file=sys.stderr)
    return done.returncode == 0


def calls(folder, job):
    path = folder / job.key / "rules.csv"
    if not path.exists():
        return {}
    with path.open() as file:
        return {name: int(count) for name, count in csv.reader(file)}


def run_all(args, tasks, what):
    tasks = list(tasks)
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        for done, _ in enumerate(pool.map(lambda t: run(args, *t), tasks), 1):
            print(f"\r{what}: {done} of {len(tasks)}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)


def run_command(args):
    jobs = jobs_of(args.list, args.seeds)
    base = args.out / "base"
    run_all(args, ((j, base, "") for j in jobs), "as it is")
    if args.together:
        rules = set(args.together)
        acting = [j for j in jobs if rules & calls(base, j).keys()]
        run_all(args, ((j, args.out / TOGETHER, ",".join(args.together)) for j in acting), "together")
        return
    names = args.rules or sorted({name for j in jobs for name in calls(base, j)})
    # Every rule on one seed before any rule on the next: a run that is cut short has looked at all of them.
    tasks = [(j, args.out / "without" / name, name) for j in jobs for name in names if calls(base, j).get(name)]
    run_all(args, tasks, "one rule out")


def result(folder, job):
    path = job.result_folder(folder) / "result.yaml"
    return yaml.safe_load(path.read_text()) if path.exists() else None


def same_trajectory(job, a, b):
    return filecmp.cmp(job.result_folder(a) / "trajectory_tum.txt", job.result_folder(b) / "trajectory_tum.txt", shallow=False)


def figures(base, other, jobs):
    """Counts, and ratios of ATE (without over with), of the runs in `other`."""
    acted = changed = lost_poses = 0
    ratios = []
    for job in jobs:
        with_it, without_it = result(base, job), result(other, job)
        if not with_it or not without_it:
            continue
        acted += 1
        if same_trajectory(job, base, other):
            continue
        changed += 1
        lost_poses += without_it["completion_percent"] < with_it["completion_percent"]
        if with_it.get("ate_m") and without_it.get("ate_m"):
            ratios.append((without_it["ate_m"] / with_it["ate_m"], job.key))
    return acted, changed, lost_poses, sorted(ratios)


def row(name, base, folder, jobs):
    acted, changed, lost_poses, ratios = figures(base, folder, jobs)
    if not ratios:
        return f"| {name} | {acted} | {changed} | {lost_poses} | | | | |"
    values = [r for r, _ in ratios]
    worse, better = sum(v > 1.2 for v in values), sum(v < 1 / 1.2 for v in values)
    return (f"| {name} | {acted} | {changed} | {lost_poses} | {statistics.median(values):.2f} | {worse} | {better} | "
            f"{ratios[-1][1]} {ratios[-1][0]:.2f}; {ratios[0][1]} {ratios[0][0]:.2f} |")


def table_command(args):
    jobs = jobs_of(args.list, args.seeds)
    base = args.out / "base"
    print("Runs in which a rule acted, and of those the ones that end otherwise without it; ATE without over ATE with it.\n")
    print("| rule out | acted | changed | fewer poses | median ratio | > 1.2 | < 1/1.2 | most, least |")
    print("|---|---|---|---|---|---|---|---|")
    for folder in sorted((args.out / "without").glob("*")) + [args.out / TOGETHER]:
        if folder.exists():
            print(row(folder.name, base, folder, jobs))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    for name, call in (("run", run_command), ("table", table_command)):
        command = commands.add_parser(name)
        command.set_defaults(call=call)
        command.add_argument("-o", "--out", type=pathlib.Path, required=True)
        command.add_argument("--list", type=pathlib.Path, default=pathlib.Path(__file__).parent / "ablation.yaml")
        command.add_argument("--data", type=pathlib.Path, default=pathlib.Path("."))
        command.add_argument("--program", default="build/ablation/bin/edgevo")
        command.add_argument("--jobs", type=int, default=1)
        command.add_argument("--seeds", type=lambda t: [int(s) for s in t.split(",")])
        command.add_argument("--rules", type=lambda t: t.split(","))
        command.add_argument("--together", type=lambda t: t.split(","))
    args = parser.parse_args()
    args.call(args)


if __name__ == "__main__":
    main()
