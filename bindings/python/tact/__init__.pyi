"""Finds where many deformable triangle meshes touch."""

import os
from typing import Callable, ClassVar, Iterator, Optional, Protocol, Sequence, overload

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]

__version__: str
LARGEST_COORDINATE: float
"""The largest size of a coordinate, metres."""

class Error(RuntimeError):
    """Data that a world cannot take. The world is as it was."""

    code: ErrorCode

class StaleReportError(RuntimeError):
    """A report was asked for something after its world's next detect() or set_settings()."""

class ErrorCode:
    """What is wrong with the data of a call."""

    non_finite_position: ClassVar[ErrorCode]
    position_out_of_range: ClassVar[ErrorCode]
    facet_out_of_range: ClassVar[ErrorCode]
    wrong_size: ClassVar[ErrorCode]
    too_large: ClassVar[ErrorCode]
    stale_body: ClassVar[ErrorCode]
    foreign_body: ClassVar[ErrorCode]
    fixed_body: ClassVar[ErrorCode]
    bad_settings: ClassVar[ErrorCode]
    wrong_order: ClassVar[ErrorCode]
    out_of_memory: ClassVar[ErrorCode]
    backend_failure: ClassVar[ErrorCode]
    bad_recording: ClassVar[ErrorCode]
    wrong_motion: ClassVar[ErrorCode]
    not_a_rotation: ClassVar[ErrorCode]
    invalid_argument: ClassVar[ErrorCode]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class Surface:
    """What a mesh is the surface of."""

    closed: ClassVar[Surface]
    sheet: ClassVar[Surface]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class Motion:
    """Whether a body's positions can be set."""

    deformable: ClassVar[Motion]
    fixed: ClassVar[Motion]
    rigid: ClassVar[Motion]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class Accuracy:
    """What a report promises of its pairs."""

    hulls: ClassVar[Accuracy]
    paper: ClassVar[Accuracy]
    exact: ClassVar[Accuracy]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class DirectionPolicy:
    """Where the contact direction of a pair comes from."""

    carried: ClassVar[DirectionPolicy]
    smallest: ClassVar[DirectionPolicy]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class Containment:
    """Is one of two bodies wholly inside the other?"""

    none: ClassVar[Containment]
    a_in_b: ClassVar[Containment]
    b_in_a: ClassVar[Containment]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class DirectionSource:
    """How a contact direction was found."""

    carried: ClassVar[DirectionSource]
    fresh: ClassVar[DirectionSource]
    smallest: ClassVar[DirectionSource]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class BodyId:
    """Names a body of one world. It is never given out twice."""

    @property
    def index(self) -> int: ...
    @property
    def generation(self) -> int: ...
    def __lt__(self, other: BodyId) -> bool: ...
    def __hash__(self) -> int: ...

class MessageKind:
    """What a message is about."""

    direction_limit: ClassVar[MessageKind]
    gjk_limit: ClassVar[MessageKind]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...

class Message:
    """What a world says while it works. Valid during the call."""

    @property
    def kind(self) -> MessageKind: ...
    @property
    def a(self) -> BodyId:
        """the pair, where it is about one; else no body"""
    @property
    def b(self) -> BodyId: ...
    @property
    def text(self) -> str: ...

class Settings:
    """What a world promises and how much of the machine it uses."""

    threads: int
    accuracy: Accuracy
    direction: DirectionPolicy
    gjk_tolerance: float
    iteration_limit: int
    zones: bool
    patches: bool
    points: bool
    on_message: Optional[Callable[[Message], None]]
    """called by detect() for each limit that it reached; must not use the world"""
    def __init__(
        self,
        *,
        threads: int = 0,
        accuracy: Accuracy = ...,
        direction: DirectionPolicy = ...,
        gjk_tolerance: float = 1e-12,
        iteration_limit: int = 100,
        zones: bool = False,
        patches: bool = False,
        points: bool = False,
        on_message: Optional[Callable[[Message], None]] = None,
    ) -> None: ...

