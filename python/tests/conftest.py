"""Fixtures of the tests, and a room with known walls."""
import os
import pathlib
import subprocess

import numpy as np
import pytest

import vcarve

ROOT = pathlib.Path(os.environ["VCARVE_ROOT"])
PROGRAM = os.environ["VCARVE_PROGRAM"]


@pytest.fixture
def model():
    return ROOT / "fixtures/scene/sparse/0"


@pytest.fixture
def photographed():
    """A model beside its photographs."""
    return ROOT / "fixtures/desk_photos/sparse"


@pytest.fixture
def program():
    """Runs the program. Fails if the program fails."""
    return lambda *words: subprocess.run([PROGRAM, *map(str, words)], check=True)


@pytest.fixture
def refusal():
    """Returns the program's message for a wrong command line."""
    def said(*words):
        run = subprocess.run([PROGRAM, *map(str, words)], check=False, capture_output=True,
                             text=True)
        assert run.returncode != 0
        return run.stderr.strip().removeprefix("colmap-vcarve: ").removesuffix("; see --help")
    return said


class Room:
    """Points on the walls of a box, seen by views inside that see in all directions."""

    def __init__(self, count=2000):
        random = np.random.default_rng(1)
        self.size = np.array([4.0, 3.0, 2.5])
        self.positions = random.uniform(size=(count, 3)) * self.size
        walls = random.integers(0, 3, count)
        ends = random.integers(0, 2, count)
        self.positions[np.arange(count), walls] = ends * self.size[walls]
        self.centers = np.array([[1.0, 1.0, 1.2], [3.0, 1.1, 1.3], [2.9, 2.1, 1.1],
                                 [1.1, 1.9, 1.4]])
        self.tracks = [list(range(len(self.centers)))] * count

    def scene(self, **given):
        return vcarve.Scene.from_arrays(
            self.positions, **{"centers": self.centers, "tracks": self.tracks, **given})


@pytest.fixture
def room():
    return Room()
