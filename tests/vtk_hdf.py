#!/usr/bin/env python3
"""Holds run.vtkhdf and tools.vtkhdf of a run to the format that VTK publishes, and to the frames of run.h5.

    vtk_hdf.py FOLDER... [--vtk]

Every dataset has the type and length that the format asks for, every step lies within them, and what a step refers to has
the bits of the frame. With --vtk the files are then read with the VTK of this Python: 9.3 and later read every frame, 9.1
and 9.2 the newest one, with a warning that they do not know the version.

Format: https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/vtkhdf_specifications.html
"""
import argparse
import pathlib
import sys

import h5py
import numpy as np

LINE, QUAD, HEXAHEDRON = 3, 9, 12
COUNTS = {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"}
STEPS = {"Values": "f", "PartOffsets": "i", "NumberOfParts": "i", "PointOffsets": "i", "CellOffsets": "i",
         "ConnectivityIdOffsets": "i"}


class Grid:
    """What run.h5 says about the powder or the tools."""

    def __init__(self, run, of_tools):
        in_space = "mesh/hexahedra" in run
        self.points = "tools/outline" if of_tools else "position"
        if of_tools:
            self.cells = run["tools/quads" if in_space else "tools/lines"][()]
            self.type = QUAD if in_space else LINE
            self.constants = {"tool": run["tools/quad_tool" if in_space else "tools/line_tool"][()]}
        else:
            self.cells = run["mesh/hexahedra" if in_space else "mesh/quads"][()]
            self.type = HEXAHEDRON if in_space else QUAD
            self.constants = {name.removeprefix("cell_"): data[()] for name, data in run["mesh"].items() if name.startswith("cell_")}
        self.frames = [frame for _, frame in sorted(run["frames"].items()) if frame.attrs.get("complete") == 1]

    def fields(self, frame):
        """{group: {name: values as VTK has them}} of the frame."""
        found = {"PointData": {}, "CellData": dict(self.constants)}
        if self.points == "position":
            for name, data in frame.items():
                place = data.attrs.get("place")
                if isinstance(data, h5py.Dataset) and name != "position" and place in ("node", "cell"):
                    found["PointData" if place == "node" else "CellData"][name] = as_vtk(data[()])
        return found


def as_vtk(values):
    """Vectors and tensors in the plane with zeros for what they lack."""
    if values.ndim == 1:
        return values
    wide = {2: 3, 4: 6}.get(values.shape[1], values.shape[1])
    return np.pad(values, ((0, 0), (0, wide - values.shape[1])))


def same(found, expected, what):
    assert found.shape == expected.shape, f"{what}: {found.shape}, not {expected.shape}"
    assert np.array_equal(found, expected, equal_nan=found.dtype.kind == "f"), f"{what}: other values"


def check_layout(root, grid):
    """Names, types, lengths and offsets. Returns the number of steps."""
    assert root.attrs["Version"].tolist() == [2, 0] and root.attrs["Version"].dtype.kind == "i"
    kind = root.attrs.get_id("Type").get_type()
    assert not kind.is_variable_str() and root.attrs["Type"] in (b"UnstructuredGrid", "UnstructuredGrid")
    for name in COUNTS:
        assert root[name].shape == (1,) and root[name].dtype.kind == "i", name
    points, cells, ids = (int(root[name][0]) for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"))
    assert (cells, ids) == (len(grid.cells), grid.cells.size)
    same(root["Connectivity"][()], grid.cells.ravel().astype("i8"), "Connectivity")
    same(root["Offsets"][()], np.arange(0, ids + 1, grid.cells.shape[1], dtype="i8"), "Offsets")
    same(root["Types"][()], np.full(cells, grid.type, "u1"), "Types")
    steps = root["Steps"]
    count = int(steps.attrs["NSteps"])
    for name, letter in STEPS.items():
        shape = (count, 1) if name in ("CellOffsets", "ConnectivityIdOffsets") else (count,)
        assert steps[name].shape == shape and steps[name].dtype.kind == letter, name
    assert root["Points"].shape == (count * points, 3) and root["Points"].dtype == np.float64
    for group in ("PointData", "CellData"):
        offsets = steps.get(f"{group}Offsets", {})
        assert set(offsets) == set(root.get(group, {})), group
    return count


def step_of(root, step):
    """What a reader that follows the offsets gets: points, {group: {name: values}}."""
    steps = root["Steps"]
    assert steps["PartOffsets"][step] == 0 and steps["NumberOfParts"][step] == 1
    assert steps["CellOffsets"][step, 0] == 0 and steps["ConnectivityIdOffsets"][step, 0] == 0
    rows = {"PointData": int(root["NumberOfPoints"][0]), "CellData": int(root["NumberOfCells"][0])}

    def part(data, first, count):
        assert 0 <= first and first + count <= len(data), f"{data.name}: rows {first} + {count} of {len(data)}"
        return data[first:first + count]

    fields = {group: {name: part(data, int(steps[f"{group}Offsets/{name}"][step]), rows[group])
                      for name, data in root.get(group, {}).items()} for group in rows}
    return part(root["Points"], int(steps["PointOffsets"][step]), rows["PointData"]), fields


def check_file(path, run, of_tools):
    """Raises AssertionError where the file is not what it should be. Returns the number of frames."""
    grid = Grid(run, of_tools)
    with h5py.File(path) as file:
        root = file["VTKHDF"]
        count = check_layout(root, grid)
        assert count == len(grid.frames), f"{path}: {count} steps of {len(grid.frames)} frames"
        for step, frame in enumerate(grid.frames):
            assert root["Steps/Values"][step] == frame.attrs["time"]
            points, fields = step_of(root, step)
            same(points, as_vtk(frame[grid.points][()]), f"{frame.name}: points")
            expected = grid.fields(frame)
            for group, values in expected.items():
                assert set(fields[group]) == set(values), f"{group}: {set(fields[group]) ^ set(values)}"
                for name, of_frame in values.items():
                    same(fields[group][name], of_frame, f"{frame.name}: {name}")
        return count


def check_with_vtk(path, run, of_tools):
    """The same as VTK sees it. Returns its version and the number of frames that it read."""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy

    grid = Grid(run, of_tools)
    version = vtk.vtkVersion()
    is_old = (version.GetVTKMajorVersion(), version.GetVTKMinorVersion()) < (9, 3)
    reader = vtk.vtkHDFReader()
    assert reader.CanReadFile(str(path)), path
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    information, key = reader.GetOutputInformation(0), vtk.vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    times = [information.Get(key, i) for i in range(information.Length(key))] if information.Has(key) else []
    assert times == ([] if is_old else [frame.attrs["time"] for frame in grid.frames]), times
    frames = grid.frames[-1:] if is_old else grid.frames
    for number, frame in enumerate(frames):
        reader.Update() if is_old else reader.UpdateTimeStep(times[number])
        read = reader.GetOutputDataObject(0)
        if read.IsA("vtkPartitionedDataSet"):
            assert read.GetNumberOfPartitions() == 1
            read = read.GetPartition(0)
        same(vtk_to_numpy(read.GetPoints().GetData()), as_vtk(frame[grid.points][()]), f"{frame.name}: points")
        same(vtk_to_numpy(read.GetCells().GetConnectivityArray()), grid.cells.ravel().astype("i8"), "connectivity")
        assert {read.GetCellType(i) for i in range(read.GetNumberOfCells())} == {grid.type}
        for group, data in (("PointData", read.GetPointData()), ("CellData", read.GetCellData())):
            for name, values in grid.fields(frame)[group].items():
                same(vtk_to_numpy(data.GetArray(name)), values, f"{frame.name}: {name}")
    return version.GetVTKVersion(), len(frames)


def check_run(folder, with_vtk=False):
    """Both files of a run. Returns a line for each."""
    lines = []
    with h5py.File(folder / "run.h5") as run:
        for name, of_tools in (("run.vtkhdf", False), ("tools.vtkhdf", True)):
            path = folder / name
            assert path.exists() == (not of_tools or "tools" in run), f"{path}: is there: {path.exists()}"
            if not path.exists():
                continue
            lines.append(f"{path}: {check_file(path, run, of_tools)} frames, as in run.h5")
            if with_vtk:
                lines.append("{}: VTK {} reads {} frames".format(path, *check_with_vtk(path, run, of_tools)))
    return lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folders", nargs="+", type=pathlib.Path)
    parser.add_argument("--vtk", action="store_true", help="read the files with VTK as well")
    asked = parser.parse_args()
    for folder in asked.folders:
        print("\n".join(check_run(folder, asked.vtk)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
