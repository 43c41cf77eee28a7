"""Reads an XDMF index as its specification says and compares what it refers to with the database.

Usage: build_xdmf.py INDEX SCENE...    Oracle: h5py, and the scenes that the index should hold, in their order.
"""

import os
import sys
import xml.etree.ElementTree as xml

import h5py
import numpy.testing


def load(item, folder):
    name, path = item.text.strip().split(":")
    values = h5py.File(os.path.join(folder, name), "r")[path][...]
    assert list(values.shape) == [int(extent) for extent in item.get("Dimensions").split()]
    return values


def main(index, names):
    folder = os.path.dirname(index)
    grids = xml.parse(index).getroot().findall("./Domain/Grid/Grid")
    assert [grid.get("Name") for grid in grids] == names, [grid.get("Name") for grid in grids]
    with h5py.File(index.replace(".xdmf", ".h5"), "r") as file:
        for grid in grids:
            row = int(grid.find("Time").get("Value"))
            assert (load(grid.find("Topology/DataItem"), folder) == file["geometry/triangles"][...]).all()
            assert (load(grid.find("Geometry/DataItem"), folder) == file["geometry/nodes"][...]).all()
            found = load(grid.find("Attribute/DataItem"), folder)
            numpy.testing.assert_array_equal(found[:, :2], file["fields/displacement"][0, row])
            assert (found[:, 2] == 0).all()
    print(len(grids), "grids right")


main(sys.argv[1], sys.argv[2:])
