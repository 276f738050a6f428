"""Scenes: from arrays, from objects like pycolmap's, and their arrays in memory."""
import copy
import pickle
import types

import numpy as np
import pytest

import vcarve


def address(array):
    return array.__array_interface__["data"][0]


def test_arrays_of_a_million_points_refer_to_the_librarys_memory():
    scene = vcarve.Scene.empty(points=1_000_000, rays=3_000_000)
    for name, dtype, shape in (("positions", np.float64, (1_000_000, 3)),
                               ("colors", np.uint8, (1_000_000, 3)),
                               ("errors_px", np.float64, (1_000_000,)),
                               ("point_ids", np.uint64, (1_000_000,)),
                               ("track_begins", np.uint64, (1_000_001,)),
                               ("track_views", np.uint32, (3_000_000,))):
        array = getattr(scene, name)
        assert array.dtype == dtype and array.shape == shape and not array.flags.owndata
        assert address(array) == address(getattr(scene, name))
        array[-1] = 7
        assert np.all(getattr(scene, name)[-1] == 7)


def test_changes_of_arrays_change_the_mesh(room):
    scene, moved = room.scene(), room.scene()
    moved.positions[:] *= 2.0
    moved.positions[:] += 1.0
    for_comparison = vcarve.Scene.from_arrays(room.positions * 2.0 + 1.0, centers=room.centers,
                                              tracks=room.tracks)
    assert np.array_equal(vcarve.reconstruct(moved).vertices,
                          vcarve.reconstruct(for_comparison).vertices)
    assert not np.array_equal(vcarve.reconstruct(scene).vertices,
                              vcarve.reconstruct(moved).vertices)


def test_arrays_outlive_their_scene(room):
    positions = room.scene().positions
    assert np.array_equal(positions, room.positions)


def test_tracks_may_be_a_list_a_pair_or_a_sparse_matrix(room):
    count, views = len(room.positions), len(room.centers)
    begins = np.arange(count + 1) * views
    flat = np.tile(np.arange(views)[::-1], count)
    rows = room.scene()
    pair = room.scene(tracks=(begins, flat))
    sparse = room.scene(tracks=types.SimpleNamespace(indptr=begins.astype(np.int32),
                                                     indices=flat.astype(np.int32)))
    for scene in (pair, sparse):
        assert np.array_equal(scene.track_begins, rows.track_begins)
        assert np.array_equal(scene.track_views, rows.track_views)


def test_without_tracks_the_nearest_views_are_used(room):
    scene = room.scene(tracks=None)
    assert len(scene.track_views) > 2 * len(room.positions)
    assert len(vcarve.reconstruct(scene).faces) > 100


def test_poses_of_both_conventions_and_centers_give_the_same_centers(model):
    scene = vcarve.read_model(model)
    centers = scene.centers
    rotation = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    world_from_cam = np.zeros((len(centers), 4, 4))
    world_from_cam[:, :3, :3] = rotation
    world_from_cam[:, :3, 3] = centers
    world_from_cam[:, 3, 3] = 1.0
    cam_from_world = np.linalg.inv(world_from_cam)[:, :3]
    for given in ({"world_from_cam": world_from_cam}, {"cam_from_world": cam_from_world},
                  {"centers": centers}):
        made = vcarve.Scene.from_arrays(scene.positions, tracks=(scene.track_begins,
                                                                 scene.track_views), **given)
        assert np.allclose(made.centers, centers)


def test_scanners_are_views_of_their_points(room):
    scene = vcarve.Scene.from_arrays(room.positions, scanners=[2.0, 1.5, 1.2])
    assert scene.centers.tolist() == [[2.0, 1.5, 1.2]] and scene.is_dense
    assert len(vcarve.reconstruct(scene).faces) > 100


def test_colors_may_be_floats(room):
    colors = np.zeros_like(room.positions)
    colors[:, 0] = 1.0
    scene = room.scene(colors=colors)
    assert scene.colors[0].tolist() == [255, 0, 0]
    assert vcarve.reconstruct(scene).colors.max(axis=0).tolist() == [255, 0, 0]


