"""Meshes: their arrays in memory, files, and comparison."""
import copy
import json
import os
import pathlib
import pickle
import subprocess
import sys

import numpy as np
import pytest

import vcarve

ROOT = pathlib.Path(os.environ["VCARVE_ROOT"])


def address(array):
    return array.__array_interface__["data"][0]


@pytest.fixture(scope="module")
def mesh():
    return vcarve.reconstruct(ROOT / "fixtures/scene/sparse/0", attributes=True)


def test_arrays_refer_to_the_librarys_memory(mesh):
    vertices, faces = len(mesh.vertices), len(mesh.faces)
    for name, dtype, shape in (("vertices", np.float64, (vertices, 3)),
                               ("faces", np.uint32, (faces, 3)),
                               ("colors", np.uint8, (vertices, 3)),
                               ("normals", np.float32, (vertices, 3)),
                               ("point_ids", np.int64, (vertices,)),
                               ("num_views", np.int32, (vertices,)),
                               ("errors_px", np.float32, (vertices,)),
                               ("support", np.int32, (faces,))):
        array = getattr(mesh, name)
        assert array.dtype == dtype and array.shape == shape and not array.flags.owndata
        assert address(array) == address(getattr(mesh, name))


def test_arrays_outlive_their_mesh(room):
    vertices = vcarve.reconstruct(room.scene()).vertices
    assert np.isfinite(vertices).all()


def test_a_mesh_of_arrays_is_written_and_read_back(mesh, tmp_path):
    made = vcarve.Mesh(mesh.vertices, mesh.faces, mesh.colors, mesh.normals)
    made.write(tmp_path / "made.ply", offset=[1.0, 2.0, 3.0])
    back = vcarve.read_mesh(str(tmp_path / "made.ply"))
    assert np.allclose(back.vertices, mesh.vertices, rtol=0, atol=1e-12)
    assert np.array_equal(back.faces, mesh.faces) and np.array_equal(back.colors, mesh.colors)


def test_every_format_is_written(mesh, tmp_path):
    for end in ("ply", "obj", "off", "stl", "glb"):
        mesh.write(tmp_path / f"out.{end}")
        assert (tmp_path / f"out.{end}").stat().st_size > 1000
    with pytest.raises(vcarve.UsageError):
        mesh.write(tmp_path / "out.doc")


TRIANGLE = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))


def with_value(rows, index, value, dtype):
    rows = np.array(rows, dtype=dtype)
    rows[index] = value
    return rows


@pytest.mark.parametrize("vertices, faces, given, sentence", [
    (TRIANGLE, [[0, 1, 2], [0, 1, 3]], {}, r"faces\[1\] has a vertex that does not exist"),
    (TRIANGLE, [[0, 1, 2], [2, 0, 2]], {}, r"faces\[1\] is degenerate"),
    (TRIANGLE, [[0, 1, -1]], {}, r"faces must be integers .* faces\[0, 2\] is -1"),
    (TRIANGLE, [[0, 1, 2**32]], {}, r"faces\[0, 2\] is 4294967296"),
    (TRIANGLE, [[0.0, 1.0, 2.9]], {}, "faces must be integers"),
    (TRIANGLE, [["0", "1", "2"]], {}, "faces must be integers"),
    (with_value(TRIANGLE, (1, 2), np.nan, float), [[0, 1, 2]], {}, r"vertices\[1, 2\] is nan"),
    (with_value(TRIANGLE, (2, 0), 1j, complex), [[0, 1, 2]], {}, "vertices must be real numbers"),
    (TRIANGLE, [[0, 1, 2]], {"normals": with_value(TRIANGLE, (2, 1), np.inf, float)},
     r"normals\[2, 1\] is inf"),
    (TRIANGLE, [[0, 1, 2]], {"normals": with_value(TRIANGLE, (2, 1), 1e300, float)},
     r"normals\[2, 1\] is 1e\+300"),
    (TRIANGLE, [[0, 1, 2]], {"colors": with_value(TRIANGLE, (2, 1), 200.0, float)},
     r"floats from 0 to 1, but colors\[2, 1\] is 200"),
    (TRIANGLE, [[0, 1, 2]], {"colors": with_value(TRIANGLE, (1, 1), np.nan, float)},
     r"colors\[1, 1\] is nan"),
    (TRIANGLE, [[0, 1, 2]], {"colors": with_value(TRIANGLE, (0, 2), 300, int)},
     r"integers from 0 to 255, but colors\[0, 2\] is 300"),
    (TRIANGLE, [[0, 1, 2]], {"colors": with_value(TRIANGLE, (0, 2), -1, int)},
     r"colors\[0, 2\] is -1"),
])
def test_a_mesh_rejects_numbers_that_do_not_fit(vertices, faces, given, sentence):
    with pytest.raises(vcarve.UsageError, match=sentence):
        vcarve.Mesh(vertices, faces, **given)


def test_float_colors_of_a_mesh_are_from_0_to_1():
    mesh = vcarve.Mesh(TRIANGLE, [[0, 1, 2]], np.array([[0.0, 0.5, 1.0]] * 3))
    assert mesh.colors.tolist() == [[0, 128, 255]] * 3
    assert "floats from 0 to 1" in vcarve.Mesh.__doc__
    assert vcarve.Mesh(TRIANGLE, np.zeros((0, 3))).faces.shape == (0, 3), "an empty list is floats"


