#!/usr/bin/python3
"""Makes docs/gallery.md: every scene below is run by the built program, and its picture drawn.

  /usr/bin/python3 docs/site/gallery.py             all of them; runs that the same program has made before are kept
  /usr/bin/python3 docs/site/gallery.py ring salt   only those whose scene has one of these in its name; the others stay as they are
  /usr/bin/python3 docs/site/gallery.py --kept      the page of what has been run so far, by any version of the program; nothing is run
  /usr/bin/python3 docs/site/gallery.py --list

Results are in build/gallery, pictures in docs/pictures/gallery. Run times are processor times of this machine.
"""
import argparse
import dataclasses
import hashlib
import json
import pathlib
import re
import resource
import subprocess
import sys

from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build/release/cli/pulvis"
RUNS = ROOT / "build/gallery"
PICTURES = ROOT / "docs/pictures/gallery"


@dataclasses.dataclass(frozen=True)
class Picture:
    scene: str          # below scenes/, without .toml
    sentence: str
    field: str = ""     # drawn; empty: `figure`
    figure: str = ""    # the name of one of all figures of the run
    frame: str = ""     # empty: the last one
    run: tuple = ()     # further options of `run`

    @property
    def name(self):
        return self.scene.replace("/", "-").replace("+", "plus")

    def command(self):
        return " ".join(["./pulvis run", f"scenes/{self.scene}.toml", *self.run])


CHAPTERS = {
    "Compaction in two dimensions": (
        Picture("compaction/regular-25", "Twenty-five discs of steel in a die; the dies of the thesis.", "effective_stress"),
        Picture("compaction/random-100", "A hundred discs at random: chains of particles carry the load.", "plastic_strain"),
        Picture("compaction/ejection-25", "Pressed, unloaded and pushed out of the die.", "pressure"),
        Picture("compaction/drawn-punch", "A punch with a profile from an SVG drawing.", "effective_stress"),
        Picture("basic/traced-grain", "A grain whose outline was traced from an image.", "effective_stress"),
        Picture("periodic/soft-pentagons", "Soft pentagons in a periodic cell, without walls.", "pressure"),
    ),
    "Compaction in three dimensions": (
        Picture("compaction-3d/one-sphere", "A sphere between two plates, pressed by a quarter of its diameter.", "plastic_strain"),
        Picture("compaction-3d/unit-cell-fcc", "The face-centred cubic cell in a closing box.", "effective_stress"),
        Picture("compaction-3d/random-30-316L", "Thirty spheres at random, pressed to a relative density of 0.9 and released.",
                "effective_stress", frame="50"),
        Picture("compaction-3d/superquadrics", "Thirty rounded boxes, pressed.", "effective_stress"),
        Picture("periodic/spheres-shear", "Thirty copper spheres in a periodic cell, pressed and sheared without walls.", "effective_stress"),
        Picture("compaction-3d/tablet", "A tablet in a cylindrical die: pressed, unloaded, ejected. Nothing bonds its particles, so they part outside.", "effective_stress"),
    ),
    "Shear and friction": (
        Picture("shear/grooves-16", "A compact drawn over a grooved plate.", "effective_stress"),
        Picture("shear/irregular-powder", "A hundred irregular particles over a rough surface, under a constant force.", "plastic_strain"),
        Picture("basic/oblique-impact", "A disc hits a wall at an angle, with friction.", "effective_stress"),
    ),
    "Bonds and breakage": (
        Picture("bonds/brazilian-disc", "The Brazilian test: a disc of grains split across its diameter.", "damage"),
        Picture("bonds/crushed-particle", "A brittle particle crushed between plates.", "fragment"),
        Picture("brittle/salt-and-copper", "Brittle salt and ductile copper in one die.", "damage"),
    ),
    "Atomic force microscope": (
        Picture("afm/calibration-v", "A V-shaped cantilever, calibrated with unit forces.", figure="solid"),
        Picture("afm/loop-beam-12.5", "A friction loop, trace and retrace on a slope.", figure="friction_loop"),
        Picture("afm/jkr-force-curve", "A force curve of a sticky sphere, with snap-in and pull-off.", figure="force_curve"),
    ),
}


def key_of(picture):
    text = subprocess.run([PROGRAM, "check", "--print", ROOT / f"scenes/{picture.scene}.toml"], capture_output=True,
                          text=True, check=True).stdout
    program = hashlib.sha256(PROGRAM.read_bytes()).hexdigest()
    return hashlib.sha256((program + text + " ".join(picture.run)).encode()).hexdigest()


