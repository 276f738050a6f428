#!/usr/bin/python3
"""Writes fixtures/desk_photos: photographs of a desk in the corner of a room, rendered, and the
model that COLMAP would make of them; fixtures/README.md says more.

Usage: tools/make_photo_fixture.py [FOLDER]
       tools/make_photo_fixture.py --check [FOLDER]   makes it again elsewhere and compares: text
           byte by byte, photographs by their pixels, as encoders differ by a level or two
       tools/make_photo_fixture.py --truth FILE.ply   writes the true surface, and nothing else
"""

import argparse
import filecmp
import multiprocessing
import pathlib
import sys
import tempfile

import numpy as np
import PIL.Image

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tools/lab/photographs"))
import desk  # noqa: E402
import views  # noqa: E402

SAMPLES = 2  # of each pixel, each way
JPEG_QUALITY = 82
POINTS = 2500
KEYPOINT_NOISE = 0.3  # pixels, each way
STEEPEST = 75.0  # degrees off the normal at which a point is still found
NEAREST = 0.008  # metres between two points
PRINT_WEIGHT = 4.0  # how much rather a point lies on things than on the room and the table
SAME_MEAN, SAME_WORST = 0.5, 24  # levels of 255 between two encoders' pixels


# ---- photographs ---------------------------------------------------------------------------------

def window_of(view, patch):
    """The part of the picture that a patch may cover: rows and columns of pixels."""
    corners = patch.corners()
    local = corners @ view.rotation.T + view.translation
    if (local[:, 2] < 0.1).any() or not view.shows(corners, -views.WIDTH).all():
        return slice(0, views.HEIGHT), slice(0, views.WIDTH)
    x, y, _ = view.project(corners)
    margin = 4 + 0.02 * max(np.ptp(x), np.ptp(y))  # edges are bent by the lens
    return (slice(max(0, int(y.min() - margin)), max(0, int(y.max() + margin))),
            slice(max(0, int(x.min() - margin)), max(0, int(x.max() + margin))))


def first_met(view, patches, pixel_x, pixel_y):
    """For each pixel of a grid: the first patch of its ray, -1 for none, and where on it."""
    rays = view.directions(pixel_x, pixel_y)
    nearest = np.full(pixel_x.shape, np.inf)
    first = np.full(pixel_x.shape, -1)
    place = np.zeros(pixel_x.shape + (2,))
    for number, patch in enumerate(patches):
        part = window_of(view, patch)
        distance, u, v = desk.meet(patch, view.center, rays[part])
        nearer = distance < nearest[part]
        nearest[part][nearer] = distance[nearer]
        first[part][nearer] = number
        place[part][nearer] = np.stack([u[nearer], v[nearer]], axis=-1)
    return first, place


def colors_of(patches, lights, first, place):
    """Linear colours of what first_met found: paint times light, Lambert's."""
    colors = np.zeros(first.shape + (3,))
    for number in np.unique(first[first >= 0]):
        here, patch = first == number, patches[number]
        u, v = place[here].T
        light = desk.between(lights[number], u, v, patch.size)
        colors[here] = patch.paint(u + patch.start, v) * light
    return colors


def light_on(number):
    patches = desk.scene()
    return desk.light_of(patches[number], patches)


def photograph(view, lights):
    """The picture in levels of 255, each pixel the mean of SAMPLES x SAMPLES rays."""
    patches = desk.scene()
    total = np.zeros((views.HEIGHT, views.WIDTH, 3))
    offsets = (np.arange(SAMPLES) + 0.5) / SAMPLES
    for offset_y in offsets:
        for offset_x in offsets:
            pixel_x, pixel_y = np.meshgrid(np.arange(views.WIDTH) + offset_x,
                                           np.arange(views.HEIGHT) + offset_y)
            total += colors_of(patches, lights, *first_met(view, patches, pixel_x, pixel_y))
    share = np.clip(0.92 * total / SAMPLES ** 2, 0, 1)
    srgb = np.where(share < 0.0031308, 12.92 * share, 1.055 * share ** (1 / 2.4) - 0.055)
    return np.round(255 * srgb).astype(np.uint8)


# ---- points --------------------------------------------------------------------------------------

def box_sum(values, reach):
    """Sums over squares of 2 reach + 1 pixels, with zeros beyond the rim."""
    for axis in (0, 1):
        before = np.cumsum(np.pad(values, [(reach + 1, reach) if a == axis else (0, 0)
                                           for a in (0, 1)]), axis=axis)
        size = 2 * reach + 1
        values = np.take(before, range(size, before.shape[axis]), axis) - np.take(
            before, range(before.shape[axis] - size), axis)
    return values


