#include "gltf_parser.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include <skelgen/core/error.hpp>

#include "finite_float.hpp"
#include "gltf_animation.hpp"
#include "gltf_nodes.hpp"
#include "gltf_primitive.hpp"

namespace skelgen::io::detail {
namespace {

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorCode::bad_input, message); }

/// Puts the scene's meshes together.
class SceneReader {
public:
    /// `morphs`: reads normals and morph targets, too, the latter from there; null: neither.
    SceneReader(GltfData& data, GltfNodes nodes, GltfData* morphs = nullptr)
        : data_(&data), nodes_(std::move(nodes)), morphs_(morphs) {
        scene_.node_matrices = world_matrices(nodes_.nodes);
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
    [[nodiscard]] GltfScene scene() && { return std::move(scene_); }

private:
    void add_mesh(const GltfValue& node_value, std::size_t node, const GltfValue& mesh, std::size_t mesh_index) {
        const auto joint_matrices = read_skin(node_value);
        const Eigen::Matrix4d& node_matrix = scene_.node_matrices[node];
        const bool mirrored = !joint_matrices && node_matrix.topLeftCorner<3, 3>().determinant() < 0;
        std::vector<double> weights = nodes_.nodes[node].weights;
        if (weights.empty()) weights = read_morph_weights(mesh);
        std::map<std::string, std::size_t> first_vertices; // of primitives by their vertices' key
        const GltfValue primitives = mesh.at("primitives");
        SceneObject object{"", "", scene_.parts.size(), 0, {}, {}, "", "", node, mesh_index};
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
            if (is_new) add_vertices(primitive.vertices, node_matrix, joint_matrices, primitives[i]);
            add_triangles(primitive, known->second, mirrored);
            add_part(primitive, {node, mesh_index, i}, known->second);
            if (morphs_ == nullptr) continue;
            const std::vector<Eigen::Vector3d> normals = read_normals(*data_, primitives[i], {});
            scene_.parts.back().normals = scene_normals(normals, primitive.vertices, node_matrix, joint_matrices);
            if (is_new) add_morphs(object, primitives[i], {primitive.vertices, normals, node_matrix, joint_matrices});
        }
        object.parts = scene_.parts.size() - object.first_part;
        if (object.parts == 0) return;
        object.weights = std::move(weights);
        object.weights.resize(object.morphs.size(), 0);
        scene_.objects.push_back(std::move(object));
    }

    /// What moves a primitive's vertices.
    struct Pose {
        const GltfVertices& vertices;
        const std::vector<Eigen::Vector3d>& normals;
        const Eigen::Matrix4d& node_matrix;
        const std::optional<std::vector<Eigen::Matrix4d>>& joint_matrices;

        [[nodiscard]] Eigen::Matrix3d at(std::size_t vertex) const {
            const Eigen::Matrix4d matrix =
                joint_matrices ? blended(vertices.influences_of(vertex), *joint_matrices, node_matrix) : node_matrix;
            return matrix.topLeftCorner<3, 3>();
        }
    };

    /// Reads the morph targets of a primitive whose vertices have just been added.
    void add_morphs(SceneObject& object, const GltfValue& primitive, const Pose& pose) {
        if (!scene_.lost_morphs.empty()) return;
        try {
            const auto targets = primitive.find("targets");
            const std::size_t count = targets ? targets->size() : 0;
            object.morphs.resize(std::max(object.morphs.size(), count));
            for (std::size_t i = 0; i < count; ++i) add_morph(object.morphs[i], (*targets)[i], pose);
        } catch (const Error& error) {
            if (error.code() != ErrorCode::bad_input) throw;
            scene_.lost_morphs = error.what();
            object.morphs.clear(); // all or none: what names them goes by their numbers
            for (SceneObject& other : scene_.objects) {
                other.morphs.clear();
                other.weights.clear();
            }
        }
    }

    /// Adds to a morph target what it does to a primitive's vertices, as they are in the scene.
    void add_morph(MorphTarget& morph, const GltfValue& target, const Pose& pose) {
        const std::size_t vertices = pose.vertices.positions.size();
        const auto read = [&](const char* attribute) {
            const auto accessor = target.find(attribute);
            if (!accessor) return GltfData::RowsInUse{vertices, {}, {0, 3, {}}};
            GltfData::RowsInUse rows = morphs_->rows_in_use(*accessor, 3);
            if (rows.all != vertices) accessor->fail("has another number of vertices than the mesh");
            return rows;
        };
        const GltfData::RowsInUse places = read("POSITION");
        const bool with_normals = pose.normals.size() == vertices && target.find("NORMAL");
        const GltfData::RowsInUse normals =
            with_normals ? read("NORMAL") : GltfData::RowsInUse{vertices, {}, {0, 3, {}}};
        std::vector<std::size_t> moved;
        std::set_union(places.places.begin(), places.places.end(), normals.places.begin(), normals.places.end(),
                       std::back_inserter(moved));
        const auto before = static_cast<Eigen::Index>(morph.vertices.size());
        const auto rows = before + static_cast<Eigen::Index>(moved.size());
        if (with_normals || morph.normals.rows() > 0) {
            const Eigen::Index known = morph.normals.rows();
            morph.normals.conservativeResize(rows, 3);
            morph.normals.bottomRows(rows - known).setZero();
        }
        morph.positions.conservativeResize(rows, 3);
        morph.positions.bottomRows(rows - before).setZero();
        std::size_t place = 0, normal = 0;
        for (std::size_t i = 0; i < moved.size(); ++i) {
            const std::size_t vertex = moved[i];
            const Eigen::Index row = before + static_cast<Eigen::Index>(i);
            morph.vertices.push_back(static_cast<int>(mesh_.coordinates.size() / 3 - vertices + vertex));
            const Eigen::Matrix3d linear = pose.at(vertex);
            if (place < places.places.size() && places.places[place] == vertex)
                morph.positions.row(row) =
                    float_row(linear * Eigen::Map<const Eigen::Vector3d>(places.rows.row(place++)));
            if (normal < normals.places.size() && normals.places[normal] == vertex)
                morph.normals.row(row) = float_row(transformed_normal_offset(
                    Eigen::Map<const Eigen::Vector3d>(normals.rows.row(normal++)), pose.normals[vertex], linear));
        }
    }

    static Eigen::RowVector3f float_row(const Eigen::Vector3d& v) {
        return {finite_float(v[0]), finite_float(v[1]), finite_float(v[2])};
    }

    void add_part(const GltfPrimitive& primitive, const GltfPart& place, std::size_t first_vertex) {
        const auto faces =
            std::count_if(primitive.triangles.begin(), primitive.triangles.end(), [](const auto& corners) {
                return corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
            });
        scene_.parts.push_back({place.node, place.mesh, place.primitive, static_cast<Eigen::Index>(first_vertex),
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
            matrices.push_back(scene_.node_matrices[joints[i].whole_number()]);
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
    PolygonMesh mesh_;
    GltfScene scene_;
    Eigen::Index faces_ = 0; ///< in the parts
    bool has_points_ = false;
    GltfData* morphs_;
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

GltfScene gltf_scene(GltfData& data, GltfData& morphs, const ReadMeshOptions& options) {
    SceneReader reader(data, posed_nodes(data, options), &morphs);
    static_cast<void>(reader.read());
    return std::move(reader).scene();
}

PolygonMesh parse_gltf(std::string_view bytes, const ReadMeshOptions& options, const LoadCompanion& load) {
    const GltfFile file = open_gltf(bytes);
    GltfData data(file, bytes.size(), load);
    return SceneReader(data, posed_nodes(data, options)).read();
}

} // namespace skelgen::io::detail
