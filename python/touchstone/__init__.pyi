from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from os import PathLike
from typing import Any, Final, Literal, TypeAlias, overload

import numpy
from numpy.typing import ArrayLike, NDArray

__version__: str
PAIRS: tuple[str, ...]

Floats: TypeAlias = NDArray[numpy.float64]

class Cylinder:
    def __init__(self, radius: float, half_length: float, rounding: float = ...) -> None: ...
    radius: Final[float]
    half_length: Final[float]
    rounding: Final[float]

class Plane:
    def __init__(self, normal: ArrayLike, displacement: float) -> None: ...
    normal: Final[Floats]
    displacement: Final[float]

class Sphere:
    def __init__(self, radius: float) -> None: ...
    radius: Final[float]

class Capsule:
    def __init__(self, radius: float, half_length: float) -> None: ...
    radius: Final[float]
    half_length: Final[float]

class Box:
    def __init__(self, half_extents: ArrayLike, rounding: float = ...) -> None: ...
    half_extents: Final[Floats]
    rounding: Final[float]

class Convex:
    def __init__(self, vertices: ArrayLike, rounding: float = ...) -> None: ...
    vertices: Final[Floats]
    rounding: Final[float]

Shape: TypeAlias = Cylinder | Plane | Sphere | Capsule | Box | Convex

class Pose:
    def __init__(self, position: ArrayLike = ..., orientation: ArrayLike = ...,
                 rotation: ArrayLike | None = ..., axis: ArrayLike | None = ...) -> None: ...
    position: Final[Floats]
    orientation: Final[Floats]
    rotation: Final[Floats]

class Point:
    def __init__(self, position: ArrayLike, normal: ArrayLike, depth: float) -> None: ...
    position: Final[Floats]
    normal: Final[Floats]
    depth: Final[float]

class Contact:
    def __init__(self, signed_distance: float, normal: ArrayLike,
                 points: Iterable[Point] = ...) -> None: ...
    signed_distance: Final[float]
    normal: Final[Floats]
    points: Final[tuple[Point, ...]]

class Contacts:
    signed_distances: Final[Floats]
    normals: Final[Floats]
    counts: Final[NDArray[numpy.int32]]
    positions: Final[Floats]
    depths: Final[Floats]
    def __len__(self) -> int: ...

@overload
def overlaps(a: Cylinder, pose_a: Pose, b: Shape, pose_b: Pose) -> bool: ...
@overload
def overlaps(a: Cylinder, pose_a: Pose | Floats, b: Shape,
             pose_b: Pose | Floats) -> NDArray[numpy.bool_]: ...
@overload
def signed_distance(a: Cylinder, pose_a: Pose, b: Shape, pose_b: Pose) -> tuple[float, Floats]: ...
@overload
def signed_distance(a: Cylinder, pose_a: Pose | Floats, b: Shape,
                    pose_b: Pose | Floats) -> tuple[Floats, Floats]: ...
def cast(a: Cylinder, pose_a: Pose | Floats, sweep: ArrayLike, b: Shape,
         pose_b: Pose | Floats) -> tuple[str | list[str], float | Floats, Floats]: ...
@overload
def contact(a: Cylinder, pose_a: Pose, b: Shape, pose_b: Pose,
            threshold: float = 0.0) -> Contact | None: ...
@overload
def contact(a: Cylinder, pose_a: Pose | Floats, b: Shape, pose_b: Pose | Floats,
            threshold: float = 0.0) -> Contacts: ...

class Patch:
    kind: Final[Literal["point", "segment", "region"]]
    area: Final[float]
    perimeter: Final[float]
    centroid: Final[Floats]
    outline: Final[Floats]

class Truth:
    lower: Final[Fraction]
    upper: Final[Fraction]
    signed_distance: Final[float]
    normals: Final[Floats]
    ties: Final[Literal["unique", "finite", "continuum"]]
    patches: Final[tuple[Patch, ...]]

@overload
def truth(a: Cylinder, pose_a: Pose, b: Shape, pose_b: Pose, width: float = 1e-15) -> Truth: ...
@overload
def truth(a: Cylinder, pose_a: Pose | Floats, b: Shape, pose_b: Pose | Floats,
          width: float = 1e-15) -> list[Truth]: ...

class FirstTouch:
    status: Final[Literal["touch", "never", "from-start", "undecided"]]
    lower: Final[Fraction]
    upper: Final[Fraction]
    fraction: Final[float]
    truth: Final[Truth | None]

def first_touch(a: Cylinder, pose_a: Pose, sweep: ArrayLike, b: Shape, pose_b: Pose,
                spin: ArrayLike = (0.0, 0.0, 0.0), width: float = 1e-20) -> FirstTouch: ...

class Configuration:
    def __init__(self, a: Cylinder, pose_a: Pose, b: Shape, pose_b: Pose) -> None: ...
    @staticmethod
    def of(identity: str) -> Configuration: ...
    identity: Final[str]
    description: Final[str]
    pair: Final[str]
    a: Final[Cylinder]
    pose_a: Final[Pose]
    b: Final[Shape]
    pose_b: Final[Pose]

def classes(pair: str) -> dict[str, str]: ...
def configurations(pair: str, classes: Sequence[str] | None = None, seed: int = 1,
                   count: int = 10) -> list[Configuration]: ...

class Score:
    outcome: Final[str]
    reason: Final[str]
    depth_error: Final[float | None]
    normal_regret: Final[float | None]
    whole_regret: Final[float | None]
    normal_angle: Final[float | None]
    deepest_error: Final[float | None]
    point_error: Final[float | None]
    coverage: Final[float | None]
    severity: Final[float]

def score(configuration: Configuration, answer: Contact | None, tolerance: float = 1e-4,
          threshold: float = 0.0) -> Score: ...
def scores(configurations: Sequence[Configuration], answers: Sequence[Contact | None],
           tolerance: float = 1e-4, threshold: float = 0.0) -> list[Score]: ...

class Report:
    def to_dict(self) -> dict[str, Any]: ...
    def save(self, folder: str | PathLike[str]) -> None: ...

def report(function: Callable[[Cylinder, Pose, Shape, Pose, float], Contact | None],
           name: str = "function", pairs: Sequence[str] | None = None,
           classes: Sequence[str] | None = None, groups: Sequence[str] | None = None,
           count: int = 20, seed: int = 1, candidates: Sequence[str] = ("reference",),
           tolerance: float = 1e-4, threshold: float = 0.0, seconds: float = 5.0,
           workers: int = 0, version: str = "",
           settings: str = "a Python function") -> Report: ...
