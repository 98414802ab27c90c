#include "nodes/visual_odometry/odometry_session.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <functional>

#include "core/base_pose.h"
#include "core/optical_axes.h"
#include "ros/setup_checks.h"
#include "support/fixture_bag.h"
#include "support/room_frame.h"
#include "support/textured_room.h"

namespace stereo_nav::nodes {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Eigen::Isometry3d baseToCamera() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = opticalToBody();
  T.translation() << 0.10, 0.0, 0.283;
  return T;
}

/// The drive through the textured room as a node would receive it, with exact disparity.
class OdometrySessionTest : public testing::Test {
 protected:
  OdometrySessionTest() {
    setup_.left_info =
        boost::make_shared<sensor_msgs::CameraInfo>(test::cameraInfo(test::roomCalibration(), false));
    setup_.right_info =
        boost::make_shared<sensor_msgs::CameraInfo>(test::cameraInfo(test::roomCalibration(), true));
  }

  /// The frame of the drive at `drive_s`, stamped `kStart_s` later.
  static ros_io::Inbox::Work frameAt(double drive_s) {
    const test::RoomFrame frame = test::roomFrame(drive_s, ros::Time(kStart_s + drive_s));
    ros_io::Inbox::Work work;
    work.frame.left = frame.left;
    work.frame.right = frame.right;
    work.frame.disparity = frame.disparity;
    work.frame.left_stamp = work.frame.right_stamp = frame.left->header.stamp;
    return work;
  }

  SessionOutput process(const ros_io::Inbox::Work& work, bool live = false) {
    return session_.process(work, setup_, live);
  }

  static Eigen::Isometry3d expectedPose(double drive_s) {
    return basePose(baseToCamera(), test::roomDrive(drive_s));
  }

  static constexpr double kStart_s = 1000.0;
  static constexpr double kTolerance_m = 0.02;

  std::map<std::string, Eigen::Isometry3d> transforms_{{ros_io::frames::kLeftOptical, baseToCamera()},
                                                       {ros_io::frames::kImu, Eigen::Isometry3d::Identity()}};
  std::map<std::string, ros::Time> asked_at_;
  ros::Time tf_reaches_{2.0 * kStart_s};
  SensorSetup setup_;
  VisualOdometryParams params_;
  OdometrySession session_{params_, odometry::OdometryConfig(),
                           [this](const std::string& target, const std::string& source, const ros::Time& time,
                                  std::string& error) -> std::optional<Eigen::Isometry3d> {
                             EXPECT_EQ(target, ros_io::frames::kBase);
                             asked_at_[source] = time;
                             const auto found = transforms_.find(source);
                             if (time > tf_reaches_) {
                               error = "would require extrapolation into the future";
                               return std::nullopt;
                             }
                             if (found != transforms_.end()) return found->second;
                             error = "not connected";
                             return std::nullopt;
                           }};
};

TEST_F(OdometrySessionTest, FollowsTheDriveInTheBaseFrame) {
  SessionOutput output;
  for (int i = 0; i < 6; ++i) {
    ros_io::Inbox::Work work = frameAt(0.1 * i);
    work.frame.rolling_shutter_s = 1e-4;  // an almost global one
    output = process(work);
    ASSERT_TRUE(output.processed);
  }
  EXPECT_EQ(output.images.readout_s, 1e-4);
  EXPECT_EQ(output.result.state, odometry::State::kTracking);
  EXPECT_LT((output.base.T_odom_base.translation() - expectedPose(0.5).translation()).norm(), kTolerance_m);
  EXPECT_NEAR(output.base.twist[0], 0.4, 0.1);
  EXPECT_TRUE(output.errors.empty());
  EXPECT_TRUE(output.warnings.empty());
  EXPECT_EQ(session_.framesProcessed(), 6u);
}

TEST_F(OdometrySessionTest, RefusesARollingShutterThatCannotBe) {
  for (const double rolling_shutter_s : {30.0, -0.01, std::nan("")}) {
    ros_io::Inbox::Work work = frameAt(0.0);
    work.frame.rolling_shutter_s = rolling_shutter_s;
    const SessionOutput output = process(work);
    EXPECT_FALSE(output.processed);
    EXPECT_EQ(output.errors.count("rolling_shutter"), 1u) << rolling_shutter_s;
  }
}

