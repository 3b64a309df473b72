#pragma once

#include <optional>
#include <vector>

#include <skelgen/applications/correspondence.hpp>
#include <skelgen/io/correspondence_json.hpp>

#include "fitted_file.hpp"

namespace skelgen::cli {

/// One of two bodies that are compared.
struct ComparedBody {
    const io::SourceMesh& source;
    const Quality& quality;
    const TriangleMesh<double>& mesh; ///< that the body was made of
    const Body<double>& body;
    const applications::ComparableBody<double>& comparable;
    const FittedFile* own = nullptr; ///< without the others, where it is one of several (`with_own_part`)
};

/// What is asked for beside a vertex for each vertex.
struct CorrespondenceExtras {
    bool confidence = false; ///< how sure each vertex's place is
    bool places = false;     ///< each vertex's place between vertices, too
};

struct FoundCorrespondence {
    io::CorrespondenceFile file;
    std::vector<int> to_body_vertex; ///< for each vertex of the one mesh a vertex of the other's body
};

/// For each vertex of one body's mesh the same place on another one's. \throws Error as `applications::correspond`.
[[nodiscard]] FoundCorrespondence correspondence_of(const ComparedBody& from, const ComparedBody& to,
                                                    const CorrespondenceExtras& extras);

/// A file's body, ready to be compared with any number of others.
struct ComparedFile {
    FittedFile file;
    applications::ComparableBody<double> comparable;
    std::optional<FittedFile> own; ///< as in `ComparedBody`

    [[nodiscard]] ComparedBody body() const {
        return {file.source, file.skeleton().quality, file.mesh(), file.found.body, comparable, own ? &*own : nullptr};
    }
};

/// `component`: which body of the file it is, as `PrepareOptions::component`. \throws Error as
/// `applications::comparable`.
[[nodiscard]] ComparedFile compared(FittedFile file, int component = 0);

} // namespace skelgen::cli
