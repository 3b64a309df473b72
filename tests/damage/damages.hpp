#pragma once

// The damages, one function each; kinds.cpp says what they are called.

#include "kinds.hpp"

namespace skelgen::damage {

// winding.cpp
[[nodiscard]] Mesh inside_out(const Subject& subject); ///< all faces look inwards
[[nodiscard]] Mesh flipped(const Subject& subject);    ///< 30 % of the faces, anywhere, look inwards
[[nodiscard]] Mesh mirrored(const Subject& subject);   ///< x becomes -x; faces look outwards all the same

// connectivity.cpp
[[nodiscard]] Mesh triangle_soup(const Subject& subject); ///< each face has three vertices of its own
[[nodiscard]] Mesh six_charts(const Subject& subject);    ///< split at seams into six pieces with their own vertices
[[nodiscard]] Mesh
duplicates(const Subject& subject); ///< 5 % of the vertices are two, 10 % of the faces are there twice
[[nodiscard]] Mesh degenerate(const Subject& subject); ///< faces without area: points, segments, needles
[[nodiscard]] Mesh fins(const Subject& subject);       ///< triangles that stick out of 2 % of the edges

// nonsense.cpp
// What is no surface any more, or none that can be reckoned with.
[[nodiscard]] Mesh random_faces(const Subject& subject); ///< as many faces, each between three random vertices
[[nodiscard]] Mesh scrambled(const Subject& subject);    ///< the same faces, the vertices in random order
[[nodiscard]] Mesh fan(const Subject& subject);          ///< the first corner of every face is the same vertex
[[nodiscard]] Mesh tiny(const Subject& subject);         ///< scaled by 1e-160: squares of lengths vanish
[[nodiscard]] Mesh huge(const Subject& subject);         ///< scaled by 1e150: volumes are no numbers

// losses.cpp
[[nodiscard]] Mesh faces_gone(const Subject& subject); ///< 5 % of the faces, anywhere
[[nodiscard]] Mesh holes(const Subject& subject);      ///< five, of 1 % of the area each

// noise.cpp
// Every vertex moves by a normally distributed amount in each direction; the root mean square of its way is this part
// of the bounding box's diagonal.
[[nodiscard]] Mesh noise_1(const Subject& subject); ///< 1 %
[[nodiscard]] Mesh noise_2(const Subject& subject); ///< 2 %

// surroundings.cpp
[[nodiscard]] Mesh far_unused(const Subject& subject);  ///< ten vertices 100 body lengths away that no face uses
[[nodiscard]] Mesh far_100(const Subject& subject);     ///< one vertex 100 body lengths away, corner of one face
[[nodiscard]] Mesh far_1000(const Subject& subject);    ///< 1000 body lengths
[[nodiscard]] Mesh floating(const Subject& subject);    ///< ten patches of the surface doubled somewhere off it
[[nodiscard]] Mesh plate_apart(const Subject& subject); ///< a plate under the feet that does not touch them
[[nodiscard]] Mesh two_bodies(const Subject& subject);  ///< the body and, beside it, a copy

// grown_plate.cpp
[[nodiscard]] Mesh plate_grown(const Subject& subject); ///< a plate and the body as one closed surface

// parts.cpp
[[nodiscard]] Mesh inner_walls(const Subject& subject); ///< a wall across every limb, at each cut of `cut_limbs`
[[nodiscard]] Mesh parts_14(const Subject& subject);    ///< 14 closed parts that reach into each other
[[nodiscard]] Mesh parts_4(const Subject& subject);     ///< likewise head, trunk with arms, two legs

// missing.cpp
// Limbs cut off at the cuts of `cut_limbs`; the surface is open there.
[[nodiscard]] Mesh no_hands(const Subject& subject); ///< both
[[nodiscard]] Mesh no_feet(const Subject& subject);  ///< both
[[nodiscard]] Mesh no_arm(const Subject& subject);   ///< the left one
[[nodiscard]] Mesh no_leg(const Subject& subject);   ///< the left one
[[nodiscard]] Mesh no_head(const Subject& subject);
[[nodiscard]] Mesh front_half(const Subject& subject); ///< the faces that look forward, as one camera sees a body

// resolution.cpp
[[nodiscard]] Mesh faces_3000(const Subject& subject);
[[nodiscard]] Mesh faces_1000(const Subject& subject);
[[nodiscard]] Mesh faces_500(const Subject& subject);
[[nodiscard]] Mesh faces_400000(const Subject& subject); ///< the same surface, cut finer

} // namespace skelgen::damage
