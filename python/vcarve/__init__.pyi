# Written by tools/docs/python_stub from what the library declares.
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Path = str | PathLike[str]
_Numbers = Sequence[float] | NDArray[np.floating[Any]]
_Progress = Callable[[str, float], object]

__version__: str


class Error(Exception): ...


class UsageError(Error, ValueError): ...


class InputError(Error, ValueError): ...


class Scene:
    """Points, views, and the views of each point. The arrays are the library's memory."""
    is_dense: bool
    @property
    def positions(self) -> NDArray[np.float64]: ...
    @property
    def colors(self) -> NDArray[np.uint8]: ...
    @property
    def errors_px(self) -> NDArray[np.float64]: ...
    @property
    def point_ids(self) -> NDArray[np.uint64]: ...
    @property
    def normals(self) -> NDArray[np.float32]: ...
    @property
    def track_begins(self) -> NDArray[np.uint64]: ...
    @property
    def track_views(self) -> NDArray[np.uint32]: ...
    @property
    def centers(self) -> NDArray[np.float64]: ...
    @property
    def names(self) -> list[str]: ...
    @staticmethod
    def empty(points: int, rays: int = 0) -> Scene: ...
    @staticmethod
    def from_arrays(
        positions: ArrayLike, *, cam_from_world: ArrayLike | None = None,
        world_from_cam: ArrayLike | None = None, centers: ArrayLike | None = None,
        scanners: ArrayLike | None = None, intrinsics: ArrayLike | None = None,
        size: ArrayLike | None = None, tracks: Any = None, colors: ArrayLike | None = None,
        normals: ArrayLike | None = None, errors_px: ArrayLike | None = None,
        ranges: bool = False, dense: bool = False, progress: _Progress | None = None,
    ) -> Scene: ...
    @staticmethod
    def from_colmap(reconstruction: Any) -> Scene: ...
    def add_camera(self, lens: str, size_px: tuple[int, int], params: Sequence[float],
                   measures_range: bool) -> int: ...
    def add_view(self, camera: int, name: str, rotation: ArrayLike,
                 center: ArrayLike) -> None: ...
    def set_tracks(self, begins: ArrayLike, views: ArrayLike) -> None: ...
    def set_normals(self, normals: ArrayLike) -> None: ...


class Texture(NamedTuple):
    """Images (height, width, 3), the page of each face, and the places of its corners there."""
    pages: list[NDArray[np.uint8]]
    page_of_face: NDArray[np.uint32]
    coordinates: NDArray[np.float32]


class Mesh:
    """A surface. The arrays are the library's memory; they are empty if unknown.
    Colors are integers from 0 to 255 or floats from 0 to 1."""
    def __init__(self, vertices: ArrayLike, faces: ArrayLike, colors: ArrayLike | None = None,
                 normals: ArrayLike | None = None) -> None: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def faces(self) -> NDArray[np.uint32]: ...
    @property
    def colors(self) -> NDArray[np.uint8]: ...
    @property
    def normals(self) -> NDArray[np.float32]: ...
    @property
    def point_ids(self) -> NDArray[np.int64]: ...
    @property
    def num_views(self) -> NDArray[np.int32]: ...
    @property
    def errors_px(self) -> NDArray[np.float32]: ...
    @property
    def support(self) -> NDArray[np.int32]: ...
    @property
    def texture(self) -> Texture | None: ...
    @property
    def counts(self) -> dict[str, dict[str, int]]: ...
    def write(self, path: _Path, *, ascii: bool = False,
              offset: ArrayLike = ...) -> None: ...


def read_mesh(path: _Path) -> Mesh: ...


def read_model(
    model: _Path, *, progress: _Progress | None = None,
    points: _Path | None = None,
    visibility: _Path | None = None,
    rays: Literal["auto", "file", "nearest"] = "auto",
    scanner: _Numbers | Literal["file"] = "file",
) -> Scene: ...


def reconstruct(
    scene: Scene | _Path | Any, *, attributes: bool = False, consume: bool = False,
    progress: _Progress | None = None,
    points: _Path | None = None,
    visibility: _Path | None = None,
    rays: Literal["auto", "file", "nearest"] = "auto",
    scanner: _Numbers | Literal["file"] = "file",
    dense: bool = False,
    dense_size: int = 640,
    refine_size: int = 1600,
    texture: bool = False,
    texture_scale: float = 1.0,
    images: _Path | None = None,
    masks: _Path | None = None,
    min_views: int = 2,
    max_error: float = 4.0,
    min_angle: float = 1.0,
    stray_spacing: float = 16.0,
    crease_reach: float = 28.0,
    border_gap: float = 3.0,
    textureless_step: float = 2.0,
    merge_px: float = 1.8,
    crop: _Path | _Numbers = "none",
    denoise: float = 2.0,
    method: Literal["cut", "strict"] = "cut",
    min_crossings: int = 1,
    views_sigma: float = 1.5,
    error_sigma: float = 3.0,
    distance_sigma: float = 0.5,
    sink_depth: float = 0.0,
    bundle_rays: int = 5,
    inferred_rays: float = 1.0,
    quality: float = 1.0,
    hull_edge: float = 20.0,
    virtual_views: int = 0,
    virtual_weight: float = 0.5,
    closed: bool = False,
    max_closing: float | Literal["auto"] = "auto",
    rim_closing: float = 2.0,
    half_seen: float = 0.5,
    hardly_seen: float = 0.12,
    trim: float = 0.5,
    beside_edge: float = 3.0,
    beside_length: float = 8.0,
    min_component: int = 6,
    max_hole: int = 12,
    smooth: int = 0,
    simplify: int | Literal["auto"] = "auto",
    threads: int = 0,
    max_memory: int | str | Literal["auto"] = "auto",
    up: _Numbers | Literal["auto", "back", "z", "none"] = "auto",
) -> Mesh: ...


def texture(
    model: Scene | _Path | Any, mesh: Mesh | _Path, *, progress: _Progress | None = None,
    texture_scale: float = 1.0,
    images: _Path | None = None,
    masks: _Path | None = None,
    threads: int = 0,
    max_memory: int | str | Literal["auto"] = "auto",
) -> Mesh: ...


def compare(
    model: Scene | _Path | Any, meshes: Mesh | _Path | Sequence[Mesh | _Path]
    | Mapping[str, Mesh | _Path], truth: Mesh | _Path | None = None, *,
    progress: _Progress | None = None,
    points: _Path | None = None,
    visibility: _Path | None = None,
    rays: Literal["auto", "file", "nearest"] = "auto",
    scanner: _Numbers | Literal["file"] = "file",
    samples: int = 400000,
    seed: int = 1,
    spacings: float = 3.0,
) -> dict[str, Any]: ...
