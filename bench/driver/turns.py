"""Steady frames: programs that keep a scene open and make a frame when they are asked to (bench/turns/turns.h)."""

import json
import math
import os
import statistics
import subprocess

from .machine import ROOT, Failure, Skip, paired, run, say, spread

PROGRAMS = {
    "single": "turns_glint",
    "double": "turns_glint",
    "baked": "turns_glint",
    "baseline": "turns_glint",
    "embree": "turns_embree",
    "robust": "turns_embree",
    "instances": "turns_embree",
    "pipeline": "turns_pipeline",
}
NAMES = {
    "single": "glint",
    "double": "glint, double precision",
    "baked": "glint, a copy for each model",
    "baseline": "the course project's method",
    "embree": "Embree",
    "robust": "Embree, robust",
    "instances": "Embree, instances",
    "pipeline": "the vendor's ray-tracing pipeline",
    "against": "glint before",
    "cold": "glint, no shader cache",
    "warm": "glint",
    "povray": "POV-Ray",
    "tachyon": "Tachyon",
}
TURN_SECONDS = 0.06  # at least so long is a turn
GPU_TURN_SECONDS = 0.25  # a GPU's clocks need some time to go up
FRAMES_MOST = 256
FAILED = "failed"
SLOW_SECONDS = 4.0  # a system with longer frames gets fewer turns


class System:
    """A program that takes turns."""

    def __init__(self, place, name, scene, assets, options):
        command = [place.program(PROGRAMS[name]), scene, "--system", name, *options]
        command += ["--assets", assets] if assets else []
        command += ["--device", place.device] if place.device else []
        self.name, self.command, self.turns, self.frames = name, command, [], 1
        self.errors = open(place.file("errors", name + ".txt"), "w+", encoding="utf-8")
        self.child = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.errors, text=True)
        self.facts = self.answer()

    def answer(self):
        line = self.child.stdout.readline()
        if line:
            return json.loads(line)
        status = self.child.wait()
        self.errors.seek(0)
        text = self.errors.read().strip()
        if status in (77, 127):  # 127: a library of it is missing
            raise Skip(text or "it cannot run here")
        raise Failure(f"{' '.join(self.command)} ended with {status}:\n{text[-2000:]}")

    def ask(self, order):
        self.child.stdin.write(order + "\n")
        self.child.stdin.flush()
        return self.answer()

    def warm(self):
        """Frames that nobody counts decide how many make a turn."""
        first = self.ask("frames 1")["wall"][0]
        self.slow = first > SLOW_SECONDS
        first = first if self.slow else self.ask("frames 1")["wall"][0]
        seconds = TURN_SECONDS if self.facts["on_processor"] else GPU_TURN_SECONDS
        self.frames = max(1, min(FRAMES_MOST, math.ceil(seconds / max(first, 1e-5))))

    def turn(self):
        times = self.ask(f"frames {self.frames}")
        self.turns.append({key: times[key] for key in ("wall", "processor", "device")})
        self.facts["peak_bytes"] = times["peak_bytes"]

    def by_turn(self, key):
        return [statistics.median(turn[key]) for turn in self.turns]

    def picture(self, path):
        self.facts = {**self.ask("picture " + path)}

    def close(self):
        if self.child.poll() is None:
            try:
                self.child.stdin.close()
            except OSError:
                pass
            self.child.wait()
        self.child.stdout.close()
        self.errors.close()


def summary(system):
    times = {key: [v for turn in system.turns for v in turn[key]] for key in ("wall", "processor", "device")}
    has_device = any(times["device"])
    return {
        "system": system.name,
        "frames": len(times["wall"]),
        "wall": spread(times["wall"]),
        "processor": spread(times["processor"]),
        "device": spread(times["device"]) if has_device else None,
        "facts": system.facts,
    }


def ratios(systems):
    """Of each of glint's own to each other one that took turns with it, and of the double one to the single one."""
    found = []
    for of in systems:
        for to in systems:
            own = of.name == "single" or (of.name == "double" and to.name == "single")
            if of is to or not own or (of.name == "single" and to.name == "double"):
                continue
            row = {"of": of.name, "to": to.name}
            for key in ("wall", "processor", "device"):
                row[key] = paired(of.by_turn(key), to.by_turn(key)) if any(of.by_turn(key)) else None
            found.append(row)
    return found


def agreement(place, systems):
    """The share of pixels by which a picture differs from glint's by more than 1/255, as displayed."""
    first, found = systems[0], []
    path = place.file("pictures", first.name + ".png")
    first.picture(path)
    for other in systems[1:]:
        theirs = place.file("pictures", other.name + ".png")
        other.picture(theirs)
        report = json.loads(run([place.glint, "compare", path, theirs, "--format", "json", "--threshold", "0.005"])["text"])
        found.append({"system": other.name, "share": report["metrics"]["share"]["value"]})
    return found


def left_out(what, why):
    """A row for what cannot be measured; a failure says so."""
    return {"what": what, "why": str(why) if isinstance(why, Skip) else f"{FAILED}: {why}"}


def measure(place, scene, assets, group, rounds, skipped):
    """One group of systems, in turn. What glint itself cannot is raised."""
    systems = []
    try:
        for name in group.systems:
            if name not in PROGRAMS:
                continue
            try:
                systems.append(System(place, name, scene, assets, group.options()))
                systems[-1].warm()
            except (Skip, Failure) as why:
                if name == group.systems[0]:
                    raise
                skipped.append(left_out(NAMES[name], why))
        for number in range(rounds):
            for system in systems:
                if not (system.slow and number >= max(1, rounds // 4)):
                    system.turn()
        agrees = agreement(place, systems)
        return {
            "group": group.name,
            "width": systems[0].facts["width"],
            "height": systems[0].facts["height"],
            "samples": systems[0].facts["samples"],
            "sets": group.sets,
            "systems": [summary(s) for s in systems],
            "ratios": ratios(systems),
            "agreement": agrees,
        }
    finally:
        for system in systems:
            system.close()


def probe(place):
    """The device's name, and whether it is the processor."""
    scene = os.path.join(ROOT, "scenes", "tinyraytracer.glint.yaml")
    system = System(place, "single", scene, None, ["--size", "16x16"])
    try:
        return system.facts["device"], system.facts["on_processor"]
    finally:
        system.close()
        say(f"on {system.facts['device']}")
