#!/usr/bin/python3
"""Writes fixtures/broken, fixtures/broken_dense, fixtures/broken_scans, fixtures/degenerate and
fixtures/formats: small COLMAP models, dense workspaces and laser scans by name.

Usage: tools/make_broken_fixtures.py [FIXTURES]

What each of them is for stands beside it below, and in fixtures/README.md.
"""

import math
import pathlib
import struct
import sys

# Name and number of parameters of COLMAP's camera models; the place in the list is the number.
CAMERA_MODELS = [
    ("SIMPLE_PINHOLE", 3), ("PINHOLE", 4), ("SIMPLE_RADIAL", 4), ("RADIAL", 5), ("OPENCV", 8),
    ("OPENCV_FISHEYE", 8), ("FULL_OPENCV", 12), ("FOV", 5), ("SIMPLE_RADIAL_FISHEYE", 4),
    ("RADIAL_FISHEYE", 5), ("THIN_PRISM_FISHEYE", 12), ("RAD_TAN_THIN_PRISM_FISHEYE", 16),
    ("SIMPLE_DIVISION", 4), ("DIVISION", 5), ("SIMPLE_FISHEYE", 3), ("FISHEYE", 4), ("EUCM", 6),
    ("EQUIRECTANGULAR", 2),
]


# ---- a model as plain lists ----------------------------------------------------------------------

def camera(camera_id, model=1, params=(800.0, 800.0, 320.0, 240.0)):
    return {"id": camera_id, "model": model, "size": (640, 480), "params": list(params)}


def image(image_id, name, camera_id=1, rotation=(1.0, 0.0, 0.0, 0.0), translation=(0.0, 0.0, 0.0),
          points2d=()):
    return {"id": image_id, "name": name, "camera": camera_id, "rotation": rotation,
            "translation": translation, "points2d": list(points2d)}


def point(point_id, position, track, color=(200, 150, 100), error=0.5):
    return {"id": point_id, "position": position, "track": list(track), "color": color,
            "error": error}


def small_model():
    """One camera, two images, two points: what most broken models are made from."""
    cameras = [camera(1)]
    images = [image(1, "a.jpg", points2d=[(320.0, 240.0, 1), (300.0, 240.0, 2)]),
              image(2, "b.jpg", translation=(-1.0, 0.0, 0.0), points2d=[(160.0, 240.0, 1)])]
    points = [point(1, (0.0, 0.0, 5.0), [(1, 0), (2, 0)]), point(2, (-0.125, 0.0, 5.0), [(1, 1)])]
    return cameras, images, points


# ---- writing -------------------------------------------------------------------------------------

def cameras_bin(cameras):
    data = struct.pack("<Q", len(cameras))
    for c in cameras:
        data += struct.pack("<IiQQ", c["id"], c["model"], *c["size"])
        data += struct.pack("<%dd" % len(c["params"]), *c["params"])
    return data


def images_bin(images):
    data = struct.pack("<Q", len(images))
    for i in images:
        data += struct.pack("<I7dI", i["id"], *i["rotation"], *i["translation"], i["camera"])
        data += i["name"].encode() + b"\0" + struct.pack("<Q", len(i["points2d"]))
        for x, y, point_id in i["points2d"]:
            data += struct.pack("<2dq", x, y, point_id)
    return data


def points_bin(points):
    data = struct.pack("<Q", len(points))
    for p in points:
        data += struct.pack("<Q3d3Bd", p["id"], *p["position"], *p["color"], p["error"])
        data += struct.pack("<Q", len(p["track"]))
        for element in p["track"]:
            data += struct.pack("<2I", *element)
    return data


def words(*values):
    return " ".join(repr(v) if isinstance(v, float) else str(v) for v in values)


def cameras_txt(cameras):
    lines = ["# Camera list with one line of data per camera:"]
    for c in cameras:
        lines.append(words(c["id"], CAMERA_MODELS[c["model"]][0], *c["size"], *c["params"]))
    return "\n".join(lines) + "\n"


def images_txt(images):
    lines = ["# Image list with two lines of data per image:"]
    for i in images:
        lines.append(words(i["id"], *i["rotation"], *i["translation"], i["camera"], i["name"]))
        lines.append(" ".join(words(*p) for p in i["points2d"]))
    return "\n".join(lines) + "\n"


