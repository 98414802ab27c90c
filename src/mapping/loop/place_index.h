#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"
#include "vision/descriptor.h"

namespace stereo_nav::mapping {

struct RetrievalParams {
  int exclude_recent = 10;
  double continuity = 0.35;
  int group_width = 2;
  int groups = 3;

  void describe(ParameterVisitor& visitor);
};

/// A place of the index that looks like the one asked for.
struct Retrieved {
  std::size_t place = 0;  ///< the best one of its group
  double score = 0.0;     ///< 0 to 1 for the share of information that the two share, and for continuity
};

/// Places by the words that their descriptors hold, without a vocabulary: 16 bits of a descriptor are its
/// word (as in Usenko et al. 2020, Basalt), weighted by its inverse document frequency (Sivic and Zisserman
/// 2003). The comparisons of ORB are ordered, the most telling ones first: the second sixteen are taken, by
/// measurement (docs/place_recognition.md). Views follow each other: a place is the more likely if the view
/// before was next to it, which carries over views of nothing, such as of a wall.
class PlaceIndex {
 public:
  explicit PlaceIndex(const RetrievalParams& params);

  /// Adds a place; places are numbered from 0 in the order in which they are added.
  void add(const std::vector<vision::Descriptor>& descriptors);
  std::size_t size() const { return words_of_.size(); }

  /// The places below `end` most like the view with these descriptors, which follows the one that was asked
  /// for before: best first, one of each group of neighbours at most `group_width` apart, `groups` of them at
  /// most.
  std::vector<Retrieved> query(const std::vector<vision::Descriptor>& descriptors, std::size_t end);

  /// Bytes of the index, those reserved ahead included.
  std::size_t bytes() const;

 private:
  /// How much of the view's information each place below `end` shares.
  std::vector<float> similarities(const std::vector<vision::Descriptor>& descriptors, std::size_t end) const;
  std::vector<Retrieved> bestGroups(const std::vector<float>& scores) const;

  RetrievalParams params_;
  std::vector<std::vector<std::uint32_t>> places_with_;  ///< for each word, in increasing order
  std::vector<std::uint32_t> words_of_;                  ///< number of words of each place
  std::vector<float> before_;                            ///< scores of the view before
};

}  // namespace stereo_nav::mapping
