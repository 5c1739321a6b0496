#!/usr/bin/env python3
"""Kills runs with SIGKILL, at random moments or at writes into run.h5, and holds them to what they promise.

    killed_runs.py PROGRAM SOURCE_DIR [--kills N] [--seed S] [--aim libdie_at_write.so]

After every kill run.h5 opens, has no half-written frame and none less than somebody saw before the kill. The
run is resumed, and killed again, until it ends; then its history, frames and final state have the same bits as
those of a run that nobody touched. A run that was killed before it had a checkpoint is started anew.

With --aim every kill falls just before a write into run.h5 or its journal (tests/die_at_write.cpp), all but those
of the commits' new data into the commits themselves; `report` and `figure` have to read what is left, too.
"""
import argparse
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

FAST = ["--set", "stage.press.duration=30 us",
        "--set", 'stage.press.move[0].displacement=["0 mm", "-0.6 mm"]',
        "--set", "output.frames=40", "--set", "output.samples=80"]
SCENES = {
    "compaction": ["compaction/regular-25.toml", *FAST],
    "observed": ["compaction/regular-25.toml", *FAST, "--set", "output.contacts=true",
                 "--set", "element.formulation=four-point"],
    "loop": ["afm/loop-beam-0.toml"],
}
SERIES = {"compaction": "tool/top/force_y", "observed": "tool/top/force_y", "loop": "clamp/force_y"}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=10)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--aim", type=pathlib.Path, help="library that ends a run at a write")
    return parser.parse_args()


def frames_in(folder):
    """How many there are; every one must be whole. None where there is no file yet."""
    if not (folder / "run.h5").exists():
        return None
    with h5py.File(folder / "run.h5", "r") as file:
        for name, frame in file["frames"].items():
            assert frame.attrs["complete"] == 1, f"{folder}: frame {name} is not whole"
            assert np.isfinite(frame["position"][...]).all(), name
        listed = folder / "run.xdmf"
        named = set(re.findall(r"run\.h5:/frames/(\d+)/", listed.read_text())) if listed.exists() else set()
        assert named <= set(file["frames"]), f"{folder}: run.xdmf names frames {named - set(file['frames'])}"
        for view in folder.glob("*.vtkhdf"):
            with h5py.File(view) as shown:
                points = shown["VTKHDF/Points"]
                named = {source.dset_name.split("/")[2] for source in points.virtual_sources()} if points.is_virtual else set()
                assert named <= set(file["frames"]), f"{view} names frames {named - set(file['frames'])}"
                assert shown["VTKHDF/Steps"].attrs["NSteps"] == len(named), view
        lengths = {len(file["history/time"])}
        file["history"].visititems(
            lambda _, o: lengths.add(len(o)) if isinstance(o, h5py.Dataset) else None)
        assert len(lengths) == 1, f"{folder}: series of lengths {lengths}"
        return len(file["frames"])


def frames_seen(folder):
    """How many somebody sees who looks on; None where the file changed under the look."""
    try:
        with h5py.File(folder / "run.h5", "r") as file:
            return len(file["frames"])
    except (OSError, RuntimeError, KeyError):
        return None


def everything_in(folder):
    found = {"history.csv": (folder / "history.csv").read_bytes(),
             "state": json.loads((folder / "summary.json").read_text())["state_hash"]}
    with h5py.File(folder / "run.h5", "r") as file:
        for group in ("frames", "history"):
            file[group].visititems(
                lambda name, o, at=group: found.__setitem__(f"{at}/{name}", o[...].tobytes())
                if isinstance(o, h5py.Dataset) else None)
    return found


