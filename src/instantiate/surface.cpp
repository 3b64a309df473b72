// The surface stage, compiled once for each scalar.

#include <skelgen/surface/impl/body.hpp>
#include <skelgen/surface/impl/canonical_form.hpp>
#include <skelgen/surface/impl/clean.hpp>
#include <skelgen/surface/impl/contours.hpp>
#include <skelgen/surface/impl/denoise.hpp>
#include <skelgen/surface/impl/envelope.hpp>
#include <skelgen/surface/impl/face_tree.hpp>
#include <skelgen/surface/impl/lattice_surface.hpp>
#include <skelgen/surface/impl/manifold_parts.hpp>
#include <skelgen/surface/impl/open_handles.hpp>
#include <skelgen/surface/impl/pieces.hpp>
#include <skelgen/surface/impl/pockets.hpp>
#include <skelgen/surface/impl/prepare.hpp>
#include <skelgen/surface/impl/rounded.hpp>
#include <skelgen/surface/impl/unpaired_pieces.hpp>
#include <skelgen/surface/impl/vertex_clusters.hpp>
#include <skelgen/surface/impl/weld.hpp>
#include <skelgen/surface/impl/winding_tree.hpp>

namespace skelgen::surface {

#define SKELGEN_INSTANTIATE(Scalar)                                                                                    \
    template class FaceTree<Scalar>;                                                                                   \
    template Scalar distance_to_triangle(const Vector3<Scalar>&, const Vector3<Scalar>&, const Vector3<Scalar>&,       \
                                         const Vector3<Scalar>&);                                                      \
    template class LevelSets<Scalar>;                                                                                  \
    template PlanarRelation<Scalar> relate(const Contour<Scalar>&, const Vector3<Scalar>&, const Vector3<Scalar>&);    \
    template std::optional<ContourAround<Scalar>> contour_around(const TriangleMesh<Scalar>&, const Triangles&,        \
                                                                 const FaceTree<Scalar>&, const Vector3<Scalar>&,      \
                                                                 const Vector3<Scalar>&, Scalar);                      \
    template Eigen::AlignedBox<Scalar, 3> robust_box(const TriangleMesh<Scalar>&);                                     \
    template std::optional<Triangles> faces_within_reach(const TriangleMesh<Scalar>&,                                  \
                                                         const Eigen::AlignedBox<Scalar, 3>&);                         \
    template Welding find_welds(const TriangleMesh<Scalar>&, Scalar, const std::vector<bool>&);                        \
    template WeldedMesh<Scalar> weld(const TriangleMesh<Scalar>&, Welding);                                            \
    template WeldedMesh<Scalar> weld(const TriangleMesh<Scalar>&, Scalar, const std::vector<bool>&);                   \
    template std::vector<bool> in_closed_pieces(const TriangleMesh<Scalar>&, const std::vector<int>&);                 \
    template TriangleMesh<Scalar> rounded(const TriangleMesh<Scalar>&);                                                \
    template CleanMesh<Scalar> clean(const TriangleMesh<Scalar>&);                                                     \
    template CleanMesh<Scalar> clean_in_own_axes(const TriangleMesh<Scalar>&);                                         \
    template class WindingTree<Scalar>;                                                                                \
    template TriangleMesh<Scalar> lattice_surface(const Lattice<Scalar>&, const std::vector<LatticeNode>&,             \
                                                  const LatticeShape<Scalar>&);                                        \
    template std::optional<PairedPieces> without_lone_pieces(const TriangleMesh<Scalar>&);                             \
    template TriangleMesh<Scalar> side_by_side(const TriangleMesh<Scalar>&, const TriangleMesh<Scalar>&);              \
    template TriangleMesh<Scalar> winding_envelope(const TriangleMesh<Scalar>&, const EnvelopeOptions&);               \
    template TriangleMesh<Scalar> smoothed(TriangleMesh<Scalar>, int, const DenoiseOptions&);                          \
    template Scalar bulge_coherence(const TriangleMesh<Scalar>&);                                                      \
    template bool is_without_noise(const TriangleMesh<Scalar>&, const DenoiseOptions&);                                \
    template DenoisedMesh<Scalar> remove_noise(TriangleMesh<Scalar>, const DenoiseOptions&);                           \
    template CanonicalPlaces<Scalar> canonical_places(const TriangleMesh<Scalar>&);                                    \
    template ClusteredMesh<Scalar> cluster_vertices(const TriangleMesh<Scalar>&, Eigen::Index);                        \
    template CanonicalMesh<Scalar> canonical_form(const TriangleMesh<Scalar>&);                                        \
    template std::vector<ManifoldParts<Scalar>> manifold_parts(const TriangleMesh<Scalar>&, double);                   \
    template ManifoldParts<Scalar> largest_manifold_part(const TriangleMesh<Scalar>&);                                 \
    template ManifoldParts<Scalar> manifold_part_of_sound(const TriangleMesh<Scalar>&);                                \
    template std::optional<Body<Scalar>> open_handles(const Body<Scalar>&);                                            \
    template std::optional<Body<Scalar>> close_pockets(const Body<Scalar>&);                                           \
    template Body<Scalar> make_body(TriangleMesh<Scalar>, const Similarity<Scalar>&, std::vector<int>, int);           \
    template bool is_inside(const Body<Scalar>&, const Vector3<Scalar>&);                                              \
    template Body<Scalar> resurfaced(Body<Scalar>, TriangleMesh<Scalar>, std::vector<int>);                            \
    template CurveSkeleton<Scalar> to_input(const Body<Scalar>&, const CurveSkeleton<Scalar>&);                        \
    template KinematicSkeleton<Scalar> to_input(const Body<Scalar>&, const KinematicSkeleton<Scalar>&);                \
    template KinematicSkeleton<Scalar> to_body(const Body<Scalar>&, const KinematicSkeleton<Scalar>&);                 \
    template void require_surface(const TriangleMesh<Scalar>&);                                                        \
    template BodyFaces faces_of_body(const TriangleMesh<Scalar>&, int, bool);                                          \
    template UsedPart<Scalar> used_part(const TriangleMesh<Scalar>&);                                                  \
    template BodyMaterial<Scalar> gather(const TriangleMesh<Scalar>&, const PrepareOptions&);                          \
    template Points<Scalar> input_vertices(const BodyMaterial<Scalar>&);                                               \
    template Outcome<Body<Scalar>> make_body_by(Remedy, BodyMaterial<Scalar>, const PrepareOptions&);                  \
    template Body<Scalar> prepare(const TriangleMesh<Scalar>&, const PrepareOptions&);

SKELGEN_INSTANTIATE(SKELGEN_SCALAR)

#undef SKELGEN_INSTANTIATE

} // namespace skelgen::surface
