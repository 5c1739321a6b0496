#!/usr/bin/python3
"""Runs over several ranks against the same run in one process: every bit of their results must be the same.

usage: ranks_runs.py PROGRAM ROOT (--case NAME [--quick] [--rebalanced PROGRAM] | --kills N [--seed S] | --full | --keys)

Case by case: a scene, left after some steps, on 1, 2, 3 and 4 ranks with 1 and 2 threads each; its state hash, its history
and every dataset of its frames, its mesh and its cracks must be those of one process. Then it is stopped twice and resumed
on other numbers of ranks, one process among them. --quick: on three ranks alone, and stopped on three and resumed on two.
--rebalanced: the ranks are those of rebalanced_run, whose chunks migrate every so many steps. --kills: a run over three
ranks is resumed after a rank was killed at a random moment, so many times, until it is done; its results must be the same
again. --full: no file may grow beyond some size, as on a disk that is full; the run over ranks ends and says so, and goes on
from its last checkpoint when there is room again. --keys: every scene of tests/keys on two ranks to its end: a key that is
new there is tried here by itself; and a run that a health check stops.
"""
import argparse
import json
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import h5py
import numpy

# Scene, steps, and what is set in it. Together they have every kind of contact, control and observer there is. In the cylindrical die
# the powder bears on the wall from step 630 on.
CASES = {
    "die": ("scenes/compaction/regular-25.toml", 300, ["output.contacts=true", "output.density_cells=[4, 4]"]),
    "friction": ("scenes/compaction/random-100.toml", 300, ["output.particle_stress=true"]),
    "damped-servo": ("scenes/compaction/biaxial.toml", 300, []),
    "shear": ("scenes/shear/grooves-16.toml", 300, []),
    "cell": ("scenes/periodic/cap-isostatic.toml", 300, ["output.contacts=true"]),
    "bonds": ("scenes/bonds/crushed-particle.toml", 115, ['stage[0].duration="2 us"', "particle[0].grains.number=12"]),
    "welds": ("scenes/bonds/green-strength.toml", 700, ['stage[0].duration="0.1 ms"', 'bond[0].threshold="1 MPa"',
                                                        "packing[0].density=0.805"]),
    "tool-bonds": ("tests/keys/scenes/bonds.toml", 400, ['stage[0].duration="1.2 us"', 'stage[1].duration="2 us"']),
    "constraints": ("scenes/bonds/pulled-blocks.toml", 130, ['stage[0].duration="1 us"']),
    "bar": ("scenes/basic/tension.toml", 300, []),
    "space-die": ("scenes/compaction-3d/random-100-copper.toml", 60, ["output.contacts=true"]),
    "space-round": ("scenes/compaction-3d/tablet.toml", 720, []),
    "space-stl": ("tests/mpi/stl-floor.toml", 240, []),
    "space-welds": ("tests/mpi/space-welds.toml", 2600, []),
    "space-constraints": ("tests/keys/scenes-3d/constraints.toml", 60, []),
    "space-cell": ("scenes/periodic/spheres-shear.toml", 600, ['stage[0].duration="4 us"', "stage[0].cell.tolerance=1e8"]),
    "space-mixture": ("scenes/compaction-3d/mixture.toml", 60, ["output.density_cells=[2, 2, 2]"]),
}
# Bonds that are made and broken in those steps: points at least.
BONDS = {"bonds": (400, 20), "welds": (100, 10), "tool-bonds": (50, 10), "constraints": (90, 50), "space-welds": (100, 20)}
RANKS_AND_THREADS = [(1, 2), (2, 1), (2, 2), (3, 1), (4, 1)]


class Failed(Exception):
    pass


