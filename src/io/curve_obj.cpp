#include <skelgen/io/curve_formats.hpp>

#include <array>
#include <cstdint>
#include <vector>

#include <skelgen/core/error.hpp>

#include "curve_builder.hpp"
#include "curve_checks.hpp"
#include "mesh_parsers.hpp"
#include "number_text.hpp"
#include "text_scanner.hpp"

namespace skelgen::io {
namespace {

constexpr std::string_view radius_comment = "# radius ";

template <typename Scalar>
class CurveObjParser {
public:
    explicit CurveObjParser(std::string_view text) : scanner_(text, "curve") {}

    CurveSkeleton<Scalar> parse() {
        while (scanner_.seek_word_or_comment()) {
            if (scanner_.at_comment())
                read_comment();
            else
                read_statement();
        }
        // A line may name nodes that follow it: which there are is known in the end.
        for (const Line& line : lines_)
            builder_.add_edge(line.a, line.b, builder_.node_count(),
                              [&](const std::string& message) { scanner_.fail_at(line.row, message); });
        return builder_.finish(fail());
    }

private:
    struct Line {
        std::int64_t a, b;
        const char* row;
    };

    [[nodiscard]] auto fail() const {
        return [this](const std::string& message) { scanner_.fail(message); };
    }

    void read_comment() {
        if (scanner_.take(radius_comment)) {
            builder_.add_radius(scanner_.template number<Scalar>("radius"), fail());
            if (!scanner_.at_line_end()) scanner_.fail("there is more than a number behind '# radius'");
        }
        scanner_.skip_line();
    }

    void read_statement() {
        const char* const row = scanner_.position();
        const std::string_view keyword = scanner_.word();
        if (keyword == "v")
            read_node(); // a comment on the same line may be its radius: no skip_line
        else if (keyword == "l")
            read_line(row);
        else if (keyword == "f")
            scanner_.fail("there is a face: this is a mesh, no curve skeleton");
        else if (detail::is_obj_keyword(keyword) || keyword == "p")
            scanner_.skip_line();
        else
            scanner_.fail("the line begins with no word that OBJ knows");
    }

    void read_node() {
        const auto node = scanner_.template coordinates<Scalar>();
        int more = 0;
        for (; !scanner_.at_line_end(); ++more) static_cast<void>(scanner_.number("weight or colour"));
        if (more == 2 || more > 4) scanner_.fail("a node has neither x y z alone, nor a weight, a colour or both");
        builder_.add_node(node, fail());
    }

    void read_line(const char* row) {
        std::int64_t before = read_end();
        int ends = 1;
        for (; !scanner_.at_line_end(); ++ends) {
            const std::int64_t next = read_end();
            lines_.push_back({before, next, row});
            before = next;
        }
        if (ends < 2) scanner_.fail("a line has one node; it must have two or more");
    }

    /// A node of a line, counted from 0; in the file from 1, or backwards from the node read last.
    std::int64_t read_end() {
        const std::int64_t written = scanner_.integer("node of a line");
        if (!scanner_.at_word_end() && !scanner_.take('/')) scanner_.fail("a line's node is not of the form v/vt");
        scanner_.skip_rest_of_word();
        if (written == 0) scanner_.fail("an edge names a node that does not exist: 0 (counted from 1)");
        return written < 0 ? static_cast<std::int64_t>(builder_.node_count()) + written : written - 1;
    }

    detail::TextScanner scanner_;
    detail::CurveBuilder<Scalar> builder_{1};
    std::vector<Line> lines_;
};

} // namespace

template <typename Scalar>
std::string curve_to_obj(const CurveSkeleton<Scalar>& curve) {
    detail::check_curve(curve, ErrorCode::usage);
    using detail::append_number;
    std::string text = "# skelgen curve skeleton\n";
    for (Eigen::Index i = 0; i < curve.nodes.rows(); ++i) {
        text += "v ";
        detail::append_point(text, curve.nodes.row(i));
        text += '\n';
        if (curve.radii.empty()) continue;
        text += radius_comment;
        append_number(text, curve.radii[static_cast<std::size_t>(i)]);
        text += '\n';
    }
    for (const auto& [a, b] : curve.edges) {
        text += "l ";
        append_number(text, a + 1);
        text += ' ';
        append_number(text, b + 1);
        text += '\n';
    }
    return text;
}

template <typename Scalar>
CurveSkeleton<Scalar> curve_from_obj(std::string_view text) {
    return CurveObjParser<Scalar>(text).parse();
}

template std::string curve_to_obj<float>(const CurveSkeleton<float>&);
template std::string curve_to_obj<double>(const CurveSkeleton<double>&);
template CurveSkeleton<float> curve_from_obj<float>(std::string_view);
template CurveSkeleton<double> curve_from_obj<double>(std::string_view);

} // namespace skelgen::io
