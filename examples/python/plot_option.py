"""Plots the quality F of a surface over the values of an option. Needs the truth. Writes f.png."""
import pathlib

import matplotlib.pyplot as plt

import vcarve

scene_folder = pathlib.Path(__file__).resolve().parents[2] / "fixtures/scene"
scene = vcarve.read_model(scene_folder / "sparse/0")
truth = vcarve.read_mesh(scene_folder / "truth.ply")

errors = [0.25, 0.5, 1.0, 2.0, 4.0]
meshes = {str(error): vcarve.reconstruct(scene, max_error=error) for error in errors}
report = vcarve.compare(scene, meshes, truth, samples=20000)

figure, axes = plt.subplots()
for i, within in enumerate(report["meshes"][0]["truth"]["agreement"]):
    f = [mesh["truth"]["agreement"][i]["f"] for mesh in report["meshes"]]
    axes.plot(errors, f, marker="o", label=f"{within['tolerance']:.2%} of the diagonal")
axes.set(xlabel="max_error [px]", ylabel="F", xscale="log")
axes.legend(title="within")
figure.savefig("f.png")