@pytest.mark.parametrize("array, index, value, sentence", [
    ("vertices", (1, 0), np.nan, r"vertices\[1\] is not finite"),
    ("normals", (2, 0), np.inf, r"normals\[2\] is not finite"),
    ("faces", (0, 2), 1, r"faces\[0\] is degenerate"),
    ("faces", (0, 2), 9, r"faces\[0\] has a vertex that does not exist"),
])
@pytest.mark.parametrize("end", ["ply", "glb"])
def test_writing_rejects_arrays_made_invalid_in_place(end, array, index, value, sentence,
                                                      tmp_path):
    mesh = vcarve.Mesh(TRIANGLE, [[0, 1, 2]], normals=[[0.0, 0.0, 1.0]] * 3)
    getattr(mesh, array)[index] = value
    with pytest.raises(vcarve.UsageError, match=sentence):
        mesh.write(tmp_path / f"out.{end}")
    assert not list(tmp_path.iterdir())


def test_writing_rejects_an_offset_that_is_not_finite(tmp_path):
    with pytest.raises(vcarve.UsageError, match="offset is not finite"):
        vcarve.Mesh(TRIANGLE, [[0, 1, 2]]).write(tmp_path / "out.ply", offset=[0, np.nan, 0])


def test_comparison_rejects_faces_without_vertices(model):
    mesh = vcarve.Mesh(TRIANGLE, [[0, 1, 2]])
    mesh.faces[0] = 1 << 30
    with pytest.raises(vcarve.UsageError, match=r"faces\[0\] has a vertex that does not exist"):
        vcarve.compare(model, mesh)
    with pytest.raises(vcarve.UsageError, match=r"faces\[0\] has a vertex that does not exist"):
        vcarve.compare(model, vcarve.Mesh(TRIANGLE, [[0, 1, 2]]), mesh)


def test_a_mesh_shows_its_counts():
    assert repr(vcarve.Mesh(np.zeros((1234, 3)), [[0, 1, 2]])) == (
        "<vcarve.Mesh: 1,234 vertices, 1 faces>")


@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy,
                                       lambda mesh: pickle.loads(pickle.dumps(mesh))])
def test_copies_and_pickles_of_a_mesh_are_equal_and_independent(duplicate, mesh, tmp_path):
    made = duplicate(mesh)
    mesh.write(tmp_path / "mesh.ply")
    made.write(tmp_path / "made.ply")
    assert (tmp_path / "mesh.ply").read_bytes() == (tmp_path / "made.ply").read_bytes()
    assert made.counts == mesh.counts and np.array_equal(made.support, mesh.support)
    made.vertices[0] += 1.0
    made.counts.clear()
    assert not np.array_equal(made.vertices[0], mesh.vertices[0]) and mesh.counts


def test_a_comparison_equals_the_json_of_the_program(mesh, model, program, tmp_path):
    mesh.write(tmp_path / "mesh.ply")
    truth = ROOT / "fixtures/scene/truth.ply"
    program("compare", "--quiet", "--samples", 5000, "--truth", truth,
            "--json", tmp_path / "c.json", model, tmp_path / "mesh.ply")
    report = vcarve.compare(model, tmp_path / "mesh.ply", truth, samples=5000)
    assert report == json.loads((tmp_path / "c.json").read_text(encoding="utf-8"))


def test_compared_meshes_have_names(mesh, model):
    report = vcarve.compare(model, {"ours": mesh, "again": mesh}, samples=1000)
    assert [one["name"] for one in report["meshes"]] == ["ours", "again"]
    assert report["meshes"][0]["views"] == report["meshes"][1]["views"]


def test_the_stub_matches_the_declarations():
    subprocess.run([ROOT / "tools/docs/python_stub", "--check"], check=True)


def test_mypy_accepts_right_types_and_rejects_wrong_ones(tmp_path):
    (tmp_path / "typed.py").write_text('''
from typing import Any
import numpy as np
from numpy.typing import NDArray
import vcarve
mesh = vcarve.reconstruct("sparse/0", method="cut", max_hole=20, crop=[0, 0, 0, 1, 1, 1])
vertices: NDArray[np.float64] = mesh.vertices
report: dict[str, Any] = vcarve.compare("sparse/0", [mesh, "other.ply"], samples=1000)
''', encoding="utf-8")
    (tmp_path / "wrong.py").write_text('''
import vcarve
vcarve.reconstruct("sparse/0", method="paint")
vcarve.reconstruct("sparse/0", max_hole="many")
''', encoding="utf-8")
    run = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", tmp_path, "typed.py", "wrong.py"],
        cwd=tmp_path, check=False, capture_output=True, text=True,
        env={**os.environ, "MYPYPATH": str(ROOT / "python")})
    faults = [line for line in run.stdout.splitlines() if "error:" in line]
    assert [line.split(": ")[0] for line in faults] == ["wrong.py:3", "wrong.py:4"]


@pytest.mark.parametrize("example", sorted((ROOT / "examples/python").glob("*.py")),
                         ids=lambda path: path.name)
def test_an_example_runs(example, tmp_path):
    subprocess.run([sys.executable, example], cwd=tmp_path, check=True,
                   env={**os.environ, "MPLBACKEND": "Agg"})
    assert list(tmp_path.iterdir())
