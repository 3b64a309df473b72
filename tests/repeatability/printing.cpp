#include "printing.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <numeric>

#include "borders.hpp"

namespace skelgen::repeatability {

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantile(std::vector<double> values, double part) {
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1) + 0.5)];
}

void print_correspondences(const CorrespondenceScores& scores) {
    const auto worst =
        static_cast<std::size_t>(std::max_element(scores.errors.begin(), scores.errors.end()) - scores.errors.begin());
    std::printf("  correspond            error over sqrt(area): mean %.4f, worst pair %.4f (%s); landmarks: mean %.4f; "
                "sent to the other side: %.4f; %.1f s for a pair\n",
                mean_of(scores.errors), quantile(scores.errors, 1), scores.pairs[worst].c_str(),
                mean_of(scores.landmark_errors), scores.exchanged, scores.seconds);
    constexpr std::array<double, 5> bounds{0, 0.3, 0.6, 0.9, 1.01};
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
        std::vector<double> errors;
        for (const auto& [confidence, error] : scores.trusted)
            if (confidence >= bounds[i] && confidence < bounds[i + 1]) errors.push_back(error);
        if (errors.empty()) continue;
        std::printf("    confidence from %.1f    %4.1f %% of the vertices, error: mean %.4f, 90%% below %.4f\n",
                    bounds[i], 100 * static_cast<double>(errors.size()) / static_cast<double>(scores.trusted.size()),
                    mean_of(errors), quantile(errors, 0.9));
    }
}

void print_borders(const std::vector<const RegisteredBody*>& bodies) {
    std::printf("  segment               length of borders over the limb's girth:");
    for (const auto& [name, ratios] : border_lengths(bodies))
        std::printf(" %s %.2f (95%% below %.2f)", name.c_str(), mean_of(ratios), quantile(ratios, 0.95));
    std::printf("\n");
}

} // namespace skelgen::repeatability
