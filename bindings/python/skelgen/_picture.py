"""Pictures for notebooks: SVG, for which no other library is needed."""

from __future__ import annotations

import html
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ._mesh import FloatArray, IntArray

GREY = "#c8c8c8"
DARK = "#444"
FRONT = np.array([[1.0, 0, 0], [0, -1, 0]])  # of what has +y up and faces +z
_SHOWN_POINTS = 2500
_HEIGHT = 360.0
_MARGIN = 10.0


def side_colour(name: str) -> str:
    """Left blue, right yellow."""
    return "#3b6fd4" if name.startswith("left_") else "#d4a017" if name.startswith("right_") else DARK


def widest_axes(points: FloatArray) -> FloatArray:
    """Where no frame is known: the coordinate axis along which most of it lies upwards, the next one to the right."""
    _, across, up = np.argsort(np.ptp(points, axis=0), kind="stable")
    return np.stack([np.eye(3)[across], -np.eye(3)[up]])


def picture(  # noqa: PLR0913
    result: object,
    axes: FloatArray,
    surface: Iterable[tuple[FloatArray, str]] = (),
    joints: FloatArray | None = None,
    bones: Iterable[tuple[int, int]] = (),
    names: Iterable[str] = (),
) -> str:
    """A figure of a result, with its `repr` below.

    Args:
        result: what is shown.
        axes: (2, 3) to the right and downwards.
        surface: points (n, 3) with their colour; of many some are drawn.
        joints: (j, 3), NaN for what is not there.
        bones: pairs of joints.
        names: of the joints, which get dots and the colours of their sides; without them lines are drawn alone.
    """
    clouds = [(points @ axes.T, colour) for points, colour in surface]
    places = np.empty((0, 2)) if joints is None else joints @ axes.T
    everything = np.concatenate([places, *(points for points, _ in clouds)])
    low, high = np.nanmin(everything, axis=0), np.nanmax(everything, axis=0)
    scale = _HEIGHT / max(float((high - low).max()), 1e-300)
    step = 1 + sum(len(points) for points, _ in clouds) // _SHOWN_POINTS

    def at(place: Any) -> str:  # noqa: ANN401
        x, y = (place - low) * scale + _MARGIN
        return f"{x:.1f} {y:.1f}"

    width, tall = ((high - low) * scale + 2 * _MARGIN).round()
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{tall:.0f}" role="img">']
    for points, colour in clouds:
        dots = "".join(f"M{at(point)}h0" for point in points[::step])
        parts.append(f'<path d="{dots}" stroke="{colour}" stroke-width="2" stroke-linecap="round"/>')
    known = list(names)
    for a, b in bones:
        if not np.isnan(places[[a, b]]).any():
            colour = side_colour(known[b]) if known else DARK
            parts.append(f'<path d="M{at(places[a])}L{at(places[b])}" stroke="{colour}" stroke-width="3"/>')
    for name, place in zip(known, places, strict=False):
        if not np.isnan(place).any():
            x, y = at(place).split()
            title = f"<title>{html.escape(name)}</title>"
            parts.append(f'<circle cx="{x}" cy="{y}" r="4" fill="{side_colour(name)}">{title}</circle>')
    return f"<figure>{''.join(parts)}</svg><figcaption>{html.escape(repr(result))}</figcaption></figure>"


def bones_of(parents: IntArray) -> list[tuple[int, int]]:
    """Each joint with its parent."""
    return [(parent, joint) for joint, parent in enumerate(parents.tolist()) if parent >= 0]