def points_txt(points):
    lines = ["# 3D point list with one line of data per point:"]
    for p in points:
        track = [number for element in p["track"] for number in element]
        lines.append(words(p["id"], *p["position"], *p["color"], p["error"], *track))
    return "\n".join(lines) + "\n"


def binary_files(model):
    cameras, images, points = model
    return {"cameras.bin": cameras_bin(cameras), "images.bin": images_bin(images),
            "points3D.bin": points_bin(points)}


def text_files(model):
    cameras, images, points = model
    return {"cameras.txt": cameras_txt(cameras), "images.txt": images_txt(images),
            "points3D.txt": points_txt(points)}


def write_model(folder, files):
    folder.mkdir(parents=True, exist_ok=True)
    for name, data in files.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())


# ---- broken --------------------------------------------------------------------------------------

def patched(data, offset, replacement):
    return data[:offset] + replacement + data[offset + len(replacement):]


def broken_binary():
    """Name -> files; every one must be refused with a sentence of its own."""
    good = binary_files(small_model())
    huge = struct.pack("<Q", 2 ** 60)
    nan = struct.pack("<d", math.nan)
    cameras, images, points = (good[f] for f in ("cameras.bin", "images.bin", "points3D.bin"))
    quaternion = 8 + 4
    name = 8 + 4 + 7 * 8 + 4
    track_length = 8 + 8 + 3 * 8 + 3 + 8
    changes = {
        "bin_camera_count_huge": {"cameras.bin": patched(cameras, 0, huge)},
        "bin_camera_model_99": {"cameras.bin": patched(cameras, 12, struct.pack("<i", 99))},
        "bin_camera_twice": {"cameras.bin": cameras_bin([camera(1), camera(1)])},
        "bin_cameras_truncated": {"cameras.bin": cameras[:-5]},
        "bin_cameras_trailing": {"cameras.bin": cameras + b"abc"},
        "bin_image_count_huge": {"images.bin": patched(images, 0, huge)},
        "bin_image_twice": {"images.bin": images_bin([image(1, "a.jpg"), image(1, "b.jpg")])},
        "bin_image_name_open": {"images.bin": images_bin([image(1, "a" * 9)])[:name + 9]},
        "bin_image_camera_unknown": {"images.bin": images_bin([image(1, "a.jpg", camera_id=7)])},
        "bin_image_rotation_zero": {"images.bin": patched(images, quaternion, bytes(32))},
        "bin_image_rotation_nan": {"images.bin": patched(images, quaternion, nan)},
        "bin_image_translation_nan": {"images.bin": patched(images, quaternion + 32, nan)},
        "bin_images_points2d_huge": {"images.bin": patched(images, name + 6, huge)},
        "bin_images_truncated": {"images.bin": images[:-1]},
        "bin_images_trailing": {"images.bin": images + b"a"},
        "bin_point_count_huge": {"points3D.bin": patched(points, 0, huge)},
        "bin_point_twice": {"points3D.bin": points_bin([point(5, (0.0, 0.0, 5.0), [(1, 0)])] * 2)},
        "bin_points_empty_file": {"points3D.bin": b""},
        "bin_points_track_huge": {"points3D.bin": patched(points, track_length, huge)},
        "bin_points_trailing": {"points3D.bin": points + bytes(4)},
        "bin_points_truncated": {"points3D.bin": points[:-3]},
    }
    models = {broken: {**good, **change} for broken, change in changes.items()}
    models["bin_points_missing"] = {f: good[f] for f in ("cameras.bin", "images.bin")}
    return models


