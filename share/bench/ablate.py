#!/usr/bin/python3
"""Which rules of the method carry weight: each is taken out of every run in which it acts.

    share/bench/ablate.py run  -o OUT [--list share/bench/ablation.yaml] [--data DIR] [--cores N] [--seeds 1,2] [--rules A,B] [--most N]
    share/bench/ablate.py run  -o OUT --together A,B,...     the rules named, out all at once
    share/bench/ablate.py table -o OUT                       figures of what has run, as Markdown

Needs a build with -DEDGEVO_ABLATION=ON (--program, default build/ablation/bin/edgevo) and python3-yaml. Each run of the list is
first made with all rules, and counts how often each rule acted (core/rule.h). A rule that never acted there cannot change that
run and costs none. --most N: each rule is taken out of N runs at most, those in which it acts most, of as many sequences as may be. A call again goes on where
the last one ended.

  OUT/scenes/SCENE/                      rendered once
  OUT/base/SEQUENCE-VARIANT-SEED/        what `edgevo bench` leaves, and rules.csv: name, calls
  OUT/without/RULE/                      what `edgevo bench` leaves
  OUT/together/NUMBER/                   the same without all of rules.txt there
"""
import argparse
import csv
import filecmp
import os
import pathlib
import statistics
import subprocess
import sys

import yaml

SCENE = "scene:"


class Job:
    """One sequence under one variant with one seed."""

    def __init__(self, name, sequence, variant, seed):
        self.name, self.sequence, self.variant, self.seed = name, sequence, variant, seed

    @property
    def key(self):
        return f"{self.name}-{self.variant}-{self.seed}"

    @property
    def place(self):
        return pathlib.Path(self.name) / self.variant / f"seed{self.seed}"


class Corpus:
    """The list with its seeds, parameter files found, scenes as folders of images."""

    def __init__(self, args):
        self.args = args
        self.bench = yaml.safe_load(args.list.read_text())
        self.seeds = args.seeds or seeds_of(self.bench["seeds"])
        self.scenes = args.out / "scenes"
        for sequence in self.bench["sequences"].values():
            sequence["params"] = str((args.list.parent / sequence["params"]).resolve())
            scene = sequence["source"].removeprefix(SCENE)
            folder = self.scenes / scene if scene != sequence["source"] else args.data / scene
            sequence["source"] = str(folder.resolve())

    def render(self):
        for sequence in self.bench["sequences"].values():
            folder = pathlib.Path(sequence["source"])
            if folder.parent == self.scenes.resolve() and not folder.exists():
                subprocess.run([self.args.program, "simulate", folder.name, "-o", folder], check=True)

    def jobs(self):
        return [Job(name, {k: v for k, v in s.items() if k != "variants"}, variant, seed)
                for seed in self.seeds
                for name, s in self.bench["sequences"].items()
                for variant in s.get("variants", self.bench["variants"]).split()]


def seeds_of(text):
    first, _, last = str(text).partition("..")
    return list(range(int(first), int(last) + 1)) if last else [int(s) for s in str(text).split()]


def bench_list(jobs):
    """A list of `edgevo bench`, with the runs of `jobs` at least."""
    sequences = {}
    for job in jobs:
        sequence = sequences.setdefault(job.name, {**job.sequence, "variants": []})
        if job.variant not in sequence["variants"]:
            sequence["variants"].append(job.variant)
    seeds = sorted({job.seed for job in jobs})
    return yaml.safe_dump({"seeds": " ".join(map(str, seeds)),
                           "sequences": {n: {**s, "variants": " ".join(s["variants"])} for n, s in sequences.items()}})


def bench(args, jobs, folder, environment):
    folder.mkdir(parents=True, exist_ok=True)
    runs = folder / "list.yaml"
    runs.write_text(bench_list(jobs))
    done = subprocess.run([args.program, "bench", runs, "-o", folder, "--cores", str(args.cores)],
                          env={**os.environ, **environment}, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          check=False)
    if done.returncode != 0:
        print(f"{folder}: {done.stderr.strip().splitlines()[-1:]}", file=sys.stderr)


