"""Whole processes: from the command to the picture in its file, with and without a shader cache, and other tracers'."""

import json
import os
import re
import shutil
import tempfile

from .machine import Failure, Skip, installed, paired, run, spread
from .scenes import Group
from .turns import NAMES, PROGRAMS, left_out

PARTS = ("read_s", "assets_s", "flatten_s", "trees_s", "open_device_s", "upload_s", "first_frame_s", "encode_s")
MANY = 9  # frames more, for the steady frame of a glint that cannot take turns


def cached(folder):
    """Caches of shaders, in this folder alone: Mesa's, NVIDIA's, and what keeps to the XDG folders."""
    return {
        **os.environ,
        "XDG_CACHE_HOME": folder,
        "MESA_SHADER_CACHE_DIR": folder,
        "MESA_GLSL_CACHE_DIR": folder,
        "__GL_SHADER_DISK_CACHE_PATH": folder,
    }


class Job:
    """What is run in turn: `once` gives a measurement, with `parts` of it in seconds."""

    lacks = ""

    def __init__(self, place, name, scene, assets, group):
        self.place, self.name, self.scene, self.assets, self.group = place, name, scene, assets, group
        self.out = place.file("pictures", f"whole-{name}.png")

    def prepare(self):
        pass


class Glint(Job):
    def prepare(self):
        self.program = self.place.against if self.name == "against" else self.place.glint
        if not self.program:
            raise Skip("--against FILE names an older glint")
        self.folder = self.place.file("cache", self.name, ".")
        if self.name != "cold":
            self.once()  # fills the cache

    def command(self, *more):
        words = [self.program, "render", self.scene, "-o", self.out, "-q", *self.group.options(), *more]
        words += ["--asset-path", self.assets] if self.assets else []
        return words + (["--device", self.place.device] if self.place.device else [])

    def measured(self, folder, *more):
        return run(self.command(*more), cached(folder))

    def parts(self, folder):
        """Of a run of its own: counting rays and the audit are not what a picture costs."""
        text = run(self.command("--stats=json"), cached(folder))["text"]
        stats = json.loads(text[text.index("{"):])
        facts = {key: stats[key] for key in ("scene_bytes", "triangles", "precision", "device")}
        return {key: stats["times"][key] for key in PARTS}, facts

    def whole(self, folder, other):
        one = self.measured(folder)
        one["parts"], one["facts"] = self.parts(other)
        return one

    def once(self):
        if self.name != "cold":
            return self.whole(self.folder, self.folder)
        folders = [tempfile.mkdtemp(dir=os.path.dirname(self.folder)) for _ in range(2)]
        try:
            return self.whole(*folders)
        finally:
            for folder in folders:
                shutil.rmtree(folder)


class Peer(Job):
    """A program of ours, with --whole."""

    def prepare(self):
        self.program = self.place.program(PROGRAMS[self.name])

    def once(self):
        words = [self.program, self.scene, "--system", self.name, "--whole", self.out, *self.group.options()]
        one = run(words + (["--assets", self.assets] if self.assets else []))
        facts = json.loads(one["text"])
        one["parts"] = {key: facts[key] for key in ("assets_s", "flatten_s", "tree_s", "encode_s")}
        one["parts"]["first_frame_s"] = facts["wall"][0]
        one["facts"] = {key: facts[key] for key in ("triangles", "device")}
        return one


