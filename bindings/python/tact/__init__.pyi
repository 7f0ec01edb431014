"""Finds where many deformable triangle meshes touch."""

import os
from typing import Callable, ClassVar, Iterable, Iterator, Mapping, Optional, Protocol, Sequence, overload

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int32]

__version__: str
LARGEST_COORDINATE: float
"""The largest size of a coordinate, metres."""

class Error(RuntimeError):
    """The exception of every public function. `code` is an ErrorCode. The world is as it was."""

    code: ErrorCode

class StaleReportError(RuntimeError):
    """A report was used after its world's next detect(), set_settings() or restore()."""

class ErrorCode:
    """What was wrong with the data of a call."""

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
    bad_state: ClassVar[ErrorCode]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class Surface:
    """What the facets of a body are."""

    closed: ClassVar[Surface]
    sheet: ClassVar[Surface]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class LabelKind:
    """What has a label."""

    facet: ClassVar[LabelKind]
    vertex: ClassVar[LabelKind]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class Motion:
    """How a body moves."""

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
    """Which of two bodies lies wholly inside the other, so that no facets meet."""

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
    """Names a body of one world. No id is given out twice."""

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
    point_limit: ClassVar[MessageKind]
    open_surface: ClassVar[MessageKind]
    inside_out: ClassVar[MessageKind]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...

class Message:
    """A limit that a step reached, or what is wrong with a body that was added."""

    @property
    def kind(self) -> MessageKind: ...
    @property
    def a(self) -> BodyId:
        """the first body of the pair, or no body"""
    @property
    def b(self) -> BodyId: ...
    @property
    def text(self) -> str: ...

class Settings:
    """How a world works."""

    threads: int
    accuracy: Accuracy
    direction: DirectionPolicy
    gjk_tolerance: float
    iteration_limit: int
    zones: bool
    patches: bool
    points: bool
    curves: bool
    within_reach: bool
    on_message: Optional[Callable[[Message], None]]
    """called for each limit that a step reached, and for each body that was added as closed and is not. The report has limits as flags and counts. The world refuses its calls; what it raises comes out of detect(), after the step"""
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
        curves: bool = False,
        on_message: Optional[Callable[[Message], None]] = None,
        within_reach: bool = False,
    ) -> None: ...

class ZoneDisk:
    """The smallest disk around an impact zone, seen along the contact direction."""

    @property
    def center(self) -> Floats:
        """(3,): metres"""
    @property
    def radius(self) -> float:
        """metres; negative where no zone is computed or it is empty"""

class Patch:
    """A connected set of facet pairs and contact points: a place where two bodies touch or nearly do."""

    @property
    def id(self) -> int:
        """the same in the next step if both share most of their vertices; made from both keys, the step of its beginning and its place"""
    @property
    def point(self) -> Floats:
        """(3,): the middle of its points, or of the boxes that its facet pairs have in common; metres"""
    @property
    def direction(self) -> Floats:
        """(3,): unit vector from a to b: the mean normal of its points, weighted by depth, or of its facets, by area"""
    @property
    def depth(self) -> float:
        """metres: minus the smallest gap of its points, or how far b moves along `direction` to part its facet pairs"""
    @property
    def area(self) -> float:
        """the area of the convex hull of its points, seen along `direction`; square metres"""
    @property
    def facet_pairs(self) -> Ints:
        """indices into Contact.facet_pairs, ascending"""
    @property
    def points(self) -> Ints:
        """indices into Contact.points, ascending"""
    @property
    def spanning(self) -> Ints:
        """at most four of `points`: the deepest, and those that span the most area; kept while they nearly do. -1 fills up"""

class PatchEventKind:
    """What became of the patch."""

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
    """A change of a patch in this step."""

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
        """the id of the other patch, or 0"""

class FeaturePair:
    """The features of bodies a and b that are nearest, or that meet."""

    vertex_facet: ClassVar[FeaturePair]
    facet_vertex: ClassVar[FeaturePair]
    edge_edge: ClassVar[FeaturePair]
    vertex_edge: ClassVar[FeaturePair]
    edge_vertex: ClassVar[FeaturePair]
    vertex_vertex: ClassVar[FeaturePair]
    vertex_plane: ClassVar[FeaturePair]
    plane_vertex: ClassVar[FeaturePair]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class ContactPoints:
    """A point on each of two surfaces, where features are nearest or have crossed. A row a point."""

    @property
    def kinds(self) -> npt.NDArray[np.uint8]:
        """(N,): values of FeaturePair"""
    @property
    def patches(self) -> Ints:
        """(N,): the number of its patch, counted from 0: an index into Contact.patches, if Settings.patches is set"""
    @property
    def a_vertices(self) -> Ints:
        """(N, 3): vertices of the smallest feature of a that holds the point; -1 fills up"""
    @property
    def b_vertices(self) -> Ints:
        """(N, 3): the same of b"""
    @property
    def a_weights(self) -> Floats:
        """(N, 3): weights of the vertices of a, not negative, with a sum of 1"""
    @property
    def b_weights(self) -> Floats:
        """(N, 3): the same of b"""
    @property
    def normals(self) -> Floats:
        """(N, 3): unit vector from the point of a to that of b; the normal of a facet where the two coincide"""
    @property
    def gaps(self) -> Floats:
        """(N,): the distance of the two points along the normal, metres; negative where the surfaces have crossed"""
    @property
    def ids(self) -> npt.NDArray[np.uint64]:
        """(N,): the same in every step in which these features are near: a key for impulses"""
    @property
    def minima(self) -> npt.NDArray[np.bool_]:
        """(N,): whether nothing beside it on either surface is nearer along its normal, which lies in the normal cones of both features"""
    def __len__(self) -> int: ...

class IntersectionCurve:
    """A polyline of points on both surfaces. A row a point."""

    @property
    def closed(self) -> bool:
        """whether the last point leads on to the first"""
    @property
    def positions(self) -> Floats:
        """(N, 3): metres; the exact place, rounded once"""
    @property
    def fractions(self) -> Floats:
        """(N,): how far along the edge, 0 to 1"""
    @property
    def edges(self) -> Ints:
        """(N, 2): the vertices of the edge, ascending. The second is -1 at a common vertex of two facets of one body"""
    @property
    def facets(self) -> Ints:
        """(N,): the facet that the edge goes through; -1 at a common vertex"""
    @property
    def facet_pairs(self) -> Ints:
        """(N,): the facets that hold the way to the next point: an index into Contact.facet_pairs. -1: no way leads on"""
    @property
    def edges_of_b(self) -> npt.NDArray[np.bool_]:
        """(N,): whether the edge is of b, and the facet of a"""
    def __len__(self) -> int: ...

