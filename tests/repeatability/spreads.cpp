#include "spreads.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/skeleton_template.hpp>

namespace skelgen::repeatability {
namespace {

/// The part of the first body's area on which `holds` is true of the parts of both, for each pair.
template <typename Holds>
std::vector<double> part_of_area(const RegisteredSet& set, PartsOf parts, const Holds& holds) {
    std::vector<double> out;
    for (const RegisteredBody& a : set.bodies) {
        const Eigen::VectorXd areas = core::vertex_areas(a.mesh);
        for (const RegisteredBody& b : set.bodies) {
            if (&a == &b) continue;
            double part = 0;
            for (std::size_t v = 0; v < (a.*parts).vertex_part.size(); ++v)
                if (holds((a.*parts).vertex_part[v], (b.*parts).vertex_part[v]))
                    part += areas[static_cast<Eigen::Index>(v)];
            out.push_back(part / areas.sum());
        }
    }
    return out;
}

double relative_deviation(const std::vector<double>& values) {
    double mean = 0, squares = 0;
    for (const double value : values) mean += value / static_cast<double>(values.size());
    for (const double value : values) squares += (value - mean) * (value - mean);
    return std::sqrt(squares / static_cast<double>(values.size())) / mean;
}

} // namespace

std::map<std::string, double> named_measures(const applications::Measurements& measures) {
    std::map<std::string, double> out{{"height", measures.height}, {"arm_span", measures.arm_span}};
    for (const auto& [name, value] : measures.lengths) out["length_" + name] = value;
    for (const auto& [name, value] : measures.girths)
        if (value) out["girth_" + name] = *value;
    return out;
}

std::vector<double> agreements(const RegisteredSet& set, PartsOf parts) {
    return part_of_area(set, parts, [](int a, int b) { return a == b; });
}

double worst_exchange(const RegisteredSet& set, PartsOf parts) {
    const std::vector<std::string>& names = (set.bodies.front().*parts).parts;
    const auto side = [&](int part) { return sign_of(split_side(names[static_cast<std::size_t>(part)]).side); };
    const auto exchanged = part_of_area(set, parts, [&](int a, int b) { return side(a) * side(b) < 0; });
    return *std::max_element(exchanged.begin(), exchanged.end());
}

std::vector<std::pair<std::string, double>> measure_spreads(const RegisteredSet& set) {
    std::map<std::string, std::map<std::string, std::vector<double>>> by_person;
    for (const RegisteredBody& body : set.bodies)
        for (const auto& [name, value] : named_measures(body.measures))
            by_person[body.name.substr(0, body.name.size() - 1)][name].push_back(value);
    std::map<std::string, std::vector<double>> deviations;
    for (const auto& [person, measures] : by_person)
        for (const auto& [name, values] : measures)
            if (values.size() > 1) deviations[name].push_back(relative_deviation(values));
    std::vector<std::pair<std::string, double>> out;
    for (const auto& [name, values] : deviations) {
        double mean = 0;
        for (const double value : values) mean += value / static_cast<double>(values.size());
        out.emplace_back(name, mean);
    }
    return out;
}

} // namespace skelgen::repeatability
