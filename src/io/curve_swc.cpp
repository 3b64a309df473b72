#include <skelgen/io/curve_formats.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

#include <skelgen/core/error.hpp>

#include "curve_builder.hpp"
#include "curve_checks.hpp"
#include "number_text.hpp"
#include "text_scanner.hpp"

namespace skelgen::io {
namespace {

using detail::append_number;
using Edge = std::array<int, 2>;

// What the columns cannot hold, in words that are read back.
constexpr std::string_view left_out_comment = "# left out, as it closes a cycle: the edge between ";
constexpr std::string_view unknown_radii_comment = "# radii unknown, a placeholder in their column";
constexpr std::string_view zero_radius_comment = "# radius 0, a placeholder in its column: node ";

// ---- writing ----

/// Trees that reach every node of a curve skeleton.
struct SpanningForest {
    std::vector<int> order;   ///< all nodes, parents before children
    std::vector<int> parents; ///< per node; -1 at a root
};

std::size_t root_count(const std::vector<int>& parents) {
    return static_cast<std::size_t>(std::count(parents.begin(), parents.end(), -1));
}

/// Trees of shortest hops from the lowest node of each component.
SpanningForest breadth_first(std::size_t nodes, const std::vector<Edge>& edges) {
    std::vector<std::vector<int>> neighbours(nodes);
    for (const auto& [a, b] : edges) {
        neighbours[static_cast<std::size_t>(a)].push_back(b);
        neighbours[static_cast<std::size_t>(b)].push_back(a);
    }
    SpanningForest forest;
    forest.parents.assign(nodes, -1);
    std::vector<bool> reached(nodes, false);
    for (std::size_t root = 0; root < nodes; ++root) {
        if (reached[root]) continue;
        reached[root] = true;
        std::queue<int> queue({static_cast<int>(root)});
        for (; !queue.empty(); queue.pop()) {
            const int node = queue.front();
            forest.order.push_back(node);
            for (const int next : neighbours[static_cast<std::size_t>(node)]) {
                if (reached[static_cast<std::size_t>(next)]) continue;
                reached[static_cast<std::size_t>(next)] = true;
                forest.parents[static_cast<std::size_t>(next)] = node;
                queue.push(next);
            }
        }
    }
    return forest;
}

/// Per node its lowest neighbour below itself; -1 where there is none.
std::vector<int> lowest_neighbours_below(std::size_t nodes, const std::vector<Edge>& edges) {
    std::vector<int> lowest(nodes, -1);
    for (const auto& [a, b] : edges) {
        int& known = lowest[static_cast<std::size_t>(std::max(a, b))];
        if (known < 0 || std::min(a, b) < known) known = std::min(a, b);
    }
    return lowest;
}

/// Keeps the nodes' order where it has parents first, so that what is read back is the same to the last index.
SpanningForest spanning_forest(std::size_t nodes, const std::vector<Edge>& edges) {
    SpanningForest forest = breadth_first(nodes, edges);
    std::vector<int> below = lowest_neighbours_below(nodes, edges);
    if (root_count(below) != root_count(forest.parents)) return forest;
    forest.parents = std::move(below);
    std::iota(forest.order.begin(), forest.order.end(), 0);
    return forest;
}

std::vector<int> swc_ids(const SpanningForest& forest) {
    std::vector<int> ids(forest.order.size());
    int next = 1;
    for (const int node : forest.order) ids[static_cast<std::size_t>(node)] = next++;
    return ids;
}

/// The edges that the trees lack, as pairs of ids in ascending order.
std::vector<Edge> left_out(const SpanningForest& forest, const std::vector<int>& ids, const std::vector<Edge>& edges) {
    std::vector<Edge> out;
    for (const auto& [a, b] : edges) {
        if (forest.parents[static_cast<std::size_t>(a)] == b || forest.parents[static_cast<std::size_t>(b)] == a)
            continue;
        const auto [low, high] = std::minmax(ids[static_cast<std::size_t>(a)], ids[static_cast<std::size_t>(b)]);
        out.push_back({low, high});
    }
    std::sort(out.begin(), out.end());
    return out;
}

/// A radius for where there is none: SWC wants it positive.
template <typename Scalar>
Scalar placeholder_radius(const Points<Scalar>& nodes) {
    const Scalar part = 1000;
    const Scalar radius = (nodes.colwise().maxCoeff() / part - nodes.colwise().minCoeff() / part).maxCoeff();
    return radius > 0 ? radius : Scalar(1);
}

template <typename Scalar>
void append_header(std::string& text, const CurveSkeleton<Scalar>& curve, const SpanningForest& forest,
                   const std::vector<int>& ids) {
    text += "# skelgen curve skeleton, in the unit of the mesh\n";
    for (const auto& [a, b] : left_out(forest, ids, curve.edges)) {
        text += left_out_comment;
        append_number(text, a);
        text += ' ';
        append_number(text, b);
        text += '\n';
    }
    if (curve.radii.empty()) {
        text += unknown_radii_comment;
        text += '\n';
    }
    for (const int node : forest.order) {
        if (curve.radii.empty() || curve.radii[static_cast<std::size_t>(node)] > 0) continue;
        text += zero_radius_comment;
        append_number(text, ids[static_cast<std::size_t>(node)]);
        text += '\n';
    }
    text += "# id type x y z radius parent\n";
}

// ---- reading ----

template <typename Scalar>
class CurveSwcParser {
public:
    explicit CurveSwcParser(std::string_view text) : scanner_(text, "curve") {}

