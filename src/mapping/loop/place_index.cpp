#include "mapping/loop/place_index.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace stereo_nav::mapping {
namespace {

constexpr std::size_t kWordsInTable = std::size_t{1} << 16;

}  // namespace

void RetrievalParams::describe(ParameterVisitor& visitor) {
  visitor.integer("exclude_recent", exclude_recent, {1, 10000}, "",
                  "newest keyframes that are no candidates: they show what the odometry follows anyway");
  visitor.integer("group_width", group_width, {0, 100}, "",
                  "keyframes at most this many apart are one place, of which the best is tried");
  visitor.integer("groups", groups, {1, 100}, "", "places tried for each keyframe");
}

PlaceIndex::PlaceIndex(const RetrievalParams& params)
    : params_(params), places_with_(kTables * kWordsInTable) {
  std::vector<int> order(vision::kDescriptorBits);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(16);
  // std::shuffle() is not the same everywhere.
  for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[random() % (i + 1)]);
  auto next = order.begin();
  for (auto& table : bits_)
    for (int& bit : table) bit = *next++;
}

std::vector<std::uint32_t> PlaceIndex::wordsOf(const std::vector<vision::Descriptor>& descriptors) const {
  std::vector<std::uint32_t> words;
  words.reserve(kTables * descriptors.size());
  for (const vision::Descriptor& descriptor : descriptors) {
    for (std::size_t table = 0; table < kTables; ++table) {
      std::uint32_t word = static_cast<std::uint32_t>(table);
      for (const int bit : bits_[table]) word = 2 * word + (vision::bitOf(descriptor, bit) ? 1U : 0U);
      words.push_back(word);
    }
  }
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

void PlaceIndex::add(const std::vector<vision::Descriptor>& descriptors) {
  const std::vector<std::uint32_t> words = wordsOf(descriptors);
  for (const std::uint32_t word : words)
    places_with_[word].push_back(static_cast<std::uint32_t>(words_of_.size()));
  words_of_.push_back(static_cast<std::uint32_t>(words.size()));
}

std::vector<Retrieved> PlaceIndex::query(const std::vector<vision::Descriptor>& descriptors,
                                         std::size_t end) const {
  end = std::min(end, size());
  if (end == 0) return {};
  std::vector<float> scores(end, 0.0F);
  double information = 0.0;
  for (const std::uint32_t word : wordsOf(descriptors)) {
    const std::vector<std::uint32_t>& places = places_with_[word];
    const double rarity = std::log(static_cast<double>(size() + 1) / static_cast<double>(places.size() + 1));
    information += rarity * rarity;
    const auto added = static_cast<float>(rarity * rarity);
    for (const std::uint32_t place : places) {
      if (place >= end) break;
      scores[place] += added;
    }
  }
  const double words = static_cast<double>(std::max<std::size_t>(1, descriptors.size() * kTables));
  for (std::size_t place = 0; place < end; ++place) {
    // What has more words shares more of them by chance.
    const double more = std::max(1.0, static_cast<double>(words_of_[place])) / words;
    scores[place] /= static_cast<float>(std::sqrt(more));
  }
  return bestGroups(scores, std::max(information, 1e-9));
}

std::vector<Retrieved> PlaceIndex::bestGroups(const std::vector<float>& scores, double information) const {
  std::vector<Retrieved> groups;
  const auto width = static_cast<std::size_t>(params_.group_width);
  std::vector<bool> taken(scores.size(), false);
  while (groups.size() < static_cast<std::size_t>(params_.groups)) {
    std::size_t best = scores.size();
    for (std::size_t place = 0; place < scores.size(); ++place) {
      if (!taken[place] && scores[place] > 0.0F && (best == scores.size() || scores[place] > scores[best]))
        best = place;
    }
    if (best == scores.size()) break;
    groups.push_back({best, static_cast<double>(scores[best]) / information});
    const std::size_t first = best < width ? 0 : best - width;
    for (std::size_t place = first; place <= best + width && place < scores.size(); ++place)
      taken[place] = true;
  }
  return groups;
}

std::size_t PlaceIndex::bytes() const {
  std::size_t bytes = sizeof(*this) + places_with_.capacity() * sizeof(places_with_[0]) +
                      words_of_.capacity() * sizeof(words_of_[0]);
  for (const auto& places : places_with_) bytes += places.capacity() * sizeof(std::uint32_t);
  return bytes;
}

}  // namespace stereo_nav::mapping