TEST_F(OdometrySessionTest, RefusesACameraThatMovesAgainstTheBaseUntilItIsBack) {
  ASSERT_TRUE(process(frameAt(0.0)).processed);
  Eigen::Isometry3d& T_base_camera = transforms_[ros_io::frames::kLeftOptical];
  T_base_camera.rotate(Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitX()));
  SessionOutput output = process(frameAt(0.1));
  EXPECT_FALSE(output.processed);
  EXPECT_TRUE(contains(output.errors["camera_moves"], "moved against base_link by 0.573 deg"))
      << output.errors["camera_moves"];
  EXPECT_EQ(asked_at_[ros_io::frames::kLeftOptical], ros::Time(kStart_s + 0.1)) << "the image's stamp";
  T_base_camera = baseToCamera();
  output = process(frameAt(0.2));
  EXPECT_TRUE(output.processed);
  EXPECT_LT((output.base.T_odom_base.translation() - expectedPose(0.2).translation()).norm(), kTolerance_m);
}

TEST_F(OdometrySessionTest, AFrameWhoseCameraTfDoesNotKnowYetIsNoMotionOfTheBase) {
  tf_reaches_ = ros::Time(kStart_s - 1.0);
  ASSERT_TRUE(process(frameAt(0.0)).processed) << "tf has just begun: the mounting is the newest";
  SessionOutput output = process(frameAt(0.1));
  EXPECT_FALSE(output.processed);
  EXPECT_TRUE(contains(output.errors["camera_moves"], "tf does not tell where the camera"))
      << output.errors["camera_moves"];
  tf_reaches_ = ros::Time(kStart_s + 1.0);
  output = process(frameAt(0.2));
  EXPECT_TRUE(output.processed);
  EXPECT_LT((output.base.T_odom_base.translation() - expectedPose(0.2).translation()).norm(), kTolerance_m);
}

/// The base drives on while the camera looks elsewhere: 0.2 m above its place and turned about the view.
TEST_F(OdometrySessionTest, AfterAResetTheCameraIsTakenWhereItIs) {
  ASSERT_TRUE(process(frameAt(0.0)).processed);
  Eigen::Isometry3d& T_base_camera = transforms_[ros_io::frames::kLeftOptical];
  T_base_camera.translation().z() += 0.2;
  T_base_camera.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  EXPECT_FALSE(process(frameAt(0.1)).processed);
  session_.reset();
  ASSERT_TRUE(process(frameAt(0.2)).processed);
  const SessionOutput output = process(frameAt(0.4));
  ASSERT_TRUE(output.processed);
  const Eigen::Isometry3d expected =
      basePose(T_base_camera, test::roomDrive(0.2)).inverse() * basePose(T_base_camera, test::roomDrive(0.4));
  EXPECT_LT((output.base.T_odom_base.translation() - expected.translation()).norm(), kTolerance_m);
}

TEST_F(OdometrySessionTest, WaitsForTheMountingAndNamesTheCommand) {
  transforms_.erase(ros_io::frames::kLeftOptical);
  SessionOutput output = process(frameAt(0.0));
  EXPECT_FALSE(output.processed);
  const std::string text = output.errors["camera_transform"];
  EXPECT_TRUE(contains(text, "base_link -> camera_left_optical")) << text;
  EXPECT_TRUE(
      contains(text, "static_transform_publisher 0 0 0.283 -1.5708 0 -1.5708 base_link camera_left_optical"))
      << text;
  transforms_[ros_io::frames::kLeftOptical] = baseToCamera();
  output = process(frameAt(0.1));
  EXPECT_TRUE(output.processed);
  EXPECT_TRUE(output.base.T_odom_base.isApprox(Eigen::Isometry3d::Identity()));
}

