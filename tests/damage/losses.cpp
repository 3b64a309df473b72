#include "damages.hpp"
#include "patch.hpp"

namespace skelgen::damage {
namespace {

Mesh without(const Soup& soup, const std::vector<std::size_t>& faces) {
    std::vector<bool> gone(soup.faces.size(), false);
    for (const std::size_t f : faces) gone[f] = true;
    Soup out{soup.vertices, {}};
    for (std::size_t f = 0; f < gone.size(); ++f)
        if (!gone[f]) out.faces.push_back(soup.faces[f]);
    return to_compact_mesh(out);
}

} // namespace

Mesh faces_gone(const Subject& subject) {
    constexpr double part = 0.05;
    const Soup soup = to_soup(subject.mesh);
    return without(soup, Dice(subject.seed).sample(soup.faces.size(), part));
}

Mesh holes(const Subject& subject) {
    constexpr int count = 5;
    constexpr double part = 0.01;
    const Soup soup = to_soup(subject.mesh);
    const std::vector<Face> beyond = neighbours(soup.faces);
    Dice dice(subject.seed);
    std::vector<std::size_t> gone;
    for (int i = 0; i < count; ++i) {
        const auto patch = patch_around(soup, beyond, dice.index(soup.faces.size()), part);
        gone.insert(gone.end(), patch.begin(), patch.end());
    }
    return without(soup, gone);
}

} // namespace skelgen::damage
