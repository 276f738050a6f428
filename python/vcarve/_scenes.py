"""Scenes from NumPy arrays."""
import numpy as np

from ._arrays import fill, numbers
from ._runs import Listener
from ._vcarve import Scene, UsageError

# Views without a known rotation see in all directions, with COLMAP's camera model of panoramas.
PANORAMA = ("EQUIRECTANGULAR", (4000, 2000), [4000.0, 2000.0])


def _poses(cam_from_world, world_from_cam, centers):
    """Returns rotations and centers of the views."""
    given = [value for value in (cam_from_world, world_from_cam, centers) if value is not None]
    if len(given) != 1:
        raise UsageError("expected one of cam_from_world, world_from_cam, centers and scanners, "
                         f"found {len(given)} of them")
    if centers is not None:
        centers = numbers("centers", centers, np.float64)
        if centers.ndim != 2 or centers.shape[1] != 3:
            raise UsageError(f"centers must be an array of shape (n, 3), not {centers.shape}")
        return np.broadcast_to(np.eye(3), (len(centers), 3, 3)), centers
    poses = numbers("poses", given[0], np.float64)
    if poses.ndim != 3 or poses.shape[1:] not in ((3, 4), (4, 4)):
        raise UsageError(f"poses must be an array of shape (n, 3, 4) or (n, 4, 4), not "
                         f"{poses.shape}")
    rotations, places = poses[:, :3, :3], poses[:, :3, 3]
    if world_from_cam is not None:
        return rotations.transpose(0, 2, 1), places
    return rotations, -np.einsum("nji,nj->ni", rotations, places)


def _add_cameras(scene, views, intrinsics, size, ranges):
    """Adds one camera for all views or one per view. Returns the camera of every view."""
    if intrinsics is None:
        scene.add_camera(*PANORAMA, ranges)
        return np.zeros(views, dtype=np.uint32)
    if size is None:
        raise UsageError("intrinsics need the size of the images, size=(width, height)")
    matrices = numbers("intrinsics", intrinsics, np.float64).reshape(-1, 3, 3)
    sizes = np.broadcast_to(numbers("size", size, np.uint64).reshape(-1, 2), (len(matrices), 2))
    if len(matrices) not in (1, views):
        raise UsageError(f"found {len(matrices)} intrinsics, but expected one, or one for each of "
                         f"{views} views")
    for matrix, (width, height) in zip(matrices, sizes):
        params = [matrix[0, 0], matrix[1, 1], matrix[0, 2], matrix[1, 2]]
        scene.add_camera("PINHOLE", (int(width), int(height)), params, ranges)
    return np.arange(views, dtype=np.uint32) if len(matrices) > 1 else np.zeros(views, np.uint32)


def _rows_of_matrix(seen, shape):
    """Returns begins and views of the tracks of a boolean matrix, points by views."""
    seen = np.asarray(seen)
    if seen.shape != shape:
        raise UsageError(f"boolean tracks must be an array of shape {shape}, not {seen.shape}")
    return np.cumsum([0, *np.count_nonzero(seen, axis=1)]), np.nonzero(seen)[1]


def _rows(tracks, points, views):
    """Returns begins and views of tracks. `tracks` is a list of rows, a pair of arrays, or a matrix
    of points by views, boolean or scipy.sparse."""
    if hasattr(tracks, "tocsr"):
        tracks = tracks.tocsr()
        if tracks.dtype == bool:
            tracks = tracks.copy()
            tracks.eliminate_zeros()
    if hasattr(tracks, "indptr") and hasattr(tracks, "indices"):
        return tracks.indptr, tracks.indices
    if len(tracks) and np.asarray(tracks[0]).dtype == bool:
        return _rows_of_matrix(tracks, (points, views))
    if isinstance(tracks, tuple) and len(tracks) == 2:
        return tracks
    lengths = [len(row) for row in tracks]
    begins = np.zeros(len(lengths) + 1, dtype=np.uint64)
    np.cumsum(lengths, out=begins[1:])
    rows = [np.asarray(row) for row in tracks if len(row)]
    return begins, np.concatenate(rows) if rows else np.zeros(0, dtype=np.uint32)


def from_arrays(positions, *, cam_from_world=None, world_from_cam=None, centers=None,
                scanners=None, intrinsics=None, size=None, tracks=None, colors=None, normals=None,
                errors_px=None, ranges=False, dense=False, progress=None):
    """Returns a scene of points, and of the views that saw them, from arrays.

    positions: (n, 3). Points that are not finite are dropped and counted.
    cam_from_world or world_from_cam: poses of the views, (v, 3, 4) or (v, 4, 4), with x right, y
        down and z forward as in COLMAP and OpenCV. Alternatives are centers, (v, 3), for views
        without known rotations, and scanners, (3,) or (n, 3): one scanner position for all points
        or one per point.
    intrinsics: (3, 3) or (v, 3, 3) with focal lengths and principal point in pixels, for images of
        size (width, height). Without intrinsics, views see in all directions.
    tracks: the views of each point, numbered from 0: a list of rows, a pair (begins, views) in
        which row i is views[begins[i]:begins[i + 1]], or a matrix of points by views, boolean or
        scipy.sparse. None: the nearest views with an unobstructed line to the point.
    colors: (n, 3), integers from 0 to 255 or floats from 0 to 1. normals: (n, 3). errors_px: (n,),
        reprojection errors.
    ranges: the views measured the distances of points, as depth maps do, so one view is enough.
    dense: the points are a dense cloud. They are merged where images do not resolve them.
    Raises UsageError with the index if a number does not fit its array.
    """
    positions = numbers("positions", positions, np.float64, finite=False)
    if positions.ndim != 2 or positions.shape[1] != 3:
        raise UsageError(f"positions must be an array of shape (n, 3), not {positions.shape}")
    scene = Scene.empty(len(positions))
    fill("positions", scene.positions, positions, finite=False)
    fill("colors", scene.colors, colors)
    fill("errors_px", scene.errors_px, errors_px, finite=False)
    if normals is not None:
        checked = np.empty(positions.shape, dtype=np.float32)
        fill("normals", checked, normals)
        scene.set_normals(checked)
    scene.is_dense = bool(dense) or scanners is not None
    if scanners is not None:
        others = (tracks, cam_from_world, world_from_cam, centers)
        if any(value is not None for value in others):
            raise UsageError("scanners replace tracks, poses and centers; remove these arguments")
        scene.place_scanners(numbers("scanners", scanners, np.float64).reshape(-1, 3))
        return scene
    rotations, places = _poses(cam_from_world, world_from_cam, centers)
    cameras = _add_cameras(scene, len(places), intrinsics, size, bool(ranges))
    for i, (rotation, place) in enumerate(zip(rotations, places)):
        scene.add_view(int(cameras[i]), str(i), rotation, place)
    if tracks is None:
        scene.take_nearest_views(Listener(progress))
    else:
        scene.set_tracks(*_rows(tracks, len(positions), len(places)))
    return scene