TEST_F(OdometrySessionTest, WaitsForTheImusMountingBeforeItStartsButNotLater) {
  transforms_.erase(ros_io::frames::kImu);
  setup_.imu_frame = ros_io::frames::kImu;
  SessionOutput output = process(frameAt(0.0));
  EXPECT_FALSE(output.processed);
  EXPECT_TRUE(contains(output.errors["imu_transform"], "base_link -> imu_link"));

  setup_.imu_frame.clear();
  ASSERT_TRUE(process(frameAt(0.0)).processed);
  setup_.imu_frame = ros_io::frames::kImu;
  output = process(frameAt(0.1));
  EXPECT_TRUE(output.processed);
  EXPECT_TRUE(odometry::isMeasured(output.result.state));
  EXPECT_EQ(output.warnings.count("imu_transform"), 1u);

  // When the mounting is known, the odometry starts anew and keeps the pose.
  transforms_[ros_io::frames::kImu] = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d before = output.base.T_odom_base.translation();
  output = process(frameAt(0.2));
  EXPECT_TRUE(output.warnings.empty());
  EXPECT_EQ(output.announcements.size(), 1u);
  EXPECT_TRUE(output.base.T_odom_base.translation().isApprox(before));
}

TEST_F(OdometrySessionTest, NamesAnImuThatContradictsTheImagesAndGoesOnWithoutIt) {
  setup_.imu_frame = ros_io::frames::kImu;
  constexpr double kTurnRate_rad_s = 10.0 * M_PI / 180.0;
  int announced = 0;
  SessionOutput output;
  for (int i = 0; i <= 30; ++i) {
    auto work = frameAt(0.1 * i);
    for (int k = -9; k <= 1; ++k) {
      ImuSample sample;
      sample.time_s = kStart_s + 0.1 * i + 0.01 * k;
      sample.angular_velocity =
          Eigen::Vector3d(0.0, 0.0, kTurnRate_rad_s);  // turns to the right: it should be negative
      work.imu.push_back(sample);
    }
    output = process(work);
    announced += static_cast<int>(output.announcements.size());
  }
  EXPECT_TRUE(contains(output.warnings["imu"], "the IMU contradicts the images and is set aside"));
  EXPECT_TRUE(contains(output.warnings["imu"], "reversed")) << output.warnings["imu"];
  EXPECT_EQ(announced, 1);
  EXPECT_EQ(output.result.state, odometry::State::kTracking);
  EXPECT_LT((output.base.T_odom_base.translation() - expectedPose(3.0).translation()).norm(),
            2 * kTolerance_m);
}

TEST_F(OdometrySessionTest, NamesAnImuOfAnotherClock) {
  setup_.imu_frame = ros_io::frames::kImu;
  auto work = frameAt(0.0);
  ImuSample sample;
  sample.time_s = 0.01;  // its driver counts from power-on
  sample.angular_velocity = Eigen::Vector3d::Zero();
  work.imu.push_back(sample);
  const SessionOutput output = process(work);
  EXPECT_TRUE(output.processed);
  EXPECT_TRUE(contains(output.warnings.at("imu_stamps"),
                       "the stamps of the IMU are 1000.0 s before those of the images"));
}

TEST_F(OdometrySessionTest, RefusesCamerasThatDoNotFitTogether) {
  const auto refusal = [this](const std::function<void(sensor_msgs::CameraInfo&)>& spoil) {
    SensorSetup setup = setup_;
    auto info = boost::make_shared<sensor_msgs::CameraInfo>(*setup.right_info);
    spoil(*info);
    setup.right_info = info;
    SessionOutput output = session_.process(frameAt(0.0), setup, false);
    EXPECT_FALSE(output.processed);
    return output.errors["cameras"];
  };
  EXPECT_TRUE(contains(refusal([](auto& info) { info.header.frame_id = "camera_right_optical"; }),
                       "frame ids differ"));
  EXPECT_TRUE(contains(refusal([](auto& info) { info.P[0] += 1.0; }), "fx"));
  EXPECT_TRUE(contains(refusal([](auto& info) { info.P[3] = 0.0; }), "baseline"));
  EXPECT_TRUE(contains(refusal([](auto& info) { info.width = 640; }), "640"));
  setup_.right_info.reset();
  EXPECT_EQ(process(frameAt(0.0)).errors.count("camera_info"), 1u);
}

