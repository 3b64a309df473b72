#include "gltf_data.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include <skelgen/core/error.hpp>
#include <skelgen/io/read_file.hpp>

#include "data_uri.hpp"
#include "gltf_component.hpp"
#include "meshopt_codec.hpp"

namespace skelgen::io::detail {
namespace {

constexpr const char* meshopt_extension = "EXT_meshopt_compression";

std::optional<GltfValue> find_extension(const GltfValue& value, const char* name) {
    const auto extensions = value.find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
}

MeshoptStream describe_stream(const GltfValue& compression, std::string_view bytes) {
    MeshoptStream stream{bytes, compression.at("count").whole_number(), compression.at("byteStride").whole_number(),
                         MeshoptMode::attributes, MeshoptFilter::none};
    const std::string& mode = compression.at("mode").text();
    if (mode == "TRIANGLES")
        stream.mode = MeshoptMode::triangles;
    else if (mode == "INDICES")
        stream.mode = MeshoptMode::indices;
    else if (mode != "ATTRIBUTES")
        compression.fail("has the mode '" + mode + "', which is not known");
    const auto filter = compression.find("filter");
    const std::string name = filter ? filter->text() : "NONE";
    if (name == "OCTAHEDRAL")
        stream.filter = MeshoptFilter::octahedral;
    else if (name == "QUATERNION")
        stream.filter = MeshoptFilter::quaternion;
    else if (name == "EXPONENTIAL")
        stream.filter = MeshoptFilter::exponential;
    else if (name != "NONE")
        compression.fail("has the filter '" + name + "', which is not known");
    return stream;
}

} // namespace

GltfData::GltfData(const GltfFile& file, std::size_t file_bytes, LoadCompanion load)
    : file_(&file), load_(std::move(load)), file_bytes_(file_bytes) {}

std::string GltfData::load_buffer(const GltfValue& buffer) {
    const std::string& uri = buffer.at("uri").text();
    if (!is_data_uri(uri)) return load_(percent_decoded(uri));
    auto bytes = decode_data_uri(uri);
    if (!bytes) buffer.fail("holds its bytes in another way than base64, or they are damaged");
    return *std::move(bytes);
}

std::string_view GltfData::buffer(const GltfValue& index) {
    const std::size_t number = index.whole_number();
    const GltfValue buffer = file_->referred("buffers", index);
    const std::size_t length = buffer.at("byteLength").whole_number();
    std::string_view bytes;
    if (number == 0 && file_->binary && !buffer.find("uri")) {
        bytes = *file_->binary;
    } else {
        auto loaded = buffers_.find(number);
        if (loaded == buffers_.end()) {
            loaded = buffers_.emplace(number, load_buffer(buffer)).first;
            count_file(loaded->second.size(), buffer);
        }
        bytes = loaded->second;
    }
    if (length > bytes.size())
        buffer.fail("promises " + std::to_string(length) + " bytes, but there are " + std::to_string(bytes.size()));
    return bytes.substr(0, length);
}

std::string_view GltfData::part(const GltfValue& view) {
    const std::string_view bytes = buffer(view.at("buffer"));
    const std::size_t offset = view.whole_number("byteOffset", 0), length = view.at("byteLength").whole_number();
    if (offset > bytes.size() || length > bytes.size() - offset) view.fail("reaches beyond its buffer");
    return bytes.substr(offset, length);
}

std::string GltfData::decompress(const GltfValue& compression) {
    // In all; a single part may shrink much more.
    constexpr std::size_t always_allowed = std::size_t{1} << 24U, best_ratio = 16;
    const std::size_t most = always_allowed + best_ratio * file_bytes_ - decompressed_bytes_;
    std::string bytes = decode_meshopt(describe_stream(compression, part(compression)), most);
    decompressed_bytes_ += bytes.size();
    return bytes;
}

std::string_view GltfData::view(const GltfValue& index) {
    const GltfValue view = file_->referred("bufferViews", index);
    const auto compression = find_extension(view, meshopt_extension);
    if (!compression) return part(view); // what is compressed may name a buffer that is not there
    const std::size_t number = index.whole_number();
    auto known = decompressed_.find(number);
    if (known == decompressed_.end()) known = decompressed_.emplace(number, decompress(*compression)).first;
    return known->second;
}

/// Rows that no view holds are zeros, until sparse ones are put in place. A file's size says how many may be.
GltfArray GltfData::zeros(const GltfValue& accessor, std::size_t columns) const {
    GltfArray array{accessor.at("count").whole_number(), columns, {}};
    if (array.rows > file_bytes_) accessor.fail("has more rows than a mesh in a file of this size");
    array.values.assign(array.rows * columns, 0.0);
    return array;
}

GltfData::RowsInUse GltfData::read_sparse(const GltfValue& accessor, std::size_t columns) {
    const GltfValue sparse = accessor.at("sparse"), indices = sparse.at("indices"), values = sparse.at("values");
    const std::size_t count = sparse.at("count").whole_number();
    const auto component_type = static_cast<int>(accessor.at("componentType").whole_number());
    RowsInUse out{accessor.at("count").whole_number(), {}, {}};
    count_numbers(count * (1 + columns), sparse);
    const auto index_type = static_cast<int>(indices.at("componentType").whole_number());
    const GltfArray places = read_rows({count, 1, {}}, view(indices.at("bufferView")),
                                       {indices.whole_number("byteOffset", 0), 0, index_type, false}, indices);
    out.rows = read_rows({count, columns, {}}, view(values.at("bufferView")),
                         {values.whole_number("byteOffset", 0), 0, component_type, accessor.truth("normalized", false)},
                         values);
    for (const double place : places.values) {
        if (!(place >= 0 && place < static_cast<double>(out.all))) sparse.fail("names a row that does not exist");
        out.places.push_back(static_cast<std::size_t>(place));
    }
    return out;
}

void GltfData::count_file(std::size_t bytes, const GltfValue& buffer) {
    file_bytes_ += bytes;
    if (file_bytes_ > max_file_bytes) buffer.fail("makes the scene larger than 2 GiB");
}

void GltfData::count_numbers(std::size_t numbers, const GltfValue& place) {
    // Small scenes may have some hundred copies of a part; a crowd is no body.
    constexpr std::size_t always_allowed = std::size_t{1} << 24U, most_per_byte = 2;
    numbers_ += numbers;
    if (numbers_ > std::max(always_allowed, most_per_byte * (file_bytes_ + decompressed_bytes_)))
        place.fail("makes the scene many times larger than its file: it is no single body");
}

GltfArray GltfData::accessor(const GltfValue& index) {
    const GltfValue accessor = file_->referred("accessors", index);
    const std::size_t columns = component_count(accessor.at("type"));
    count_numbers(accessor.at("count").whole_number() * columns, index);
    const auto component_type = static_cast<int>(accessor.at("componentType").whole_number());
    const auto view_index = accessor.find("bufferView");
    GltfArray array;
    if (view_index) {
        const std::size_t stride = file_->referred("bufferViews", *view_index).whole_number("byteStride", 0);
        array = read_rows(
            {accessor.at("count").whole_number(), columns, {}}, view(*view_index),
            {accessor.whole_number("byteOffset", 0), stride, component_type, accessor.truth("normalized", false)},
            accessor);
    } else {
        array = zeros(accessor, columns);
    }
    if (accessor.find("sparse")) {
        const RowsInUse sparse = read_sparse(accessor, columns);
        for (std::size_t i = 0; i < sparse.places.size(); ++i)
            std::copy_n(sparse.rows.row(i), columns, array.values.data() + sparse.places[i] * columns);
    }
    return array;
}

GltfData::RowsInUse GltfData::rows_in_use(const GltfValue& index, std::size_t columns) {
    const GltfValue value = file_->referred("accessors", index);
    const bool is_sparse = value.find("sparse") && !value.find("bufferView");
    if (is_sparse && component_count(value.at("type")) == columns) {
        RowsInUse sparse = read_sparse(value, columns);
        const auto unordered = std::adjacent_find(sparse.places.begin(), sparse.places.end(), std::greater_equal<>());
        if (unordered != sparse.places.end()) value.fail("has sparse indices that do not rise");
        return sparse;
    }
    GltfArray array = accessor(index, columns);
    RowsInUse out{array.rows, {}, {0, columns, {}}};
    for (std::size_t i = 0; i < array.rows; ++i) {
        if (std::all_of(array.row(i), array.row(i) + columns, [](double x) { return x == 0; })) continue;
        out.places.push_back(i);
        out.rows.values.insert(out.rows.values.end(), array.row(i), array.row(i) + columns);
    }
    out.rows.rows = out.places.size();
    return out;
}

GltfArray GltfData::accessor(const GltfValue& index, std::size_t columns) {
    GltfArray array = accessor(index);
    if (array.columns != columns)
        index.fail("refers to an accessor whose rows have " + std::to_string(array.columns) +
                   " numbers; they must have " + std::to_string(columns));
    return array;
}

} // namespace skelgen::io::detail
