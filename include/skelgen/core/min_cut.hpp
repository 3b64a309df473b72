#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace skelgen::core {

/// A network of nodes 0, 1, ... and arcs that cost something to cut; finds the cheapest cut between two of its nodes by
/// blocking flows (Din70).
class CutNetwork {
public:
    explicit CutNetwork(std::size_t nodes) : arcs_of_(nodes), level_(nodes), next_(nodes) {}

    /// Joins two nodes; `there` is what it costs to cut where the first stays with the source, `back` where the second
    /// does. Both are 0 or more.
    void join(std::size_t from, std::size_t to, double there, double back) {
        arcs_of_[from].push_back(arcs_.size());
        arcs_.push_back({to, there});
        arcs_of_[to].push_back(arcs_.size());
        arcs_.push_back({from, back});
        least_ = std::numeric_limits<double>::epsilon() * (largest_ = std::max({largest_, there, back}));
    }

    /// Which nodes stay with the source in the cheapest cut, of several that with the fewest nodes. Uses the network
    /// up. O(nodes^2 arcs) at worst, near linear on surfaces.
    [[nodiscard]] std::vector<bool> source_side(std::size_t source, std::size_t sink) {
        while (find_levels(source, sink)) {
            next_.assign(next_.size(), 0);
            while (push(source, sink)) {
            }
        }
        std::vector<bool> out;
        for (const int level : level_) out.push_back(level >= 0);
        return out;
    }

private:
    struct Arc {
        std::size_t to;
        double capacity; ///< that is left
    };

    /// How many arcs with capacity each node is from the source; -1 where none lead to it. \returns whether some lead
    /// to the sink.
    bool find_levels(std::size_t source, std::size_t sink) {
        level_.assign(level_.size(), -1);
        level_[source] = 0;
        std::vector<std::size_t> front{source};
        for (std::size_t i = 0; i < front.size(); ++i)
            for (const std::size_t a : arcs_of_[front[i]])
                if (const Arc& arc = arcs_[a]; arc.capacity > least_ && level_[arc.to] < 0) {
                    level_[arc.to] = level_[front[i]] + 1;
                    front.push_back(arc.to);
                }
        return level_[sink] >= 0;
    }

    /// Sends what one way through the levels can take. \returns whether there was such a way.
    bool push(std::size_t source, std::size_t sink) {
        std::vector<std::size_t> way; // arcs
        std::size_t at = source;
        while (at != sink) {
            std::size_t& next = next_[at];
            while (next < arcs_of_[at].size() && !leads_on(at, arcs_of_[at][next])) ++next;
            if (next < arcs_of_[at].size()) {
                way.push_back(arcs_of_[at][next]);
                at = arcs_[way.back()].to;
                continue;
            }
            if (way.empty()) return false; // a dead end: back, and not here again
            at = arcs_[way.back() ^ 1U].to;
            way.pop_back();
            ++next_[at];
        }
        double most = std::numeric_limits<double>::infinity();
        for (const std::size_t a : way) most = std::min(most, arcs_[a].capacity);
        for (const std::size_t a : way) {
            arcs_[a].capacity -= most;
            arcs_[a ^ 1U].capacity += most;
        }
        return true;
    }

    [[nodiscard]] bool leads_on(std::size_t from, std::size_t a) const {
        return arcs_[a].capacity > least_ && level_[arcs_[a].to] == level_[from] + 1;
    }

    std::vector<Arc> arcs_; ///< each beside its reverse
    std::vector<std::vector<std::size_t>> arcs_of_;
    std::vector<int> level_;
    std::vector<std::size_t> next_;  ///< per node the arc to look at next
    double largest_ = 0, least_ = 0; ///< capacity at first; what counts as none
};

} // namespace skelgen::core
