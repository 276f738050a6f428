#!/usr/bin/python3
"""Adds gross outliers to a COLMAP text model of PINHOLE cameras: points at random depths along a
ray of a true point, seen by that view and one or two others they fall into the picture of, as a
false match that passed the geometric tests would be.

usage: add_outliers.py IN_FOLDER OUT_FOLDER [SHARE, 0.03 unless given]
"""

import math
import pathlib
import random
import shutil
import sys

DEPTHS = (0.3, 3.0)  # factors of the true depth; uniform in the logarithm


def read_lines(path):
    """Returns the comments and the other lines."""
    lines = path.read_text(encoding="utf-8").splitlines()
    return ([line for line in lines if line.startswith("#")],
            [line for line in lines if not line.startswith("#")])


def rotation(qw, qx, qy, qz):
    return ((1 - 2 * (qy * qy + qz * qz), 2 * (qx * qy - qw * qz), 2 * (qx * qz + qw * qy)),
            (2 * (qx * qy + qw * qz), 1 - 2 * (qx * qx + qz * qz), 2 * (qy * qz - qw * qx)),
            (2 * (qx * qz - qw * qy), 2 * (qy * qz + qw * qx), 1 - 2 * (qx * qx + qy * qy)))


class Image:
    """The pose, camera and keypoints of an image. False keypoints are added to the latter."""

    def __init__(self, head, keypoints, cameras):
        fields = head.split()
        self.head, self.identity, self.keypoints = head, fields[0], keypoints.split()
        self.turn = rotation(*map(float, fields[1:5]))
        self.shift = tuple(map(float, fields[5:8]))
        self.camera = cameras[fields[8]]

    def center(self):
        return tuple(-sum(self.turn[i][k] * self.shift[i] for i in range(3)) for k in range(3))

    def project(self, place):
        """The pixel of a position, or None outside of the image."""
        x, y, z = (sum(row[k] * place[k] for k in range(3)) + shift
                   for row, shift in zip(self.turn, self.shift))
        width, height, fx, fy, cx, cy = self.camera
        if z <= 0:
            return None
        u, v = fx * x / z + cx, fy * y / z + cy
        return (u, v) if 0 <= u < width and 0 <= v < height else None

    def add_keypoint(self, pixel, point):
        """Adds a keypoint and returns its index."""
        self.keypoints += [f"{pixel[0]:.6f}", f"{pixel[1]:.6f}", str(point)]
        return len(self.keypoints) // 3 - 1


def read_cameras(path):
    cameras = {}
    for line in read_lines(path)[1]:
        fields = line.split()
        if fields[1] != "PINHOLE":
            sys.exit(f"add_outliers.py: {path}: expected PINHOLE cameras, found {fields[1]}")
        cameras[fields[0]] = tuple(map(float, fields[2:8]))
    return cameras


def outlier(point, images, dice):
    """A false position on the true point's first ray, and the pixels of the 2 or 3 views in its
    track; None if too few views show it."""
    first = images[point[8]]
    low, high = map(math.log, DEPTHS)
    depth = math.exp(dice.uniform(low, high))
    center = first.center()
    place = tuple(c + depth * (float(p) - c) for c, p in zip(center, point[1:4]))
    near = sorted((image for image in images.values() if image is not first),
                  key=lambda image: math.dist(image.center(), center))[:len(images) // 3]
    dice.shuffle(near)
    pixels = [(image, image.project(place)) for image in [first] + near]
    seen = [(image, pixel) for image, pixel in pixels if pixel][:dice.choice((2, 3))]
    return (place, seen) if len(seen) >= 2 and seen[0][0] is first else None


def add_outliers(points, images, share):
    """Returns the lines of the outliers, and adds their keypoints to the images."""
    dice = random.Random(1)
    next_id = 1 + max(int(point[0]) for point in points)
    lines = []
    wanted = round(share * len(points))
    while len(lines) < wanted:
        point = dice.choice(points)
        found = outlier(point, images, dice)
        if not found:
            continue
        place, seen = found
        identity = next_id + len(lines)
        fields = [identity, *map(repr, place), *point[4:7], f"{dice.uniform(0.3, 1.8):.6f}"]
        for image, pixel in seen:
            fields += [image.identity, image.add_keypoint(pixel, identity)]
        lines.append(" ".join(map(str, fields)))
    return lines


def main(source, target, share):
    target.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source / "cameras.txt", target / "cameras.txt")
    cameras = read_cameras(source / "cameras.txt")
    image_comments, image_lines = read_lines(source / "images.txt")
    images = [Image(*pair, cameras) for pair in zip(image_lines[0::2], image_lines[1::2])]
    comments, lines = read_lines(source / "points3D.txt")
    false_lines = add_outliers([line.split() for line in lines],
                               {image.identity: image for image in images}, share)
    heads = [line for image in images for line in (image.head, " ".join(image.keypoints))]
    for name, text in (("images.txt", image_comments + heads),
                       ("points3D.txt", comments + lines + false_lines)):
        (target / name).write_text("\n".join(text) + "\n", encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]),
         float(sys.argv[3]) if len(sys.argv) == 4 else 0.03)
