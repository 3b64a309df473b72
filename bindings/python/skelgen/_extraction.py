"""A body found in a mesh, and what it is good for."""

from __future__ import annotations

import json
import os
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, SupportsIndex, overload

import numpy as np

from . import _core
from ._curve import Curve
from ._mesh import FloatArray, IntArray, Mesh, MeshLike, PathLike, as_mesh, is_path
from ._picture import FRONT, GREY, bones_of, picture
from ._skeleton import Frame, Skeleton, _fixed, read_skeleton

if TYPE_CHECKING:
    from collections.abc import Iterator

    import numpy.typing as npt


class Extraction(Skeleton):
    """A skeleton with the mesh that it was found in: found once, used for whatever is wanted.

    Beside what every `Skeleton` has:

    Attributes:
        vertices: (n, 3) and
        faces: (m, 3), the mesh's. Arrays that were given as C-contiguous float64 and int32 are kept, not copied: change
            them, and what is made of the body later is wrong.
        trail: what was tried until the body was found, one dictionary each.
        geodesic_diameter: the largest distance along the surface.
    """

    def __init__(  # noqa: PLR0913
        self,
        mesh: Mesh,
        template: PathLike,
        fingers: str,
        toes: bool,  # noqa: FBT001
        component: int,
        threads: int,
    ) -> None:
        self._mesh = mesh
        self._options = _checked(template, fingers, toes, component, threads)
        self._found: _core.FoundBody | None = None
        self._curve: Curve | None = None
        self._skeleton_text = self._body.skeleton_json
        super().__init__(self._skeleton_text)
        self.trail: list[dict[str, Any]] = json.loads(self._body.trail_json)["tried"]

    @property
    def vertices(self) -> FloatArray:
        """(n, 3), the mesh's."""
        return self._mesh.vertices

    @property
    def faces(self) -> IntArray:
        """(m, 3), the mesh's."""
        return self._mesh.faces

    @property
    def geodesic_diameter(self) -> float:
        """The largest distance along the surface, in the mesh's unit."""
        return float(self._document["mesh"]["geodesic_diameter"])

    @property
    def timings_ms(self) -> dict[str, float]:
        """What each stage took, milliseconds."""
        return dict(self._document["timings_ms"])

    @property
    def _body(self) -> _core.FoundBody:
        """What was found; after unpickling it is found again, which gives the same."""
        if self._found is None:
            self._found = self._find(with_curve=False)
        return self._found

    def _find(self, *, with_curve: bool) -> _core.FoundBody:
        mesh = self._mesh
        return _core.extract(mesh.vertices, mesh.faces, mesh.name, *self._options, with_curve, mesh._read_ms)  # noqa: SLF001

    @property
    def curve(self) -> Curve:
        """The curve skeleton that the joints were found by; made when it is first asked for."""
        if self._curve is None:
            self._curve = Curve(*self._find(with_curve=True).curve)
        return self._curve

    def segment(self, parts: str = "bones") -> Segmentation:
        """Divide the body into its parts.

        Args:
            parts: "bones" (head, neck, chest, abdomen, pelvis, and on each side shoulder, upper_arm, forearm, hand,
                thigh, calf, foot) or "body" (head, torso, and the limbs without the shoulder).

        Raises:
            ValueError: there is no such set of parts, or the skeleton's template is neither human21 nor quadruped.

        >>> skelgen.extract("body.off").segment().parts[:3]
        ('head', 'neck', 'chest')
        """
        return Segmentation(self._mesh, json.loads(_core.segment(self._body, parts)), self.frame)

    def measure(self) -> Measurements:
        """Measure the body: height, arm span, lengths of bones, girths, area and volume, in the mesh's own unit.

        Raises:
            ValueError: the skeleton's template is neither human21 nor quadruped.

        >>> measures = skelgen.extract("body.off").measure()
        >>> round(measures.height, 2)
        1.76
        """
        return Measurements(json.loads(_core.measure(self._body)))

    def align(self, origin: str = "crotch", *, scale: bool = False) -> Aligned:
        """Turn the body so that +y is up and it faces +z.

        Where `component` chose one of several bodies, that one alone comes back.

        Args:
            origin: "crotch" (in the joint) or "floor" (below it, as low as the lowest vertex).
            scale: whether it becomes 1 high when it stands upright.

        Raises:
            ValueError: there is no such origin.

        >>> skelgen.extract("body.off").align(origin="floor").matrix.shape
        (4, 4)
        """
        return Aligned(self._mesh, *_core.align(self._body, origin, scale))

    def rig(self, rest: str = "as-is", *, fingers: str = "auto", toes: bool = False) -> Rig:
        """Bind the mesh to its skeleton: a character that moves.

        Where `component` chose one of several bodies, that one alone.

        Args:
            rest: "as-is", "t-pose" or "a-pose". VRM wants the T-pose.
            fingers: bones of the fingers: "auto" (where the surface shows some), "on" or "off".
            toes: also bones of the single toes, where the surface shows them.

        Raises:
            ValueError: there is no such pose, or an option has another value.
            NoSkeletonError: the skeleton does not lie in the body.

        >>> skelgen.extract("body.off").rig(rest="t-pose").save("body.glb")
        """
        return Rig(self, rest, fingers, toes=toes)

    def pose(self, like: MeshLike) -> Posed:
        """Hold the body as another one holds itself, whatever the shape, proportions and unit of both.

        Where `component` chose one of several bodies, that one alone comes back.

        Args:
            like: an `Extraction`, a `Skeleton`, a skeleton's file, or the mesh of another body.

        Raises:
            ValueError: the skeleton is none that says how someone is held.

        >>> body = skelgen.extract("body.off")
        >>> body.pose(like=body).vertices.shape
        (6890, 3)
        """
        if is_path(like) and Path(like).suffix == ".json":
            like = read_skeleton(like)
        if isinstance(like, Skeleton) and not isinstance(like, Extraction):
            posed = _core.pose_as(self._body, json.dumps(like.to_dict()))
        else:
            posed = _core.pose_like(self._body, _found(like)._body)  # noqa: SLF001
        return Posed(self._mesh, *posed)

    def correspond(self, to: MeshLike) -> Correspondence:
        """Find for each vertex of this body the same place on another one.

        Args:
            to: an `Extraction`, which is reused, or the mesh of another body.

        Raises:
            ValueError, NoSkeletonError: as `extract`, of the other mesh.

        >>> body = skelgen.extract("body.off")
        >>> float((body.correspond(body).vertex_to_vertex == range(6890)).mean()) > 0.9
        True
        """
        other = _found(to)
        return Correspondence(json.loads(_core.correspond(self._body, other._body)), other.faces)  # noqa: SLF001

    def _shown_vertices(self) -> FloatArray:
        return self.vertices

    def __getstate__(self) -> dict[str, Any]:
        """The mesh and what was found in it; the surface is made again where it is needed."""
        return {**self.__dict__, "_found": None}

    def __repr__(self) -> str:
        return super().__repr__().replace("(", f"({self._mesh.name!r}, ", 1)


