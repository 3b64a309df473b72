#include "kinds.hpp"

#include <skelgen/core/error.hpp>
#include <skelgen/core/skeleton_template.hpp>

#include "damages.hpp"

namespace skelgen::damage {
namespace {

Vec3 mirrored_point(const Vec3& p) { return {-p.x(), p.y(), p.z()}; }

/// What was on the left of the body is on the right of its mirror image.
io::GroundTruth mirrored_truth(const io::GroundTruth& truth) {
    io::GroundTruth out = truth;
    out.joints.clear(), out.markers.clear();
    for (const auto& [name, position] : truth.joints)
        out.joints.emplace_back(mirrored_name(name), mirrored_point(position));
    for (const auto& [name, position] : truth.markers) out.markers[mirrored_name(name)] = mirrored_point(position);
    return out;
}

} // namespace

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all{
        {"inside-out", "all faces look inwards", ".off", false, inside_out},
        {"flipped", "30 % of the faces look inwards", ".off", false, flipped},
        {"soup-off", "every face by itself, as OFF", ".off", false, triangle_soup},
        {"soup-ply", "every face by itself, as PLY", ".ply", false, triangle_soup},
        {"soup-stl", "every face by itself, as STL", ".stl", false, triangle_soup},
        {"charts", "six charts with vertices of their own", ".off", false, six_charts},
        {"duplicates", "5 % of the vertices are two, 10 % of the faces are there twice", ".off", false, duplicates},
        {"degenerate", "faces without area", ".off", false, degenerate},
        {"fins", "triangles that stick out", ".off", false, fins},
        {"inner-walls", "walls across every limb", ".off", true, inner_walls},
        {"far-unused", "far vertices that no face uses", ".off", false, far_unused},
        {"far-100", "a vertex of a face 100 body lengths away", ".off", false, far_100},
        {"far-1000", "a vertex of a face 1000 body lengths away", ".off", false, far_1000},
        {"faces-gone", "5 % of the faces left out", ".off", false, faces_gone},
        {"holes", "five holes of 1 % of the area", ".off", false, holes},
        {"noise-1", "noise of 1 % of the diagonal", ".off", false, noise_1},
        {"noise-2", "noise of 2 % of the diagonal", ".off", false, noise_2},
        {"floating", "ten floating pieces", ".off", false, floating},
        {"plate-apart", "a plate below the feet", ".off", true, plate_apart},
        {"plate-grown", "a plate grown to the soles", ".off", true, plate_grown},
        {"parts-14", "14 closed overlapping parts", ".off", true, parts_14},
        {"parts-4", "4 closed overlapping parts", ".off", true, parts_4},
        {"no-hands", "both hands cut off", ".off", true, no_hands, true, false, {"left_hand", "right_hand"}},
        {"no-feet", "both feet cut off", ".off", true, no_feet, true, false, {"left_foot", "right_foot"}},
        {"no-arm", "an arm cut off", ".off", true, no_arm, true, false, {"left_elbow", "left_wrist", "left_hand"}},
        {"no-leg", "a leg cut off", ".off", true, no_leg, true, false, {"left_knee", "left_ankle", "left_foot"}},
        {"no-head", "the head cut off", ".off", true, no_head, true, false, {"head"}},
        {"front-half", "the faces that look forward alone", ".off", true, front_half},
        {"faces-3000", "decimated to 3000 faces", ".off", false, faces_3000},
        {"faces-1000", "decimated to 1000 faces", ".off", false, faces_1000},
        {"faces-500", "decimated to 500 faces", ".off", false, faces_500},
        {"faces-400000", "subdivided to 400 thousand faces", ".ply", false, faces_400000},
        {"mirrored", "mirrored", ".off", false, mirrored, true, true},
        {"two-bodies", "two bodies apart", ".off", false, two_bodies, false},
        {"random-faces", "faces between random vertices", ".off", false, random_faces, true, false, {}, false},
        {"scrambled", "the vertices in random order", ".off", false, scrambled, true, false, {}, false},
        {"fan", "the first corner of every face is the same vertex", ".off", false, fan, true, false, {}, false},
        {"tiny", "scaled by 1e-160", ".off", false, tiny, true, false, {}, false},
        {"huge", "scaled by 1e150", ".off", false, huge, true, false, {}, false}};
    return all;
}

const Kind& named_kind(std::string_view name) {
    for (const Kind& kind : kinds())
        if (kind.name == name) return kind;
    std::string what = "there is no damage " + std::string(name) + ": give one of";
    for (const Kind& kind : kinds()) what += " " + kind.name;
    throw Error(ErrorCode::usage, what);
}

Mesh damaged(const Kind& kind, const Subject& subject) {
    if (subject.mesh.vertices.rows() < 4 || subject.mesh.faces.rows() < 4)
        throw Error(ErrorCode::bad_input, "there is no surface to damage");
    if (kind.needs_skeleton && !subject.skeleton)
        throw Error(ErrorCode::bad_input, kind.name + " needs the body's skeleton; give it");
    return kind.apply(subject);
}

io::GroundTruth truth_after(const Kind& kind, io::GroundTruth truth) {
    if (kind.is_mirrored) return mirrored_truth(truth);
    truth.missing.insert(kind.missing.begin(), kind.missing.end());
    return truth;
}

} // namespace skelgen::damage
