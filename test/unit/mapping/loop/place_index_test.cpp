#include "mapping/loop/place_index.h"

#include <gtest/gtest.h>

#include "mapping/loop/descriptor_matching.h"
#include "unit/mapping/loop/landmark_world.h"

namespace stereo_nav::mapping {
namespace {

using Descriptors = std::vector<vision::Descriptor>;

Descriptors randomPlace(std::size_t corners, std::mt19937_64& random) {
  Descriptors descriptors(corners);
  for (auto& descriptor : descriptors) descriptor = randomDescriptor(random);
  return descriptors;
}

Descriptors again(const Descriptors& place, int bits, std::mt19937_64& random) {
  Descriptors descriptors = place;
  for (auto& descriptor : descriptors) descriptor = seenAgain(descriptor, bits, random);
  return descriptors;
}

PlaceIndex indexOf(const std::vector<Descriptors>& places, const RetrievalParams& params = {}) {
  PlaceIndex index(params);
  for (const Descriptors& place : places) index.add(place);
  return index;
}

TEST(PlaceIndexTest, FindsEachPlaceAmongHundredsThoughManyBitsDiffer) {
  std::mt19937_64 random(1);
  std::vector<Descriptors> places;
  for (int i = 0; i < 300; ++i) places.push_back(randomPlace(200, random));
  PlaceIndex index(RetrievalParams{});
  for (std::size_t i = 0; i < places.size(); i += 10) {
    index = indexOf(places);
    const auto found = index.query(again(places[i], 25, random), index.size());
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.front().place, i);
    EXPECT_LE(found.front().score, 1.0);
  }
  RetrievalParams alone;
  alone.continuity = 0.0;
  EXPECT_NEAR(indexOf(places, alone).query(places[7], places.size()).front().score, 1.0, 0.01);
}

TEST(PlaceIndexTest, AViewOfNothingIsNextToTheOneBefore) {
  std::mt19937_64 random(5);
  std::vector<Descriptors> places;
  for (int i = 0; i < 50; ++i) places.push_back(randomPlace(200, random));
  PlaceIndex index = indexOf(places);
  index.query(again(places[20], 20, random), index.size());
  const auto found = index.query({}, index.size());
  ASSERT_FALSE(found.empty());
  EXPECT_NEAR(static_cast<double>(found.front().place), 20.0, 1.0);
}

TEST(PlaceIndexTest, GroupsNeighboursAndLeavesOutWhatIsTooNew) {
  std::mt19937_64 random(2);
  RetrievalParams params;
  params.groups = 2;
  params.group_width = 2;
  PlaceIndex index(params);
  const Descriptors place = randomPlace(100, random);
  for (int i = 0; i < 40; ++i)  // seen at 10, 11, 12 and at 30
    index.add((i >= 10 && i <= 12) || i == 30 ? again(place, 10, random) : randomPlace(100, random));
  const auto found = index.query(place, index.size());
  ASSERT_EQ(found.size(), 2u);
  const auto first = std::min(found[0].place, found[1].place),
             second = std::max(found[0].place, found[1].place);
  EXPECT_TRUE(first >= 10 && first <= 12);
  EXPECT_EQ(second, 30u);
  for (const Retrieved& retrieved : index.query(place, 12)) EXPECT_LT(retrieved.place, 12u);
  EXPECT_TRUE(index.query(place, 0).empty());
}

TEST(PlaceIndexTest, NeedsLessThanFiveKilobytesAKeyframe) {
  std::mt19937_64 random(3);
  PlaceIndex index(RetrievalParams{});
  constexpr std::size_t kKeyframes = 2600;
  for (std::size_t i = 0; i < kKeyframes; ++i) index.add(randomPlace(400, random));
  EXPECT_LT(index.bytes() / kKeyframes, 5000u);
}

TEST(PlaceIndexTest, AViewWithoutCornersIsLikeNone) {
  PlaceIndex index(RetrievalParams{});
  index.add({});
  EXPECT_TRUE(index.query({}, index.size()).empty());
}

TEST(DescriptorMatchingTest, FindsAPermutationOverScalesAndOnlyMutualMatches) {
  std::mt19937_64 random(4);
  constexpr std::size_t kCorners = 60;
  const Descriptors place = randomPlace(2 * kCorners, random);  // two scales
  Descriptors query = randomPlace(2 * kCorners, random);
  // Corner 59 - i of the query is corner i of the place, its first scale like the place's second one.
  for (std::size_t i = 0; i < kCorners; ++i)
    query[kCorners - 1 - i] = seenAgain(place[kCorners + i], 30, random);
  const auto matches = mutualMatches({query, kCorners}, {place, kCorners}, 64);
  ASSERT_EQ(matches.size(), kCorners);
  for (const CornerMatch& match : matches) {
    EXPECT_EQ(match.place, kCorners - 1 - match.query);
    EXPECT_LE(match.distance, 30);
  }
  EXPECT_TRUE(mutualMatches({randomPlace(30, random), 30}, {place, kCorners}, 64).empty());
}

}  // namespace
}  // namespace stereo_nav::mapping