class Foreign(Job):
    """A tracer with a scene language of its own; its picture goes through our encoder."""

    def prepare(self):
        self.program = installed(self.name)
        self.export = self.place.program("bench_export")
        kind, ending = ("pov", "pov") if self.name == "povray" else ("tachyon", "dat")
        self.scene_out = self.place.file("scenes", "exported." + ending)
        self.raw = self.place.file("pictures", self.name + ".ppm")
        words = [self.export, kind, self.scene, self.scene_out]
        words += ["--size", self.group.size] if self.group.size else []
        for one in self.group.sets:
            words += ["--set", one]
        said = json.loads(run(words + (["--assets", self.assets] if self.assets else []))["text"])
        self.lacks, self.srgb = said["lacks"], said["srgb"]
        self.size = said["width"], said["height"]

    def command(self):
        threads = str(len(os.sched_getaffinity(0)))
        if self.name == "tachyon":
            return [self.program, self.scene_out, "-numthreads", threads, "-format", "PPM", "-o", self.raw]
        width, height = self.size
        return [self.program, "+I" + self.scene_out, "+O" + self.raw, "+FP", f"+W{width}", f"+H{height}", "-D", "-A",
                "+WT" + threads, "File_Gamma=" + ("srgb" if self.srgb else "1"), "-V"]

    def trace(self, text):
        """Seconds of tracing by the tool's own report."""
        if self.name == "tachyon":
            return float(re.search(r"Ray Tracing Time: +([0-9.]+)", text)[1]), None
        found = re.search(r"Trace Time:.*\(([0-9.]+) seconds\)\s+using \d+ thread\(s\) with ([0-9.]+) CPU-seconds", text)
        return float(found[1]), float(found[2])

    def once(self):
        one = run(self.command())
        wall, processor = self.trace(one["text"])
        end = run([self.export, "png", self.raw, self.out])
        one["parts"] = {"trace_s": wall, "encode_s": end["wall"]}
        if processor is not None:
            one["parts"]["trace_processor_s"] = processor
        for key in ("wall", "processor"):
            one[key] += end[key]
        one["facts"] = {}
        return one


def job(place, name, scene, assets, group):
    kind = Foreign if name in ("povray", "tachyon") else Peer if name in PROGRAMS else Glint
    return kind(place, name, scene, assets, group)


def summary(one, runs):
    parts = {key: spread([r["parts"][key] for r in runs]) for key in runs[0]["parts"]}
    row = {"system": one.name, "runs": len(runs), "lacks": one.lacks, "parts": parts, "facts": runs[-1]["facts"]}
    for key in ("wall", "processor", "peak_bytes"):
        row[key] = spread([r[key] for r in runs])
    return row


def ratios(done):
    rows = []
    for of in ("cold", "warm"):
        for to in done:
            if of not in done or to == of or to == "cold":
                continue
            series = {key: paired([r[key] for r in done[of]], [r[key] for r in done[to]]) for key in ("wall", "processor")}
            rows.append({"of": of, "to": to, **series})
    return rows


def prepared(place, names, scene, assets, group, skipped):
    jobs = []
    for name in names:
        one = job(place, name, scene, assets, group)
        try:
            one.prepare()
            jobs.append(one)
        except (Skip, Failure) as why:
            skipped.append(left_out(f"{NAMES[name]}, whole process", why))
    return jobs


def measure(place, names, scene, assets, group, rounds, skipped):
    jobs = prepared(place, names, scene, assets, group, skipped)
    done = {one.name: [] for one in jobs}
    for _ in range(rounds):
        for one in jobs:
            done[one.name].append(one.once())
    return {"systems": [summary(one, done[one.name]) for one in jobs if done[one.name]], "ratios": ratios(done)}


def steady_before(place, scene, assets, group, rounds, skipped):
    """Steady frames of today's glint and an older one by what more frames of a process cost: its own processor time."""
    jobs = prepared(place, ["warm", "against"], scene, assets, group, skipped)
    if len(jobs) < 2:
        return None
    found = {one.name: [] for one in jobs}
    for _ in range(rounds):
        for one in jobs:
            few = one.measured(one.folder, "--repeat", "1")
            many = one.measured(one.folder, "--repeat", str(1 + MANY))
            found[one.name].append((many["processor"] - few["processor"]) / MANY)
    return {
        "frames": MANY,
        "today": spread(found["warm"]),
        "before": spread(found["against"]),
        "processor": paired(found["warm"], found["against"]),
    }


def encoding(place, scene, assets, sizes, rounds):
    """Making the PNG alone, of pictures of these sizes, by glint's own account."""
    found = []
    for size in sizes:
        one = Glint(place, "warm", scene, assets, Group("encoding", [], size))
        one.prepare()
        runs = [one.parts(one.folder)[0] for _ in range(rounds)]
        found.append({"size": size, "seconds": spread([parts["encode_s"] for parts in runs])})
    return found
