#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace skelgen::io {

/// An array as numpy has it: numbers, or texts where there are no numbers.
struct NpyArray {
    std::vector<std::size_t> shape;
    std::vector<double> numbers = {};    ///< the last index fastest
    std::vector<std::string> texts = {}; ///< UTF-8
};

/// The bytes of an .npz file, which `numpy.load` reads: a ZIP archive, nothing compressed, with an .npy file (version
/// 1.0) for each name; doubles as '<f8', texts as '<U' of the longest one's length. \throws Error usage when an array
/// has another number of entries than its shape says, or the file would be larger than 4 GiB. O(bytes).
[[nodiscard]] std::string format_npz(const std::vector<std::pair<std::string, NpyArray>>& arrays);

} // namespace skelgen::io