    CurveSkeleton<Scalar> parse() {
        while (scanner_.seek_word_or_comment()) {
            if (scanner_.at_comment())
                read_comment();
            else
                read_node(); // no skip_line: a comment may follow on the same line
        }
        add_left_out_edges();
        correct_radii();
        return builder_.finish(fail());
    }

private:
    struct LeftOut {
        std::int64_t a, b; ///< ids
        const char* row;
    };
    struct ZeroRadius {
        std::int64_t id;
        const char* row;
    };

    [[nodiscard]] auto fail() const {
        return [this](const std::string& message) { scanner_.fail(message); };
    }

    void read_comment() {
        const char* const row = scanner_.position();
        if (scanner_.take(left_out_comment)) {
            const std::int64_t a = scanner_.whole_integer("first node of the edge");
            left_out_.push_back({a, scanner_.whole_integer("second node of the edge"), row});
            if (!scanner_.at_line_end()) scanner_.fail("there is more than two nodes of an edge that was left out");
        } else if (scanner_.take(zero_radius_comment)) {
            zero_radii_.push_back({scanner_.whole_integer("node of radius 0"), row});
            if (!scanner_.at_line_end()) scanner_.fail("there is more than one node of radius 0");
        } else if (scanner_.take(unknown_radii_comment)) {
            radii_are_known_ = false;
        }
        scanner_.skip_line();
    }

    void read_node() {
        const char* const row = scanner_.position();
        const auto expected = static_cast<std::int64_t>(builder_.node_count()) + 1;
        const std::int64_t id = scanner_.whole_integer("node's id");
        if (id != expected)
            scanner_.fail_at(row, "a node has the id " + std::to_string(id) + " where " + std::to_string(expected) +
                                      " is expected; ids are 1, 2, 3, ... without gaps");
        static_cast<void>(scanner_.whole_integer("type"));
        const auto node = scanner_.template coordinates<Scalar>();
        const auto radius = scanner_.template number<Scalar>("radius");
        const std::int64_t parent = scanner_.whole_integer("parent");
        if (!scanner_.at_line_end()) scanner_.fail("there are more than the seven fields id type x y z radius parent");
        builder_.add_node(node, fail());
        builder_.add_radius(radius, fail());
        if (parent == -1) return;
        if (parent >= id || parent < 1) fail_for_parent(id, parent);
        builder_.add_edge(parent - 1, id - 1, builder_.node_count(), fail());
    }

    [[noreturn]] void fail_for_parent(std::int64_t id, std::int64_t parent) const {
        const std::string named = "node " + std::to_string(id) + " has the parent " + std::to_string(parent);
        if (parent == id) scanner_.fail(named + ", itself");
        detail::TextScanner ahead = scanner_;
        std::int64_t last = id;
        for (ahead.skip_line(); ahead.seek_word(); ahead.skip_line()) ++last;
        if (parent < 1 || parent > last) scanner_.fail(named + ", which does not exist; a root has -1");
        scanner_.fail(named + ", which comes after it; parents come first");
    }

    void add_left_out_edges() {
        for (const LeftOut& edge : left_out_) {
            // Ids are up to 18 digits of either sign: no difference overflows.
            builder_.add_edge(edge.a - 1, edge.b - 1, builder_.node_count(),
                              [&](const std::string& message) { scanner_.fail_at(edge.row, message); });
        }
    }

    void correct_radii() {
        for (const auto& [id, row] : zero_radii_) {
            if (id < 1 || static_cast<std::uint64_t>(id) > builder_.node_count())
                scanner_.fail_at(row, "a radius is that of a node that does not exist: " + std::to_string(id));
            builder_.set_radius(static_cast<std::size_t>(id - 1), 0);
        }
        if (!radii_are_known_) builder_.clear_radii();
    }

    detail::TextScanner scanner_;
    detail::CurveBuilder<Scalar> builder_{1};
    std::vector<LeftOut> left_out_;
    std::vector<ZeroRadius> zero_radii_;
    bool radii_are_known_ = true;
};

} // namespace

template <typename Scalar>
std::string curve_to_swc(const CurveSkeleton<Scalar>& curve) {
    detail::check_curve(curve, ErrorCode::usage);
    const SpanningForest forest = spanning_forest(static_cast<std::size_t>(curve.nodes.rows()), curve.edges);
    const std::vector<int> ids = swc_ids(forest);
    const auto id_of = [&ids](int node) { return node < 0 ? -1 : ids[static_cast<std::size_t>(node)]; };
    const Scalar placeholder = placeholder_radius(curve.nodes);

    std::string text;
    append_header(text, curve, forest, ids);
    for (const int node : forest.order) {
        append_number(text, id_of(node));
        text += " 0 "; // type 0: undefined
        detail::append_point(text, curve.nodes.row(node));
        text += ' ';
        const Scalar radius = curve.radii.empty() ? Scalar(0) : curve.radii[static_cast<std::size_t>(node)];
        append_number(text, radius > 0 ? radius : placeholder);
        text += ' ';
        append_number(text, id_of(forest.parents[static_cast<std::size_t>(node)]));
        text += '\n';
    }
    return text;
}

template <typename Scalar>
CurveSkeleton<Scalar> curve_from_swc(std::string_view text) {
    return CurveSwcParser<Scalar>(text).parse();
}

template std::string curve_to_swc<float>(const CurveSkeleton<float>&);
template std::string curve_to_swc<double>(const CurveSkeleton<double>&);
template CurveSkeleton<float> curve_from_swc<float>(std::string_view);
template CurveSkeleton<double> curve_from_swc<double>(std::string_view);

} // namespace skelgen::io