class Segmentation:
    """A surface in parts.

    Attributes:
        parts: their names, sides in front: left_upper_arm.
        vertex_part: (n,) for each vertex an index into `parts`.
        face_part: (m,) for each face, likewise.
    """

    def __init__(self, mesh: Mesh, document: dict[str, Any], frame: Frame) -> None:
        self._mesh = mesh
        self._document = document
        self._frame = frame
        self.parts: tuple[str, ...] = tuple(document["parts"])
        self.vertex_part: IntArray = _fixed(np.array(document["vertex_part"], np.int32))
        self.face_part: IntArray = _fixed(np.array(document["face_part"], np.int32))

    def mask(self, part: str) -> npt.NDArray[np.bool_]:
        """(n,) which vertices are of that part.

        Raises:
            KeyError: there is no such part.

        >>> int(skelgen.segment("body.off").mask("left_hand").sum()) > 100
        True
        """
        if part not in self.parts:
            message = f"{part!r} is none of {', '.join(self.parts)}"
            raise KeyError(message)
        is_of_part: npt.NDArray[np.bool_] = self.vertex_part == self.parts.index(part)
        return is_of_part

    @property
    def colours(self) -> npt.NDArray[np.uint8]:
        """(n, 3) a colour for each vertex, 0 to 255: left blue to green, right yellow to red."""
        return _core.part_colours(list(self.parts))[self.vertex_part]

    def to_dict(self) -> dict[str, Any]:
        """The segmentation's file, as `skelgen segment` writes it.

        >>> skelgen.segment("body.off").to_dict()["format"]
        'skelgen-segmentation'
        """
        return dict(json.loads(json.dumps(self._document)))

    def save(self, path: PathLike) -> None:
        """Write .json, or .ply: coloured, with labels.

        Raises:
            ValueError: the name ends in none of these.
            OSError: it cannot be stored.

        >>> skelgen.segment("body.off").save("parts.ply")
        """
        suffix = Path(path).suffix
        if suffix == ".ply":
            labels = self.vertex_part.tolist(), self.face_part.tolist()
            _core.write_parts(Path(path), self._mesh.vertices, self._mesh.faces, list(self.parts), *labels)
        else:
            _save_json(path, self._document)

    def _repr_html_(self) -> str:
        """A picture for notebooks: the parts from the front, in their colours."""
        colours = [f"#{colour.tobytes().hex()}" for colour in _core.part_colours(list(self.parts))]
        surface = [(self._mesh.vertices[self.vertex_part == part], colour) for part, colour in enumerate(colours)]
        return picture(self, self._frame.axes, surface)

    def __repr__(self) -> str:
        return f"Segmentation({len(self.parts)} parts of {len(self.vertex_part)} vertices)"


