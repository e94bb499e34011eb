"""The gate: ratios and counts that must not get worse than those in bench/expected.json."""

import json

from .machine import Failure
from .table import lines

# Ratios of processor time of systems that take turns: both suffer alike from what else the machine does.
RATIO_TOLERANCE = 0.15
COUNT_TOLERANCE = 0.02
RATIOS = [("single", "embree"), ("single", "baseline"), ("double", "single"), ("single", "instances")]
COUNTS = ["nodes_tested", "items_tested", "scene_bytes"]


def kind(report):
    return "processor" if report["machine"]["on_processor"] else report["machine"]["device"]


def rows_of(report):
    """What the gate looks at in a report: one number a row, of which less is better."""
    key = "processor" if report["machine"]["on_processor"] else "device"
    found = []
    for scene in report["scenes"]:
        for group in scene["groups"]:
            where = {"device": kind(report), "scene": scene["scene"], "group": group["group"]}
            for row in group["ratios"]:
                if (row["of"], row["to"]) in RATIOS and row[key]:
                    found.append({**where, "what": f"{row['of']} : {row['to']}, {key} time",
                                  "value": row[key]["median"], "tolerance": RATIO_TOLERANCE})
            facts = group["systems"][0]["facts"]
            for name in COUNTS:
                found.append({**where, "what": name, "value": facts[name], "tolerance": COUNT_TOLERANCE})
    return found


def name_of(row):
    return row["device"], row["scene"], row["group"], row["what"]


def read(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)["rows"]
    except FileNotFoundError:
        return []
    except (OSError, ValueError, KeyError) as why:
        raise Failure(f"{path}: {why}") from why


def renew(report, path):
    """Puts this report's numbers in place of the old ones; what it did not measure stays."""
    rows = {name_of(row): row for row in read(path)}
    for row in rows_of(report):
        old = rows.get(name_of(row))
        value = float(f"{row['value']:.4g}") if isinstance(row["value"], float) else row["value"]
        rows[name_of(row)] = {**row, "value": value, "tolerance": old["tolerance"] if old else row["tolerance"]}
    with open(path, "w", encoding="utf-8") as file:
        file.write('{\n "rows": [\n')
        file.write(",\n".join("  " + json.dumps(rows[name]) for name in sorted(rows)))
        file.write("\n ]\n}\n")


def check(report, path):
    """Prints what is worse, and all that was compared; whether nothing is worse."""
    now = {name_of(row): row["value"] for row in rows_of(report)}
    table, worse = [], 0
    for row in read(path):
        value = now.get(name_of(row))
        if value is None:
            continue
        bound = row["value"] * (1 + row["tolerance"])
        bad = value > bound
        worse += bad
        table.append([f"{row['scene']}, {row['group']}: {row['what']}", f"{row['value']:.4g}", f"{value:.4g}",
                      f"{bound:.4g}", "WORSE" if bad else ""])
    if not table:
        print(f"\nthe gate: {path} has nothing of what was measured")
        return False
    print("\nthe gate: less is better")
    print("\n".join(lines(["", "expected", "now", "at most", ""], table)))
    print(f"{worse} of {len(table)} worse")
    return worse == 0


