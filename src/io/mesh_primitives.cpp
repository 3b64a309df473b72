#include "mesh_primitives.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shading_normals.hpp"
#include "tangents.hpp"
#include "unwritable_mesh.hpp"

namespace skelgen::io::detail {
namespace {

using applications::Skin;

/// Weights that sum to 1 as floats, too.
FloatRows float_weights(const Skin<double>& skin) {
    FloatRows weights = skin.weights.cast<float>();
    for (Eigen::Index v = 0; v < weights.rows(); ++v)
        weights(v, 0) += static_cast<float>(1 - weights.row(v).cast<double>().sum());
    return weights;
}

/// The rows of the mesh's vertices, and behind them those of their copies.
template <typename Rows>
Rows with_copies(const Rows& rows, const std::vector<int>& copies) {
    Rows all(rows.rows() + static_cast<Eigen::Index>(copies.size()), rows.cols());
    all.topRows(rows.rows()) = rows;
    for (std::size_t i = 0; i < copies.size(); ++i)
        all.row(rows.rows() + static_cast<Eigen::Index>(i)) = rows.row(copies[i]);
    return all;
}

/// What every vertex of a mesh has, and every copy of one, as floats; without a skin neither weights nor joints.
struct VertexRows {
    FloatRows positions, normals, weights;
    Eigen::Matrix<std::uint16_t, Eigen::Dynamic, 4, Eigen::RowMajor> joints;

