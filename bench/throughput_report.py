"""The output of bench/throughput.py, and quantities derived from several of its lines."""
import re

CONTACT = re.compile(r"^system/.*(contact|bin|tool_reaction)")
LARGER = ("1683", "10000")  # than 100 particles, otherwise equal
UPDATES = ("step", "kernels", "limit", "run/step")  # whole element updates, or the part of the bodies
COUNTED = "100"  # the case with counted instructions and operations; also used for the larger cases
THESIS_STEPS = 94_000

# what, case, line, threads, must, target; a minimum if the first is "M/s" or "x", otherwise a maximum.
AIMS = (
    ("M/s", "element-updates, 100 particles, 2 threads", "100", "step", 2, 80, 130),
    ("M/s", "element-updates, 1,683 particles, 2 threads", "1683", "step", 2, 80, 120),
    ("M/s", "element-updates, 10,000 particles, 2 threads", "10000", "step", 2, 60, 100),
    ("M/s", "internal force and return map, 100, 1 thread", "100", "kernels", 1, None, 110),
    ("M/s", "internal force and return map, 100, 2 threads", "100", "kernels", 2, None, 200),
    ("x", "kernels over the bare loop, 100, 1 thread", "100", "kernels/of_limit", 1, None, 0.85),
    ("x", "kernels over the bare loop, 100, 2 threads", "100", "kernels/of_limit", 2, None, 0.85),
    ("x", "step over the bare loop, 100, 2 threads", "100", "step/of_limit", 2, None, 0.55),
    ("x", "step over the bare loop, 1,683, 2 threads", "1683", "step/of_limit", 2, None, 0.5),
    ("x", "step over the bare loop, 10,000, 2 threads", "10000", "step/of_limit", 2, None, 0.45),
    ("s", "the thesis's hour: 100 particles, 94,000 steps", "thesis", "94,000_steps", 2, 20, 12),
    ("B", "memory an element, 100 particles", "100", "memory/columns", 1, 600, None),
    ("B", "memory an element, 1,683 particles", "1683", "memory/columns", 1, 600, None),
    ("B", "memory an element, 10,000 particles", "10000", "memory/columns", 1, 600, None),
    ("s", "start-up, 100 particles", "100", "startup", 1, 0.5, None),
    ("s", "start-up, 10,000 particles", "10000", "startup", 1, 10, None),
    ("1", "share of contact, 100 particles", "100", "contact_share", 1, None, 0.35),
    ("1", "share of contact, relative density 0.95", "100-dense", "contact_share", 1, None, 0.45),
    ("1", "share of the task graph, 100, 1 thread", "100", "graph_share", 1, None, 0.03),
    ("1", "share of the task graph, 100, 2 threads", "100", "graph_share", 2, None, 0.03),
    ("x", "one to two threads, 1,683 particles", "1683", "scaling", 2, None, 1.85),
    ("1", "step's cost, 1,683 over 100, 1 thread", "1683", "cost_over_100", 1, None, 1.25),
    ("1", "step's cost, 10,000 over 100, 1 thread", "10000", "cost_over_100", 1, None, 1.25),
)


# ---- derived from several lines -----------------------------------------------------------------
def derive(measured):
    """Adds lines that are ratios and sums of the medians of others."""
    cases = [case for case, name, threads in measured.lines if name == "step" and threads == 1]
    for case in cases:
        derive_times(measured, case)
        derive_memory(measured, case)
        for threads in (1, 2):
            derive_fractions(measured, case, threads)
            derive_ratios(measured, case, threads)
    derive_thesis(measured)


def derive_thesis(measured):
    """A run with about as many steps is comparable with that of the thesis; a shorter one is not."""
    if "thesis" not in measured.states:
        return
    run, (steps, _) = measured.lines["thesis", "run", 2], measured.states["thesis"]
    if abs(steps / THESIS_STEPS - 1) < 0.05:
        scaled = measured.line("thesis", "94,000_steps", 2, "s")
        for seconds in run.values:
            scaled.add(seconds * THESIS_STEPS / steps)