def run(picture):
    """The run's folder, and its processor time in s; it is run unless that was done."""
    folder, key = RUNS / picture.name, key_of(picture)
    stamp = RUNS / f"{picture.name}.json"
    if stamp.exists() and (kept := json.loads(stamp.read_text()))["key"] == key:
        return folder, kept["seconds"]
    command = [PROGRAM, "run", ROOT / f"scenes/{picture.scene}.toml", "-o", folder, "--overwrite", "--quiet", "--threads", "2",
               *picture.run]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        sys.exit(f"{picture.scene}: exit code {done.returncode}\n{done.stderr[-2000:]}")
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    stamp.write_text(json.dumps({"key": key, "seconds": seconds}))
    return folder, seconds


def draw(picture, folder):
    drawn = RUNS / f"{picture.name}-figures"
    options = ["--field", picture.field, "-o", drawn / "field.png"] if picture.field else ["-o", drawn]
    options += ["--frame", picture.frame] if picture.frame else []
    drawn.mkdir(exist_ok=True)
    done = subprocess.run([PROGRAM, "figure", folder, *options, "--no-title", "--width", "100mm", "--dpi", "130"],
                          capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{picture.scene}: no picture\n{done.stderr[-2000:]}")
    file = drawn / f"{picture.figure or 'field'}.png"
    if not file.exists():
        sys.exit(f"{picture.scene}: no {file.stem} among {sorted(f.stem for f in drawn.glob('*.png'))}")
    with Image.open(file) as image:  # 256 colours: a third of the bytes
        image.convert("RGB").quantize(256).save(PICTURES / f"{picture.name}.png", optimize=True)


def time_text(seconds):
    return "less than a second" if seconds < 1 else f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min"


def processor():
    found = re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text())
    return f"an {found[1]}" if found else "this machine"


def page(rows, machine):
    lines = ["# Gallery", "",
             "Every picture is the result of one command, made by the program as it is "
             "(`/usr/bin/python3 docs/site/gallery.py`). Times are processor times of one run on "
             f"{machine}.", ""]
    for chapter, pictures in CHAPTERS.items():
        lines += [f"## {chapter}", ""]
        for picture in [p for p in pictures if p.name in rows]:
            lines += [f"### {rows[picture.name][0]}", "",
                      f"![{rows[picture.name][0]}](pictures/gallery/{picture.name}.png)", "",
                      f"{picture.sentence} Processor time {rows[picture.name][1]}.", "", "```",
                      picture.command(), "```", ""]
    (ROOT / "docs/gallery.md").write_text("\n".join(lines))


def rows_of_page(pictures):
    """Titles and times that the page has now, and the processor of these times."""
    text = (ROOT / "docs/gallery.md").read_text()
    found = {p.name: re.search(rf"^!\[(.*)\]\(pictures/gallery/{re.escape(p.name)}\.png\)\n\n.*Processor time (.*)\.$", text, flags=re.M)
             for p in pictures}
    return ({name: (match[1], match[2]) for name, match in found.items() if match},
            re.search(r"processor times of one run on (.*)\.$", text, flags=re.M)[1])


def title(folder):
    return re.search(r'^title = "(.*)"', (folder / "scene.toml").read_text(), flags=re.M)[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("name", nargs="*", help="only scenes with one of these in their name")
    parser.add_argument("--kept", action="store_true", help="write the page of what has been run, and run nothing")
    parser.add_argument("--list", action="store_true", help="name the scenes and stop")
    options = parser.parse_args()
    pictures = [p for chapter in CHAPTERS.values() for p in chapter]
    if options.list:
        print("\n".join(p.scene for p in pictures))
        return
    PICTURES.mkdir(parents=True, exist_ok=True)
    RUNS.mkdir(parents=True, exist_ok=True)
    if options.kept:
        pictures = [p for p in pictures if (RUNS / f"{p.name}.json").exists()]
    chosen = [p for p in pictures if not options.name or any(n in p.name for n in options.name)]
    rows, machine = rows_of_page(pictures) if options.name else ({}, processor())
    other = "" if machine == processor() else f" on {processor()}"
    for picture in chosen:
        if options.kept:
            folder, seconds = RUNS / picture.name, json.loads((RUNS / f"{picture.name}.json").read_text())["seconds"]
        else:
            folder, seconds = run(picture)
            draw(picture, folder)
        rows[picture.name] = (title(folder), time_text(seconds) + other)
        print(f"{picture.scene}: {rows[picture.name][1]}", flush=True)
    page(rows, machine)


if __name__ == "__main__":
    main()
