#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "odometry/stereo/stereo_odometry.h"
#include "support/textured_room.h"

namespace stereo_nav::odometry {

inline constexpr double kPeriod_s = 0.1;
inline constexpr int kFrames = 12;

/// Drives through the textured room; both images are rendered at their own times.
class StereoOdometryTest : public ::testing::Test {
 protected:
  StereoFrame frameAt(double time_s, double offset_s = 0.0) const {
    StereoFrame frame;
    frame.left_time_s = time_s;
    frame.right_time_s = time_s + offset_s;
    const auto pair =
        room.renderPair(test::roomDrive(time_s), test::roomDrive(time_s + offset_s), calibration);
    frame.left = pair.left;
    frame.right = pair.right;
    return frame;
  }

  std::vector<StereoFrame> course(double offset_s = 0.0) const {
    std::vector<StereoFrame> frames;
    for (int i = 0; i < kFrames; ++i) frames.push_back(frameAt(kPeriod_s * i, offset_s));
    return frames;
  }

  /// The frame as rolling shutters take it, in bands of rows; at `time` the rig is where roomDrive() is at
  /// `seconds(time)`.
  template <typename Seconds>
  StereoFrame rollingFrameAt(double time_s, double readout_s, const Seconds& seconds) const {
    constexpr int kBands = 12;
    StereoFrame frame;
    for (int i = 0; i < kBands; ++i) {
      // A camera that sees these rows only.
      vision::StereoCalibration band = calibration;
      const int first = i * calibration.height / kBands;
      band.height = (i + 1) * calibration.height / kBands - first;
      band.cy -= first;
      const Eigen::Isometry3d pose =
          test::roomDrive(seconds(time_s + readout_s * ((i + 0.5) / kBands - 0.5)));
      const auto pair = room.renderPair(pose, pose, band);
      frame.left.push_back(pair.left);
      frame.right.push_back(pair.right);
    }
    frame.left_time_s = frame.right_time_s = time_s;
    frame.readout_s = readout_s;
    return frame;
  }

  static FrameResult drive(Odometry& odometry, const std::vector<StereoFrame>& frames) {
    FrameResult result;
    for (const StereoFrame& frame : frames) result = odometry.process(frame);
    return result;
  }

  /// Distance from the truth in m at the end of the course, or of a course that ends at `end_s`.
  static double endError(const FrameResult& result, double end_s = kPeriod_s * (kFrames - 1)) {
    const Eigen::Isometry3d truth = test::roomDrive(0.0).inverse() * test::roomDrive(end_s);
    return (result.T_start_camera.translation() - truth.translation()).norm();
  }

  StereoOdometry odometry() const { return {StereoParams(), calibration, Eigen::Matrix3d::Identity()}; }

  test::TexturedRoom room;
  vision::StereoCalibration calibration = test::roomCalibration();
};

}  // namespace stereo_nav::odometry
