#pragma once

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/curve/contraction.hpp>
#include <skelgen/curve/leaf_extension.hpp>
#include <skelgen/curve/proxy.hpp>
#include <skelgen/curve/pruning.hpp>
#include <skelgen/curve/surgery.hpp>
#include <skelgen/surface/body.hpp>

/// From a body to its curve skeleton (LF20 section 3.1, after Au08): a thin graph along the middle of trunk and limbs.
namespace skelgen::curve {

/// Constants of every step from body to curve skeleton.
struct CurveOptions {
    ProxyOptions proxy;
    ContractionOptions contraction;
    SurgeryOptions surgery;
    LeafExtensionOptions leaves;
    PruningOptions pruning;
};

/// \throws Error usage when an option is out of its range.
void validate(const CurveOptions& options);

/// A curve skeleton, and whether the contraction that it comes from came to its end.
template <typename Scalar = double>
struct CurveResult {
    CurveSkeleton<Scalar> curve; ///< in the body's coordinates; regions of the body's vertices
    bool converged = false;      ///< if not, the curve may leave the middle of the body: see Contraction
    int iterations = 0;          ///< of the contraction
    Scalar volume_ratio = 1;     ///< enclosed volume that the contraction left, relative to the start's
};

/// The curve skeleton of a body, in eight steps, each of them public on its own:
/// 1. build_proxy: a well-shaped mesh of about 3000 vertices that stands in for the body;
/// 2. contract: it shrinks towards its medial axis until next to no volume is left;
/// 3. connectivity_surgery: edges collapse until no face is left, only a graph;
/// 4. centre_nodes: its nodes move back to the middle of the surface that collapsed into them;
/// 5. spread_regions: the proxy's vertices hand their nodes on to the body's;
/// 6. extend_leaves: the curve grows to the ends of the limbs, on the surface;
/// 7. prune: fingers, ears, heels and other short branches go;
/// 8. place_limb_ends: what lies beside an end gets inside.
///
/// O(n log n) and the cost of contracting the proxy. \throws Error usage when an option is out of its range; else as
/// the steps do.
template <typename Scalar>
[[nodiscard]] CurveResult<Scalar> find_curve(const Body<Scalar>& body, const CurveOptions& options = {});

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/find_curve.hpp>
#endif