TEST_F(OdometrySessionTest, RefusesImagesOfAnotherFrameOrSizeThanTheirInfo) {
  ros_io::Inbox::Work work = frameAt(0.0);
  auto image = boost::make_shared<sensor_msgs::Image>(*work.frame.right);
  image->header.frame_id = "camera_right_optical";
  work.frame.right = image;
  EXPECT_TRUE(contains(process(work).errors["cameras"], "'camera_right_optical'"));

  image = boost::make_shared<sensor_msgs::Image>(*work.frame.left);
  image->width /= 2;
  work = frameAt(0.0);
  work.frame.left = image;
  EXPECT_TRUE(contains(process(work).errors["cameras"], "160x240"));
}

TEST_F(OdometrySessionTest, ALoopingBagStartsAgainAtTheOriginACorrectedClockDoesNot) {
  for (const bool live : {false, true}) {
    session_.reset();
    for (int i = 0; i < 4; ++i) process(frameAt(1.0 + 0.1 * i));
    ros_io::Inbox::Work again = frameAt(0.0);
    again.frame.after_jump = true;
    const SessionOutput jumped = process(again, live);
    ASSERT_TRUE(jumped.processed);
    ASSERT_EQ(jumped.announcements.size(), 1u);
    EXPECT_TRUE(contains(jumped.announcements[0], "jumped back"));
    EXPECT_EQ(jumped.base.T_odom_base.isApprox(Eigen::Isometry3d::Identity()), !live);
    EXPECT_TRUE(odometry::isMeasured(process(frameAt(0.1)).result.state));
  }
}

TEST_F(OdometrySessionTest, ResetAndSetPose) {
  EXPECT_FALSE(session_.setPose(Eigen::Isometry3d::Identity(), Matrix6d::Zero())) << "no odometry yet";
  for (int i = 0; i < 3; ++i) process(frameAt(0.1 * i));
  session_.reset();
  EXPECT_TRUE(process(frameAt(0.3)).base.T_odom_base.isApprox(Eigen::Isometry3d::Identity()));

  Eigen::Isometry3d set = Eigen::Isometry3d::Identity();
  set.translation() << 10.0, 20.0, 0.0;
  ASSERT_TRUE(session_.setPose(set, Matrix6d::Zero()));
  const SessionOutput output = process(frameAt(0.4));
  EXPECT_TRUE(odometry::isMeasured(output.result.state)) << "the odometry goes on";
  const Eigen::Isometry3d motion = expectedPose(0.3).inverse() * expectedPose(0.4);
  EXPECT_LT((output.base.T_odom_base.translation() - (set * motion).translation()).norm(), kTolerance_m);
}

TEST_F(OdometrySessionTest, ChangedCameraInfosStartAnewAtTheSamePose) {
  for (int i = 0; i < 3; ++i) process(frameAt(0.1 * i));
  auto info = boost::make_shared<sensor_msgs::CameraInfo>(*setup_.right_info);
  info->P[3] *= 1.01;
  setup_.right_info = info;
  const SessionOutput output = process(frameAt(0.2));
  EXPECT_EQ(output.announcements.size(), 1u);
  EXPECT_LT((output.base.T_odom_base.translation() - expectedPose(0.2).translation()).norm(), kTolerance_m);
}

TEST_F(OdometrySessionTest, SaysWhenLeftAndRightAreSwapped) {
  std::string text;
  for (int i = 0; i < 5 && text.empty(); ++i) {
    ros_io::Inbox::Work work = frameAt(1.0 * i);
    std::swap(work.frame.left, work.frame.right);
    text = process(work).warnings["camera_order"];
  }
  EXPECT_TRUE(contains(text, "swapped")) << text;
}

TEST_F(OdometrySessionTest, AnImageThatCannotBeReadIsAProblemNotACrash) {
  ros_io::Inbox::Work work = frameAt(0.0);
  auto image = boost::make_shared<sensor_msgs::Image>(*work.frame.left);
  image->encoding = "64FC1";
  work.frame.left = image;
  const SessionOutput output = process(work);
  EXPECT_FALSE(output.processed);
  EXPECT_EQ(output.errors.count("image"), 1u);
}

TEST(SetupChecks, FrameIdsOfOldRecordings) {
  EXPECT_EQ(ros_io::withoutSlash("/camera"), "camera");
  EXPECT_EQ(ros_io::withoutSlash("camera"), "camera");
  EXPECT_EQ(ros_io::withoutSlash(""), "");
}

}  // namespace
}  // namespace stereo_nav::nodes