class ReachPairs:
    """A vertex and a facet, or two edges, that are nearer to each other than the sum of the margins. A row a pair."""

    @property
    def kinds(self) -> npt.NDArray[np.uint8]:
        """(N,): values of FeaturePair"""
    @property
    def a_vertices(self) -> Ints:
        """(N, 3): vertices of the feature of a, each once; -1 fills up"""
    @property
    def b_vertices(self) -> Ints:
        """(N, 3): the same of b"""
    @property
    def a_weights(self) -> Floats:
        """(N, 3): weights, with a sum of 1, of the place of a nearest to b; above zero are those of the closest vertex, edge or facet alone"""
    @property
    def b_weights(self) -> Floats:
        """(N, 3): the same of b"""
    @property
    def normals(self) -> Floats:
        """(N, 3): unit vector from the place of a to that of b; zero where the two coincide"""
    @property
    def distances(self) -> Floats:
        """(N,): how far the two places are apart, metres"""
    def __len__(self) -> int: ...

class Contact:
    """Two bodies whose convex hulls overlap or touch, decided exactly, or are nearer than the sum of the margins. Arrays that it gives stay valid."""

    @property
    def a(self) -> BodyId: ...
    @property
    def b(self) -> BodyId: ...
    @property
    def direction(self) -> Floats:
        """(3,): unit vector from a to b: moving b by depth * direction separates the hulls"""
    @property
    def depth(self) -> float:
        """the overlap of the hulls along `direction`, metres; minus their distance where they are apart"""
    @property
    def containment(self) -> Containment:
        """which body lies wholly inside the other, decided exactly; the direction leads out of it"""
    @property
    def source(self) -> DirectionSource: ...
    @property
    def iterations(self) -> int: ...
    @property
    def limit_reached(self) -> bool: ...
    @property
    def point_limit_reached(self) -> bool:
        """whether a sheet crosses itself deeper than its crossing edges are long: vertices there have no point"""
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
        """(N, 2): the facets that meet, sorted; empty at Accuracy.hulls"""
    @property
    def points(self) -> ContactPoints:
        """the points, if Settings.points is set; sorted by kind, then by features"""
    @property
    def within_reach(self) -> ReachPairs:
        """every vertex and facet, and every two edges, nearer than the sum of the margins, if Settings.within_reach is set; sorted by kind, then by features"""
    @property
    def touching(self) -> bool:
        """whether facets meet, or a point's gap is below the sum of the rest offsets"""
    @property
    def patches(self) -> list[Patch]:
        """the patches, if Settings.patches is set; sorted by first facet pair, then by first point"""
    @property
    def curves(self) -> list[IntersectionCurve]:
        """the curves in which the surfaces cross, if Settings.curves is set; sorted by their first facet pair"""
    def hash(self) -> int:
        """a number made from every bit of the contact, its facet pairs, points, pairs within reach and patches, but for counts of work"""

class PointArrays:
    """Arrays for the contact points of a whole report. A row a point."""

    @property
    def bodies(self) -> npt.NDArray[np.int64]:
        """(N, 2): the index of body a and of body b, 2 a point"""
    @property
    def contacts(self) -> Ints:
        """(N,): the number of its contact, counted from 0"""
    @property
    def kinds(self) -> npt.NDArray[np.uint8]:
        """(N,): which features these are, as numbers"""
    @property
    def a_vertices(self) -> Ints:
        """(N, 3): vertices of a, 3 a point; -1 fills up"""
    @property
    def b_vertices(self) -> Ints:
        """(N, 3): vertices of b, 3 a point; -1 fills up"""
    @property
    def a_weights(self) -> Floats:
        """(N, 3): weights of the vertices of a, 3 a point"""
    @property
    def b_weights(self) -> Floats:
        """(N, 3): weights of the vertices of b, 3 a point"""
    @property
    def normals(self) -> Floats:
        """(N, 3): unit vectors from a to b, 3 a point"""
    @property
    def gaps(self) -> Floats:
        """(N,): metres; negative where the surfaces have crossed"""
    @property
    def ids(self) -> npt.NDArray[np.uint64]:
        """(N,): the same in every step in which these features are near"""
    @property
    def patch_ids(self) -> npt.NDArray[np.uint64]:
        """(N,): ids of the patches, or 0 where patches are not requested"""
    @property
    def minima(self) -> npt.NDArray[np.uint8]:
        """(N,): 1 if nothing beside it on either surface is nearer, else 0"""
    def __len__(self) -> int: ...

class PointLabelArrays:
    """Arrays for the labels of what the points of a whole report name; 0 where there is none. A row a point."""

    @property
    def a_facets(self) -> npt.NDArray[np.uint32]:
        """(N,): that of a's facet, or of the first that has the vertex or the edge"""
    @property
    def b_facets(self) -> npt.NDArray[np.uint32]:
        """(N,): the same of b"""
    @property
    def a_vertices(self) -> npt.NDArray[np.uint32]:
        """(N, 3): those of a's vertices, 3 a point"""
    @property
    def b_vertices(self) -> npt.NDArray[np.uint32]:
        """(N, 3): those of b's vertices, 3 a point"""
    def __len__(self) -> int: ...

class ReachPairArrays:
    """Arrays for the pairs within reach of a whole report. A row a pair."""

    @property
    def bodies(self) -> npt.NDArray[np.int64]:
        """(N, 2): the index of body a and of body b, 2 a pair"""
    @property
    def contacts(self) -> Ints:
        """(N,): the number of its contact, counted from 0"""
    @property
    def kinds(self) -> npt.NDArray[np.uint8]:
        """(N,): which features these are, as numbers"""
    @property
    def a_vertices(self) -> Ints:
        """(N, 3): vertices of a, 3 a pair; -1 fills up"""
    @property
    def b_vertices(self) -> Ints:
        """(N, 3): vertices of b, 3 a pair; -1 fills up"""
    @property
    def a_weights(self) -> Floats:
        """(N, 3): weights of the vertices of a, 3 a pair"""
    @property
    def b_weights(self) -> Floats:
        """(N, 3): weights of the vertices of b, 3 a pair"""
    @property
    def normals(self) -> Floats:
        """(N, 3): unit vectors from a to b, 3 a pair; zero where the distance is"""
    @property
    def distances(self) -> Floats:
        """(N,): metres"""
    def __len__(self) -> int: ...

