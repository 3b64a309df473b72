#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gltf_file.hpp"

namespace skelgen::io::detail {

/// Gives the content of a file beside the scene's, by its reference in the scene; Error bad_input when there is none.
using LoadCompanion = std::function<std::string(const std::string& reference)>;

/// The values of an accessor, row after row.
struct GltfArray {
    std::size_t rows = 0;
    std::size_t columns = 1;
    std::vector<double> values; ///< rows x columns; integers as they are, or in [-1, 1] where they are normalised

    [[nodiscard]] const double* row(std::size_t i) const { return values.data() + i * columns; }
};

/// The numbers of a glTF file: buffers, the views into them, and the accessors that say what is there. Buffers are
/// loaded and views are decompressed when they are first asked for: those of pictures never are. No byte outside a
/// buffer is ever read, whatever offsets and counts the file has.
class GltfData {
public:
    /// `file` must outlive this. `file_bytes`: the size of the whole scene file.
    GltfData(const GltfFile& file, std::size_t file_bytes, LoadCompanion load);

    /// The values that the accessor with the given number has, sparse ones put in place.
    /// \throws Error bad_input when it, its views or buffers do not hold together; what loading a file throws.
    [[nodiscard]] GltfArray accessor(const GltfValue& index);

    /// As `accessor`, which must have so many columns (3 for VEC3).
    [[nodiscard]] GltfArray accessor(const GltfValue& index, std::size_t columns);

    /// The rows of an accessor of so many columns that are not zero, as morph targets have few of them: of a sparse
    /// accessor without a view no others are read.
    struct RowsInUse {
        std::size_t all = 0;             ///< how many rows there are
        std::vector<std::size_t> places; ///< of those in use, rising
        GltfArray rows;                  ///< a row for each place
    };
    [[nodiscard]] RowsInUse rows_in_use(const GltfValue& index, std::size_t columns);

    /// The bytes of a view into a buffer, decompressed; valid as long as this lives.
    [[nodiscard]] std::string_view view(const GltfValue& index);

    /// Takes note that `numbers` are about to be read. A file may refer to the same bytes again and again.
    /// \throws Error bad_input when that makes more than a file of this size has use for.
    void count_numbers(std::size_t numbers, const GltfValue& place);

    [[nodiscard]] const GltfFile& file() const { return *file_; }

private:
    [[nodiscard]] std::string_view buffer(const GltfValue& index);
    [[nodiscard]] std::string load_buffer(const GltfValue& buffer);
    [[nodiscard]] std::string decompress(const GltfValue& compression);
    void count_file(std::size_t bytes, const GltfValue& buffer);
    [[nodiscard]] std::string_view part(const GltfValue& view);
    [[nodiscard]] GltfArray zeros(const GltfValue& accessor, std::size_t columns) const;
    /// The sparse rows of an accessor that has so many, and where they belong.
    [[nodiscard]] RowsInUse read_sparse(const GltfValue& accessor, std::size_t columns);

    const GltfFile* file_;
    LoadCompanion load_;
    std::size_t file_bytes_;                          ///< of the scene's file and of the buffers loaded so far
    std::size_t decompressed_bytes_ = 0;              ///< of the views decompressed so far
    std::size_t numbers_ = 0;                         ///< read so far
    std::map<std::size_t, std::string> buffers_;      ///< loaded, by number; a map, so that they never move
    std::map<std::size_t, std::string> decompressed_; ///< views, by number
};

} // namespace skelgen::io::detail
