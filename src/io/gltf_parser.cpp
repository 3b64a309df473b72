#include "gltf_parser.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include <skelgen/core/error.hpp>

#include "gltf_animation.hpp"
#include "gltf_nodes.hpp"
#include "gltf_primitive.hpp"

namespace skelgen::io::detail {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::bad_input, message); }

/// Puts the scene's meshes together.
class SceneReader {
public:
    /// `with_normals`: reads the parts' normals, too.
    SceneReader(GltfData& data, GltfNodes nodes, bool with_normals)
        : data_(&data), nodes_(std::move(nodes)), matrices_(world_matrices(nodes_.nodes)), with_normals_(with_normals) {
    }

    PolygonMesh read() {
        for (const std::size_t node : shown_nodes(data_->file(), nodes_)) {
            const GltfValue value = data_->file().root().at("nodes")[node];
            if (const auto mesh = value.find("mesh"))
                add_mesh(value, node, data_->file().referred("meshes", *mesh), mesh->whole_number());
        }
        if (mesh_.sizes.empty() && has_points_)
            refuse("holds points or lines and no triangles; make a surface of them first (Poisson reconstruction)");
        if (mesh_.sizes.empty()) refuse("shows no mesh; export the scene again, with the body's mesh");
        return std::move(mesh_);
    }