class FacetPairArrays:
    """Arrays for the facet pairs of a whole report. A row a pair."""

    @property
    def bodies(self) -> npt.NDArray[np.int64]:
        """(N, 2): the index of body a and of body b, 2 a pair"""
    @property
    def contacts(self) -> Ints:
        """(N,): the number of its contact, counted from 0"""
    @property
    def facets(self) -> Ints:
        """(N, 2): the facet of a and that of b, 2 a pair"""
    def __len__(self) -> int: ...

class ReachStencils:
    """A pair within reach, and how it depends on its vertices. A row a pair."""

    @property
    def whole(self) -> Stencils:
        """all vertices of both features: what the mollifier of nearly parallel edges depends on"""
    @property
    def closest(self) -> Stencils:
        """those of the closest features alone: what gap and friction depend on"""
    def barriers(
        self,
        positions: npt.NDArray[np.floating],
        reach: float,
        *,
        rest: Optional[npt.NDArray[np.floating]] = None,
        hessians: bool = True,
    ) -> tuple[Floats, Floats, Floats]:
        """the barriers of distances below `reach` metres, terms of `whole`; `rest` (V, 3) for the mollifier. Hessians are positive semidefinite"""
    def __len__(self) -> int: ...

class StencilKind:
    """The features that a stencil joins, in the order of its vertices."""

    point_point: ClassVar[StencilKind]
    point_edge: ClassVar[StencilKind]
    point_facet: ClassVar[StencilKind]
    edge_edge: ClassVar[StencilKind]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class Stencils:
    """The vertices of a contact point and how it depends on them. A row a stencil; of tact/solver.h."""

    @property
    def kinds(self) -> npt.NDArray[np.uint8]:
        """(N,): values of StencilKind"""
    @property
    def vertices(self) -> Ints:
        """(N, 4): rows of the program's system; -1 fills up"""
    @property
    def weights(self) -> Floats:
        """(N, 4): weights of the vertices, those of body a negative: the weighted sum of positions leads from a to b"""
    @property
    def normals(self) -> Floats:
        """(N, 3): unit vector from a to b"""
    @property
    def gaps(self) -> Floats:
        """(N,): metres; negative where the surfaces have crossed"""
    @property
    def ids(self) -> npt.NDArray[np.uint64]:
        """(N,): that of the contact point"""
    def evaluate_gaps(
        self, positions: npt.NDArray[np.floating], *, hessians: bool = True
    ) -> tuple[Floats, Floats, Floats]:
        """the gaps at positions (V, 3): values (N,), gradients (N, 4, 3), Hessians (N, 12, 12), or (0, 12, 12) if they are not wanted"""
    def gap_rates(self, velocities: npt.NDArray[np.floating]) -> Floats:
        """(N,): how fast gaps grow if vertices have such velocities (V, 3); where they are ways, by how much they grow"""
    def barriers(
        self,
        positions: npt.NDArray[np.floating],
        reach: float,
        *,
        rest: Optional[npt.NDArray[np.floating]] = None,
        hessians: bool = True,
    ) -> tuple[Floats, Floats, Floats]:
        """the barriers of gaps below `reach` metres; `rest` (V, 3) for the mollifier of nearly parallel edges. Hessians are positive semidefinite"""
    def penalties(
        self, positions: npt.NDArray[np.floating], reach: float, *, hessians: bool = True
    ) -> tuple[Floats, Floats, Floats]:
        """the penalties of gaps below `reach` metres"""
    def friction(
        self,
        moved: npt.NDArray[np.floating],
        limits: npt.ArrayLike,
        smoothing: float,
        *,
        hessians: bool = True,
    ) -> tuple[Floats, Floats, Floats]:
        """the potentials of friction for the ways `moved` (V, 3) of vertices, of at most `limits` (N,) newtons"""
    def colors(self, moving: int) -> Ints:
        """(N,): stencils of one colour share no vertex below `moving`"""
    def debug_draw(self, positions: npt.ArrayLike, drawer: _DebugDrawer, color: DebugColor | None = None) -> None:
        """draws stencils where `positions` (V, 3) has their vertices: the edges of both features, a line from a to b, and the normal, half as long as the features are wide"""
    def effective_masses(self, inverse_masses: npt.ArrayLike) -> Floats:
        """(N,): the mass that resists a push at the point, kg; infinity if no vertex moves"""
    def add_gradients(self, gradients: Floats, moving: int) -> Floats:
        """(moving, 3): the sum of gradients for each vertex below `moving`"""
    def triplets(self, hessians: Floats, moving: int) -> tuple[Ints, Ints, Floats]:
        """rows, columns and values of Hessians between vertices below `moving`: for scipy.sparse.coo_matrix"""
    def __len__(self) -> int: ...

class Report:
    """What World.detect() found. It is valid until the next step; arrays that it gives stay valid."""

    @property
    def contacts(self) -> list[Contact]:
        """the contacts, sorted by (a, b)"""
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
    def points(self) -> PointArrays:
        """the points of all contacts, in their order"""
    @property
    def facet_pairs(self) -> FacetPairArrays:
        """the facet pairs of all contacts, in their order"""
    @property
    def within_reach(self) -> ReachPairArrays:
        """the pairs within reach of all contacts, in their order"""
    def stencils_within_reach(self, first_rows: dict[BodyId, int]) -> ReachStencils:
        """the stencils of all pairs within reach, if Settings.within_reach is set; `first_rows` as for stencils()"""
    def stencils(self, first_rows: dict[BodyId, int]) -> Stencils:
        """the stencils of all points but those with planes; `first_rows` has the row of each body's first vertex in the program's system"""
    @property
    def candidate_pairs(self) -> list[tuple[BodyId, BodyId, bool]]:
        """the pairs whose boxes overlap, sorted by (a, b)"""
    @property
    def began(self) -> list[tuple[BodyId, BodyId]]: ...
    @property
    def ended(self) -> list[tuple[BodyId, BodyId]]: ...
    @property
    def patch_events(self) -> list[PatchEvent]:
        """the changes of patches, if Settings.patches is set; sorted by (a, b), ends before beginnings"""
    @property
    def stats(self) -> dict[str, float]:
        """counts and times of the step. By name, times in milliseconds"""
    def hash(self) -> int:
        """a number made from every bit of candidate pairs, contacts, facet pairs, points and pairs within reach; bodies enter it by their keys"""
    def keep(self, into: Report | None = None) -> Report:
        """copies a report. The copy stays valid, and any thread may read it while the next step runs. Its memory is that of `into`, an earlier copy, which is stale from then on: two in turns take no memory"""
    def __len__(self) -> int: ...

