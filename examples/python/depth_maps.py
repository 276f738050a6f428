"""Depth maps in, a collision mesh out: what a network that sees each image once (VGGT, DUSt3R,
Depth Anything) leaves are depths, intrinsics and poses. Here they are made up: a floor and a ball,
seen by eight cameras, with noise. Writes collision.obj, closed and of few faces.
"""
import numpy as np

import vcarve

WIDTH, HEIGHT, FOCAL = 80, 60, 70.0
BALL, RADIUS = np.array([0.0, 0.0, 0.5]), 0.5
random = np.random.default_rng(1)
K = np.array([[FOCAL, 0.0, WIDTH / 2], [0.0, FOCAL, HEIGHT / 2], [0.0, 0.0, 1.0]])


def look_at(center, target):
    """The pose of a camera, world_from_cam: x right, y down, z ahead."""
    ahead = (target - center) / np.linalg.norm(target - center)
    right = np.cross(ahead, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    pose = np.eye(4)
    pose[:3, :3] = np.stack([right, np.cross(ahead, right), ahead], axis=1)
    pose[:3, 3] = center
    return pose


def rays(pose):
    """The directions of all pixels in the world, with length 1 along the camera's axis."""
    u, v = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)
    in_camera = np.stack([u, v, np.ones_like(u)], axis=-1) @ np.linalg.inv(K).T
    return in_camera.reshape(-1, 3) @ pose[:3, :3].T


def depth_map(pose):
    """Simulates the network: the depth of the ball or the floor, with 0.3 % noise."""
    ways, from_ball = rays(pose), pose[:3, 3] - BALL
    a, b = (ways * ways).sum(axis=1), ways @ from_ball
    root = b * b - a * (from_ball @ from_ball - RADIUS**2)
    ball = np.where(root > 0.0, (-b - np.sqrt(np.maximum(root, 0.0))) / a, np.inf)
    floor = np.where(ways[:, 2] < 0.0, -pose[2, 3] / np.minimum(ways[:, 2], -1e-9), np.inf)
    depth = np.minimum(ball, floor)
    depth[depth > 6.0] = np.nan  # unknown
    return depth * (1.0 + 0.003 * random.standard_normal(depth.shape))


turns = np.linspace(0.0, 2.0 * np.pi, 8, endpoint=False)
poses = np.array([look_at(np.array([2.5 * np.cos(t), 2.5 * np.sin(t), 1.5]), BALL) for t in turns])

points, seen_by = [], []
for view, pose in enumerate(poses):
    depths = depth_map(pose)
    known = np.isfinite(depths)
    points.append(pose[:3, 3] + depths[known, None] * rays(pose)[known])
    seen_by.append(np.full(known.sum(), view))
points, seen_by = np.concatenate(points), np.concatenate(seen_by)

scene = vcarve.Scene.from_arrays(points, world_from_cam=poses, intrinsics=K, size=(WIDTH, HEIGHT),
                                 tracks=(np.arange(len(points) + 1), seen_by), ranges=True,
                                 dense=True)
mesh = vcarve.reconstruct(scene, closed=True, simplify=500)
mesh.write("collision.obj")

off_floor = mesh.vertices[mesh.vertices[:, 2] > 0.2]
miss = np.abs(np.linalg.norm(off_floor - BALL, axis=1) - RADIUS)
print(f"{len(points)} points, {len(mesh.faces)} faces, distance to ball {np.median(miss):.3f}")
assert np.median(miss) < 0.05 * RADIUS
