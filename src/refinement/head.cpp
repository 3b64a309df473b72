#include <skelgen/refinement/head.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

namespace skelgen {
namespace {

// Calibrated on 50 registered bodies; as parts of the distance from the neck joint to the top of the head.
constexpr double adult_throat = 0.82, adult_length = 0.92;

/// One slice of a head: its contour and the axes of that, longer one first.
struct Slice {
    CrossSection section;
    Vector3<double> centre; ///< of the contour
    Vector3<double> major, minor;
    double diameter = 0; ///< extent along `major`
};

/// Length-weighted mean and covariance of contours.
struct Moments {
    double weight = 0;
    Vector3<double> first = Vector3<double>::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

    void add(const CrossSection& section, const Vector3<double>& origin) {
        const Eigen::Index n = section.points.rows();
        for (Eigen::Index i = 0; i < n; ++i) {
            const Vector3<double> middle =
                (section.points.row(i) + section.points.row((i + 1) % n)).transpose() / 2 - origin;
            weight += section.lengths[i];
            first += section.lengths[i] * middle;
            second += section.lengths[i] * middle * middle.transpose();
        }
    }
    [[nodiscard]] Vector3<double> mean() const { return first / weight; }
    [[nodiscard]] Eigen::Matrix3d covariance() const { return second / weight - mean() * mean().transpose(); }
};

double extent(const CrossSection& section, const Vector3<double>& direction) {
    const Eigen::VectorXd along = section.points * direction;
    return along.maxCoeff() - along.minCoeff();
}

std::optional<Slice> cut(const Slicer& slicer, const Vector3<double>& point, const Vector3<double>& up, double reach) {
    auto section = slicer.around(point, up, reach);
    if (!section || !(section->perimeter > 0)) return std::nullopt;
    Slice out{std::move(*section), {}, {}, {}, 0};
    Moments moments;
    moments.add(out.section, point);
    out.centre = point + moments.mean();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments.covariance());
    out.major = axes.eigenvectors().col(2);
    out.minor = up.cross(out.major).normalized();
    out.diameter = extent(out.section, out.major);
    return out;
}

/// Slices from the top down to the throat; the last one is the throat's, the others are the head's.
std::vector<Slice> slices_of(const Slicer& slicer, const Vector3<double>& top, const Vector3<double>& neck,
                             const Vector3<double>& up, const HeadOptions& options) {
    const double height = (top - neck).dot(up), step = options.slice * height;
    std::vector<Slice> slices;
    double largest = 0;
    Vector3<double> at = top - step * up;
    for (double depth = step; depth < 2.5 * height; depth += step, at -= step * up) {
        auto slice = cut(slicer, at, up, 0.5 * height);
        if (!slice) break;
        at = slice->section.centroid; // follow the head, not the plumb line
        // RB12's rules: shrunk markedly from the largest slice, or the longer axis turned from along the head to across
        // the shoulders. Both only below the skull's widest part.
        const bool throat = depth > 0.4 * height && slice->diameter < options.throat * largest;
        const bool turned = depth > 0.7 * height && !slices.empty() && slice->diameter > largest &&
                            std::abs(slice->major.dot(slices[slices.size() / 2].major)) < 0.5;
        largest = std::max(largest, slice->diameter);
        slices.push_back(std::move(*slice));
        if (throat || turned) break;
    }
    return slices;
}

/// How clearly the head faces `head.forward` (positive) or away (negative). Two signs: under the skull the jaw lies to
/// the front, so that slices' centres move forward from top to bottom; and slices are egg-shaped, narrower at the
/// front.
double frontness(const std::vector<Slice>& slices, const HeadShape& head) {
    double egg = 0, perimeter = 0, n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i + 1 < slices.size(); ++i) {
        const CrossSection& section = slices[i].section;
        egg += section.perimeter * egg_shape(section, head.forward);
        perimeter += section.perimeter;
        const double depth = static_cast<double>(i + 1) / static_cast<double>(slices.size());
        const double centre = slices[i].centre.dot(head.forward);
        n += 1;
        x += depth;
        y += centre;
        xx += depth * depth;
        xy += depth * centre;
    }
    const double jaw = (n * xy - x * y) / (n * xx - x * x);
    return (jaw / 4 + 4 * egg / perimeter) / head.length;
}