@pytest.mark.parametrize("given, sentence", [
    ({"centers": [[0.0, 0.0]]}, r"centers must be an array of shape \(n, 3\), not \(1, 2\)"),
    ({"tracks": [[0, 9]] * 2000}, "the track of point 0 has view 9, but there are 4"),
    ({"tracks": ([0, 1], [0])}, "the track_begins of 2000 points must be 2001 numbers"),
    ({"tracks": [[-1]] * 2000}, r"track_views\[0\] is -1"),
    ({"tracks": [[0.5]] * 2000}, "track_views must be integers"),
    ({"tracks": np.ones((2000, 3), dtype=bool)},
     r"boolean tracks must be an array of shape \(2000, 4\), not \(2000, 3\)"),
    ({"cam_from_world": np.zeros((1, 3, 4))}, "expected one of cam_from_world"),
    ({"centers": None, "cam_from_world": np.zeros((4, 3, 4))},
     "the pose of view 0 has no valid rotation"),
    ({"colors": np.zeros((3, 3))}, r"colors must be an array of shape \(2000, 3\), not \(3, 3\)"),
    ({"colors": np.full((2000, 3), 200.0)}, r"floats from 0 to 1, but colors\[0, 0\] is 200"),
    ({"colors": np.full((2000, 3), -0.1)}, r"colors\[0, 0\] is -0.1"),
    ({"colors": np.full((2000, 3), 300)}, r"colors\[0, 0\] is 300"),
    ({"colors": np.full((2000, 3), -1)}, r"colors\[0, 0\] is -1"),
    ({"errors_px": np.full(2000, 1j)}, "errors_px must be real numbers"),
    ({"normals": np.full((2000, 3), np.nan)}, r"normals\[0, 0\] is nan"),
    ({"normals": np.zeros((3, 3))}, r"normals must be an array of shape \(2000, 3\)"),
    ({"centers": np.full((4, 3), 1j)}, "centers must be real numbers"),
    ({"centers": [[0.0, 0.0, 0.0], [0.0, np.inf, 0.0]]}, r"centers\[1, 1\] is inf"),
    ({"intrinsics": np.full((3, 3), np.nan), "size": (640, 480)}, r"intrinsics\[0, 0\] is nan"),
    ({"intrinsics": np.eye(3), "size": (640.5, 480)}, "size must be integers"),
    ({"intrinsics": np.eye(3)}, "intrinsics need the size of the images"),
    ({"scanners": [0, 0, 0]}, "scanners replace"),
])
def test_arrays_that_do_not_fit_are_rejected_with_a_sentence(given, sentence, room):
    with pytest.raises(vcarve.UsageError, match=sentence):
        room.scene(**given)


def test_complex_positions_are_rejected(room):
    with pytest.raises(vcarve.UsageError, match="positions must be real numbers"):
        vcarve.Scene.from_arrays(room.positions + 1j, centers=room.centers, tracks=room.tracks)


def test_positions_that_are_not_finite_are_dropped_and_counted(room):
    room.positions[5] = np.nan
    mesh = vcarve.reconstruct(room.scene())
    assert mesh.counts["filter"]["non-finite"] == 1 and np.isfinite(mesh.vertices).all()


def seen_at_random(room):
    """Returns a boolean matrix of points by views, and the scene with these tracks."""
    seen = np.random.default_rng(2).uniform(size=(len(room.positions), len(room.centers))) < 0.7
    return seen, room.scene(tracks=[np.flatnonzero(row) for row in seen])


def require_same_tracks(scene, other):
    assert np.array_equal(scene.track_begins, other.track_begins)
    assert np.array_equal(scene.track_views, other.track_views)


def test_tracks_may_be_a_boolean_matrix_of_points_by_views(room):
    seen, rows = seen_at_random(room)
    for matrix in (seen, seen.tolist()):
        require_same_tracks(room.scene(tracks=matrix), rows)