def broken_text():
    good = text_files(small_model())
    first_image = "1 1.0 0.0 0.0 0.0 0.0 0.0 0.0 1 a.jpg\n"
    changes = {
        "txt_camera_params_few": ("cameras.txt", " 240.0\n", "\n"),
        "txt_camera_size_missing": ("cameras.txt", " 480 800.0 800.0 320.0 240.0", ""),
        "txt_camera_width_word": ("cameras.txt", "640", "wide"),
        "txt_image_camera_unknown": ("images.txt", "1 a.jpg", "7 a.jpg"),
        "txt_image_rotation_zero": ("images.txt", "1 1.0 0.0", "1 0.0 0.0"),
        "txt_image_name_missing": ("images.txt", " a.jpg", ""),
        "txt_image_rotation_nan": ("images.txt", "1 1.0 0.0", "1 nan 0.0"),
        "txt_image_id_negative": ("images.txt", "2 1.0", "-2 1.0"),
        "txt_image_twice": ("images.txt", "2 1.0", "1 1.0"),
        "txt_images_points2d_left_out": ("images.txt", "320.0 240.0 1 300.0 240.0 2\n", ""),
        "txt_images_pose_cut": ("images.txt", first_image, "1 1.0 0.0 0.0 0.0 0.0\n"),
        "txt_point_color_300": ("points3D.txt", "200", "300"),
        "txt_point_coordinate_word": ("points3D.txt", "5.0", "5,0"),
        "txt_point_coordinate_1e999": ("points3D.txt", "5.0", "1e999"),
        "txt_point_error_missing": ("points3D.txt", " 0.5 1 0 2 0", ""),
        "txt_point_track_odd": ("points3D.txt", "0.5 1 0 2 0", "0.5 1 0 2"),
        "txt_point_twice": ("points3D.txt", "\n2 ", "\n1 "),
    }
    models = {}
    for broken, (file, old, new) in changes.items():
        assert old in good[file], broken
        models[broken] = {**good, file: good[file].replace(old, new, 1)}
    return models


# ---- dense workspaces ----------------------------------------------------------------------------

# The numbers of PLY by the names they may have in a header.
PLY_NUMBERS = {"uchar": "B", "uint8": "B", "ushort": "H", "int": "i", "float": "f",
               "float32": "f", "double": "d", "float64": "d"}
FUSED_PROPERTIES = ("float x", "float y", "float z", "float nx", "float ny", "float nz",
                    "uchar red", "uchar green", "uchar blue")


def fused_header(encoding, count, properties, before=""):
    return ("ply\nformat %s 1.0\n%selement vertex %d\n%send_header\n"
            % (encoding, before, count, "".join("property %s\n" % p for p in properties))).encode()


def ply_entry(encoding, properties, values):
    """One vertex; the value of a list is a list."""
    numbers = []
    for declared, value in zip(properties, values):
        kinds = declared.split()[:-1]
        if kinds[0] == "list":
            numbers += [(PLY_NUMBERS[kinds[1]], len(value))]
            numbers += [(PLY_NUMBERS[kinds[2]], v) for v in value]
        else:
            numbers.append((PLY_NUMBERS[kinds[0]], value))
    if encoding == "ascii":
        return (" ".join("%.9g" % v for _, v in numbers) + "\n").encode()
    order = "<" if encoding == "binary_little_endian" else ">"
    return struct.pack(order + "".join(k for k, _ in numbers), *[v for _, v in numbers])


def fused_ply(vertices, encoding="binary_little_endian", properties=FUSED_PROPERTIES):
    return fused_header(encoding, len(vertices), properties) + b"".join(
        ply_entry(encoding, properties, vertex) for vertex in vertices)


def fused_vis(tracks):
    return struct.pack("<Q", len(tracks)) + b"".join(
        struct.pack("<%dI" % (len(track) + 1), len(track), *track) for track in tracks)


# What rich_model's views saw, by places in its images.bin; the second names an image twice.
FUSED_VERTICES = [(0.5, 0.25, 4.0, 0.0, 0.0, -1.0, 200, 150, 100),
                  (-0.125, 3.0, 5.0, 0.0, 3.0, -4.0, 0, 128, 255),
                  (1.5, -2.0, 6.0, 0.0, 0.0, 0.0, 1, 2, 3)]
FUSED_TRACKS = [[0, 2], [2, 1, 2], [0]]