def corners_of(picture):
    """Rows and columns of pixels where the picture changes in two directions: Shi and Tomasi's
    measure, the three best of every square of 20 pixels. In integers, hence the same anywhere."""
    grey = picture.astype(np.int64) @ np.array([77, 150, 29]) // 256
    change_y, change_x = np.gradient(2 * grey.astype(float))
    xx, yy, xy = (box_sum(np.round(p), 2) for p in (change_x ** 2, change_y ** 2,
                                                    change_x * change_y))
    measure = (xx + yy) / 2 - np.hypot((xx - yy) / 2, xy)
    measure[:8], measure[-8:], measure[:, :8], measure[:, -8:] = 0, 0, 0, 0
    found = []
    for row in range(0, views.HEIGHT, 20):
        for column in range(0, views.WIDTH, 20):
            square = measure[row:row + 20, column:column + 20].copy()
            for _ in range(3):
                y, x = np.unravel_index(np.argmax(square), square.shape)
                if square[y, x] > 500:
                    found.append((row + y, column + x))
                square[max(0, y - 5):y + 6, max(0, x - 5):x + 6] = 0
    return np.array(found)


def candidates(all_views, pictures, patches):
    """Places on the surface that stand out in one of the pictures, the normals there, weights."""
    places, normals, weights = [], [], []
    plain = len(desk.room()) + len(desk.table())
    for view, picture in zip(all_views, pictures):
        pixel_x, pixel_y = np.meshgrid(np.arange(views.WIDTH) + 0.5, np.arange(views.HEIGHT) + 0.5)
        first, place = first_met(view, patches, pixel_x, pixel_y)
        for row, column in corners_of(picture):
            if first[row, column] >= 0:
                patch = patches[first[row, column]]
                u, v = place[row, column]
                places.append(patch.origin + u * patch.along_u + v * patch.along_v)
                normals.append(patch.normal)
                weights.append(PRINT_WEIGHT if first[row, column] >= plain else 1.0)
    return np.array(places), np.array(normals), np.array(weights)


def seen_by(all_views, patches, places, normals):
    """Which view (column) truly sees which place (row)."""
    seen = np.zeros((len(places), len(all_views)), dtype=bool)
    for column, view in enumerate(all_views):
        sights = view.center - places
        lengths = np.linalg.norm(sights, axis=1)
        facing = (sights * normals).sum(axis=1) > lengths * np.cos(np.radians(STEEPEST))
        rows = np.flatnonzero(facing & view.shows(places, margin=2.0))
        start = places[rows] + 1e-6 * normals[rows]
        hidden = desk.blocked(patches, start, view.center - start, 1.0)
        seen[rows[~hidden], column] = True
    return seen


def spread(places, order):
    """Those of order that keep their distance from all chosen before them."""
    chosen = []
    taken = np.zeros((0, 3))
    for row in order:
        if len(chosen) == POINTS:
            break
        if not len(taken) or ((taken - places[row]) ** 2).sum(axis=1).min() > NEAREST ** 2:
            chosen.append(row)
            taken = places[chosen]
    return chosen


class Found:
    """Points as a matcher and a bundle adjustment leave them: keypoints are off by noise, and each
    point lies where it fits its keypoints best."""

    def __init__(self, all_views, places, seen, chance):
        self.seen = seen
        self.keypoints = np.zeros(seen.shape + (2,))
        normal, right = np.zeros((len(places), 3, 3)), np.zeros((len(places), 3))
        for column, view in enumerate(all_views):
            rows = np.flatnonzero(seen[:, column])
            noise = KEYPOINT_NOISE * chance.standard_normal((len(rows), 2))
            exact = np.stack(view.project(places[rows])[:2], axis=1)
            self.keypoints[rows, column] = np.round(exact + noise, 1)
            slope = np.stack([(np.stack(view.project(places[rows] + 1e-5 * axis)[:2], axis=1)
                               - exact) / 1e-5 for axis in np.eye(3)], axis=2)
            normal[rows] += np.einsum("nki,nkj->nij", slope, slope)
            right[rows] += np.einsum("nki,nk->ni", slope, self.keypoints[rows, column] - exact)
        self.places = np.round(places + np.linalg.solve(normal, right[..., None])[..., 0], 6)
        self.errors = self._errors(all_views)

    def _errors(self, all_views):
        total = np.zeros(len(self.places))
        for column, view in enumerate(all_views):
            rows = np.flatnonzero(self.seen[:, column])
            x, y, _ = view.project(self.places[rows])
            total[rows] += np.hypot(x - self.keypoints[rows, column, 0],
                                    y - self.keypoints[rows, column, 1])
        return total / self.seen.sum(axis=1)

    def colors(self, pictures):
        """The mean of the pixels that hold a point's keypoints."""
        total = np.zeros((len(self.places), 3))
        for column, picture in enumerate(pictures):
            rows = np.flatnonzero(self.seen[:, column])
            at = np.floor(self.keypoints[rows, column]).astype(int)
            total[rows] += picture[np.clip(at[:, 1], 0, views.HEIGHT - 1),
                                   np.clip(at[:, 0], 0, views.WIDTH - 1)]
        return np.round(total / self.seen.sum(axis=1)[:, None]).astype(int)


def find_points(all_views, pictures, patches, chance):
    places, normals, weights = candidates(all_views, pictures, patches)
    seen = seen_by(all_views, patches, places, normals)
    turn = np.argsort(chance.standard_exponential(len(places)) / weights, kind="stable")
    order = [row for row in turn if seen[row].sum() >= 3]
    chosen = spread(places, order)
    return Found(all_views, places[chosen], seen[chosen], chance)


