#include "odometry/common/exact_clique.h"

#include <algorithm>
#include <cstdint>

#include "odometry/common/greedy_clique.h"

namespace stereo_nav::odometry {
namespace {

using Words = std::vector<std::uint64_t>;

bool empty(const Words& set) {
  return std::all_of(set.begin(), set.end(), [](std::uint64_t word) { return word == 0; });
}

void erase(Words& set, std::size_t i) {
  set[i / 64] &= ~(std::uint64_t{1} << (i % 64));
}

class Search {
 public:
  Search(const ConsistencyGraph& graph, std::size_t budget, std::vector<std::size_t> start)
      : graph_(graph), budget_(budget), best_(std::move(start)) {}

  void run() {
    Words candidates(graph_.words(), 0);
    for (std::size_t i = 0; i < graph_.size(); ++i) candidates[i / 64] |= std::uint64_t{1} << (i % 64);
    expand(candidates);
  }

  bool exhausted() const { return expanded_ >= budget_; }
  std::size_t expanded() const { return expanded_; }
  const std::vector<std::size_t>& best() const { return best_; }

 private:
  struct Coloured {
    std::size_t node;
    std::size_t colour;  ///< from 1: a clique among the nodes up to here has at most so many members
  };

  /// Nodes by colour; members of one colour are not connected, so a clique has at most one of each.
  std::vector<Coloured> colour(const Words& candidates) const {
    std::vector<Coloured> order;
    Words uncoloured = candidates;
    for (std::size_t number = 1; !empty(uncoloured); ++number) {
      Words free = uncoloured;
      for (std::size_t w = 0; w < free.size(); ++w) {
        while (free[w] != 0) {
          const std::size_t node = 64 * w + static_cast<std::size_t>(__builtin_ctzll(free[w]));
          order.push_back({node, number});
          erase(uncoloured, node);
          erase(free, node);
          const std::uint64_t* row = graph_.row(node);
          for (std::size_t v = w; v < free.size(); ++v) free[v] &= ~row[v];
        }
      }
    }
    return order;
  }

  void expand(Words candidates) {
    const std::vector<Coloured> order = colour(candidates);
    for (auto next = order.rbegin(); next != order.rend(); ++next) {
      if (current_.size() + next->colour <= best_.size() || exhausted()) return;
      ++expanded_;
      current_.push_back(next->node);
      Words fewer = candidates;
      for (std::size_t w = 0; w < fewer.size(); ++w) fewer[w] &= graph_.row(next->node)[w];
      if (!empty(fewer)) {
        expand(std::move(fewer));
      } else if (current_.size() > best_.size()) {
        best_ = current_;
      }
      current_.pop_back();
      erase(candidates, next->node);
    }
  }

  const ConsistencyGraph& graph_;
  std::size_t budget_;
  std::size_t expanded_ = 0;
  std::vector<std::size_t> current_;
  std::vector<std::size_t> best_;
};

}  // namespace

CliqueResult largestClique(const ConsistencyGraph& graph, std::size_t budget) {
  Search search(graph, budget, greedyClique(graph));
  search.run();
  CliqueResult result{search.best(), !search.exhausted(), search.expanded()};
  std::sort(result.members.begin(), result.members.end());
  return result;
}

}  // namespace stereo_nav::odometry