class ZoneDisk:
    """The disk around an impact zone, across the contact direction."""

    @property
    def center(self) -> Floats:
        """(3,), metres"""
    @property
    def radius(self) -> float:
        """metres; negative if there is none"""

class Patch:
    """A connected set of facet pairs and contact points."""

    @property
    def id(self) -> int:
        """lasts from step to step"""
    @property
    def point(self) -> Floats:
        """(3,), metres"""
    @property
    def direction(self) -> Floats:
        """(3,), unit, from a to b"""
    @property
    def depth(self) -> float:
        """metres"""
    @property
    def area(self) -> float:
        """square metres"""
    @property
    def facet_pairs(self) -> Ints:
        """rows of Contact.facet_pairs"""
    @property
    def points(self) -> Ints:
        """rows of Contact.points"""
    @property
    def spanning(self) -> Ints:
        """at most four of the points, the deepest first"""

class PatchEventKind:
    """What became of a patch."""

    began: ClassVar[PatchEventKind]
    split: ClassVar[PatchEventKind]
    merged: ClassVar[PatchEventKind]
    ended: ClassVar[PatchEventKind]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class PatchEvent:
    """What became of a patch in this step."""

    @property
    def a(self) -> BodyId: ...
    @property
    def b(self) -> BodyId: ...
    @property
    def kind(self) -> PatchEventKind: ...
    @property
    def patch(self) -> int:
        """its id"""
    @property
    def other(self) -> int:
        """the patch that it came off, or went into; or 0"""

class FeaturePair:
    """Between which features a contact point lies."""

    vertex_facet: ClassVar[FeaturePair]
    facet_vertex: ClassVar[FeaturePair]
    edge_edge: ClassVar[FeaturePair]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class ContactPoints:
    """Where two surfaces are nearest to each other, a row a point."""

    @property
    def kinds(self) -> npt.NDArray[np.uint8]:
        """(N,): values of FeaturePair"""
    @property
    def patches(self) -> Ints:
        """(N,): points connected by common vertices"""
    @property
    def a_vertices(self) -> Ints:
        """(N, 3): vertices of a; -1 fills up"""
    @property
    def b_vertices(self) -> Ints:
        """(N, 3): vertices of b; -1 fills up"""
    @property
    def a_weights(self) -> Floats:
        """(N, 3): their weights; the sum of a row is 1"""
    @property
    def b_weights(self) -> Floats:
        """(N, 3): their weights; the sum of a row is 1"""
    @property
    def normals(self) -> Floats:
        """(N, 3): unit, from a to b"""
    @property
    def gaps(self) -> Floats:
        """(N,): metres"""
    @property
    def ids(self) -> npt.NDArray[np.uint64]:
        """(N,): the same while these features are near each other"""
    def __len__(self) -> int: ...

class Contact:
    """Two bodies whose convex hulls overlap. Arrays that it gives stay valid."""

    @property
    def a(self) -> BodyId: ...
    @property
    def b(self) -> BodyId: ...
    @property
    def direction(self) -> Floats:
        """(3,), unit, from a to b"""
    @property
    def depth(self) -> float:
        """overlap of the hulls along `direction`, metres"""
    @property
    def containment(self) -> Containment:
        """is one body wholly inside the other, so that no facets meet?"""
    @property
    def source(self) -> DirectionSource: ...
    @property
    def iterations(self) -> int: ...
    @property
    def limit_reached(self) -> bool: ...
    @property
    def plane_a(self) -> float: ...
    @property
    def plane_b(self) -> float: ...
    @property
    def zone_a(self) -> ZoneDisk: ...
    @property
    def zone_b(self) -> ZoneDisk: ...
    @property
    def kept_facets_a(self) -> int: ...
    @property
    def kept_facets_b(self) -> int: ...
    @property
    def facet_pairs(self) -> Ints:
        """(N, 2): the facets that meet, sorted"""
    @property
    def points(self) -> ContactPoints:
        """filled if Settings.points is set"""
    @property
    def touching(self) -> bool:
        """does any facet of a meet one of b?"""
    @property
    def patches(self) -> list[Patch]:
        """filled if Settings.patches is set"""