class Measurements:
    """What is read off a body, in the mesh's own unit, its square and its cube.

    Attributes:
        height: of the body stood upright.
        arm_span: from fingertip to fingertip along the bones; None of an animal.
        area: of the surface.
        volume: enclosed by it.
        lengths: of bones, by name.
        girths: around the body as a tape lies, by name; None where no section shows it.
        girth_places: the plane of each girth, by its name: a place on it and its normal, (2, 3), in the mesh's
            coordinates; None likewise.
        unit: "m", "cm" or "mm", in which the body is as high as people are; None where it is so in none.
    """

    def __init__(self, document: dict[str, Any]) -> None:
        self._document = document
        body = document["bodies"][0]
        self.height: float = body["height"]
        self.arm_span: float | None = body.get("arm_span")
        self.area: float = body["area"]
        self.volume: float = body["volume"]
        self.lengths: dict[str, float] = dict(body["lengths"])
        self.girths: dict[str, float | None] = dict(body["girths"])
        self.girth_places: dict[str, FloatArray | None] = {
            name: None if plane is None else _fixed(np.array([plane["place"], plane["normal"]], float))
            for name, plane in body["girth_places"].items()
        }
        self.unit: str | None = body["unit"]["name"] if body["unit"] else None

    def to_dict(self) -> dict[str, Any]:
        """The measures' file, as `skelgen measure` writes it.

        >>> skelgen.measure("body.off").to_dict()["format"]
        'skelgen-measurements'
        """
        return dict(json.loads(json.dumps(self._document)))

    def row(self) -> dict[str, float | str | None]:
        """All of it, flat, as in the columns of `skelgen measure --csv`: a row for pandas.

        >>> round(skelgen.measure("body.off").row()["length_left_calf"], 2)
        0.41
        """
        return {
            "height": self.height,
            "arm_span": self.arm_span,
            "area": self.area,
            "volume": self.volume,
            **{f"length_{name}": value for name, value in self.lengths.items()},
            **{f"girth_{name}": value for name, value in self.girths.items()},
            "unit": self.unit,
        }

    def save(self, path: PathLike) -> None:
        """Write .json.

        Raises:
            ValueError: the name ends otherwise.
            OSError: it cannot be stored.

        >>> skelgen.measure("body.off").save("measures.json")
        """
        _save_json(path, self._document)

    def _repr_html_(self) -> str:
        """A table for notebooks."""
        cells = "".join(f"<tr><th>{name}</th><td>{_shown(value)}</td></tr>" for name, value in self.row().items())
        return f"<table>{cells}</table>"

    def __repr__(self) -> str:
        span = "" if self.arm_span is None else f"arm_span {self.arm_span:.4g}, "
        return f"Measurements(height {self.height:.4g}, {span}{len(self.girths)} girths)"


