"""The pictures of docs/site/how_it_works.md and gallery.md, drawn by the program from fixtures."""
import pathlib
import subprocess
import tempfile

import numpy

STEP_PX = 760
PANEL_PX = 500
VIEW = "view_04.png"

# Corners, and triangles that are counterclockwise from outside.
CUBE = (numpy.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) / 2,
        numpy.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                     [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]))


def rows(path):
    """The words of each line except comments; images.txt has empty lines."""
    return [line.split() for line in path.read_text(encoding="utf-8").splitlines()
            if not line.startswith("#")]


def rotation(w, x, y, z):
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def centers(model):
    """The camera centers by image, except that of the view. Images have two lines: pose and 2D
    points."""
    return {words[0]: -rotation(*map(float, words[1:5])).T @ numpy.array(words[5:8], float)
            for words in rows(model / "images.txt")[::2] if words[9] != VIEW}


def points(model):
    """The positions of points, and the images that saw them."""
    return [(numpy.array(words[1:4], float), words[8::2])
            for words in rows(model / "points3D.txt") if words]


def write_ply(path, solids):
    """Writes solids; each is a pair of corners and triangles."""
    counts = numpy.cumsum([0] + [len(corners) for corners, _ in solids])
    corners = numpy.vstack([corners for corners, _ in solids])
    faces = numpy.vstack([faces + first for (_, faces), first in zip(solids, counts)])
    lines = ["ply", "format ascii 1.0", f"element vertex {len(corners)}", "property double x",
             "property double y", "property double z", f"element face {len(faces)}",
             "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(str, corner)) for corner in corners.tolist()]
    lines += ["3 " + " ".join(map(str, face)) for face in faces.tolist()]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def cube(place, size):
    return CUBE[0] * size + place, CUBE[1]


def rod(begin, end, width):
    """A cube stretched from one position to another."""
    along = end - begin
    side = numpy.cross(along, numpy.eye(3)[numpy.argmin(numpy.abs(along))])
    side *= width / numpy.linalg.norm(side)
    third = numpy.cross(along / numpy.linalg.norm(along), side)
    return CUBE[0] @ numpy.array([along, side, third]) + (begin + end) / 2, CUBE[1]


def draw(build, fixtures, out):
    """Draws all pictures into the folder `out`."""
    def call(program, *words):
        subprocess.run([build / program, *map(str, words)], check=True, stdout=subprocess.DEVNULL)

    scene = fixtures / "scene/sparse/0"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        text = fixtures / "scene/sparse_txt"
        seen = points(text)
        spread = numpy.linalg.norm(numpy.std([place for place, _ in seen], axis=0))
        stands = centers(text)
        write_ply(folder / "points.ply", [cube(place, spread / 100) for place, _ in seen])
        write_ply(folder / "rays.ply", [cube(place, spread / 100) for place, _ in seen] +
                  [rod(place, stands[views[0]], spread / 800)
                   for place, views in seen[::50] if views[0] in stands])
        made = {"labels": ["--closed", "--max-closing", 0], "surface": [],
                "simplified": ["--simplify", 1400]}
        for step, options in made.items():
            call("colmap-vcarve", "--quiet", scene, folder / f"{step}.ply", *options)
        for step in ("points", "rays", *made):
            call("picture_surfaces", out / f"step_{step}.png", STEP_PX, scene, VIEW,
                 folder / f"{step}.ply")
        for fixture, model in (("scene", scene), ("air", fixtures / "air"),
                               ("room", fixtures / "room")):
            call("colmap-vcarve", "--quiet", model, folder / f"{fixture}.ply")
            call("picture_surfaces", out / f"gallery_{fixture}.png", PANEL_PX, model, "auto",
                 folder / f"{fixture}.ply", fixtures / fixture / "truth.ply")
