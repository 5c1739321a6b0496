"""Labels of keys of summary.json and study.csv that are no series or fields: those have theirs in run.h5. And what symbols need.

From the first brace on this is also JSON: report pages use the same table (cli/report/page/names.js).
"""
NAMES = {
 "keys": {
  "top_force": "top force $F$",
  "bottom_force": "bottom force $F$",
  "top_pressure": "top pressure $p$",
  "bottom_pressure": "bottom pressure $p$",
  "top_force_end": "final top force $F$",
  "bottom_force_end": "final bottom force $F$",
  "top_force_max": "largest top force $F$",
  "bottom_force_max": "largest bottom force $F$",
  "top_pressure_max": "largest top pressure $p$",
  "bottom_pressure_max": "largest bottom pressure $p$",
  "static_friction": "static friction $\\mu_s$",
  "dynamic_friction": "dynamic friction $\\mu_d$",
  "dilation": "dilation $\\Delta h$",
  "particles": "particles",
  "elements": "elements",
  "steps": "steps",
  "increments": "increments",
  "wall_seconds": "computing time",
  "energy_balance_error": "energy balance error",
  "kinetic_ratio": "kinetic over internal energy",
  "expectations_met": "expectations met",
  "scene_hash": "hash of the scene",
  "state_hash": "hash of the final state",
  "instruction_set": "instruction set"
 },
 "components": {
  "4": ["xx", "yy", "zz", "xy"],
  "2": ["x", "y"],
  "3": ["x", "y", "z"],
  "6": ["xx", "yy", "zz", "xy", "yz", "zx"]
 },
 "letters": {
  "\\rho": "ρ",
  "\\sigma": "σ",
  "\\varepsilon": "ε",
  "\\mu": "μ",
  "\\tau": "τ",
  "\\Delta": "Δ",
  "\\theta": "θ",
  "\\varphi": "φ",
  "\\omega": "ω",
  "\\ell": "ℓ",
  "\\min": "min",
  "\\max": "max",
  "\\mathrm": "",
  "\\bar": ""
 }
}
