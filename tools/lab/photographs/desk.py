"""The scene: a desk in the corner of a room, made of flat patches for ray casting."""

import functools
import math
import typing

import numpy as np

import paints

FACETS = 24  # number of sides of the tin


class Patch(typing.NamedTuple):
    """A rectangle, or the regular polygon with FACETS sides in it."""
    origin: np.ndarray
    along_u: np.ndarray  # unit vectors; their cross product points out of the body
    along_v: np.ndarray
    size: tuple
    paint: typing.Callable
    start: float = 0.0  # the u of the paint at the beginning of the patch
    polygon: bool = False

    @property
    def normal(self):
        (a, b, c), (d, e, f) = self.along_u, self.along_v
        return np.array([b * f - c * e, c * d - a * f, a * e - b * d])

    def corners(self):
        if not self.polygon:
            u, v = self.along_u * self.size[0], self.along_v * self.size[1]
            return np.array([self.origin, self.origin + u, self.origin + u + v, self.origin + v])
        angles = np.arange(FACETS) * 2 * math.pi / FACETS
        radius = self.size[0] / 2
        return (self.origin + np.outer(radius * (1 + np.cos(angles)), self.along_u)
                + np.outer(radius * (1 + np.sin(angles)), self.along_v))


def box(center, size, turned, front, back, left, right, top, bottom=None):
    """An upright box. `center` is the center of its bottom, about which it is turned by degrees.
    The front faces -y before the turn. Each side is a paint, or None if the side is missing."""
    angle = math.radians(turned)
    x = np.array([math.cos(angle), math.sin(angle), 0.0])
    y = np.array([-math.sin(angle), math.cos(angle), 0.0])
    z = np.array([0.0, 0.0, 1.0])
    (a, b, c), base = size, np.array(center, dtype=float)
    sides = [(front, base - x * a / 2 - y * b / 2, x, z, (a, c)),
             (back, base + x * a / 2 + y * b / 2, -x, z, (a, c)),
             (left, base - x * a / 2 + y * b / 2, -y, z, (b, c)),
             (right, base + x * a / 2 - y * b / 2, y, z, (b, c)),
             (top, base - x * a / 2 - y * b / 2 + z * c, x, y, (a, b)),
             (bottom, base - x * a / 2 + y * b / 2, x, -y, (a, b))]
    return [Patch(origin, u, v, extent, paint) for paint, origin, u, v, extent in sides if paint]


def seeded(paint, seed, **more):
    return functools.partial(paint, seed=seed, **more)


def book(center, size, turned, seed, cloth, print_color):
    """A lying book with its spine in front."""
    a, b, c = size
    flat = {"size": (a, b), "cloth": cloth, "print_color": print_color}
    cut = seeded(paints.pages, seed + 1, size=(0, c), cloth=cloth)
    return box(center, size, turned,
               front=seeded(paints.spine, seed + 2, **{**flat, "size": (a, c)}), back=cut,
               left=cut, right=cut, top=seeded(paints.cover, seed, **flat))


def standing_book(center, size, turned, seed, cloth, print_color):
    """An upright book with its spine in front and its covers left and right."""
    a, b, c = size
    flat = {"size": (b, c), "cloth": cloth, "print_color": print_color}
    upright = seeded(paints.spine, seed + 1, **{**flat, "size": (c, a)})
    across = seeded(paints.pages, seed + 2, size=(0, a), cloth=cloth)
    return box(center, size, turned, front=lambda u, v: upright(v, u),
               back=lambda u, v: across(v, u), left=seeded(paints.cover, seed, **flat),
               right=seeded(paints.cover, seed + 3, **flat), top=lambda u, v: across(v, u))


def painted_tin(center, radius, height, seed):
    """A prism around `center`, the center of its bottom."""
    angles = np.arange(FACETS + 1) * 2 * math.pi / FACETS
    ring = np.array(center) + radius * np.stack(
        [np.cos(angles), np.sin(angles), np.zeros(FACETS + 1)], axis=1)
    width = 2 * radius * math.sin(math.pi / FACETS)
    up = np.array([0.0, 0.0, 1.0])
    sides = [Patch(ring[i], (ring[i + 1] - ring[i]) / width, up, (width, height),
                   seeded(paints.tin, seed), start=i * width) for i in range(FACETS)]
    corner = np.array(center) + np.array([-radius, -radius, height])
    return sides + [Patch(corner, np.array([1.0, 0, 0]), np.array([0, 1.0, 0]),
                          (2 * radius, 2 * radius), seeded(paints.lid, seed + 1), polygon=True)]


