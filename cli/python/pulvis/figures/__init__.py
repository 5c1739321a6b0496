"""What draws runs, studies and probes: `pulvis figure` from the command line, `run.plot` from Python.

Each function that draws takes a run and Options, and axes where it can draw into those of somebody else. It returns
the Figure, whose `table` holds the numbers, or None where the run has not recorded what it would show.
"""
