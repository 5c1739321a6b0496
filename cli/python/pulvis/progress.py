"""A tqdm progress bar for runs, in a terminal or a notebook."""

import sys
from contextlib import contextmanager


def in_notebook():
    """Whether this is running in a Jupyter kernel."""
    if "IPython" not in sys.modules:  # a kernel has it; importing it is as slow as a short run
        return False
    from IPython import get_ipython

    shell = get_ipython()
    return shell is not None and "IPKernelApp" in shell.config


@contextmanager
def progress_bar(simulation, shown):
    """Follows the simulated time of `simulation`; `shown`: True, False, or None for notebooks only."""
    if shown is None:
        shown = in_notebook()
    if not shown or simulation.finished:
        yield
        return
    from tqdm.auto import tqdm

    layout = "{l_bar}{bar}| {elapsed} < {remaining}{postfix}"
    with tqdm(total=simulation.end, desc=simulation.scene.title, bar_format=layout) as bar:

        def show():
            bar.total = simulation.end  # a stage may end early
            bar.n = simulation.time
            bar.set_postfix_str(f", step {simulation.steps}")

        simulation._run.on_tick(show)
        try:
            yield
        finally:
            if not simulation.finished:
                simulation._run.on_tick(None)
            show()
