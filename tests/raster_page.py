"""Holds the images of a raster's report, as a browser drew them, and its Gwyddion Simple Fields to run.h5.

usage: raster_page.py SOURCE_DIR PAGE RUN_H5 FIELDS
"""
import html
import json
import re
import struct
import sys
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(sys.argv[1]) / "cli/python"))
from pulvis.figures import afm


def check(holds, what):
    if not holds:
        sys.exit(f"FAILED: {what}")


def field_in(file):
    content = file.read_bytes()
    head, _, _ = content.partition(b"\0")
    wide, tall = (int(re.search(rf"^{name} = (\d+)$", head.decode(), re.M)[1]) for name in ("XRes", "YRes"))
    start = 4 * (len(head) // 4 + 1)
    return np.array(struct.unpack(f"<{wide * tall}f", content[start:])).reshape(tall, wide)


def main():
    page = Path(sys.argv[2]).read_text(encoding="utf-8")
    drawn = json.loads(html.unescape(re.search(r'<pre id="ranges">(.*?)</pre>', page)[1]))
    count = 0
    with h5py.File(sys.argv[3]) as run:
        (action,) = run["images"]
        for channel in afm.CHANNELS:
            trace, retrace = (run[f"images/{action}/{channel}_{way}"][:] for way in ("trace", "retrace"))
            maps = [("trace", trace), ("retrace", retrace)]
            if channel == "friction":
                maps.append(("difference", (trace - retrace) / 2))
            size = max(np.abs(values).max() for _, values in maps)
            for level in afm.LEVELS:
                wanted = [end for _, values in maps for end in
                          (afm.levelled(values, level).min(), afm.levelled(values, level).max())]
                np.testing.assert_allclose(drawn[f"{channel} {level}"], wanted, atol=3e-7 * size)  # floats
                count += 1
            for way, values in maps:
                for level, suffix in (("none", ""), ("plane", "-plane")):
                    field = field_in(Path(sys.argv[4]) / f"{action}-{channel}-{way}{suffix}.gsf")
                    wanted = afm.levelled(values, level)[::-1]
                    np.testing.assert_allclose(field, wanted, rtol=1e-6, atol=1e-6 * size)
    check(count == 9 == len(drawn), f"{count} images, {len(drawn)} drawn")


if __name__ == "__main__":
    main()
