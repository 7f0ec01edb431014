"""Bodies over the ranks of an MPI communicator: `mpirun -n 4 python3 program.py`."""

from typing import Callable, ClassVar, Mapping, Optional, Sequence, overload

import numpy as np
import numpy.typing as npt
from mpi4py import MPI

from . import (
    Containment,
    ContactPoints,
    DirectionSource,
    FeaturePair,
    Impacts,
    IntersectionCurve,
    LabelKind,
    Motion,
    Patch,
    PatchEventKind,
    ReachPairs,
    Settings,
    Surface,
)

class Partitioner:
    """How Zoltan cuts space into one part a rank."""

    rcb: ClassVar[Partitioner]
    hsfc: ClassVar[Partitioner]
    name: str
    value: int
    def __init__(self, value: int) -> None: ...
    def __int__(self) -> int: ...
    def __hash__(self) -> int: ...

class _Bodies:
    @property
    def key_a(self) -> int:
        """The key of body a, not above key_b."""
    @property
    def key_b(self) -> int: ...
    @property
    def rank_a(self) -> int:
        """The owner of a: this rank for a body that every rank holds; -1 if it was removed."""
    @property
    def rank_b(self) -> int: ...
    @property
    def counted(self) -> bool:
        """Whether this rank counts them, in sums over all ranks."""

class Contact(_Bodies):
    """A contact in which this rank owns a body."""

    @property
    def direction(self) -> npt.NDArray[np.float64]: ...
    @property
    def depth(self) -> float: ...
    @property
    def containment(self) -> Containment: ...
    @property
    def source(self) -> DirectionSource: ...
    @property
    def touching(self) -> bool: ...
    @property
    def facet_pairs(self) -> npt.NDArray[np.int32]: ...
    @property
    def points(self) -> ContactPoints: ...
    @property
    def patches(self) -> list[Patch]: ...
    @property
    def within_reach(self) -> ReachPairs: ...
    @property
    def curves(self) -> list[IntersectionCurve]: ...
    def hash(self) -> int:
        """As tact.Contact.hash(): the same on every rank and on one machine."""

class ContactEvent(_Bodies):
    """Two bodies that began or ceased to touch."""

class PatchEvent(_Bodies):
    """A change of a patch in this step."""

    @property
    def kind(self) -> PatchEventKind: ...
    @property
    def patch(self) -> int: ...
    @property
    def other(self) -> int: ...

class Impact(_Bodies):
    """Two features that meet between two steps."""

    @property
    def time(self) -> float: ...
    @property
    def stops(self) -> bool:
        """False if they touch and part, or slide along each other."""
    @property
    def kind(self) -> FeaturePair: ...
    @property
    def a_vertices(self) -> list[int]: ...
    @property
    def b_vertices(self) -> list[int]: ...

class Report:
    """What World.detect() found of the bodies of this rank, valid until the next call together."""

    @property
    def contacts(self) -> list[Contact]: ...
    def find_contact(self, a: int, b: int) -> Optional[Contact]: ...
    @property
    def began(self) -> list[ContactEvent]: ...
    @property
    def ended(self) -> list[ContactEvent]: ...
    @property
    def patch_events(self) -> list[PatchEvent]: ...
    def hash_sum(self) -> int:
        """The sum, modulo 2^64, of the hashes of the contacts that this rank counts."""
    @property
    def stats(self) -> dict[str, float]: ...
    def __len__(self) -> int: ...

class MotionReport:
    """What World.detect_motion() found of the bodies of this rank."""

    @property
    def first_time(self) -> float: ...
    @property
    def impacts(self) -> list[Impact]: ...
    @property
    def stats(self) -> dict[str, float]: ...
    def __len__(self) -> int: ...