    /// `unmorphed`: the places of the vertices where no morph target has weight.
    VertexRows(const TriangleMesh<double>& mesh, const Points<double>& unmorphed, const Skin<double>* skin,
               const std::vector<int>& copies)
        : positions(with_copies<FloatRows>(unmorphed.cast<float>(), copies)),
          normals(with_copies<FloatRows>(shading_normals(mesh).cast<float>().rowwise().normalized(), copies)) {
        if (skin != nullptr) {
            weights = with_copies(float_weights(*skin), copies);
            joints = with_copies<decltype(joints)>(skin->joints.cast<std::uint16_t>(), copies);
        }
        if (!positions.allFinite()) refuse_to_write_mesh("a coordinate is too large for a float; scale the mesh down");
    }
};

/// What a morph target adds to a vertex in the looks' pose, in the mesh's.
Eigen::Vector3d turned(const WrittenMesh& written, int vertex, const Eigen::RowVector3f& offset) {
    return written.turns[static_cast<std::size_t>(vertex)] * offset.transpose().cast<double>();
}

/// Where the mesh's vertices are without their morph targets.
Points<double> unmorphed(const WrittenMesh& written) {
    Points<double> places = written.mesh.vertices;
    if (written.turns.empty()) return places;
    for (const SceneObject& object : written.looks.objects)
        for (std::size_t i = 0; i < object.morphs.size(); ++i) {
            if (object.weights[i] == 0) continue;
            const MorphTarget& morph = object.morphs[i];
            for (std::size_t k = 0; k < morph.vertices.size(); ++k)
                places.row(morph.vertices[k]) -=
                    object.weights[i] * written.scale *
                    turned(written, morph.vertices[k], morph.positions.row(static_cast<Eigen::Index>(k))).transpose();
        }
    return places;
}

[[noreturn]] void refuse_looks() { refuse_to_write_mesh("its looks are those of another mesh"); }

/// Whether the looks' copies are of vertices that there are, and each part has them.
bool has_sound_copies(const SceneLooks& looks, Eigen::Index vertices) {
    const auto all = vertices + static_cast<Eigen::Index>(looks.copies.size());
    const auto is_vertex = [&](int v) { return v >= 0 && v < vertices; };
    if (!std::all_of(looks.copies.begin(), looks.copies.end(), is_vertex)) return false;
    return looks.copies.empty() || std::all_of(looks.parts.begin(), looks.parts.end(), [&](const ScenePart& part) {
               return part.first_vertex == 0 && part.vertices == all;
           });
}

/// The mesh's faces by the vertices and copies that the looks have there, each turned as in the mesh.
Triangles drawn_faces(const TriangleMesh<double>& mesh, const SceneLooks& looks) {
    const Eigen::Index vertices = mesh.vertices.rows();
    if (!has_sound_copies(looks, vertices)) refuse_looks();
    if (looks.faces.rows() == 0) return mesh.faces;
    const auto all = vertices + static_cast<Eigen::Index>(looks.copies.size());
    if (looks.faces.rows() != mesh.faces.rows() || looks.faces.minCoeff() < 0 || looks.faces.maxCoeff() >= all)
        refuse_looks();
    Triangles faces(mesh.faces.rows(), 3);
    for (Eigen::Index f = 0; f < faces.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            faces(f, k) = -1;
            for (const int drawn : looks.faces.row(f)) {
                const int source = drawn < vertices ? drawn : looks.copies[static_cast<std::size_t>(drawn - vertices)];
                if (source == mesh.faces(f, k)) faces(f, k) = drawn;
            }
            if (faces(f, k) < 0) refuse_looks();
        }
    return faces;
}

/// Normals of a part's vertices, and whether its own ones look the other way.
struct PartNormals {
    FloatRows rows;
    bool are_turned = false;
};

/// The looks' own normals of a part, in the mesh's pose; smooth ones where it has none. Those of a mesh that has been
/// turned inside out look the other way, as then most of them do.
PartNormals own_normals(const WrittenMesh& written, const ScenePart& part, const FloatRows& smooth) {
    FloatRows normals = smooth;
    std::vector<bool> is_own(static_cast<std::size_t>(part.vertices), false);
    Eigen::Index outwards = 0, inwards = 0;
    for (Eigen::Index i = 0; i < part.vertices; ++i) {
        const Eigen::Index v = part.first_vertex + i, copy = v - written.mesh.vertices.rows();
        const auto source =
            static_cast<std::size_t>(copy < 0 ? v : written.looks.copies[static_cast<std::size_t>(copy)]);
        const Eigen::Vector3d own = written.turns[source] * part.normals.row(i).transpose().cast<double>();
        const double length = own.norm();
        constexpr double least = 1e-6; // shorter ones, whose length should be 1, have no direction
        if (!(length > least) || !std::isfinite(length)) continue;
        is_own[static_cast<std::size_t>(i)] = true;
        const Eigen::Vector3f unit = (own / length).cast<float>();
        normals.block<1, 3>(i, 0) = unit.normalized().transpose();
        (normals.row(i).dot(smooth.row(i)) < 0 ? inwards : outwards) += 1;
    }
    const bool are_turned = inwards > outwards;
    if (are_turned)
        for (Eigen::Index i = 0; i < part.vertices; ++i)
            if (is_own[static_cast<std::size_t>(i)]) normals.row(i) = -normals.row(i);
    return {std::move(normals), are_turned};
}

/// The set of texture coordinates that a material's normal map goes by; none where it has no such map.
std::optional<std::size_t> normal_map_set(const Json& materials, std::optional<std::size_t> material,
                                          const ScenePart& part) {
    if (!material || !materials[*material].contains("normalTexture")) return std::nullopt;
    const auto set = materials[*material]["normalTexture"].value("texCoord", std::size_t{0});
    if (set >= part.texture_coordinates.size()) return std::nullopt;
    return set;
}

bool has_same_vertices(const ScenePart& a, const ScenePart& b) {
    return a.first_vertex == b.first_vertex && a.vertices == b.vertices;
}

/// The parts, which must be of the mesh that has these faces: all of them, one after the other.
std::vector<ScenePart> checked(std::vector<ScenePart> parts, const Triangles& drawn, Eigen::Index vertices) {
    if (parts.empty()) return {{0, vertices, 0, drawn.rows(), std::nullopt, {}, {}}};
    Eigen::Index faces = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const ScenePart& part = parts[i];
        const auto corners =
            drawn.middleRows(std::min(part.first_face, drawn.rows()), std::min(part.faces, drawn.rows() - faces));
        const bool own = part.faces == 0 || (corners.minCoeff() >= part.first_vertex &&
                                             corners.maxCoeff() < part.first_vertex + part.vertices);
        const bool shares = !part.same_as || (*part.same_as < i && !parts[*part.same_as].same_as &&
                                              has_same_vertices(part, parts[*part.same_as]));
        if (part.first_face != faces || corners.rows() != part.faces || !own || !shares ||
            part.first_vertex + part.vertices > vertices)
            refuse_looks();
        faces += part.faces;
    }
    if (faces != drawn.rows()) refuse_looks();
    return parts;
}

/// The looks' objects, which must have the parts: all of them, one after the other.
void check_objects(const SceneLooks& looks, Eigen::Index vertices) {
    std::size_t parts = 0;
    for (const SceneObject& object : looks.objects) {
        bool is_sound = object.first_part == parts && object.weights.size() == object.morphs.size();
        for (const MorphTarget& morph : object.morphs) {
            const auto rows = static_cast<Eigen::Index>(morph.vertices.size());
            is_sound = is_sound && morph.positions.rows() == rows &&
                       (morph.normals.rows() == 0 || morph.normals.rows() == rows) &&
                       std::adjacent_find(morph.vertices.begin(), morph.vertices.end(), std::greater_equal<>()) ==
                           morph.vertices.end() &&
                       (rows == 0 || (morph.vertices.front() >= 0 && morph.vertices.back() < vertices));
        }
        if (!is_sound) refuse_looks();
        parts += object.parts;
    }
    if (!looks.objects.empty() && parts != looks.parts.size()) refuse_looks();
}

/// Which object has a part; the first where there are none.
std::size_t object_of(const SceneLooks& looks, std::size_t part) {
    std::size_t object = 0;
    while (object < looks.objects.size() && part >= looks.objects[object].first_part + looks.objects[object].parts)
        ++object;
    return object;
}

/// Faces that are written together: of one material and one part's vertices.
struct Batch {
    std::size_t part; ///< the one that has what the vertices look like
    std::optional<std::size_t> material;
    std::vector<std::uint32_t> corners; ///< counted from the part's first vertex
};

/// Parts that share their vertices may take turns: their faces are brought together by material.
std::vector<Batch> batches_of(const std::vector<ScenePart>& parts, const Triangles& drawn) {
    std::vector<Batch> batches;
    std::map<std::pair<std::size_t, std::optional<std::size_t>>, std::size_t> known;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const ScenePart& part = parts[i];
        if (part.faces == 0) continue;
        const std::size_t owner = part.same_as.value_or(i);
        const auto [place, is_new] = known.emplace(std::pair(owner, part.material), batches.size());
        if (is_new) batches.push_back({owner, part.material, {}});
        for (const int corner : drawn.middleRows(part.first_face, part.faces).reshaped<Eigen::RowMajor>())
            batches[place->second].corners.push_back(static_cast<std::uint32_t>(corner - part.first_vertex));
    }
    return batches;
}

