"""The kinematic skeleton: joints, end points, frame, and how far to trust it."""

from __future__ import annotations

import copy
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from ._mesh import FloatArray, IntArray, PathLike, _existing
from ._picture import GREY, bones_of, picture


def _fixed(array: Any) -> Any:  # noqa: ANN401
    array.flags.writeable = False
    return array


@dataclass(frozen=True, eq=False)
class Frame:
    """The person's own directions, each (3,): `left`, `forward`, `up` of length 1; `origin` is the root joint.

    (left, forward, up) is a left-handed triple.
    """

    origin: FloatArray
    left: FloatArray
    forward: FloatArray
    up: FloatArray

    @property
    def axes(self) -> FloatArray:
        """(2, 3) to the right and downwards in a picture from the front."""
        return np.stack([self.left, -self.up])


@dataclass(frozen=True)
class Quality:
    """How far the skeleton may be trusted."""

    sides_confidence: float  #: 0 (a coin toss) to 1 (every witness agrees)
    matched_nodes: int  #: nodes of the reduced template found in the curve skeleton
    warnings: tuple[str, ...]  #: one sentence each
    side_votes: dict[str, float]  #: what each kind of witness says of the sides


class Skeleton:
    """A kinematic skeleton, as its file has it.

    Arrays are read-only, and in the unit of the mesh.

    Attributes:
        names: of the joints, in the template's order, parents before children.
        parents: (j,) index of each joint's parent, -1 for the root.
        positions: (j, 3); NaN for joints that are missing.
        radius: (j,) mean distance from the joint to the surface around it; NaN for missing ones.
        confidence: (j,) 0 to 1; 0 for missing ones.
        present: (j,) False for joints whose limb ends before them.
        end_points: places on the surface by name: head_top, left_fingertip, ...
        frame: the person's own directions.
        quality: how far the skeleton may be trusted.
        template: the template's name.

    >>> skeleton = skelgen.read_skeleton("body.json")
    >>> skeleton
    Skeleton(human21: 21 joints, sides_confidence 0.98)
    >>> skeleton["left_knee"].shape
    (3,)
    """

    def __init__(self, text: str) -> None:
        self._document: dict[str, Any] = json.loads(text)
        joints = self._document["joints"]
        self.template: str = self._document["template"]
        self.names: tuple[str, ...] = tuple(joint["name"] for joint in joints)
        index = {name: j for j, name in enumerate(self.names)}
        nowhere = [np.nan] * 3
        self.parents: IntArray = _fixed(np.array([index.get(joint["parent"], -1) for joint in joints], np.int32))
        self.positions: FloatArray = _fixed(np.array([joint.get("position", nowhere) for joint in joints], float))
        self.radius: FloatArray = _fixed(np.array([joint.get("radius", np.nan) for joint in joints], float))
        self.present = _fixed(np.array([joint.get("present", True) for joint in joints], bool))
        self.confidence: FloatArray = _fixed(
            np.array([joint.get("confidence", 1.0) if joint.get("present", True) else 0.0 for joint in joints], float)
        )
        self.end_points: dict[str, FloatArray] = {
            name: _fixed(np.array(place, float)) for name, place in self._document["end_points"].items()
        }
        frame = self._document["frame"]
        self.frame = Frame(*(_fixed(np.array(frame[key], float)) for key in ("origin", "left", "forward", "up")))
        quality = self._document["quality"]
        self.quality = Quality(
            quality["sides_confidence"],
            quality["matched_nodes"],
            tuple(quality["warnings"]),
            dict(quality.get("side_votes", {})),
        )

    @classmethod
    def from_dict(cls, document: dict[str, Any]) -> Skeleton:
        """The skeleton that a skeleton file's content describes.

        Raises:
            ValueError: it is none; the message says which part is missing or malformed.

        >>> skelgen.Skeleton.from_dict(skelgen.extract("body.off").to_dict()).template
        'human21'
        """
        return Skeleton(_core.skeleton_json(json.dumps(document)))

    def to_dict(self) -> dict[str, Any]:
        """What the skeleton's file holds, as `skelgen extract` writes it.

        >>> skelgen.read_skeleton("body.json").to_dict()["joints"][0]["name"]
        'crotch'
        """
        return copy.deepcopy(self._document)

    def save(self, path: PathLike) -> None:
        """Write the skeleton's file (JSON), wholly or not at all.

        Raises:
            OSError: it cannot be stored.

        >>> skelgen.extract("body.off").save("body.json")
        """
        _core.write_text(Path(path), _core.skeleton_json(json.dumps(self._document)))

    def __getitem__(self, name: str) -> FloatArray:
        """The place of a joint, or of an end point, (3,).

        Raises:
            KeyError: there is none of that name.
        """
        if name in self.end_points:
            return self.end_points[name]
        try:
            place: FloatArray = self.positions[self.names.index(name)]
        except ValueError:
            message = f"{name!r} is none of {', '.join((*self.names, *self.end_points))}"
            raise KeyError(message) from None
        return place

    def __eq__(self, other: object) -> bool:
        """Whether both files would hold the same, timings aside."""
        if not isinstance(other, Skeleton):
            return NotImplemented
        return _without_timings(self._document) == _without_timings(other._document)

    __hash__ = None  # type: ignore[assignment]
    __iter__ = None  # names are no numbers from 0 on

    def __repr__(self) -> str:
        missing = int((~self.present).sum())
        count = f"{len(self.names)} joints" + (f", {missing} of them missing" if missing else "")
        return f"{type(self).__name__}({self.template}: {count}, sides_confidence {self.quality.sides_confidence:.2f})"

    def _shown_vertices(self) -> FloatArray | None:
        return None

    def _repr_html_(self) -> str:
        """A picture for notebooks: the body from the front, left blue, right yellow."""
        vertices = self._shown_vertices()
        surface = [] if vertices is None else [(vertices, GREY)]
        return picture(self, self.frame.axes, surface, self.positions, bones_of(self.parents), self.names)


def _without_timings(document: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in document.items() if key != "timings_ms"}


def read_skeleton(path: PathLike) -> Skeleton:
    """Read a skeleton's file, as `Skeleton.save` and `skelgen extract` write it.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: it is no skeleton file.

    >>> skelgen.read_skeleton("body.json").names[0]
    'crotch'
    """
    file = _existing(path)
    try:
        return Skeleton(_core.skeleton_json(file.read_text(encoding="utf-8")))
    except ValueError as error:
        message = f"{file}: {error}"
        raise ValueError(message) from error
