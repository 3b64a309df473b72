#pragma once

#include <skelgen/core/mesh.hpp>

namespace skelgen::surface {

/// Constants of envelopes.
struct EnvelopeOptions {
    double cells = 200;       ///< along the longest side of what is enveloped; limbs apart by two cells stay apart
    int most_faces = 80'000;  ///< about; where there would be more, cells are larger: a person has 50 to 70 thousand
    int smoothing_passes = 4; ///< so that cells do not show (Tau95)
};

/// \throws Error usage when an option is out of its range.
void validate(const EnvelopeOptions& options);

/// One closed surface around all that some pieces enclose together: where their winding number is one half (JKS13,
/// BDSLJ18). Pieces that overlap become one, holes are closed by a skin, what is inside another one is gone; gaps of
/// two cells and more stay open. The pieces must look outwards. May consist of several closed parts and hollows; empty
/// when the pieces enclose nothing. Any unit. O(faces log faces + cells^2 log faces). \throws Error usage when an
/// option is out of its range.
template <typename Scalar>
[[nodiscard]] TriangleMesh<Scalar> winding_envelope(const TriangleMesh<Scalar>& mesh,
                                                    const EnvelopeOptions& options = {});

} // namespace skelgen::surface

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/surface/impl/envelope.hpp>
#endif
