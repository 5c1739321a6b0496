"""Plotting of runs, studies and probes: `pulvis figure` from the command line, `run.plot` from Python.

Each plotting function takes a run and Options, and optionally the axes to draw into. It returns the Figure, whose
`table` holds the plotted data, or None if the run did not record that data.
"""
