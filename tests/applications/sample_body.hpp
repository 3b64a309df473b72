#pragma once

#include <skelgen/extract.hpp>
#include <skelgen/io/read_mesh.hpp>

namespace skelgen::test {

/// The sample body's mesh: a man in mid-stride, 1.75 m tall.
inline TriangleMesh<double> sample_mesh() { return read_mesh<double>(SKELGEN_DATA "/sample/body.off"); }

} // namespace skelgen::test
