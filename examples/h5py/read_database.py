#!/usr/bin/python3
"""Reads a database with h5py: which missing block changes the measured displacements most?

    build-database -o bridge.h5
    examples/h5py/read_database.py bridge.h5

Prints what the file is, checks every scene's checksum and the content digest by itself, and lists the single missing
blocks of standing scenes by the largest change at a control point. database/README.md documents the file.
"""

import hashlib
import struct
import sys

import h5py
import numpy

STANDING = 0     # scenes/outcome
LOCAL, ARCH = 1, 2  # scenes/collapse

# What the content digest covers, in its order (scenes/checksum stands for all that is kept of the scenes).
DIGEST_ORDER = [
    "bridge/text", "solver/settings",
    "geometry/block_index", "geometry/block_kind", "geometry/block_top_course", "geometry/corners",
    "geometry/block_corners", "geometry/nodes", "geometry/block_nodes", "geometry/triangles",
    "geometry/block_triangles", "geometry/edges", "geometry/block_edges",
    "control/point_name", "control/point_position", "control/point_block", "control/point_node",
    "scenes/checksum",
]


def raw_bytes(dataset):
    """The dataset's bytes as they stand in the file."""
    if dataset.shape == () and dataset.dtype.kind == "S":
        return dataset[()].ljust(dataset.dtype.itemsize, b"\0")
    return dataset[...].tobytes()


def content_digest(file):
    digest = hashlib.sha256(f"{file.attrs['format'].decode()} {file.attrs['schema_version']}\n".encode())
    for path in DIGEST_ORDER:
        content = raw_bytes(file[path])
        digest.update(path.encode() + b"\0" + struct.pack("<Q", len(content)) + content)
    return digest.hexdigest()


def scene_checksum(file, row):
    removed = file["scenes/removed"][row]
    removed = removed[removed >= 0]
    digest = hashlib.sha256()
    digest.update(struct.pack("<ii", file["scenes/variant"][row], len(removed)) + removed.astype("<i4").tobytes())
    digest.update(struct.pack("<Bdi", file["scenes/outcome"][row], file["scenes/residual"][row],
                              file["scenes/iterations"][row]))
    moving = numpy.flatnonzero(file["scenes/moving"][row])
    digest.update(struct.pack("<Bi", file["scenes/collapse"][row], len(moving)) + moving.astype("<i4").tobytes())
    digest.update(file["control/vertical_displacement"][row].tobytes())
    if "fields" in file:
        digest.update(file["fields/displacement"][row].tobytes())
    return numpy.frombuffer(digest.digest(), dtype=numpy.uint8)


def scene_name(file, row):
    removed = file["scenes/removed"][row]
    blocks = [",".join(map(str, file["geometry/block_index"][block])) for block in removed if block >= 0]
    return "+".join(blocks) if blocks else "intact"


def largest_changes(file, count):
    """(change in m, scene, control point) of the standing singles, largest first."""
    removed = file["scenes/removed"][...]
    singles = (numpy.sum(removed >= 0, axis=1) == 1) & (file["scenes/outcome"][...] == STANDING)
    vertical = file["control/vertical_displacement"][...]
    intact = vertical[0]
    found = []
    for row in numpy.flatnonzero(singles):
        change = numpy.nan_to_num(numpy.abs(vertical[row] - intact))
        point = int(numpy.argmax(change))
        found.append((change[point], scene_name(file, row), file["control/point_name"][point].decode()))
    return sorted(found, reverse=True)[:count]


def main(path):
    with h5py.File(path, "r") as file:
        rows = len(file["scenes/outcome"])
        print(f"{path}: bridge '{file.attrs['bridge_name'].decode()}', {rows} scenes, "
              f"made by version {file.attrs['program_version'].decode()}")
        wrong = [row for row in range(rows) if (scene_checksum(file, row) != file["scenes/checksum"][row]).any()]
        digest_right = content_digest(file) == file.attrs["content_digest"].decode()
        print(f"checksums: {rows - len(wrong)} of {rows} right; content digest {'right' if digest_right else 'WRONG'}")
        extent = file["scenes/collapse"][...]
        print(f"collapses: {numpy.sum(extent == ARCH)} of the arch, {numpy.sum(extent == LOCAL)} of wall blocks only")
        print("largest change of a vertical displacement when one block is missing:")
        for change, scene, point in largest_changes(file, 5):
            print(f"  {scene:>6}  {1000 * change:8.4f} mm at {point}")
    return 0 if digest_right and not wrong else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else "bridge.h5"))
