#!/usr/bin/env python3
"""A study on a cluster of one node: Slurm of its own, started and stopped here, in a folder of its own.

    slurm_study.py PROGRAM SOURCE_DIR [--time-limit]

Runs of a study that Slurm does have the bits of a local study; none is started twice, stopped ones go on from their
checkpoints, and a node that is lost costs no finished run. --time-limit waits for real time limits instead, which
takes some minutes: by hand.
"""
import argparse
import csv
import ctypes
import getpass
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "scancel")
STUDY = """scene = "{scene}"
[set]
"stage.press.duration" = "{duration}"
"stage.press.move[0].displacement" = ["0 mm", "-0.6 mm"]
output.frames = 3
output.samples = 40
[grid]
contact.friction = {frictions}
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def end_with_parent():
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def comes(what, condition, seconds=40):
    """Waits for something; where it does not come, says what."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        found = condition()
        if found:
            return found
        time.sleep(0.05)
    raise AssertionError(f"{what}: not within {seconds} s")


class Cluster:
    """One node with two processors, whatever there really are. Authentication is munge's, with a key of its own."""

    def __init__(self, place):
        self.place = place
        for name in ("state", "spool"):
            (place / name).mkdir()
        (place / "munge").mkdir(mode=0o755)
        key = place / "munge/key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        controller, node = free_ports(2)
        host = socket.gethostname().split(".")[0]
        (place / "slurm.conf").write_text(f"""ClusterName=sandbox
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
AuthInfo=socket={place}/munge/socket,cred_expire=5
SlurmUser={getpass.getuser()}
SlurmdUser={getpass.getuser()}
StateSaveLocation={place}/state
SlurmdSpoolDir={place}/spool
SlurmctldPidFile={place}/slurmctld.pid
SlurmdPidFile={place}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=2
KillWait=5
BatchStartTimeout=1
MessageTimeout=2
MaxArraySize=4
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_interval=1
NodeName=node NodeHostname={host} NodeAddr=127.0.0.1 CPUs=2
PartitionName=main Nodes=node Default=YES MaxTime=60
""")
        self.environment = {**os.environ, "SLURM_CONF": str(place / "slurm.conf")}
        self.daemons = {}

    def __enter__(self):
        munge = self.place / "munge"
        self.start("munged", "--foreground", f"--key-file={munge}/key", f"--socket={munge}/socket",
                   f"--pid-file={munge}/pid", f"--log-file={munge}/log", f"--seed-file={munge}/seed")
        comes("munge's socket", (munge / "socket").exists)
        self.start("slurmctld", "-D")
        self.start_node()
        comes("an idle node", lambda: self.says("sinfo", "--noheader", "--format=%T") == "idle")
        return self

    def __exit__(self, *_):
        """Everything that has this cluster in its environment goes: daemons, steps of jobs, runs."""
        for _ in range(3):
            for process in self.processes():
                self.kill(process)
            for daemon in self.daemons.values():
                daemon.wait()
            time.sleep(0.05)

    def start(self, name, *options):
        with open(self.place / f"{name}.log", "ab") as log:
            self.daemons[name] = subprocess.Popen([shutil.which(name), *options], stdout=log, stderr=log,
                                                  stdin=subprocess.DEVNULL, env=self.environment,
                                                  preexec_fn=end_with_parent)

    def start_node(self):
        self.start("slurmd", "-D", "-N", "node", "-b")  # -b: the node says that it was started anew

    def lose_node(self):
        """What runs on it goes as if the power failed."""
        kept = [self.daemons[name].pid for name in ("munged", "slurmctld")]
        for process in self.processes():
            if process not in kept:
                self.kill(process)
        self.daemons["slurmd"].wait()

    def processes(self):
        mark = f"SLURM_CONF={self.place}/slurm.conf".encode()
        found = []
        for entry in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if mark in (entry / "environ").read_bytes().split(b"\0"):
                    found.append(int(entry.name))
            except OSError:  # it has ended, or is somebody else's
                pass
        return found

    @staticmethod
    def kill(process):
        try:
            os.kill(process, signal.SIGKILL)
        except ProcessLookupError:
            pass

    def says(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True,
                              check=False).stdout.strip()

    def waits(self):
        """Tasks that are waiting or running, and what they do."""
        return self.says("squeue", "--noheader", "--array", "--format=%i %T %r")

    def restarts(self, task):
        return int(re.search(r"Restarts=(\d+)", self.says("scontrol", "show", "job", task))[1])

    def logs(self):
        names = ("munged", "slurmctld", "slurmd")
        return "".join(f"--- {name}\n{(self.place / name).with_suffix('.log').read_text()[-3000:]}\n"
                       for name in names if (self.place / name).with_suffix(".log").exists())


