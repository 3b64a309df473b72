#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>

#include <skelgen/core/geometry.hpp>
#include <skelgen/core/precision.hpp>
#include <skelgen/core/skeleton_template.hpp>
#include <skelgen/hands/digit.hpp>
#include <skelgen/hands/impl/digit_tubes.hpp>
#include <skelgen/hands/impl/hand_surface.hpp>
#include <skelgen/hands/impl/phalanx_fit.hpp>

namespace skelgen::hands {

namespace detail {

/// How far from its end a digit's joints lie, from the knuckle on, relative to its length beyond the web.
template <typename Scalar>
std::array<Scalar, phalanges> joint_parts(Digit digit) {
    constexpr std::array<std::array<double, phalanges>, 5> parts{
        {{1.80, 1.24, 0.57}, {1.30, 0.79, 0.38}, {1.24, 0.76, 0.35}, {1.28, 0.80, 0.39}, {1.36, 0.83, 0.40}}};
    std::array<Scalar, phalanges> out{};
    for (std::size_t k = 0; k < phalanges; ++k) out[k] = static_cast<Scalar>(parts[static_cast<std::size_t>(digit)][k]);
    return out;
}

template <typename Scalar>
Vector3<Scalar> direction(const Vector3<Scalar>& v) {
    const Scalar length = v.norm();
    return length > 0 ? Vector3<Scalar>(v / length) : v;
}

/// Where a tube is one: rings at the web itself lean towards the palm.
template <typename Scalar>
std::size_t first_sound(const DigitTube<Scalar>& tube) {
    return tube.axis.size() / 12;
}

/// Which way a tube leaves the hand: from there to its next joint, over its first quarter.
template <typename Scalar>
Vector3<Scalar> base_direction(const DigitTube<Scalar>& tube) {
    return direction<Scalar>(tube.axis[tube.axis.size() / 4] - tube.axis[first_sound(tube)]);
}

/// A place on a tube's axis, that far from its end along it; beyond the web straight on.
template <typename Scalar>
struct OnAxis {
    Vector3<Scalar> place;
    Scalar radius = 0;
};

template <typename Scalar>
Scalar axis_length(const DigitTube<Scalar>& tube) {
    Scalar length = 0;
    for (std::size_t i = 1; i < tube.axis.size(); ++i) length += (tube.axis[i] - tube.axis[i - 1]).norm();
    return length;
}

template <typename Scalar>
OnAxis<Scalar> from_end(const DigitTube<Scalar>& tube, Scalar distance) {
    const std::size_t first = first_sound(tube);
    for (std::size_t i = tube.axis.size() - 1; i > first; --i) {
        const Vector3<Scalar> step = tube.axis[i - 1] - tube.axis[i];
        const Scalar length = step.norm();
        if (distance <= length && length > 0) {
            const Scalar part = distance / length;
            return {tube.axis[i] + part * step, tube.radii[i] + part * (tube.radii[i - 1] - tube.radii[i])};
        }
        distance -= length;
    }
    return {tube.axis[first] - distance * base_direction(tube), tube.radii[first]};
}

/// The mean radius of a tube beyond its middle, but for its tip: the tube of a finger alone begins at the thumb's web,
/// in the palm.
template <typename Scalar>
Scalar outer_radius(const DigitTube<Scalar>& tube) {
    const std::size_t first = tube.radii.size() / 2, last = 3 * tube.radii.size() / 4 + 1;
    Scalar sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += tube.radii[i];
    return sum / static_cast<Scalar>(last - first);
}

/// How many digits side by side have that girth, relative to one of them: each one more adds two diameters.
template <typename Scalar>
std::size_t digits_in(Scalar girth) {
    constexpr Scalar clearly = Scalar(1.45); // of a girth: 1.64 for two
    if (girth < clearly) return 1;
    return 1 + static_cast<std::size_t>(std::max(Scalar(1), std::round((girth - 1) * std::numbers::pi_v<Scalar> / 2)));
}

/// How much wider than thick a tube is between its web and its end, by second moments: 1 where it is round.
template <typename Scalar>
Scalar flatness(const DigitTube<Scalar>& tube) {
    const std::size_t first = tube.axis.size() / 3, last = 5 * tube.axis.size() / 6;
    Eigen::Matrix3<Scalar> moments = Eigen::Matrix3<Scalar>::Zero();
    for (std::size_t i = 0; i < tube.points.size(); ++i) {
        Vector3<Scalar> off = tube.points[i] - tube.axis.back();
        std::size_t nearest = tube.axis.size() - 1;
        for (std::size_t k = 0; k + 1 < tube.axis.size(); ++k) {
            const Vector3<Scalar> step = tube.axis[k + 1] - tube.axis[k], from = tube.points[i] - tube.axis[k];
            const Scalar square = step.squaredNorm();
            const Scalar part = square > 0 ? std::clamp(step.dot(from) / square, Scalar(0), Scalar(1)) : Scalar(0);
            const Vector3<Scalar> own = from - part * step;
            if (own.squaredNorm() >= off.squaredNorm()) continue;
            off = own;
            nearest = k;
        }
        if (nearest >= first && nearest < last) core::add_outer_product<Scalar>(moments, tube.areas[i], off);
    }
    const Vector3<Scalar> squares = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3<Scalar>>(moments).eigenvalues();
    return squares[1] > 0 ? std::sqrt(squares[2] / squares[1]) : Scalar(1);
}

/// Which of the tubes is the thumb.
template <typename Scalar>
std::optional<std::size_t> find_thumb(const std::vector<DigitTube<Scalar>>& tubes, Scalar length) {
    // Of the hand's length, calibrated: thumbs leave it 0.14 and more before fingers of people, 0.04 of figures. One of
    // five is the thumb in any case.
    const Scalar apart = Scalar(tubes.size() == all_digits.size() ? 0 : 0.03);
    if (tubes.size() < 2) return std::nullopt;
    if (tubes.size() == 2) return outer_radius(tubes[0]) < outer_radius(tubes[1]) ? 0 : 1;
    std::size_t first = 0;
    for (std::size_t i = 1; i < tubes.size(); ++i)
        if (tubes[i].joins < tubes[first].joins) first = i;
    for (std::size_t i = 0; i < tubes.size(); ++i)
        if (i != first && tubes[i].joins - tubes[first].joins < apart * length) return std::nullopt;
    return first;
}

/// The tubes but the thumb, in the order in which they stand, from the thumb's side on.
template <typename Scalar>
std::vector<std::size_t> in_a_row(const std::vector<DigitTube<Scalar>>& tubes, std::optional<std::size_t> thumb) {
    std::vector<std::size_t> row;
    Vector3<Scalar> mean = Vector3<Scalar>::Zero();
    for (std::size_t i = 0; i < tubes.size(); ++i) {
        if (i == thumb) continue;
        row.push_back(i);
        mean += tubes[i].axis.front();
    }
    if (row.size() < 2) return row;
    mean /= static_cast<Scalar>(row.size());
    Eigen::Matrix3<Scalar> moments = Eigen::Matrix3<Scalar>::Zero();
    for (const std::size_t i : row) core::add_outer_product<Scalar>(moments, 1, tubes[i].axis.front() - mean);
    const Vector3<Scalar> along = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3<Scalar>>(moments).eigenvectors().col(2);
    const auto at = [&](std::size_t i) { return along.dot(tubes[i].axis.front() - mean); };
    std::sort(row.begin(), row.end(), [&](std::size_t a, std::size_t b) { return at(a) < at(b); });
    const auto from_thumb = [&](std::size_t i) { return (tubes[i].axis.front() - tubes[*thumb].axis.front()).norm(); };
    const bool is_reversed =
        thumb ? from_thumb(row.front()) > from_thumb(row.back()) : tubes[row.front()].ends < tubes[row.back()].ends;
    if (is_reversed) std::reverse(row.begin(), row.end());
    return row;
}

/// How many digits each tube of a row is, of that many in all: one where it is round, however thick.
template <typename Scalar>
std::vector<std::size_t> widths_in_digits(const std::vector<DigitTube<Scalar>>& tubes,
                                          const std::vector<std::size_t>& row, Scalar thinnest, std::size_t digits) {
    // Two round ones side by side that are clearly two by their girth are 1.44 as wide as thick; one that is generated
    // is 1.18 at most.
    constexpr Scalar flat = Scalar(1.3);
    std::vector<std::size_t> widths;
    std::size_t spare = digits - std::min(digits, row.size());
    for (const std::size_t i : row) {
        std::size_t more = std::min(spare, digits_in<Scalar>(outer_radius(tubes[i]) / thinnest) - 1);
        if (tubes[i].is_alone)
            more = spare;
        else if (more > 0 && flatness(tubes[i]) < flat)
            more = 0;
        widths.push_back(1 + more);
        spare -= widths.back() - 1;
    }
    return widths;
}

/// The digit with the joints of its phalanges where its surface bends. The thumb's second one lies in its web, which
/// hides where that is: of the thumb the last one alone.
template <typename Scalar>
FoundDigit<Scalar> with_fitted_joints(FoundDigit<Scalar> digit, const DigitTube<Scalar>& tube) {
    constexpr Scalar of_end = Scalar(0.8); // the end's radius, of the digit's
    const std::array<Scalar, phalanges> parts = joint_parts<Scalar>(digit.digit);
    const std::size_t first = digit.digit == Digit::thumb ? 1 : 0, first_fitted = 2 * first;
    PhalanxChain<Scalar> chain;
    ExpectedPhalanges<Scalar> expected;
    expected.length = parts[first] * axis_length(tube);
    for (std::size_t k = first; k < phalanges; ++k) {
        chain.places.push_back(digit.joints[k]);
        chain.radii.push_back(outer_radius(tube));
        const Scalar next = k + 1 < phalanges ? parts[k + 1] : Scalar(0);
        expected.shares.push_back((parts[k] - next) / parts[first]);
    }
    chain.radii.push_back(of_end * outer_radius(tube));
    chain.places.push_back(digit.tip - chain.radii.back() * direction<Scalar>(digit.tip - digit.joints.back()));
    chain = fit_phalanges(tube, std::move(chain), expected);
    for (std::size_t k = first_fitted; k < phalanges; ++k) {
        digit.joints[k] = chain.places[k - first];
        digit.radii[k] = chain.radii[k - first];
    }
    return digit;
}

/// A digit with its joints on a tube, that is so many digits.
template <typename Scalar>
FoundDigit<Scalar> on_tube(const DigitTube<Scalar>& tube, Digit digit, const HandPlace<Scalar>& place,
                           std::size_t width) {
    constexpr Scalar clear = Scalar(0.25); // of the hand's length, that a finger of people stands out by, and more
    FoundDigit<Scalar> out;
    out.digit = digit;
    out.tip = tube.axis.back();
    out.web = tube.axis.front();
    out.vertices = tube.vertices;
    const Scalar length = axis_length(tube);
    const std::array<Scalar, phalanges> parts = joint_parts<Scalar>(digit);
    // A hand that is all one has its knuckles where the skeleton says.
    const Scalar knuckle = tube.is_alone ? (place.knuckles - out.tip).norm() / length : parts.front();
    for (std::size_t k = 0; k < phalanges; ++k) {
        const OnAxis<Scalar> at = from_end<Scalar>(tube, parts[k] / parts.front() * knuckle * length);
        out.joints[k] = at.place;
        out.radii[k] = at.radius;
    }
    if (width == 1 && !tube.is_alone) out = with_fitted_joints(std::move(out), tube);
    // The thumb's metacarpal lies in the palm, between its second joint and the wrist.
    constexpr Scalar to_wrist = Scalar(0.4);
    if (digit == Digit::thumb) out.joints[0] = out.joints[1] + to_wrist * (place.wrist - out.joints[1]);
    out.confidence = static_cast<double>(std::min(Scalar(1), (tube.ends - tube.joins) / (clear * place.length())));
    return out;
}

/// The axis about which a digit bends: across its own bend where there is one that agrees, else as the palm has it.
template <typename Scalar>
Vector3<Scalar> hinge_of(const FoundDigit<Scalar>& digit, const Vector3<Scalar>& towards) {
    constexpr Scalar bent = Scalar(0.25); // sine of the least bend that says how: about 15 degrees
    const Vector3<Scalar> first = direction<Scalar>(digit.joints[1] - digit.joints[0]);
    const Vector3<Scalar> last = direction<Scalar>(digit.tip - digit.joints[2]);
    const Vector3<Scalar> expected = direction<Scalar>(first.cross(towards)), own = first.cross(last);
    constexpr Scalar agrees = Scalar(0.7); // within 45 degrees
    if (own.norm() > bent && own.normalized().dot(expected) > agrees) return own.normalized();
    return expected;
}

} // namespace detail

/// Names the digits of a hand and divides them into phalanges. The thumb is the one that leaves the hand clearly
/// nearest to the forearm, of two the thinner one; the others stand in a row from it on: index, middle, ring, little,
/// and where there are fewer, the last ones are missing; without a thumb the little finger is at the end where they are
/// shorter. One that is as wide as several, and flat, is these together. Joints are first put on the digit's axis, at
/// the parts of its length beyond the web that they have in people and in characters alike (medians of the rigs of five
/// groups of makers), the knuckle behind the web straight on. Those of digits that are one each are then fitted to the
/// surface (`fit_phalanges`). In the order of the digits; empty without tubes. O(points of the tubes).
template <typename Scalar>
std::vector<FoundDigit<Scalar>> name_digits(const std::vector<DigitTube<Scalar>>& tubes, const HandPlace<Scalar>& place,
                                            Side side) {
    std::vector<FoundDigit<Scalar>> out;
    const auto thumb = detail::find_thumb<Scalar>(tubes, place.length());
    const std::vector<std::size_t> row = detail::in_a_row<Scalar>(tubes, thumb);
    if (row.empty()) return out;

    // Figures' fingers are thicker than their thumbs: only where all of them are clearly so, or one is alone, is the
    // thumb what one digit's girth is told by.
    Scalar thinnest = detail::outer_radius(tubes[row.front()]);
    for (const std::size_t i : row) thinnest = std::min(thinnest, detail::outer_radius(tubes[i]));
    if (thumb)
        if (const Scalar of_thumb = detail::outer_radius(tubes[*thumb]);
            row.size() == 1 || detail::digits_in<Scalar>(thinnest / of_thumb) > 1)
            thinnest = of_thumb;
    constexpr std::size_t fingers = 4;
    const std::vector<std::size_t> widths = detail::widths_in_digits(tubes, row, thinnest, fingers);
    if (thumb) out.push_back(detail::on_tube(tubes[*thumb], Digit::thumb, place, 1));
    std::size_t next = 1;
    for (std::size_t k = 0; k < row.size() && next < all_digits.size(); ++k) {
        FoundDigit<Scalar> digit = detail::on_tube(tubes[row[k]], all_digits[next++], place, widths[k]);
        for (std::size_t more = 1; more < widths[k] && next < all_digits.size(); ++more)
            digit.fused.push_back(all_digits[next++]);
        out.push_back(std::move(digit));
    }

    // Out of the palm: from the fingers' direction and where the thumb is, as the hand's side has it.
    Vector3<Scalar> forward = Vector3<Scalar>::Zero(), middle = Vector3<Scalar>::Zero();
    for (const std::size_t i : row) {
        forward += detail::base_direction(tubes[i]);
        middle += tubes[i].axis.front() / static_cast<Scalar>(row.size());
    }
    Vector3<Scalar> to_thumb = tubes[row.front()].axis.front() - tubes[row.back()].axis.front();
    if (row.size() == 1) to_thumb = thumb ? Vector3<Scalar>(tubes[*thumb].axis.front() - middle) : to_thumb;
    const Vector3<Scalar> palm =
        static_cast<Scalar>(sign_of(side)) * detail::direction<Scalar>(forward.cross(to_thumb));
    for (FoundDigit<Scalar>& digit : out) {
        const bool is_thumb = digit.digit == Digit::thumb;
        digit.hinge = detail::hinge_of<Scalar>(digit, is_thumb ? Vector3<Scalar>(middle - digit.web) : palm);
    }
    return out;
}

/// Names the toes of a foot from the big one, which is on its inner side, and gives each two joints. The first one is
/// behind its web by three quarters of the way from the webs to the ball of the foot, the second one in the middle of
/// the toe. One that is as wide as several is these together; fewer than two tubes show no toes. `up` leads from the
/// ball towards the ankle. In the order of the digits. O(tubes).
template <typename Scalar>
std::vector<FoundDigit<Scalar>> name_toes(const std::vector<DigitTube<Scalar>>& tubes, const HandPlace<Scalar>& place,
                                          Side side, const Vector3<Scalar>& up) {
    // Both as MakeHuman's rig has them: of the way from the webs to the ball, and of that from the ends to the ball.
    constexpr Scalar first = Scalar(0.75), middle = Scalar(0.45);
    constexpr Scalar clear = Scalar(0.12);     // of the place's length, that a toe stands out by, and more
    constexpr Scalar of_big_toe = Scalar(0.8); // how thick the second one is; the others are thinner
    if (tubes.size() < 2) return {};
    // The end of the foot is that of the big toe: forwards is where all point to, along the sole.
    const Vector3<Scalar> to_end = detail::direction<Scalar>(place.tip - place.knuckles);
    const Vector3<Scalar> from_sole = detail::direction<Scalar>(up - up.dot(to_end) * to_end);
    const Vector3<Scalar> inwards = static_cast<Scalar>(sign_of(side)) * to_end.cross(up);
    std::vector<std::size_t> row;
    Vector3<Scalar> forward = Vector3<Scalar>::Zero(), web = Vector3<Scalar>::Zero();
    for (std::size_t i = 0; i < tubes.size(); ++i) {
        row.push_back(i);
        forward += tubes[i].axis.back() - tubes[i].axis.front();
        web += tubes[i].axis.front() / static_cast<Scalar>(tubes.size());
    }
    forward = detail::direction<Scalar>(forward - forward.dot(from_sole) * from_sole);
    Scalar to_ball = forward.dot(web - place.knuckles);
    to_ball = std::max(to_ball, Scalar(0));
    std::sort(row.begin(), row.end(), [&](std::size_t a, std::size_t b) {
        return inwards.dot(tubes[a].axis.front()) > inwards.dot(tubes[b].axis.front());
    });
    const Scalar usual = of_big_toe * detail::outer_radius(tubes[row.front()]);
    const std::vector<std::size_t> widths = detail::widths_in_digits(tubes, row, usual, all_digits.size());

    std::vector<FoundDigit<Scalar>> out;
    std::size_t next = 0;
    for (std::size_t k = 0; k < row.size() && next < all_digits.size(); ++k) {
        const DigitTube<Scalar>& tube = tubes[row[k]];
        FoundDigit<Scalar>& toe = out.emplace_back();
        toe.digit = all_digits[next++];
        for (std::size_t more = 1; more < widths[k] && next < all_digits.size(); ++more)
            toe.fused.push_back(all_digits[next++]);
        toe.tip = tube.axis.back();
        toe.web = tube.axis.front();
        toe.vertices = tube.vertices;
        const Scalar beyond_web = detail::axis_length(tube), from_tip = middle * (to_ball + beyond_web);
        const auto on_tube = detail::from_end<Scalar>(tube, std::min(from_tip, beyond_web));
        const Scalar behind_web = std::max(from_tip - beyond_web, Scalar(0));
        toe.joints = {toe.web - first * to_ball * forward, on_tube.place - behind_web * forward, toe.tip};
        toe.radii = {tube.radii[detail::first_sound(tube)], on_tube.radius, Scalar(0)};
        toe.hinge = detail::direction<Scalar>((toe.joints[1] - toe.joints[0]).cross(-up));
        toe.confidence = static_cast<double>(std::min(Scalar(1), (tube.ends - tube.joins) / (clear * place.length())));
    }
    return out;
}

} // namespace skelgen::hands