def broken_dense():
    """Name -> files; every one must be refused with a sentence of its own."""
    ply = fused_ply(FUSED_VERTICES)
    vis = fused_vis(FUSED_TRACKS)
    header = fused_header("binary_little_endian", 3, FUSED_PROPERTIES)
    ascii_ply = fused_ply(FUSED_VERTICES, "ascii")
    with_list = FUSED_PROPERTIES[:3] + ("list uchar float samples",)
    faces = b"ply\nformat ascii 1.0\nelement face 0\nproperty list uchar int vertex_index\n"
    changes = {
        "ply_ascii_ends": {"fused.ply": ascii_ply[:-20]},
        "ply_ascii_word": {"fused.ply": ascii_ply.replace(b"0.25", b"0,25")},
        "ply_count_huge": {"fused.ply": header.replace(b"x 3", b"x %d" % 10 ** 18)
                                        + ply[len(header):]},
        "ply_empty": {"fused.ply": b""},
        "ply_header_open": {"fused.ply": header.replace(b"end_header\n", b"")},
        "ply_list_long": {"fused.ply": fused_ply([(0.5, 0.25, 4.0, [1.0])] * 3,
                                                 properties=with_list)[:-5] + b"\x09" + bytes(4)},
        "ply_no_vertices": {"fused.ply": faces + b"end_header\n"},
        "ply_no_z": {"fused.ply": fused_ply([v[:2] for v in FUSED_VERTICES],
                                            properties=FUSED_PROPERTIES[:2])},
        "ply_truncated": {"fused.ply": ply[:-5]},
        "vis_count_huge": {"fused.ply.vis": patched(vis, 0, struct.pack("<Q", 2 ** 60))},
        "vis_count_less": {"fused.ply.vis": fused_vis(FUSED_TRACKS[:2])},
        "vis_count_more": {"fused.ply.vis": fused_vis(FUSED_TRACKS + [[0]])},
        "vis_empty": {"fused.ply.vis": b""},
        "vis_image_unknown": {"fused.ply.vis": fused_vis([[0, 2], [2, 3], [0]])},
        "vis_no_points": {"fused.ply.vis": fused_vis([])},
        "vis_track_huge": {"fused.ply.vis": patched(vis, 8, struct.pack("<I", 2 ** 31))},
        "vis_trailing": {"fused.ply.vis": vis + bytes(4)},
        "vis_truncated": {"fused.ply.vis": vis[:-2]},
        "vis_truncated_between": {"fused.ply.vis": vis[:-8]},
    }
    good = dense_files(ply, vis)
    workspaces = {broken: {**good, **change} for broken, change in changes.items()}
    workspaces["no_model"] = {"fused.ply": ply, "fused.ply.vis": vis}
    return workspaces


def dense_files(ply, vis):
    """A workspace as stereo_fusion leaves it, with what is no concern of ours."""
    model = {"sparse/" + name: data for name, data in binary_files(rich_model()).items()}
    return {**model, "fused.ply": ply, "fused.ply.vis": vis, "meshed-poisson.ply": b"not read",
            "stereo/patch-match.cfg": b"not read"}


def dense_formats():
    """The same points in four ways."""
    vis = fused_vis(FUSED_TRACKS)
    doubles = ("double z", "double y", "uchar quality", "float64 x", "list uchar ushort samples",
               "uint8 diffuse_red", "uint8 diffuse_green", "uint8 diffuse_blue",
               "float32 nx", "float32 ny", "float32 nz")
    shuffled = [(z, y, 7, x, list(range(k)), r, g, b, *normal)
                for k, (x, y, z, *normal, r, g, b) in enumerate(FUSED_VERTICES)]
    others = b"element camera 2\nproperty float fx\nproperty list uchar int ids\n"
    big = fused_ply(shuffled, "binary_big_endian", doubles)
    big = big.replace(b"element vertex", others + b"element vertex")
    camera_data = struct.pack(">fB2i", 1.5, 2, 3, 4) + struct.pack(">fB", 2.5, 0)
    return {
        "dense_little": dense_files(fused_ply(FUSED_VERTICES), vis),
        "dense_ascii": dense_files(fused_ply(FUSED_VERTICES, "ascii"), vis),
        "dense_big_lists": dense_files(big.replace(b"end_header\n", b"end_header\n" + camera_data),
                                       vis),
        "dense_bare": dense_files(fused_ply([v[:3] for v in FUSED_VERTICES],
                                            properties=FUSED_PROPERTIES[:3]), vis),
    }


# ---- laser scans ---------------------------------------------------------------------------------

