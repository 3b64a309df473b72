#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include <skelgen/io/read_file.hpp>

#include "gzip.hpp"

namespace skelgen::io::detail {

/// A file's content as parsers take it: unpacked where it is compressed by gzip, without UTF-8's byte order mark.
/// What is unpacked lies in `storage`, which must outlive the result. \throws Error bad_input as `gunzip`.
[[nodiscard]] inline std::string_view plain_content(std::string_view content, std::string& storage) {
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (is_gzip(content)) {
        storage = gunzip(content, max_file_bytes);
        content = storage;
    }
    if (content.starts_with(byte_order_mark)) content.remove_prefix(byte_order_mark.size());
    return content;
}

/// Text whose lines end in a carriage return alone (old Macs), as lines that the parsers know: then it lies in
/// `storage`, which must outlive the result. All other content as it is.
[[nodiscard]] inline std::string_view with_line_feeds(std::string_view content, std::string& storage) {
    const auto has = [content](char c) { return content.find(c) != std::string_view::npos; };
    if (has('\n') || !has('\r') || has('\0')) return content;
    storage = content;
    std::replace(storage.begin(), storage.end(), '\r', '\n');
    return storage;
}

} // namespace skelgen::io::detail