def room():
    x, y, z = np.eye(3)
    corner = np.array([-0.95, 0.5, -0.72])
    return [Patch(corner, x, z, (3.4, 2.2), seeded(paints.brick, 100)),
            Patch(corner - 3.0 * y, y, z, (3.0, 2.2), seeded(paints.plaster, 200)),
            Patch(corner - 3.0 * y, x, y, (3.4, 3.0), seeded(paints.tiles, 300))]


def table():
    top, post = seeded(paints.wood, 400), seeded(paints.leg, 450)
    edge = seeded(paints.wood, 470, plank=0.2)
    patches = box((-0.17, 0.06, -0.035), (1.5, 0.84, 0.035), 0, front=edge, back=edge, left=edge,
                  right=edge, top=top, bottom=edge)
    for at_x in (-0.87, 0.53):
        for at_y in (-0.3, 0.42):
            patches += box((at_x, at_y, -0.72), (0.06, 0.06, 0.685), 0, post, post, post, post,
                           None)
    return patches


def things():
    linear = paints.linear
    card = seeded(paints.cardboard, 500)
    patches = box((-0.52, 0.2, 0.0), (0.34, 0.24, 0.21), 14,
                  front=seeded(paints.carton_front, 510), back=card,
                  left=seeded(paints.cardboard, 520), right=seeded(paints.cardboard, 530),
                  top=seeded(paints.carton_top, 540))
    patches += book((-0.02, 0.0, 0.0), (0.25, 0.175, 0.038), -16, 600,
                    linear(134, 52, 48), linear(206, 178, 120))
    patches += book((-0.03, 0.01, 0.038), (0.2, 0.14, 0.03), 12, 620,
                    linear(52, 78, 112), linear(212, 204, 186))
    patches += standing_book((0.02, 0.33, 0.0), (0.05, 0.17, 0.24), 24, 640,
                             linear(72, 96, 64), linear(206, 190, 140))
    patches += painted_tin((0.3, 0.16, 0.0), 0.05, 0.13, 700)
    sheet = seeded(paints.squared_paper, 800)
    rim = seeded(paints.cardboard, 810)
    patches += box((-0.5, -0.13, 0.0), (0.21, 0.297, 0.002), -24, rim, rim, rim, rim, sheet)
    return patches + frame()


def frame():
    """The picture on the plastered wall, 2 cm thick."""
    wall, y, z = -0.95, np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])
    x = np.array([1.0, 0.0, 0.0])
    low, thick = np.array([wall, -0.2, 0.3]), 0.02
    rim = seeded(paints.wood, 911, plank=0.5)
    return [Patch(low + x * thick, y, z, (0.46, 0.34), seeded(paints.picture, 900)),
            Patch(low, x, z, (thick, 0.34), rim), Patch(low + x * thick + y * 0.46, -x, z,
                                                        (thick, 0.34), rim),
            Patch(low + z * 0.34 + x * thick, -x, y, (thick, 0.46), rim),
            Patch(low, x, y, (thick, 0.46), rim)]


def scene():
    return room() + table() + things()


# ---- rays ----------------------------------------------------------------------------------------

def meet(patch, origins, directions):
    """The distance of the patch along each ray (infinity if missed), and the position on it."""
    with np.errstate(divide="ignore", invalid="ignore"):
        normal = patch.normal
        distance = ((patch.origin - origins) @ normal) / (directions @ normal)
        offset = origins - patch.origin
        u = offset @ patch.along_u + distance * (directions @ patch.along_u)
        v = offset @ patch.along_v + distance * (directions @ patch.along_v)
        met = (distance > 1e-9) & (u >= 0) & (v >= 0) & (u <= patch.size[0]) & (v <= patch.size[1])
    if patch.polygon:
        met[met] = in_polygon(u[met], v[met], patch.size[0] / 2)
    return np.where(met, distance, np.inf), u, v


