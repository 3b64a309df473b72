#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "little_endian.hpp"

namespace skelgen::io::detail {

/// A node of an FBX document: a name, properties, and nodes in it. Properties have the types that they are given as:
/// readers tell int32 from int64 and take no other.
class FbxNode {
public:
    /// A node with properties: std::int32_t, std::int64_t, double, bool, texts, or lists of the first three or of
    /// floats.
    template <typename... Properties>
    explicit FbxNode(std::string name, const Properties&... properties) : name_(std::move(name)) {
        (add(properties), ...);
    }

    /// Appends a node and returns it.
    template <typename... Properties>
    FbxNode& child(std::string name, const Properties&... properties) {
        return children_.emplace_back(std::move(name), properties...);
    }
    void append(FbxNode node) { children_.push_back(std::move(node)); }

    /// Appends a property of bytes, as a picture's.
    void add_bytes(std::string_view bytes);

private:
    friend std::string format_fbx_document(const std::vector<FbxNode>& nodes);

    void add(std::int32_t value);
    void add(std::int64_t value);
    void add(double value);
    void add(bool value);
    void add(std::string_view text);
    void add(const std::string& text) { add(std::string_view(text)); }
    void add(const char* text) { add(std::string_view(text)); }
    void add(const std::vector<std::int32_t>& values) { add_list('i', values); }
    void add(const std::vector<std::int64_t>& values) { add_list('l', values); }
    void add(const std::vector<double>& values) { add_list('d', values); }
    void add(const std::vector<float>& values) { add_list('f', values); }
    /// A list of numbers of this type.
    template <typename Number>
    void add_list(char type, const std::vector<Number>& values) {
        std::string bytes;
        for (const Number value : values) append_little_endian(bytes, value);
        add_list(type, values.size(), bytes);
    }
    void add_list(char type, std::size_t length, const std::string& bytes);

    void append_to(std::string& bytes) const;

    std::string name_;
    std::string properties_; ///< as they are stored
    std::uint32_t count_ = 0;
    std::vector<FbxNode> children_;
};

/// A binary FBX file of version 7.4 with these nodes at its top, and the head and foot that readers ask for: the foot's
/// bytes go with one time of creation and one identity, which are the same in all files. Lists are compressed where
/// this build has zlib. \throws Error usage when the file would be 4 GiB or larger.
[[nodiscard]] std::string format_fbx_document(const std::vector<FbxNode>& nodes);

/// When all files say that they were created, as the foot has it.
inline constexpr const char* fbx_creation_time = "1970-01-01 10:00:00:000";

/// The identity that goes with it: 16 bytes.
[[nodiscard]] std::string_view fbx_file_id();

} // namespace skelgen::io::detail
