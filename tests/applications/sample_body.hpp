#pragma once

#include <skelgen/extract.hpp>
#include <skelgen/io/read_mesh.hpp>

namespace skelgen::test {

/// The sample body's mesh: a man in mid-stride, 1.75 m tall.
inline TriangleMesh<double> sample_mesh() { return read_mesh<double>(SKELGEN_DATA "/sample/body.off"); }

/// The sample body, and what is found in it.
struct SampleBody {
    TriangleMesh<double> mesh = sample_mesh();
    Extraction<double> found = extract(mesh);
    const KinematicSkeleton<double>& skeleton = found.skeleton;
    const Body<double>& body = found.body;
};

/// Found once for all tests that a process runs.
inline const SampleBody& sample_body() {
    static const SampleBody sample;
    return sample;
}

} // namespace skelgen::test