def _own(mesh: Mesh, sources: tuple[IntArray, IntArray]) -> tuple[IntArray, IntArray]:
    """The numbers of the vertices of the mesh that there are, and faces between these, of those that are a body's."""
    vertices, faces = sources
    if len(vertices) == 0:
        return np.arange(len(mesh.vertices), dtype=np.int32), mesh.faces
    return vertices, np.searchsorted(vertices, mesh.faces[faces]).astype(np.int32)


class Aligned(Mesh):
    """A body turned to +y up, facing +z.

    Attributes:
        matrix: (4, 4) from the mesh's coordinates to these, for columns (x, y, z, 1).
        source_vertices: (n,) which of the mesh's vertices each one is: all, but where one of several bodies was chosen.
    """

    def __init__(
        self, mesh: Mesh, matrix: FloatArray, vertices: FloatArray, sources: tuple[IntArray, IntArray]
    ) -> None:
        self.source_vertices, faces = _own(mesh, sources)
        super().__init__(vertices, faces, mesh.name)
        self.matrix = matrix

    def to_dict(self) -> dict[str, Any]:
        """The transform's file, as `skelgen align` writes it.

        >>> skelgen.align("body.off").to_dict()["format"]
        'skelgen-transform'
        """
        return dict(json.loads(_core.transform_to_json(self.matrix)))

    def _axes(self) -> FloatArray:
        return FRONT


class Posed(Mesh):
    """A body in another pose.

    Attributes:
        skeleton: where its joints went.
        source_vertices: (n,) which of the mesh's vertices each one is: all, but where one of several bodies was chosen.
    """

    def __init__(
        self, mesh: Mesh, vertices: FloatArray, turns: FloatArray, sources: tuple[IntArray, IntArray], skeleton: str
    ) -> None:
        self.source_vertices, faces = _own(mesh, sources)
        super().__init__(vertices, faces, mesh.name)
        self._scene, self._sources, self._turns = mesh._scene, sources, turns  # noqa: SLF001
        self.skeleton = Skeleton(skeleton)

    def _axes(self) -> FloatArray:
        return self.skeleton.frame.axes


