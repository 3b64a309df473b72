// Trust as a function of the evidence, whatever the table says that it is calibrated by.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <skelgen/search/trust.hpp>
#include <skelgen/search/trust_table.hpp>

#include "catch.hpp"

using namespace skelgen;
using namespace skelgen::search;

namespace {

Evidence usual_evidence() { return {trust_means}; }

/// A proportion, whose square is heard, too: it has a best value.
bool is_curved(std::size_t witness) {
    return std::find(curved_witnesses.begin(), curved_witnesses.end(), static_cast<Witness>(witness)) !=
           curved_witnesses.end();
}

/// The usual evidence with one witness moved, towards what speaks against a skeleton for negative ways.
Evidence with_voice(std::size_t witness, double way) {
    Evidence evidence = usual_evidence();
    evidence.values[witness] += trust_weights[witness] < 0 ? -way : way;
    return evidence;
}

double log_odds(const Evidence& evidence) {
    const double p = probability_right(evidence);
    return std::log(p / (1 - p));
}

/// Three joints, the last one absent.
KinematicSkeleton<double> three_joints() {
    KinematicSkeleton<double> skeleton;
    for (const bool is_present : {true, true, false}) {
        Joint<double> joint;
        joint.position = {static_cast<double>(skeleton.joints.size()), 1, 2};
        joint.is_present = is_present;
        skeleton.joints.push_back(joint);
    }
    return skeleton;
}

} // namespace

TEST_CASE("usual evidence is as likely as the table's offset and squares say") {
    double expected = trust_offset; // and the squares of the usual proportions, which are less than the usual squares
    for (std::size_t c = 0; c < curved_witnesses.size(); ++c) {
        const double usual = usual_evidence()[curved_witnesses[c]];
        expected += trust_square_weights[c] * (usual * usual - trust_square_means[c]);
    }
    CHECK(log_odds(usual_evidence()) == Approx(expected).margin(1e-9));
}

TEST_CASE("each witness moves the log odds as its weight says") {
    for (std::size_t w = 0; w < witness_count; ++w) {
        INFO(to_string(static_cast<Witness>(w)));
        if (is_curved(w)) continue;
        for (const double way : {-0.1, -0.01, 0.01, 0.1})
            CHECK(log_odds(with_voice(w, way)) - log_odds(usual_evidence()) ==
                  Approx(way * std::abs(trust_weights[w])).margin(1e-6));
    }
}

TEST_CASE("whatever the evidence, a probability lies within 0 and 1") {
    for (std::size_t w = 0; w < witness_count; ++w)
        for (const double way : {-100.0, -4.0, 4.0, 100.0}) {
            INFO(to_string(static_cast<Witness>(w)));
            const double probability = probability_right(with_voice(w, way));
            CHECK(probability >= 0);
            CHECK(probability <= 1);
        }
}

TEST_CASE("the square of a proportion is heard alike either way, up to a bound") {
    const auto at = [](Witness witness, double value) {
        Evidence evidence = usual_evidence();
        evidence[witness] = value;
        return log_odds(evidence);
    };
    for (std::size_t c = 0; c < curved_witnesses.size(); ++c) {
        const Witness witness = curved_witnesses[c];
        INFO(to_string(witness));
        const double bend = at(witness, 0.5) + at(witness, -0.5) - 2 * at(witness, 0);
        CHECK(bend == Approx(2 * 0.25 * trust_square_weights[c]).margin(1e-6));
        const double slope = trust_weights[static_cast<std::size_t>(witness)];
        CHECK(at(witness, 2.5) - at(witness, 2) == Approx(0.5 * slope).margin(1e-6));
    }
}

TEST_CASE("witnesses add up: two of them say what both say, in logarithms of the odds") {
    Evidence both = usual_evidence();
    const auto a = static_cast<std::size_t>(Witness::apart), b = static_cast<std::size_t>(Witness::doubt);
    both.values[a] += 0.3;
    both.values[b] += 0.2;
    Evidence one = usual_evidence(), other = usual_evidence();
    one.values[a] += 0.3;
    other.values[b] += 0.2;
    CHECK(log_odds(both) - log_odds(one) == Approx(log_odds(other) - log_odds(usual_evidence())).margin(1e-9));
}

TEST_CASE("what is refused is no guess that would end the search") {
    CHECK(least_probability > 0);
    CHECK(least_probability < 0.5);
    CHECK(sure_enough > 0.5);
    CHECK(sure_enough < 1);
}