def test_tracks_may_be_sparse_matrices_in_any_format(room):
    sparse = pytest.importorskip("scipy.sparse")
    seen, rows = seen_at_random(room)
    with_stored_zeros = sparse.csr_matrix(np.ones_like(seen))
    with_stored_zeros.data[:] = seen.ravel()
    for matrix in (sparse.csr_matrix(seen), sparse.csc_matrix(seen), sparse.coo_matrix(seen),
                   with_stored_zeros):
        require_same_tracks(room.scene(tracks=matrix), rows)


def test_a_scene_shows_its_counts(room):
    assert repr(room.scene()) == "<vcarve.Scene: 2,000 points, 4 views, 8,000 rays>"


@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy,
                                       lambda scene: pickle.loads(pickle.dumps(scene))])
def test_copies_and_pickles_of_a_scene_are_equal_and_independent(duplicate, model):
    scene = vcarve.read_model(model)
    scene.set_normals(np.tile([0.0, 0.0, 1.0], (len(scene.positions), 1)))
    scene.is_dense = True
    made = duplicate(scene)
    for name in ("positions", "colors", "errors_px", "point_ids", "normals", "track_begins",
                 "track_views", "centers"):
        assert np.array_equal(getattr(made, name), getattr(scene, name)), name
    assert made.names == scene.names and made.is_dense
    surface = vcarve.reconstruct(scene)
    assert np.array_equal(vcarve.reconstruct(made).vertices, surface.vertices)
    made.positions[0] += 1.0
    assert not np.array_equal(made.positions[0], scene.positions[0])


def _as_method(value):
    return lambda: value


def pycolmap_like(scene, newest):
    """Returns a scene as an object like pycolmap's, with newer or older names."""
    views, images = range(len(scene.centers)), {}
    for i in views:
        image = types.SimpleNamespace(image_id=i + 1, camera_id=1, name=scene.names[i])
        translation = -scene.centers[i]
        if newest:
            pose = types.SimpleNamespace(matrix=_as_method(np.c_[np.eye(3), translation]))
            image.cam_from_world, image.has_pose = _as_method(pose), True
        else:
            image.rotmat, image.tvec, image.registered = _as_method(np.eye(3)), translation, True
        images[i + 1] = image
    lens = types.SimpleNamespace(name="EQUIRECTANGULAR") if newest else "EQUIRECTANGULAR"
    camera = types.SimpleNamespace(model=lens, width=4000, height=2000, params=[4000.0, 2000.0])
    points = {}
    for i, row in enumerate(np.split(scene.track_views, scene.track_begins[1:-1].astype(int))):
        elements = [types.SimpleNamespace(image_id=int(view) + 1, point2D_idx=0) for view in row]
        points[i + 1] = types.SimpleNamespace(xyz=scene.positions[i], color=scene.colors[i],
                                              error=scene.errors_px[i],
                                              track=types.SimpleNamespace(elements=elements))
    return types.SimpleNamespace(cameras={1: camera}, images=images, points3D=points)


@pytest.mark.parametrize("newest", [True, False])
def test_an_object_like_pycolmaps_is_a_scene(newest, room):
    scene = room.scene()
    of_shape = vcarve.reconstruct(pycolmap_like(scene, newest))
    assert np.array_equal(of_shape.vertices, vcarve.reconstruct(scene).vertices)


def test_other_objects_raise_a_type_error():
    with pytest.raises(TypeError, match="like pycolmap.Reconstruction; found type list"):
        vcarve.reconstruct([1, 2])


def test_tracks_cannot_change_while_arrays_are_in_use(room):
    scene = room.scene()
    kept = scene.track_views
    with pytest.raises(BufferError):
        scene.set_tracks([0] * 2001, [])
    del kept
    scene.set_tracks([0] * 2001, np.zeros(0, dtype=np.uint32))
    assert len(scene.track_views) == 0