PLACE = ("float x", "float y", "float z")
ORIGIN = ("float x_origin", "float y_origin", "float z_origin")
SCAN = PLACE + ORIGIN
# Two scanners, at (0, 0, 1) and (8, 0, 1); three points of the first, one of the second.
SCAN_VERTICES = [(2.0, 0.5, 1.0, 0.0, 0.0, 1.0), (2.0, -0.5, 1.25, 0.0, 0.0, 1.0),
                 (6.0, 0.5, 0.75, 8.0, 0.0, 1.0), (2.0, 0.0, 3.0, 0.0, 0.0, 1.0)]
PCL_CAMERA = ("float view_px", "float view_py", "float view_pz", "float x_axisx", "int viewportx")
PCL_ENTRY = (0.0, 0.0, 1.0, 1.0, 4)


def with_camera(encoding="binary_little_endian", properties=PCL_CAMERA, entries=(PCL_ENTRY,)):
    """The points of SCAN_VERTICES and where their scanner stood, as PCL writes it behind them."""
    points = fused_ply([v[:3] for v in SCAN_VERTICES], encoding, PLACE)
    declared = ("element camera %d\n" % len(entries)
                + "".join("property %s\n" % p for p in properties)).encode()
    return points.replace(b"end_header\n", declared + b"end_header\n") + b"".join(
        ply_entry(encoding, properties, entry) for entry in entries)


def broken_scans():
    """Name -> file; every one must be refused with a sentence of its own."""
    def at_third(place):
        return fused_ply([(*v[:3], *place) if k == 2 else v
                          for k, v in enumerate(SCAN_VERTICES)], properties=SCAN)
    return {
        "camera_ends": with_camera()[:-6],
        "camera_infinite": with_camera(entries=((0.0, math.inf, 1.0, 1.0, 4),)),
        "camera_twice": with_camera(entries=(PCL_ENTRY, PCL_ENTRY)),
        "camera_x_only": with_camera(properties=("float view_px",), entries=((0.0,),)),
        "origin_infinite": at_third((8.0, 0.0, -math.inf)),
        "origin_nan": at_third((math.nan, 0.0, 1.0)),
        "origin_without_z": fused_ply([v[:5] for v in SCAN_VERTICES], properties=SCAN[:5]),
        "scanner_y_only": fused_ply([v[:4] for v in SCAN_VERTICES],
                                    properties=PLACE + ("float scanner_y",)),
        "vertices_end": fused_ply(SCAN_VERTICES, properties=SCAN)[:-4],
    }


def scan_formats():
    """The same points in several ways, measured by two scanners or by the first alone."""
    words = PLACE + ("double scanner_x", "double scanner_y", "double scanner_z")
    shuffled = ("double z_origin", "list uchar ushort samples", "float x", "double x_origin",
                "float64 z", "double y_origin", "float32 y")
    lists = [(sz, [1] * k, x, sx, z, sy, y)
             for k, (x, y, z, sx, sy, sz) in enumerate(SCAN_VERTICES)]
    before = with_camera("ascii").split(b"end_header\n")
    camera = before[1].splitlines(True)[-1]
    header = before[0].replace(b"element vertex", b"@").split(b"@")
    vertex, declared = header[1].split(b"element camera")
    return {
        "scan_camera": with_camera(),
        "scan_camera_ascii_first": header[0] + b"element camera" + declared + b"element vertex"
                                   + vertex + b"end_header\n" + camera
                                   + before[1][:-len(camera)],
        "scan_camera_big": with_camera("binary_big_endian"),
        "scan_origin": fused_ply(SCAN_VERTICES, properties=SCAN),
        "scan_origin_big_lists": fused_ply(lists, "binary_big_endian", shuffled),
        "scan_scanner_ascii": fused_ply(SCAN_VERTICES, "ascii", words),
    }


# ---- degenerate ----------------------------------------------------------------------------------

def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(x / length for x in a)


