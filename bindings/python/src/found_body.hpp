#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <skelgen/applications/correspondence.hpp>
#include <skelgen/core/builtin_templates.hpp>
#include <skelgen/extract.hpp>
#include <skelgen/io/skeleton_json.hpp>

#include <extract_file.hpp>

#include "lent_mesh.hpp"

namespace skelgen::python {

/// What Python's `extract` takes.
struct FindOptions {
    std::string name;                          ///< of the mesh, in the files of results
    std::string skeleton_template = "human21"; ///< or human51: with fingers
    std::string fingers = "off";               ///< or "on", "auto"
    bool toes = false;                         ///< also joints of single toes
    int component = 0;
    int threads = 1;
    bool with_curve = false;
    double read_ms = 0; ///< what it took to read the mesh
};

/// A body that was found in a mesh, with the mesh: the one place that knows how `extract` is called and what it
/// returns. Values of it do not change, and so threads may share it.
class FoundBody {
public:
    /// \throws Error as `extract` and `load_template`.
    FoundBody(const Vertices& vertices, const Faces& faces, const FindOptions& options);

    [[nodiscard]] const Vertices& vertices() const { return vertices_; }
    [[nodiscard]] const Faces& faces() const { return faces_; }
    [[nodiscard]] const Extraction<double>& found() const { return found_; }
    /// Without fingers and toes: what everything else is made with.
    [[nodiscard]] const KinematicSkeleton<double>& skeleton() const { return found_.skeleton; }
    [[nodiscard]] const SkeletonTemplate& skeleton_template() const { return template_; }
    [[nodiscard]] const Body<double>& body() const { return found_.body; }
    /// Empty unless `FindOptions::with_curve`.
    [[nodiscard]] const CurveSkeleton<double>& curve() const { return found_.curve; }
    [[nodiscard]] const io::SourceMesh& source() const { return source_; }
    /// The skeleton's file, and that of what was tried.
    [[nodiscard]] std::string skeleton_json() const;
    [[nodiscard]] std::string trail_json() const;

    /// What `component` chose, without the mesh's other bodies, as the program has it; nothing where it chose none.
    [[nodiscard]] std::optional<cli::FittedFile> own_part() const;

    /// What a correspondence is found by; made once. \throws Error as `applications::comparable`.
    [[nodiscard]] const applications::ComparableBody<double>& comparable() const;

private:
    Vertices vertices_;
    Faces faces_;
    SkeletonTemplate template_;
    Extraction<double> found_;
    cli::FingeredSkeleton shown_;
    io::SourceMesh source_;
    double read_ms_ = 0;
    int component_ = 0;
    mutable std::mutex mutex_;
    mutable std::unique_ptr<const applications::ComparableBody<double>> comparable_;
};

/// The exception that Python gets for a body that was not found; with the GIL.
[[nodiscard]] nb::object no_skeleton_error(const Error& error);

} // namespace skelgen::python
