"""Numbers with engineering units, and descriptions of stages and actions in words."""
import math

PREFIXES = [(1e12, "T"), (1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"), (1e-12, "p")]


def prefix_for(value, unit):
    """The factor from SI, and the prefixed unit."""
    size = abs(value)
    if unit == "" or not 0 < size < math.inf:
        return 1, unit
    for factor, prefix in PREFIXES:
        if unit[0] == "m" and factor > 1:  # no kilometres
            continue
        if size >= 0.99995 * factor:
            return 1 / factor, prefix + unit
    return 1e12, "p" + unit


SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def number(value):
    """A number with four significant digits."""
    if value == 0 or not math.isfinite(value):
        return f"{value:g}"
    power = math.floor(math.log10(abs(value)))
    if -4 <= power < 7:
        digits = max(0, 3 - power)
        text = f"{round(value, 3 - power):,.{digits}f}"
        text = text.rstrip("0").rstrip(".") if "." in text else text
    else:
        text = f"{value / 10**power:.4g} · 10{str(power).translate(SUPERSCRIPT)}"
    return text.replace("-", "−")


def quantity(value, unit):
    factor, named = prefix_for(value, unit)
    return f"{number(factor * value)} {named}".strip()


def span(low, high, unit):
    """One value, or a range, in a single unit."""
    if abs(high - low) <= 1e-6 * max(abs(low), abs(high)):
        return quantity(high, unit)
    factor, named = prefix_for(high, unit)
    return f"{number(factor * low)} to {number(factor * high)} {named}"


def degrees(angle):
    return f"{number(math.degrees(angle))}°"


def counted(count, what):
    return f"{count:,} {what}" + ("" if count == 1 else "s")


def way(vector):
    """An arrow for a direction in 2D; in 3D its largest component, or all components."""
    size = math.hypot(*vector)
    if size == 0:
        return "·"
    if len(vector) == 3:
        axis = max(range(3), key=lambda k: abs(vector[k]))
        if abs(vector[axis]) > (1 - 1e-9) * size:
            return f"along {'−' if vector[axis] < 0 else ''}{'xyz'[axis]}"
        return f"along ({', '.join(number(part / size) for part in vector)})"
    return "→↗↑↖←↙↓↘"[round(4 * math.atan2(vector[1], vector[0]) / math.pi) % 8]


def move_text(move):
    if "radial" in move:
        return (f"{move['tool']} by {quantity(abs(move['radial']), 'm')} {'outwards' if move['radial'] > 0 else 'inwards'}"
                f" at up to {quantity(move['speed'], 'm/s')}")
    text = (f"{move['tool']} {way(move['displacement'])} {quantity(math.hypot(*move['displacement']), 'm')}"
            f" at up to {quantity(move['speed'], 'm/s')}")
    return text + (f" through a spring of {quantity(move['stiffness'], 'N/m')}" if "stiffness" in move else "")


def servo_text(servo):
    return f"{servo['tool']} {way(servo['direction'])} holds {quantity(servo['force'], 'N')}"


def until_text(until):
    if "relative_density" in until:
        return f"ends at relative density {number(until['relative_density'])}"
    if "force" in until:
        return f"slows down from {quantity(until['force'], 'N')} of {until['tool']}"
    return f"ends at a travel of {quantity(until['displacement'], 'm')} of {until['tool']}"


PARTS = ("xx", "yy", "zz", "xy", "yz", "zx")
STRAINS = {f"strain_{part}": f"ε_{part}" for part in PARTS}
STRESSES = {**{f"stress_{part}": f"σ_{part}" for part in PARTS}, "mean_stress": "mean stress"}


def rotation_text(rotation):
    if not isinstance(rotation, list):
        return degrees(rotation)
    return ", ".join(f"{degrees(angle)} about {axis}" for angle, axis in zip(rotation, "xyz") if angle)


def cell_text(drive, axes):
    """axes: of the scene, 2 or 3."""
    parts = [f"{symbol} = {number(drive[name])}" for name, symbol in STRAINS.items() if name in drive]
    parts += [f"{symbol} = {quantity(drive[name], 'Pa')}" for name, symbol in STRESSES.items() if name in drive]
    if "stress_ratio" in drive:
        lateral, axial = ("σ_xx", "σ_yy") if axes == 2 else ("σ_xx, σ_yy", "σ_zz")
        parts.append(f"{lateral} over {axial} = {number(drive['stress_ratio'])}")
    if "rotation" in drive:
        parts.append(f"rotation {rotation_text(drive['rotation'])}")
    return "borders: " + (", ".join(parts) if parts else "kept")


def stage_text(stage, axes=2):
    parts = [move_text(move) for move in stage["moves"]] + [servo_text(servo) for servo in stage["servos"]]
    if "cell" in stage:
        parts.append(cell_text(stage["cell"], axes))
    if "until" in stage:
        parts.append(until_text(stage["until"]))
    if stage.get("keep_state"):
        parts.append("saves its final state")
    return "; ".join(parts) or "no tool moves"


SIDEWAYS = {"lateral": "across the lever (y)", "along": "along the lever (x)"}


def action_text(action):
    kind = action["kind"]
    if kind == "press" and "force" in action:
        text = f"surface up to a force of {quantity(action['force'], 'N')}"
    elif kind in ("press", "retract"):
        up = (action["distance"] > 0) == (kind == "press")
        text = f"surface {'up' if up else 'down'} by {quantity(abs(action['distance']), 'm')}"
    elif kind == "hold":
        text = "no motion"
    else:
        text = f"tip by {quantity(action['distance'], 'm')} {SIDEWAYS[action['direction']]}"
        if kind == "raster":
            text += f", {action['lines']} lines over {quantity(action['width'], 'm')}"
        elif action["retrace"]:
            text += " and back"
    if action["servo"]:
        text += ", at constant force"
    return text