def quaternion_of(rows):
    """w, x, y, z of the rotation with these rows, by the largest of the four."""
    (a, b, c), (d, e, f), (g, h, i) = rows
    squares = (a + e + i, a - e - i, e - a - i, i - a - e)
    largest = max(range(4), key=lambda k: squares[k])
    if largest == 0:
        q = (1 + squares[0], h - f, c - g, d - b)
    elif largest == 1:
        q = (h - f, 1 + squares[1], b + d, c + g)
    elif largest == 2:
        q = (c - g, b + d, 1 + squares[2], f + h)
    else:
        q = (d - b, c + g, f + h, 1 + squares[3])
    length = math.sqrt(dot(q, q))
    return tuple(x / length for x in q)


def looking(image_id, center, target):
    """An image at `center` that looks at `target`: z ahead, y down."""
    ahead = unit(tuple(t - c for t, c in zip(target, center)))
    up = (0.0, 0.0, 1.0) if abs(ahead[2]) < 0.9 else (0.0, 1.0, 0.0)
    right = unit(cross(ahead, up))
    rows = (right, cross(ahead, right), ahead)
    translation = tuple(-dot(row, center) for row in rows)
    return image(image_id, "view%d.png" % image_id, rotation=quaternion_of(rows),
                 translation=translation)


def ring(count=4, radius=6.0, height=3.0, target=(0.0, 0.0, 0.0)):
    angles = [2 * math.pi * (k + 0.3) / count for k in range(count)]
    return [looking(k + 1, (target[0] + radius * math.cos(a), target[1] + radius * math.sin(a),
                            target[2] + height), target) for k, a in enumerate(angles)]


def seen_by_all(positions, images):
    return [point(k + 1, p, [(i["id"], k) for i in images]) for k, p in enumerate(positions)]


def cube(half=1.0):
    return [(x * half, y * half, z * half) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]


def model_of(positions, images):
    return [camera(1)], images, seen_by_all(positions, images)


def view_on_point():
    """Image 5 stands exactly on point 1 and sees the other points."""
    corners = cube()
    images = ring() + [image(5, "view5.png", translation=tuple(-x for x in corners[0]))]
    points = seen_by_all(corners, images)
    points[0]["track"] = points[0]["track"][:-1]
    return [camera(1)], images, points


def point_seen_from_where_it_is():
    """As view_on_point, and the point claims to be seen by the image that stands on it."""
    return [camera(1)], *view_on_point()[1:2], seen_by_all(cube(), view_on_point()[1])


def behind_camera():
    """Point 9 is said to be seen by image 1 but lies behind it."""
    images = ring()
    points = seen_by_all(cube(), images)
    angle = 2 * math.pi * 0.3 / 4
    points.append(point(9, (12 * math.cos(angle), 12 * math.sin(angle), 6.0), [(1, 8), (2, 8)]))
    return [camera(1)], images, points


def duplicated_positions():
    """Every corner of a cube twice, each half of the copies with half of the views."""
    images = ring()
    points = seen_by_all(cube() + cube(), images)
    for p in points:
        p["track"] = p["track"][:2] if p["id"] <= 8 else p["track"][1:]
    return [camera(1)], images, points


def degenerate():
    """Name -> model; all can be read, what can be made of them is for the passes to say."""
    views = ring()
    grid = range(4)
    lattice = [(float(x), float(y), float(z)) for x in grid for y in grid for z in grid]
    plane = [(x + 0.25 * (y % 2), float(y), 0.0) for x in grid for y in grid]
    return {
        "no_points": model_of([], views),
        "no_views": ([camera(1)], [], []),
        "one_view": model_of(cube(), views[:1]),
        "three_points": model_of(cube()[:3], views),
        "four_points": model_of([cube()[k] for k in (0, 3, 5, 6)], views),
        "identical_points": model_of([(0.5, 0.5, 0.5)] * 8, views),
        "collinear_points": model_of([(k / 4, k / 2, float(k)) for k in range(8)], views),
        "coplanar_points": model_of(plane, views),
        "duplicated_positions": duplicated_positions(),
        "lattice": model_of(lattice, ring(target=(1.5, 1.5, 1.5), radius=9.0, height=5.0)),
        "nan_position": model_of(cube() + [(math.nan, 0.0, 0.0)], views),
        "infinite_position": model_of(cube() + [(0.0, math.inf, 0.0)], views),
        "huge_position": model_of(cube() + [(1e300, 0.0, 0.0)], views),
        "no_tracks": ([camera(1)], views, [point(k + 1, p, []) for k, p in enumerate(cube())]),
        "view_on_point": view_on_point(),
        "point_seen_from_where_it_is": point_seen_from_where_it_is(),
        "point_behind_camera": behind_camera(),
    }