TEMPLATE_TEST_CASE("confidences are those of what is there: of the sides the whole's, none of what is absent", "",
                   float, double) {
    KinematicSkeleton<TestType> skeleton;
    skeleton.joints.resize(3);
    skeleton.joints[1].position = {1, 2, 3};
    skeleton.joints[2].is_present = false;
    const auto trusted = with_confidence(skeleton, 0.7, {0, 1, 0});
    CHECK(trusted.quality.sides_confidence == 0.7);
    CHECK(trusted.joints[2].confidence == 0);
    for (const std::size_t j : {0, 1}) {
        CHECK(trusted.joints[j].confidence > 0);
        CHECK(trusted.joints[j].confidence < 1);
        CHECK(trusted.joints[j].position == skeleton.joints[j].position);
    }
}

TEST_CASE("the more a joint is doubted the less it is trusted, and the less the likelier the whole is") {
    double last = 1;
    for (const double doubt : {0.0, 0.5, 2.0, 9.0, 100.0}) {
        const double confidence = with_confidence(three_joints(), 0.6, {doubt, 0, 0}).joints[0].confidence;
        CHECK(confidence < last);
        last = confidence;
    }
    last = 0;
    for (const double probability : {0.05, 0.3, 0.6, 0.9, 0.99}) {
        const double confidence = with_confidence(three_joints(), probability, {1, 1, 1}).joints[1].confidence;
        CHECK(confidence > last);
        last = confidence;
    }
}

TEST_CASE("certainty either way leaves confidences that are numbers from 0 to 1") {
    for (const double probability : {0.0, 1.0})
        for (const double doubt : {0.0, 1e6}) {
            const auto trusted = with_confidence(three_joints(), probability, {doubt, doubt, doubt});
            for (const Joint<double>& joint : trusted.joints) {
                CHECK(joint.confidence >= 0);
                CHECK(joint.confidence <= 1);
            }
        }
}

TEST_CASE("the strongest doubt is the one of the witness that speaks most against it") {
    const std::map<Witness, std::string> clauses{{Witness::unmatched_reach, "belongs to no limb"},
                                                 {Witness::unexplained, "belongs to no limb"},
                                                 {Witness::reach, "too compact, or too long"},
                                                 {Witness::lacks_head, "a limb or the head"},
                                                 {Witness::lacks_limbs, "a limb or the head"},
                                                 {Witness::apart, "lie on each other"},
                                                 {Witness::doubt, "unlikely lengths"},
                                                 {Witness::outside, "outside of it"},
                                                 {Witness::legs_go_on, "four legs"},
                                                 {Witness::pairs_girths, "no person's"}};
    int heard = 0;
    for (const auto& [witness, clause] : clauses) {
        const auto w = static_cast<std::size_t>(witness);
        if (trust_weights[w] == 0) continue;
        ++heard;
        INFO(to_string(witness));
        CHECK_THAT(strongest_doubt(with_voice(w, -100)), Catch::Matchers::Contains(clause));
        Evidence both = with_voice(w, -100); // and not of one that says less
        const std::size_t other = w == 0 ? 1 : 0;
        both.values[other] = with_voice(other, -1e-3).values[other];
        CHECK_THAT(strongest_doubt(both), Catch::Matchers::Contains(clause));
    }
    CHECK(heard >= 1);
}

TEST_CASE("every witness has a name of its own, in the order of the table") {
    std::set<std::string_view> names;
    for (std::size_t w = 0; w < witness_count; ++w) names.insert(to_string(static_cast<Witness>(w)));
    CHECK(names.size() == witness_count);
    CHECK(names.count("") == 0);
    CHECK(to_string(Witness::unmatched_reach) == "unmatched_reach");
    CHECK(to_string(Witness::agreed) == "agreed");
}

TEST_CASE("of a person and an animal in one body one is right at most") {
    CHECK(probability_beside(0.83, 0) == 0.83);
    CHECK(probability_beside(0.5, 0.5) == Approx(1.0 / 3)); // even odds for each and for neither
    CHECK(probability_beside(0.9, 0.8) + probability_beside(0.8, 0.9) < 1);
    CHECK(probability_beside(1, 1) == 1);
    CHECK(probability_beside(0.9, 1 - 1e-12) < 1e-10);
}
