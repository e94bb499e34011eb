"""What glint is to reach, as ratios where they can be one, and whether a report shows it."""

from . import results
from .table import lines


class Missing(Exception):
    """Why a report cannot tell."""


class Target:
    """`on`: "processor" or "gpu"; "" for both. `processors`: of the machine, or None for any number. `most`: the number must
    be at most `must`; else at least. `unit`: of the number, empty for a ratio. `by`: which clock decides, whatever is asked
    for: threads that wait for each other take no processor time."""

    def __init__(self, what, on, most, must, aim, value, unit="", processors=None, by=None):
        self.what, self.on, self.most, self.must, self.aim = what, on, most, must, aim
        self.value, self.unit, self.processors, self.by = value, unit, processors, by


def known(value, why):
    if value is None:
        raise Missing(why)
    return value


# ---- where a number comes from


def turn(scene, group, of, to, key=None, inverse=False):
    def value(report, clock):
        found = known(results.ratio(report, scene, group, of, to, key or clock), f"{scene}, {group}, {to}: not in this report")
        return 1 / found["median"] if inverse else found["median"]

    return value


def device_ms(scene, group, which="single"):
    def value(report, clock):
        del clock
        found = known(results.system(report, scene, group, which), f"{scene}, {group}: not in this report")
        return 1e3 * known(found["device"], "the device has no clock")["median"]

    return value


def beyond_device(scene, group):
    def value(report, clock):
        del clock
        found = known(results.system(report, scene, group, "single"), f"{scene}, {group}: not in this report")
        return 1e3 * (found["wall"]["median"] - known(found["device"], "the device has no clock")["median"])

    return value


def process(scene, of, to):
    def value(report, clock):
        found = results.whole_ratio(report, scene, of, to, clock)
        return known(found, f"{scene}, whole process, {to}: not in this report")["median"]

    return value


def before(report, clock):
    """Always by processor time: it is a difference of two processes."""
    del clock
    scene = results.scene(report, "original")
    found = scene["before"] if scene else None
    return known(found, "an older glint to compare with: --against FILE")["processor"]["median"]


def pov_trace(report, clock):
    """The least of both: they do not take turns."""
    own = known(results.system(report, "original", "frame", "single"), "original, frame: not in this report")
    pov = known(results.whole_system(report, "original", "povray"), "POV-Ray is not in this report")
    theirs = pov["parts"]["trace_s" if clock == "wall" else "trace_processor_s"]["least"]
    return own[clock]["least"] / theirs


def encoding(size):
    def value(report, clock):
        del clock
        scene = results.scene(report, "original")
        found = results.find(scene["encoding"], size=size) if scene else None
        return 1e3 * known(found, "PNG alone: not in this report; it is left out by --quick")["seconds"]["least"]

    return value


def tree(report, clock):
    del clock
    ours = known(results.whole_system(report, "bunny-1104k", "warm"), "bunny-1104k: not in this report")
    theirs = known(results.whole_system(report, "bunny-1104k", "embree"), "Embree is not in this report")
    return ours["parts"]["trees_s"]["least"] / theirs["parts"]["tree_s"]["least"]


def reading(report, clock):
    del clock
    scene = known(results.scene(report, "bunny-1104k"), "bunny-1104k: not in this report")
    ours = known(results.whole_system(report, "bunny-1104k", "warm"), "bunny-1104k: not in this report")
    return scene["mesh_bytes"] / ours["parts"]["assets_s"]["least"] / 1e6


def copies(part):
    def value(report, clock):
        del clock
        found = known(results.whole_system(report, "venus-1000", "warm"), "venus-1000: not in this report")
        if part == "scene_bytes":
            return found["facts"][part] / 2**20
        return found["parts"][part]["least"]

    return value


def growth(report, clock):
    """Rays per second at 1.1 M triangles, over those at 69 000."""
    rates = []
    for scene in ("bunny-69k", "bunny-1104k"):
        found = known(results.system(report, scene, "frame", "single"), f"{scene}: not in this report")
        key = clock if report["machine"]["on_processor"] else "device"
        rates.append(sum(found["facts"]["rays"].values()) / found[key]["least"])
    return rates[1] / rates[0]


# ---- the table

