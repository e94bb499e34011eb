"""docs/performance.md and its pictures, from reports of bench/run: no number in them is typed by hand."""

import os

from . import results, targets
from .figure import bars
from .table import mib, ms
from .turns import NAMES


HEAD = """# How fast glint is

All numbers here come from `bench/run`, which measures glint beside other tracers in one run: they take turns, frame by frame and
process by process, so that all of them suffer alike from what else the machine does. **Ratios are the result**; times are
those of the machine that each section names. This page and its figures are made from reports,
a section each:

<!-- test: not run: it measures for minutes -->
```sh
./bench/run --json report.json --targets          # all scenes: a table, the report, and what was aimed at
./bench/run --quick --check                       # minutes; status 1 if glint fell behind bench/expected.json
./bench/run --page docs/performance.md report.json...   # this page, from reports
```

[bench/README.md](../bench/README.md) describes how it measures and what the other tracers are. In short:

- **Embree** is a program of ours on Intel's library, which is among the fastest on processors. It reads the same files by
  glint's own code, traces the same rays with the same shading on as many threads, and writes its picture with the same
  encoder: the column *pixels off* says how many pixels differ, and the number of rays is printed by the bench.
- **POV-Ray** and **Tachyon** render an exported scene, as near as their languages come.
- **The course project's method** tests boxes of 64 triangles one by one, in a shader with the same mapping to workgroups.
- **The vendor's ray-tracing pipeline** (`VK_KHR_ray_tracing_pipeline`) traces the same triangles, where a device has it.

`cpu` is processor time of all threads, the least of all frames; the other times are medians. "of it" is glint's time as a part of the
other's, the median over the turns, by the clock on the wall and by processor time.
"""


def row(cells):
    return "| " + " | ".join(cells) + " |"


def grid(head, rows):
    return "\n".join([row(head), row(["---"] + ["---:"] * (len(head) - 1))] + [row(r) for r in rows]) + "\n"


def command(report, source):
    quick = " --quick" if report["quick"] else ""
    return (f"<!-- test: not run: it measures for minutes -->\n```sh\n./bench/run{quick} --rounds {report['rounds']} "
            f"--json {source} --targets\n```\n")


def own_ratio(group, name, key):
    found = results.find(group["ratios"], of="single", to=name)
    return f"{found[key]['median']:.3g}" if found and found[key] else ""


# ---- frames


def frame_rows(report):
    for scene in report["scenes"]:
        for group in scene["groups"]:
            for one in group["systems"]:
                off = results.find(group["agreement"], system=one["system"])
                yield [
                    f"{scene['scene']}, {group['group']}", f"{group['width']}x{group['height']}", NAMES[one["system"]],
                    ms(one["wall"]["median"]), ms(one["processor"]["least"]),
                    ms(one["device"]["median"]) if one["device"] else "", own_ratio(group, one["system"], "wall"),
                    own_ratio(group, one["system"], "processor"), f"{100 * off['share']:.3f} %" if off else "",
                ]


def frame_figure(report, name):
    """glint and its first peer: on a processor in the group that every scene has, on a GPU over the same triangles."""
    on_processor = report["machine"]["on_processor"]
    key, wanted = ("processor", "frame") if on_processor else ("device", "shadow 1080p")
    names, rows = [], []
    for scene in report["scenes"]:
        group = results.find(scene["groups"], group=wanted)
        if not group or len(group["systems"]) < 2 or not group["systems"][1][key]:
            continue
        names = names or [NAMES[one["system"]] for one in group["systems"][:2]]
        rows.append((scene["scene"], [1e3 * one[key]["least"] for one in group["systems"][:2]]))
    title = "A steady frame: milliseconds of processor time" if on_processor else \
        "Primary and shadow rays, 1920x1080: milliseconds of the device's time"
    return figure(f"{name}-frames.svg", title, names, rows, " ms")


# ---- whole processes


