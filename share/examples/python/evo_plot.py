# SPDX-License-Identifier: BSD-3-Clause
"""Error of a run against ground truth, computed and drawn by evo.

    evo_plot.py SOURCE GROUNDTRUTH.txt OUT.png

Needs evo (pip install evo); exit code 77 without it.
"""

import sys

import edgevo


def main(arguments: list[str]) -> int:
    if len(arguments) != 3:
        print(__doc__)
        return 2
    source, truth_file, picture = arguments
    try:
        from evo.core import metrics, sync
        from evo.tools import file_interface, plot
    except ImportError:
        print("SKIPPED: evo is not installed; pip install evo", file=sys.stderr)
        return 77
    import matplotlib.pyplot as plt

    run = edgevo.run(source)
    truth, estimate = sync.associate_trajectories(file_interface.read_tum_trajectory_file(truth_file), run.to_evo())
    estimate.align(truth, correct_scale=True)
    error = metrics.APE(metrics.PoseRelation.translation_part)
    error.process_data((truth, estimate))
    print(f"ATE by evo {error.get_statistic(metrics.StatisticsType.rmse):.4f}, by edgevo "
          f"{edgevo.evaluate(run, truth_file).ate:.4f} m")
    figure = plt.figure()
    axes = plot.prepare_axis(figure, plot.PlotMode.xz)
    plot.traj(axes, plot.PlotMode.xz, truth, "--", "gray", "truth")
    plot.traj_colormap(axes, estimate, error.error, plot.PlotMode.xz, min_map=0, max_map=max(error.error))
    figure.savefig(picture)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except edgevo.InputError as error:
        sys.exit(f"evo_plot.py: {error}")
