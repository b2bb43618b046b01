#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the runs that the trust in a frame is fitted to: trust_corpus.py EDGEVO DATA OUT [--tier N] [--jobs N].

EDGEVO: the program. DATA: the folder of the real sequences (datasets/README.md). OUT: one folder a run, the changed
sequences under OUT/data, and OUT/runs.txt, the list that edgevo_fit_trust reads: run folder, ground truth, camera.
The corpus contains failures on purpose: skipped frames, changed and extreme light, blur, a wrong focal length, few
points, own parts in view, traffic, and a camera that stands while a bus crosses. Runs that are there already are kept,
so that a stopped corpus goes on where it was.
"""
import argparse
import collections
import concurrent.futures
import fnmatch
import math
import os
import shutil
import subprocess
import sys
import threading

# Folder of DATA, or a rendered scene, and the camera that took it: what is excluded together to evaluate the fit.
REAL = {'kitti00': ('kitti00_first300', 'kitti'), 'kitti05': ('kitti05_first300', 'kitti'),
        'kitti02': ('kitti02_first300', 'kitti'), 'karlsruhe': ('karlsruhe_0019', 'karlsruhe'),
        'fr1_xyz': ('tum_fr1_xyz_first500', 'kinect'), 'fr1_rpy': ('tum_fr1_rpy_first400', 'kinect'),
        'colon': ('colon_00_first1000', 'endoscope')}
RENDERED = {'street': ('street', None, 'rendered_car'), 'desk': ('desk', None, 'rendered_hand'),
            'lakeshore': ('lakeshore', None, 'rendered_boat'), 'corridor': ('corridor', None, 'rendered_robot'),
            'rotation': ('rotation', None, 'rendered_robot'), 'corridor4': ('corridor', 4, 'rendered_robot'),
            'corridor5': ('corridor', 5, 'rendered_robot'), 'rotation2': ('rotation', 2, 'rendered_robot'),
            'desk4': ('desk', 4, 'rendered_hand')}
# Sequences with a reference of fewer frames, in the folder of --cases: folder, source in it, its options, camera, frames
# that the reference is of use for. They have no changes.
CASES = {'phone': ('phone_over_desk', 'video.mp4', ['--camera', 'camera.txt'], 'phone', None),
         'wide_endoscope': ('endoscope_wide', '', [], 'wide_endoscope', 86)}
# What `edgevo overlay` pastes over a sequence: options; the frames are numbered from the first that is used.
OVERLAYS = {'plain20': ['--own-part', 'plain', '--part-share', '0.2'],
            'gripper20': ['--own-part', 'gripper', '--part-share', '0.2'],
            'dashboard30': ['--own-part', 'dashboard', '--part-share', '0.3'],
            'lorry300': ['--vehicle-ahead', '300'], 'lorry400': ['--vehicle-ahead', '400'],
            'oncoming': ['--traffic', 'oncoming'], 'overtaking': ['--traffic', 'overtaking'],
            'standing': ['--standing', '80', '--stop-at', '60', '--crossing', '900']}
ROAD = ('kitti00', 'kitti05', 'kitti02', 'karlsruhe', 'street')  # what has traffic
# Rotation from the axes that the truth calls the camera's to those of the images, degrees about x, y, z (a rotation
# vector), found from directions and rotations of a run over ten frames each. Its lever arm is left: in slow turns that
# truth calls some motions wrong that are right.
TRUTH_TURN = {'karlsruhe': (6.148, -0.537, 1.080)}
FEW_POINTS = ['--set', 'mapping.window.max_points=150']
KEPT = {'frames.csv', 'summary.yaml', 'trajectory_tum.txt', 'trajectory_live_tum.txt', 'scale.csv', 'covariances.csv'}


# Tier (the lower, the earlier it runs), variant, changes of the data, options of the run, seed.
VARIANTS = [
    (1, 'normal', [], [], 1),
    (1, 'every3', [], ['--every', '3'], 1),
    (1, 'every5', [], ['--every', '5'], 1),
    (1, 'focal80', ['focal0.8'], [], 1),
    (1, 'mixed', ['mixed'], [], 1),
    (1, 'extreme', ['mixed', 'mixed'], [], 1),
    (2, 'few_points', [], FEW_POINTS, 1),
    (2, 'normal', [], [], 2),
    (2, 'every4', [], ['--every', '4'], 2),
    (2, 'every8', [], ['--every', '8'], 1),
    (2, 'every3', [], ['--every', '3'], 2),
    (2, 'mixed_every3', ['mixed'], ['--every', '3'], 1),
    (2, 'focal120', ['focal1.2'], [], 1),
    (2, 'blur', ['blur'], [], 1),
    (2, 'backward', ['backward'], [], 1),
    (2, 'plain20', ['plain20'], [], 1),
    (2, 'gripper20', ['gripper20'], [], 1),
    (2, 'dashboard30', ['dashboard30'], [], 1),
    (2, 'lorry300', ['lorry300'], [], 1),
    (2, 'lorry400', ['lorry400'], [], 1),
    (2, 'oncoming', ['oncoming'], [], 1),
    (2, 'overtaking', ['overtaking'], [], 1),
    (2, 'standing', ['standing'], [], 1),
    (3, 'normal', [], [], 3),
    (3, 'every6', [], ['--every', '6'], 2),
    (3, 'every3', [], ['--every', '3'], 3),
    (3, 'mixed', ['mixed'], [], 2),
    (3, 'extreme', ['mixed', 'mixed'], [], 2),
    (3, 'extreme_every3', ['mixed', 'mixed'], ['--every', '3'], 1),
    (3, 'few_points_every3', [], FEW_POINTS + ['--every', '3'], 1),
]


MAKING = collections.defaultdict(threading.Lock)  # a changed sequence is made by one thread, the others wait for it


def call(command):
    return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def product(a, b):
    """Of two quaternions (x, y, z, w)."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


