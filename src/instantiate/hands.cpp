// The hands compiled once, for float and double.

#include <skelgen/hands/impl/digit_tubes.hpp>
#include <skelgen/hands/impl/find_hands.hpp>
#include <skelgen/hands/impl/hand_surface.hpp>
#include <skelgen/hands/impl/phalanges.hpp>
#include <skelgen/hands/impl/phalanx_fit.hpp>

namespace skelgen::hands {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template std::optional<HandPlace<Scalar>> hand_place(const KinematicSkeleton<Scalar>&, Side);                      \
    template std::optional<HandPlace<Scalar>> toes_place(const KinematicSkeleton<Scalar>&, Side);                      \
    template std::optional<HandSurface<Scalar>> hand_surface(const TriangleMesh<Scalar>&, const HandPlace<Scalar>&);   \
    template std::optional<TriangleMesh<Scalar>> arm_pieces(const TriangleMesh<Scalar>&, const HandPlace<Scalar>&);    \
    template std::optional<HandSurface<Scalar>> own_hand_surface(const TriangleMesh<Scalar>&,                          \
                                                                 const HandPlace<Scalar>&);                            \
    template TriangleMesh<Scalar> hand_envelope(const TriangleMesh<Scalar>&, const surface::WindingTree<Scalar>&,      \
                                                const HandPlace<Scalar>&);                                             \
    template std::vector<DigitTube<Scalar>> find_tubes(const HandSurface<Scalar>&, const HandPlace<Scalar>&,           \
                                                       const DigitBounds&);                                            \
    template PhalanxChain<Scalar> fit_phalanges(const DigitTube<Scalar>&, PhalanxChain<Scalar>,                        \
                                                const ExpectedPhalanges<Scalar>&);                                     \
    template std::vector<FoundDigit<Scalar>> name_digits(const std::vector<DigitTube<Scalar>>&,                        \
                                                         const HandPlace<Scalar>&, Side);                              \
    template std::vector<FoundDigit<Scalar>> name_toes(const std::vector<DigitTube<Scalar>>&,                          \
                                                       const HandPlace<Scalar>&, Side, const Vector3<Scalar>&);        \
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