def in_polygon(u, v, radius):
    angle = np.arctan2(v - radius, u - radius)
    wedge = 2 * math.pi / FACETS
    from_middle = angle - (np.floor(angle / wedge) + 0.5) * wedge
    return np.hypot(u - radius, v - radius) * np.cos(from_middle) <= radius * math.cos(wedge / 2)


def blocked(patches, origins, directions, reach):
    """Whether an object is nearer than `reach` along each ray."""
    result = np.zeros(len(directions), dtype=bool)
    for patch in patches:
        open_rays = ~result
        start = origins[open_rays] if origins.ndim == 2 else origins
        end = reach[open_rays] if isinstance(reach, np.ndarray) else reach
        result[open_rays] = meet(patch, start, directions[open_rays])[0] < end
    return result


# ---- light ---------------------------------------------------------------------------------------

SUN = np.array([0.75, -0.38, 0.62]) / np.linalg.norm([0.75, -0.38, 0.62])
SUN_COLOR, SKY_COLOR = np.array([0.98, 0.91, 0.8]), np.array([0.6, 0.64, 0.69])
RAYS = 48  # to the light, and to the sky, from every position


def light_of(patch, patches):
    """The light at a grid of positions on a patch: a window, as a wide cone of directions, and the
    sky, which darkens corners. Independent of the viewing direction."""
    finest = 0.012 if max(patch.size) < 1.6 else 0.05
    counts = [max(2, int(math.ceil(extent / finest)) + 1) for extent in patch.size]
    # Half a millimeter inside the patch, so that adjacent objects do not occlude its whole rim.
    u, v = (np.linspace(5e-4, extent - 5e-4, count) for extent, count in zip(patch.size, counts))
    places = (patch.origin + u[:, None, None] * patch.along_u + v[None, :, None] * patch.along_v
              + 1e-4 * patch.normal).reshape(-1, 3)
    others = [other for other in patches
              if ((other.corners() - patch.origin) @ patch.normal > 1e-4).any()]
    windows, skies = [], []
    for k in range(RAYS):
        share, turn = (k + 0.5) / RAYS, 2.399963 * k
        window = SUN + 0.24 * math.sqrt(share) * _around(SUN, turn)
        windows.append(window / np.linalg.norm(window))
        skies.append(patch.normal * math.sqrt(1 - share)
                     + math.sqrt(share) * _around(patch.normal, turn))
    facing = np.maximum(0.0, np.array(windows) @ patch.normal)
    total = np.outer(_share_free(others, places, np.array(skies), np.ones(RAYS), 0.7), SKY_COLOR)
    if facing.any():
        total += np.outer(_share_free(others, places, np.array(windows), facing, np.inf),
                          SUN_COLOR)
    return (total + 0.04).reshape(counts[0], counts[1], 3)


def _share_free(patches, places, directions, weights, reach):
    """The mean weight of the directions at each position; occluded directions count as 0."""
    origins = np.repeat(places, len(directions), axis=0)
    rays = np.tile(directions, (len(places), 1))
    free = ~blocked(patches, origins, rays, reach)
    return (free.reshape(len(places), -1) * weights).mean(axis=1)


def _around(axis, turn):
    """A unit vector perpendicular to an axis, rotated about it."""
    side = np.cross(axis, [0.0, 0.0, 1.0] if abs(axis[2]) < 0.9 else [1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    return side * math.cos(turn) + np.cross(axis, side) * math.sin(turn)


def between(grid, u, v, size):
    """Interpolates the values of a grid over a patch linearly."""
    s = np.clip(u / size[0], 0, 1) * (grid.shape[0] - 1)
    t = np.clip(v / size[1], 0, 1) * (grid.shape[1] - 1)
    i = np.minimum(s.astype(int), grid.shape[0] - 2)
    j = np.minimum(t.astype(int), grid.shape[1] - 2)
    s, t = (s - i)[:, None], (t - j)[:, None]
    return ((grid[i, j] * (1 - s) + grid[i + 1, j] * s) * (1 - t)
            + (grid[i, j + 1] * (1 - s) + grid[i + 1, j + 1] * s) * t)
