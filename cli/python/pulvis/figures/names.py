"""The table of names: what stands in figures, tables and menus instead of a key.

Each key has words and a symbol, the symbol as matplotlib's mathtext; `plain` gives it in plain text.
"""
import re
from collections import namedtuple

Name = namedtuple("Name", "words symbol")

# Keys as they stand in run.h5, summary.json and study.csv.
EXACT = {
    "time": ("time", "t"), "dt": ("time step", r"\Delta t"),
    "relative_density": ("relative density", r"\rho"), "min_jacobian": ("smallest Jacobian", r"\min J"),
    "contacts": ("edges in contact", ""), "penetration": ("penetration, of the edge length", ""),
    "contact_overlap": ("overlap, of the particles' area", ""), "narrow_contacts": ("force on narrow contacts", ""),
    "stress_ratio/axial": ("axial stress over yield stress", r"\sigma_\mathrm{ax}/\sigma_y"),
    "stress_ratio/lateral": ("lateral stress over yield stress", r"\sigma_\mathrm{lat}/\sigma_y"),
    "stress/axial_top": ("axial stress on the top", r"\sigma_\mathrm{ax}"),
    "stress/axial_bottom": ("axial stress on the bottom", r"\sigma_\mathrm{ax}"),
    "stress/radial_left": ("lateral stress on the left", r"\sigma_\mathrm{lat}"),
    "stress/radial_right": ("lateral stress on the right", r"\sigma_\mathrm{lat}"),
    "stress/transmission": ("transmission of the axial force", ""), "transmission": ("transmission of the axial force", ""),
    "stress/mean": ("mean stress", r"\sigma_m"), "stress/deviatoric": ("deviatoric stress", "q"),
    # Fields of frames.
    "effective_stress": ("effective stress", r"\sigma_\mathrm{eff}"), "pressure": ("pressure", "p"),
    "plastic_strain": ("plastic strain", r"\bar\varepsilon_p"), "stress": ("stress", r"\sigma"),
    "velocity": ("velocity", "v"), "position": ("position", "x"), "damage": ("damage", "D"),
    "particle_stress": ("stress of the particle", r"\sigma"), "particle_centre": ("centre of the particle", "x"),
    "coordination": ("coordination number", "Z"), "tools_touched": ("tools touched", ""),
    "force_chain": ("force chain", ""), "fragment": ("fragment", ""), "parent": ("parent particle", ""),
    "target_slip": ("slip of the target", "s"), "number": ("particle", ""), "material": ("material", ""),
    "class": ("class", ""), "local_density": ("local relative density", r"\rho"),
    # Cells and means over them.
    "cell/width": ("width of the cell", "w"), "cell/height": ("height of the cell", "h"),
    "cell/rotation": ("rotation of the cell", r"\omega"), "cell/stored_energy": ("stored energy", "u"),
    "cell/dissipated_energy": ("dissipated energy", "d"),
    "network/coordination": ("coordination number", "Z"), "network/tools": ("tools a particle touches", ""),
    "network/rattlers": ("share of rattlers", ""), "network/anisotropy": ("anisotropy of the fabric", "a"),
    "network/fabric_angle": ("direction of the fabric", r"\theta"),
    "network/mean_force": ("mean normal force", "F_n"), "network/largest_force": ("largest normal force", "F_n"),
    "network/chain_share": ("share of particles in force chains", ""),
    "density/compact": ("relative density of the compact", r"\rho"),
    "density/minimum": ("lowest local density", r"\rho_\min"),
    "density/maximum": ("highest local density", r"\rho_\max"),
    "density/deviation": ("deviation of local densities", r"s_\rho"),
    "bonds/area": ("bonded area", "A"), "bonds/crack_length": ("crack length", r"\ell"),
    "bonds/damage": ("damage of the bonds", "D"), "bonds/fragments": ("fragments", ""),
    "bonds/largest_fragment": ("largest fragment, of the area", ""),
    "shear/distance": ("sliding distance", "s"), "shear/friction": ("friction coefficient", r"\mu"),
    "shear/work": ("work of the target", "W"), "shear/locked": ("particles that go along", ""),
    "shear/plastic_work": ("plastic work while sheared", "W_p"), "shear/ploughing": ("share of ploughing", ""),
    "shear/normal_stress": ("normal stress on the target", r"\sigma_n"),
    "shear/lateral_stress": ("shear stress on the target", r"\tau"),
    "shear/punch_lateral_stress": ("shear stress on the punch", r"\tau"),
    "shear/dilation": ("dilation", r"\Delta h"), "shear/wall_share": ("lateral force that the walls bear", ""),
    # The lever.
    "contact/points": ("points in contact", ""), "contact/pressure": ("contact pressure", "p"),
    "contact/radius": ("contact radius", "a"), "contact/slides": ("points that slide", ""),
    "detector/lateral": ("lateral signal", "U_l"), "detector/normal": ("normal signal", "U_n"),
    "slope/lateral": ("lateral slope", r"\varphi"), "slope/normal": ("normal slope", r"\theta"),
    "foot/displacement_y": ("lateral displacement of the foot", "u_y"), "foot/twist": ("twist of the foot", r"\varphi"),
    "newton/iterations": ("Newton iterations", ""), "energy/released": ("released energy", "E"),
    "k_n": ("normal stiffness", "k_n"), "k_l": ("lateral stiffness", "k_l"),
    "k_x": ("longitudinal stiffness", "k_x"), "k_l/k_n": ("lateral over normal stiffness", "k_l/k_n"),
    "arm": ("arm of the tip", "h"), "torsional_stiffness": ("torsional stiffness", r"k_\varphi"),
    "share_twist": ("share of twist", ""), "share_bending": ("share of lateral bending", ""),
    "share_tip": ("share of the tip", ""), "invols_normal": ("normal InvOLS", ""),
    "invols_lateral": ("lateral InvOLS", ""), "loop/load": ("load of the loop", "N"),
    "loop/half_width": ("half-width of the loop", "W"), "loop/offset": ("offset of the loop", r"\Delta"),
    "loop/friction": ("friction coefficient of the loop", r"\mu"), "loop/sensitivity": ("sensitivity", ""),
    "curve/pull_off": ("pull-off force", "F_\\mathrm{po}"), "curve/work": ("pull-off work", "W"),
    "curve/work_of_adhesion": ("work of adhesion", "w"),
    # Values of a run as a whole.
    "wall_seconds": ("computing time", ""), "steps": ("steps", ""), "top_force_end": ("final force on the top", "F"),
    "bottom_force_end": ("final force on the bottom", "F"), "top_force_max": ("largest force on the top", "F"),
    "static_friction": ("static friction", r"\mu_s"), "dynamic_friction": ("dynamic friction", r"\mu_d"),
    "energy_balance_error": ("error of the energy balance", ""), "kinetic_ratio": ("kinetic over internal energy", ""),
    "strength": ("strength", r"\sigma_f"),
}

