#include "nearest_word.hpp"

#include <algorithm>
#include <cstddef>

namespace skelgen::cli {
namespace {

/// How many letters are to be changed, left out, put in or swapped with the next to make one word of the other.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        now[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            const bool is_swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (is_swapped) now[j] = std::min(now[j], before[j - 2] + 1);
        }
        before.swap(last);
        last.swap(now);
    }
    return last[b.size()];
}

} // namespace

std::string nearest_word(std::string_view typed, const std::vector<std::string>& words) {
    constexpr std::size_t letters_per_slip = 4, longest = 64; // nobody means anything by longer ones
    if (typed.size() > longest) return "";
    std::size_t least = std::max<std::size_t>(1, typed.size() / letters_per_slip) + 1;
    std::string nearest;
    for (const std::string& word : words)
        if (const std::size_t off = distance(typed, word); off < least) {
            least = off;
            nearest = word;
        }
    return nearest;
}

} // namespace skelgen::cli