/// Writes what the vertices of parts have, each once.
class AttributeWriter {
public:
    AttributeWriter(GltfBuffer& buffer, const WrittenMesh& written)
        : buffer_(&buffer), written_(&written),
          rows_(written.mesh, unmorphed(written), written.skin, written.looks.copies) {}

    struct Written {
        Json attributes;
        FloatRows normals;
        bool has_own_normals = false, are_turned = false;
    };

    const Written& of(std::size_t number, const ScenePart& part) {
        const auto known = by_part_.find(number);
        if (known != by_part_.end()) return known->second;
        Written out{places_of(part), rows_.normals.middleRows(part.first_vertex, part.vertices)};
        if (part.normals.rows() > 0 && !written_->turns.empty()) {
            PartNormals own = own_normals(*written_, part, out.normals);
            out.normals = std::move(own.rows);
            out.are_turned = own.are_turned;
            out.has_own_normals = true;
            out.attributes["NORMAL"] = buffer_->add_floats(out.normals, GltfTarget::vertices);
        } else {
            const auto [normals, is_new] = smooth_normals_.emplace(part.first_vertex, 0);
            if (is_new) normals->second = buffer_->add_floats(out.normals, GltfTarget::vertices);
            out.attributes["NORMAL"] = normals->second;
        }
        for (std::size_t set = 0; set < part.texture_coordinates.size(); ++set)
            out.attributes["TEXCOORD_" + std::to_string(set)] =
                buffer_->add_floats(part.texture_coordinates[set], GltfTarget::vertices);
        if (part.colours.rows() > 0)
            out.attributes["COLOR_0"] = buffer_->add_floats(part.colours, GltfTarget::vertices);
        return by_part_.emplace(number, std::move(out)).first->second;
    }

