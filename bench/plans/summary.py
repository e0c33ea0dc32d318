#!/usr/bin/env python3
"""Prints a table of a sweep's results.csv: a row a search, over all maps with finite heights.

    summary.py everything/results.csv [--views 45 80] [--searches pyramid "linear steps=64" ...]

For each view: the median over maps of a search's time, in milliseconds a million fragments on one
thread (search alone), of its look-ups per fragment, and of the error that 99 % of the fragments keep,
in texels; and the mean over maps of the fragments that are further off than the plan's
`wrong_texels`, in percent. Sorted by that of the last view.
"""
import argparse
import csv
import statistics
import sys


def numbers(rows, key):
    return [float(row[key]) for row in rows if row[key]]


def figures(rows):
    times = [float(row["trace_ms"]) / float(row["fragments"]) * 1e6 for row in rows]
    return (statistics.median(times), statistics.median(numbers(rows, "search_look_ups") or [0]),
            statistics.median(numbers(rows, "texels_p99")),
            100 * statistics.mean(numbers(rows, "wrong")))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results")
    parser.add_argument("--views", nargs="+", default=["45", "80"])
    parser.add_argument("--searches", nargs="+", help="all of the file, unless given")
    given = parser.parse_args()
    rows = {}
    try:
        with open(given.results, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                if not row["failed"] and row["map_kind"] != "nan":
                    rows.setdefault(row["algorithm"], {}).setdefault(row["view"], []).append(row)
    except (OSError, KeyError) as error:
        sys.exit(f"{given.results}: found {error}, expected the results.csv of a sweep")
    searches = given.searches or sorted(rows)
    for name in searches:
        if name not in rows:
            sys.exit(f"{given.results}: found no search {name}, expected one of {', '.join(sorted(rows))}")
        for view in given.views:
            if view not in rows[name]:
                views = ", ".join(sorted(rows[name]))
                sys.exit(f"{given.results}: found no view {view} of {name}, expected one of {views}")
    table = [(name, [figures(rows[name][view]) for view in given.views]) for name in searches]
    table.sort(key=lambda line: (round(line[1][-1][3], 2), line[1][-1][0]))
    heads = ["ms", "look-ups", "99 %, texels", "wrong, %"]
    print("| search | " + " | ".join(f"{head}, {view}°" for view in given.views for head in heads) + " |")
    print("|---" * (1 + len(heads) * len(given.views)) + "|")
    for name, views in table:
        cells = [f"{x:.3g}" if abs(x) >= 0.01 or x == 0 else f"{x:.0e}" for view in views for x in view]
        print(f"| `{name}` | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
