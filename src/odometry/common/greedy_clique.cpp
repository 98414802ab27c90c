#include "odometry/common/greedy_clique.h"

#include <algorithm>

namespace stereo_nav::odometry {
namespace {

using Words = std::vector<std::uint64_t>;

int commonBits(const std::uint64_t* a, const Words& b) {
  int count = 0;
  for (std::size_t w = 0; w < b.size(); ++w) count += __builtin_popcountll(a[w] & b[w]);
  return count;
}

/// The member of `candidates` that is connected to most others of them; graph.size() if there is none.
std::size_t bestConnected(const ConsistencyGraph& graph, const Words& candidates) {
  std::size_t best = graph.size();
  int best_degree = -1;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if ((candidates[i / 64] >> (i % 64) & 1U) == 0) continue;
    const int degree = commonBits(graph.row(i), candidates);
    if (degree > best_degree) {
      best = i;
      best_degree = degree;
    }
  }
  return best;
}

}  // namespace

std::vector<std::size_t> greedyClique(const ConsistencyGraph& graph) {
  Words candidates(graph.words(), 0);
  for (std::size_t i = 0; i < graph.size(); ++i) candidates[i / 64] |= std::uint64_t{1} << (i % 64);

  std::vector<std::size_t> clique;
  for (std::size_t next = bestConnected(graph, candidates); next < graph.size();
       next = bestConnected(graph, candidates)) {
    clique.push_back(next);
    // A node is not connected to itself, so this also takes `next` out.
    for (std::size_t w = 0; w < candidates.size(); ++w) candidates[w] &= graph.row(next)[w];
  }
  std::sort(clique.begin(), clique.end());
  return clique;
}

}  // namespace stereo_nav::odometry
