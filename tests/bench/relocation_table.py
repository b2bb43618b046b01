#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""How often a few images are enough to be found in an earlier map, in another light, and what a run elsewhere believes.

    relocation_table.py EDGEVO WORK NAME=SOURCE ... [--kind mixed] [--places 23] [--images 10] [--foreign]

Each SOURCE (a sequence, or scene:NAME for one that is rendered) is run once as it is and keeps its map. Then short runs begin at random
places of the same images, relit and with another seed, with --map. Right: the last pose is within 2 % of the median depth there and 2
degrees of that of the map's run; wrong: it is not, although the run says that it was found. --kind own: not relit. With --foreign the
maps are those of all other SOURCEs of the same camera instead: of other scenes, so that whatever is found is wrong. Maps and relit images
in WORK are used again."""
import argparse
import concurrent.futures
import csv
import math
import pathlib
import random
import re
import shutil
import statistics
import subprocess


class OtherCamera(Exception):
    pass


def edgevo(arguments, options):
    done = subprocess.run([options.edgevo, *map(str, arguments)], capture_output=True, text=True)
    if "was made by another camera" in done.stderr:
        raise OtherCamera
    if done.returncode not in (0, 3):
        raise SystemExit(f"edgevo {arguments[0]} {arguments[1]}: {done.stderr.strip()}")
    return done.stdout


def sequence_of(name, source, options):
    """The folder of the images; a scene is rendered once."""
    if not source.startswith("scene:"):
        return pathlib.Path(source)
    folder = options.work / name / "images"
    if not folder.exists():
        edgevo(["simulate", source[6:], "-o", folder], options)
    return folder


def relit(name, images, options):
    if options.kind == "own":
        return images
    folder = options.work / name / options.kind
    if not folder.exists():
        edgevo(["relight", images, "--kind", options.kind, "-o", folder], options)
    return folder


def kept_map(name, images, options):
    out = options.work / name / "map"
    if not (out / "summary.yaml").exists():
        edgevo(["run", images, "-o", out, "--quiet", "--force"], options)
    return out


def trajectory(path):
    """time -> (position, quaternion x y z w) of the camera in the map."""
    rows = [line.split() for line in open(path) if not line.startswith("#")]
    return {r[0]: ([float(v) for v in r[1:4]], [float(v) for v in r[4:8]]) for r in rows}


def degrees_between(a, b):
    return math.degrees(2 * math.acos(min(1.0, abs(sum(x * y for x, y in zip(a, b))))))


class Map:
    def __init__(self, name, images, options):
        self.folder = kept_map(name, images, options)
        self.poses = trajectory(self.folder / "trajectory_tum.txt")
        self.frames = list(csv.DictReader(open(self.folder / "frames.csv")))
        depths = [float(f["median_depth"]) for f in self.frames if f["median_depth"]]
        self.usual_depth = statistics.median(depths)

    def depth_at(self, index):
        at = [float(f["median_depth"]) for f in self.frames[index:index + 10] if f["median_depth"]]
        return statistics.median(at) if at else self.usual_depth

    def error(self, poses, begin):
        """(share of the median depth, degrees) of the last pose; none: no pose that both have."""
        times = [t for t in poses if t in self.poses]
        if not times:
            return math.inf, math.inf
        (p, q), (truth_p, truth_q) = poses[times[-1]], self.poses[times[-1]]
        return math.dist(p, truth_p) / self.depth_at(begin), degrees_between(q, truth_q)


def beginnings(name, frames, options):
    """Random indices with a pose of the map at each image; the same for each program."""
    posed = [int(f["index"]) for f in frames if f["segment"] != "-1"]
    ends = set(posed)
    fit = [i for i in posed if i + options.images - 1 in ends]
    return sorted(random.Random(name).sample(fit, min(options.places, len(fit))))


def locate(name, images, map_folder, begin, options):
    out = options.work / name / f"at_{begin}"
    text = edgevo(["run", images, "--frames", f"{begin}:{begin + options.images}", "--seed", 2, "--map", map_folder, "-o", out,
                   "--edge-map", "off", "--mcap", "off", "--force"], options)
    found = re.search(r"^(\d+) frames? found in ", text, re.M)
    poses = trajectory(out / "trajectory_tum.txt") if found and (out / "trajectory_tum.txt").exists() else {}
    shutil.rmtree(out, ignore_errors=True)
    return begin, bool(found), poses


def row(name, label, images, truth, map_used, options):
    begins = beginnings(name, truth.frames, options)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        done = list(pool.map(lambda b: locate(name, images, map_used.folder, b, options), begins))
    errors = [(b, *map_used.error(poses, b)) for b, found, poses in done if found]
    right = [e for e in errors if not options.foreign and e[1] <= 0.02 and e[2] <= 2]
    wrong = [e for e in errors if e not in right]
    median = [100 * statistics.median(e[1] for e in right), statistics.median(e[2] for e in right)] if right else [math.nan] * 2
    print(f"{label:28} {len(begins):6} {len(right):6} {len(wrong):6} {median[0]:8.2f} {median[1]:8.3f}", flush=True)
    for begin, share, degrees in wrong:
        print(f"    wrong: images from {begin}: {100 * share:.1f} % of the depth, {degrees:.2f} degrees", flush=True)
    return len(begins), len(right), len(wrong)


def pairs(maps, foreign):
    if not foreign:
        return [(name, name) for name in maps]
    return [(name, other) for name in maps for other in maps if other != name]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("edgevo")
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("sources", nargs="+", metavar="NAME=SOURCE")
    parser.add_argument("--kind", default="mixed")
    parser.add_argument("--places", type=int, default=23)
    parser.add_argument("--images", type=int, default=10)
    parser.add_argument("--foreign", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    sources = [s.split("=", 1) for s in options.sources]
    images = {name: sequence_of(name, source, options) for name, source in sources}
    maps = {name: Map(name, images[name], options) for name, _ in sources}
    print(f"{'':28} {'places':>6} {'right':>6} {'wrong':>6} {'median %':>8} {'degrees':>8}")
    rows = []
    for name, other in pairs(maps, options.foreign):
        label = f"{name} in {other}" if options.foreign else name
        try:
            rows.append(row(name, label, relit(name, images[name], options), maps[name], maps[other], options))
        except OtherCamera:
            continue
    print(f"{'all':28} " + " ".join(f"{sum(column):6}" for column in zip(*rows)))


if __name__ == "__main__":
    main()