ENERGIES = {"elastic": "elastic", "plastic": "plastic", "kinetic": "kinetic", "hourglass": "hourglass", "contact": "contact",
            "friction": "friction", "damping": "contact damping", "bulk_damping": "material damping", "bonds": "bonds",
            "fracture": "fracture", "external": "work of the tools", "balance": "error of the balance"}

# Where an axis or a component stands in the key.
PATTERNS = [(re.compile(pattern), words, symbol) for pattern, words, symbol in [
    (r"tool/(?P<who>.+)/force_(?P<k>[xyz])", "force on {who}", "F_{k}"),
    (r"tool/(?P<who>.+)/position_(?P<k>[xyz])", "position of {who}", "{k}"),
    (r"tool/(?P<who>.+)/force_asked", "force asked of {who}", "F"),
    (r"tool/(?P<who>.+)/drive_force", "force of the drive of {who}", "F"),
    (r"probe/force_(?P<k>[xyz])", "force on the tip", "F_{k}"),
    (r"clamp/force_(?P<k>[xyz])", "force on the clamp", "F_{k}"),
    (r"probe/displacement_(?P<k>[xyz])", "displacement of the tip", "u_{k}"),
    (r"travel_(?P<who>.+)", "travel of {who}", "s"),
    (r"scanner/(?P<k>[xyz])", "scanner", "{k}"),
    (r"momentum/(?P<k>[xy])", "momentum", "p_{k}"),
    (r"momentum/angular", "angular momentum", "L"),
    (r"cell/strain_(?P<k>\w+)", "strain of the cell", r"\varepsilon_{{{k}}}"),
    (r"(cell/stress_|stress/)(?P<k>xx|yy|zz|xy)", "mean stress", r"\sigma_{{{k}}}"),
    (r"network/fabric_(?P<k>\w\w)", "fabric", "F_{{{k}}}"),
]]
COMPONENTS = {4: ("xx", "yy", "zz", "xy"), 2: ("x", "y"), 3: ("x", "y", "z")}
GREEK = {r"\rho": "ρ", r"\sigma": "σ", r"\varepsilon": "ε", r"\mu": "μ", r"\tau": "τ", r"\Delta": "Δ", r"\theta": "θ",
         r"\varphi": "φ", r"\omega": "ω", r"\ell": "ℓ", r"\min": "min", r"\max": "max", r"\mathrm": "", r"\bar": ""}