def truth_of(name, source, data):
    """The ground truth of a sequence, its axes turned to those of the images where they differ."""
    truth = os.path.abspath(f'{source}/groundtruth_tum.txt')
    if name not in TRUTH_TURN:
        return truth
    turn = [math.radians(d) for d in TRUTH_TURN[name]]
    angle = math.sqrt(sum(t * t for t in turn))
    back = tuple(-t / angle * math.sin(angle / 2) for t in turn) + (math.cos(angle / 2),)
    turned = os.path.abspath(f'{data}/{os.path.basename(source)}.truth.txt')
    with MAKING[turned], open(turned, 'w') as out:
        for row in (r.split() for r in open(truth) if r.strip() and not r.startswith('#')):
            out.write(' '.join(row[:4] + [f'{q:.9f}' for q in product([float(q) for q in row[4:8]], back)]) + '\n')
    return turned


def link_images(source, target):
    os.makedirs(target)
    os.symlink(os.path.abspath(f'{source}/images'), f'{target}/images')
    for file in ('times.txt', 'groundtruth_tum.txt', 'camera.txt'):
        shutil.copyfile(f'{source}/{file}', f'{target}/{file}')


def scale_focal_length(source, target, factor):
    link_images(source, target)
    lines = open(f'{source}/camera.txt').read().splitlines()
    for i, line in enumerate(lines):
        if line.strip() and not line.startswith('#'):
            numbers = line.split()
            numbers[:2] = [f'{float(n) * factor:.6f}' for n in numbers[:2]]
            lines[i] = ' '.join(numbers)
    open(f'{target}/camera.txt', 'w').write('\n'.join(lines) + '\n')


