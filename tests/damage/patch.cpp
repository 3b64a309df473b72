#include "patch.hpp"

namespace skelgen::damage {

std::vector<std::size_t> patch_around(const Soup& soup, const std::vector<Face>& beyond, std::size_t face,
                                      double part) {
    double whole = 0;
    for (const Face& each : soup.faces) whole += normal(soup, each).norm();
    std::vector<bool> is_in(soup.faces.size(), false);
    std::vector<std::size_t> patch{face};
    is_in[face] = true;
    double area = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
        area += normal(soup, soup.faces[patch[i]]).norm();
        if (area >= part * whole) {
            patch.resize(i + 1);
            break;
        }
        for (const int next : beyond[patch[i]]) {
            if (next < 0 || is_in[static_cast<std::size_t>(next)]) continue;
            is_in[static_cast<std::size_t>(next)] = true;
            patch.push_back(static_cast<std::size_t>(next));
        }
    }
    return patch;
}

} // namespace skelgen::damage
