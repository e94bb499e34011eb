"""Measuring all that was asked for, and looking things up in what was measured (docs/schema/bench-report.schema.json)."""

import json
import os

from . import turns, whole
from .machine import Failure, Skip, describe, say

VERSION = 1


def fits(group, quick, on_processor):
    right = group.on == "" or (group.on == "processor") == on_processor
    return right and (group.quick or not quick)


def measure_scene(place, scene, options, on_processor):
    skipped, found = [], []
    path, assets = scene.make(place)
    for group in scene.groups:
        if fits(group, options.quick, on_processor):
            say(f"{scene.name}: {group.name}")
            try:
                found.append(turns.measure(place, path, assets, group, options.rounds, skipped))
            except (Skip, Failure) as why:
                skipped.append(turns.left_out(group.name, why))
    report = {"scene": scene.name, "what": scene.what, "groups": found, "whole": None, "before": None, "encoding": []}
    if found and scene.whole and not options.frames_only:
        say(f"{scene.name}: whole processes")
        first = scene.groups[0]
        jobs = [n for n in scene.whole if not (options.quick and n in ("povray", "tachyon") and scene.name != "original")]
        report["whole"] = whole.measure(place, jobs, path, assets, first, options.whole_rounds, skipped)
        if place.against and "against" in scene.whole:
            report["before"] = whole.steady_before(place, path, assets, first, options.whole_rounds, skipped)
        if scene.name == "original" and not options.quick:
            report["encoding"] = whole.encoding(place, path, assets, ["1024x768", "3840x2160"], 2)
    report["mesh_bytes"] = mesh_bytes(path, assets)
    report["skipped"] = [dict(t) for t in sorted({tuple(s.items()) for s in skipped})]
    return report


def mesh_bytes(path, assets):
    """Of a scene that reads one mesh and nothing else."""
    name = os.path.basename(path).split(".")[0] + ".obj"
    mesh = os.path.join(assets or "", name)
    return os.path.getsize(mesh) if assets and os.path.isfile(mesh) else None


def measure(place, chosen, options):
    device, on_processor = turns.probe(place)
    report = {
        "report": "glint bench",
        "version": VERSION,
        "quick": options.quick,
        "rounds": options.rounds,
        "machine": {**describe(), "device": device, "on_processor": on_processor},
        "scenes": [],
        "skipped": [],
    }
    for scene in chosen:
        try:
            report["scenes"].append(measure_scene(place, scene, options, on_processor))
        except (Skip, Failure) as why:
            report["skipped"].append(turns.left_out(scene.name, why))
    every = report["skipped"] + [one for scene in report["scenes"] for one in scene["skipped"]]
    if any(one["why"].startswith(turns.FAILED) for one in every):
        report["failed"] = True
    return report


def load(path):
    try:
        with open(path, encoding="utf-8") as file:
            report = json.load(file)
    except (OSError, ValueError) as why:
        raise Failure(f"{path}: {why}") from why
    if report.get("report") != "glint bench" or report.get("version") != VERSION:
        raise Failure(f"{path}: is not a report of bench/run")
    return report


def shortened(value):
    """Numbers with as many digits as a clock has."""
    if isinstance(value, float):
        return float(f"{value:.6g}")
    if isinstance(value, dict):
        return {key: shortened(one) for key, one in value.items()}
    return [shortened(one) for one in value] if isinstance(value, list) else value


def save(report, path):
    """Complete or absent."""
    with open(path + ".part", "w", encoding="utf-8") as file:
        json.dump(shortened(report), file, indent=1)
        file.write("\n")
    os.replace(path + ".part", path)


# ---- looking up; None: it was not measured


def find(rows, **wanted):
    for row in rows or []:
        if all(row.get(key) == value for key, value in wanted.items()):
            return row
    return None


def scene(report, name):
    return find(report["scenes"], scene=name)


def group(report, name, group_name):
    found = scene(report, name)
    return find(found["groups"], group=group_name) if found else None


def system(report, name, group_name, which):
    found = group(report, name, group_name)
    return find(found["systems"], system=which) if found else None


def ratio(report, name, group_name, of, to, key):
    found = group(report, name, group_name)
    row = find(found["ratios"], of=of, to=to) if found else None
    return row[key] if row else None


def whole_system(report, name, which):
    found = scene(report, name)
    return find(found["whole"]["systems"], system=which) if found and found["whole"] else None


def whole_ratio(report, name, of, to, key):
    found = scene(report, name)
    row = find(found["whole"]["ratios"], of=of, to=to) if found and found["whole"] else None
    return row[key] if row else None