class Report:
    """What a step found, until the next one. Arrays that it gives stay valid."""

    @property
    def contacts(self) -> list[Contact]:
        """pairs whose hulls overlap, sorted by (a, b)"""
    def find_contact(self, a: BodyId, b: BodyId) -> Optional[Contact]: ...
    @property
    def bodies(self) -> npt.NDArray[np.int64]:
        """(C, 2): BodyId.index of the bodies of each contact"""
    @property
    def directions(self) -> Floats:
        """(C, 3): the direction of each contact"""
    @property
    def depths(self) -> Floats:
        """(C,): the depth of each contact, metres"""
    @property
    def candidate_pairs(self) -> list[tuple[BodyId, BodyId, bool]]:
        """(a, b, hulls_overlap) of the pairs whose boxes overlap"""
    @property
    def began(self) -> list[tuple[BodyId, BodyId]]: ...
    @property
    def ended(self) -> list[tuple[BodyId, BodyId]]: ...
    @property
    def patch_events(self) -> list[PatchEvent]:
        """what became of patches, if Settings.patches is set"""
    @property
    def stats(self) -> dict[str, float]:
        """counts, and times in milliseconds, by name"""
    def hash(self) -> int:
        """a number made from every bit of the answers"""
    def __len__(self) -> int: ...

class Impacts:
    """What detect_motion() looks for. Less is faster."""

    all: ClassVar[Impacts]
    first_of_pair: ClassVar[Impacts]
    first: ClassVar[Impacts]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class MotionReport:
    """What meets between two steps, a row an impact, sorted by bodies and then by time."""

    @property
    def first_time(self) -> float:
        """the earliest time, 0 to 1; inf if nothing meets"""
    @property
    def bodies(self) -> npt.NDArray[np.int64]:
        """(N, 2): BodyId.index of the two bodies"""
    @property
    def kinds(self) -> npt.NDArray[np.uint8]:
        """(N,): values of FeaturePair"""
    @property
    def times(self) -> Floats:
        """(N,): when first, 0 to 1; never late"""
    @property
    def a_vertices(self) -> Ints:
        """(N, 3): vertices of a; -1 fills up"""
    @property
    def b_vertices(self) -> Ints:
        """(N, 3): vertices of b; -1 fills up"""
    @property
    def stats(self) -> dict[str, float]:
        """counts, and times in milliseconds, by name"""
    def __len__(self) -> int: ...

class RayHits:
    """Facets that rays meet, a row a hit."""

    @property
    def bodies(self) -> npt.NDArray[np.int64]:
        """(N,): BodyId.index; -1 where nothing was hit"""
    @property
    def facets(self) -> Ints:
        """(N,); -1 where nothing was hit"""
    @property
    def fractions(self) -> Floats:
        """(N,): from_ + fraction * (to - from_)"""
    @property
    def barycentric(self) -> Floats:
        """(N, 3): of the facet's corners there"""
    def __len__(self) -> int: ...

class ClosestPoints:
    """The nearest places of all surfaces, a row a point."""

    @property
    def bodies(self) -> npt.NDArray[np.int64]:
        """(N,): BodyId.index; -1 where nothing is as near"""
    @property
    def facets(self) -> Ints:
        """(N,); -1 where nothing is as near"""
    @property
    def distances(self) -> Floats:
        """(N,): metres; inf where nothing is as near"""
    @property
    def barycentric(self) -> Floats:
        """(N, 3): of the facet's corners there"""
    def __len__(self) -> int: ...

