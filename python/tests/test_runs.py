"""Runs: the same mesh as the program's, options, progress, interruption, errors."""
import logging
import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import vcarve
from vcarve import _options


def test_a_model_gives_the_same_bytes_as_the_program(model, program, tmp_path):
    program("--quiet", "--max-hole", 20, "--crop", "auto", "--attributes", model,
            tmp_path / "program.ply")
    mesh = vcarve.reconstruct(model, max_hole=20, crop="auto", attributes=True)
    mesh.write(tmp_path / "python.ply")
    assert (tmp_path / "python.ply").read_bytes() == (tmp_path / "program.ply").read_bytes()


def test_photographs_give_the_same_file_as_the_program(photographed, program, tmp_path):
    program("--quiet", "--dense", "--dense-size", 160, "--texture", "--up", "z", photographed,
            tmp_path / "program.glb")
    mesh = vcarve.reconstruct(photographed, dense=True, dense_size=160, texture=True, up="z")
    mesh.write(tmp_path / "python.glb")
    assert "fuse" in mesh.counts
    assert (tmp_path / "python.glb").read_bytes() == (tmp_path / "program.glb").read_bytes()


def test_a_texture_has_pages_and_coordinates(photographed):
    mesh = vcarve.reconstruct(photographed, texture=True, texture_scale=0.5)
    pages, page_of_face, coordinates = mesh.texture
    assert page_of_face.shape == (len(mesh.faces),)
    assert coordinates.shape == (len(mesh.faces), 3, 2)
    assert coordinates.min() >= 0 and coordinates.max() <= 1
    assert page_of_face.max() == len(pages) - 1
    assert all(page.dtype == np.uint8 and page.shape[2] == 3 for page in pages)
    again = pickle.loads(pickle.dumps(mesh)).texture
    assert np.array_equal(again.pages[0], pages[0])
    assert np.array_equal(again.coordinates, coordinates)
    assert vcarve.reconstruct(photographed).texture is None


def test_any_mesh_can_be_textured(photographed, program, tmp_path):
    mesh = vcarve.reconstruct(photographed)
    mesh.write(tmp_path / "mesh.ply")
    program("texture", "--quiet", photographed, tmp_path / "mesh.ply", tmp_path / "program.glb")
    vcarve.texture(photographed, mesh).write(tmp_path / "python.glb")
    assert (tmp_path / "python.glb").read_bytes() == (tmp_path / "program.glb").read_bytes()
    of_scene = vcarve.texture(vcarve.read_model(photographed), mesh,
                              images=photographed.parent / "images")
    assert len(of_scene.texture.pages) > 0


def test_a_scene_needs_the_folder_of_its_photographs(photographed):
    scene = vcarve.read_model(photographed)
    with pytest.raises(vcarve.UsageError, match="--images"):
        vcarve.reconstruct(scene, texture=True)
    made = vcarve.reconstruct(scene, texture=True, images=photographed.parent / "images")
    assert made.texture.pages


def test_a_scene_gives_the_mesh_of_its_model(model):
    scene = vcarve.read_model(str(model))
    of_scene = vcarve.reconstruct(scene)
    of_model = vcarve.reconstruct(model)
    assert np.array_equal(of_scene.vertices, of_model.vertices)
    assert np.array_equal(of_scene.faces, of_model.faces)


def test_a_consumed_scene_is_empty(room):
    scene = room.scene()
    kept = vcarve.reconstruct(scene)
    consumed = vcarve.reconstruct(scene, consume=True)
    assert np.array_equal(kept.vertices, consumed.vertices)
    assert len(scene.positions) == 0


def test_a_scene_with_arrays_in_use_cannot_be_consumed(room):
    scene = room.scene()
    positions = scene.positions
    with pytest.raises(BufferError, match="in use"):
        vcarve.reconstruct(scene, consume=True)
    assert np.array_equal(positions, room.positions)


@pytest.mark.parametrize("option", _options.DECLARED["reconstruct"], ids=lambda o: o["name"])
def test_every_option_is_a_keyword_that_accepts_its_default(option, room):
    given = {option["name"]: _options.default_of(option)}
    mesh = vcarve.reconstruct(room.scene(), **given)
    assert np.array_equal(mesh.faces, vcarve.reconstruct(room.scene()).faces)


def test_options_are_documented_and_in_the_signature():
    documented = vcarve.reconstruct.__doc__
    for group in ("input", "reconstruct"):
        for option in _options.DECLARED[group]:
            assert option["help"] in documented
            assert option["name"] in vcarve.reconstruct.__signature__.parameters


