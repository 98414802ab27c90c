#include "ros/keyframe_message.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::ros_io {
namespace {

vision::Keyframe someKeyframe() {
  vision::Keyframe keyframe;
  keyframe.id = 7;
  keyframe.time_s = 12.5;
  keyframe.follows = true;
  keyframe.T_previous_keyframe = expMotion((Vector6d() << 0.1, 0.2, 0.3, 0.1, -0.2, 0.05).finished());
  keyframe.covariance = 1e-4 * Matrix6d::Identity();
  keyframe.corners.push_back({3, {10.5, 20.25}, 4.0, 0.5});
  keyframe.corners.push_back({9, {100.0, 50.0}, 1.5, 0.25});
  for (std::uint64_t i = 1; i <= 4; ++i) keyframe.descriptors.push_back({i, 10 * i, ~i, 1ULL << 63});
  return keyframe;
}

TEST(KeyframeMessageTest, ComesBackAsItWent) {
  const vision::Keyframe sent = someKeyframe();
  const Keyframe message = toMessage(sent, "camera_left_optical");
  EXPECT_EQ(message.header.frame_id, "camera_left_optical");
  const vision::Keyframe keyframe = toKeyframe(message);
  EXPECT_EQ(keyframe.id, sent.id);
  EXPECT_EQ(keyframe.time_s, sent.time_s);
  EXPECT_TRUE(keyframe.follows);
  EXPECT_TRUE(keyframe.T_previous_keyframe.isApprox(sent.T_previous_keyframe, 1e-12));
  EXPECT_EQ(keyframe.covariance, sent.covariance);
  EXPECT_EQ(keyframe.descriptors, sent.descriptors);
  EXPECT_EQ(keyframe.scales(), 2u);
  ASSERT_EQ(keyframe.corners.size(), 2u);
  EXPECT_EQ(keyframe.corners[1].landmark_id, 9u);
  EXPECT_EQ(keyframe.corners[0].px, sent.corners[0].px);
  EXPECT_EQ(keyframe.corners[1].disparity_px, 1.5);
  EXPECT_EQ(keyframe.corners[1].disparity_sigma_px, 0.25);
  EXPECT_TRUE(toKeyframe(toMessage(vision::Keyframe(), "x")).corners.empty());
}

TEST(KeyframeMessageTest, RefusesWhatCannotBeAndSaysWhat) {
  const auto refusal = [](const std::function<void(Keyframe&)>& damage) {
    Keyframe message = toMessage(someKeyframe(), "x");
    damage(message);
    try {
      toKeyframe(message);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(refusal([](Keyframe& m) { m.x_px.pop_back(); }).find("1 values for 2 corners"),
            std::string::npos);
  EXPECT_NE(refusal([](Keyframe& m) { m.descriptors.pop_back(); }).find("127 bytes"), std::string::npos);
  EXPECT_NE(refusal([](Keyframe& m) { m.descriptors.clear(); }).find("0 bytes"), std::string::npos);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(refusal([nan](Keyframe& m) { m.disparity_px[1] = nan; }).find("corner 1"), std::string::npos);
  EXPECT_NE(refusal([](Keyframe& m) { m.disparity_sigma_px[0] = -1.0F; }).find("corner 0"),
            std::string::npos);
  EXPECT_NE(refusal([](Keyframe& m) { m.motion.pose.orientation.w = 7.0; }).find("motion"),
            std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::ros_io
