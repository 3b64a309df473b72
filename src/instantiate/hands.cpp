// The hands compiled once, for float and double.

#include <skelgen/hands/impl/find_hands.hpp>

namespace skelgen::hands {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template std::vector<Hand<Scalar>> find_feet(const TriangleMesh<Scalar>&, const Body<Scalar>&,                     \
                                                 const KinematicSkeleton<Scalar>&);                                    \
    template KinematicSkeleton<Scalar> with_toes(KinematicSkeleton<Scalar>, const std::vector<Hand<Scalar>>&);         \
    template std::vector<Hand<Scalar>> find_hands(const TriangleMesh<Scalar>&, const Body<Scalar>&,                    \
                                                  const KinematicSkeleton<Scalar>&);                                   \
    template KinematicSkeleton<Scalar> with_digits(KinematicSkeleton<Scalar>, const std::vector<Hand<Scalar>>&);       \
    template KinematicSkeleton<Scalar> without_digits(KinematicSkeleton<Scalar>);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::hands
