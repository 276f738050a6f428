#!/usr/bin/python3
"""Makes a COLMAP text model small: drops the keypoints that belong to no point, and rounds the
places of the others in their images to 1/64 px. Poses, cameras, points, colors and errors stay.

usage: slim_model.py IN_FOLDER OUT_FOLDER
"""

import pathlib
import shutil
import sys

NO_POINT = "-1"
STEPS_A_PIXEL = 64


def rounded(coordinate):
    return f"{round(float(coordinate) * STEPS_A_PIXEL) / STEPS_A_PIXEL:.10g}"


def slim_keypoints(line):
    """The line with keypoints of points only, and old index -> new index."""
    fields = line.split()
    kept, new_index = [], {}
    for old, (x, y, point) in enumerate(zip(fields[0::3], fields[1::3], fields[2::3])):
        if point != NO_POINT:
            new_index[str(old)] = str(len(new_index))
            kept += [rounded(x), rounded(y), point]
    return " ".join(kept), new_index


def slim_images(lines):
    """The reduced lines of images.txt, and image id -> (old index -> new index)."""
    result, indices, image = [], {}, None
    for line in lines:
        if line.startswith("#"):
            result.append(line)
        elif image is None:
            image = line.split()[0]
            result.append(line)
        else:
            keypoints, indices[image] = slim_keypoints(line)
            result.append(keypoints)
            image = None
    return result, indices


def renumbered(line, indices):
    """A line of points3D.txt with the new indices in its track."""
    if line.startswith("#"):
        return line
    fields = line.split()
    head, track = fields[:8], fields[8:]
    for image, old in zip(track[0::2], track[1::2]):
        head += [image, indices[image][old]]
    return " ".join(head)


def main(source, target):
    target.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source / "cameras.txt", target / "cameras.txt")
    images, indices = slim_images((source / "images.txt").read_text().splitlines())
    points = (source / "points3D.txt").read_text().splitlines()
    (target / "images.txt").write_text("\n".join(images) + "\n")
    (target / "points3D.txt").write_text("\n".join(renumbered(p, indices) for p in points) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
