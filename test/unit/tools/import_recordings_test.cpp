// The check figures of the real recordings.
#include <sensor_msgs/Image.h>

#include <cstdlib>

#include "import_test_support.h"
#include "stereo_nav/StereoSync.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"
#include "tools/import_sequence/sequence_bag.h"

namespace stereo_nav::tools {
namespace {

class ImportRecordings : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("STEREO_NAV_DATA");
    if (!folder) GTEST_SKIP() << "STEREO_NAV_DATA does not name the folder of the recordings";
    data_ = folder;
  }
  std::string data_;
};

TEST_F(ImportRecordings, eurocMh01) {
  const Sequence sequence = readEuroc(data_ + "/euroc_mh01_a");
  EXPECT_EQ(sequence.left.stamps.size(), 200u);
  EXPECT_EQ(sequence.right.stamps.size(), 200u);
  EXPECT_EQ(sequence.imu.readings.size(), 2490u);
  EXPECT_EQ(sequence.ground_truth.size(), 2190u);
  EXPECT_NEAR((sequence.left.stamps.back() - sequence.left.stamps.front()).toSec(), 9.95, 1e-3);
  const auto calibration = ros_io::toCalibration(sequence.left.info, sequence.right.info);
  EXPECT_NEAR(calibration.fx, 436.2, 0.1);
  EXPECT_NEAR(calibration.baseline_m, 0.1101, 5e-5);
  EXPECT_EQ(calibration.cx, calibration.right_cx);
}

TEST_F(ImportRecordings, eurocMh01Unsynchronised) {
  const TemporaryFolder folder;
  Sequence sequence = readEuroc(data_ + "/euroc_mh01_a");
  BagOptions options;
  options.every = 2;
  options.right_lag_frames = 1;
  const auto summary = writeBag(sequence, options, folder / "lag.bag", [](std::size_t, std::size_t) {});
  EXPECT_EQ(summary.pairs, 100u);
  EXPECT_EQ(summary.left_without_partner, 0u);
  const auto sync = readTopic<StereoSync>(folder / "lag.bag", "camera/sync");
  ASSERT_EQ(sync.size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(sync[i].left_stamp, sequence.left.stamps[2 * i]);
    EXPECT_EQ(sync[i].right_stamp, sequence.right.stamps[2 * i + 1]);
    EXPECT_NEAR(sync[i].skew_s, 0.05, 1e-6);
  }
}

TEST_F(ImportRecordings, kitti06) {
  const Sequence sequence = readKitti(data_ + "/kitti06_a");
  EXPECT_EQ(sequence.left.stamps.size(), 51u);
  EXPECT_EQ(sequence.ground_truth.size(), 51u);
  const auto calibration = ros_io::toCalibration(sequence.left.info, sequence.right.info);
  EXPECT_DOUBLE_EQ(calibration.fx, 707.0912);
  EXPECT_NEAR(calibration.baseline_m, 0.5372, 5e-5);
  EXPECT_EQ(calibration.width, 1226);
}

TEST_F(ImportRecordings, uniboRobot) {
  const Sequence sequence = readImages(data_ + "/unibo_robot");
  EXPECT_EQ(sequence.left.frames->size(), 389u);
  EXPECT_EQ(sequence.right.frames->size(), 389u);
  EXPECT_NEAR((sequence.left.stamps[15] - sequence.left.stamps[0]).toSec(), 1.0, 1e-9);
  const auto calibration = ros_io::toCalibration(sequence.left.info, sequence.right.info);
  EXPECT_DOUBLE_EQ(calibration.fx, 567.2);
  EXPECT_NEAR(calibration.baseline_m, 0.092226, 1e-12);
}

TEST_F(ImportRecordings, zedStepsHasNoCalibration) {
  EXPECT_NE(messageOf<InputError>([this] {
              readImages(data_ + "/zed_steps");
            }).find("zed_steps/calib.txt: does not exist"),
            std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::tools
