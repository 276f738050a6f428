"""The camera poses and lenses of the photographs of the desk."""

import math
import typing

import numpy as np

WIDTH, HEIGHT = 640, 480
AIM = np.array([-0.16, 0.1, 0.1])  # the approximate target of all views


class Lens(typing.NamedTuple):
    """COLMAP's OPENCV camera; other models are special cases."""
    camera_id: int
    model: str
    shown: tuple  # the parameters in cameras.txt
    fx: float
    fy: float
    cx: float
    cy: float
    k1: float = 0.0
    k2: float = 0.0
    p1: float = 0.0
    p2: float = 0.0

    def bent(self, x, y):
        """Distorts positions at depth one."""
        r2 = x * x + y * y
        radial = self.k1 * r2 + self.k2 * r2 * r2
        return (x + x * radial + 2 * self.p1 * x * y + self.p2 * (r2 + 2 * x * x),
                y + y * radial + 2 * self.p2 * x * y + self.p1 * (r2 + 2 * y * y))

    def straight(self, pixel_x, pixel_y):
        """The positions at depth one that the lens shows at these pixels."""
        bent_x, bent_y = (pixel_x - self.cx) / self.fx, (pixel_y - self.cy) / self.fy
        x, y = bent_x, bent_y
        for _ in range(30):
            again_x, again_y = self.bent(x, y)
            x, y = x + bent_x - again_x, y + bent_y - again_y
        return x, y


LENSES = {
    1: Lens(1, "PINHOLE", (560, 560, 320, 240), 560, 560, 320, 240),
    2: Lens(2, "SIMPLE_RADIAL", (545, 322, 238, -0.08), 545, 545, 322, 238, -0.08),
    3: Lens(3, "OPENCV", (550, 552, 318.5, 241, -0.085, 0.012, 0.0006, -0.0004),
            550, 552, 318.5, 241, -0.085, 0.012, 0.0006, -0.0004),
}


class View(typing.NamedTuple):
    image_id: int
    name: str
    lens: Lens
    quaternion: tuple
    translation: np.ndarray

    @property
    def rotation(self):
        """From the rounded quaternion in the file, which COLMAP normalizes."""
        w, x, y, z = np.array(self.quaternion) / np.linalg.norm(self.quaternion)
        return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                         [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                         [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])

    @property
    def center(self):
        return -self.rotation.T @ self.translation

    def directions(self, pixel_x, pixel_y):
        """Rays of depth one in the frame of the scene."""
        x, y = self.lens.straight(pixel_x, pixel_y)
        return np.stack([x, y, np.ones_like(x)], axis=-1) @ self.rotation

    def project(self, places):
        """Pixels and depths."""
        local = places @ self.rotation.T + self.translation
        depth = np.where(np.abs(local[:, 2]) < 1e-12, 1e-12, local[:, 2])
        x, y = self.lens.bent(local[:, 0] / depth, local[:, 1] / depth)
        return (self.lens.fx * x + self.lens.cx, self.lens.fy * y + self.lens.cy, local[:, 2])

    def shows(self, places, margin=0.0):
        """Whether the image shows the positions."""
        local = places @ self.rotation.T + self.translation
        # A lens with barrel distortion maps positions far outside back into the image.
        ahead = (local[:, 2] > 0.05) & (np.hypot(local[:, 0], local[:, 1]) < 1.2 * local[:, 2])
        x, y, _ = self.project(places)
        return (ahead & (x > margin) & (y > margin) & (x < WIDTH - margin)
                & (y < HEIGHT - margin))


def quaternion_of(rotation):
    """The quaternion (w, x, y, z) of a rotation by less than half a turn."""
    w = math.sqrt(max(1e-12, 1 + np.trace(rotation))) / 2
    return (w, (rotation[2, 1] - rotation[1, 2]) / (4 * w),
            (rotation[0, 2] - rotation[2, 0]) / (4 * w),
            (rotation[1, 0] - rotation[0, 1]) / (4 * w))


def looking(center, aim, tilt):
    """The rotation of an upright camera with a roll of `tilt`."""
    ahead = (aim - center) / np.linalg.norm(aim - center)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    down = np.cross(ahead, right)
    return np.stack([right * math.cos(tilt) + down * math.sin(tilt),
                     down * math.cos(tilt) - right * math.sin(tilt), ahead])


def arc(chance):
    """Seven views from the eye height of a sitting person, five from that of a standing one."""
    places = [(-14 + 13.5 * k, 20, 1.18) for k in range(7)]
    places += [(-6 + 15.5 * k, 41, 1.25) for k in range(5)]
    views = []
    for image_id, (azimuth, elevation, distance) in enumerate(places, 1):
        jitter = chance.uniform(-1, 1, 7)
        a, e = math.radians(azimuth + 2 * jitter[0]), math.radians(elevation + 2 * jitter[1])
        center = AIM + (distance + 0.06 * jitter[2]) * np.array(
            [math.sin(a) * math.cos(e), -math.cos(a) * math.cos(e), math.sin(e)])
        rotation = looking(center, AIM + 0.04 * jitter[3:6], 0.03 * jitter[6])
        lens = LENSES[1 if image_id % 2 else 2 + image_id // 2 % 2]
        views.append(View(image_id, f"view_{image_id:02}.jpg", lens,
                          tuple(round(q, 9) for q in quaternion_of(rotation)),
                          np.round(-rotation @ center, 9)))
    return views
