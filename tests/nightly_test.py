"""bench/nightly.py with two studies of a few steps, one good, one whose expectation is not met, and with a scene; what its log and
exit code say, and that what is finished is kept.

usage: nightly_test.py PROGRAM SOURCE_DIR FOLDER
"""
import json
import shutil
import subprocess
import sys
from pathlib import Path

program, root, folder = Path(sys.argv[1]), Path(sys.argv[2]), Path(sys.argv[3])
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)

STUDY = '''scene = "{scene}"
[set]
"stage.press.duration" = "20 us"
"stage.press.move[0].displacement" = ["0 mm", "-0.4 mm"]
output.frames = 2
output.samples = 40
[[variation]]
name = "one"
[[expect]]
series = "relative_density"
of = "one"
{bound}
'''
for name, bound in (("kept", "above = 0.7"), ("broken", "above = 0.9")):
    (folder / f"{name}.toml").write_text(STUDY.format(scene=root / "scenes/compaction/regular-25.toml", bound=bound))


def nightly(*studies):
    done = subprocess.run(["/usr/bin/python3", root / "bench/nightly.py", *studies, "-o", folder / "out", "--jobs", "1",
                           "--program", program], capture_output=True, text=True)
    log = folder / "out/nightly.md"
    return done.returncode, log.read_text() if log.exists() else "", done.stdout + done.stderr


code, log, said = nightly(folder / "kept.toml")
assert code == 0, said
assert "| kept | 1 | 1 of 1 |" in log and "| 0: good |" in log, log
first = (folder / "out/kept/one/history.csv").stat().st_mtime_ns

code, log, said = nightly(folder / "broken.toml", folder / "kept.toml")  # a bad one does not keep the next from running
assert code == 1 and "not good: broken" in said, said
assert "| broken | 1 | 0 of 1 |" in log and "| 3: " in log and "- NOT met" in log, log
assert "| kept | 1 | 1 of 1 |" in log, log
assert (folder / "out/kept/one/history.csv").stat().st_mtime_ns == first, "a finished run was run again"

code, log, said = nightly("no-such-study")
assert code == 2 and "no such study" in said and "wall-friction" in said and "brittle/crushed-bed" in said, said

code, log, said = nightly("basic/oblique-impact")
assert code == 0 and "| basic/oblique-impact | 1 | 2 of 2 |" in log and "- met energy_balance_error" in log, said + log
summary = folder / "out/scenes/basic/oblique-impact/summary.json"
written = summary.stat().st_mtime_ns
nightly("basic/oblique-impact")
assert summary.stat().st_mtime_ns == written, "a finished scene was run again"
summary.write_text(json.dumps(json.loads(summary.read_text()) | {"energy_balance_error": 0.5}))
code, log, said = nightly("basic/oblique-impact")
assert code == 1 and "| basic/oblique-impact | 1 | 1 of 2 |" in log and "- NOT met energy_balance_error" in log, said + log