class Killer:
    def __init__(self, options):
        self.options = options
        self.chance = random.Random(options.seed)
        self.kills = self.anew = 0
        self.writes, self.references = {}, {}  # of the scenes: writes into run.h5, what is right and how long it takes
        self.stages = {"before a checkpoint": 0, "after one": 0}

    def start(self, scene, folder, resume, environment=None):
        words = [str(self.options.program.resolve())]
        name, *changes = SCENES[scene]
        if resume:
            words += ["resume", str(folder)]
        else:
            words += ["run", str(self.options.source / "scenes" / name), "-o", str(folder),
                      "--overwrite", *changes]
        words += ["--threads", str(self.chance.choice([1, 2])), "--checkpoint-steps",
                  str(self.chance.choice([7, 50, 200]) if scene != "loop" else 2)]
        return subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                env={**os.environ, **(environment or {})})

    def aimed(self, more):
        return {"LD_PRELOAD": str(self.options.aim.resolve()), **more} if self.options.aim else {}

    def reference(self, scene, folder):
        begin = time.monotonic()
        count = folder.with_suffix(".count")
        run = self.start(scene, folder, False, self.aimed({"DIE_AT_WRITE_COUNT": str(count)}))
        assert run.wait() == 0, run.stderr.read()
        if self.options.aim:
            self.writes[scene] = int(count.read_text())
        return everything_in(folder), time.monotonic() - begin

    def run_aimed(self, scene, folder, resume):
        """Killed just before one of the writes into run.h5, wherever that falls."""
        at = self.chance.randint(1, self.writes[scene] // (4 if resume else 1))
        run = self.start(scene, folder, resume, self.aimed({"DIE_AT_WRITE": str(at)}))
        run.wait()
        run.stderr_text = run.stderr.read()
        if run.returncode != -9:
            return run
        self.kills += 1
        try:
            frames = frames_in(folder)
        except (OSError, RuntimeError, KeyError) as error:
            raise AssertionError(f"{scene}: {'resume' if resume else 'run'} ended at write {at} "
                                 "into run.h5 leaves it unreadable") from error
        if frames:
            self.read_by("report", folder)
            self.read_by("figure", folder, "--series", SERIES[scene], "-o", folder.with_suffix(".csv"))
        self.count_stage(folder)
        return run

    def read_by(self, *words):
        reader = subprocess.run([self.options.program.resolve(), *words], check=False,
                                capture_output=True, text=True)
        assert reader.returncode == 0, f"{words[0]} after {self.kills} kills: {reader.stderr}"

    def count_stage(self, folder):
        self.stages["after one" if list(folder.glob("checkpoint-*.h5")) else
                    "before a checkpoint"] += 1

    def run_once(self, scene, folder, duration, resume):
        """Exit code of a run that may be killed at any moment."""
        run = self.start(scene, folder, resume)
        try:
            run.wait(self.chance.uniform(0, 0.7 * duration))
        except subprocess.TimeoutExpired:
            seen = frames_seen(folder)
            run.kill()
            run.wait()
            self.kills += 1
            there = frames_in(folder)
            # (A resumed run takes away what is younger than its checkpoint.)
            assert resume or seen is None or there >= seen, f"{seen} frames were there, {there} are left"
            self.count_stage(folder)
        run.stderr_text = run.stderr.read()
        return run

    def round(self, scene, place):
        if scene not in self.references:
            self.references[scene] = self.reference(scene, place / f"{scene}-whole")
        expected, duration = self.references[scene]
        folder = place / scene
        resume = False
        while True:
            if self.kills >= self.options.kills:  # enough: now to the end
                run = self.start(scene, folder, resume)
                run.wait()
                run.stderr_text = run.stderr.read()
            elif self.options.aim:
                run = self.run_aimed(scene, folder, resume)
            else:
                run = self.run_once(scene, folder, duration, resume)
            assert run.returncode in (0, -9), run.stderr_text
            if run.returncode == 0:
                break
            resume = (folder / "run.h5").exists() and bool(list(folder.glob("checkpoint-*.h5")))
            self.anew += not resume
        found = everything_in(folder)
        assert found.keys() == expected.keys(), found.keys() ^ expected.keys()
        for name, bits in expected.items():
            assert found[name] == bits, f"{scene}: {name} differs"


def main():
    killer = Killer(arguments())
    rounds = 0
    with tempfile.TemporaryDirectory(prefix="pulvis-killed-") as place:
        while killer.kills < killer.options.kills:
            for scene in SCENES:
                killer.round(scene, pathlib.Path(place))
                rounds += 1
                print(f"{scene}: {killer.kills} kills so far", flush=True)
                if killer.kills >= killer.options.kills:
                    break
    print(f"{killer.kills} kills ({killer.stages['before a checkpoint']} before the first "
          f"checkpoint), {rounds} runs brought to their end: every run.h5 opened, no frame lost, "
          "the same bits")
    return 0


if __name__ == "__main__":
    sys.exit(main())
