#include <skelgen/io/coloured_ply.hpp>

#include <algorithm>
#include <string_view>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/io/atomic_file.hpp>

#include "little_endian.hpp"
#include "number_text.hpp"

namespace skelgen::io {
namespace {

void check(const TriangleMesh<double>& mesh, const MeshColours& colours) {
    const auto n = static_cast<std::size_t>(mesh.vertices.rows()), m = static_cast<std::size_t>(mesh.faces.rows());
    const bool right_sizes = colours.vertices.size() == n &&
                             (colours.vertex_labels.empty() || colours.vertex_labels.size() == n) &&
                             (colours.face_labels.empty() || colours.face_labels.size() == m);
    if (!right_sizes) throw Error(ErrorCode::usage, "a coloured mesh needs one colour and label for each vertex");
    if (!mesh.vertices.allFinite())
        throw Error(ErrorCode::usage, "a coordinate is not a number or infinite; repair the mesh");
}

std::string header(const TriangleMesh<double>& mesh, const MeshColours& colours) {
    std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex ";
    detail::append_number(text, mesh.vertices.rows());
    for (const char* axis : {"x", "y", "z"}) text += std::string("\nproperty double ") + axis;
    for (const char* channel : {"red", "green", "blue"}) text += std::string("\nproperty uchar ") + channel;
    if (!colours.vertex_labels.empty()) text += "\nproperty int label";
    text += "\nelement face ";
    detail::append_number(text, mesh.faces.rows());
    text += "\nproperty list uchar int vertex_indices";
    if (!colours.face_labels.empty()) text += "\nproperty int label";
    return text + "\nend_header\n";
}

} // namespace

std::string format_coloured_ply(const TriangleMesh<double>& mesh, const MeshColours& colours) {
    check(mesh, colours);
    std::string bytes = header(mesh, colours);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        const auto i = static_cast<std::size_t>(v);
        for (int axis = 0; axis < 3; ++axis) detail::append_little_endian(bytes, mesh.vertices(v, axis));
        for (const std::uint8_t channel : colours.vertices[i]) detail::append_little_endian(bytes, channel);
        if (!colours.vertex_labels.empty())
            detail::append_little_endian(bytes, static_cast<std::int32_t>(colours.vertex_labels[i]));
    }
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
        detail::append_little_endian(bytes, std::uint8_t{3});
        for (int corner = 0; corner < 3; ++corner)
            detail::append_little_endian(bytes, static_cast<std::int32_t>(mesh.faces(f, corner)));
        if (!colours.face_labels.empty())
            detail::append_little_endian(bytes,
                                         static_cast<std::int32_t>(colours.face_labels[static_cast<std::size_t>(f)]));
    }
    return bytes;
}

void write_coloured_ply(const std::filesystem::path& path, const TriangleMesh<double>& mesh,
                        const MeshColours& colours) {
    write_file_atomically(path, format_coloured_ply(mesh, colours));
}

std::vector<ByteColour> part_colours(const std::vector<std::string>& parts) {
    // By name without its side: left, right. Of each set, any two are 25 apart or more in CIELAB, where 2.3 can just be
    // told apart; neighbours differ in lightness by 12 or more, so that borders show without colours, too.
    struct Pair {
        std::string_view part;
        ByteColour left, right;
    };
    static constexpr std::array<Pair, 13> colours{{{"head", {133, 76, 140}, {}},
                                                   {"neck", {119, 136, 130}, {}},
                                                   {"chest", {248, 220, 248}, {}},
                                                   {"abdomen", {113, 90, 108}, {}},
                                                   {"pelvis", {215, 169, 236}, {}},
                                                   {"torso", {179, 200, 201}, {}},
                                                   {"shoulder", {11, 177, 192}, {212, 179, 109}},
                                                   {"upper_arm", {31, 103, 216}, {198, 72, 93}},
                                                   {"forearm", {84, 241, 213}, {231, 229, 114}},
                                                   {"hand", {126, 186, 253}, {116, 106, 1}},
                                                   {"thigh", {46, 106, 78}, {204, 118, 95}},
                                                   {"calf", {107, 243, 161}, {198, 20, 0}},
                                                   {"foot", {66, 121, 170}, {243, 162, 67}}}};
    // An animal's parts have the colours of a person's.
    static constexpr std::array<std::array<std::string_view, 2>, 7> alike{{{"fore_upper", "upper_arm"},
                                                                           {"fore_lower", "forearm"},
                                                                           {"fore_foot", "hand"},
                                                                           {"hind_upper", "thigh"},
                                                                           {"hind_lower", "calf"},
                                                                           {"hind_foot", "foot"},
                                                                           {"tail", "shoulder"}}};
    std::vector<ByteColour> out;
    for (const std::string& part : parts) {
        SidedName name = split_side(part);
        for (const auto& [animals, persons] : alike)
            if (name.plain == animals) name.plain = persons;
        const auto* const found =
            std::find_if(colours.begin(), colours.end(), [&](const Pair& pair) { return pair.part == name.plain; });
        if (found == colours.end()) throw Error(ErrorCode::usage, "there is no colour for the part '" + part + "'");
        out.push_back(name.side == Side::right ? found->right : found->left);
    }
    return out;
}

} // namespace skelgen::io
