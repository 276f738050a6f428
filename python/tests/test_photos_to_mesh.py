"""examples/photos_to_mesh, with a fake COLMAP."""
import os
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(os.environ["VCARVE_ROOT"])
PROGRAM = os.environ["VCARVE_PROGRAM"]

# Each line of $MODELS is a model: "REGISTERED POINTS". If there is none, the mapper fails.
COLMAP = r"""#!/usr/bin/env bash
echo "colmap $1" >>"$CALLS"
[[ "$1" == mapper ]] || { [[ "$1" != "$FAILS" ]] || { echo "a stack trace"; exit 1; }; exit 0; }
[[ -n "$MODELS" ]] || { echo "ERROR: failed to create sparse model"; exit 1; }
out=${!#} i=0
while read -r registered points; do
    mkdir -p "$out/$i"
    printf "\\x$(printf %x "$registered")\0\0\0\0\0\0\0rest" >"$out/$i/images.bin"
    head -c "$points" /dev/zero >"$out/$i/points3D.bin"
    i=$((i + 1))
done <<<"$MODELS"
"""

# The real program reports errors that need no model.
VCARVE = r"""#!/usr/bin/env bash
[[ -d "$1" ]] || exec "$PROGRAM" "$@"
echo "colmap-vcarve $*" >>"$CALLS"
"""


class Script:
    """The script in a folder with photographs and both programs. Records the calls."""

    def __init__(self, folder):
        self.folder = folder
        self.calls = folder / "calls"
        self.programs = folder / "bin"
        self.programs.mkdir()
        for name, text in (("colmap", COLMAP), ("colmap-vcarve", VCARVE)):
            (self.programs / name).write_text(text, encoding="utf-8")
            (self.programs / name).chmod(0o755)
        (folder / "photos/left").mkdir(parents=True)

    def take_photos(self, count):
        for i in range(count):
            (self.folder / f"photos/left/{i}.{('jpg', 'PNG', 'tiff')[i % 3]}").touch()
        (self.folder / "photos/notes.txt").touch()

    def run(self, *words, models="12 100", fails=""):
        run = subprocess.run(
            [ROOT / "examples/photos_to_mesh", *map(str, words)], cwd=self.folder, check=False,
            capture_output=True, text=True,
            env={"PATH": f"{self.programs}:/usr/bin:/bin", "MODELS": models, "FAILS": fails, "CALLS": str(self.calls),
                 "PROGRAM": PROGRAM, "WORK": str(self.folder / "work")})
        made = self.calls.read_text(encoding="utf-8") if self.calls.exists() else ""
        return run.returncode, run.stderr, made.splitlines()


@pytest.fixture
def script(tmp_path):
    return Script(tmp_path)


@pytest.mark.parametrize("end, options", [("glb", "--texture "), ("OBJ", "--texture "),
                                          ("stl", "")])
def test_dense_points_are_meshed_and_textured_if_the_format_has_textures(end, options, script):
    script.take_photos(12)
    code, errors, calls = script.run("photos", f"out.{end}", "--threads", 1)
    assert code == 0 and "registered" not in errors
    assert calls == ["colmap feature_extractor", "colmap exhaustive_matcher", "colmap mapper",
                     f"colmap-vcarve {script.folder}/work/sparse/0 out.{end} --dense "
                     f"--images photos {options}--threads 1"]


@pytest.mark.parametrize("words, sentence", [
    (["out.doc"], "cannot write out.doc: the name of a mesh must end with .ply, .obj"),
    (["none/out.glb"], "cannot write none/out.glb: the folder none does not exist"),
    (["photos"], "cannot write photos"),
    (["out.glb", "--max-hole", "x"], "--max-hole takes a whole number"),
    (["out.glb", "--foo"], "there is no option --foo"),
])
def test_output_and_options_are_checked_before_colmap_runs(words, sentence, script):
    script.take_photos(12)
    code, errors, calls = script.run("photos", *words)
    assert code == 2 and sentence in errors and not calls
    assert len(errors.splitlines()) == 1


@pytest.mark.parametrize("count", [0, 1, 2])
def test_fewer_than_three_photographs_are_rejected_with_a_sentence(count, script):
    script.take_photos(count)
    code, errors, calls = script.run("photos", "out.glb")
    assert code == 3 and not calls
    assert errors == (
        f"photos_to_mesh: photos has {count} photographs (.jpg, .png, .tif, .ppm or .pgm). "
        "A mesh needs at least 3 that overlap; 20 to 60 are better.\n")


def test_photographs_that_do_not_overlap_give_a_remedy_not_a_log(script):
    script.take_photos(3)
    code, errors, _ = script.run("photos", "out.glb", models="")
    assert code == 1 and "COLMAP could not register the photographs. Take more" in errors
    assert "ERROR" not in errors and "failed" not in errors


def test_other_failures_show_the_messages_of_colmap(script):
    script.take_photos(3)
    code, errors, _ = script.run("photos", "out.glb", fails="exhaustive_matcher")
    assert code == 1
    assert errors.endswith("a stack trace\nphotos_to_mesh: colmap exhaustive_matcher failed; its "
                           "messages are above.\n")


def test_unregistered_photographs_of_the_meshed_model_are_counted(script):
    script.take_photos(59)
    code, errors, calls = script.run("photos", "out.glb", models="20 10\n39 200\n5 20")
    assert code == 0 and "/work/sparse/1 out.glb" in calls[-1]
    assert "39 of 59 photographs were registered" in errors and "in small steps" in errors


@pytest.mark.parametrize("missing", ["colmap", "colmap-vcarve"])
def test_both_programs_must_be_on_path(missing, script):
    script.take_photos(3)
    (script.programs / missing).unlink()
    for tool in ("bash", "dirname", "readlink", "sed", "find", "wc", "mktemp", "mkdir", "rm"):
        (script.programs / tool).symlink_to(f"/usr/bin/{tool}")
    copy = script.folder / "photos_to_mesh"
    copy.write_bytes((ROOT / "examples/photos_to_mesh").read_bytes())
    run = subprocess.run([f"{script.programs}/bash", copy, "photos", "out.glb"],
                         cwd=script.folder, check=False, capture_output=True, text=True,
                         env={"PATH": str(script.programs)})
    assert run.returncode == 1
    assert run.stderr.startswith(f"photos_to_mesh: {missing} is not on PATH. On Debian,")


def test_the_usage_names_the_required_programs(script):
    code, errors, _ = script.run()
    assert code == 2 and "Needs colmap and colmap-vcarve on PATH" in errors
