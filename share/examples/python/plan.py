# SPDX-License-Identifier: BSD-3-Clause
"""A path back to where a drive began, planned in its map.

    plan.py SOURCE CAMERA_HEIGHT RADIUS OUT.txt

Runs SOURCE with the height of the camera over the ground (metres) as scale, and plans on the grid for a round robot:
cells that are occupied, unknown or closer than RADIUS to an occupied one are not crossed. OUT.txt: x y in metres.
"""

import heapq
import sys
from typing import Optional

import edgevo
import numpy as np
import numpy.typing as npt

Cell = tuple[int, int]  # row, column


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


def main(arguments: list[str]) -> int:
    if len(arguments) != 4:
        print(__doc__)
        return 2
    source, height, radius, out = arguments[0], arguments[1], float(arguments[2]), arguments[3]
    run = edgevo.run(source, scale=f"camera_height={height}")
    if not run.is_metric:
        print(f"plan.py: no metres: {run.scale_problem}", file=sys.stderr)
        return 1
    plan_map = edgevo.Map(run)
    print(f"{plan_map}; {plan_map.unit}")

    # Positions of the camera in the axes of the map: x forward, z up.
    positions = run.poses[~np.isnan(run.poses[:, 0, 0]), :3, 3] @ run.T_map_world[:3, :3].T + run.T_map_world[:3, 3]
    is_open = open_cells(plan_map.grid, int(np.ceil(radius / plan_map.resolution)))

    def cell_of(position: npt.NDArray[np.float64]) -> Cell:
        column, row = ((position[:2] - plan_map.origin) / plan_map.resolution).astype(int)
        return nearest(is_open, (int(row), int(column)))

    path = shortest(is_open, cell_of(positions[-1]), cell_of(positions[0]))
    if path is None:
        print("no path found")
        return 1
    xy = (np.array(path)[:, ::-1] + 0.5) * plan_map.resolution + plan_map.origin
    at_camera = np.column_stack([xy, np.full(len(xy), positions[0, 2])])
    np.savetxt(out, xy, fmt="%.3f")
    print(f"{len(path)} points; at the height of the camera {plan_map.distance(at_camera).min():.2f} from an edge")
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except edgevo.InputError as error:
        sys.exit(f"plan.py: {error}")