class World:
    """Bodies that are spread over the ranks of an MPI communicator, each with a key of its own.

    All ranks call the functions marked "together" in the same order.
    """

    def __init__(
        self,
        communicator: MPI.Comm,
        settings: Settings = ...,
        *,
        partitioner: Partitioner = ...,
        rebalance_above: float = 0.0,
    ) -> None:
        """Together."""
    @property
    def rank(self) -> int: ...
    @property
    def rank_count(self) -> int: ...
    @property
    def settings(self) -> Settings: ...
    def set_settings(self, settings: Settings) -> None:
        """Together."""
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
        key: int,
        edges: npt.ArrayLike = ...,
        points: npt.ArrayLike = ...,
        rest_offset: Optional[float] = None,
        every_rank: bool = False,
    ) -> None:
        """Adds a body of this rank, or, with `every_rank`, a fixed one that all ranks add."""
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
        key: int,
        rest_offset: Optional[float] = None,
    ) -> None:
        """Adds a half-space that all ranks add alike."""
    def remove_body(self, key: int) -> None: ...
    @overload
    def set_positions(self, key: int, positions: npt.ArrayLike) -> None: ...
    @overload
    def set_positions(self, positions: Mapping[int, npt.ArrayLike]) -> None: ...
    def set_facets(
        self,
        key: int,
        positions: npt.ArrayLike,
        facets: npt.ArrayLike,
        vertex_map: npt.ArrayLike,
        *,
        edges: npt.ArrayLike = ...,
        points: npt.ArrayLike = ...,
        facet_map: npt.ArrayLike = ...,
    ) -> None:
        """Gives a body other vertices and facets, as World.set_facets() does."""
    def set_pose(self, key: int, rotation: npt.ArrayLike, translation: npt.ArrayLike) -> None: ...
    @overload
    def set_poses(self, poses: Mapping[int, tuple[npt.ArrayLike, npt.ArrayLike]]) -> None:
        """Places many rigid bodies in parallel, all or none."""
    @overload
    def set_poses(self, keys: Sequence[int], rotations: npt.ArrayLike, translations: npt.ArrayLike) -> None:
        """Places many rigid bodies in parallel, all or none."""
    def set_layers(self, key: int, layer: int, mask: int) -> None: ...
    def set_group(self, key: int, group: int) -> None: ...
    def set_motion(self, key: int, motion: Motion) -> None: ...
    def set_margin(self, key: int, margin: float) -> None: ...
    def set_rest_offset(self, key: int, rest_offset: float | None) -> None: ...
    def set_feature_settings(
        self,
        key: int,
        *,
        rest_offsets: npt.ArrayLike = ...,
        vertex_labels: npt.ArrayLike = ...,
        facet_labels: npt.ArrayLike = ...,
        vertex_layers: npt.ArrayLike = ...,
        vertex_masks: npt.ArrayLike = ...,
        facet_layers: npt.ArrayLike = ...,
        facet_masks: npt.ArrayLike = ...,
        margins: npt.ArrayLike = ...,
    ) -> None: ...
    def set_self_contact(self, key: int, wanted: bool) -> None: ...
    def set_self_contact_filter(
        self,
        key: int,
        *,
        rings: int = ...,
        rest_distance: float = ...,
        rest_positions: npt.ArrayLike | None = ...,
    ) -> None: ...
    def set_excluded(self, key: int, other: int, excluded: bool) -> None: ...
    def set_excluded_labels(
        self, a: int, label_a: int, b: int, label_b: int, excluded: bool, *, kind: LabelKind = ...
    ) -> None: ...
    def detect(self) -> Report:
        """Together."""
    def detect_motion(self, wanted: Impacts = ...) -> MotionReport:
        """Together."""
    def save(self) -> bytes:
        """Together; this rank's share of all that later answers depend on."""
    def restore(self, shares: Sequence[bytes]) -> None:
        """Together; each share that was saved is given to one rank, whichever."""
    def set_body_state(
        self,
        pack: Callable[[int], bytes],
        unpack: Callable[[int, bytes], None],
        drop: Callable[[int], None],
    ) -> None:
        """The program's state that moves with bodies."""
    def rebalance(self) -> None:
        """Together."""
    def set_owner(self, key: int, rank: int) -> None: ...
    def move_bodies(self) -> None:
        """Together."""
    def exchange(self, give: Callable[[int], bytes], take: Callable[[int, bytes], None]) -> None:
        """Together."""
    def owns(self, key: int) -> bool: ...
    @property
    def bodies(self) -> list[int]: ...
    @property
    def body_count(self) -> int: ...
    def positions(self, key: int) -> npt.NDArray[np.float64]: ...
    def __len__(self) -> int: ...