class Rig:
    """A mesh bound to joints, in its rest pose: +y up, facing +z, standing on y = 0.

    Attributes:
        extraction: what it was made of.
        rest: the rest pose's name.
        vertices: (n, 3) in metres where the unit is known, in the mesh's order.
        faces: (m, 3), outwards.
        names: of the joints.
        parents: (j,) index of each joint's parent, -1 for the root.
        positions: (j, 3) of the joints in the rest pose.
        joints: (n, 4) the joints that move each vertex, the strongest first.
        weights: (n, 4) by how much; rows sum to 1.
        source_vertices: (n,) which of the mesh's vertices each one is: all, but where one of several bodies was chosen.
    """

    def __init__(
        self,
        extraction: Extraction,
        rest: str = "as-is",
        fingers: str = "auto",
        clips: tuple[Path, ...] = (),
        *,
        toes: bool = False,
    ) -> None:
        self.extraction = extraction
        self.rest = rest
        self._fingers = fingers
        self._toes = toes
        self._clips = clips
        scene = extraction._mesh._scene  # noqa: SLF001
        self._character = _core.make_rig(extraction._body, rest, fingers, toes, scene)  # noqa: SLF001
        for clip in clips:
            self._character = _core.animated(self._character, clip)
        self.vertices: FloatArray = self._character.vertices
        self.faces: IntArray = self._character.faces
        self.names: tuple[str, ...] = tuple(self._character.names)
        self.parents: IntArray = self._character.parents
        self.positions: FloatArray = self._character.positions
        self.joints: IntArray = self._character.joints
        self.weights: FloatArray = self._character.weights
        self.source_vertices, _ = _own(extraction._mesh, self._character.sources)  # noqa: SLF001

    @property
    def metres_per_unit(self) -> float:
        """What the mesh's coordinates were multiplied by; 1 where the unit is not known."""
        return self._character.metres_per_unit

    @property
    def animations(self) -> tuple[str, ...]:
        """The names of the motions that it has."""
        return tuple(self._character.animations)

    def animate(self, clip: PathLike) -> Rig:
        """The same character with one more motion, and without bones of the fingers.

        Args:
            clip: a BVH file, or an FBX, GLB, glTF, VRMA or DAE, whose first animation is followed.

        Raises:
            FileNotFoundError: there is no such file.
            ValueError: it is damaged, or its joints are not known as a body's.

        >>> walking = skelgen.extract("body.off").rig().animate("walk.bvh")
        >>> walking.animations
        ('walk',)
        """
        file = Path(clip)
        if not file.exists():
            message = f"{file}: there is no such file"
            raise FileNotFoundError(message)
        return Rig(self.extraction, self.rest, "off", (*self._clips, file))

    def save(self, path: PathLike, names: str = "skelgen") -> None:
        """Write .glb, .fbx, .vrm or .bvh, wholly or not at all; what moves only as .glb or .fbx.

        Args:
            path: the file.
            names: whose names the joints get: "skelgen", "smpl", "mixamo", "vrm", "unity", "godot", "unreal", ..., as
                `skelgen rig --names` has them.

        Raises:
            ValueError: there are no such names, the file's name ends in none of these, or the rest pose is not what
                VRM wants.
            OSError: it cannot be stored.

        >>> skelgen.rig("body.off").save("body.glb", names="mixamo")
        """
        _core.write_character(self._character, Path(path), names)

    def _repr_html_(self) -> str:
        """A picture for notebooks: the character at rest."""
        return picture(self, FRONT, [(self.vertices, GREY)], self.positions, bones_of(self.parents), self.names)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled as what it was made of."""
        made_of = (self.extraction, self.rest, self._fingers, self._clips)
        return partial(type(self), toes=self._toes), made_of

    def __repr__(self) -> str:
        moving = f", moving: {', '.join(self.animations)}" if self.animations else ""
        return f"Rig({len(self.names)} joints, {len(self.vertices)} vertices, {self.rest}{moving})"


class Correspondence:
    """Which place of one body is which of another one.

    Attributes:
        vertex_to_vertex: (n,) for each vertex of the first one a vertex of the second.
        vertex_to_face: (n,) and a face of the second that its place is on,
        corners: (n, 3) the vertices of that face,
        weights: (n, 3) and by how much each of them counts, 1 in all: the place is their mean.
        confidence: (n,) how sure, 0 to 1.
        landmarks: places that stand out, by the part that they are on: a vertex of each body.
    """

    def __init__(self, document: dict[str, Any], faces: IntArray) -> None:
        self._document = document
        self.vertex_to_vertex: IntArray = _fixed(np.array(document["vertex_to_vertex"], np.int32))
        self.vertex_to_face: IntArray = _fixed(np.array(document["vertex_to_face"], np.int32))
        self.corners: IntArray = _fixed(faces[self.vertex_to_face])
        self.weights: FloatArray = _fixed(np.array(document["face_weights"], float))
        self.confidence: FloatArray = _fixed(np.array(document["confidence"], float))
        self.landmarks: dict[str, tuple[int, int]] = {
            mark["name"]: (mark["from"], mark["to"]) for mark in document["landmarks"]
        }

    def transfer(self, values: npt.ArrayLike, *, smooth: bool = False) -> npt.NDArray[Any]:
        """What the second body has at each of its vertices (colours, texture coordinates, ...), for the first one's.

        Args:
            values: (vertices of the second body, ...).
            smooth: whether values are mixed between vertices, or each is one of those given.

        Raises:
            ValueError: there are not as many values as vertices.

        >>> body = skelgen.extract("body.off")
        >>> body.correspond(body).transfer(body.vertices, smooth=True).shape
        (6890, 3)
        """
        array = np.asarray(values)
        if array.ndim == 0 or len(array) != self._document["to"]["vertices"]:
            message = f"values: an array of shape {array.shape}; there are {self._document['to']['vertices']} vertices"
            raise ValueError(message)
        carried: npt.NDArray[Any] = array[self.vertex_to_vertex]
        if smooth:
            carried = np.einsum("nc,nc...->n...", self.weights, array[self.corners])
        return carried

    def to_dict(self) -> dict[str, Any]:
        """The correspondence's file, as `skelgen correspond --confidence --places` writes it.

        >>> skelgen.correspond("body.off", "body.off").to_dict()["format"]
        'skelgen-correspondence'
        """
        return dict(json.loads(json.dumps(self._document)))

    def save(self, path: PathLike) -> None:
        """Write .json.

        Raises:
            ValueError: the name ends otherwise.
            OSError: it cannot be stored.

        >>> skelgen.correspond("body.off", "body.off").save("map.json")
        """
        _save_json(path, self._document)

    def __repr__(self) -> str:
        return f"Correspondence({len(self.vertex_to_vertex)} vertices, confidence {self.confidence.mean():.2f})"


def extract(  # noqa: PLR0913
    mesh: MeshLike,
    faces: npt.ArrayLike | None = None,
    *,
    template: PathLike = "human21",
    fingers: str = "off",
    toes: bool = False,
    component: int = 0,
    threads: int = 1,
    name: str | None = None,
) -> Extraction:
    """Find the skeleton of one human body: any pose, orientation and unit.

    Args:
        mesh: vertices (n, 3), an object that has vertices and faces (trimesh, Open3D, PyVista, meshio), or a path.
            C-contiguous float64 is read where it is; other numbers are converted.
        faces: (m, 3) vertex indices, where `mesh` has none. int32 is read where it is.
        template: a built-in template's name, or a template's file; "human51" is human21 with fingers, "quadruped" a
            four-legged animal's, "auto" a person's or an animal's, whichever is likelier.
        fingers: joints of the fingers: "off", "on" or "auto" (where the surface shows some).
        toes: also joints of the single toes, where the surface shows them.
        component: which of several bodies that stand apart, 1 for the largest; 0: there must be one alone.
        threads: that work on it; the result does not depend on their number.
        name: what results call the mesh; by default its file's name, or "mesh".

    Raises:
        ValueError: an argument makes no sense (the message names it, and its shape), or the mesh is no surface.
        FileNotFoundError: there is no such file.
        NoSkeletonError: no body can be found in the mesh.

    >>> body = skelgen.extract("body.off")
    >>> body
    Extraction('body.off', human21: 21 joints, sides_confidence 0.98)
    >>> body.positions.shape, body.names[:2]
    ((21, 3), ('crotch', 'waist'))
    """
    return Extraction(as_mesh(mesh, faces, name=name), template, fingers, toes, component, threads)


def _checked(
    template: PathLike,
    fingers: str,
    toes: bool,  # noqa: FBT001
    component: int,
    threads: int,
) -> tuple[str, str, bool, int, int]:
    for name, value, kind, what in (
        ("template", template, (str, os.PathLike), "a template's name or file"),
        ("fingers", fingers, str, '"off", "on" or "auto"'),
        ("toes", toes, bool, "True or False"),
        ("component", component, SupportsIndex, "a whole number"),
        ("threads", threads, SupportsIndex, "a whole number"),
    ):
        if not isinstance(value, kind):
            message = f"{name}: {value!r} is not {what}"
            raise TypeError(message)
    return os.fspath(template), fingers, toes, component, threads


def _found(mesh: MeshLike, faces: npt.ArrayLike | None = None, **options: Any) -> Extraction:  # noqa: ANN401
    return mesh if isinstance(mesh, Extraction) and not options else extract(mesh, faces, **options)


def segment(
    mesh: MeshLike,
    faces: npt.ArrayLike | None = None,
    *,
    parts: str = "bones",
    **options: Any,  # noqa: ANN401
) -> Segmentation:
    """`extract` and `Extraction.segment`, which say more; options as `extract` has them.

    >>> skelgen.segment("body.off", parts="body").parts[:2]
    ('head', 'torso')
    """
    return _found(mesh, faces, **options).segment(parts)


def measure(mesh: MeshLike, faces: npt.ArrayLike | None = None, **options: Any) -> Measurements:  # noqa: ANN401
    """`extract` and `Extraction.measure`, which say more; options as `extract` has them.

    >>> skelgen.measure("body.off").unit
    'm'
    """
    return _found(mesh, faces, **options).measure()


def align(
    mesh: MeshLike,
    faces: npt.ArrayLike | None = None,
    *,
    origin: str = "crotch",
    scale: bool = False,
    **options: Any,  # noqa: ANN401
) -> Aligned:
    """`extract` and `Extraction.align`, which say more; options as `extract` has them.

    >>> skelgen.align("body.off", origin="floor").save("aligned.ply")
    """
    return _found(mesh, faces, **options).align(origin, scale=scale)


def rig(
    mesh: MeshLike,
    faces: npt.ArrayLike | None = None,
    *,
    rest: str = "as-is",
    fingers: str = "auto",
    toes: bool = False,
    **options: Any,  # noqa: ANN401
) -> Rig:
    """`extract` and `Extraction.rig`, which say more; options as `extract` has them, but `fingers` and `toes`.

    >>> skelgen.rig("body.off", rest="t-pose").save("body.vrm")
    """
    return _found(mesh, faces, **options).rig(rest, fingers=fingers, toes=toes)


def pose(mesh: MeshLike, faces: npt.ArrayLike | None = None, *, like: MeshLike, **options: Any) -> Posed:  # noqa: ANN401
    """`extract` and `Extraction.pose`, which say more; options as `extract` has them.

    >>> skelgen.pose("body.off", like="body.json").save("posed.ply")
    """
    return _found(mesh, faces, **options).pose(like)


@overload
def correspond(
    template: MeshLike, bodies: list[Any] | set[Any] | tuple[PathLike | Mesh | Skeleton, ...] | Iterator[Any]
) -> Iterator[Correspondence]: ...
@overload
def correspond(template: MeshLike, bodies: MeshLike) -> Correspondence: ...
def correspond(template: MeshLike, bodies: MeshLike) -> Correspondence | Iterator[Correspondence]:
    """For each vertex of one body the same place on another one, or on each of many.

    Args:
        template: the body whose vertices are looked for; found once.
        bodies: another body, or a list, set or iterator of them, or a tuple of paths or bodies: then an iterator of
            results, one after the other.

    Raises:
        ValueError, NoSkeletonError: as `extract`, of each body. To go on after one that fails, call
            `Extraction.correspond` for each.

    >>> [found.confidence.shape for found in skelgen.correspond("body.off", ["body.off"])]
    [(6890,)]
    """
    found = _found(template)
    is_pair = isinstance(bodies, tuple) and not any(
        is_path(body) or isinstance(body, (Mesh, Skeleton)) for body in bodies
    )
    if hasattr(bodies, "__next__") or (isinstance(bodies, (list, set, tuple)) and not is_pair):
        return (found.correspond(body) for body in bodies)
    return found.correspond(bodies)


def _shown(value: float | str | None) -> str:
    return f"{value:.4g}" if isinstance(value, float) else value or "not known"


def _save_json(path: PathLike, document: dict[str, Any]) -> None:
    if Path(path).suffix != ".json":
        message = f"{path}: its name must end in .json"
        raise ValueError(message)
    _core.write_text(Path(path), json.dumps(document) + "\n")