def play_backward(source, target):
    """The last image first; times and poses are mirrored about the sum of the first and the last time."""
    os.makedirs(f'{target}/images')
    times = open(f'{source}/times.txt').read().split()
    mirror = float(times[0]) + float(times[-1])
    open(f'{target}/times.txt', 'w').write(''.join(f'{mirror - float(t):.6f}\n' for t in reversed(times)))
    names = sorted(os.listdir(f'{source}/images'))[:len(times)]
    for i, name in enumerate(reversed(names)):
        os.symlink(os.path.abspath(f'{source}/images/{name}'), f'{target}/images/{i:06d}{os.path.splitext(name)[1]}')
    shutil.copyfile(f'{source}/camera.txt', f'{target}/camera.txt')
    rows = [r.split() for r in open(f'{source}/groundtruth_tum.txt') if r.strip() and not r.startswith('#')]
    with open(f'{target}/groundtruth_tum.txt', 'w') as out:
        for row in reversed(rows):
            out.write(' '.join([f'{mirror - float(row[0]):.6f}'] + row[1:]) + '\n')


def edgevo_makes(command, name):
    done = call(command)
    if done.returncode:
        sys.exit(f'{name}: {done.stderr.strip()}')


def change_once(edgevo, name, source, target, change, seed):
    if change.startswith('focal'):
        scale_focal_length(source, target, float(change[5:]))
    elif change == 'backward':
        play_backward(source, target)
    elif change in OVERLAYS:
        edgevo_makes([edgevo, 'overlay', source, '-o', target] + OVERLAYS[change], name)
    else:
        edgevo_makes([edgevo, 'relight', source, '-o', target, '--kind', change, '--seed', str(seed)], name)


def changed(edgevo, data, name, source, changes):
    """Folder of a sequence with its changes applied one after another; each is made once."""
    for i, change in enumerate(changes):
        name += '_' + change
        target, made = f'{data}/{name}', f'{data}/{name}.made'
        with MAKING[target]:
            if not os.path.exists(made):
                shutil.rmtree(target, ignore_errors=True)
                change_once(edgevo, name, source, target, change, i + 1)
                open(made, 'w').close()
        source = target
    return source


def rendered(edgevo, data, name):
    scene, seed, _ = RENDERED[name]
    target, made = f'{data}/{name}', f'{data}/{name}.made'
    with MAKING[target]:
        if not os.path.exists(made):
            shutil.rmtree(target, ignore_errors=True)
            edgevo_makes([edgevo, 'simulate', scene, '-o', target] + (['--seed', str(seed)] if seed else []), name)
            open(made, 'w').close()
    return target


def run(edgevo, source, out, options, seed):
    """Runs the odometry and keeps the files that the fit reads."""
    if os.path.exists(f'{out}/summary.yaml'):
        return
    shutil.rmtree(out, ignore_errors=True)
    done = call([edgevo, 'run', source, '-o', out, '--quiet', '--edge-map', 'off', '--seed', str(seed)] + options)
    if not os.path.exists(f'{out}/summary.yaml'):
        print(f'{out}: no run: {done.stderr.strip()[-200:]}', flush=True)
        return
    for file in os.listdir(out):
        if file not in KEPT:
            path = f'{out}/{file}'
            shutil.rmtree(path) if os.path.isdir(path) else os.remove(path)


def is_possible(name, variant):
    """Traffic belongs on a road, and no gripper into a body."""
    if variant in ('lorry300', 'lorry400', 'oncoming', 'overtaking', 'standing'):
        return name in ROAD
    return variant not in OVERLAYS or name != 'colon'


def plan(last_tier):
    """(tier, name, camera, is real, variant) of all runs up to a tier; each variant of all sequences, then the next."""
    jobs = []
    for v in VARIANTS:
        if v[1] == 'normal':
            jobs += [(v[0], name, case[3], True, v) for name, case in CASES.items()]
        jobs += [(v[0], name, camera, True, v) for name, (_, camera) in REAL.items() if is_possible(name, v[1])]
        is_plain = v[1] in ('normal', 'every3', 'mixed')
        if v[1] in OVERLAYS:
            jobs += [(v[0], name, RENDERED[name][2], False, v) for name in ('street', 'desk') if is_possible(name, v[1])]
        elif v[4] == 1 and (is_plain or v[1] in ('every5', 'focal80', 'few_points', 'extreme')):
            jobs += [(v[0] + (1 if seed else 0), name, camera, False, v)
                     for name, (_, seed, camera) in RENDERED.items() if is_plain or not seed]
    return sorted((j for j in jobs if j[0] <= last_tier), key=lambda j: j[0])


