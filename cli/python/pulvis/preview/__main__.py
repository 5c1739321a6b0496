"""usage: python3 -m pulvis.preview SETUP.json -o PICTURE.png|svg|pdf"""
import sys
from pathlib import Path

if not __package__:  # run as a script: its folder must not shadow other modules
    sys.path[0] = str(Path(__file__).resolve().parents[2])

try:
    from pulvis.preview.draw import main
except ImportError as error:
    print(f"preview: {error}; needed: python3-numpy, python3-matplotlib", file=sys.stderr)
    sys.exit(4)

if __name__ == "__main__":
    main()