def process_rows(report):
    for scene in report["scenes"]:
        for one in scene["whole"]["systems"] if scene["whole"] else []:
            ratio = results.find(scene["whole"]["ratios"], of="warm", to=one["system"])
            parts = {key: value["median"] for key, value in one["parts"].items()}
            first = [parts[key] for key in ("upload_s", "first_frame_s") if key in parts]
            yield [
                scene["scene"], NAMES[one["system"]], ms(one["wall"]["median"]), ms(one["processor"]["least"]),
                f"{ratio['wall']['median']:.2f}" if ratio else "", f"{ratio['processor']['median']:.2f}" if ratio else "",
                ms(parts["assets_s"]) if "assets_s" in parts else "",
                ms(parts.get("trees_s", parts.get("tree_s"))) if "trees_s" in parts or "tree_s" in parts else "",
                ms(sum(first)) if first else "", ms(parts["trace_s"]) if "trace_s" in parts else "",
                ms(parts["encode_s"]), mib(one["peak_bytes"]["median"]), one["lacks"],
            ]


def process_figure(report, name):
    systems = ["cold", "warm", "embree", "povray", "tachyon"]
    rows = []
    for scene in report["scenes"]:
        if not scene["whole"]:
            continue
        found = [results.find(scene["whole"]["systems"], system=one) for one in systems]
        rows.append((scene["scene"], [one["processor"]["least"] if one else None for one in found]))
    return figure(f"{name}-processes.svg", "From the command to the PNG: seconds of processor time", [NAMES[s] for s in systems],
                  rows, " s")


def figure(file, title, names, rows, unit):
    """Its name and its text; None: nothing to show."""
    return (file, bars(title, names, rows, unit)) if rows else None


# ---- the page


def shown(made):
    return f"![{made[0].split('.')[0]}](pictures/{made[0]})\n" if made else ""


def missing(report):
    found = [f"{one['what']}: {one['why']}" for one in report["skipped"]]
    found += [f"{scene['scene']}: {one['what']}: {one['why']}" for scene in report["scenes"] for one in scene["skipped"]]
    plain = [line.replace("\n", " ").replace("|", "/") for line in found]
    return ("Not measured:\n\n" + "\n".join("- " + line for line in plain) + "\n") if plain else ""


def section(source, report):
    machine = report["machine"]
    name = "performance-" + os.path.basename(source).split(".")[0]
    frames, processes = frame_figure(report, name), process_figure(report, name)
    on = "; the device is a driver that traces on the processor" if machine["on_processor"] else ""
    clock = "processor" if machine["on_processor"] else "wall"
    parts = [
        f"## {machine['device']}\n",
        f"{machine['processor']}, {machine['processors']} processors{on}; {machine['date']}, commit {machine['commit']}.\n",
        command(report, source),
        "### Steady frames\n", shown(frames),
        grid(["scene", "pixels", "", "ms", "cpu", "device", "of it", "by cpu", "pixels off"], frame_rows(report)),
    ]
    if any(scene["whole"] for scene in report["scenes"]):
        parts += [
            "### Whole processes\n", shown(processes),
            "In milliseconds. *first frame*: on the device, compiled and traced; *trace*: what the tool reports of itself.\n",
            grid(["scene", "", "ms", "cpu", "of it", "by cpu", "load", "tree", "first frame", "trace", "encode", "MiB", "it lacks"],
                 process_rows(report)),
        ]
    parts += ["### What was aimed at\n", f"Judged by {'processor time' if clock == 'processor' else 'the clock'} where both are known.\n",
              grid(["", "device", "must", "aim", "by the clock", "by processor time", ""], targets.rows(report, clock)),
              missing(report)]
    return "\n".join(part for part in parts if part), [made for made in (frames, processes) if made]


def write(path, reports):
    folder = os.path.join(os.path.dirname(os.path.abspath(path)), "pictures")
    sections, figures = [HEAD], []
    for source, report in reports:
        words, made = section(source, report)
        sections.append(words)
        figures += made
    os.makedirs(folder, exist_ok=True)
    for name, svg in figures:
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(svg)
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(sections))