/// The thinnest section below the middle of the head and above shoulders or chest, found in steps of `step`.
std::optional<Vector3<double>> find_throat(const Slicer& slicer, const HeadShape& head, double height, double step) {
    constexpr double clearly = 1.15; // times thicker
    double head_thickness = 0, thinnest = 0;
    std::optional<Vector3<double>> throat;
    Vector3<double> at = head.centroid;
    for (double depth = 0; depth < 1.5 * height; depth += step, at -= step * head.up) {
        const auto section = slicer.around(at, head.up, 0.5 * height);
        if (!section) break;
        at = section->centroid;
        head_thickness = std::max(head_thickness, depth < 0.3 * height ? section->thickness : 0);
        if (!throat || section->thickness < thinnest) {
            throat = at;
            thinnest = section->thickness;
        } else if (section->thickness > clearly * thinnest && head_thickness > clearly * thinnest) {
            return throat;
        }
    }
    return std::nullopt;
}

} // namespace

std::optional<HeadShape> measure_head(const Slicer& slicer, const Vector3<double>& top, const Vector3<double>& neck,
                                      const HeadOptions& options) {
    HeadShape out;
    out.up = (top - neck).normalized();
    std::vector<Slice> slices;
    for (int round = 0; round < 2;
         ++round) { // the top of the head says roughly where up is, its centroid says it better
        slices = slices_of(slicer, top, neck, out.up, options);
        if (slices.size() < 5) return std::nullopt;
        Vector3<double> sum = Vector3<double>::Zero();
        double weight = 0;
        for (std::size_t i = 0; i + 1 < slices.size(); ++i) {
            sum += slices[i].section.perimeter * slices[i].centre;
            weight += slices[i].section.perimeter;
        }
        out.centroid = sum / weight;
        if (round == 0) out.up = (out.centroid - neck).normalized();
    }

    Moments moments;
    for (std::size_t i = 0; i + 1 < slices.size(); ++i) moments.add(slices[i].section, slices[i].centre);
    Eigen::Matrix3d across = moments.covariance();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(across);
    const double longer = axes.eigenvalues()[2], shorter = axes.eigenvalues()[1];
    if (!(longer > 1.02 * shorter)) return std::nullopt;
    out.forward = axes.eigenvectors().col(2);
    out.forward = (out.forward - out.forward.dot(out.up) * out.up).normalized();
    const Vector3<double> side = out.up.cross(out.forward);
    for (std::size_t i = 0; i + 1 < slices.size(); ++i) {
        out.length = std::max(out.length, extent(slices[i].section, out.forward));
        out.breadth = std::max(out.breadth, extent(slices[i].section, side));
    }
    out.frontness = frontness(slices, out);
    if (out.frontness < 0) {
        out.forward = -out.forward;
        out.frontness = -out.frontness;
    }

    const double height = (top - neck).norm();
    if (out.length > options.longest * height) return std::nullopt;
    const double throat = (top - slices.back().centre).dot(out.up) / height;
    out.size = std::min(throat / adult_throat, out.length / (adult_length * height));
    out.throat = find_throat(slicer, out, height, options.slice / 2 * height);
    std::size_t nose = 0;
    double farthest = 0;
    for (std::size_t i = 0; i + 1 < slices.size(); ++i) {
        const double reach = (slices[i].section.points * out.forward).maxCoeff() - out.centroid.dot(out.forward);
        if (reach > farthest) {
            farthest = reach;
            nose = i;
        }
    }
    const double nose_height = (slices[nose].section.points.row(0).transpose() - out.centroid).dot(out.up);
    out.joint = out.centroid + nose_height * out.up - options.joint_back * out.length * out.forward;
    return out;
}

} // namespace skelgen
