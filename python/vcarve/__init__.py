"""Surfaces of COLMAP models, and of points whose views are known.

    import vcarve
    mesh = vcarve.reconstruct("sparse/0", max_hole=20)
    mesh.write("out.glb")
    mesh.vertices, mesh.faces   # NumPy arrays, not copied

A scene may come from arrays (Scene.from_arrays) or from a reconstruction of pycolmap's instead.
The options of the command line are keywords, with the same names, ranges and meanings. What a run
says of itself goes to the logger "vcarve". Ctrl-C ends a run within a second, and other threads go
on meanwhile.
"""
import json
import os

from . import _colmap, _options, _scenes, _vcarve
from ._runs import Listener
from ._vcarve import Error, InputError, Mesh, Scene, UsageError, __version__, read_mesh

__all__ = ["Error", "InputError", "Mesh", "Scene", "UsageError", "__version__", "compare",
           "read_mesh", "read_model", "reconstruct"]


def _is_path(model):
    return isinstance(model, (str, os.PathLike))


def _scene_of(model, given, listener):
    """The scene that is given as itself, as a reconstruction or as the path of a model."""
    if _is_path(model):
        return _vcarve.read_scene(model, given, listener)
    if given:
        raise TypeError(f"{', '.join(given)}: only of use where the model is a path")
    return model if isinstance(model, Scene) else _colmap.from_colmap(model)


@_options.takes("input")
def read_model(model, *, progress=None, **options):
    """Reads a COLMAP model, a dense workspace or a laser scan as a Scene.

    `model` is the path that the command line takes; `progress(stage, share)` is told how far it is.
    """
    return _vcarve.read_scene(model, options, Listener(progress))


@_options.takes("input", "reconstruct")
def reconstruct(scene, *, attributes=False, consume=False, progress=None, **options):
    """Makes the surface of a scene, as `colmap-vcarve MODEL OUT.ply` does.

    `scene` is a Scene, the path of a model, or an object shaped like pycolmap.Reconstruction. With
    `attributes` the mesh tells which points its vertices were, and how many views its faces rest
    on. With `consume` the arrays of a Scene are used up instead of copied; no NumPy array of them
    may be left then. `progress(stage, share)` is told how far the run is, 0 to 1 in every stage; an
    exception that it raises ends the run.
    Raises UsageError where an option is out of its range or the scene does not fit together, and
    InputError where a file is wrong or the scene holds too little for a surface.
    """
    given, settings = _options.split(options, "input")
    listener = Listener(progress)
    if _is_path(scene):
        mesh = _vcarve.reconstruct_model(scene, given, settings, attributes, listener)
    else:
        run = _vcarve.consume_scene if consume else _vcarve.reconstruct_scene
        mesh = run(_scene_of(scene, given, listener), settings, attributes, listener)
    mesh.counts.update(listener.counts)
    return mesh


def _named(mesh, name):
    if isinstance(mesh, Mesh):
        return name, mesh
    return (name if name != "mesh" else os.path.basename(os.fspath(mesh))), read_mesh(mesh)


def _all_named(meshes):
    """Pairs of name and mesh of one mesh, of several, or of a dictionary of them."""
    if isinstance(meshes, (Mesh, str, os.PathLike)):
        meshes = [meshes]
    if isinstance(meshes, dict):
        return [_named(mesh, name) for name, mesh in meshes.items()]
    if len(meshes) == 1:
        return [_named(meshes[0], "mesh")]
    return [_named(mesh, f"mesh {i + 1}" if isinstance(mesh, Mesh) else "mesh")
            for i, mesh in enumerate(meshes)]


@_options.takes("input", "compare")
def compare(model, meshes, truth=None, *, progress=None, **options):
    """Measures meshes against the model they were made from, and the truth where it is known.

    `model` is what reconstruct() takes. `meshes` is a Mesh, the path of a PLY file, a list or a
    dictionary of them; `truth` is one of the first two. Returns what `colmap-vcarve compare --json`
    writes, as a dictionary: report["meshes"][0]["views"]["hidden_sights"]; docs/results.md
    explains the figures.
    """
    given, settings = _options.split(options, "input")
    listener = Listener(progress)
    named_truth = None if truth is None else _named(truth, "truth")
    return json.loads(_vcarve.compare_meshes(_scene_of(model, given, listener), _all_named(meshes),
                                             named_truth, settings, listener))


def _mesh_text(mesh):
    return f"<vcarve.Mesh: {len(mesh.vertices):,} vertices, {len(mesh.faces):,} faces>"


def _scene_text(scene):
    return (f"<vcarve.Scene: {len(scene.positions):,} points, {len(scene.names):,} views, "
            f"{len(scene.track_views):,} rays>")


Mesh.__doc__ = """A surface: vertices (n, 3), faces (m, 3) of vertex indices, colors (n, 3), normals (n, 3).

Colors are integers from 0 to 255 or floats from 0 to 1. Numbers that do not fit, vertices that are
not finite, and degenerate faces raise UsageError, which names the index. The arrays are the
library's own memory; they are empty where nothing is known.
"""
Mesh.__repr__ = _mesh_text
Scene.__repr__ = _scene_text
Scene.__module__ = Mesh.__module__ = "vcarve"
Scene.from_arrays = staticmethod(_scenes.from_arrays)
Scene.from_colmap = staticmethod(_colmap.from_colmap)
