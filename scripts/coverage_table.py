#!/usr/bin/python3
"""Lines reached by the tests, room by room, from gcovr's summary. Usage: coverage_table.py SUMMARY.json"""

import json
import sys

with open(sys.argv[1]) as file:
    files = json.load(file)["files"]
rooms = {}
for entry in files:
    top, room = entry["filename"].split("/")[:2]
    counts = rooms.setdefault(room if top == "src" else top, [0, 0])
    counts[0] += entry["line_covered"]
    counts[1] += entry["line_total"]
rooms["all"] = [sum(counts) for counts in zip(*rooms.values())]

print("| room | lines | reached | per cent |\n|---|---|---|---|")
for room, (reached, total) in rooms.items():
    print(f"| {room} | {total} | {reached} | {100 * reached / total:.1f} |")