def every(options):
    return int(options[options.index('--every') + 1]) if '--every' in options else 1


def make_case(args, name, out, camera, seed):
    """Makes the run of a case as it is; its line of runs.txt, empty if there is none or no folder of them."""
    folder, source, options, _, frames = CASES[name]
    folder = f'{args.cases}/{folder}'
    if not args.cases or args.prepare:
        return ''
    options = [f'{folder}/{o}' if o.endswith('.txt') else o for o in options]
    frames = min((n for n in (frames, args.frames) if n), default=None)
    run(args.edgevo, f'{folder}/{source}', out, options + (['--frames', f'0:{frames}'] if frames else []), seed)
    reference = os.path.abspath(f'{folder}/reference_tum.txt')
    return f'{os.path.abspath(out)} {reference} {camera}\n' if os.path.exists(f'{out}/summary.yaml') else ''


def make(args, data, job):
    """Makes the run of a job with what it needs; its line of runs.txt, empty if there is none."""
    _, name, camera, is_real, (_, variant, changes, options, seed) = job
    out = f'{args.out}/{name}.{variant}.{seed}'
    if name in CASES:
        return make_case(args, name, out, camera, seed)
    source = f'{args.data}/{REAL[name][0]}' if is_real else rendered(args.edgevo, data, name)
    source = changed(args.edgevo, data, name, source, changes)
    if args.frames:
        options = options + ['--frames', f'0:{args.frames * every(options)}']
    if not args.prepare:
        run(args.edgevo, source, out, options, seed)
    if not os.path.exists(f'{out}/summary.yaml'):
        return ''
    return f'{os.path.abspath(out)} {truth_of(name, source, data)} {camera}\n'


def is_wanted(job, patterns):
    _, name, _, _, (_, variant, _, _, seed) = job
    return not patterns or any(fnmatch.fnmatchcase(f'{name}.{variant}.{seed}', p) for p in patterns)


def check(args, jobs):
    """Ends the program where nothing could be made."""
    if not shutil.which(args.edgevo):
        sys.exit(f'{args.edgevo}: is no program; build it, and give its path')
    if not jobs:
        sys.exit('--only: matches no run of these tiers; --list prints their names')
    if not args.cases and all(name in CASES for _, name, _, _, _ in jobs):
        sys.exit('--only: these runs need the folder of --cases')
    if any(is_real and name not in CASES for _, name, _, is_real, _ in jobs) and not os.path.isdir(args.data):
        sys.exit(f'{args.data}: is no folder; see datasets/README.md for the sequences')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('edgevo')
    parser.add_argument('data')
    parser.add_argument('out')
    parser.add_argument('--tier', type=int, default=3, help='1: some 60 runs, 2: 160, 3: all')
    parser.add_argument('--cases', help='folder of phone_over_desk and endoscope_wide (default: without them)')
    parser.add_argument('--frames', type=int, help='use only the first images, so many in each run')
    parser.add_argument('--only', nargs='+', help='runs to make, NAME.VARIANT.SEED with * for any text')
    parser.add_argument('--jobs', type=int, default=1, help='runs at a time')
    parser.add_argument('--list', action='store_true', help='print the runs and end')
    parser.add_argument('--prepare', action='store_true', help='make the changed sequences only')
    args = parser.parse_args()
    jobs = [j for j in plan(args.tier) if is_wanted(j, args.only)]
    if args.list:
        for tier, name, camera, _, (_, variant, _, _, seed) in jobs:
            print(tier, name, variant, seed, camera)
        return
    check(args, jobs)
    data = f'{args.out}/data'
    os.makedirs(data, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(args.jobs) as pool:
        made = pool.map(lambda job: make(args, data, job), jobs)
        with open(f'{args.out}/runs.txt', 'w') as file:
            for line in made:
                file.write(line)
                file.flush()


if __name__ == '__main__':
    main()
