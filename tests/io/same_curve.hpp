#pragma once

#include <algorithm>
#include <cstring>

#include <skelgen/core/curve_skeleton.hpp>

#include "catch.hpp"

namespace skelgen::test {

/// Whether two numbers have the same bits: 0 and -0 are two numbers.
template <typename Scalar>
bool same_bits(Scalar a, Scalar b) {
    return std::memcmp(&a, &b, sizeof(Scalar)) == 0;
}

/// Checks that two curves are the same to the last bit.
template <typename Scalar>
void check_same(const CurveSkeleton<Scalar>& a, const CurveSkeleton<Scalar>& b) {
    REQUIRE(a.nodes.rows() == b.nodes.rows());
    CHECK(std::equal(a.nodes.data(), a.nodes.data() + a.nodes.size(), b.nodes.data(), same_bits<Scalar>));
    CHECK(a.edges == b.edges);
    CHECK(std::equal(a.radii.begin(), a.radii.end(), b.radii.begin(), b.radii.end(), same_bits<Scalar>));
    CHECK(a.regions == b.regions);
}

} // namespace skelgen::test