def run(program, words, code=(0,)):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, timeout=900)
    if done.returncode not in code:
        raise Failed(f"pulvis {' '.join(map(str, words))}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return done


def summary_of(folder):
    return json.loads((folder / "summary.json").read_text())


def differences(one, other):
    """Of the datasets of two runs, and of their histories."""
    found = []
    if (one / "history.csv").read_bytes() != (other / "history.csv").read_bytes():
        found.append("history.csv")
    with h5py.File(one / "run.h5") as a, h5py.File(other / "run.h5") as b:
        names = {}
        for key, file in (("a", a), ("b", b)):
            names[key] = []
            file.visititems(lambda name, item, key=key: names[key].append(name)
                            if isinstance(item, h5py.Dataset) else None)
        if sorted(names["a"]) != sorted(names["b"]):
            found.append("other datasets")
        for name in names["a"]:
            if name in b and not numpy.array_equal(a[name][()], b[name][()], equal_nan=a[name].dtype.kind == "f"):
                found.append(name)
    return found


def require_same(one, other, what):
    alone, ranks = summary_of(one), summary_of(other)
    if alone["state_hash"] != ranks["state_hash"]:
        raise Failed(f"{what}: the state hash is {ranks['state_hash']}, of one process {alone['state_hash']}")
    found = differences(one, other)
    if alone.get("bonds") != ranks.get("bonds"):
        found.append("bonds of summary.json")
    if found:
        raise Failed(f"{what}: not the same: {', '.join(found[:8])}")


class Case:
    def __init__(self, program, root, name, scratch, rebalanced=None):
        scene, self.steps, self.set = CASES[name]
        self.program, self.scene, self.name, self.scratch = program, root / scene, name, scratch
        self.rebalanced = rebalanced  # a program that begins and resumes runs over ranks instead
        self.migrated = 0

    def words(self, folder, *more):
        sets = [word for override in self.set for word in ("--set", override)]
        return ["run", self.scene, "-o", folder, "--quiet", "--checkpoint-steps", 10**9, "--stop-after", self.steps,
                *sets, *more]

    def alone(self):
        folder = self.scratch / "alone"
        run(self.program, self.words(folder, "--threads", 1), code=(0, 1, 3, 130))
        if self.name in BONDS:
            bonds = summary_of(folder)["bonds"]
            if bonds["made"] < BONDS[self.name][0] or bonds["broken"] < BONDS[self.name][1]:
                raise Failed(f"{self.name}: {bonds['made']} points were bonded and {bonds['broken']} broke")
        return folder

    def begin(self, folder, ranks, threads, stop, code):
        if self.rebalanced:
            return self.shake(folder, ranks, ["run", self.scene, folder, stop, threads, *self.set], code)
        words = self.words(folder, "--ranks", ranks, "--threads", threads)
        words[words.index("--stop-after") + 1] = stop
        return run(self.program, words, code)

    def resume(self, folder, ranks, stop, code):
        if self.rebalanced:
            return self.shake(folder, ranks, ["resume", folder, stop], code)
        return run(self.program, ["resume", folder, "--quiet", "--ranks", ranks, "--stop-after", stop], code)

    def shake(self, folder, ranks, words, code):
        every = max(1, self.steps // 12)
        run("mpirun", ["--quiet", "--oversubscribe", "--bind-to", "none", "--allow-run-as-root", "-np", ranks,
                       self.rebalanced, every, *words], code)
        made = json.loads((folder / "summary.json").read_text()).get("ranks", {}).get("rebalancings", [])
        self.migrated += sum(one["chunks"] for one in made)

    def check(self, quick):
        alone = self.alone()
        for ranks, threads in [(3, 1)] if quick else RANKS_AND_THREADS:
            folder = self.scratch / f"{ranks}x{threads}"
            self.begin(folder, ranks, threads, self.steps, code=(0, 1, 3, 130))
            require_same(alone, folder, f"{self.name}, {ranks} ranks, {threads} threads")
        for first, then in ((3, 2),) if quick else ((3, 2), (1, 3), (2, 1)):
            self.check_resumed(alone, first, then)
        if self.rebalanced:
            if self.migrated == 0:
                raise Failed(f"{self.name}: no chunk has migrated")
            print(f"{self.name}: chunks have migrated {self.migrated} times")

    def check_resumed(self, alone, first, then):
        """Stopped in the middle, and once more, on other numbers of ranks."""
        folder = self.scratch / f"resumed-{first}-{then}"
        self.begin(folder, first, 1, self.steps // 3, code=(130,))
        for stop, ranks in ((2 * self.steps // 3, then), (self.steps, first)):
            self.resume(folder, ranks, stop, code=(0, 1, 3, 130))
        require_same(alone, folder, f"{self.name}, stopped on {first} ranks, resumed on {then}")


def ranks_of(launcher):
    """Process ids of the ranks below a launcher."""
    children = {}
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            stat = (entry / "stat").read_text()
        except OSError:
            continue
        parent = int(stat.rsplit(")", 1)[1].split()[1])
        children.setdefault(parent, []).append((int(entry.name), stat[stat.index("(") + 1:stat.rindex(")")]))
    found, waiting = [], [launcher]
    while waiting:
        for pid, name in children.get(waiting.pop(), []):
            waiting.append(pid)
            if name == "pulvis":
                found.append(pid)
    return found


def kill_a_rank(choose, launcher):
    """At a random moment; whether there was one to kill."""
    time.sleep(choose.uniform(0.3, 2.5))
    ranks = ranks_of(launcher.pid)
    if not ranks or launcher.poll() is not None:
        return False
    try:
        os.kill(choose.choice(ranks), signal.SIGKILL)
    except ProcessLookupError:
        return False
    return True


def run_with_kills(case, folder, choose, kills):
    """To its end, over as many kills as come before it; returns how many did."""
    killed, words = 0, case.words(folder, "--ranks", 3)
    words[words.index("--checkpoint-steps") + 1] = 50
    while True:
        launcher = subprocess.Popen([case.program, *map(str, words)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                    text=True)
        hit = killed < kills and kill_a_rank(choose, launcher)
        _, told = launcher.communicate(timeout=600)
        if launcher.returncode in (0, 1, 3, 130):
            return killed
        if launcher.returncode != 4 or not hit or "killed" not in told:
            raise Failed(f"exit {launcher.returncode}, killed: {hit}: {told}")
        killed += 1
        if list(folder.glob("checkpoint-*.h5")):
            words = ["resume", folder, "--quiet", "--ranks", choose.choice((2, 3, 4)), "--checkpoint-steps", 50,
                     "--stop-after", case.steps]
        elif "--overwrite" not in words:
            words.append("--overwrite")


def check_kills(program, root, kills, scratch, seed):
    """A rank is killed again and again; what `resume` leaves in the end is what one process leaves."""
    choose = random.Random(seed)
    case = Case(program, root, "friction", scratch)
    case.steps = 2000
    alone, killed, runs = case.alone(), 0, 0
    while killed < kills:
        folder = scratch / f"killed-{runs}"
        killed += run_with_kills(case, folder, choose, kills - killed)
        runs += 1
        require_same(alone, folder, f"killed {killed} times")
    print(f"a rank was killed {killed} times, in {runs} runs")


def check_full(program, root, scratch):
    """As much is written as fits; then all ranks end, and nothing that was there is lost."""
    case = Case(program, root, "friction", scratch)
    case.steps, most = 400, 8 << 20  # mpirun's own files are as large as half of it
    case.set = case.set + ["output.frames=5000", "output.samples=5000"]
    alone, folder = case.alone(), scratch / "full"
    words = case.words(folder, "--ranks", 3)
    words[words.index("--checkpoint-steps") + 1] = 100
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, timeout=300,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (most, most)))
    if done.returncode != 4 or "run.h5: cannot write" not in done.stderr or "pulvis resume" not in done.stderr:
        raise Failed(f"exit {done.returncode}: {done.stderr}")
    with h5py.File(folder / "run.h5") as file:
        frames = len(file["frames"])
    run(program, ["resume", folder, "--quiet", "--ranks", 2, "--stop-after", case.steps], code=(130,))
    require_same(alone, folder, "resumed after a full disk")
    print(f"{frames} frames fitted; resumed, and the same as one process")


def check_keys(program, root, scratch):
    """Every scene of tests/keys that ranks can share, to its end: whatever key there is, two ranks leave the same bits."""
    compared = 0
    for number, scene in enumerate(sorted((root / "tests/keys").glob("scenes*/*.toml"))):
        alone, folder = scratch / f"alone-{number}", scratch / f"ranks-{number}"
        done = run(program, ["run", scene, "-o", folder, "--quiet", "--ranks", 2], code=(0, 1, 2, 3))
        if done.returncode == 2:  # of a lever, or a part of another scene
            continue
        if summary_of(folder)["particles"] == 1:  # nothing to share out
            continue
        run(program, ["run", scene, "-o", alone, "--quiet", "--threads", 2], code=(0, 1, 3))
        require_same(alone, folder, f"{scene} on 2 ranks")
        compared += 1
    if compared < 20:
        raise Failed(f"only {compared} scenes were compared")
    print(f"{compared} scenes of keys: the same bits on ranks")


def check_stop(program, root, scratch):
    """A run that a health check stops within a step: the ranks complete it, but stop where one process does."""
    scene, folders, told = root / "scenes/extreme/stop-through.toml", [], []
    for ranks in (1, 2):
        folders.append(scratch / f"stopped-{ranks}")
        told.append(run(program, ["run", scene, "-o", folders[-1], "--quiet", "--threads", 1, "--ranks", ranks],
                        code=(0, 3)).stderr.replace(str(folders[-1]), "FOLDER"))
    alone, ranks = (summary_of(folder) for folder in folders)
    found = differences(*folders) + [key for key in ("steps", "time") if alone[key] != ranks[key]]
    if found or told[0] != told[1]:
        raise Failed(f"a run that stops is not the same on 2 ranks: {', '.join(found) or told}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("root", type=Path)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("--case", choices=CASES)
    what.add_argument("--kills", type=int)
    what.add_argument("--full", action="store_true")
    what.add_argument("--keys", action="store_true")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--rebalanced")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="pulvis-ranks-") as scratch:
        try:
            if options.case:
                case = Case(options.program, options.root, options.case, Path(scratch), options.rebalanced)
                case.check(options.quick)
            elif options.keys:
                check_keys(options.program, options.root, Path(scratch))
                check_stop(options.program, options.root, Path(scratch))
            elif options.full:
                check_full(options.program, options.root, Path(scratch))
            else:
                check_kills(options.program, options.root, options.kills, Path(scratch), options.seed)
        except Failed as failure:
            sys.exit(str(failure))


if __name__ == "__main__":
    main()
