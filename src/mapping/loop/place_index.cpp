#include "mapping/loop/place_index.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::mapping {
namespace {

constexpr std::size_t kWords = std::size_t{1} << 16;

/// Each word once, in increasing order.
std::vector<std::uint16_t> wordsOf(const std::vector<vision::Descriptor>& descriptors) {
  constexpr int kFirstBit = 16;
  std::vector<std::uint16_t> words;
  words.reserve(descriptors.size());
  for (const vision::Descriptor& descriptor : descriptors)
    words.push_back(static_cast<std::uint16_t>(descriptor[0] >> kFirstBit));
  std::sort(words.begin(), words.end());
  words.erase(std::unique(words.begin(), words.end()), words.end());
  return words;
}

}  // namespace

void RetrievalParams::describe(ParameterVisitor& visitor) {
  visitor.integer("exclude_recent", exclude_recent, {1, 10000}, "",
                  "newest keyframes that are no candidates: they show what the odometry follows anyway");
  visitor.real(
      "continuity", continuity, {0.0, 1.0}, "",
      "share of the score that a place next to it had for the keyframe before, which it has besides its own");
  visitor.integer("group_width", group_width, {0, 100}, "",
                  "keyframes at most this many apart are one place, of which the best is tried");
  visitor.integer("groups", groups, {1, 100}, "", "places tried for each keyframe");
}

PlaceIndex::PlaceIndex(const RetrievalParams& params) : params_(params), places_with_(kWords) {}

void PlaceIndex::add(const std::vector<vision::Descriptor>& descriptors) {
  const std::vector<std::uint16_t> words = wordsOf(descriptors);
  for (const std::uint16_t word : words)
    places_with_[word].push_back(static_cast<std::uint32_t>(words_of_.size()));
  words_of_.push_back(static_cast<std::uint32_t>(words.size()));
}

std::vector<float> PlaceIndex::similarities(const std::vector<vision::Descriptor>& descriptors,
                                            std::size_t end) const {
  std::vector<float> similarities(end, 0.0F);
  const std::vector<std::uint16_t> words = wordsOf(descriptors);
  double information = 0.0;
  for (const std::uint16_t word : words) {
    const std::vector<std::uint32_t>& places = places_with_[word];
    const double rarity = std::log(static_cast<double>(size() + 1) / static_cast<double>(places.size() + 1));
    information += rarity * rarity;
    const auto added = static_cast<float>(rarity * rarity);
    for (const std::uint32_t place : places) {
      if (place >= end) break;
      similarities[place] += added;
    }
  }
  if (information == 0.0) return similarities;
  for (std::size_t place = 0; place < end; ++place) {
    // What has more words shares more of them by chance.
    const double more =
        static_cast<double>(std::max(1U, words_of_[place])) / static_cast<double>(words.size());
    similarities[place] /= static_cast<float>(information * std::sqrt(more));
  }
  return similarities;
}

std::vector<Retrieved> PlaceIndex::query(const std::vector<vision::Descriptor>& descriptors,
                                         std::size_t end) {
  std::vector<float> scores = similarities(descriptors, std::min(end, size()));
  const auto share = static_cast<float>(params_.continuity);
  for (std::size_t place = 0; place < scores.size(); ++place) {
    float beside = 0.0F;
    for (std::size_t next = place == 0 ? 0 : place - 1; next <= place + 1 && next < before_.size(); ++next)
      beside = std::max(beside, before_[next]);
    scores[place] = (scores[place] + share * beside) / (1.0F + share);
  }
  before_ = scores;
  return bestGroups(scores);
}

std::vector<Retrieved> PlaceIndex::bestGroups(const std::vector<float>& scores) const {
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
    groups.push_back({best, static_cast<double>(scores[best])});
    const std::size_t first = best < width ? 0 : best - width;
    for (std::size_t place = first; place <= best + width && place < scores.size(); ++place)
      taken[place] = true;
  }
  return groups;
}

std::size_t PlaceIndex::bytes() const {
  std::size_t bytes = sizeof(*this) + places_with_.capacity() * sizeof(places_with_[0]) +
                      words_of_.capacity() * sizeof(words_of_[0]) + before_.capacity() * sizeof(before_[0]);
  for (const auto& places : places_with_) bytes += places.capacity() * sizeof(std::uint32_t);
  return bytes;
}

}  // namespace stereo_nav::mapping
