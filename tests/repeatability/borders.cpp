#include "borders.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::repeatability {
namespace {

/// The parts beyond a border, and the girth there.
struct Border {
    const char* name;
    std::vector<std::string> beyond;
    const char* girth;
    bool is_sided;
};

const std::vector<Border>& borders() {
    static const std::vector<Border> all{{"head", {"head", "neck"}, "neck", false},
                                         {"upper_arm", {"upper_arm", "forearm", "hand"}, "upper_arm", true},
                                         {"forearm", {"forearm", "hand"}, "elbow", true},
                                         {"hand", {"hand"}, "wrist", true},
                                         {"thigh", {"thigh", "calf", "foot"}, "thigh", true},
                                         {"calf", {"calf", "foot"}, "knee", true},
                                         {"foot", {"foot"}, "ankle", true}};
    return all;
}

std::optional<double> girth_of(const RegisteredBody& body, const std::string& name) {
    for (const auto& [girth, value] : body.measures.girths)
        if (girth == name) return value;
    return std::nullopt;
}

/// How long the line between vertices of which `is_beyond` holds and the others is.
double length_of(const RegisteredBody& body, const std::vector<bool>& is_beyond) {
    double length = 0;
    for (Eigen::Index f = 0; f < body.mesh.faces.rows(); ++f) {
        std::array<Vector3<double>, 3> middles;
        std::size_t crossed = 0;
        for (int k = 0; k < 3; ++k) {
            const int a = body.mesh.faces(f, k), b = body.mesh.faces(f, (k + 1) % 3);
            if (is_beyond[static_cast<std::size_t>(a)] != is_beyond[static_cast<std::size_t>(b)])
                middles[crossed++] = (core::point(body.mesh.vertices, a) + core::point(body.mesh.vertices, b)) / 2;
        }
        if (crossed == 2) length += (middles[0] - middles[1]).norm();
    }
    return length;
}

} // namespace

std::map<std::string, std::vector<double>> border_lengths(const std::vector<const RegisteredBody*>& bodies) {
    std::map<std::string, std::vector<double>> out;
    for (const RegisteredBody* body : bodies)
        for (const Border& border : borders())
            for (const std::string side : {"left_", "right_"}) {
                if (!border.is_sided && side != "left_") continue;
                const std::string prefix = border.is_sided ? side : "";
                const std::optional<double> girth = girth_of(*body, prefix + border.girth);
                if (!girth) continue;
                std::vector<bool> is_beyond;
                for (const int part : body->bones.vertex_part)
                    is_beyond.push_back(std::any_of(border.beyond.begin(), border.beyond.end(), [&](const auto& name) {
                        return body->bones.parts[static_cast<std::size_t>(part)] == prefix + name;
                    }));
                out[border.name].push_back(length_of(*body, is_beyond) / *girth);
            }
    return out;
}

} // namespace skelgen::repeatability