def run_base(args, jobs):
    for number, job in enumerate(jobs, 1):
        folder = args.out / "base" / job.key
        rules = folder / "rules.csv"
        if not rules.exists():
            bench(args, [job], folder, {"EDGEVO_WITHOUT": "", "EDGEVO_RULES": str(rules.resolve())})
        print(f"\rall rules: {number} of {len(jobs)}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)


def calls(out, job):
    path = out / "base" / job.key / "rules.csv"
    if not path.exists():
        return {}
    with path.open() as file:
        return {name: int(count) for name, count in csv.reader(file)}


def base_result(out, job):
    return out / "base" / job.key / job.place


def most_telling(args, jobs, rules):
    """Of the jobs in which `rules` acted args.most: one of each sequence in turn, from where they acted most. None: all."""
    acted = {j: sum(calls(args.out, j).get(rule, 0) for rule in rules) for j in jobs}
    turn = {}
    for job in sorted((j for j in jobs if acted[j]), key=lambda j: -acted[j]):
        turn[job] = sum(j.name == job.name for j in turn)
    return sorted(turn, key=lambda j: turn[j])[:args.most]


def run_without(args, jobs, rules, folder):
    """The runs in which one of `rules` acted, without them."""
    acting = most_telling(args, jobs, rules)
    if acting:
        bench(args, acting, folder, {"EDGEVO_WITHOUT": ",".join(rules), "EDGEVO_RULES": ""})


def run_command(args):
    corpus = Corpus(args)
    corpus.render()
    jobs = corpus.jobs()
    run_base(args, jobs)
    if args.together:
        folder = args.out / "together" / str(len(args.together))
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "rules.txt").write_text("\n".join(args.together) + "\n")
        run_without(args, jobs, args.together, folder)
        return
    names = args.rules or sorted({name for j in jobs for name in calls(args.out, j)})
    # Every rule on one seed before any rule on the next: a call that is cut short has looked at all of them.
    for seed in corpus.seeds:
        for number, name in enumerate(names, 1):
            run_without(args, [j for j in jobs if j.seed == seed], [name], args.out / "without" / name)
            print(f"\rseed {seed}, rules: {number} of {len(names)}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)


def result(folder):
    path = folder / "result.yaml"
    return yaml.safe_load(path.read_text()) if path.exists() else None


def figures(out, folder, jobs, rules):
    """Counts, and ratios of ATE (without over with), of the runs in `folder` in which a rule acted."""
    acted = changed = lost_poses = 0
    ratios = []
    for job in jobs:
        here, there = base_result(out, job), folder / job.place
        with_it, without_it = result(here), result(there)
        if not with_it or not without_it or not set(rules) & calls(out, job).keys():
            continue
        acted += 1
        if filecmp.cmp(here / "trajectory_tum.txt", there / "trajectory_tum.txt", shallow=False):
            continue
        changed += 1
        lost_poses += without_it["completion_percent"] < with_it["completion_percent"]
        if with_it.get("ate_m") and without_it.get("ate_m"):
            ratios.append((without_it["ate_m"] / with_it["ate_m"], job.key))
    return acted, changed, lost_poses, sorted(ratios)


def row(args, name, folder, jobs, rules):
    acted, changed, lost_poses, ratios = figures(args.out, folder, jobs, rules)
    counts = f"| {name} | {acted} | {changed} | {lost_poses} | "
    if not ratios:
        return counts + "| | | | |"
    values = [r for r, _ in ratios]
    mean = statistics.geometric_mean(values)
    worse, better = sum(v > 1.2 for v in values), sum(v < 1 / 1.2 for v in values)
    return (counts + f"{statistics.median(values):.3f} | {mean:.3f} | {worse} | {better} | "
            f"{ratios[-1][1]} {ratios[-1][0]:.2f}; {ratios[0][1]} {ratios[0][0]:.2f} |")


def table_command(args):
    jobs = Corpus(args).jobs()
    print("Runs in which a rule acted, and of those the ones that end otherwise without it; ATE without over ATE with it.\n")
    print("| rule out | acted | changed | fewer poses | median ratio | mean ratio | > 1.2 | < 1/1.2 | most, least |")
    print("|---|---|---|---|---|---|---|---|---|")
    for folder in sorted((args.out / "without").glob("*")):
        print(row(args, folder.name, folder, jobs, [folder.name]))
    for folder in sorted((args.out / "together").glob("*")):
        rules = (folder / "rules.txt").read_text().splitlines()
        print(row(args, f"{len(rules)} together", folder, jobs, rules))


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
        command.add_argument("--cores", type=int, default=1)
        command.add_argument("--seeds", type=lambda t: [int(s) for s in t.split(",")])
        command.add_argument("--most", type=int)
        command.add_argument("--rules", type=lambda t: t.split(","))
        command.add_argument("--together", type=lambda t: t.split(","))
    args = parser.parse_args()
    args.call(args)


if __name__ == "__main__":
    main()