TARGETS = [
    Target("original, frame : Embree's", "processor", True, 2.4, 1.8, turn("original", "frame", "single", "embree"), processors=2),
    Target("original, frame : that of the glint before", "processor", True, 0.65, 0.6, before),
    Target("original, the course project's method : glint", "processor", False, 150, 190,
           turn("original", "baseline", "single", "baseline", inverse=True)),
    Target("original, frame : POV-Ray's tracing", "processor", True, 0.22, 0.18, pov_trace),
    Target("original, frame : Embree's, 16 processors", "processor", True, 3.0, 2.2,
           turn("original", "frame", "single", "embree"), processors=16, by="wall"),
    Target("original, whole process : Embree's", "processor", True, 1.6, 1.2, process("original", "warm", "embree"), processors=2),
    Target("original, whole process, no shader cache : Embree's", "processor", True, 2.0, 1.5,
           process("original", "cold", "embree"), processors=2),
    Target("PNG of 1024x768", "processor", True, 50, 30, encoding("1024x768"), "ms", 2),
    Target("PNG of 3840x2160", "processor", True, 500, 300, encoding("3840x2160"), "ms", 2),
    Target("original, depth 20, 1024x768", "gpu", True, 0.62, 0.40, device_ms("original", "depth 20"), "ms"),
    Target("the same, the course project's method : glint", "gpu", False, 95, 150,
           turn("original", "depth 20", "single", "baseline", "device", True)),
    Target("the same, 1920x1080", "gpu", True, 0.85, 0.7, device_ms("original", "depth 20, 1080p"), "ms"),
    Target("the same, 3840x2160", "gpu", True, 2.3, 1.8, device_ms("original", "depth 20, 4K"), "ms"),
    Target("original, 16 samples", "gpu", True, 7, 4, device_ms("original", "16 samples"), "ms"),
    Target("original, wall less device, 1080p", "gpu", True, 1.5, 0.7, beyond_device("original", "depth 20, 1080p"), "ms"),
    Target("knot of 1 M, 1080p, primary", "gpu", True, 0.75, 0.55, device_ms("knot-1m", "primary 1080p"), "ms"),
    Target("knot of 1 M, 1080p, and a shadow ray", "gpu", True, 1.15, 0.8, device_ms("knot-1m", "shadow 1080p"), "ms"),
    Target("knot of 10 M, 1080p, and a shadow ray", "gpu", True, 1.9, 1.3, device_ms("knot-10m", "shadow 1080p"), "ms"),
] + [
    Target(f"{name}, the vendor's pipeline : glint, {rays}", "gpu", False, must, 1.5,
           turn(scene, group, "single", "pipeline", "device", True))
    for name, scene in (("knot of 1 M", "knot-1m"), ("scan of 1.1 M", "bunny-1104k"))
    for rays, group, must in (("primary", "primary 1080p", 1.1), ("and a shadow ray", "shadow 1080p", 1.25))
] + [
    Target("double : single precision", "gpu", True, 1.5, 1.2, turn("original", "double", "double", "single", "device")),
    Target("double : single precision", "processor", True, 1.6, 1.4, turn("original", "double", "double", "single")),
    Target("1.1 M triangles, tree : Embree's", "processor", True, 1.8, 1.2, tree, processors=2),
    Target("1.1 M triangles, reading OBJ", "processor", False, 300, 600, reading, "MB/s", 2),
    Target("1000 models, memory on the device", "", True, 16, 8, copies("scene_bytes"), "MiB"),
    Target("1000 models, flattening", "processor", True, 0.2, 0.1, copies("flatten_s"), "s", 2),
    Target("1000 models, frame : the baked one's", "processor", True, 1.4, 1.2, turn("venus-1000", "frame", "single", "baked")),
    Target("rays per second, 1.1 M : 69 000 triangles", "processor", False, 0.7, 0.8, growth),
    Target("rays per second, 1.1 M : 69 000 triangles", "gpu", False, 0.6, 0.7, growth),
]


def reached(target, value, bound):
    return value <= bound if target.most else value >= bound


def judge(target, report, clock):
    """The numbers by the wall's clock and by processor time, or None, and a word or why there is none. `clock` decides."""
    on_processor = report["machine"]["on_processor"]
    if target.on and (target.on == "processor") != on_processor:
        return None, None, "not measured here: for a processor" if target.on == "processor" else "not measured here: for a GPU"
    if target.processors and target.processors != report["machine"]["processors"]:
        return None, None, f"not measured here: for {target.processors} processors"
    try:
        by = {key: target.value(report, key) for key in ("wall", "processor")}
    except Missing as why:
        return None, None, f"not measured here: {why}"
    value = by[target.by or clock]
    word = "aim met" if reached(target, value, target.aim) else "met" if reached(target, value, target.must) else "MISSED"
    return by["wall"], by["processor"], word


ON = {"processor": "processor", "gpu": "GPU", "": "both"}
HEAD = ["", "device", "must", "aim", "by the clock", "by processor time", ""]


def rows(report, clock):
    for target in TARGETS:
        wall, processor, word = judge(target, report, clock)
        sign = "≤" if target.most else "≥"
        unit = " " + target.unit if target.unit else ""
        bounds = [f"{sign} {bound:g}{unit}" for bound in (target.must, target.aim)]
        cells = ["-" if value is None else f"{value:.3g}{unit}" for value in (wall, processor)]
        yield [target.what, ON[target.on], *bounds, *cells, word]


def print_targets(report, clock):
    print()
    print("\n".join(lines(HEAD, list(rows(report, clock)))))