    /// The morph targets of an object as they are of a part; null where it has none.
    Json targets_of(std::size_t number, const ScenePart& part, const SceneObject& object) {
        const auto [known, is_new] = targets_.emplace(number, Json());
        if (!is_new || written_->turns.empty()) return known->second;
        const Written& written = of(number, part);
        const bool with_normals =
            written.has_own_normals && std::any_of(object.morphs.begin(), object.morphs.end(),
                                                   [](const MorphTarget& morph) { return morph.normals.rows() > 0; });
        for (const MorphTarget& morph : object.morphs) {
            Json target{{"POSITION", add_offsets(morph, morph.positions, part, written_->scale, true)}};
            if (with_normals)
                target["NORMAL"] = add_offsets(morph, morph.normals, part, written.are_turned ? -1 : 1, false);
            known->second.push_back(std::move(target));
        }
        return known->second;
    }

    [[nodiscard]] auto positions(const ScenePart& part) const {
        return rows_.positions.middleRows(part.first_vertex, part.vertices);
    }

private:
    /// Of what a morph target adds to vertices, what it adds to a part's, times `factor`.
    std::size_t add_offsets(const MorphTarget& morph, const decltype(MorphTarget::positions)& offsets,
                            const ScenePart& part, double factor, bool limits) {
        const auto first = std::lower_bound(morph.vertices.begin(), morph.vertices.end(), part.first_vertex);
        const auto last = std::lower_bound(first, morph.vertices.end(), part.first_vertex + part.vertices);
        const auto begin = static_cast<Eigen::Index>(first - morph.vertices.begin());
        const Eigen::Index count = offsets.rows() > 0 ? static_cast<Eigen::Index>(last - first) : 0;
        std::vector<std::uint32_t> places;
        FloatRows rows(count, 3);
        for (Eigen::Index i = 0; i < count; ++i) {
            const int vertex = morph.vertices[static_cast<std::size_t>(begin + i)];
            places.push_back(static_cast<std::uint32_t>(vertex - part.first_vertex));
            rows.row(i) = (factor * turned(*written_, vertex, offsets.row(begin + i))).cast<float>().transpose();
        }
        return buffer_->add_sparse_floats(places, rows, static_cast<std::size_t>(part.vertices), limits);
    }

    /// What all parts of the same vertices have in common.
    const Json& places_of(const ScenePart& part) {
        const auto [known, is_new] = places_.emplace(part.first_vertex, Json());
        Json& attributes = known->second;
        if (!is_new) return attributes;
        attributes["POSITION"] = buffer_->add_floats(positions(part), GltfTarget::vertices, true);
        if (rows_.joints.size() == 0) return attributes;
        attributes["JOINTS_0"] = buffer_->add_joints(
            {rows_.joints.data() + 4 * part.first_vertex, static_cast<std::size_t>(4 * part.vertices)});
        attributes["WEIGHTS_0"] =
            buffer_->add_floats(rows_.weights.middleRows(part.first_vertex, part.vertices), GltfTarget::vertices);
        return attributes;
    }

    GltfBuffer* buffer_;
    const WrittenMesh* written_;
    VertexRows rows_;
    std::map<Eigen::Index, Json> places_;                ///< by the first vertex
    std::map<Eigen::Index, std::size_t> smooth_normals_; ///< their accessors, by the first vertex
    std::map<std::size_t, Written> by_part_;
    std::map<std::size_t, Json> targets_; ///< by part
};