class Impacts:
    """Which impacts World.detect_motion() finds."""

    all: ClassVar[Impacts]
    first_of_pair: ClassVar[Impacts]
    first: ClassVar[Impacts]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class MotionReport:
    """What World.detect_motion() found. A row an impact, sorted by bodies and then by time."""

    @property
    def first_time(self) -> float:
        """the earliest time of an impact that stops, 0 to 1; infinity if none does"""
    @property
    def bodies(self) -> npt.NDArray[np.int64]:
        """(N, 2): BodyId.index of the two bodies"""
    @property
    def kinds(self) -> npt.NDArray[np.uint8]:
        """(N,): values of FeaturePair"""
    @property
    def times(self) -> Floats:
        """(N,): the part of the way, 0 to 1, at which they first meet; never later than the true time"""
    @property
    def a_vertices(self) -> Ints:
        """(N, 3): vertices of the feature of a; -1 fills up"""
    @property
    def b_vertices(self) -> Ints:
        """(N, 3): vertices of the feature of b; -1 fills up"""
    @property
    def stops(self) -> npt.NDArray[np.bool_]:
        """(N,): false if they touch and part, or slide along each other: the surfaces around them do not cross there"""
    @property
    def bounds(self) -> dict[BodyId, Floats]:
        """for each vertex of a body how far along its way it may go, 0 to 1, if bounds were requested. (V,) by body that moved. All may go so far at once, and come through nothing"""
    @property
    def stats(self) -> dict[str, float]:
        """counts and times. By name, times in milliseconds"""
    def stencils(
        self, first_rows: dict[BodyId, int], begin: npt.NDArray[np.floating], end: npt.NDArray[np.floating]
    ) -> Stencils:
        """the stencils of all impacts that stop, but those with planes, as vertices go straight from `begin` (V, 3) to `end`; `first_rows` as for Report.stencils()"""
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
        """(N,): the place on the ray: from_ + fraction * (to - from_)"""
    @property
    def barycentric(self) -> Floats:
        """(N, 3): the place on the facet: weights of its corners, not negative, with a sum of 1"""
    def __len__(self) -> int: ...

class ClosestPoints:
    """The nearest place of all surfaces; of equally near ones the least by body and facet. A row a point."""

    @property
    def bodies(self) -> npt.NDArray[np.int64]:
        """(N,): BodyId.index; -1 where nothing is as near"""
    @property
    def facets(self) -> Ints:
        """(N,); -1 where nothing is as near"""
    @property
    def distances(self) -> Floats:
        """(N,): metres; infinity where no facet is within reach"""
    @property
    def barycentric(self) -> Floats:
        """(N, 3): the place on the facet: weights of its corners, not negative, with a sum of 1"""
    def __len__(self) -> int: ...

class BodyDistances:
    """The least distance of the surfaces of two bodies, and where it is; of equally near facets the least of a, then of b. A row a pair."""

    @property
    def bodies(self) -> npt.NDArray[np.int64]:
        """(N, 2): BodyId.index of both bodies"""
    @property
    def distances(self) -> Floats:
        """(N,): metres: zero exactly where the surfaces share a point, else right to 1e-12 of both bodies' size; infinity where they are farther apart than requested"""
    @property
    def facets(self) -> Ints:
        """(N, 2): the facet of each; negative: farther apart than requested"""
    @property
    def a_barycentric(self) -> Floats:
        """(N, 3): the place on a's facet: weights of its corners; zero on a plane"""
    @property
    def b_barycentric(self) -> Floats:
        """(N, 3): the place on b's facet"""
    @property
    def containments(self) -> npt.NDArray[np.uint8]:
        """(N,): whether one lies wholly inside the other, whose surfaces are apart. Values of Containment"""
    def __len__(self) -> int: ...

class SweepHits:
    """The first facet that a swept body meets; of equal fractions the least by body, then by facets. A row a sweep."""

    @property
    def bodies(self) -> npt.NDArray[np.int64]:
        """(N,): BodyId.index; -1 where nothing is met"""
    @property
    def facets(self) -> Ints:
        """(N,): of the swept body; negative: it meets nothing"""
    @property
    def others(self) -> Ints:
        """(N,): the facet of the body that is met"""
    @property
    def fractions(self) -> Floats:
        """(N,): the part of the way, 0 to 1, that is free: never later than the true one. Earlier by the time that the facets take for the last 1e-13 of their size and way"""
    @property
    def normals(self) -> Floats:
        """(N, 3): unit vector from `facet` to `other`; zero if they meet at once"""
    @property
    def barycentric(self) -> Floats:
        """(N, 3): the place on `facet`: weights of its corners"""
    @property
    def other_barycentric(self) -> Floats:
        """(N, 3): the place on `other`"""
    def __len__(self) -> int: ...

class Overlap:
    """What two closed bodies have in common."""

    @property
    def volume(self) -> float:
        """cubic metres"""
    @property
    def area(self) -> float:
        """of its surface, square metres; zero where the bodies only touch"""

class PlayedStep:
    """A step that was run again."""

    @property
    def number(self) -> int: ...
    @property
    def byte(self) -> int: ...
    @property
    def recorded(self) -> Optional[int]:
        """the hash of the recorded report. None if the step failed or the program ended in it"""
    @property
    def now(self) -> int: ...
    @property
    def same(self) -> bool: ...

class RecordingPlayer:
    """Runs a recording again, step by step. Iterate over its steps."""

    def __init__(self, path: str | os.PathLike[str], *, threads: Optional[int] = None) -> None: ...
    def __iter__(self) -> Iterator[PlayedStep]: ...
    def __next__(self) -> PlayedStep: ...
    @property
    def world(self) -> World: ...
    @property
    def cut_at(self) -> Optional[int]:
        """the byte of the record that the end of the recording cuts off. Known at the end"""
    @property
    def recorded_by(self) -> str: ...

