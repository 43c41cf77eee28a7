"""Prints what VTK finds in a VTU file: numbers of triangles and points, and then x, y, ux, uy, uz of every point.

Usage: vtu_contents.py FILE
"""

import sys

import vtk

problems = []
reader = vtk.vtkXMLUnstructuredGridReader()
reader.AddObserver("ErrorEvent", lambda *_: problems.append("error"))
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
displacement = grid.GetPointData().GetArray("displacement_m")
assert not problems and displacement is not None
assert all(grid.GetCellType(i) == vtk.VTK_TRIANGLE for i in range(grid.GetNumberOfCells()))
assert all(
    0 <= grid.GetCell(i).GetPointId(k) < grid.GetNumberOfPoints() for i in range(grid.GetNumberOfCells()) for k in range(3)
)
print(grid.GetNumberOfCells(), grid.GetNumberOfPoints())
for i in range(grid.GetNumberOfPoints()):
    print(",".join(repr(number) for number in (*grid.GetPoint(i)[:2], *displacement.GetTuple3(i))))
