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
PATIENCE = 180  # s, on a busy machine


def run_of(folder, *options):
    """A run that takes minutes, also on a fast machine: it is killed. A frame comes about once a second: a page has 60 at most."""
    command = [PROGRAM, "run", SCENE, "-o", folder, "--threads", "1", "--quiet", "--set", "stage.press.duration=150 ms",
               "--set", "output.frames=2000", "--set", "output.samples=16000", *options]
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
    assert status == 200 and "connect-src 'self'" in page
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


class Browser:
    """Headless Chromium, spoken to through a pipe: a page that goes on loading has no end at which it could be dumped."""

    def __init__(self, profile):
        read_here, self.to = os.pipe()
        self.answers, write_here = os.pipe()
        command = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--no-first-run",
                   "--disable-background-networking", f"--user-data-dir={profile}", "--window-size=1300,1700",
                   "--remote-debugging-pipe", "about:blank"]

        def place():  # it reads from 3 and writes to 4
            ends = os.dup(read_here), os.dup(write_here)
            os.dup2(ends[0], 3)
            os.dup2(ends[1], 4)

        self.process = subprocess.Popen(command, pass_fds=(3, 4, read_here, write_here), preexec_fn=place,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(read_here)
        os.close(write_here)
        self.number, self.rest, self.session = 0, b"", {}
        page = next(one for one in self.call("Target.getTargets")["targetInfos"] if one["type"] == "page")
        self.session = {"sessionId": self.call("Target.attachToTarget", targetId=page["targetId"], flatten=True)["sessionId"]}

    def call(self, method, **params):
        self.number += 1
        os.write(self.to, json.dumps({"id": self.number, "method": method, "params": params, **self.session}).encode() + b"\0")
        while True:
            while b"\0" not in self.rest:
                got = os.read(self.answers, 1 << 20)
                assert got, "chromium has ended"
                self.rest += got
            one, self.rest = self.rest.split(b"\0", 1)
            answer = json.loads(one)
            if answer.get("id") == self.number:
                assert "result" in answer, (method, answer)
                return answer["result"]

    def value(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True)
        assert "exceptionDetails" not in answer, (expression, answer)
        return answer["result"].get("value")

    def status(self):
        return self.value("document.body ? {...document.body.dataset} : {}")

    def close(self):
        self.process.kill()
        self.process.wait()


def check_page(browser, condition, what):
    def look():
        status = browser.status()
        assert "error" not in status, status
        return status if condition(status) else None
    return until(look, what)


def check_growing_page(browser, address):
    browser.call("Page.navigate", url=address)
    first = check_page(browser, lambda now: int(now.get("frames", 0)) >= 2, "a page with frames")
    assert first["phase"] == "running" and browser.value("document.querySelector('.picture').dataset.drawn")
    assert re.search(r"^Running: [\d.]+ % done, about ", browser.value("document.getElementById('live').textContent"))
    # The reader's choices stay; the picture stays at the last frame, or at the one that was chosen.
    browser.value("document.getElementById('curve').value = 3; document.getElementById('curve').onchange()")
    chosen = browser.value("document.getElementById('curve').selectedOptions[0].text")
    second = check_page(browser, lambda now: int(now["frames"]) > int(first["frames"]), "more frames")
    assert int(second["samples"]) > int(first["samples"])
    assert browser.value("document.getElementById('curve').selectedOptions[0].text") == chosen
    last = "document.getElementById('frame').value === document.getElementById('frame').max"
    assert browser.value(last), "it does not follow the run"
    browser.value("document.getElementById('frame').value = 1; document.getElementById('frame').oninput()")
    check_page(browser, lambda now: int(now["version"]) > int(second["version"]), "still more of the run")
    assert not browser.value(last), "it has left the frame that was chosen"
    assert not browser.value("document.querySelector('.live button').hidden")
    browser.value("document.querySelector('.live button').click()")
    assert browser.value(last)
    print("ok: the page grows, and keeps what was chosen")


def check_watch(work):
    folder = work / "killed"
    run = run_of(folder)
    until(lambda: (folder / "run.h5").exists(), "run.h5")
    process, address = watch(folder)
    browser = Browser(work / "profile")
    try:
        check_growth(address)
        check_door(address, folder)
        check_growing_page(browser, address)
        run.kill()
        run.wait()
        before = files_of(folder)
        check_page(browser, lambda now: now["phase"] == "gone", "that it was killed")
        assert "it was killed" in browser.value("document.getElementById('live').textContent")
        assert files_of(folder) == before, "something was written into the folder"
        print("ok: nothing is written into the folder")
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE) == 0
        check_page(browser, lambda now: "lost" in now, "that the view has ended")
        print("ok: the page says that the run was killed, and stays")
    finally:
        browser.close()
        for each in (run, process):
            each.kill()
            each.wait()


def check_run_live(work):
    """The run ends with its own exit code once the page knows its end."""
    run = run_of(work / "live", "--live", "--set", "stage.press.duration=20 us",
                 "--set", 'stage.press.move[0].displacement=["0 mm", "-0.4 mm"]', "--set", "output.frames=8", "--set", "output.samples=16")
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
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as name:
        work = pathlib.Path(name)
        os.environ["HOME"] = name
        check_no_run(work)
        check_watch(work)
        check_run_live(work)


main()
