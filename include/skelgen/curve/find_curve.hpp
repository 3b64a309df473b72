#pragma once

#include <memory>
#include <vector>

#include <skelgen/core/curve_skeleton.hpp>
#include <skelgen/curve/branch_centring.hpp>
#include <skelgen/curve/contraction.hpp>
#include <skelgen/curve/leaf_extension.hpp>
#include <skelgen/curve/proxy.hpp>
#include <skelgen/curve/pruning.hpp>
#include <skelgen/curve/surgery.hpp>
#include <skelgen/surface/body.hpp>

/// From a body to its curve skeleton (LF20 section 3.1, after Au08): a thin graph along the middle of trunk and limbs.
namespace skelgen::curve {

/// Which branches a curve has.
enum class Detail {
    limbs,  ///< trunk and limbs: five ends on a body; lengths as LF20 prunes them
    digits, ///< also fingers, tails, horns, table legs
    all     ///< everything that sticks out of what it is part of
};

/// Constants of every step from body to curve skeleton.
struct CurveOptions {
    Detail detail = Detail::limbs; ///< finer ones put numbers of their own in place of the proxy's size, the pruning's
                                   ///< lengths and the centring's relief
    ProxyOptions proxy;
    ContractionOptions contraction;
    SurgeryOptions surgery;
    LeafExtensionOptions leaves;
    PruningOptions pruning;
    BranchCentringOptions centring;
    bool is_draft = false; ///< only roughly in the middle, without regions: see centre_roughly
};

/// \throws Error usage when an option is out of its range.
void validate(const CurveOptions& options);

/// What a contraction leaves of a body: branches before they are laid into the middle of the surface.
template <typename Scalar = double>
struct ContractedCurve {
    BranchedCurve<Scalar> branched;
    std::vector<int> origin_of_vertex; ///< per vertex of the body, among the origins of the branches
    BranchCentringOptions centring;    ///< how they are to be laid there
};

/// A curve skeleton, and whether the contraction that it comes from came to its end.
template <typename Scalar = double>
struct CurveResult {
    CurveSkeleton<Scalar> curve; ///< in the body's coordinates; regions of the body's vertices
    bool converged = false;      ///< if not, the curve may leave the middle of the body: see Contraction
    int iterations = 0;          ///< of the contraction
    Scalar volume_ratio = 1;     ///< enclosed volume that the contraction left, relative to the start's
    bool is_point = false;       ///< too compact for a curve, as a ball is: its only node is the centre
    bool is_draft = false;       ///< as the options have it
    std::shared_ptr<const ContractedCurve<Scalar>>
        contracted; ///< of the body, to be finished; none in a curve in input coordinates
};

/// The curve skeleton of a body, in eight steps, each of them public on its own:
/// 1. build_proxy: a well-shaped mesh of about 3000 vertices that stands in for the body;
/// 2. contract: it shrinks towards its medial axis until next to no volume is left;
/// 3. connectivity_surgery: edges collapse until no face is left, only a graph; centre_nodes: its nodes move back to
///    where the surface lay that collapsed into them;
/// 4. nearest_of_proxy, spread_regions: the proxy's vertices hand their nodes on to the body's;
/// 5. extend_leaves: the curve grows to the ends of the limbs, on the surface;
/// 6. prune: short branches go, as the detail asks;
/// 7. centre_branches: the branches that are left are laid into the middle of the surface, section by section;
/// 8. curve_with_regions: every node gets its radius and its part of the surface.
///
/// O(n log n) and the cost of contracting the proxy. \throws Error usage when an option is out of its range; else as
/// the steps do.
template <typename Scalar>
[[nodiscard]] CurveResult<Scalar> find_curve(const Body<Scalar>& body, const CurveOptions& options = {});

/// A draft made a whole curve; others as they are. \throws Error as find_curve.
template <typename Scalar>
[[nodiscard]] CurveResult<Scalar> finished(CurveResult<Scalar> found, const Body<Scalar>& body);

} // namespace skelgen::curve

#ifdef SKELGEN_HEADER_ONLY
#include <skelgen/curve/impl/find_curve.hpp>
#endif
