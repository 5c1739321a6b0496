"""`pulvis figure` runs it: python3 -m pulvis.figures FOLDER [OPTION]..."""
import sys
from pathlib import Path

if not __package__:  # run as a script: its folder must not shadow other modules
    sys.path[0] = str(Path(__file__).resolve().parents[2])

try:
    import matplotlib

    matplotlib.use("Agg")
    from pulvis.figures.command import main
except ImportError as error:
    print(f"figures: {error}; needed: python3-h5py, python3-numpy, python3-matplotlib", file=sys.stderr)
    sys.exit(4)

if __name__ == "__main__":
    sys.exit(main())
