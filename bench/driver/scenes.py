"""The scenes of bench/run: what they are made of, in which sizes and settings they are traced, and by whom."""

import math
import os
import re

from .machine import ROOT, Skip, run

# The course project's own rule for when a path ends, instead of ours.
COURSE = ["trace.max_depth=20", "trace.min_weight=0.018257"]


class Group:
    """Systems that take turns at one picture. `on`: "processor", "gpu" or "" for both kinds of device."""

    def __init__(self, name, systems, size=None, samples=1, sets=(), on="", quick=True):
        self.name, self.systems, self.size, self.samples, self.sets = name, systems, size, samples, list(sets)
        self.on, self.quick = on, quick

    def options(self):
        words = ["--samples", str(self.samples)]
        if self.size:
            words += ["--size", self.size]
        for one in self.sets:
            words += ["--set", one]
        return words


class Scene:
    def __init__(self, name, what, make, groups, whole=(), quick=False, grown=False):
        self.name, self.what, self.make, self.groups = name, what, make, groups
        self.whole, self.quick = whole, quick


# ---- files


def shipped(path):
    def make(place):
        full = os.path.join(ROOT, path)
        if path.startswith("scenes/showcase") and not os.path.exists(os.path.join(ROOT, "scenes/generated/sky.png")):
            raise Skip("scenes/generated is not made; build the target glint_scenes")
        return full, None

    return make


def original(place):
    place.asset("seed", "background.jpg")
    return os.path.join(ROOT, "tests/scenes/original.glint.yaml"), place.asset("seed")


def box_of(text):
    """The box that bench_mesh prints."""
    numbers = [float(n) for n in re.search(r"from (.*) to (.*)", text).group(1, 2) for n in n.split()]
    return numbers[:3], numbers[3:]


def mesh_scene(place, mesh, lower, upper):
    """A mesh that fills the picture, lit from the side, so that most hits send a shadow ray."""
    middle = [(a + b) / 2 for a, b in zip(lower, upper)]
    size = max(b - a for a, b in zip(lower, upper))
    eye = [m + size * d for m, d in zip(middle, (0.25, 0.2, 1.1))]
    lamp = [m + size * d for m, d in zip(middle, (3, 5, 4))]
    path = place.file("scenes", os.path.basename(mesh).replace(".obj", ".glint.yaml"))
    with open(path, "w", encoding="utf-8") as file:
        file.write(
            "glint: 1\nimage: {width: 1024, height: 768}\n"
            f"camera: {{position: {eye}, look_at: {middle}, fov: 42}}\nbackground: {{color: 0.2}}\n"
            f"lights: [{{position: {lamp}}}]\n"
            f"models: [{{mesh: {os.path.basename(mesh)}}}]\n"
        )
    return path, os.path.dirname(mesh)


def made(place, name, *words):
    """A mesh that bench_mesh makes, once; its box is kept beside it."""
    mesh = place.file("meshes", name + ".obj")
    note = mesh + ".txt"
    if not os.path.exists(mesh) or not os.path.exists(note):
        text = run([place.program("bench_mesh"), *words, mesh])["text"]
        with open(note, "w", encoding="utf-8") as file:
            file.write(text)
    with open(note, encoding="utf-8") as file:
        return mesh, *box_of(file.read())


def scan(name):
    return lambda place: mesh_scene(place, *made(place, name, "ply", place.asset("models", name + ".ply")))


def knot(name, triangles):
    return lambda place: mesh_scene(place, *made(place, name, "knot", str(triangles)))


