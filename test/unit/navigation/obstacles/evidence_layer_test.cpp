#include "navigation/obstacles/evidence_layer.h"

#include <gtest/gtest.h>

namespace stereo_nav::navigation {
namespace {

using State = EvidenceLayer::State;

class Layer : public testing::Test {
 protected:
  void look(double time_s, bool occupied) {
    layer_.beginLook(time_s);
    occupied ? layer_.seeOccupied({3, 4}) : layer_.seeFree({3, 4});
    layer_.endLook();
  }
  State state(int x = 3, int y = 4) const { return layer_.state(static_cast<std::size_t>(y * 10 + x)); }
  EvidenceLayer layer_{10, 5.0};
};

TEST_F(Layer, BelievesTheSecondLook) {
  EXPECT_EQ(state(), State::kUnknown);
  look(0.0, true);
  EXPECT_EQ(state(), State::kUnknown);
  look(0.1, true);
  EXPECT_EQ(state(), State::kOccupied);
}

TEST_F(Layer, LetsWhatHasGoneFadeWithinAFewLooks) {
  for (int i = 0; i < 100; ++i) look(0.1 * i, true);
  for (int i = 0; i < 5; ++i) look(10.0 + 0.1 * i, false);
  EXPECT_NE(state(), State::kOccupied);
  for (int i = 0; i < 5; ++i) look(10.5 + 0.1 * i, false);
  EXPECT_EQ(state(), State::kFree);
}

TEST_F(Layer, CountsOccupiedBeforeFreeInOneLook) {
  for (int i = 0; i < 3; ++i) {
    layer_.beginLook(0.1 * i);
    layer_.seeOccupied({3, 4});
    layer_.seeFree({3, 4});
    layer_.endLook();
  }
  EXPECT_EQ(state(), State::kOccupied);
}

TEST_F(Layer, ForgetsWhatNobodyLooksAt) {
  look(0.0, true);
  look(0.1, true);
  layer_.beginLook(5.0);
  layer_.endLook();
  EXPECT_EQ(state(), State::kOccupied);
  layer_.beginLook(5.3);
  layer_.endLook();
  EXPECT_EQ(state(), State::kUnknown);
}

TEST(NearLayer, RemembersLongerWhatStandsBesideTheRobot) {
  EvidenceLayer layer(10, 5.0, 2, 60.0);  // the robot is in the middle, at (5, 5)
  for (const double time_s : {0.0, 0.1}) {
    layer.beginLook(time_s);
    layer.seeOccupied({6, 5});
    layer.seeOccupied({8, 5});
    layer.endLook();
  }
  const auto stateAfter = [&](double time_s, int x) {
    layer.beginLook(time_s);
    layer.endLook();
    return layer.state(static_cast<std::size_t>(5 * 10 + x));
  };
  EXPECT_EQ(stateAfter(6.0, 8), State::kUnknown);
  EXPECT_EQ(stateAfter(59.0, 6), State::kOccupied);
  EXPECT_EQ(stateAfter(61.0, 6), State::kUnknown);
}

TEST_F(Layer, KeepsThePlacesOfCellsWhenItsWindowMoves) {
  look(0.0, true);
  look(0.1, true);
  layer_.shift({2, -1});
  EXPECT_EQ(state(1, 5), State::kOccupied);
  EXPECT_EQ(state(3, 4), State::kUnknown);
  layer_.shift({5, 0});
  layer_.shift({-5, 0});
  EXPECT_EQ(state(1, 5), State::kUnknown) << "it had left the window";
}

}  // namespace
}  // namespace stereo_nav::navigation
