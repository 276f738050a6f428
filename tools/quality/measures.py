"""Runs the program and reads the JSON of `compare`, for all scripts that measure meshes."""
import json
import pathlib
import subprocess
import time

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "build/colmap-vcarve"


def last_line(text):
    lines = text.strip().splitlines()
    return lines[-1].removeprefix("colmap-vcarve: ") if lines else "no message"


def run(words, timeout):
    """Returns seconds, and the reason if the run failed or None."""
    start = time.monotonic()
    try:
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True,
                              errors="replace", timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        return timeout, f"timed out after {timeout:g} s"
    seconds = time.monotonic() - start
    return seconds, last_line(done.stderr) if done.returncode else None


def figures_of(mesh):
    """Name -> figure for one mesh of the JSON; None if there is no such figure."""
    size, views, truth = mesh["size"], mesh["views"], mesh.get("truth")
    at = truth["agreement"] if truth else [{"f": None, "precision": None, "recall": None}] * 4
    return {
        "F 0.1 %": at[0]["f"], "F 0.25 %": at[1]["f"], "F 0.5 %": at[2]["f"], "F 1 %": at[3]["f"],
        "P 0.25 %": at[1]["precision"], "R 0.25 %": at[1]["recall"],
        "blocked": truth["blocked"] if truth else None,
        "seen right": truth["seen_right"] if truth else None,
        "torn": truth["torn"] if truth else None, "open": truth["open"] if truth else None,
        "hidden rays": views["hidden_rays"], "missed points": views["missed_points"],
        "unsupported area": views["unsupported_area"],
        "back faces seen": views["back_faces_seen"], "nothing seen": views["nothing_seen"],
        "seen boundary edges": views["seen_boundary_edges"],
        "non-manifold edges": size["nonmanifold_edges"],
        "orientation faults": size["orientation_faults"],
        "vertices": size["vertices"], "faces": size["faces"],
    }


def measure(model, mesh, truth, json_path, program=PROGRAM, timeout=600):
    """Returns the figures of a mesh and None, or None and the reason. `truth` may be None."""
    command = [program, "compare", "--quiet", model, mesh, "--json", json_path]
    failure = run(command + (["--truth", truth] if truth else []), timeout)[1]
    if failure:
        return None, failure
    return figures_of(json.loads(json_path.read_text(encoding="utf-8"))["meshes"][0]), None


def cell(figure):
    if figure is None:
        return "-"
    return str(figure) if isinstance(figure, int) else f"{figure:.4f}"
