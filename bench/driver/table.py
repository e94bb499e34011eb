"""What was measured, as text for people."""

from .turns import NAMES


def ms(seconds):
    if seconds is None:
        return "-"
    value = 1e3 * seconds
    return f"{value:.2f}" if value < 10 else f"{value:.1f}" if value < 1000 else f"{value:.0f}"


def mib(count):
    return f"{count / 2**20:.0f}" if count else "-"


def lines(head, rows):
    """Columns as wide as they must be; the first and the last one to the left."""
    texts = [head] + [[str(cell) for cell in row] for row in rows]
    widths = [max(len(row[i]) for row in texts) for i in range(len(head))]
    return [
        "  ".join([row[0].ljust(widths[0])] + [c.rjust(w) for c, w in zip(row[1:-1], widths[1:-1])] + row[-1:]).rstrip()
        for row in texts
    ]


def times(spread):
    return [ms(spread["median"]), ms(spread["least"]), ms(spread["most"])] if spread else ["-"] * 3


def against_first(group, name, key):
    """glint's time as a multiple of this one's."""
    for row in group["ratios"]:
        if row["of"] == "single" and row["to"] == name and row[key]:
            return f"{row[key]['median']:.2f}"
    return "-"


def steady(group):
    rows = []
    for one in group["systems"]:
        facts = one["facts"]
        rays = facts.get("rays")
        share = next((a["share"] for a in group["agreement"] if a["system"] == one["system"]), None)
        rows.append([
            "  " + NAMES[one["system"]], one["frames"], *times(one["wall"]), ms(one["processor"]["least"]),
            ms(one["device"]["median"]) if one["device"] else "-",
            against_first(group, one["system"], "wall"), against_first(group, one["system"], "processor"),
            sum(rays.values()) if rays and sum(rays.values()) else "-",
            f"{100 * share:.3f} %" if share is not None else "-",
            ms(facts.get("tree_s")), mib(facts.get("scene_bytes")), mib(facts.get("peak_bytes")),
        ])
    head = ["  steady frame, ms", "frames", "median", "least", "most", "cpu", "device", "glint/it", "by cpu", "rays",
            "pixels off", "tree", "scene MiB", "peak MiB"]
    return lines(head, rows)


def part(one, *names):
    """The median of the first of these parts that it has."""
    for name in names:
        if name in one["parts"]:
            return ms(one["parts"][name]["median"])
    return "-"


def first_frame(one):
    """From the scene in memory to the first picture: on the device, compiled, traced."""
    found = [one["parts"][n]["median"] for n in ("upload_s", "first_frame_s") if n in one["parts"]]
    return ms(sum(found)) if found else "-"


def whole(scene):
    rows = []
    for one in scene["whole"]["systems"]:
        ratio = next((r for r in scene["whole"]["ratios"] if r["of"] == "warm" and r["to"] == one["system"]), None)
        rows.append([
            "  " + NAMES[one["system"]], one["runs"], *times(one["wall"]), ms(one["processor"]["least"]),
            f"{ratio['wall']['median']:.2f}" if ratio else "-", f"{ratio['processor']['median']:.2f}" if ratio else "-",
            part(one, "assets_s"), part(one, "flatten_s"), part(one, "trees_s", "tree_s"), first_frame(one),
            part(one, "trace_s"), part(one, "encode_s"), mib(one["peak_bytes"]["median"]), one["lacks"],
        ])
    head = ["  whole process, ms", "runs", "median", "least", "most", "cpu", "glint/it", "by cpu", "load", "flatten",
            "tree", "first frame", "trace", "encode", "peak MiB", "it lacks"]
    return lines(head, rows)


def print_report(report):
    machine = report["machine"]
    print(f"{machine['device']}; {machine['processor']}, {machine['processors']} processors; commit {machine['commit']}")
    for scene in report["scenes"]:
        print(f"\n{scene['scene']}: {scene['what']}")
        for group in scene["groups"]:
            sets = ", ".join(group["sets"])
            print(f" {group['group']}: {group['width']}x{group['height']}, samples {group['samples']}"
                  f"{'; ' + sets if sets else ''}")
            print("\n".join(steady(group)))
        if scene["whole"]:
            print("\n".join(whole(scene)))
        if scene["before"]:
            before = scene["before"]
            print(f"  a frame's processor time: {ms(before['today']['least'])} ms, {ms(before['before']['least'])} before: "
                  f"{before['processor']['median']:.2f} of it")
        for one in scene["encoding"]:
            print(f"  PNG of {one['size']}: {ms(one['seconds']['least'])} ms")
        for one in scene["skipped"]:
            print(f"  skipped: {one['what']}: {one['why']}")
    for one in report["skipped"]:
        print(f"\nskipped: {one['what']}: {one['why']}")
