// The surface stage, compiled once for each scalar.

#include <skelgen/surface/impl/body.hpp>
#include <skelgen/surface/impl/canonical_form.hpp>
#include <skelgen/surface/impl/cut_surface.hpp>
#include <skelgen/surface/impl/denoise.hpp>
#include <skelgen/surface/impl/manifold_parts.hpp>
#include <skelgen/surface/impl/prepare.hpp>

namespace skelgen::surface {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template Scalar bulge_coherence(const TriangleMesh<Scalar>&);                                                      \
    template DenoisedMesh<Scalar> remove_noise(TriangleMesh<Scalar>, const DenoiseOptions&);                           \
    template CanonicalMesh<Scalar> canonical_form(const TriangleMesh<Scalar>&);                                        \
    template ManifoldParts<Scalar> largest_manifold_part(const TriangleMesh<Scalar>&);                                 \
    template CutSurface<Scalar> cut_surface(const TriangleMesh<Scalar>&, const std::vector<int>&,                      \
                                            const std::vector<int>&);                                                  \
    template Body<Scalar> make_body(TriangleMesh<Scalar>, const Similarity<Scalar>&, std::vector<int>, int);           \
    template CurveSkeleton<Scalar> to_input(const Body<Scalar>&, const CurveSkeleton<Scalar>&);                        \
    template KinematicSkeleton<Scalar> to_input(const Body<Scalar>&, const KinematicSkeleton<Scalar>&);                \
    template Body<Scalar> prepare(const TriangleMesh<Scalar>&, const PrepareOptions&);

SKELGEN_INSTANTIATE(float)
SKELGEN_INSTANTIATE(double)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::surface
