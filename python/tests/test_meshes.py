"""Meshes: their arrays in memory, files, and comparison."""
import json
import os
import pathlib
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


def test_arrays_are_the_librarys_memory(mesh):
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


def test_faces_have_corners_that_there_are():
    with pytest.raises(vcarve.UsageError, match="a face has vertex 3, but there are 3"):
        vcarve.Mesh(np.zeros((3, 3)), [[0, 1, 3]])


def test_a_comparison_is_what_the_program_writes(mesh, model, program, tmp_path):
    mesh.write(tmp_path / "mesh.ply")
    truth = ROOT / "fixtures/scene/truth.ply"
    program("compare", "--quiet", "--samples", 5000, "--truth", truth,
            "--json", tmp_path / "c.json", model, tmp_path / "mesh.ply")
    report = vcarve.compare(model, tmp_path / "mesh.ply", truth, samples=5000)
    assert report == json.loads((tmp_path / "c.json").read_text(encoding="utf-8"))


def test_several_meshes_have_names(mesh, model):
    report = vcarve.compare(model, {"ours": mesh, "again": mesh}, samples=1000)
    assert [one["name"] for one in report["meshes"]] == ["ours", "again"]
    assert report["meshes"][0]["views"] == report["meshes"][1]["views"]


def test_the_stub_is_what_is_declared():
    subprocess.run([ROOT / "tools/docs/python_stub", "--check"], check=True)


def test_the_types_are_right(tmp_path):
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