class PlayedStep:
    """A step that was run again."""

    @property
    def number(self) -> int: ...
    @property
    def byte(self) -> int: ...
    @property
    def recorded(self) -> Optional[int]:
        """hash of the report then; None if the step had no answer"""
    @property
    def now(self) -> int: ...
    @property
    def same(self) -> bool: ...

class RecordingPlayer:
    """Runs a recording again: iterate over its steps."""

    def __init__(self, path: str | os.PathLike[str], *, threads: Optional[int] = None) -> None: ...
    def __iter__(self) -> Iterator[PlayedStep]: ...
    def __next__(self) -> PlayedStep: ...
    @property
    def world(self) -> World: ...
    @property
    def cut_at(self) -> Optional[int]:
        """the byte of the record that is cut off; None if the recording is whole, or not yet played"""
    @property
    def recorded_by(self) -> str: ...

class _DebugDrawer(Protocol):
    def line(self, p: Floats, q: Floats, color: tuple[float, float, float, float]) -> None: ...
    def triangle(self, p: Floats, q: Floats, r: Floats, color: tuple[float, float, float, float]) -> None: ...
    def text(self, at: Floats, words: str, color: tuple[float, float, float, float]) -> None: ...

class DebugColor:
    """Each 0 to 1; alpha 1 covers what is behind."""

    red: float
    green: float
    blue: float
    alpha: float
    def __init__(self, red: float = 0.0, green: float = 0.0, blue: float = 0.0, alpha: float = 1.0) -> None: ...

class DebugDrawOptions:
    """What World.debug_draw() draws, and in which colour: see tact/debug_draw.h."""

    surfaces: bool
    boxes: bool
    candidate_pairs: bool
    directions: bool
    planes: bool
    zones: bool
    kept_facets: bool
    facet_pairs: bool
    patches: bool
    points: bool
    names: bool
    surface: DebugColor
    box: DebugColor
    moved_box: DebugColor
    candidate: DebugColor
    direction: DebugColor
    plane: DebugColor
    zone: DebugColor
    kept: DebugColor
    meeting: DebugColor
    patch: DebugColor
    point: DebugColor
    word: DebugColor
    def __init__(self, **options: bool | DebugColor) -> None: ...