def value(measured, case, name, threads=1):
    line = measured.lines.get((case, name, threads))
    return line.median if line else None


def derive_times(measured, case):
    def add(name, threads, figure):
        measured.line(case, name, threads, "1").add(figure)

    step = {threads: value(measured, case, "step", threads) for threads in (1, 2)}
    systems = {name: line.median for (of, name, _), line in measured.lines.items()
               if of == case and name.startswith("system/")}
    contact = sum(ns for name, ns in systems.items() if CONTACT.match(name))
    add("contact_share", 1, contact / sum(systems.values()))
    add("scaling", 2, step[1] / step[2])
    for threads in (1, 2):
        add("graph_share", threads, value(measured, case, "graph", threads) / step[threads])
    if case in LARGER and (smallest := value(measured, "100", "step")):
        add("cost_over_100", 1, step[1] / smallest)


def derive_memory(measured, case):
    columns = value(measured, case, "memory/bodies") + value(measured, case, "memory/contact")
    measured.line(case, "memory/columns", 1, "B/element").add(columns)


def derive_fractions(measured, case, threads):
    """Fractions of the measured peaks; arithmetic only if the operations were counted for this case."""
    per_ns = {name: 1 / value(measured, case, name, threads) for name in ("step", "kernels")}
    peak = measured.lines["machine", "fma", threads].best
    for name, prefix in (("step", ""), ("kernels", "kernels/")):
        flops = value(measured, COUNTED, prefix + "flops")
        if flops is not None and case in (COUNTED, *LARGER):
            measured.line(case, name + "/of_peak_flops", threads, "1").add(flops * per_ns[name] / peak)
    moved = value(measured, case, "memory/moved_a_step") * per_ns["step"]
    bandwidth = measured.lines["machine", "triad", threads].best
    measured.line(case, "step/of_bandwidth", threads, "1").add(moved / bandwidth)


def derive_ratios(measured, case, threads):
    """Ratios of the medians to the bare loop of the same rounds."""
    limit = measured.lines.get((case, "limit", threads))
    for name in ("step", "kernels") if limit else ():
        line = measured.lines[case, name, threads]
        measured.line(case, name + "/of_limit", threads, "1").add(limit.median / line.median)


# ---- tables ---------------------------------------------------------------------------------------
def show(measured):
    for key in ("version", "commit", "compiler", "instruction_set"):
        print(f"{key:<16}{measured.context[key]}")
    for case, (steps, state) in measured.states.items():
        print(f"state {case:<16}{state} after {steps} steps")
    show_lines(measured)
    show_aims(measured)


def show_lines(measured):
    print(f"\n{'case':<16}{'line':<28}{'threads':>7}{'best':>11}{'median':>11} {'unit':<18}"
          f"{'M updates/s':>11}{'share':>8}")
    for (case, name, threads), line in measured.lines.items():
        updates = f"{1e3 / line.median:11.1f}" if name in UPDATES else f"{'':11}"
        share = f"{sorted(line.shares)[len(line.shares) // 2]:8.1%}" if line.shares else ""
        print(f"{case:<16}{name:<28}{threads:>7}{line.best:11.4g}{line.median:11.4g} "
              f"{line.unit:<18}{updates}{share}")


def judged(unit, figure, bound):
    if bound is None:
        return ""
    met = figure >= bound if unit in ("M/s", "x") else figure <= bound
    return f"{bound:g} {'met' if met else 'missed'}"


def show_aims(measured):
    print(f"\n{'':<50}{'median':>10}      {'must':<14}{'aim':<14}")
    for unit, what, case, name, threads, must, aim in AIMS:
        figure = value(measured, case, name, threads)
        if figure is None:
            continue
        figure = 1e3 / figure if unit == "M/s" else figure
        print(f"{what:<50}{figure:10.4g} {unit:<4} {judged(unit, figure, must):<14}"
              f"{judged(unit, figure, aim):<14}")
