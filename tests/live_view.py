#!/usr/bin/env python3
"""Live views: `pulvis watch` of runs that go on, end, are killed or are none, and `pulvis run --live`.

    live_view.py PROGRAM SOURCE_DIR

The page is served while the run goes on, and its samples and frames get more; only to who knows the word in the address,
and only what is new. Nothing is written into the folder. In headless Chromium the page shows a picture that grows, and
says that the run was killed.
"""
import http.client
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request

PROGRAM, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
SCENE = SOURCE / "scenes/compaction/regular-25.toml"
PATIENCE = 60  # s, on a busy machine


def run_of(folder, *options):
    """A run that takes long enough to be watched."""
    command = [PROGRAM, "run", SCENE, "-o", folder, "--threads", "1", "--quiet", "--set", "output.frames=400",
               "--set", "output.samples=800", *options]
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def watch(folder, *options):
    """The process and the address that it printed."""
    process = subprocess.Popen([PROGRAM, "watch", folder, *options], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    address = process.stdout.readline().strip()
    assert re.fullmatch(r"http://127\.0\.0\.1:\d+/[0-9a-f]{32}/", address), (address, process.communicate())
    return process, address


def get(address):
    try:
        with urllib.request.urlopen(address, timeout=PATIENCE) as answer:
            return answer.status, answer.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, ""


def ask(address, what, since=0):
    status, text = get(f"{address}{what}?since={since}")
    assert status == 200, (what, status)
    return json.loads(text)


def until(condition, what):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.1)
    raise AssertionError(f"not in {PATIENCE} s: {what}")


def files_of(folder):
    return {path.name: (path.stat().st_size, path.stat().st_mtime_ns) for path in folder.rglob("*")}


def refused(*command):
    """The message of a command that ends with exit code 2."""
    done = subprocess.run([PROGRAM, *command], capture_output=True, text=True, timeout=PATIENCE, check=False)
    assert done.returncode == 2 and not done.stdout, (command, done)
    return done.stderr


def report_with(address, frames, since=0):
    """The data once they have that many frames."""
    def look():
        ask(address, "state", since)
        report = ask(address, "report", since)
        return report if report["head"] and len(report["head"].get("frames", [])) >= frames else None
    return until(look, f"{frames} frames")


def check_growth(address):
    first = report_with(address, 1)
    later = report_with(address, len(first["head"]["frames"]) + 2, first["version"])
    assert later["version"] > first["version"]
    assert later["head"]["samples"] > first["head"]["samples"], "no more samples"
    assert first["sections"]["cells"] and later["sections"]["cells"] is None, "the mesh is sent again"
    assert later["sections"]["history"], "the new samples are not sent"
    state = ask(address, "state")["state"]
    assert state["phase"] == "running" and 0 < state["time"] < state["end"] and state["left"] > 0, state
    print("ok: frames and samples come, and only what is new")


def check_door(address, folder):
    status, page = get(address)
    assert status == 200 and "connect-src 'self'" in page and "http" + "s://" not in page
    port = int(re.search(r":(\d+)/", address)[1])
    word = address.rstrip("/").rsplit("/", 1)[1]
    for wrong in ("/", "/report", f"/{word[:-1]}x/", f"/{word[:-1]}x/state", f"/{word}/run.h5", f"/{word}/../"):
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=PATIENCE)
        connection.request("GET", wrong)
        assert connection.getresponse().status == 404, wrong
    told = refused("watch", folder, "--port", str(port))
    assert str(port) in told and "--port" in told, told
    print("ok: only for who knows the address; a port in use is refused")


def check_no_run(folder):
    assert "no such folder" in refused("watch", folder / "none")
    (folder / "empty").mkdir()
    assert "holds no run" in refused("watch", folder / "empty")
    print("ok: a folder that is no run is refused")


def body_in_browser(address, work, seconds):
    """The <body> tag after that time."""
    command = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
               f"--user-data-dir={work}/profile", "--window-size=1200,1600", f"--timeout={1000 * seconds}", "--dump-dom", address]
    page = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=True).stdout
    return page, re.search(r"<body[^>]*>", page)[0]


def check_page(address, work, phase, words):
    page, body = body_in_browser(address, work, 5)
    assert "data-error" not in body and f'data-phase="{phase}"' in body and "data-ready" in body, body
    assert int(re.search(r'data-frames="(\d+)"', body)[1]) >= 3, body
    assert re.search(r'<canvas class="picture"[^>]* data-drawn="\d+ effective_stress"', page), "no picture"
    assert re.search(words, page), f"the page does not say: {words}"
    print(f"ok: the page of a run that is {phase}")


def check_watch(work):
    folder = work / "killed"
    run = run_of(folder)
    until(lambda: (folder / "run.h5").exists(), "run.h5")
    process, address = watch(folder)
    try:
        check_growth(address)
        check_door(address, folder)
        check_page(address, work, "running", r"Running: [\d.]+ %")
        run.kill()
        run.wait()
        before = files_of(folder)
        until(lambda: ask(address, "state")["state"]["phase"] == "gone", "that it was killed")
        check_page(address, work, "gone", "it was killed")
        assert files_of(folder) == before, "something was written into the folder"
        print("ok: nothing is written into the folder")
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE) == 0
    finally:
        for each in (run, process):
            each.kill()
            each.wait()


def check_run_live(work):
    """The run ends with its own exit code once the page knows its end."""
    run = run_of(work / "live", "--live", "--set", "stage.press.duration=20 us",
                 "--set", 'stage.press.move[0].displacement=["0 mm", "-0.4 mm"]', "--set", "output.frames=8")
    try:
        address = until(lambda: re.search(r"http://\S+/", run.stderr.readline()), "the address")[0]
        report_with(address, 1)
        version, state = 0, {"last": False}
        while not (state["last"] and state["version"] == version):
            state = ask(address, "state", version)
            version = ask(address, "report", version)["version"]
        assert state["state"]["phase"] == "ended" and state["state"]["outcome"] == "done", state
        assert run.wait(PATIENCE) == 0
        assert len(ask_nothing(address)) == 0
    finally:
        run.kill()
        run.wait()
    print("ok: run --live ends when the page knows the end")


def ask_nothing(address):
    try:
        return get(address)[1]
    except OSError:
        return ""


def main():
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        os.environ["HOME"] = name
        check_no_run(work)
        check_watch(work)
        check_run_live(work)


main()
