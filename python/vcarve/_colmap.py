"""Scenes from objects like pycolmap.Reconstruction."""
import numpy as np

from ._arrays import fill
from ._vcarve import Scene, UsageError


def _value(attribute):
    """Some properties of pycolmap are methods in other versions."""
    return attribute() if callable(attribute) else attribute


def _first(thing, *names):
    for name in names:
        if hasattr(thing, name):
            return _value(getattr(thing, name))
    raise UsageError(f"a {type(thing).__name__} has no attribute {' or '.join(names)}")


def _lens(camera):
    model = _first(camera, "model_name", "model")
    return getattr(model, "name", None) or str(model)


def _pose(image):
    """Returns rotation and center of the image's camera. Newer names of pycolmap come first."""
    if hasattr(image, "cam_from_world"):
        pose = _value(image.cam_from_world)
        matrix = np.asarray(_value(pose.matrix), dtype=np.float64)[:3]
        rotation, translation = matrix[:, :3], matrix[:, 3]
    else:
        rotation = np.asarray(_first(image, "rotmat", "qvec2rotmat"), dtype=np.float64)
        translation = np.asarray(image.tvec, dtype=np.float64)
    return rotation, -rotation.T @ translation


def _is_registered(image):
    for name in ("has_pose", "registered"):
        if hasattr(image, name):
            return bool(_value(getattr(image, name)))
    return True


def _add_views(reconstruction, scene):
    """Adds cameras and views in the order of their ids; returns the index of each image."""
    cameras = {}
    for camera_id, camera in sorted(reconstruction.cameras.items()):
        cameras[camera_id] = len(cameras)
        scene.add_camera(_lens(camera), (int(camera.width), int(camera.height)),
                         [float(p) for p in camera.params], False)
    views = {}
    for image_id, image in sorted(reconstruction.images.items()):
        if not _is_registered(image):
            continue
        if image.camera_id not in cameras:
            raise UsageError(f"image {image_id} has camera {image.camera_id}, but the "
                             "reconstruction has no such camera")
        views[image_id] = len(views)
        scene.add_view(cameras[image.camera_id], str(image.name), *_pose(image))
    return views


def from_colmap(reconstruction):
    """Returns the scene of an object with dictionaries cameras, images and points3D, like pycolmap.

    Points are sorted by their ids. Rays of images that are not registered are omitted.
    """
    for name in ("cameras", "images", "points3D"):
        if not hasattr(reconstruction, name):
            raise TypeError("expected a Scene, a path or an object like pycolmap.Reconstruction; "
                            f"found type {type(reconstruction).__name__}, which has no {name}")
    points = sorted(reconstruction.points3D.items())
    scene = Scene.empty(len(points))
    views = _add_views(reconstruction, scene)
    rows = []
    if points:
        fill("positions", scene.positions, [point.xyz for _, point in points], finite=False)
        fill("colors", scene.colors, [_first(point, "color", "rgb") for _, point in points])
        fill("errors_px", scene.errors_px, [point.error for _, point in points], finite=False)
        scene.point_ids[:] = [point_id for point_id, _ in points]
    for _, point in points:
        rows.append([views[e.image_id] for e in point.track.elements if e.image_id in views])
    begins = np.cumsum([0] + [len(row) for row in rows])
    scene.set_tracks(begins, np.array([view for row in rows for view in row], dtype=np.uint32))
    return scene
