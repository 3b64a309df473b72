#include "fbx_node.hpp"

#include <limits>
#include <optional>
#include <utility>

#include "gzip.hpp"
#include "unwritable_mesh.hpp"

namespace skelgen::io::detail {
namespace {

using namespace std::string_view_literals;

constexpr std::uint32_t fbx_version = 7400; // the last whose places in the file have 32 bits, which all readers know
constexpr std::size_t record_head = 13;     // three numbers and the length of the name

std::uint32_t checked_size(std::size_t bytes) {
    if (bytes > std::numeric_limits<std::uint32_t>::max())
        refuse_to_write_mesh("it would be larger than the 4 GiB of an FBX file");
    return static_cast<std::uint32_t>(bytes);
}

void append_sized(std::string& bytes, std::string_view content) {
    append_little_endian(bytes, checked_size(content.size()));
    bytes += content;
}

} // namespace

void FbxNode::add(std::int32_t value) {
    ++count_;
    properties_ += 'I';
    append_little_endian(properties_, value);
}

void FbxNode::add(std::int64_t value) {
    ++count_;
    properties_ += 'L';
    append_little_endian(properties_, value);
}

void FbxNode::add(double value) {
    ++count_;
    properties_ += 'D';
    append_little_endian(properties_, value);
}

void FbxNode::add(bool value) {
    ++count_;
    properties_ += 'C';
    properties_ += static_cast<char>(value);
}

void FbxNode::add(std::string_view text) {
    ++count_;
    properties_ += 'S';
    append_sized(properties_, text);
}

void FbxNode::add_bytes(std::string_view bytes) {
    ++count_;
    properties_ += 'R';
    append_sized(properties_, bytes);
}

void FbxNode::add_list(char type, std::size_t length, const std::string& bytes) {
    ++count_;
    const std::optional<std::string> smaller = zlib_compressed(bytes);
    properties_ += type;
    append_little_endian(properties_, checked_size(length));
    append_little_endian(properties_, std::uint32_t{smaller ? 1U : 0U});
    append_sized(properties_, smaller ? *smaller : bytes);
}

void FbxNode::append_to(std::string& bytes) const {
    const std::size_t begin = bytes.size();
    bytes.append(4, '\0'); // where the node ends, once that is known
    append_little_endian(bytes, count_);
    append_little_endian(bytes, checked_size(properties_.size()));
    bytes += static_cast<char>(name_.size());
    bytes += name_;
    bytes += properties_;
    for (const FbxNode& child : children_) child.append_to(bytes);
    // The end of the nodes in it: also where there might be some, and are none.
    if (!children_.empty() || count_ == 0) bytes.append(record_head, '\0');
    std::string end;
    append_little_endian(end, checked_size(bytes.size()));
    bytes.replace(begin, end.size(), end);
}

std::string_view fbx_file_id() { return "\x28\xb3\x2a\xeb\xb6\x24\xcc\xc2\xbf\xc8\xb0\x2a\xa9\x2b\xfc\xf1"sv; }

std::string format_fbx_document(const std::vector<FbxNode>& nodes) {
    constexpr std::size_t alignment = 16, gap = 120;
    std::string bytes("Kaydara FBX Binary  \0\x1a\0"sv);
    append_little_endian(bytes, fbx_version);
    for (const FbxNode& node : nodes) node.append_to(bytes);
    bytes.append(record_head, '\0');
    bytes += "\xfa\xbc\xab\x09\xd0\xc8\xd4\x66\xb1\x76\xfb\x83\x1c\xf7\x26\x7e"sv;
    bytes.append(4, '\0');
    bytes.append(alignment - bytes.size() % alignment, '\0'); // at least one
    append_little_endian(bytes, fbx_version);
    bytes.append(gap, '\0');
    bytes += "\xf8\x5a\x8c\x6a\xde\xf5\xd9\x7e\xec\xe9\x0c\xe3\x75\x8f\x29\x0b"sv;
    return bytes;
}

} // namespace skelgen::io::detail
