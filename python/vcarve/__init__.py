"""Meshes from COLMAP models, and from points with known views.

    import vcarve
    mesh = vcarve.reconstruct("sparse/0", max_hole=20)
    mesh.write("out.glb")
    mesh.vertices, mesh.faces   # NumPy arrays, not copied

A scene may also be made of arrays (Scene.from_arrays) or of a pycolmap reconstruction. The options
of the command line are keywords with the same names, ranges and meanings. Runs log to the logger
"vcarve". Ctrl-C ends a run within a second. Other Python threads continue during a run.
"""
import collections
import json
import os

from . import _colmap, _options, _scenes, _vcarve
from ._runs import Listener
from ._vcarve import Error, InputError, Mesh, Scene, UsageError, __version__, read_mesh

__all__ = ["Error", "InputError", "Mesh", "Scene", "UsageError", "__version__", "compare",
           "Texture", "read_mesh", "read_model", "reconstruct", "texture"]

Texture = collections.namedtuple("Texture", "pages page_of_face coordinates")
Texture.__doc__ = """The texture of a mesh.

`pages` is a list of images (height, width, 3), `page_of_face` (m,) has the page of each face, and
`coordinates` (m, 3, 2) the positions of the corners: (0, 0) is the upper left corner of the page,
(1, 1) the lower right corner.
"""


def _is_path(model):
    return isinstance(model, (str, os.PathLike))


def _scene_of(model, given, listener):
    """Returns the scene of a Scene, a pycolmap reconstruction or the path of a model."""
    if _is_path(model):
        return _vcarve.read_scene(model, given, listener)
    if given:
        raise TypeError(f"{', '.join(given)}: only allowed if the model is a path")
    return model if isinstance(model, Scene) else _colmap.from_colmap(model)


@_options.takes("input")
def read_model(model, *, progress=None, **options):
    """Reads a COLMAP model, a dense workspace or a laser scan as a Scene.

    `model` is a path as on the command line. Calls `progress(stage, share)`, see reconstruct().
    """
    return _vcarve.read_scene(model, options, Listener(progress))


@_options.takes("input", "reconstruct", "output")
def reconstruct(scene, *, attributes=False, consume=False, progress=None, **options):
    """Makes the mesh of a scene, as `colmap-vcarve MODEL OUT.ply` does.

    `scene` is a Scene, the path of a model, or an object like pycolmap.Reconstruction. With
    `attributes`, the mesh has the input point of each vertex, and the number of views that support
    each face. With `dense`, dense points are computed from the photographs; with `texture`,
    Mesh.texture is made of them. A Scene needs their folder, `images`. `up` is the direction of
    .glb files. With `consume`, the arrays of a Scene are moved instead of copied; no NumPy arrays of
    the scene may exist then. Calls `progress(stage, share)`; shares increase from 0 to 1 in every
    stage. An exception of `progress` ends the run.
    Raises UsageError if an option is out of range or the scene is inconsistent. Raises InputError
    if a file is wrong or the scene has too little data for a surface.
    """
    given, settings = _options.split(options, "input")
    output, settings = _options.split(settings, "output")
    listener = Listener(progress)
    if _is_path(scene):
        mesh = _vcarve.reconstruct_model(scene, given, settings, output, attributes, listener)
    else:
        run = _vcarve.consume_scene if consume else _vcarve.reconstruct_scene
        mesh = run(_scene_of(scene, given, listener), settings, output, attributes, listener)
    mesh.counts.update(listener.counts)
    return mesh


@_options.takes("texture")
def texture(model, mesh, *, progress=None, **options):
    """Textures a mesh with the photographs of a model, as `colmap-vcarve texture` does.

    `model` is the path of a model, or a scene as for reconstruct(), which needs `images`. `mesh` is
    a Mesh in the model's frame, or the path of a PLY file. Returns a Mesh with a texture, whose
    faces may be parts of those of `mesh`. Calls `progress(stage, share)`, see reconstruct().
    """
    listener = Listener(progress)
    scene = model if _is_path(model) else _scene_of(model, {}, listener)
    made = _vcarve.texture_mesh(scene, _named(mesh, "mesh")[1], options, listener)
    made.counts.update(listener.counts)
    return made


def _named(mesh, name):
    if isinstance(mesh, Mesh):
        return name, mesh
    return (name if name != "mesh" else os.path.basename(os.fspath(mesh))), read_mesh(mesh)


def _all_named(meshes):
    """Returns pairs of name and mesh, from one mesh, a list or a dictionary."""
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
    """Measures meshes against their model, and against the true surface if it is known.

    `model` is a scene as for reconstruct(). `meshes` is a Mesh, the path of a PLY file, or a list
    or dictionary of these; `truth` is a Mesh or a path. Returns the JSON of `colmap-vcarve compare
    --json` as a dictionary, such as report["meshes"][0]["views"]["hidden_rays"]. docs/results.md
    explains the figures.
    """
    given, settings = _options.split(options, "input")
    listener = Listener(progress)
    named_truth = None if truth is None else _named(truth, "truth")
    return json.loads(_vcarve.compare_meshes(_scene_of(model, given, listener), _all_named(meshes),
                                             named_truth, settings, listener))


def _texture_of(mesh):
    """The Texture of a mesh made with `texture=True`, else None. The arrays are not copied."""
    return None if mesh._texture is None else Texture(*mesh._texture)


def _mesh_text(mesh):
    return f"<vcarve.Mesh: {len(mesh.vertices):,} vertices, {len(mesh.faces):,} faces>"


def _scene_text(scene):
    return (f"<vcarve.Scene: {len(scene.positions):,} points, {len(scene.names):,} views, "
            f"{len(scene.track_views):,} rays>")


Mesh.__doc__ = """A mesh: vertices (n, 3), faces (m, 3) of vertex indices, colors (n, 3), normals (n, 3).

Colors are integers from 0 to 255 or floats from 0 to 1. Numbers that do not fit, vertices that are
not finite, and degenerate faces raise UsageError with the index. The arrays are the library's
memory, without a copy. Arrays without data are empty.
"""
Mesh.__repr__ = _mesh_text
Mesh.texture = property(_texture_of)
Scene.__repr__ = _scene_text
Scene.__module__ = Mesh.__module__ = "vcarve"
Scene.from_arrays = staticmethod(_scenes.from_arrays)
Scene.from_colmap = staticmethod(_colmap.from_colmap)
