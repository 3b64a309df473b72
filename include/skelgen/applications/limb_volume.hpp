#pragma once

#include <vector>

#include <skelgen/core/mesh.hpp>
#include <skelgen/core/precision.hpp>

namespace skelgen::applications {

/// The faces whose corners follow a joint most: `strongest` per vertex the joint that it follows most. O(faces).
[[nodiscard]] Triangles faces_following(const Triangles& faces, const std::vector<int>& strongest, int joint);

/// Of the connected pieces of a part of a surface the one that surrounds a bone most: a limb's own skin, or the sleeve
/// that stands for it. Half a skirt and a shield follow bones, too, but what they hold with their rims closed is no
/// volume of a limb. None of them surrounds it: none. O(vertices + faces log faces).
[[nodiscard]] Triangles around_bone(const Points<core::Accumulator>& vertices, const Triangles& part,
                                    const Vector3<core::Accumulator>& from, const Vector3<core::Accumulator>& to);

/// Volume of a part of a surface, each rim of which is closed by a fan around its middle, cube of the vertices' unit;
/// negative where faces look inwards. Edges count as often as faces run along them one way more than the other: where
/// sheets meet in an edge, or faces lie twice, all is closed, too, and what moves rigidly keeps its volume.
/// O(vertices + faces log faces).
[[nodiscard]] core::Accumulator closed_volume(const Points<core::Accumulator>& vertices, const Triangles& part);

} // namespace skelgen::applications

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/applications/impl/limb_volume.hpp>
#endif
