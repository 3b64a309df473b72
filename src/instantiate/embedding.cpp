// The embedding compiled once, for float and double.

#include <skelgen/embedding/impl/embed.hpp>
#include <skelgen/embedding/impl/missing_limbs.hpp>
#include <skelgen/embedding/impl/reduced_graph.hpp>
#include <skelgen/embedding/impl/spectral_matching.hpp>

namespace skelgen::embedding {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template ReducedGraph<Scalar> reduce(const CurveSkeleton<Scalar>&);                                                \
    template ReducedGraph<Scalar> reduce<Scalar>(const SkeletonTemplate&);                                             \
    template Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> affinity_matrix(                                    \
        const ReducedGraph<Scalar>&, const ReducedGraph<Scalar>&, const MatchingOptions&);                             \
    template std::vector<int> spectral_assignment(const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>&, int);  \
    template Scalar distortion(const ReducedGraph<Scalar>&, const ReducedGraph<Scalar>&, const std::vector<int>&,      \
                               const MatchingOptions&);                                                                \
    template std::vector<int> descend(const ReducedGraph<Scalar>&, const ReducedGraph<Scalar>&, std::vector<int>,      \
                                      const MatchingOptions&);                                                         \
    template Assignment least_distorted(const ReducedGraph<Scalar>&, const ReducedGraph<Scalar>&, std::vector<int>,    \
                                        const MatchingOptions&);                                                       \
    template Outcome<Embedding> embed(const CurveSkeleton<Scalar>&, const SkeletonTemplate&, const MatchingOptions&);  \
    template Scalar unmatched_reach(const CurveSkeleton<Scalar>&, const Embedding&);                                   \
    template Scalar matched_diameter(const CurveSkeleton<Scalar>&, const Embedding&);                                  \
    template std::vector<LaidTemplate> without_a_limb(const CurveSkeleton<Scalar>&, const SkeletonTemplate&,           \
                                                      std::size_t, const MatchingOptions&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::embedding
