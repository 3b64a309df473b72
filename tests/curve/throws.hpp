#pragma once

#include <skelgen/core/error.hpp>

namespace skelgen::test {

/// Does `call` throw an Error of that code?
template <typename Call>
bool throws(ErrorCode code, Call&& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.code() == code;
    }
    return false;
}

} // namespace skelgen::test