    /// Of what has been read.
    [[nodiscard]] const std::vector<GltfPart>& parts() const { return parts_; }

private:
    void add_mesh(const GltfValue& node_value, std::size_t node, const GltfValue& mesh, std::size_t mesh_index) {
        const auto joint_matrices = read_skin(node_value);
        const bool mirrored = !joint_matrices && matrices_[node].topLeftCorner<3, 3>().determinant() < 0;
        std::vector<double> weights = nodes_.nodes[node].weights;
        if (weights.empty()) weights = read_morph_weights(mesh);
        std::map<std::string, std::size_t> first_vertices; // of primitives by their vertices' key
        const GltfValue primitives = mesh.at("primitives");
        // Any number of nodes may have the same mesh, and what JSON says takes longer to read than a buffer's numbers.
        constexpr std::size_t effort = 64;
        data_->count_numbers(effort * (weights.size() + primitives.size()), mesh);
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            if (!has_triangles(primitives[i])) {
                has_points_ = true;
                continue;
            }
            const GltfPrimitive primitive = read_primitive(*data_, primitives[i], weights);
            const std::string key = vertex_key(primitives[i]);
            data_->count_numbers(key.size(), primitives[i]);
            const auto [known, is_new] = first_vertices.emplace(key, mesh_.coordinates.size() / 3);
            if (is_new) add_vertices(primitive.vertices, matrices_[node], joint_matrices, primitives[i]);
            add_triangles(primitive, known->second, mirrored);
            add_part(primitive, mesh_index, i, known->second);
            if (with_normals_)
                parts_.back().normals = scene_normals(read_normals(*data_, primitives[i], weights), primitive.vertices,
                                                      matrices_[node], joint_matrices);
        }
    }

    void add_part(const GltfPrimitive& primitive, std::size_t mesh, std::size_t index, std::size_t first_vertex) {
        const auto faces =
            std::count_if(primitive.triangles.begin(), primitive.triangles.end(), [](const auto& corners) {
                return corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
            });
        parts_.push_back({mesh, index, static_cast<Eigen::Index>(first_vertex),
                          static_cast<Eigen::Index>(primitive.vertices.positions.size()), faces_, faces});
        faces_ += faces;
    }

    /// What each joint of the node's skin does to a point; none where it has no skin.
    [[nodiscard]] std::optional<std::vector<Eigen::Matrix4d>> read_skin(const GltfValue& node) {
        const auto index = node.find("skin");
        if (!index) return std::nullopt;
        const GltfValue skin = data_->file().referred("skins", *index);
        const GltfValue joints = skin.at("joints");
        data_->count_numbers(16 * joints.size(), skin); // a matrix each
        std::optional<GltfArray> inverse_binds;
        if (const auto accessor = skin.find("inverseBindMatrices")) {
            inverse_binds = data_->accessor(*accessor, 16);
            if (inverse_binds->rows < joints.size()) skin.fail("has more joints than inverse bind matrices");
        }
        std::vector<Eigen::Matrix4d> matrices;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            static_cast<void>(data_->file().referred("nodes", joints[i])); // there it is
            matrices.push_back(matrices_[joints[i].whole_number()]);
            if (inverse_binds) matrices.back() *= Eigen::Map<const Eigen::Matrix4d>(inverse_binds->row(i));
        }
        return matrices;
    }

    void add_vertices(const GltfVertices& vertices, const Eigen::Matrix4d& node_matrix,
                      const std::optional<std::vector<Eigen::Matrix4d>>& joint_matrices, const GltfValue& primitive) {
        for (std::size_t i = 0; i < vertices.positions.size(); ++i) {
            const auto influences = vertices.influences_of(i);
            const bool is_skinned = joint_matrices && !influences.empty();
            if (is_skinned) check_joints(influences, joint_matrices->size(), primitive);
            const Eigen::Vector3d position = is_skinned ? skinned(vertices.positions[i], influences, *joint_matrices)
                                                        : transformed(vertices.positions[i], node_matrix);
            mesh_.coordinates.insert(mesh_.coordinates.end(), position.begin(), position.end());
        }
        if (mesh_.coordinates.size() / 3 > static_cast<std::size_t>(std::numeric_limits<int>::max()))
            refuse("has more vertices than an int can count; simplify it");
    }

    /// Normals as the mesh lies in the scene; none where there are not as many as vertices.
    static decltype(GltfPart::normals)
    scene_normals(const std::vector<Eigen::Vector3d>& normals, const GltfVertices& vertices,
                  const Eigen::Matrix4d& node_matrix,
                  const std::optional<std::vector<Eigen::Matrix4d>>& joint_matrices) {
        if (normals.size() != vertices.positions.size()) return {};
        decltype(GltfPart::normals) out(static_cast<Eigen::Index>(normals.size()), 3);
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const auto influences = vertices.influences_of(i);
            const Eigen::Vector3d turned = joint_matrices && !influences.empty()
                                               ? skinned_normal(normals[i], influences, *joint_matrices)
                                               : transformed_normal(normals[i], node_matrix);
            out.row(static_cast<Eigen::Index>(i)) = turned.transpose().cast<float>();
        }
        return out;
    }

    static void check_joints(std::span<const Influence> influences, std::size_t joints, const GltfValue& primitive) {
        for (const Influence& influence : influences) // without weight it may name anything, unless it is the first
            if ((influence.weight != 0 || &influence == &influences.front()) && influence.joint >= joints)
                primitive.fail("names joints that its skin does not have");
    }

    void add_triangles(const GltfPrimitive& primitive, std::size_t first_vertex, bool mirrored) {
        for (auto corners : primitive.triangles) {
            if (mirrored) std::swap(corners[1], corners[2]); // or it would be inside out
            for (const std::size_t corner : corners) mesh_.corners.push_back(static_cast<int>(first_vertex + corner));
            mesh_.sizes.push_back(3);
        }
    }

    GltfData* data_;
    GltfNodes nodes_;
    std::vector<Eigen::Matrix4d> matrices_; ///< of the nodes, in the scene
    PolygonMesh mesh_;
    std::vector<GltfPart> parts_;
    Eigen::Index faces_ = 0; ///< in `parts_`
    bool has_points_ = false;
    bool with_normals_;
};

/// The nodes as they are stored, or as the wanted animation has them.
GltfNodes posed_nodes(GltfData& data, const ReadMeshOptions& options) {
    GltfNodes nodes = read_nodes(data.file());
    if (!options.animation.empty())
        for (const AnimationChannel& channel : read_animation(data, options.animation))
            nodes.nodes = animate(std::move(nodes.nodes), channel, options.time);
    return nodes;
}

} // namespace

std::vector<GltfPart> gltf_parts(GltfData& data, const ReadMeshOptions& options) {
    SceneReader reader(data, posed_nodes(data, options), true);
    static_cast<void>(reader.read());
    return reader.parts();
}

PolygonMesh parse_gltf(std::string_view bytes, const ReadMeshOptions& options, const LoadCompanion& load) {
    const GltfFile file = open_gltf(bytes);
    GltfData data(file, bytes.size(), load);
    return SceneReader(data, posed_nodes(data, options), false).read();
}

} // namespace skelgen::io::detail