class _DebugDrawer(Protocol):
    def line(self, p: Floats, q: Floats, color: tuple[float, float, float, float]) -> None: ...
    def triangle(self, p: Floats, q: Floats, r: Floats, color: tuple[float, float, float, float]) -> None: ...
    def text(self, at: Floats, words: str, color: tuple[float, float, float, float]) -> None: ...

class DebugColor:
    """A colour; an alpha of 1 covers what is behind."""

    red: float
    green: float
    blue: float
    alpha: float
    def __init__(self, red: float = 0.0, green: float = 0.0, blue: float = 0.0, alpha: float = 1.0) -> None: ...

class DebugDrawOptions:
    """What is drawn, and in which colour."""

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
    curves: bool
    within_reach: bool
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
    curve: DebugColor
    reach: DebugColor
    distance: DebugColor
    sum: DebugColor
    force: DebugColor
    word: DebugColor
    def __init__(self, **options: bool | DebugColor) -> None: ...

class SumKind:
    """What a sum is over."""

    contact: ClassVar[SumKind]
    patch: ClassVar[SumKind]
    body: ClassVar[SumKind]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class ContactSums:
    """The sums of a step. A row a sum."""

    @property
    def kinds(self) -> npt.NDArray[np.uint8]:
        """(N,): values of SumKind"""
    @property
    def bodies(self) -> npt.NDArray[np.int64]:
        """(N, 2): BodyId.index of a and b; -1 for no body"""
    @property
    def patches(self) -> npt.NDArray[np.uint64]:
        """(N,): the id of the patch, or 0"""
    @property
    def points(self) -> Ints:
        """(N,): the number of contact points"""
    @property
    def areas(self) -> Floats:
        """(N,): the areas of the patches, square metres; 0 where Settings.patches is not set"""
    @property
    def deepest_gaps(self) -> Floats:
        """(N,): the smallest gap, metres; infinity without points"""
    @property
    def mean_gaps(self) -> Floats:
        """(N,): metres"""
    @property
    def centers(self) -> Floats:
        """(N, 3): the mean place of its points, metres"""
    @property
    def normals(self) -> Floats:
        """(N, 3): the mean of the normals towards `b`, or towards the body of a sum over a body; shorter than 1 where they differ"""
    @property
    def forces(self) -> Floats:
        """(N, 3): the sum of the impulses on `b`, or on the body"""
    @property
    def torques(self) -> Floats:
        """(N, 3): their moment about `center`"""
    @property
    def first_vertices(self) -> npt.NDArray[np.int64]:
        """(N + 1,): where the vertices of each sum begin in `vertices`, and the end"""
    @property
    def vertices(self) -> npt.NDArray[np.int64]:
        """(M, 2): BodyId.index and vertex, of each sum each once, in order"""
    def __len__(self) -> int: ...

def nearest_rotation(matrix: npt.ArrayLike) -> Floats:
    """(3, 3) or (N, 3, 3): the rotation nearest to a matrix that is orthonormal to 1e-5"""

def rotation_of_quaternion(quaternion: npt.ArrayLike) -> Floats:
    """(3, 3) or (N, 3, 3) of (4,) or (N, 4): the rotation of a quaternion x, y, z, w"""

class SurfaceComponent:
    """Facets that are joined by edges."""

    @property
    def facet(self) -> int:
        """the first of its facets"""
    @property
    def facet_count(self) -> int:
        """how many there are"""
    @property
    def closed(self) -> bool:
        """each edge joins two facets, which run along it in opposite directions"""
    @property
    def inside_out(self) -> bool:
        """closed, and its facets are clockwise seen from outside"""

class SurfaceCheck:
    """A body's surface, by its vertices and facets as they were added. Edges have the smaller vertex first, and all lists are sorted."""

    @property
    def components(self) -> list[SurfaceComponent]:
        """by their first facet"""
    @property
    def border_edges(self) -> Ints:
        """edges of one facet"""
    @property
    def branching_edges(self) -> Ints:
        """edges of three or more facets"""
    @property
    def turned_facets(self) -> Ints:
        """facets turned against most of their component"""
    @property
    def crossings(self) -> Ints:
        """facets that meet beyond what neighbours share"""
    @property
    def repeated_facets(self) -> Ints:
        """a facet, and the first with the same corners"""
    @property
    def repeated_vertices(self) -> Ints:
        """a vertex, and the first at the same place"""
    @property
    def slivers(self) -> Ints:
        """facets of hardly any height, or of no area"""
    @property
    def unused_vertices(self) -> Ints:
        """vertices of no facet, edge or point"""
    def is_solid(self) -> bool:
        """whether it bounds a solid: there is a component, every one is closed, and none is inside out"""
    def is_clean(self) -> bool:
        """whether every list of faults is empty; borders are none, nor are unused vertices"""

class FeatureSettings:
    """Settings of single vertices and facets of a body. An empty array sets nothing."""

    @property
    def rest_offsets(self) -> Floats:
        """(V,): what each vertex adds to the distance that surfaces keep, metres, 0 to the margin"""
    @property
    def vertex_labels(self) -> npt.NDArray[np.uint32]:
        """(V,): the program's own numbers, one a vertex"""
    @property
    def facet_labels(self) -> npt.NDArray[np.uint32]:
        """(F,): the program's own numbers, one a facet"""
    @property
    def vertex_layers(self) -> npt.NDArray[np.uint32]:
        """(V,): the layers that each vertex is on, a bit each; by default those of the body"""
    @property
    def vertex_masks(self) -> npt.NDArray[np.uint32]:
        """(V,): the layers that each vertex is tested against; by default those of the body"""
    @property
    def facet_layers(self) -> npt.NDArray[np.uint32]:
        """(F,): the layers that each facet is on, a bit each; by default those of the body"""
    @property
    def facet_masks(self) -> npt.NDArray[np.uint32]:
        """(F,): the layers that each facet is tested against; by default those of the body"""
    @property
    def margins(self) -> Floats:
        """(V,): how far ahead of each vertex contact points are seen, metres, 0 to the margin of the body"""

