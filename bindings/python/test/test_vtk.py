# SPDX-License-Identifier: BSD-3-Clause
"""Grids of VTK, in and out, and the hand-over to PyVista. Skipped without VTK (Debian: python3-vtk9)."""
import importlib.util
import sys
import types
import unittest
from unittest import mock

import support
import numpy as np

import delam

HAVE = importlib.util.find_spec("vtkmodules") is not None
if HAVE:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import reference
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter


def block(kind):
    """Two layers, 1 x 1 (x 1) in all, with a joint."""
    plane = kind in ("tri3", "quad4", "tri6", "quad8", "quad9")
    mesh = delam.Mesh.layers(*((1.0, 2) if plane else ((1.0, 1.0), (2, 1))), [0.5, 0.5], [1, 1], kind)
    mesh.add_interface(0, 1)
    return mesh


class Without(unittest.TestCase):
    def test_it_is_named(self):
        with mock.patch.dict(sys.modules, {"vtkmodules": None}), self.assertRaisesRegex(ImportError, "python3-vtk9"):
            block("quad4").to_vtk()
        with mock.patch.dict(sys.modules, {"pyvista": None}), self.assertRaisesRegex(ImportError, "needs PyVista"):
            block("quad4").to_pyvista()


@unittest.skipUnless(HAVE, "VTK is not installed")
class Grids(unittest.TestCase):
    def test_every_cell_type_there_and_back(self):
        for kind in delam.CELLS:
            with self.subTest(kind):
                mesh = block(kind)
                grid = mesh.to_vtk({"place": mesh.nodes[:, 0]}, {"number": np.arange(mesh.cell_count)})
                self.assertEqual(grid.GetNumberOfPoints(), mesh.node_count)
                self.assertEqual(grid.GetNumberOfCells(), mesh.cell_count)
                np.testing.assert_array_equal(vtk_to_numpy(grid.GetPointData().GetArray("place")), mesh.nodes[:, 0])
                back = delam.Mesh.from_vtk(grid)
                np.testing.assert_array_equal(back.nodes[:mesh.node_count], mesh.nodes)  # new tied nodes follow
                np.testing.assert_array_equal(back.cells.connectivity, mesh.cells.connectivity)
                np.testing.assert_array_equal(back.cells.bodies, mesh.cells.bodies)
                self.assertEqual(back.interface_count, 1)

    def test_vtk_understands_the_cells(self):
        # VTK's own measure of the cells: nodes in another order would give another size, or a negative one.
        for kind in delam.CELLS:
            with self.subTest(kind):
                measure = vtkCellSizeFilter()
                measure.SetInputData(block(kind).to_vtk())
                measure.Update()
                if kind == "hex27":  # whose size VTK 9.1 does not compute; the next test has it
                    continue
                data = measure.GetOutput().GetCellData()
                sizes = vtk_to_numpy(data.GetArray("Volume")) + vtk_to_numpy(data.GetArray("Area"))
                self.assertAlmostEqual(sizes.sum(), 1.0, 9)
                self.assertGreater(sizes.min(), 0)

    def test_vtk_places_the_nodes(self):
        # VTK's interpolation in a box is linear in its coordinates only if every node is where VTK expects it.
        for kind in (kind for kind in delam.CELLS if kind.startswith(("quad", "hex"))):
            with self.subTest(kind):
                cell = block(kind).to_vtk().GetCell(0)
                low, high = np.array(cell.GetBounds()).reshape(3, 2).T
                for where in np.random.default_rng(1).random((5, 3)):
                    place, weights = [0.0] * 3, [0.0] * cell.GetNumberOfPoints()
                    cell.EvaluateLocation(reference(0), where, place, weights)
                    np.testing.assert_allclose(place, low + where * (high - low), atol=1e-12)

    def test_a_solver(self):
        solver = delam.Solver(support.double_cantilever())
        solver.history([0.5])
        grid = solver.to_vtk()
        displacement = vtk_to_numpy(grid.GetPointData().GetArray("displacement"))
        np.testing.assert_array_equal(displacement[:, :2], solver.field("displacement"))
        np.testing.assert_array_equal(vtk_to_numpy(grid.GetCellData().GetArray("stress")), solver.field("stress"))
        self.assertGreater(np.abs(displacement).max(), 1e-3)

    def test_labels(self):
        mesh = block("quad4")
        for name, level in (("bodies", "INFO"), ("zones", "WARNING")):
            grid = mesh.to_vtk(cell_data={"zones": mesh.cells.bodies + 0.0})
            if name == "zones":
                grid.GetCellData().RemoveArray("bodies")
            with self.assertLogs("delam", "INFO") as caught:
                back = delam.Mesh.from_vtk(grid)
            self.assertEqual(([record.levelname for record in caught.records], back.body_count),
                             ([level], 2 if name == "bodies" else 1))
            self.assertEqual(delam.Mesh.from_vtk(grid, bodies="zones").body_count, 2)
        with self.assertRaisesRegex(delam.ArgumentError, "'half' of cell 0 is 0.5; labels of bodies are integers"):
            delam.Mesh.from_vtk(mesh.to_vtk(cell_data={"half": mesh.cells.bodies + 0.5}), bodies="half")

    def test_what_has_no_place(self):
        from vtkmodules.vtkCommonDataModel import VTK_VOXEL
        grid = block("hex8").to_vtk()
        with self.assertRaisesRegex(delam.ArgumentError, "'parts' is no cell data; there are bodies"):
            delam.Mesh.from_vtk(grid, bodies="parts")
        grid.InsertNextCell(VTK_VOXEL, 8, list(range(8)))
        with self.assertRaisesRegex(delam.MeshError, "VTK type 11 have no place here"):
            delam.Mesh.from_vtk(grid)
        with self.assertRaisesRegex(delam.MeshError, "no cells of a known type"):
            delam.Mesh.from_vtk(vtkUnstructuredGrid())
        with self.assertRaisesRegex(delam.ArgumentError, "grid = dict, expected a vtkUnstructuredGrid"):
            delam.Mesh.from_vtk({})

    def test_pyvista_gets_the_grid(self):
        # PyVista is in no package of Debian 12: what its wrap() is given, and a subclass like its grids, stand for it.
        class UnstructuredGrid(vtkUnstructuredGrid):
            pass

        def wrap(grid):
            wrapped = UnstructuredGrid()
            wrapped.DeepCopy(grid)
            return wrapped

        with mock.patch.dict(sys.modules, {"pyvista": types.SimpleNamespace(wrap=wrap)}):
            grid = block("tet10").to_pyvista()
        self.assertIsInstance(grid, UnstructuredGrid)
        self.assertEqual(delam.Mesh.from_vtk(grid).cell_count, block("tet10").cell_count)


if __name__ == "__main__":
    support.main()
