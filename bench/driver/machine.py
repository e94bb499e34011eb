"""What every part of bench/run needs: places, running a program with its clocks, statistics of times."""

import os
import platform
import shutil
import statistics
import subprocess
import sys
import time

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


class Skip(Exception):
    """Something cannot be measured here; the text says why."""


class Failure(Exception):
    """Something that should work does not; the text says what."""


class Place:
    """Where programs, meshes and files made on the way are."""

    def __init__(self, build, work, assets, device, against):
        self.build = os.path.abspath(build)
        self.work = os.path.abspath(work)
        self.assets = os.path.abspath(assets) if assets else None
        self.device = device
        self.against = os.path.abspath(against) if against else None
        self.glint = os.path.join(self.build, "glint")

    def program(self, name):
        path = os.path.join(self.build, "bench", name)
        if not os.access(path, os.X_OK):
            raise Skip(f"{name} is not built")
        return path

    def asset(self, *parts):
        path = os.path.join(self.assets, *parts) if self.assets else None
        if not path or not os.path.exists(path):
            raise Skip(f"{'/'.join(parts)} is not there; --assets DIR or GLINT_ASSETS names its folder")
        return path

    def file(self, *parts):
        path = os.path.join(self.work, *parts)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        return path


def say(text):
    print(text, file=sys.stderr, flush=True)


def installed(name):
    path = shutil.which(name)
    if not path:
        raise Skip(f"{name} is not installed")
    return path


def run(command, env=None):
    """Runs a program to its end: wall and processor seconds, the most memory, and what it printed."""
    start = time.monotonic()
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=env)
    text = child.stdout.read().decode("utf-8", "replace")
    _, status, usage = os.wait4(child.pid, 0)
    wall = time.monotonic() - start
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise Failure(f"{' '.join(command)} ended with {child.returncode}:\n{text[-2000:]}")
    return {"wall": wall, "processor": usage.ru_utime + usage.ru_stime, "peak_bytes": usage.ru_maxrss * 1024, "text": text}


def spread(values):
    """Median, least and most; None for nothing."""
    values = [v for v in values if v is not None]
    if not values:
        return None
    return {"median": statistics.median(values), "least": min(values), "most": max(values)}


def paired(of, to):
    """The ratio of two series that took turns, round by round."""
    return spread([a / b for a, b in zip(of, to) if b])


def processor_name():
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            for line in file:
                if line.startswith("model name"):
                    return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.machine()


def commit():
    try:
        done = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty"], capture_output=True, text=True)
    except OSError:
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""


def describe():
    return {
        "processor": processor_name(),
        "processors": len(os.sched_getaffinity(0)),
        "system": platform.system() + " " + platform.release(),
        "commit": commit(),
        "date": time.strftime("%Y-%m-%d"),
    }
