# SPDX-License-Identifier: BSD-3-Clause
"""A path in a map: of a drive, back to where it began; or of an earlier one, to where that ended.

    plan.py SOURCE RADIUS OUT.txt --camera-height METRES
    plan.py SOURCE RADIUS OUT.txt --map EARLIER

The first runs SOURCE, with the height of the camera over the ground as scale. The second plans in the map of EARLIER,
the folder of a run, from where the first images of SOURCE are found in it, and says how far the camera is from the path
and from its end. The path is in the axes of that map: when places or loops move the camera, it stays where it is.

The robot is round: cells that are occupied, unknown or closer than RADIUS to an occupied one are not crossed. RADIUS
and OUT.txt (x y) are in the unit of the map, which is said.
"""

import argparse
import heapq
import pathlib
import sys
from typing import Optional

import edgevo
import numpy as np
import numpy.typing as npt

Cell = tuple[int, int]  # row, column
_Floats = npt.NDArray[np.float64]


def open_cells(grid: npt.NDArray[np.int8], cells: int) -> npt.NDArray[np.bool_]:
    """Free cells that are more than `cells` away from an occupied one."""
    near = grid == 100
    for _ in range(cells):
        grown = near.copy()
        grown[1:] |= near[:-1]
        grown[:-1] |= near[1:]
        grown[:, 1:] |= near[:, :-1]
        grown[:, :-1] |= near[:, 1:]
        near = grown
    free: npt.NDArray[np.bool_] = (grid == 0) & ~near
    return free


def nearest(is_open: npt.NDArray[np.bool_], cell: Cell) -> Cell:
    cells = np.argwhere(is_open)
    if len(cells) == 0:
        raise SystemExit("plan.py: the robot does not fit anywhere")
    row, column = cells[np.argmin(((cells - np.array(cell)) ** 2).sum(axis=1))]
    return int(row), int(column)


def neighbours(is_open: npt.NDArray[np.bool_], cell: Cell) -> list[Cell]:
    around = [(cell[0] + i, cell[1] + j) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0)]
    rows, columns = is_open.shape
    return [c for c in around if 0 <= c[0] < rows and 0 <= c[1] < columns and is_open[c]]


def shortest(is_open: npt.NDArray[np.bool_], start: Cell, goal: Cell) -> Optional[list[Cell]]:
    """A*; None: there is no path."""
    queue: list[tuple[float, float, Cell, Optional[Cell]]] = [(0.0, 0.0, start, None)]
    came_from: dict[Cell, Optional[Cell]] = {}
    while queue:
        _, length, cell, before = heapq.heappop(queue)
        if cell in came_from:
            continue
        came_from[cell] = before
        if cell == goal:
            path = [cell]
            while (previous := came_from[path[-1]]) is not None:
                path.append(previous)
            return path[::-1]
        for next_cell in neighbours(is_open, cell):
            step = length + float(np.hypot(next_cell[0] - cell[0], next_cell[1] - cell[1]))
            rest = float(np.hypot(next_cell[0] - goal[0], next_cell[1] - goal[1]))
            heapq.heappush(queue, (step + rest, step, next_cell, cell))
    return None


class Planner:
    """Paths in the map of a run."""

    def __init__(self, run: edgevo.Run, radius: float) -> None:
        self.T_map_world, self.radius = run.T_map_world, radius
        self.map = edgevo.Map(run)
        self.is_open = open_cells(self.map.grid, int(np.ceil(radius / self.map.resolution)))
        print(f"{self.map}; {self.map.unit}")

    def position(self, T_world_cam: _Floats) -> _Floats:
        """Of the camera in the axes of the map: x forward, z up."""
        in_map: _Floats = (self.T_map_world @ T_world_cam)[:3, 3]
        return in_map

    def cell_of(self, position: _Floats) -> Cell:
        column, row = ((position[:2] - self.map.origin) / self.map.resolution).astype(int)
        return nearest(self.is_open, (int(row), int(column)))

    def plan(self, start: _Floats, goal: _Floats, out: str) -> Optional[_Floats]:
        cells = shortest(self.is_open, self.cell_of(start), self.cell_of(goal))
        if cells is None:
            print(f"no path found for a robot of {2 * self.radius:g} in cells of {self.map.resolution:g}")
            return None
        path: _Floats = (np.array(cells)[:, ::-1] + 0.5) * self.map.resolution + self.map.origin
        np.savetxt(out, path, fmt="%.3f")
        at_camera = np.column_stack([path, np.full(len(path), goal[2])])
        nearest_edge = self.map.distance(at_camera).min()
        print(f"{len(path)} points; at the height of the camera {nearest_edge:.2f} from an edge")
        return path


def plan_back(arguments: argparse.Namespace) -> int:
    run = edgevo.run(arguments.source, scale=f"camera_height={arguments.camera_height}")
    if not run.is_metric:
        print(f"plan.py: no metres: {run.scale_problem}", file=sys.stderr)
        return 1
    planner = Planner(run, arguments.radius)
    poses = run.poses[~np.isnan(run.poses[:, 0, 0])]
    path = planner.plan(planner.position(poses[-1]), planner.position(poses[0]), arguments.out)
    return 0 if path is not None else 1


class Drive:
    """A drive in the map of an earlier one: where it is, and where on its path."""

    def __init__(self, arguments: argparse.Namespace) -> None:
        self.source = edgevo.open_source(arguments.source)
        self.odometry = edgevo.Odometry(self.source.camera, map=arguments.map, on_event=self.take, log=print)
        earlier = edgevo.load_run(arguments.map)
        self.planner, self.out = Planner(earlier, arguments.radius), arguments.out
        self.goal = self.planner.position(earlier.poses[~np.isnan(earlier.poses[:, 0, 0])][-1])
        self.T_world_odom: _Floats = np.eye(4)
        self.path: Optional[_Floats] = None

    def take(self, event: edgevo.Event) -> None:
        if event.kind == "placed" and event.T is not None:
            self.T_world_odom = event.T

    def follow(self, frame: edgevo.Frame) -> None:
        record = self.odometry.process(frame)
        if record.T_world_cam is None or not self.odometry.is_in_map:
            return
        position = self.planner.position(self.T_world_odom @ record.T_world_cam)
        if self.path is None:
            self.path = self.planner.plan(position, self.goal, self.out)
        if self.path is None:
            return
        away = np.linalg.norm(self.path - position[:2], axis=1)
        rest = np.linalg.norm(np.diff(self.path[away.argmin() :], axis=0), axis=1).sum()
        x, y = position[:2]
        print(f"frame {frame.index}: at {x:.2f} {y:.2f}, {away.min():.2f} from the path, {rest:.2f} to go")

    def to_the_end(self) -> int:
        for frame in self.source:
            self.follow(frame)
        if self.path is None:
            print("plan.py: the camera was not found in the map, or no path from there", file=sys.stderr)
        return 0 if self.path is not None else 1


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("source")
    parser.add_argument("radius", type=float)
    parser.add_argument("out")
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("--camera-height", type=float, metavar="METRES")
    where.add_argument("--map", metavar="EARLIER")
    arguments = parser.parse_args()
    if arguments.radius <= 0:
        parser.error("argument radius: give a length above 0")
    if not pathlib.Path(arguments.out).parent.is_dir():
        parser.error(f"argument out: {arguments.out}: its folder does not exist")
    return Drive(arguments).to_the_end() if arguments.map else plan_back(arguments)


if __name__ == "__main__":
    try:
        sys.exit(main())
    except edgevo.InputError as error:
        sys.exit(f"plan.py: {error}")
