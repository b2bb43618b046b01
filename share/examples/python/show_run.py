# SPDX-License-Identifier: BSD-3-Clause
"""A run to look at in rerun, Foxglove or RViz.

    show_run.py SOURCE FOLDER

Opens FOLDER/run.mcap in rerun if that is installed (pip install rerun-sdk); else says how to open it.
"""

import pathlib
import shutil
import subprocess
import sys

import edgevo


def main(arguments: list[str]) -> int:
    if len(arguments) != 2:
        print(__doc__)
        return 2
    source, folder = arguments
    run = edgevo.run(source, progress=lambda done, total: print(f"\r{done} of {total}", end=""))
    run.save(folder)
    file = pathlib.Path(folder) / "run.mcap"
    print(f"\n{run}\n{file}: open it in Foxglove (foxglove.dev), or with `rerun {file}`")
    if shutil.which("rerun"):
        subprocess.Popen(["rerun", str(file)])
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except edgevo.InputError as error:
        sys.exit(f"show_run.py: {error}")
