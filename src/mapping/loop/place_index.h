#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"
#include "vision/descriptor.h"

namespace stereo_nav::mapping {

struct RetrievalParams {
  int exclude_recent = 15;
  int group_width = 2;
  int groups = 3;

  void describe(ParameterVisitor& visitor);
};

/// A place of the index that looks like the one asked for.
struct Retrieved {
  std::size_t place = 0;  ///< the best one of its group
  double score = 0.0;     ///< of that one: 0 to 1, share of the question's information that the two share
};

/// Places by the words that their descriptors hold, without a vocabulary: 16 bits of a descriptor are its
/// word (as in Usenko et al. 2020, Basalt), weighted by its inverse document frequency (Sivic and Zisserman
/// 2003). Each descriptor gives kTables words of different bits.
class PlaceIndex {
 public:
  explicit PlaceIndex(const RetrievalParams& params);

  /// Adds a place; places are numbered from 0 in the order in which they are added.
  void add(const std::vector<vision::Descriptor>& descriptors);
  std::size_t size() const { return words_of_.size(); }

  /// The places below `end` most like these descriptors, best first: one of each group of neighbours at most
  /// `group_width` apart, `groups` of them at most.
  std::vector<Retrieved> query(const std::vector<vision::Descriptor>& descriptors, std::size_t end) const;

  /// Bytes of the index, those reserved ahead included.
  std::size_t bytes() const;

 private:
  static constexpr std::size_t kTables = 2;
  static constexpr int kWordBits = 16;

  /// Each word once, in increasing order.
  std::vector<std::uint32_t> wordsOf(const std::vector<vision::Descriptor>& descriptors) const;
  std::vector<Retrieved> bestGroups(const std::vector<float>& scores, double information) const;

  RetrievalParams params_;
  std::array<std::array<int, kWordBits>, kTables> bits_;  ///< of the descriptor that make a word
  std::vector<std::vector<std::uint32_t>> places_with_;   ///< for each word, in increasing order
  std::vector<std::uint32_t> words_of_;                   ///< number of words of each place
};

}  // namespace stereo_nav::mapping
