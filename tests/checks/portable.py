#!/usr/bin/python3
"""What goes into the state of a run is made with functions that have the same bits on every machine.

usage: portable.py [ROOT]

Refuses elementary functions and distributions of the library at hand (std::sin, Eigen's Rotation2D,
std::normal_distribution ...) in engine, components, systems and scenes. Exit code 1 then. Files whose figures are
only told, after the run or beside it, are listed below; so is all of cli.
"""
import re
import sys
from pathlib import Path

FOLDERS = ("engine", "components", "systems", "scenes")
SUFFIXES = {".hpp", ".cpp", ".h", ".ipp", ".inl"}
OURS = {"sin", "cos", "tan", "acos", "atan", "atan2", "exp", "log", "pow", "cbrt", "hypot"}
OTHERS = {"asin", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "exp2", "expm1", "log2", "log10", "log1p",
          "erf", "erfc", "tgamma", "lgamma", "beta", "riemann_zeta", "legendre", "ellint_1", "ellint_2",
          "cyl_bessel_j", "polar", "arg", "sincos", "complex"}
TOLD = {  # reductions of records, fits of curves, laws that a result is laid beside, warnings at a run's end
    "scenes": ("lab_", "wedge_", "study_", "cooper_eaton", "density_fits", "density_fit_errors", "compaction_curve",
               "afm_closed_forms", "loop_plateau", "contact_findings"),
}
NAMES = "|".join(sorted(OURS | OTHERS))
RULES = [
    # portable::sin( is ours; a member (x.exp()) is Eigen's.
    (re.compile(rf"(?<![\w:])(?:std::|::|numext::)*({NAMES})\s*[(<]"), None),
    (re.compile(r"using\s+std::(" + NAMES + r")\b"), None),
    (re.compile(rf"(?:\.|->)({NAMES}|stableNorm|blueNorm|hypotNorm)\s*\(\s*\)"), None),
    (re.compile(r"\b(Rotation2D[df]?|AngleAxis[df]?|Quaternion[df]?|EulerAngles\w*)\b"),
     "rotation() of scenes/spec/rotation.hpp"),
    (re.compile(r"\b(\w+_distribution|uniform_real\w*|generate_canonical|default_random_engine|random_device"
                r"|random_shuffle|shuffle)\b"), "Random of scenes/outlines/portable.hpp"),
]
COMMENT = re.compile(r"//.*")
TEXT = re.compile(r'"(\\.|[^"\\])*"')


def is_told(folder, name):
    return name.startswith(TOLD.get(folder, ()))


def faults(source):
    for number, line in enumerate(source.read_text(encoding="utf-8").splitlines(), 1):
        if line.lstrip().startswith("#include"):
            continue
        code = COMMENT.sub("", TEXT.sub('""', line))
        for rule, instead in RULES:
            for match in rule.finditer(code):
                name = match[1]
                yield number, name, instead or (f"portable::{name}" if name in OURS else
                                                "one of " + ", ".join(sorted(OURS)) + " in portable::")


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    files, wrong = 0, []
    for folder in FOLDERS:
        for source in sorted((root / folder).rglob("*")):
            if source.suffix not in SUFFIXES or is_told(folder, source.name) \
                    or source.name.startswith("portable_math.") or source.name == "rotation.hpp":
                continue
            files += 1
            wrong += [f"{source.relative_to(root)}:{number}: {name} has other bits on other machines: allowed is "
                      f"{instead} (engine/portable_math.hpp)" for number, name, instead in faults(source)]
    print(*wrong, sep="\n", end="\n" if wrong else "")
    if files == 0:
        sys.exit(f"portable: no source under {root}: is this the root?")
    print(f"portable: {files} files, {len(wrong)} functions of the library at hand")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