class Check:
    def __init__(self, options, cluster, place):
        self.program, self.source = options.program.resolve(), options.source.resolve()
        self.cluster, self.place = cluster, place

    def write(self, name, frictions, duration):
        """A study whose runs take about a second for each 150 us."""
        file = self.place / name
        file.write_text(STUDY.format(scene=self.source / "scenes/compaction/regular-25.toml",
                                     frictions=frictions, duration=duration))
        return file

    def study(self, file, results, *options, code=0):
        end = subprocess.run([self.program, "study", file, "-o", results, *options], text=True,
                             env=self.cluster.environment, capture_output=True, check=False)
        assert end.returncode == code, f"{options}: exit code {end.returncode}\n{end.stdout}{end.stderr}"
        return end.stdout + end.stderr

    def submit(self, file, results, *options):
        told = self.study(file, results, "--slurm", *options)
        return re.search(r"submitted as Slurm job (\d+)", told)[1]

    @staticmethod
    def outcome(run):
        try:
            return json.loads((run / "summary.json").read_text())["outcome"]
        except FileNotFoundError:
            return ""

    @staticmethod
    def has_begun(run):
        return any(run.glob("checkpoint-*.h5"))

    def same_runs(self, local, results):
        """Files of the same names and the same bits, whoever ran them."""
        runs = sorted(folder for folder in local.iterdir() if (folder / "run.h5").exists())
        assert runs, local
        for run in runs:
            other = results / run.name
            mine, its = ({file.name for file in folder.iterdir()} for folder in (run, other))
            assert mine == its, f"{run.name}: {mine ^ its}"
            for name in ("scene.toml", "history.csv", "run.xdmf"):
                assert (run / name).read_bytes() == (other / name).read_bytes(), f"{run.name}/{name}"
            first, second = (json.loads((folder / "summary.json").read_text()) for folder in (run, other))
            for key in ("state_hash", "scene_hash", "steps", "outcome"):
                assert first[key] == second[key], f"{run.name}: {key}: {first[key]}, {second[key]}"
        tables = [list(csv.DictReader((folder / "study.csv").open())) for folder in (local, results)]
        for table in tables:
            for row in table:
                del row["wall_seconds [s]"]
        assert tables[0] == tables[1]

    def refusals(self):
        file, results = self.write("few.toml", "[0.1, 0.2, 0.3, 0.4, 0.5]", "60 us"), self.place / "refused"
        told = self.study(file, results, "--slurm", "--partition", "nowhere", "--array-size", "2", code=4)
        assert "invalid partition" in told, told
        told = self.study(file, results, "--slurm", code=4)  # five tasks, where MaxArraySize is 4
        assert "Invalid job array" in told and "a smaller --array-size" in told, told
        assert not self.cluster.waits()

    def whole_study(self):
        file = self.write("study.toml", "[0.1, 0.2, 0.3, 0.4, 0.5]", "180 us")
        local, results = self.place / "local", self.place / "cluster"
        self.study(file, local)
        job = self.submit(file, results, "--time", "5", "--array-size", "2")
        assert "nothing to submit" in self.study(file, results, "--slurm")
        told = self.study(file, results, code=130)
        assert "5 runs: 0 to do, 0 finished before" in told and "5 not finished yet" in told, told
        self.stop_one(job, results)
        finished = comes("a finished run beside one that runs", lambda: self.finished_beside_running(results))
        before = {run: (run / "summary.json").stat().st_mtime_ns for run in finished}
        self.cluster.lose_node()
        time.sleep(4)  # jobs that are younger than three seconds when a node returns may only be on their way to it
        self.cluster.start_node()
        comes("the end of the array", lambda: not self.cluster.waits())
        for run, when in before.items():
            assert (run / "summary.json").stat().st_mtime_ns == when, f"{run.name} was run again"
        told = self.study(file, results)
        assert "5 runs: 0 to do, 5 finished before" in told, told
        assert not (results / "slurm.json").exists()
        resumed = [log for log in results.glob("friction=*/log.txt") if "resumed at step" in log.read_text()]
        assert resumed, "no run went on from its checkpoint"
        self.same_runs(local, results)

    def finished_beside_running(self, results):
        runs = list(results.glob("friction=*"))
        done = [run for run in runs if self.outcome(run) == "done" and not self.has_begun(run)]
        return done if any(self.outcome(run) != "done" and self.has_begun(run) for run in runs) else []

    def stop_one(self, job, results):
        """The second and last task, whose own job number is that of the whole array, stops as at a time limit."""
        comes("a run of task 1", lambda: self.has_begun(results / "friction=0.2"))
        self.cluster.says("scancel", "--signal=USR1", "--batch", f"{job}_1")
        comes("task 1 queued again", lambda: self.cluster.restarts(f"{job}_1") == 1)
        assert self.outcome(results / "friction=0.2") == "interrupted"
        assert self.cluster.restarts(f"{job}_0") == 0, "the other task was stopped, too"

    def cancelled(self):
        """What somebody cancels stays so; a local study goes on with it."""
        file, results = self.write("cancelled.toml", "[0.1]", "240 us"), self.place / "cancelled"
        job = self.submit(file, results)
        comes("a run", lambda: self.has_begun(results / "friction=0.1"))
        self.cluster.says("scancel", job)
        comes("the end of the job", lambda: not self.cluster.waits())
        assert self.outcome(results / "friction=0.1") == "interrupted"
        told = self.study(file, results)
        assert "resumed from their checkpoints: 1" in told, told

    def time_limit(self):
        """A real one, of a minute: the signal comes up to a minute before, since Slurm looks twice a minute."""
        file = self.write("long.toml", "[0.1]", "40 ms")
        local, results = self.place / "local", self.place / "cluster"
        job = self.submit(file, results, "--time", "1")
        comes("the task queued again", lambda: self.cluster.restarts(f"{job}_0") > 0, 90)
        comes("the end of the array", lambda: not self.cluster.waits(), 600)
        self.study(file, results)
        self.study(file, local)
        self.same_runs(local, results)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("source", type=pathlib.Path)
    parser.add_argument("--time-limit", action="store_true")
    options = parser.parse_args()
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    missing = [name for name in PROGRAMS if shutil.which(name) is None]
    if missing:
        sys.exit(f"slurm_study: there is no {', '.join(missing)}: install Debian's slurm-wlm and munge")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("slurm_study: ended by SIGTERM"))  # and cleans up
    begin = time.monotonic()
    # munge wants every folder above its socket to be open to all: those of TMPDIR need not be.
    with tempfile.TemporaryDirectory(prefix="pulvis-slurm-", dir="/tmp") as folder:
        place = pathlib.Path(folder)
        place.chmod(0o755)
        (place / "slurm").mkdir()
        cluster = Cluster(place / "slurm")
        try:
            with cluster:
                check = Check(options, cluster, place)
                for part in [check.time_limit] if options.time_limit else [
                        check.refusals, check.whole_study, check.cancelled]:
                    part()
                    print(f"{part.__name__}: good after {time.monotonic() - begin:.0f} s", flush=True)
        except BaseException:
            print(cluster.logs(), file=sys.stderr)
            for log in place.glob("*/slurm/*.txt"):
                print(f"--- {log}\n{log.read_text()}", file=sys.stderr)
            raise
        left = cluster.processes()
        assert not left, f"still running: {left}"


if __name__ == "__main__":
    main()