# ---- files ---------------------------------------------------------------------------------------

def write_model(folder, all_views, found, colors):
    folder.mkdir(parents=True, exist_ok=True)
    cameras = ["# Camera list with one line of data per camera:",
               "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]"]
    for lens in views.LENSES.values():
        cameras.append(f"{lens.camera_id} {lens.model} {views.WIDTH} {views.HEIGHT} "
                       + " ".join(f"{value:g}" for value in lens.shown))
    images = ["# Image list with two lines of data per image:",
              "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME",
              "#   POINTS2D[] as (X, Y, POINT3D_ID)"]
    tracks = [[] for _ in found.places]
    for column, view in enumerate(all_views):
        pose = " ".join(f"{value:.9f}" for value in (*view.quaternion, *view.translation))
        images.append(f"{view.image_id} {pose} {view.lens.camera_id} {view.name}")
        rows = np.flatnonzero(found.seen[:, column])
        images.append(" ".join("%.1f %.1f %d" % (*found.keypoints[row, column], row + 1)
                               for row in rows))
        for index, row in enumerate(rows):
            tracks[row].append(f"{view.image_id} {index}")
    points = ["# 3D point list with one line of data per point:",
              "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)"]
    for row, (place, color, error) in enumerate(zip(found.places, colors, found.errors)):
        points.append("%d %.6f %.6f %.6f %d %d %d %.3f %s" % (row + 1, *place, *color, error,
                                                             " ".join(tracks[row])))
    for name, lines in (("cameras", cameras), ("images", images), ("points3D", points)):
        (folder / f"{name}.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")


def write_truth(path, patches):
    vertices, faces = [], []
    for patch in patches:
        corners = patch.corners()
        faces.append([len(corners), *range(len(vertices), len(vertices) + len(corners))])
        vertices += list(corners)
    header = ["ply", "format ascii 1.0", "comment the true surface of the desk, in metres",
              f"element vertex {len(vertices)}", "property double x", "property double y",
              "property double z", f"element face {len(faces)}",
              "property list uchar int vertex_indices", "end_header"]
    lines = ["%.6f %.6f %.6f" % tuple(np.round(vertex, 6) + 0.0) for vertex in vertices]
    lines += [" ".join(map(str, face)) for face in faces]
    path.write_text("\n".join(header + lines) + "\n", encoding="utf-8")


def make(folder):
    patches = desk.scene()
    chance = np.random.RandomState(44)  # its numbers are the same for every release of NumPy
    all_views = views.arc(chance)
    with multiprocessing.Pool() as pool:
        lights = pool.map(light_on, range(len(patches)), chunksize=1)
        pictures = pool.starmap(photograph, [(view, lights) for view in all_views], chunksize=1)
    (folder / "images").mkdir(parents=True, exist_ok=True)
    for view, picture in zip(all_views, pictures):
        PIL.Image.fromarray(picture).save(folder / "images" / view.name, quality=JPEG_QUALITY,
                                          optimize=True)
    found = find_points(all_views, pictures, patches, chance)
    write_model(folder / "sparse", all_views, found, found.colors(pictures))
    return f"{len(all_views)} photographs, {len(found.places)} points, {found.seen.sum()} sights"


def difference(name, one, other):
    """What is different between two files, or nothing."""
    if not other.is_file():
        return f"{name} is missing"
    if one.suffix != ".jpg":
        return None if filecmp.cmp(one, other, shallow=False) else f"{name} has other bytes"
    a, b = (np.asarray(PIL.Image.open(path)).astype(int) for path in (one, other))
    if a.shape != b.shape:
        return f"{name} has another size"
    off = np.abs(a - b)
    if off.mean() > SAME_MEAN or off.max() > SAME_WORST:
        return f"{name} is {off.mean():.2f} levels off on average, {off.max()} at worst"
    return None


def check(folder):
    with tempfile.TemporaryDirectory() as again:
        again = pathlib.Path(again)
        make(again)
        made = sorted(p.relative_to(again) for p in again.rglob("*") if p.is_file())
        kept = {p.relative_to(folder) for p in folder.rglob("*") if p.is_file()}
        problems = [f"{name} is not made by this tool" for name in sorted(kept - set(made))]
        problems += filter(None, (difference(name, again / name, folder / name) for name in made))
    for problem in problems:
        print(f"make_photo_fixture: {problem}", file=sys.stderr)
    if problems:
        sys.exit(1)
    print(f"make_photo_fixture: {len(made)} files made again are the same")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--truth", type=pathlib.Path, metavar="FILE")
    parser.add_argument("folder", nargs="?", type=pathlib.Path,
                        default=ROOT / "fixtures/desk_photos")
    arguments = parser.parse_args()
    if arguments.truth:
        write_truth(arguments.truth, desk.scene())
    elif arguments.check:
        check(arguments.folder)
    else:
        print(f"make_photo_fixture: {make(arguments.folder)}")


if __name__ == "__main__":
    main()
