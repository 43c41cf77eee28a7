#!/usr/bin/python3
"""Reads a database with h5py: which missing block changes the measured displacements most?

    build-database -o bridge.h5
    examples/h5py/read_database.py bridge.h5

Prints what the file is, checks every record's checksum and the content digest by itself, and lists the single missing
blocks of standing scenes by the largest change at a control point. database/README.md documents the file.
"""

import hashlib
import struct
import sys

import h5py
import numpy

STANDING, UNRESOLVED = 0, 2  # scenes/outcome
LOCAL, ARCH = 1, 2  # scenes/collapse

# What a record's checksum covers, in its order: columns of the record and then, for each state, columns of the state.
RECORD_COLUMNS = ["scenes/variant", "scenes/removed"]
STATE_COLUMNS = [
    "scenes/outcome", "scenes/residual", "scenes/iterations", "scenes/collapse", "scenes/moving",
    "control/vertical_displacement", "fields/displacement", "fields/slipped", "scenes/origin",
]
OPTIONAL = ["fields/slipped", "scenes/origin"]  # left out where it is 0, and the dataset where all are
PADDED = ["scenes/removed"]  # a list, then -1
MARKS = ["scenes/moving"]    # a list: 1 in the place of each of its numbers

# What the content digest covers, in its order (scenes/checksum stands for all that is kept of the records).
DIGEST_ORDER = [
    "bridge/text", "solver/settings",
    "geometry/block_label", "geometry/block_role", "geometry/block_ring", "geometry/block_index",
    "geometry/block_kind", "geometry/block_top_course", "geometry/corners",
    "geometry/block_corners", "geometry/nodes", "geometry/block_nodes", "geometry/triangles",
    "geometry/block_triangles", "geometry/edges", "geometry/block_edges",
    "geometry/joint_blocks", "geometry/joint_nodes", "geometry/joint_ends", "geometry/joint_length",
    "control/point_name", "control/point_position", "control/point_block", "control/point_node",
    "history/states",
    "model_error/share",
    "model_error/common",
    "model_error/intact",
    "sensitivity/parameter_name", "sensitivity/parameter_unit", "sensitivity/parameter_sigma",
    "sensitivity/parameter_of_epoch", "sensitivity/basis", "sensitivity/removed", "sensitivity/known",
    "sensitivity/bridge_factors", "sensitivity/epoch_factors", "sensitivity/residual_signal",
    "sensitivity/standing_share", "sensitivity/if_standing",
    "sensitivity/residual_bridge", "sensitivity/residual_epoch", "sensitivity/residual_share",
    "sensitivity/unevenness",
    "sensitivity/load_place",
    "sensitivity/load_influence",
    "variants/young_modulus", "variants/poisson_ratio", "variants/density",
    "variants/normal_stiffness", "variants/tangential_stiffness", "variants/friction_coefficient",
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
        if path not in file:  # those of joints, if the bridge has none; sensitivities of a known bridge
            continue
        content = raw_bytes(file[path])
        digest.update(path.encode() + b"\0" + struct.pack("<Q", len(content)) + content)
    return digest.hexdigest()


def values(file, path, place):
    """What a record has in a column, as bytes behind their number."""
    if path not in file and path in OPTIONAL:
        return b""
    if path not in file:  # a database without fields
        return struct.pack("<I", 0)
    found = numpy.atleast_1d(file[path][place])
    if path in OPTIONAL and not found.any():
        return b""
    if path in PADDED:
        found = found[found >= 0]
    if path in MARKS:
        found = numpy.flatnonzero(found).astype("<i4")
    return struct.pack("<I", found.size) + found.tobytes()


def record_checksum(file, row):
    states = len(file["history/states"])
    digest = hashlib.sha256(struct.pack("<I", states))
    for path in RECORD_COLUMNS:
        digest.update(values(file, path, row))
    for state in range(states):
        for path in STATE_COLUMNS:
            digest.update(values(file, path, (state, row)))
    return numpy.frombuffer(digest.digest(), dtype=numpy.uint8)


def scene_name(file, row):
    removed = file["scenes/removed"][row]
    blocks = [",".join(map(str, file["geometry/block_index"][block])) for block in removed if block >= 0]
    return "+".join(blocks) if blocks else "intact"


def largest_changes(file, count, variant=0, state=0):
    """(change in m, scene, control point) of a variant's standing singles in a state, largest first."""
    first, last = numpy.searchsorted(file["scenes/variant"][...], [variant, variant + 1])  # its records
    removed = file["scenes/removed"][first:last]
    outcome = file["scenes/outcome"][state, first:last]
    vertical = file["control/vertical_displacement"][state, first:last]
    singles = (numpy.sum(removed >= 0, axis=1) == 1) & (outcome == STANDING)
    found = []
    for row in numpy.flatnonzero(singles):
        change = numpy.nan_to_num(numpy.abs(vertical[row] - vertical[0]))  # the intact bridge comes first
        point = int(numpy.argmax(change))
        name = scene_name(file, first + row)
        found.append((change[point], name, file["control/point_name"][point].decode()))
    return sorted(found, reverse=True)[:count]


def print_state(file, state, name):
    extent = file["scenes/collapse"][state]
    outcome = file["scenes/outcome"][state]
    print(f"{name}: {numpy.sum(outcome == STANDING)} stand, {numpy.sum(outcome == UNRESOLVED)} are unresolved; "
          f"collapses: {numpy.sum(extent == ARCH)} of the arch, {numpy.sum(extent == LOCAL)} of wall blocks only")
    print("  largest change of a vertical displacement when one block is missing:")
    for change, scene, point in largest_changes(file, 5, state=state):
        print(f"  {scene:>6}  {1000 * change:8.4f} mm at {point}")


def main(path):
    with h5py.File(path, "r") as file:
        rows = len(file["scenes/variant"])
        states = ", ".join(name.decode() for name in file["history/states"])
        print(f"{path}: bridge '{file.attrs['bridge_name'].decode()}', {rows} records, "
              f"made by version {file.attrs['program_version'].decode()}")
        print(f"variants: {len(file['variants/density'])}; states: {states}")
        wrong = [row for row in range(rows) if (record_checksum(file, row) != file["scenes/checksum"][row]).any()]
        digest_right = content_digest(file) == file.attrs["content_digest"].decode()
        print(f"checksums: {rows - len(wrong)} of {rows} right; content digest {'right' if digest_right else 'WRONG'}")
        for state, name in enumerate(file["history/states"]):
            print_state(file, state, name.decode())
    return 0 if digest_right and not wrong else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1] if len(sys.argv) > 1 else "bridge.h5"))
