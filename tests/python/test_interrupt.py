"""Ctrl-C: KeyboardInterrupt, with the run's files whole."""
import json
import os
import signal
import subprocess
import sys
import time

SCRIPT = """
import sys, pulvis
scene = pulvis.Scene(sys.argv[1])
sim = scene.simulation(threads=1, folder=sys.argv[2])
print("running", flush=True)
try:
    sim.run()
except KeyboardInterrupt:
    print("interrupted", sim.steps, flush=True)
    steps = sim.steps
    sim.step(5)
    print("went on", sim.steps - steps, flush=True)
"""


def test_ctrl_c_raises_when_the_files_are_whole(scenes, tmp_path):
    folder = tmp_path / "run"
    scene = scenes / "compaction/regular-25.toml"
    child = subprocess.Popen([sys.executable, "-c", SCRIPT, scene, folder], stdout=subprocess.PIPE, text=True,
                             env=dict(os.environ))
    assert child.stdout.readline() == "running\n"
    while not list(folder.glob("checkpoint-*.h5")):
        time.sleep(0.05)
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=120)
    assert child.returncode == 0
    word, steps = out.splitlines()[0].split()
    assert word == "interrupted" and int(steps) > 0
    assert out.splitlines()[1] == "went on 5"
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["outcome"] == "interrupted" and summary["steps"] == int(steps) + 5
    assert (folder / f"checkpoint-{int(steps) + 5:012}.h5").is_file()


LEVER = """
import sys, threading, os, signal, pulvis
scene = pulvis.Scene(sys.argv[1])
lever = scene.simulation(folder=sys.argv[2])
@lever.on_sample
def _(lever):
    if len(lever.history["actions"]) == 3:
        os.kill(os.getpid(), signal.SIGINT)
try:
    lever.run()
except KeyboardInterrupt:
    print("interrupted", lever.outcome, flush=True)
"""


def test_a_lever_is_interrupted_too(scenes, tmp_path, program, read_summary):
    scene = scenes / "afm/loop-beam-0.toml"
    done = subprocess.run([sys.executable, "-c", LEVER, scene, tmp_path / "run"], capture_output=True, text=True)
    assert done.stdout == "interrupted interrupted\n", done.stderr
    assert read_summary(tmp_path / "run")["outcome"] == "interrupted"
    assert list((tmp_path / "run").glob("checkpoint-*.h5"))
