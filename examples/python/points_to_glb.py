"""Makes a GLB from NumPy arrays: points and the cameras that saw them. Writes column.glb."""
import numpy as np

import vcarve

# A column and twelve cameras around it, in arrays like those of your program.
random = np.random.default_rng(1)
turn, height = random.uniform(0.0, 2.0 * np.pi, 4000), random.uniform(0.0, 2.0, 4000)
normals = np.stack([np.cos(turn), np.sin(turn), np.zeros_like(turn)], axis=1)
points = 0.5 * normals + height[:, None] * [0.0, 0.0, 1.0]
around = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
cameras = np.stack([3.0 * np.cos(around), 3.0 * np.sin(around), np.full(12, 1.0)], axis=1)

# A camera sees the points that face it.
to_cameras = cameras[None] - points[:, None]
sees = np.einsum("pcx,px->pc", to_cameras, normals) > 0.3 * np.linalg.norm(to_cameras, axis=2)
tracks = [np.flatnonzero(row) for row in sees]

colors = np.stack([height / 2.0, np.full_like(height, 0.5), 1.0 - height / 2.0], axis=1)
scene = vcarve.Scene.from_arrays(points, centers=cameras, tracks=tracks, colors=colors)


def show(stage, share):
    if share == 1.0:
        print(stage)


mesh = vcarve.reconstruct(scene, progress=show)
mesh.write("column.glb")

# The arrays of the mesh are NumPy arrays without a copy.
radius = np.linalg.norm(mesh.vertices[:, :2], axis=1)
print(f"{len(mesh.faces)} faces, radius {np.median(radius):.3f}")
assert abs(np.median(radius) - 0.5) < 0.01
