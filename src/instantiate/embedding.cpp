// The embedding compiled once, for float and double.

#include <skelgen/embedding/impl/embed.hpp>
#include <skelgen/embedding/impl/loop_cuts.hpp>
#include <skelgen/embedding/impl/proportions.hpp>
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
    template std::vector<bool> matched_or_hidden(const CurveSkeleton<Scalar>&, const Embedding&);                      \
    template Scalar unmatched_reach(const CurveSkeleton<Scalar>&, const Embedding&);                                   \
    template Scalar matched_diameter(const CurveSkeleton<Scalar>&, const Embedding&);                                  \
    template Scalar unmatched_share(const CurveSkeleton<Scalar>&, const Embedding&);                                   \
    template int contact_count(const CurveSkeleton<Scalar>&);                                                          \
    template std::vector<LoopCuts> find_loop_cuts(const CurveSkeleton<Scalar>&, const SkeletonTemplate&,               \
                                                  const MatchingOptions&);                                             \
    template Proportions proportions_of(const CurveSkeleton<Scalar>&, const Embedding&, const SkeletonTemplate&);      \
    template bool legs_go_on(const CurveSkeleton<Scalar>&, const Embedding&, const SkeletonTemplate&);                 \
    template Outcome<FittingTemplate> fitting_proportions(const CurveSkeleton<Scalar>&, const SkeletonTemplate&,       \
                                                          const MatchingOptions&);                                     \
    template std::vector<FittingTemplate> other_fitting_templates(                                                     \
        const CurveSkeleton<Scalar>&, const SkeletonTemplate&, std::size_t, const MatchingOptions&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::embedding