/// A mesh for each object, without primitives yet.
std::vector<WrittenObject> without_primitives(const WrittenMesh& written) {
    const Json nothing = Json::array();
    if (written.looks.objects.empty())
        return {{Json{{"name", "body"}, {"primitives", nothing}}, "body", "", std::nullopt}};
    std::vector<WrittenObject> out;
    for (const SceneObject& object : written.looks.objects) {
        const std::string node_name = object.name.empty() ? object.mesh_name : object.name;
        const std::string name = valid_utf8(node_name.empty() ? "body" : node_name);
        Json mesh{{"name", object.mesh_name.empty() ? name : valid_utf8(object.mesh_name)}, {"primitives", nothing}};
        if (!object.mesh_extras.empty()) mesh["extras"] = parse_json(object.mesh_extras);
        if (!object.morphs.empty() && !written.turns.empty()) mesh["weights"] = object.weights;
        out.push_back({std::move(mesh), name, object.extras, out.size()});
    }
    return out;
}

} // namespace

std::vector<WrittenObject> describe_objects(GltfBuffer& buffer, const WrittenMesh& written) {
    const TriangleMesh<double>& mesh = written.mesh;
    const SceneLooks& looks = written.looks;
    if (mesh.faces.rows() == 0) refuse_to_write_mesh("it has no faces");
    if (!written.turns.empty() && static_cast<Eigen::Index>(written.turns.size()) != mesh.vertices.rows())
        refuse_to_write_mesh("the turns of its vertices are those of another mesh");
    const Triangles drawn = drawn_faces(mesh, looks);
    const auto vertices = mesh.vertices.rows() + static_cast<Eigen::Index>(looks.copies.size());
    const std::vector<ScenePart> parts = checked(looks.parts, drawn, vertices);
    check_objects(looks, mesh.vertices.rows());
    const Json materials = parse_json(looks.json).value("materials", Json::array());
    AttributeWriter writer(buffer, written);
    std::vector<WrittenObject> objects = without_primitives(written);
    for (const Batch& batch : batches_of(parts, drawn)) {
        const ScenePart& part = parts[batch.part];
        const std::size_t number = object_of(looks, batch.part);
        const AttributeWriter::Written& vertex = writer.of(batch.part, part);
        Json attributes = vertex.attributes;
        if (const auto set = normal_map_set(materials, batch.material, part)) // the input's own have been turned
            attributes["TANGENT"] = buffer.add_floats(
                tangents(writer.positions(part), vertex.normals, batch.corners, part.texture_coordinates[*set]),
                GltfTarget::vertices);
        Json primitive{{"attributes", std::move(attributes)}, {"indices", buffer.add_indices(batch.corners)}};
        if (batch.material) primitive["material"] = *batch.material;
        if (!looks.objects.empty())
            if (Json targets = writer.targets_of(batch.part, part, looks.objects[number]); !targets.is_null())
                primitive["targets"] = std::move(targets);
        objects[number].mesh["primitives"].push_back(std::move(primitive));
    }
    std::erase_if(objects, [](const WrittenObject& object) { return object.mesh["primitives"].empty(); });
    return objects;
}

Json node_of(const WrittenObject& object) {
    Json node{{"name", object.name}};
    if (!object.extras.empty()) node["extras"] = parse_json(object.extras);
    return node;
}

void add_about(Json& scene, const SceneLooks& looks) {
    const Json about = parse_json(looks.about);
    for (const auto& [key, value] : about.items()) scene["asset"][key] = value;
}

void add_materials(Json& scene, GltfBuffer& buffer, const SceneLooks& looks) {
    const Json json = parse_json(looks.json);
    for (const auto& [key, value] : json.items()) scene[key] = value;
    for (std::size_t i = 0; i < looks.pictures.size(); ++i)
        scene["images"][i]["bufferView"] = buffer.add_bytes(looks.pictures[i]);
}

} // namespace skelgen::io::detail