# ---- formats -------------------------------------------------------------------------------------

def rich_model():
    """Ids with gaps and out of order, odd names, shared cameras, a view twice in a track."""
    cameras = [camera(12, 2, (700.0, 320.5, 240.25, -0.0125)), camera(3)]
    images = [image(40, "left room/IMG 0001.jpg", 12, (0.5, 0.5, -0.5, 0.5), (0.1, -2.5, 3.0),
                    [(1.5, 2.5, 900), (3.25, 4.0, -1)]),
              image(7, "K\u00f6ln \u5bfa 7.png", 3, (2.0, 0.0, 0.0, 0.0), (1.0, 2.0, 3.0)),
              image(100000, "c.jpg", 12, (0.6, 0.0, 0.8, 0.0), (1e-17, 0.0, 5e6),
                    [(10.0, 20.0, -2)])]
    seen_twice_by_7 = [(100000, 0), (7, 3), (40, 0), (7, 4)]
    points = [point(900, (0.1, 1 / 3, -2e-7), seen_twice_by_7, (0, 128, 255)),
              point(2, (1e6 + 0.1, 5e-324, 4.6e6), [(40, 1)], (255, 255, 255), -1.0),
              point(18446744073709551614, (1.0, 2.0, 3.0), [], (1, 2, 3), 0.0)]
    return cameras, images, points


def every_camera_model():
    cameras = [camera(k + 1, k, [100.0 * k + j + 0.5 for j in range(n)])
               for k, (_, n) in enumerate(CAMERA_MODELS)]
    images = [image(k + 1, "%02d.jpg" % k, k + 1, translation=(float(k), 0.0, 0.0))
              for k in range(len(cameras))]
    return cameras, images, [point(1, (0.0, 0.0, 9.0), [(i["id"], 0) for i in images])]


def text_by_hand(files):
    """As an editor on Windows leaves it: byte order mark, CRLF, tabs, plus signs, blank lines and
    comments between, blanks at ends of lines, no line feed at the end of the file."""
    files = dict(files)
    files["cameras.txt"] = "\ufeff" + files["cameras.txt"].replace("640 480", "640\t+480 ")
    points = files["points3D.txt"].replace("\n2 ", "\n\n#\n2  ")
    files["points3D.txt"] = "\n  # a comment\n" + points
    return {name: text.rstrip("\n").replace("\n", "\r\n") for name, text in files.items()}


def formats():
    """Name -> files; rich_* hold one model, cameras_* another."""
    rich = text_files(rich_model())
    strangers = {"rigs.bin": b"not read", "frames.bin": b"not read"}
    unknown = text_files(([camera(1)], [image(1, "a.jpg")], []))
    unknown["cameras.txt"] = "1 MODEL_OF_TOMORROW 640 480 1 2 3 4 5 6 7\n"
    return {
        "rich_bin": {**binary_files(rich_model()), **strangers},
        "rich_txt": rich,
        "rich_txt_by_hand": text_by_hand(rich),
        "cameras_bin": binary_files(every_camera_model()),
        "cameras_txt": text_files(every_camera_model()),
        "camera_unknown_txt": unknown,
    }


def main():
    default = pathlib.Path(__file__).resolve().parent.parent / "fixtures"
    fixtures = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    for name, files in {**broken_binary(), **broken_text()}.items():
        write_model(fixtures / "broken" / name, files)
    for name, files in broken_dense().items():
        write_model(fixtures / "broken_dense" / name, files)
    for name, model in degenerate().items():
        write_model(fixtures / "degenerate" / name, text_files(model))
    for name, ply in broken_scans().items():
        write_model(fixtures / "broken_scans" / name, {"scan.ply": ply})
    scans = {name: {"scan.ply": ply} for name, ply in scan_formats().items()}
    for name, files in {**formats(), **dense_formats(), **scans}.items():
        write_model(fixtures / "formats" / name, files)


if __name__ == "__main__":
    main()
