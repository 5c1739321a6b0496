#!/usr/bin/python3
"""Pictures of an AFM run: the deformed solid (first, middle and last frame), its curves, its rasters.

usage: figures_afm.py RUN_FOLDER [-o FOLDER]
"""
import argparse
import csv
from pathlib import Path

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
COLOURS = ["#7aa6c2", "#d4b24c", "#8a8a8a", "#c77f6d"]  # lever, coating, tip, glue
CURVES = [("scanner/z", "probe/force_z"), ("scanner/y", "probe/force_y"),
          ("scanner/y", "detector/lateral"), ("time", "probe/force_z")]


def outer_faces(hexahedra):
    """Faces that belong to one hexahedron only, and which one."""
    seen = {}
    for cell, corners in enumerate(hexahedra):
        for face in FACES:
            nodes = tuple(corners[i] for i in face)
            seen.setdefault(tuple(sorted(nodes)), []).append((nodes, cell))
    return [faces[0] for faces in seen.values() if len(faces) == 1]


def draw_solid(axis, position, faces, parts, title):
    polygons = [position[list(nodes)] * 1e6 for nodes, _ in faces]
    colours = [COLOURS[parts[cell]] for _, cell in faces]
    axis.add_collection3d(Poly3DCollection(polygons, facecolors=colours, edgecolors="#00000030",
                                           linewidths=0.3))
    low, high = position.min(axis=0) * 1e6, position.max(axis=0) * 1e6
    axis.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]), title=title,
             xlabel="x in µm", ylabel="y in µm", zlabel="z in µm")
    axis.set_box_aspect(np.maximum(high - low, 0.15 * (high - low).max()))
    axis.view_init(18, -60)


def draw_frames(run, path):
    frames = sorted(run["frames"])
    chosen = frames if len(frames) <= 4 else [frames[0], frames[len(frames) // 2], frames[-1]]
    faces = outer_faces(run["mesh/hexahedra"][:].tolist())
    parts = run["mesh/cell_particle"][:]
    figure = plt.figure(figsize=(7 * len(chosen), 6))
    for i, name in enumerate(chosen):
        frame = run["frames"][name]
        axis = figure.add_subplot(1, len(chosen), i + 1, projection="3d")
        draw_solid(axis, frame["position"][:], faces, parts,
                   f"frame {int(name)}, time {frame.attrs['time']:.3g}")
    figure.savefig(path, dpi=90, bbox_inches="tight")
    plt.close(figure)


def draw_curves(folder, path):
    with open(folder / "history.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    units = dict(name.rsplit(" ", 1) for name in rows[0])
    values = {name.rsplit(" ", 1)[0]: np.array([float(r[i]) for r in rows[1:]])
              for i, name in enumerate(rows[0])}
    if "scanner/z" not in values:
        return False
    figure, axes = plt.subplots(1, len(CURVES), figsize=(6 * len(CURVES), 4.5))
    for axis, (x, y) in zip(axes, CURVES):
        axis.plot(values[x], values[y], ".-", markersize=3, linewidth=0.8)
        axis.set(xlabel=f"{x} {units[x]}", ylabel=f"{y} {units[y]}")
        axis.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=90)
    plt.close(figure)
    return True


def draw_images(run, path):
    """Rasters, way forth above way back; friction also as half of their difference."""
    actions = sorted(run["images"]) if "images" in run else []
    if not actions:
        return False
    channels = ["topography", "deflection", "friction"]
    figure, axes = plt.subplots(2 * len(actions), 3, figsize=(15, 9 * len(actions)), squeeze=False)
    for i, action in enumerate(actions):
        for j, way in enumerate(["forth", "back"]):
            for axis, channel in zip(axes[2 * i + j], channels):
                data = run[f"images/{action}/{channel}_{way}"]
                picture = axis.imshow(data[:], origin="lower", cmap="afmhot")
                axis.set(title=f"{action}: {channel}, {way}", xlabel="pixel", ylabel="line")
                figure.colorbar(picture, ax=axis, label=f"{channel} in {data.attrs['unit']}", shrink=0.8)
    figure.tight_layout()
    figure.savefig(path, dpi=80)
    plt.close(figure)
    return True


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("-o", "--output", type=Path)
    options = parser.parse_args()
    output = options.output or options.folder / "pictures"
    output.mkdir(parents=True, exist_ok=True)
    with h5py.File(options.folder / "run.h5", "r") as run:
        draw_frames(run, output / "solid.png")
        if draw_images(run, output / "images.png"):
            print(output / "images.png")
    print(output / "solid.png")
    if draw_curves(options.folder, output / "curves.png"):
        print(output / "curves.png")


if __name__ == "__main__":
    main()
