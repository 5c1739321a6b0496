"""docs/*.schema.json by a JSON-schema library, as an editor would: every shipped scene is valid, as it is written and as
`pulvis check --print` completes it, and wrong ones are refused.

usage: schema_test.py PROGRAM SOURCE_DIR
"""
import copy
import json
import subprocess
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from jsonschema import Draft202012Validator

program, root = Path(sys.argv[1]), Path(sys.argv[2])
FEWEST = 100  # shipped scenes; fewer: they have moved, and nothing is tested


def schema(name):
    text = json.loads((root / "docs" / f"{name}.schema.json").read_text(encoding="utf-8"))
    Draft202012Validator.check_schema(text)
    return text


SCENE, REDUCTION = (schema(name) for name in ("scene", "reduce"))


def tables(path):
    return tomllib.loads(path.read_text(encoding="utf-8"))


def whole(path):
    """With the tables of the extended files, whose order does not matter here."""
    scene = tables(path)
    return {**whole(path.parent / scene["extends"]), **scene} if "extends" in scene else scene


def faults(scene, language):
    return [f"{error.json_path}: {error.message[-200:]}" for error in Draft202012Validator(language).iter_errors(scene)]


def is_part(path):
    """Only for others to extend."""
    return path.parent == root / "scenes/parts" or path.name.startswith("part-")


def faults_of_file(path):
    scene = tables(path)
    if is_part(path):  # an editor would miss in it what is left to the others
        scene.setdefault("extends", "another.toml")
    return faults(scene, SCENE)


def faults_of_print(path):
    done = subprocess.run([program, "check", path, "--print"], capture_output=True, text=True)
    assert done.returncode == 0, f"{path}: {done.stderr}"
    return faults(tomllib.loads(done.stdout), SCENE)


def shipped():
    files = sorted([*root.glob("scenes/**/*.toml"), *root.glob("tests/keys/scenes*/*.toml")])
    return [path for path in files if "family" in whole(path)]


def places(value, at=()):
    """Every value of a scene with the way to it."""
    yield at, value
    if isinstance(value, (dict, list)):
        for key, inner in value.items() if isinstance(value, dict) else enumerate(value):
            yield from places(inner, (*at, key))


def changed(scene, at, value):
    scene = copy.deepcopy(scene)
    inner = scene
    for key in at[:-1]:
        inner = inner[key]
    if value is None:
        del inner[at[-1]]
    else:
        inner[at[-1]] = value
    return scene


def is_quantity(value):
    return isinstance(value, str) and value[:1].isdigit() and " " in value and value.split()[-1].isalpha()


def wrong_scenes(scene):
    """What is wrong, and a scene with it: a key that does not exist, numbers without their unit, values of another type."""
    for at, value in places(scene):
        where = ".".join(map(str, at))
        if isinstance(value, dict) and at[:1] != ("let",):
            yield f"{where}.no_such_key", changed(scene, (*at, "no_such_key"), 1)
        if is_quantity(value) and at[:1] not in (("let",), ("expect",), ("title",)):  # expectations may be numbers
            number = value.split()[0]
            for wrong in (number, f"{number}e3", float(number), f"{number} 5", [value]):
                yield f"{where} = {wrong}", changed(scene, at, wrong)
        if isinstance(value, bool):
            yield f"{where} = 1", changed(scene, at, 1)


def check_wrong(path, *more):
    """more: (keys, value) or (keys, None), without it."""
    scene = tables(path)
    assert not faults(scene, SCENE), path
    several = [*wrong_scenes(scene), *((f"{at} = {value}", changed(scene, at, value)) for at, value in more)]
    accepted = [what for what, wrong in several if not faults(wrong, SCENE)]
    assert not accepted, f"{path}: not refused: {accepted}"
    return len(several)


def check_scenes():
    scenes = shipped()
    assert len(scenes) >= FEWEST, len(scenes)
    found = {path: faults_of_file(path) for path in scenes}
    with ThreadPoolExecutor(2) as pool:
        complete = [path for path in scenes if not is_part(path) and root / "scenes" in path.parents]
        for path, told in zip(complete, pool.map(faults_of_print, complete)):
            found[path] += told
    bad = [f"{path.relative_to(root)}: {told}" for path, told in found.items() if told]
    assert not bad, "\n".join(bad)
    reductions = [path for folder in ("scenes/lab", "tests/keys/settings") for path in (root / folder).glob("*.toml")
                  if not {"extends", "parameter"} & set(tables(path))]  # scenes of a fit
    bad = [f"{path}: {told}" for path in reductions if (told := faults(tables(path), REDUCTION))]
    assert reductions and not bad, "\n".join(bad)
    return len(scenes), len(complete), len(reductions)


def check_all_wrong():
    def size(key):
        return "packing", 0, "class", 0, key

    return (check_wrong(root / "scenes/compaction/regular-100.toml", (("family",), None), (("material",), None),
                        (("stage",), None), (("particle",), None), (("family",), "compression"), (("particle", 0, "outline"), "disk"),
                        (("particle", 0, "width"), "1 mm"), (("contact", "friction"), -0.1), (("afm",), {}))
            + check_wrong(root / "scenes/compaction/biaxial.toml", (size("mean"), "1 mm"), (size("distribution"), "normal"),
                          (size("distribution"), "sieve"), (size("distribution"), "narrow"), (size("file"), "sieve.csv"))
            + check_wrong(root / "scenes/compaction-3d/tablet.toml", (("dimension",), 4), (("particle", 0, "shape"), "disc"),
                          (size("deviation"), "1 mm"), (size("distribution"), "lognormal"))
            + check_wrong(root / "scenes/bonds/brazilian-disc.toml",
                          *((("material", 0, "damping", "mass_proportional"), wrong) for wrong in ("20000", "20000 1", 20000)))
            + check_wrong(root / "scenes/afm/calibration-beam.toml", (("lever",), None), (("particle",), [])))


if __name__ == "__main__":
    print("ok: {} scenes, {} of them also completed, and {} settings of reductions; ".format(*check_scenes())
          + f"{check_all_wrong()} wrong scenes are refused")