def copies(place, count=1000):
    """So many models of one mesh, on a grid, each turned."""
    folder = os.path.dirname(place.asset("seed", "venus-mesh.obj"))
    path = place.file("scenes", f"venus-{count}.glint.yaml")
    side = math.ceil(count ** (1 / 3) - 1e-9)
    middle, far = (side - 1) / 2, side / 10
    with open(path, "w", encoding="utf-8") as file:
        file.write(
            "glint: 1\nimage: {width: 1024, height: 768}\n"
            f"camera: {{position: [0, {14 * far:g}, {34 * far:g}], look_at: [0, 0, 0], fov: 50}}\n"
            f"background: {{color: 0.2}}\nlights: [{{position: [{30 * far:g}, {60 * far:g}, {40 * far:g}]}}]\nmodels:\n"
        )
        for i in range(count):
            x, y, z = i % side - middle, i // side % side - middle, i // side**2 - middle
            file.write(
                f"  - {{mesh: venus-mesh.obj, scale: 1.2, rotation: [0, {37 * i % 360}, 0], "
                f"translation: [{3 * x}, {2.4 * y}, {3 * z}]}}\n"
            )
    return path, folder


def named(path):
    """A scene file that the user names."""
    if not os.path.isfile(path):
        raise Skip(f"there is no scene '{path}'; --list names those that bench/run knows")
    name = os.path.basename(path).split(".")[0]
    return Scene(name, path, lambda place: (os.path.abspath(path), place.assets),
                 [Group("frame", ["single", "embree"])], ["cold", "warm", "embree", "povray", "tachyon"], quick=True)


# ---- the table

ALL = ["cold", "warm", "against", "embree", "povray", "tachyon"]
OWN = ["cold", "warm", "embree"]
BOTH = ["single", "embree"]
FULL, HUGE = "1920x1080", "3840x2160"


def mesh_groups():
    return [
        Group("frame", BOTH),
        Group("primary 1080p", ["single", "pipeline"], FULL, sets=["trace.shadows=false", "trace.max_depth=0"], on="gpu"),
        Group("shadow 1080p", ["single", "pipeline"], FULL, sets=["trace.max_depth=0"], on="gpu"),
    ]


SCENES = [
    Scene("original", "the course project's scene, 54 000 triangles", original, [
        Group("frame", ["single", "embree", "against"], "1024x768"),
        Group("double", ["single", "double"], "1024x768"),
        Group("baseline", ["single", "baseline"], "512x384", sets=COURSE),
        Group("depth 20", ["single", "double", "baseline"], "1024x768", sets=COURSE, on="gpu"),
        Group("depth 20, 1080p", ["single"], FULL, sets=COURSE, on="gpu"),
        Group("depth 20, 4K", ["single"], HUGE, sets=COURSE, on="gpu"),
        Group("16 samples", ["single"], "1024x768", 16, on="gpu"),
    ], ALL, quick=True),
    Scene("showcase", "the picture of the README", shipped("scenes/showcase.glint.yaml"), [Group("frame", BOTH)],
          ["cold", "warm", "against", "embree", "povray"], quick=True),
    Scene("tinyraytracer", "four spheres", shipped("scenes/tinyraytracer.glint.yaml"), [Group("frame", BOTH)], ALL,
          quick=True),
    Scene("bunny-69k", "a scan of 69 000 triangles", scan("bunny-69k"), mesh_groups(), ALL, quick=True),
    Scene("nefertiti-100k", "a scan of 100 000 triangles", scan("nefertiti-100k"), mesh_groups(), OWN),
    Scene("bunny-276k", "subdivided and displaced", scan("bunny-276k"), mesh_groups(), OWN),
    Scene("bunny-1104k", "subdivided and displaced again", scan("bunny-1104k"), mesh_groups(), OWN + ["povray"]),
    Scene("knot-1m", "a displaced knot of 1 M triangles", knot("knot-1m", 1000000), mesh_groups(), OWN),
    Scene("knot-10m", "a displaced knot of 10 M triangles", knot("knot-10m", 10000000), mesh_groups(), OWN),
    Scene("venus-1000", "1000 models of one mesh of 31 398 triangles", copies,
          [Group("frame", ["single", "baked", "instances"])], ["warm", "instances"]),
    Scene("venus-3200", "3200 of them: 100 M triangles", lambda place: copies(place, 3200),
          [Group("frame", ["single", "instances"])], ["warm", "instances"]),
]


def choose(names, quick):
    if not names:
        return [s for s in SCENES if s.quick or not quick]
    known = {s.name: s for s in SCENES}
    return [known[n] if n in known else named(n) for n in names]
