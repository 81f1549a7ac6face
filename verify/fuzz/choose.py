#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""choose.py CONTROL COUNT: of the inputs in a control file of libFuzzer's merge at most COUNT that together reach most
edges, one after another, each the one that adds most (of equals the smallest). Prints their names."""
import sys

lines = open(sys.argv[1], encoding="utf-8").read().split("\n")
count = int(lines[0])
names = lines[2:2 + count]
sizes, edges = {}, {}
for line in lines[2 + count:]:
    word, *rest = line.split() or [""]
    if word == "STARTED":
        sizes[int(rest[0])] = int(rest[1])
    elif word == "FT":
        edges[int(rest[0])] = {int(feature) // 8 for feature in rest[1:]}  # 8 counts of an edge
reached, possible = set(), len(set().union(*edges.values()))
for _ in range(int(sys.argv[2])):
    if not edges:
        break
    best = max(edges, key=lambda i: (len(edges[i] - reached), -sizes[i]))
    if not edges[best] - reached:
        break
    reached |= edges.pop(best)
    print(names[best])
print(f"{len(reached)} of {possible} edges", file=sys.stderr)