class World:
    """A set of bodies and the contacts among them."""

    def __init__(self, settings: Settings = ...) -> None: ...
    @property
    def settings(self) -> Settings: ...
    def set_settings(self, settings: Settings) -> None: ...
    def add_body(
        self,
        positions: npt.NDArray[np.floating],
        facets: npt.NDArray[np.integer],
        *,
        surface: Surface = ...,
        motion: Motion = ...,
        name: str = "",
        layer: int = 1,
        mask: int = 0xFFFFFFFF,
        margin: float = 0.0,
        self_contact: bool = False,
        group: int = 0,
    ) -> BodyId:
        """positions: (V, 3) in metres; facets: (F, 3), vertices counter-clockwise seen from outside"""
    def remove_body(self, body: BodyId) -> None: ...
    @overload
    def set_positions(self, body: BodyId, positions: npt.NDArray[np.floating]) -> None: ...
    @overload
    def set_positions(self, positions: dict[BodyId, npt.NDArray[np.floating]]) -> None: ...
    def set_pose(self, body: BodyId, rotation: npt.ArrayLike, translation: npt.ArrayLike) -> None:
        """of a rigid body: a vertex that was added at p stands at rotation @ p + translation; (3, 3), and (3,) metres"""
    @overload
    def set_poses(self, poses: dict[BodyId, tuple[npt.ArrayLike, npt.ArrayLike]]) -> None:
        """{body: (rotation, translation)}: all of them or, after an error, none"""
    @overload
    def set_poses(self, bodies: Sequence[BodyId], rotations: npt.ArrayLike, translations: npt.ArrayLike) -> None:
        """the same as arrays: N bodies, (N, 3, 3), and (N, 3) metres"""
    def set_layers(self, body: BodyId, layer: int, mask: int) -> None: ...
    def set_group(self, body: BodyId, group: int) -> None:
        """bodies of one group are not tested against each other; 0: in none"""
    def set_excluded(self, a: BodyId, b: BodyId, excluded: bool) -> None:
        """are the two bodies left out, whatever their layers?"""
    def excluded(self, a: BodyId, b: BodyId) -> bool: ...
    def set_motion(self, body: BodyId, motion: Motion) -> None: ...
    def detect(self) -> Report: ...
    def detect_motion(self, wanted: Impacts = ...) -> MotionReport:
        """what meets between the positions of the last detect() and those set since; it changes nothing"""
    def cast_rays(
        self,
        from_: npt.NDArray[np.floating],
        to: npt.NDArray[np.floating],
        *,
        any: bool = False,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> RayHits:
        """the first facet that each ray meets, or any; (N, 3) both, metres"""
    def cast_ray_all(
        self,
        from_: npt.ArrayLike,
        to: npt.ArrayLike,
        *,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> RayHits:
        """all facets that a ray meets, sorted by time"""
    def closest_points(
        self,
        points: npt.NDArray[np.floating],
        *,
        within: float = ...,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> ClosestPoints:
        """the nearest place of all surfaces to each point; (N, 3), metres"""
    def overlap_box(
        self,
        lower: npt.ArrayLike,
        upper: npt.ArrayLike,
        *,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> npt.NDArray[np.int64]:
        """(N, 2): BodyId.index and facet of what shares a point with the box"""
    def bodies_containing(
        self, point: npt.ArrayLike, *, layer: int = 0xFFFFFFFF, mask: int = 0xFFFFFFFF
    ) -> list[BodyId]:
        """the closed bodies that a point is in"""
    def overlap_boxes(
        self,
        lower: npt.NDArray[np.floating],
        upper: npt.NDArray[np.floating],
        *,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> list[npt.NDArray[np.int64]]:
        """overlap_box() of many boxes, (N, 3) both"""
    def bodies_containing_each(
        self, points: npt.NDArray[np.floating], *, layer: int = 0xFFFFFFFF, mask: int = 0xFFFFFFFF
    ) -> list[list[BodyId]]:
        """bodies_containing() of many points, (N, 3)"""
    def contains(self, body: BodyId) -> bool: ...
    @property
    def body_count(self) -> int: ...
    @property
    def bodies(self) -> list[BodyId]: ...
    def name(self, body: BodyId) -> str: ...
    def surface(self, body: BodyId) -> Surface: ...
    def motion(self, body: BodyId) -> Motion: ...
    def layer(self, body: BodyId) -> int: ...
    def mask(self, body: BodyId) -> int: ...
    def group(self, body: BodyId) -> int: ...
    def margin(self, body: BodyId) -> float:
        """half the body's thickness, metres"""
    def self_contact(self, body: BodyId) -> bool: ...
    def set_margin(self, body: BodyId, margin: float) -> None: ...
    def set_self_contact(self, body: BodyId, wanted: bool) -> None: ...
    def vertex_count(self, body: BodyId) -> int: ...
    def facet_count(self, body: BodyId) -> int: ...
    def positions(self, body: BodyId) -> Floats:
        """a copy, (V, 3) in metres, as they were set last; NaN for a vertex that no facet uses"""
    def facets(self, body: BodyId) -> Ints:
        """a copy, (F, 3), as it was given"""
    def bounds(self, body: BodyId) -> tuple[Floats, Floats]:
        """lower and upper corner of the body's box with its margin, metres"""
    def record(self, path: str | os.PathLike[str]) -> None:
        """writes all that enters the world to a file that `tact replay` runs again; before the first body is added"""
    def stop_recording(self) -> None:
        """closes the file; OSError if it does not hold all"""
    def debug_draw(self, report: Report, drawer: _DebugDrawer, options: DebugDrawOptions = ...) -> None:
        """draws a report of this world"""
    def __len__(self) -> int: ...