def worded(key):
    return key.replace("_", " ").replace("/", ", ")


def name_of(key, components=1):
    """Name of a series, a field (NAME:k for component k of `components`) or a value of a study."""
    if key in EXACT:
        return Name(*EXACT[key])
    base, _, component = key.partition(":")
    if component.isdigit() and base in EXACT and 1 <= int(component) <= components:
        words, symbol = EXACT[base]
        part = COMPONENTS.get(components, [str(i + 1) for i in range(components)])[int(component) - 1]
        return Name(words, part if symbol == "x" else f"{symbol}_{{{part}}}")
    if key.startswith("peak/"):
        words, symbol = name_of(key[len("peak/"):])
        return Name(f"{words} at peak density", symbol)
    if key.startswith("energy/"):
        kind = key[len("energy/"):]
        return Name(ENERGIES.get(kind, worded(kind)) + ("" if kind in ("external", "balance") else " energy"), "E")
    for pattern, words, symbol in PATTERNS:
        if match := pattern.fullmatch(key):
            return Name(words.format(**match.groupdict()), symbol.format(**match.groupdict()))
    return Name(worded(key), "")


def plain(symbol):
    """A symbol, or words with some, without mathtext."""
    for tex, letter in GREEK.items():
        symbol = symbol.replace(tex, letter)
    return symbol.replace("{", "").replace("}", "").replace("$", "").replace("_", "")


def capital(text):
    return text[:1].upper() + text[1:]


def shown_unit(unit):
    """As it stands in print: "J/m^3" is J/m³."""
    unit = re.sub(r"\^(-?\d)", lambda power: power[1].translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")), unit)
    return unit.replace(" ", "\u2009")


def label(key, unit, components=1, words=None):
    """ "Effective stress σ_eff / MPa", for an axis or a colour bar; `words` instead of those of the table."""
    name = name_of(key, components)
    text = capital(words or name.words)
    if name.symbol:
        text += f" ${name.symbol}$"
    return over(text, unit)


def over(text, unit):
    """What is a quantity, over its unit: numbers stand on the axis."""
    if unit in ("", "-", None):
        return text
    unit = shown_unit(unit)
    return f"{text} / ({unit})" if "/" in unit or "\u2009" in unit else f"{text} / {unit}"
