#include "batch_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include <skelgen/core/error.hpp>
#include <skelgen/io/npz.hpp>
#include <skelgen/io/read_file.hpp>
#include <skelgen/io/skeleton_json.hpp>

#include "batch_parts.hpp"
#include "console.hpp"

namespace skelgen::cli {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// What is known of one mesh.
struct Row {
    std::string file;
    SummaryLine line;
    std::optional<KinematicSkeleton<double>> skeleton;
    std::vector<std::pair<std::string, double>> measures;
    std::string unit; ///< of the measures; empty where it is not known
};

struct Table {
    std::vector<Row> rows;
    std::vector<std::string> joints, measures; ///< of all rows, in the order in which they come
};

void add_missing(std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

/// Adds what a measurements file says of its one body, as columns of a table are called.
void add_measures(const std::string& text, Row& row) {
    const auto file = nlohmann::ordered_json::parse(text);
    const auto& body = file.at("bodies").at(0);
    std::vector<std::pair<std::string, double>>& out = row.measures;
    for (const char* name : {"height", "arm_span", "area", "volume"})
        if (body.contains(name)) out.emplace_back(name, body.at(name).get<double>()); // animals have no arms
    for (const auto& [kind, prefix] : {std::pair("lengths", "length_"), std::pair("girths", "girth_")})
        for (const auto& [name, value] : body.at(kind).items())
            out.emplace_back(prefix + name, value.is_null() ? unknown : value.get<double>());
    if (body.at("unit").is_object()) row.unit = body.at("unit").at("name").get<std::string>();
}

/// What was written of a mesh; what has been taken away since is not known.
Row row_of(const BatchItem& item, const SummaryLines& lines) {
    Row row;
    row.file = item.file;
    const auto line = lines.find(item.file);
    if (line == lines.end()) {
        row.line.status = "not done yet";
        return row;
    }
    row.line = line->second;
    if (row.line.status != "ok") return row;
    try {
        row.skeleton = io::read_skeleton_document(item.output).skeleton;
        const auto measured = row.line.also.find("measure");
        if (measured != row.line.also.end() && measured->second.empty())
            add_measures(io::read_file(part_file(item, "measure")), row);
    } catch (const Error&) {
    } catch (const nlohmann::json::exception&) {
    }
    return row;
}

Table table_of(const std::vector<BatchItem>& items, const SummaryLines& lines) {
    Table table;
    for (const BatchItem& item : items) {
        const Row& row = table.rows.emplace_back(row_of(item, lines));
        if (row.skeleton)
            for (const Joint<double>& joint : row.skeleton->joints) add_missing(table.joints, joint.name);
        for (const auto& [name, value] : row.measures) add_missing(table.measures, name);
    }
    return table;
}

/// The joint of that name, if it is there and present.
const Joint<double>* joint_of(const Row& row, const std::string& name) {
    if (!row.skeleton) return nullptr;
    for (const Joint<double>& joint : row.skeleton->joints)
        if (joint.name == name) return joint.is_present ? &joint : nullptr;
    return nullptr;
}

double measure_of(const Row& row, const std::string& name) {
    for (const auto& [known, value] : row.measures)
        if (known == name) return value;
    return unknown;
}

double confidence_of(const Row& row) { return row.skeleton ? row.skeleton->quality.sides_confidence : unknown; }

// ---------------------------------------------------------------------------------------------------------------- CSV

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

/// A cell more; empty where the number is not known.
void append_cell(std::string& text, double value) {
    text += ',';
    if (!std::isnan(value)) text += nlohmann::json(value).dump(); // the shortest that reads back the same
}

std::string to_csv(const Table& table) {
    std::string text = "file,status,error,seconds,sides_confidence";
    for (const std::string& joint : table.joints)
        for (const char* what : {"_x", "_y", "_z", "_confidence"}) text += "," + joint + what;
    for (const std::string& measure : table.measures) text += "," + measure;
    if (!table.measures.empty()) text += ",unit";
    text += "\r\n";
    for (const Row& row : table.rows) {
        text += quoted(row.file) + "," + row.line.status + ",";
        if (!row.line.error.empty()) text += quoted(row.line.error);
        append_cell(text, row.line.seconds);
        append_cell(text, confidence_of(row));
        for (const std::string& name : table.joints) {
            const Joint<double>* joint = joint_of(row, name);
            for (int axis = 0; axis < 3; ++axis) append_cell(text, joint ? joint->position[axis] : unknown);
            append_cell(text, joint ? joint->confidence : unknown);
        }
        for (const std::string& name : table.measures) append_cell(text, measure_of(row, name));
        if (!table.measures.empty()) text += "," + row.unit;
        text += "\r\n";
    }
    return text;
}

// ---------------------------------------------------------------------------------------------------------------- NPZ

/// An array of a row for each mesh, of that shape; `append_row` appends its numbers.
io::NpyArray numbers(const Table& table, std::vector<std::size_t> shape, const auto& append_row) {
    io::NpyArray array;
    shape.insert(shape.begin(), table.rows.size());
    array.shape = std::move(shape);
    for (const Row& row : table.rows) append_row(row, array.numbers);
    return array;
}

io::NpyArray texts(std::vector<std::string> values) {
    io::NpyArray array;
    array.shape = {values.size()};
    array.texts = std::move(values);
    return array;
}

std::string to_npz(const Table& table) {
    std::vector<std::string> files, statuses, units;
    for (const Row& row : table.rows) {
        files.push_back(row.file);
        statuses.push_back(row.line.status);
        units.push_back(row.unit);
    }
    const std::size_t joints = table.joints.size();
    const auto of_joints = [&](const auto& value) {
        return numbers(table, {joints}, [&](const Row& row, std::vector<double>& out) {
            for (const std::string& name : table.joints) {
                const Joint<double>* joint = joint_of(row, name);
                out.push_back(joint ? value(*joint) : unknown);
            }
        });
    };
    const auto positions = numbers(table, {joints, 3}, [&](const Row& row, std::vector<double>& out) {
        for (const std::string& name : table.joints) {
            const Joint<double>* joint = joint_of(row, name);
            for (int axis = 0; axis < 3; ++axis) out.push_back(joint ? joint->position[axis] : unknown);
        }
    });
    const auto measures = numbers(table, {table.measures.size()}, [&](const Row& row, std::vector<double>& out) {
        for (const std::string& name : table.measures) out.push_back(measure_of(row, name));
    });
    const auto sides =
        numbers(table, {}, [](const Row& row, std::vector<double>& out) { out.push_back(confidence_of(row)); });
    return io::format_npz({{"files", texts(std::move(files))},
                           {"status", texts(std::move(statuses))},
                           {"sides_confidence", sides},
                           {"joints", texts(table.joints)},
                           {"positions", positions},
                           {"radius", of_joints([](const Joint<double>& joint) { return joint.radius; })},
                           {"confidence", of_joints([](const Joint<double>& joint) { return joint.confidence; })},
                           {"measures", texts(table.measures)},
                           {"measured", measures},
                           {"unit", texts(std::move(units))}});
}

} // namespace

void add_table_options(CLI::App& command, TableFiles& files) {
    command
        .add_option("--csv", files.csv,
                    "Table to write, a row for each mesh: what became of it, joints, confidences, measures; - for\n"
                    "standard output")
        ->type_name("FILE");
    command
        .add_option("--npz", files.npz,
                    "The same as arrays for numpy: files, status, joints, positions (bodies, joints, 3), radius,\n"
                    "confidence, sides_confidence, measures (their names), measured, unit; NaN for what is not known")
        ->type_name("FILE");
}

std::vector<std::string> files_of(const TableFiles& files) {
    std::vector<std::string> out;
    for (const std::string& file : {files.csv, files.npz})
        if (!file.empty()) out.push_back(file);
    return out;
}

void write_tables(const TableFiles& files, const std::vector<BatchItem>& items, const SummaryLines& lines) {
    if (files_of(files).empty()) return;
    const Table table = table_of(items, lines);
    if (!files.csv.empty()) write_result(files.csv, to_csv(table));
    if (!files.npz.empty()) write_result(files.npz, to_npz(table));
}

} // namespace skelgen::cli
