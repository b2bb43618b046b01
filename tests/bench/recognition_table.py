#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Adds up what recognise_places writes: recognition_table.py NAME=FILE.csv ... prints a row for each name.

A query is right if its pose is within 2 % of the median depth and 2 degrees of the truth, near within 5 %,
wrong beyond, or if the map is of another place. AP: area under precision over recall, ranked by the edges'
false alarms; R100: recall where the first wrong one comes."""
import csv
import math
import sys


def is_within(row, share):
    return row["is_proved"] == "1" and 0 <= float(row["off"]) <= share and float(row["off_deg"]) <= 2


def shows_place(row):  # within a tenth of the depth and ten degrees: what corners can be found again from
    return 0 <= float(row["by_path_m"]) <= 0.2 and float(row["by_path_deg"]) <= 10


def best_of(rows):
    proved = [r for r in rows if r["is_proved"] == "1"]
    return min(proved, key=lambda r: float(r["edges"])) if proved else None


def average_precision(ranked, count):
    right = area = 0
    at_full = None
    for n, is_right in enumerate(ranked, 1):
        right += is_right
        if is_right:
            area += right / n
        elif at_full is None:
            at_full = right
    return (area / count, (right if at_full is None else at_full) / count) if count else (math.nan, math.nan)


def table_row(name, path):
    queries = {}
    for row in csv.DictReader(open(path)):
        queries.setdefault(row["query"], []).append(row)
    best = [best_of(rows) for rows in queries.values()]
    found = [b for b in best if b]
    right = sum(is_within(b, 0.02) for b in found)
    near = sum(is_within(b, 0.05) for b in found) - right
    nominated = sum(any(shows_place(r) for r in rows) for rows in queries.values())
    ranked = sorted(found, key=lambda b: float(b["edges"]))
    ap, full = average_precision([is_within(b, 0.05) for b in ranked], len(queries))
    by_corners = [min(rows, key=lambda r: float(r["corners"])) for rows in queries.values()]
    corners = sum(float(r["corners"]) < -3 for r in by_corners)
    wrong = [b for b in found if not is_within(b, 0.05)]
    n = len(queries)
    print(f"{name:34} {n:6} {100 * nominated / n:6.1f} {100 * corners / n:6.1f} {100 * right / n:6.1f} "
          f"{100 * near / n:6.1f} {len(wrong):5} {ap:6.3f} {full:6.3f}")
    for b in wrong[:5]:
        print("    wrong:", b["query"], b["place"], b["corners"], b["edges"], "off", b["off"], b["off_deg"])


def main():
    print(f"{'':34} {'number':>6} {'nomin.':>6} {'corner':>6} {'right':>6} {'near':>6} {'wrong':>5} {'AP':>6} {'R100':>6}")
    for argument in sys.argv[1:]:
        name, path = argument.rsplit("=", 1)
        table_row(name, path)


if __name__ == "__main__":
    main()
