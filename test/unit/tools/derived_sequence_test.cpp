#include "tools/import_sequence/derived_sequence.h"

#include <gtest/gtest.h>

#include <utility>

namespace stereo_nav::tools {
namespace {

/// Frames whose first pixel is their index and whose last is `mark`.
class NumberedFrames : public FrameReader {
 public:
  explicit NumberedFrames(int mark) : mark_(mark) {}
  std::size_t size() const override { return 3; }
  cv::Mat read(std::size_t index) override {
    cv::Mat image(2, 100, CV_8UC1, cv::Scalar(0));
    image.at<unsigned char>(0, 0) = static_cast<unsigned char>(index);
    image.at<unsigned char>(0, 99) = static_cast<unsigned char>(mark_);
    return image;
  }

 private:
  int mark_;
};

CameraTrack track(int mark, double cx, double projection_3) {
  CameraTrack track;
  for (const double time_s : {10.0, 10.1, 10.3}) track.stamps.emplace_back(time_s);
  track.frames = std::make_unique<NumberedFrames>(mark);
  track.info.width = 100;
  track.info.height = 2;
  track.info.D = {0.1, 0.2, 0.3, 0.4, 0.5};
  track.info.K = {50, 0, cx, 0, 50, 1, 0, 0, 1};
  track.info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  track.info.P = {50, 0, 49, projection_3, 0, 50, 1, 0, 0, 0, 1, 0};
  return track;
}

Sequence exampleSequence() {
  Sequence sequence;
  sequence.left = track(101, 40.0, 0.0);
  sequence.right = track(102, 45.0, -5.0);  // baseline 0.1 m
  sequence.T_body_camera = Eigen::Isometry3d::Identity();
  sequence.imu.readings = {{ros::Time(10.05), {1, 2, 3}, {4, 5, 6}}, {ros::Time(10.2), {7, 8, 9}, {1, 1, 1}}};
  sequence.ground_truth.resize(2);
  sequence.ground_truth[0] = {ros::Time(10.0), Eigen::Isometry3d::Identity()};
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Eigen::Vector3d(1.0, 2.0, 3.0));
  T.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
  sequence.ground_truth[1] = {ros::Time(10.3), T};
  return sequence;
}

TEST(Reverse, TimeRunsBackwardsAndRatesTurnTheOtherWay) {
  Sequence sequence = exampleSequence();
  reverse(sequence);
  EXPECT_EQ(sequence.left.stamps[0], ros::Time(10.0));
  EXPECT_EQ(sequence.left.stamps[1], ros::Time(10.2));
  EXPECT_EQ(sequence.left.stamps[2], ros::Time(10.3));
  EXPECT_EQ(sequence.left.frames->read(0).at<unsigned char>(0, 0), 2);
  EXPECT_EQ(sequence.imu.readings[0].stamp, ros::Time(10.1));
  EXPECT_EQ(sequence.imu.readings[0].angular_velocity, Eigen::Vector3d(-7, -8, -9));
  EXPECT_EQ(sequence.imu.readings[0].linear_acceleration, Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(sequence.ground_truth[0].stamp, ros::Time(10.0));
  EXPECT_EQ(sequence.ground_truth[0].T_world_camera.translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(Mirror, SwapsTheCamerasAndFlipsTheirImages) {
  Sequence sequence = exampleSequence();
  mirror(sequence);
  EXPECT_EQ(sequence.left.frames->read(1).at<unsigned char>(0, 0), 102);
  EXPECT_EQ(sequence.left.frames->read(1).at<unsigned char>(0, 99), 1);
  EXPECT_EQ(sequence.left.info.K[2], 54.0);
  EXPECT_EQ(sequence.left.info.P[2], 50.0);
  EXPECT_EQ(sequence.left.info.P[3], 0.0);
  EXPECT_EQ(sequence.right.info.P[3], -5.0);
  EXPECT_EQ(sequence.left.info.D[2], 0.3);
  EXPECT_EQ(sequence.left.info.D[3], -0.4);
}

TEST(Mirror, MotionIsThatOfTheOtherCameraReflected) {
  Sequence sequence = exampleSequence();
  const Eigen::Isometry3d T_world_right =
      sequence.ground_truth[1].T_world_camera * Eigen::Translation3d(0.1, 0.0, 0.0);
  mirror(sequence);
  const Eigen::Isometry3d& T = sequence.ground_truth[1].T_world_camera;
  EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-12);
  const Eigen::Vector3d seen(0.5, -0.2, 4.0);  // by the old right camera
  const Eigen::Vector3d mirrored(-0.5, -0.2, 4.0);
  const Eigen::Vector3d expected = (T_world_right * seen).cwiseProduct(Eigen::Vector3d(-1, 1, 1));
  EXPECT_TRUE((T * mirrored).isApprox(expected, 1e-12));
  EXPECT_EQ(sequence.imu.readings[0].angular_velocity, Eigen::Vector3d(1, -2, -3));
  EXPECT_EQ(sequence.imu.readings[0].linear_acceleration, Eigen::Vector3d(-4, 5, 6));
}

TEST(Mirror, TwiceIsTheOriginal) {
  Sequence sequence = exampleSequence();
  mirror(sequence);
  mirror(sequence);
  const Sequence original = exampleSequence();
  EXPECT_EQ(sequence.left.info, original.left.info);
  EXPECT_EQ(sequence.right.info, original.right.info);
  EXPECT_TRUE(
      sequence.ground_truth[1].T_world_camera.isApprox(original.ground_truth[1].T_world_camera, 1e-12));
  EXPECT_EQ(sequence.left.frames->read(2).at<unsigned char>(0, 99), 101);
}

}  // namespace
}  // namespace stereo_nav::tools