class SelfContactFilter:
    """Which features of a body that is tested against itself are too near to each other to be tested."""

    @property
    def rings(self) -> int:
        """features with vertices at most so many edges apart are left out, 0 to 16; 0 leaves out those with a common vertex alone"""
    @property
    def rest_distance(self) -> float:
        """features with vertices at most so far apart at rest are left out, metres, 0 to LARGEST_COORDINATE; 0 leaves out none"""
    @property
    def rest_positions(self) -> Floats:
        """(V, 3): where vertices are at rest, metres; by default where they are when the filter is set"""

class World:
    """A set of bodies and the contacts among them."""

    def __init__(self, settings: Settings = ...) -> None: ...
    @property
    def settings(self) -> Settings: ...
    def set_settings(self, settings: Settings) -> None: ...
    def add_body(
        self,
        positions: npt.ArrayLike,
        facets: npt.ArrayLike = ...,
        *,
        surface: Surface = ...,
        motion: Motion = ...,
        name: str = "",
        layer: int = 1,
        mask: int = 0xFFFFFFFF,
        margin: float = 0.0,
        self_contact: bool = False,
        group: int = 0,
        key: Optional[int] = None,
        edges: npt.ArrayLike = ...,
        points: npt.ArrayLike = ...,
        rest_offset: Optional[float] = None,
    ) -> BodyId:
        """adds a body; copies its mesh and groups the facets into clusters. Positions: (V, 3) in metres; facets: (F, 3), vertices counter-clockwise seen from outside; edges: (E, 2); points: (P,)"""
    def add_plane(
        self,
        normal: npt.ArrayLike,
        offset: float = 0.0,
        *,
        name: str = "",
        layer: int = 1,
        mask: int = 0xFFFFFFFF,
        margin: float = 0.0,
        group: int = 0,
        key: Optional[int] = None,
        rest_offset: Optional[float] = None,
    ) -> BodyId:
        """adds a half-space, which is fixed and has no vertices: exact at any distance, and without a mesh"""
    def remove_body(self, body: BodyId) -> None: ...
    @overload
    def set_positions(self, body: BodyId, positions: npt.ArrayLike) -> None: ...
    @overload
    def set_positions(self, positions: dict[BodyId, npt.ArrayLike]) -> None: ...
    def set_facets(
        self,
        body: BodyId,
        positions: npt.ArrayLike,
        facets: npt.ArrayLike,
        vertex_map: npt.ArrayLike,
        *,
        edges: npt.ArrayLike = ...,
        points: npt.ArrayLike = ...,
        facet_map: npt.ArrayLike = ...,
    ) -> None:
        """gives a body other vertices and facets; `vertex_map` tells of each new vertex which old one it was, or -1. (V, 3) in metres, (F, 3), and (V,); edges (E, 2); points (P,); of each facet the old one whose label, layer and mask it has, or -1: (F,)"""
    def set_pose(self, body: BodyId, rotation: npt.ArrayLike, translation: npt.ArrayLike) -> None:
        """places a rigid body: a vertex added at p stands at rotation * p + translation. (3, 3), and (3,) metres"""
    @overload
    def set_poses(self, poses: dict[BodyId, tuple[npt.ArrayLike, npt.ArrayLike]]) -> None:
        """places many rigid bodies in parallel, all or none"""
    @overload
    def set_poses(self, bodies: Iterable[BodyId], rotations: npt.ArrayLike, translations: npt.ArrayLike) -> None:
        """places many rigid bodies in parallel, all or none"""
    def set_layers(self, body: BodyId, layer: int, mask: int) -> None: ...
    def set_group(self, body: BodyId, group: int) -> None:
        """sets the group of a body"""
    def set_excluded(self, a: BodyId, b: BodyId, excluded: bool) -> None:
        """sets whether two bodies are excluded from tests, whatever their layers: the two sides of a joint, say"""
    def excluded(self, a: BodyId, b: BodyId) -> bool: ...
    def set_motion(self, body: BodyId, motion: Motion) -> None: ...
    def detect(self) -> Report: ...
    def detect_motion(
        self, wanted: Impacts = ..., distance: float | None = None, bounds: bool = False
    ) -> MotionReport:
        """finds what meets between the positions of the last detect() and the current ones, every vertex moving straight"""
    def sum_contacts(
        self, report: Report, ids: npt.NDArray[np.uint64] = ..., impulses: npt.NDArray[np.floating] = ...
    ) -> ContactSums:
        """adds up the points of a world's last report, at the current positions. `ids` (N,) and `impulses` (N, 3) are of points"""
    def point_labels(self, report: Report) -> PointLabelArrays:
        """the labels of the points of all contacts of a world's last report, in their order"""
    def joined_minima(self, report: Report, *, within: float = 0.0, layers: int = 0) -> npt.NDArray[np.bool_]:
        """(N,): for each contact point of a world's last report, in the order of Report.points, whether it is a minimum also of joined surfaces. Facets of one body are joined, whether or not they share vertices, bodies that are not tested against each other, and bodies on `layers`; `within` metres they are at one place"""
    def save(self) -> bytes:
        """all that later answers depend on as bytes: settings, bodies, histories"""
    def restore(self, bytes: bytes) -> None:
        """goes back to the state of `bytes`, of this world or another: later calls answer as after save(), bit for bit"""
    def cast_rays(
        self,
        from_: npt.ArrayLike,
        to: npt.ArrayLike,
        *,
        any: bool = False,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> RayHits:
        """answers many rays in parallel. The first facet that each meets, or any; (N, 3) both, metres"""
    def cast_ray_all(
        self,
        from_: npt.ArrayLike,
        to: npt.ArrayLike,
        *,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> RayHits:
        """all facets that a ray meets, sorted by fraction, body and facet"""
    def closest_points(
        self,
        points: npt.ArrayLike,
        *,
        within: float = ...,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> ClosestPoints:
        """finds the nearest places to many points in parallel. (N, 3), metres"""
    def signed_distances(
        self,
        points: npt.ArrayLike,
        *,
        within: float = ...,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> ClosestPoints:
        """finds the signed distances of many points in parallel. (N, 3), metres; negative inside closed bodies"""
    def distances(self, a: Sequence[BodyId], b: Sequence[BodyId], *, within: float = ...) -> BodyDistances:
        """finds the distances of many pairs of bodies in parallel. Lists of one length"""
    def nearest_bodies(
        self,
        body: BodyId,
        *,
        count: int = 1,
        within: float = ...,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> BodyDistances:
        """the bodies nearest to one, sorted by distance and body"""
    def sweeps(
        self,
        bodies: Sequence[BodyId],
        ways: Optional[npt.ArrayLike] = None,
        *,
        axes: Optional[npt.ArrayLike] = None,
        centers: Optional[npt.ArrayLike] = None,
        angles: Optional[npt.ArrayLike] = None,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> SweepHits:
        """finds what many sweeps meet in parallel. A body each, (N, 3), metres; (N,), radians. Without axes they are z"""
    def overlap(self, a: BodyId, b: BodyId) -> Overlap:
        """volume and surface of what two closed bodies that do not cross themselves have in common"""
    def overlap_box(
        self,
        lower: npt.ArrayLike,
        upper: npt.ArrayLike,
        *,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> npt.NDArray[np.int64]:
        """the facets that share a point with a box, decided exactly; sorted by body and facet. (N, 2): BodyId.index and facet"""
    def bodies_containing(
        self, point: npt.ArrayLike, *, layer: int = 0xFFFFFFFF, mask: int = 0xFFFFFFFF
    ) -> list[BodyId]:
        """the closed bodies that contain a point or have it on their surface, decided exactly, at any `within`"""
    def overlap_boxes(
        self,
        lower: npt.ArrayLike,
        upper: npt.ArrayLike,
        *,
        layer: int = 0xFFFFFFFF,
        mask: int = 0xFFFFFFFF,
    ) -> list[npt.NDArray[np.int64]]:
        """finds the facets in many boxes in parallel. (N, 3) both; an array a box"""
    def bodies_containing_each(
        self, points: npt.ArrayLike, *, layer: int = 0xFFFFFFFF, mask: int = 0xFFFFFFFF
    ) -> list[list[BodyId]]:
        """finds the bodies that contain many points in parallel. (N, 3); a list a point"""
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
    def key(self, body: BodyId) -> int:
        """the key of a body: given, or its index"""
    def margin(self, body: BodyId) -> float:
        """the margin of a body, metres"""
    def self_contact(self, body: BodyId) -> bool: ...
    def set_margin(self, body: BodyId, margin: float) -> None: ...
    def set_self_contact(self, body: BodyId, wanted: bool) -> None: ...
    def rest_offset(self, body: BodyId) -> float:
        """the rest offset of a body, or its margin, metres"""
    def set_rest_offset(self, body: BodyId, rest_offset: float | None) -> None:
        """sets what a body adds to the distance that surfaces keep, metres; none takes the margin, whatever that becomes"""
    def set_feature_settings(
        self,
        body: BodyId,
        *,
        rest_offsets: npt.ArrayLike = ...,
        vertex_labels: npt.ArrayLike = ...,
        facet_labels: npt.ArrayLike = ...,
        vertex_layers: npt.ArrayLike = ...,
        vertex_masks: npt.ArrayLike = ...,
        facet_layers: npt.ArrayLike = ...,
        facet_masks: npt.ArrayLike = ...,
        margins: npt.ArrayLike = ...,
    ) -> None:
        """replaces the settings of single vertices and facets of a body. (V,), those of facets (F,); an empty array sets nothing"""
    def set_self_contact_filter(
        self,
        body: BodyId,
        *,
        rings: int = ...,
        rest_distance: float = ...,
        rest_positions: npt.ArrayLike | None = ...,
    ) -> None:
        """sets which features of a body are too near to each other to be tested against each other. Positions at rest: (V, 3) metres, by default where vertices are now"""
    def self_contact_filter(self, body: BodyId) -> SelfContactFilter:
        """which features of a body are too near to be tested, valid until that or its facets change"""
    def set_excluded_labels(
        self, a: BodyId, label_a: int, b: BodyId, label_b: int, excluded: bool, *, kind: LabelKind = ...
    ) -> None:
        """sets whether features of two labels are excluded from tests: a collar and what it is sewn to, say"""
    def excluded_labels(self, a: BodyId, label_a: int, b: BodyId, label_b: int, *, kind: LabelKind = ...) -> bool: ...
    def feature_settings(self, body: BodyId) -> FeatureSettings:
        """returns the settings of single vertices and facets of a body, valid until they or its facets change"""
    def labels(self, body: BodyId, vertices: npt.ArrayLike) -> npt.NDArray[np.uint32]:
        """the labels of a feature of a body, whose vertices are named as in a point, a pair or an impact. (N, 3) gives (N, 4): those of the vertices, and that of the facet, or of the first facet that has the vertex or the edge"""
    def vertex_count(self, body: BodyId) -> int: ...
    def facet_count(self, body: BodyId) -> int: ...
    def edge_count(self, body: BodyId) -> int: ...
    def point_count(self, body: BodyId) -> int: ...
    def plane(self, body: BodyId) -> Optional[tuple[npt.NDArray[np.float64], float]]:
        """the half-space of a body that add_plane() added; none for any other"""
    def positions(self, body: BodyId) -> Floats:
        """a copy, (V, 3) in metres, as they were set last; NaN for a vertex that no facet, edge or point uses"""
    def facets(self, body: BodyId) -> Ints:
        """a copy, (F, 3), as it was given"""
    def edges(self, body: BodyId) -> Ints:
        """a copy, (E, 2), as it was given"""
    def points(self, body: BodyId) -> Ints:
        """a copy, (P,), as it was given"""
    def bounds(self, body: BodyId) -> tuple[Floats, Floats]:
        """the box of a body with its margin, metres; that of a plane is infinite. Without a facet, edge or point, lower is above upper. Two arrays, lower and upper"""
    def check_surface(self, body: BodyId, sliver: float = 1e-6) -> SurfaceCheck:
        """checks what a body's surface is: borders, turned facets, crossings with itself and more. A facet is a sliver whose height is at most `sliver` times its longest side"""
    def record(self, path: str | os.PathLike[str]) -> None:
        """writes all that enters the world to a file that `tact replay` runs again; before the first body is added"""
    def stop_recording(self) -> None:
        """closes the file; OSError if it does not hold all"""
    def debug_draw(self, report: Report, drawer: _DebugDrawer, options: DebugDrawOptions = ...) -> None:
        """draws a report of this world, which the drawer can read and not change"""
    def debug_draw_distances(self, distances: BodyDistances, drawer: _DebugDrawer, options: DebugDrawOptions = ...) -> None:
        """draws distances of bodies of this world: a line between the two places, and its length"""
    def debug_draw_sums(self, sums: ContactSums, drawer: _DebugDrawer, options: DebugDrawOptions = ...) -> None:
        """draws each patch of sums as a circle of its area across its normal, and forces as arrows, the largest half as long as all bodies"""
    def __len__(self) -> int: ...

class WeldedMesh:
    """A mesh in which no two vertices have equal positions."""

    @property
    def positions(self) -> Floats:
        """(V, 3): of each place the first vertex that was given. Metres"""
    @property
    def facets(self) -> Ints:
        """(F, 3): all that were given, in their order"""
    @property
    def vertex_of(self) -> Ints:
        """for each vertex that was given, its vertex in this mesh"""
    @property
    def merged_vertices(self) -> int:
        """how many vertices became one with an earlier vertex"""
    @property
    def collapsed_facets(self) -> int:
        """how many facets have a vertex twice that had three"""

def weld(positions: npt.ArrayLike, facets: npt.ArrayLike) -> WeldedMesh:
    """a mesh without the vertices that repeat an earlier position; 0 and -0 are equal"""

_Path = str | os.PathLike[str]

class Mesh:
    """A surface as a file gives it."""

    name: str
    positions: Floats
    """(V, 3): metres"""
    facets: Ints
    """(F, 3)"""
    vertices: Ints
    """(V,): the number of each vertex in the file"""
    def __init__(
        self, name: str, positions: npt.ArrayLike, facets: npt.ArrayLike, vertices: Optional[Ints] = None
    ) -> None: ...

class MeshSequence:
    """A surface that moves, a frame at a time. Iterate over its meshes."""

    name: str
    positions: list[Floats]
    """(V, 3) each, one a frame; metres"""
    facets: Ints
    """(F, 3): the same in all frames"""
    vertices: Ints
    """(V,): the number of each vertex in the files"""
    times: list[float]
    """of the frames of a series, seconds; else empty"""
    files: list[str]
    """one a frame; empty if the positions are of no files"""
    def __init__(
        self,
        name: str,
        positions: Iterable[npt.ArrayLike],
        facets: npt.ArrayLike,
        vertices: Optional[Ints] = None,
        times: Iterable[float] = (),
        files: Iterable[str] = (),
    ) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, frame: int) -> Mesh: ...

def read(path: _Path, *, displacement: Optional[str] = None) -> Mesh:
    """a surface from a file; cells that have a volume give their surface. `displacement` names point data to add to the positions"""

def read_sequence(
    *paths: _Path, frames: Optional[int] = None, displacement: Optional[str] = None, progress: bool = True
) -> list[MeshSequence]:
    """the bodies of files, folders and series, each with the positions of all its frames, or the first `frames`"""

class CheckFrame:
    """What a frame holds. Bodies are numbers, counted from 0, in the order of CheckResult.bodies."""

    number: int
    time: Optional[float]
    """seconds, of a series"""
    files: list[str]
    """of each body, where one moves"""
    hash: str
    """of the report, 16 hexadecimal digits"""
    candidate_pairs: list[tuple[int, int, bool]]
    """bodies whose boxes overlap, and whether their hulls do"""
    bodies: npt.NDArray[np.int64]
    """(C, 2): the bodies of each contact"""
    directions: Floats
    """(C, 3): the direction of each contact"""
    depths: Floats
    """(C,): the depth of each contact, metres"""
    facet_pairs: FacetPairArrays
    points: PointArrays
    impacts: Optional[MotionReport]
    """what met since the frame before, if impacts are requested"""
    stats: dict[str, float]
    """counts and times of the step. By name, times in milliseconds"""
    def __init__(
        self,
        number: int,
        time: Optional[float],
        files: list[str],
        report: Report,
        motion: Optional[MotionReport],
        sizes: list[tuple[int, int]],
    ) -> None: ...
    @property
    def least_gap(self) -> Optional[float]:
        """the least gap of its contact points, metres; None without points"""
    def gaps(self, body: int) -> Floats:
        """(V,): for each vertex of a body the least gap of its contact points, metres; infinity where there is none"""
    def crossing(self, body: int) -> npt.NDArray[np.bool_]:
        """(F,): for each facet of a body whether it meets another"""

class CheckResult:
    """What check() found: its frames, and the bodies that it stepped."""

    bodies: list[MeshSequence]
    frames: list[CheckFrame]
    world: World
    """at the last frame"""
    ids: list[BodyId]
    """of the bodies in the world"""
    json: Optional[str]
    """what `tact check --json` writes, if it is requested"""
    def __init__(
        self, bodies: list[MeshSequence], frames: list[CheckFrame], world: World, ids: list[BodyId], json: Optional[str]
    ) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, frame: int) -> CheckFrame: ...
    @property
    def crossing_frames(self) -> list[int]:
        """the numbers of the frames in which facets meet"""

def check(
    *meshes: _Path | Mesh | MeshSequence,
    sheets: str | Iterable[str] = (),
    margins: None | float | Mapping[str, float] = None,
    selves: str | Iterable[str] = (),
    exclude: Iterable[tuple[str, str]] = (),
    weld: bool = False,
    points: bool = False,
    curves: bool = False,
    within_reach: bool = False,
    impacts: bool = False,
    surfaces: bool = False,
    accuracy: str | Accuracy = "exact",
    threads: int = 0,
    frames: Optional[int] = None,
    json: bool | _Path = False,
    record: Optional[_Path] = None,
    progress: bool = True,
) -> CheckResult:
    """finds which bodies touch, frame by frame: what `tact check` does, with the same numbers, as arrays"""

class Page:
    """A page for the browser that plays steps and shows of every facet why it was kept or dropped."""

    html: str
    height: int
    """of the cell, pixels"""
    def __init__(self, text: str, height: int) -> None: ...
    def save(self, path: _Path) -> None:
        """writes the page to a file, which needs no network"""

def view(
    what: World | _Path,
    *,
    title: Optional[str] = None,
    height: int = 640,
    every: int = 1,
    start: int = 0,
    stop: Optional[int] = None,
    few_points: bool = False,
    points: bool = False,
    curves: bool = False,
) -> Page:
    """the page that `tact view` writes, of a world as it stands or of a recording, for a notebook's cell"""
