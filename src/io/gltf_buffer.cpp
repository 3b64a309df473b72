#include "gltf_buffer.hpp"

#include <utility>

#include "little_endian.hpp"

namespace skelgen::io::detail {
namespace {

constexpr int type_unsigned_short = 5123, type_unsigned_int = 5125, type_float = 5126;

const char* type_of(Eigen::Index columns) {
    switch (columns) {
    case 1:
        return "SCALAR";
    case 2:
        return "VEC2";
    case 3:
        return "VEC3";
    case 4:
        return "VEC4";
    default:
        return "MAT4";
    }
}

/// As doubles: JSON then has every digit, and the limits are exactly those of the data.
Json to_list(const Eigen::RowVectorXf& row) {
    Json list = Json::array();
    for (const float value : row) list.push_back(static_cast<double>(value));
    return list;
}

} // namespace

std::size_t GltfBuffer::add_view(std::size_t begin, GltfTarget target) {
    Json view{{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}};
    if (target != GltfTarget::none) view["target"] = static_cast<int>(target);
    views_.push_back(std::move(view));
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0'); // what follows begins at a whole word
    return views_.size() - 1;
}

/// Rows of three zeros, as accessors without a view have them by the format: Godot before 4.1 reads the first view
/// instead.
std::size_t GltfBuffer::zeros_view(std::size_t count) {
    const auto known = zeros_.find(count);
    if (known != zeros_.end()) return known->second;
    constexpr std::size_t row = 3 * sizeof(float);
    const std::size_t begin = bytes_.size();
    bytes_.resize(begin + row * count, '\0');
    const std::size_t view = add_view(begin, GltfTarget::vertices);
    views_[view]["byteStride"] = row; // a view of several accessors has to have one
    return zeros_[count] = view;
}

std::size_t GltfBuffer::add_accessor(int component_type, std::size_t count, const char* type, std::size_t begin,
                                     GltfTarget target) {
    accessors_.push_back(
        {{"bufferView", add_view(begin, target)}, {"componentType", component_type}, {"count", count}, {"type", type}});
    return accessors_.size() - 1;
}

std::size_t GltfBuffer::add_floats(const FloatRows& rows, GltfTarget target, bool limits) {
    const std::size_t begin = bytes_.size();
    for (Eigen::Index i = 0; i < rows.size(); ++i) append_little_endian(bytes_, rows.data()[i]);
    const std::size_t index =
        add_accessor(type_float, static_cast<std::size_t>(rows.rows()), type_of(rows.cols()), begin, target);
    if (limits) {
        accessors_.back()["min"] = to_list(rows.colwise().minCoeff());
        accessors_.back()["max"] = to_list(rows.colwise().maxCoeff());
    }
    return index;
}

std::size_t GltfBuffer::add_sparse_floats(std::span<const std::uint32_t> places, const FloatRows& rows,
                                          std::size_t count, bool limits) {
    constexpr std::size_t columns = 3;
    if (const std::size_t bytes_a_place = 4 + 4 * columns; places.size() * bytes_a_place >= count * 4 * columns) {
        FloatRows all = FloatRows::Zero(static_cast<Eigen::Index>(count), columns);
        for (std::size_t i = 0; i < places.size(); ++i) all.row(places[i]) = rows.row(static_cast<Eigen::Index>(i));
        return add_floats(all, GltfTarget::vertices, limits);
    }
    Json accessor{
        {"bufferView", zeros_view(count)}, {"componentType", type_float}, {"count", count}, {"type", type_of(columns)}};
    if (!places.empty()) {
        const auto begin_of = [&](const auto& append) {
            const std::size_t begin = bytes_.size();
            append();
            return add_view(begin, GltfTarget::none);
        };
        const std::size_t indices = begin_of([&] {
            for (const std::uint32_t place : places) append_little_endian(bytes_, place);
        });
        const std::size_t values = begin_of([&] {
            for (Eigen::Index i = 0; i < rows.size(); ++i) append_little_endian(bytes_, rows.data()[i]);
        });
        accessor["sparse"] = {{"count", places.size()},
                              {"indices", {{"bufferView", indices}, {"componentType", type_unsigned_int}}},
                              {"values", {{"bufferView", values}}}};
    }
    if (limits) { // the zeros count, too
        const Eigen::RowVectorXf zero = Eigen::RowVectorXf::Zero(columns);
        const bool is_zero = rows.rows() == 0;
        accessor["min"] = to_list(is_zero ? zero : rows.colwise().minCoeff().cwiseMin(zero));
        accessor["max"] = to_list(is_zero ? zero : rows.colwise().maxCoeff().cwiseMax(zero));
    }
    accessors_.push_back(std::move(accessor));
    return accessors_.size() - 1;
}

std::size_t GltfBuffer::add_indices(std::span<const std::uint32_t> indices) {
    const std::size_t begin = bytes_.size();
    for (const std::uint32_t index : indices) append_little_endian(bytes_, index);
    return add_accessor(type_unsigned_int, indices.size(), "SCALAR", begin, GltfTarget::indices);
}

std::size_t GltfBuffer::add_joints(std::span<const std::uint16_t> joints) {
    const std::size_t begin = bytes_.size();
    for (const std::uint16_t joint : joints) append_little_endian(bytes_, joint);
    return add_accessor(type_unsigned_short, joints.size() / 4, "VEC4", begin, GltfTarget::vertices);
}

std::size_t GltfBuffer::add_bytes(std::string_view bytes) {
    const std::size_t begin = bytes_.size();
    bytes_ += bytes;
    return add_view(begin, GltfTarget::none);
}

void GltfBuffer::describe_in(Json& scene) const {
    scene["accessors"] = accessors_;
    scene["bufferViews"] = views_;
    scene["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
}

} // namespace skelgen::io::detail
