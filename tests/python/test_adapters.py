"""Meshes of other packages: each of the same tetrahedron gives the same answers, and nothing is dropped in silence."""

import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import pierce
from pierce.adapters import arrays_of

VERTICES = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]], dtype=np.float64)
FACES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype=np.int64)
PACKED = np.concatenate([np.full((4, 1), 3), FACES], axis=1).ravel()


class Tracked(np.ndarray):
    """As trimesh's arrays: a subclass."""


class PolyData:
    """As PyVista's, which gives its faces packed, with the number of corners in front."""

    def __init__(self, points, faces, strips=()):
        self.points, self.faces, self.strips = points, np.asarray(faces), np.asarray(strips)


class Tensor:
    """As one of a GPU: NumPy can't read it until it is on the CPU."""

    def __init__(self, array, on_cpu=False):
        self._array, self._on_cpu = array, on_cpu

    def cpu(self):
        return Tensor(self._array, on_cpu=True)

    def numpy(self):
        assert self._on_cpu
        return self._array


def tensor_mesh():
    return SimpleNamespace(vertex={"positions": Tensor(VERTICES.astype(np.float32))},
                           triangle={"indices": Tensor(FACES.astype(np.int32))})


MESHES = {
    "trimesh": lambda: SimpleNamespace(vertices=VERTICES.view(Tracked), faces=FACES.view(Tracked)),
    "lists": lambda: SimpleNamespace(vertices=VERTICES.tolist(), faces=FACES.tolist()),
    "rows apart": lambda: SimpleNamespace(vertices=np.asfortranarray(VERTICES), faces=np.asfortranarray(FACES)),
    "short": lambda: SimpleNamespace(vertices=VERTICES, faces=FACES.astype(np.uint8)),
    "pyvista": lambda: PolyData(VERTICES.astype(np.float32), PACKED),
    "pyvista, rows": lambda: PolyData(VERTICES, FACES),
    "soup": lambda: pierce.TriangleSoup(VERTICES, FACES.astype(np.uint32)),
    "tensors": tensor_mesh,
}


def of_open3d(kind):
    o3d = pytest.importorskip("open3d", reason="Open3D is not installed (tests/install_packages open3d)")
    mesh = o3d.geometry.TriangleMesh(o3d.utility.Vector3dVector(VERTICES),
                                     o3d.utility.Vector3iVector(FACES.astype(np.int32)))
    return mesh if kind == "legacy" else o3d.t.geometry.TriangleMesh.from_legacy(mesh)


@pytest.mark.parametrize("name", [*MESHES, "open3d legacy", "open3d tensor"])
def test_the_same_mesh(name):
    mesh = of_open3d(name.split()[1]) if name.startswith("open3d") else MESHES[name]()
    made = pierce.CollisionMesh.of(mesh)
    assert made.dtype == (np.float32 if name in ("pyvista", "tensors", "open3d tensor") else np.float64)
    assert made.contains(np.array([[1, 1, 1], [2, 2, 2], [-1, 1, 1]], np.float32)).tolist() == [True, False, False]
    hits = made.first_hits_of_rays(np.array([[1, 1, 9], [1, 1, -9]], np.float32),
                                   np.array([[0, 0, -1], [0, 0, 1]], np.float32))
    assert hits.face.tolist() == [3, 0]
    assert hits.position.tolist() == [[1, 1, 2], [1, 1, 0]]


def test_options_go_to_the_mesh():
    made = pierce.CollisionMesh.of(MESHES["trimesh"](), broadphase="grid", face_numbers=[7, 7, 7, 9])
    assert made.statistics()["broadphase"] == "grid"
    assert made.first_hits_of_rays([[1, 1, 9]], [0, 0, -1]).face.tolist() == [9]


def test_numbers_of_faces_are_kept():
    soup = pierce.TriangleSoup(VERTICES, FACES.astype(np.uint32), np.array([5, 5, 6, 6], dtype=np.uint32))
    assert pierce.CollisionMesh.of(soup).first_hits_of_rays([[1, 1, 9]], [0, 0, -1]).face.tolist() == [6]


@pytest.mark.parametrize("name, empty", [
    ("trimesh", SimpleNamespace(vertices=[], faces=[])),
    ("pyvista", PolyData(np.zeros((0, 3), np.float32), np.zeros(0, np.int64))),
    ("tensors", SimpleNamespace(vertex={}, triangle={})),
    ("legacy", SimpleNamespace(vertices=np.zeros((0, 3)), triangles=np.zeros((0, 3), np.int32))),
])
def test_a_mesh_of_nothing(name, empty):
    assert len(pierce.CollisionMesh.of(empty)) == 0


@pytest.mark.parametrize("mesh, words", [
    (PolyData(VERTICES, [3, 0, 2, 1, 4, 0, 1, 2, 3]), "of 2 faces 1 have not three corners, first face 1 with 4"),
    (PolyData(VERTICES, [4, 3, 3, 3, 3, 3, 0, 1, 2]), "of 2 faces 1 have not three corners, first face 0 with 4"),
    (PolyData(VERTICES, [4, 0, 1, 2, 3] * 4), "of 4 faces 4 have not three corners, first face 0 with 4"),
    (PolyData(VERTICES, [3, 0, 2, 1, 3, 0, 1]), "entry 4 says 3 corners"),
    (PolyData(VERTICES, [0, 3, 0, 2, 1]), "entry 0 says 0 corners"),
    (PolyData(VERTICES, [], strips=[4, 0, 1, 2, 3]), "strips"),
    (SimpleNamespace(vertices=VERTICES, faces=np.array([[0, 1, 2, 3]])), "of 1 faces 1 have not three corners"),
])
def test_what_is_no_triangle_is_refused(mesh, words):
    with pytest.raises(ValueError, match=words):
        pierce.CollisionMesh.of(mesh)


@pytest.mark.parametrize("thing", [SimpleNamespace(geometry={}), SimpleNamespace(points=VERTICES), VERTICES, None])
def test_what_is_no_mesh_is_refused(thing):
    with pytest.raises(TypeError, match=f"{type(thing).__name__} is no mesh"):
        arrays_of(thing)


def test_the_guide():
    """The block of Python in the page, for a mesh as trimesh has it."""
    page = Path(__file__).resolve().parents[2] / "examples" / "guide" / "python_examples.md"
    (block,) = re.findall(r"^```python\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)
    names = {"part": MESHES["trimesh"](), "points": [[1, 1, 1], [9, 1, 1]], "origins": [[1, 1, 9], [9, 9, 9]],
             "directions": [[0, 0, -1]] * 2}
    exec(compile(block, str(page), "exec"), names)
    assert names["inside"].tolist() == [True, False]
    assert names["locations"].tolist() == [[1, 1, 2], [1, 1, 0]] and names["index_ray"].tolist() == [0, 0]
    assert names["index_tri"].tolist() == [3, 0] and names["first"].tolist() == [3, -1]


def test_a_wrong_corner_is_refused():
    with pytest.raises(pierce.MeshError):
        pierce.CollisionMesh.of(PolyData(VERTICES, [3, 0, 1, 4]))
