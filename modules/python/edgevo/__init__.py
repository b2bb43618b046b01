# SPDX-License-Identifier: BSD-3-Clause
"""Monocular edge visual odometry: numpy arrays in, numpy arrays out.

    import edgevo
    run = edgevo.run("recording.mcap")
    print(run, run.poses.shape)

Poses T_a_b are 4 x 4 matrices that take points from b to a. Camera axes: x right, y down, z forward.
"""

from . import _edgevo
from ._edgevo import (
    Camera,
    Evaluation,
    Event,
    Frame,
    InputError,
    Keyframe,
    Map,
    Odometry,
    Param,
    Record,
    Run,
    Source,
    State,
    __version__,
    evaluate,
    load_run,
    open_source,
    params,
    read_camera,
    run,
    simulate,
)

__all__ = [
    "Camera",
    "Evaluation",
    "Event",
    "Frame",
    "InputError",
    "Keyframe",
    "Map",
    "Odometry",
    "Param",
    "Record",
    "Run",
    "Source",
    "State",
    "__version__",
    "evaluate",
    "load_run",
    "open_source",
    "params",
    "read_camera",
    "run",
    "simulate",
]

# Names in messages, in help() and for pickle are those of the package.
for _name in __all__:
    if isinstance(getattr(_edgevo, _name), type):
        getattr(_edgevo, _name).__module__ = __name__
del _name