def test_options_accept_numbers_texts_paths_and_rows(room, tmp_path):
    box = [0.5, 0.5, -0.5, 5.0, 5.0, 5.0]
    cropped = vcarve.reconstruct(room.scene(), crop=box, max_hole=np.int64(20),
                                 denoise=np.float32(1))
    typed = vcarve.reconstruct(room.scene(), crop="0.5,0.5,-0.5,5,5,5", max_hole="20", denoise="1")
    assert np.array_equal(cropped.vertices, typed.vertices)
    assert len(cropped.faces) < len(vcarve.reconstruct(room.scene()).faces)
    polygon = tmp_path / "polygon.txt"
    polygon.write_text("0.5 0.5\n5 0.5\n5 5\n0.5 5\n", encoding="utf-8")
    assert len(vcarve.reconstruct(room.scene(), crop=polygon).faces) > 0


def test_flags_are_true_or_false(room):
    open_, closed = (vcarve.reconstruct(room.scene(), closed=flag) for flag in (False, True))
    assert np.array_equal(open_.faces, vcarve.reconstruct(room.scene()).faces)
    assert len(closed.faces) > len(open_.faces)
    with pytest.raises(vcarve.UsageError, match="--closed takes True or False, not yes"):
        vcarve.reconstruct(room.scene(), closed="yes")


@pytest.mark.parametrize("name, value", [("min_views", 0), ("max_error", "much"),
                                         ("method", "paint"), ("crop", "1,2"), ("max_memory", "2Q"),
                                         ("min_views", True), ("threads", 2.5)])
def test_wrong_values_raise_the_message_of_the_program(name, value, model, refusal, tmp_path):
    with pytest.raises(vcarve.UsageError) as error:
        vcarve.reconstruct(model, **{name: value})
    option = "--" + name.replace("_", "-")
    assert str(error.value) in refusal(option, value, model, tmp_path / "out.ply")


def test_an_unknown_keyword_raises_a_type_error(model):
    with pytest.raises(TypeError, match="unexpected keyword argument 'min_vews'"):
        vcarve.reconstruct(model, min_vews=2)


def test_input_errors_have_the_message_of_the_program(refusal, tmp_path):
    with pytest.raises(vcarve.InputError) as error:
        vcarve.reconstruct(tmp_path)
    assert str(error.value) in refusal(tmp_path, tmp_path / "out.ply")
    assert isinstance(error.value, (vcarve.Error, ValueError))


def test_progress_increases_to_1_in_every_stage(model):
    told = []
    mesh = vcarve.reconstruct(model, progress=lambda stage, share: told.append((stage, share)))
    stages = [stage for stage, share in told if share == 0.0]
    assert stages[0] == "read" and "triangulate" in stages
    for stage in mesh.counts:
        shares = [share for name, share in told if name == stage]
        assert shares == sorted(shares) and shares[-1] == 1.0
    assert mesh.counts["triangulate"]["cells"] > 0


def test_an_exception_of_the_callback_ends_the_run(model):
    def refuse(stage, share):
        if stage == "triangulate":
            raise RuntimeError("enough")
    with pytest.raises(RuntimeError, match="enough"):
        vcarve.reconstruct(model, progress=refuse)


def test_notes_are_logged(caplog, model):
    with caplog.at_level(logging.WARNING, "vcarve"):
        vcarve.reconstruct(model, rays="nearest")
    assert "nearest views" in caplog.text


def test_an_interrupted_run_ends_within_a_second(big_room):
    begun = threading.Event()

    def interrupt():
        begun.wait()
        time.sleep(0.5)
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    sent = []
    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        vcarve.reconstruct(big_room, progress=lambda stage, share: begun.set())
    ended = time.monotonic()
    thread.join()
    assert ended - sent[0] < 1.0


def test_other_threads_continue_during_a_run(big_room):
    counted = [0]
    stop = threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    begun = time.monotonic()
    with pytest.raises(RuntimeError):
        vcarve.reconstruct(big_room, progress=_after(0.5))
    stop.set()
    thread.join()
    assert counted[0] > 20 * (time.monotonic() - begun)


def _after(seconds):
    """Returns a callback that ends a run after this time."""
    begun = time.monotonic()

    def tell(stage, share):
        del stage, share
        if time.monotonic() - begun > seconds:
            raise RuntimeError("long enough")
    return tell


@pytest.fixture(scope="module")
def big_room():
    """A scene that takes many seconds."""
    from conftest import Room
    return Room(300_000).scene()
