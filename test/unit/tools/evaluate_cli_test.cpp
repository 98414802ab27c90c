// The command-line contract of `evaluate`: figures on a recording of known answer, and refusals.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "stereo_nav/ros/topics.h"
#include "support/command.h"
#include "support/fixture_bag.h"

namespace stereo_nav {
namespace {

namespace fs = std::filesystem;

std::string contentOf(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class EvaluateTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = fs::temp_directory_path() / ("evaluate_test_" + std::to_string(getpid()));
    fs::create_directories(folder);
    test::FixtureBag fixture;
    fixture.frames = 12;
    test::writeFixtureBag(file("room.bag"), fixture);
  }
  static void TearDownTestSuite() { fs::remove_all(folder); }

  static std::string file(const std::string& name) { return (folder / name).string(); }

  static test::CommandResult evaluate(const std::string& arguments,
                                      const std::string& config_file = "vo_thesis.yaml") {
    const std::string config = std::string(" --config ") + STEREO_NAV_SOURCE_DIR + "/config/" + config_file;
    return test::runCommand(std::string("ROS_PACKAGE_PATH=") + STEREO_NAV_SOURCE_DIR + " " + EVALUATE + " " +
                            arguments + config);
  }

  /// Exit status 2, one line that holds `part`, and no results.
  static void expectRefusal(const std::string& arguments, const std::string& part) {
    const fs::path output = folder / "refused";
    const auto result = evaluate(arguments + " --output " + output.string());
    EXPECT_EQ(result.status, 2) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
    EXPECT_FALSE(fs::exists(output)) << "a folder is left behind";
  }

  /// A copy of the fixture whose messages `change` may edit; the ones it returns false for are left out.
  template <class Message>
  static std::string copyWith(const std::string& name, const std::string& topic,
                              const std::function<bool(Message&)>& change,
                              const std::string& original = "room.bag") {
    rosbag::Bag source(file(original));
    rosbag::Bag copy(file(name), rosbag::bagmode::Write);
    rosbag::View view(source);
    for (const rosbag::MessageInstance& instance : view) {
      const auto message = instance.getTopic() == topic ? instance.instantiate<Message>() : nullptr;
      if (!message) {
        copy.write(instance.getTopic(), instance.getTime(), instance);
      } else if (change(*message)) {
        copy.write(topic, instance.getTime(), *message);
      }
    }
    return file(name);
  }

  static fs::path folder;
};

fs::path EvaluateTest::folder;

TEST_F(EvaluateTest, MeasuresAKnownDriveAndRepeatsItselfToTheByte) {
  for (const char* output : {"first", "second"}) {
    const auto result = evaluate(file("room.bag") + " --output " + file(output));
    ASSERT_EQ(result.status, 0) << result.output;
  }
  const auto summary = nlohmann::json::parse(contentOf(folder / "first/summary.json"));
  EXPECT_EQ(summary["frames"], 12);
  EXPECT_EQ(summary["frames_lost"], 0);
  EXPECT_NEAR(summary["path_length_m"].get<double>(), 0.44, 0.001);  // 11 periods at 0.4 m/s
  EXPECT_LT(summary["ate_rmse_m"].get<double>(), 0.03);
  for (const char* name : {"trajectory.tum", "trajectory.kitti", "summary.json", "frames.csv"}) {
    const std::string first = contentOf(folder / "first" / name);
    EXPECT_FALSE(first.empty());
    EXPECT_EQ(first, contentOf(folder / "second" / name)) << name;
  }
  const auto timing = nlohmann::json::parse(contentOf(folder / "first/timing.json"));
  EXPECT_GT(timing["frame_time_ms"]["median"].get<double>(), 0.0);
  EXPECT_GT(timing["stage_time_ms"].size(), 3u);
  EXPECT_NE(contentOf(folder / "first/report.html").find("</html>"), std::string::npos);
}

TEST_F(EvaluateTest, TheDisparityMapHasItsOwnParameters) {
  // When the search lies beyond the disparities of the room, nothing has a depth and nothing can be followed.
  std::ofstream(file("near.yaml")) << "min_disparity: 128\n";
  const auto as_configured = evaluate(file("room.bag") + " --output " + file("wide"));
  ASSERT_EQ(as_configured.status, 0) << as_configured.output;
  const auto result =
      evaluate(file("room.bag") + " --disparity-config " + file("near.yaml") + " --output " + file("narrow"));
  ASSERT_EQ(result.status, 0) << result.output;
  const auto wide = nlohmann::json::parse(contentOf(folder / "wide/summary.json"));
  const auto narrow = nlohmann::json::parse(contentOf(folder / "narrow/summary.json"));
  EXPECT_LT(narrow["inliers_mean"].get<double>(), 0.5 * wide["inliers_mean"].get<double>());
}

TEST_F(EvaluateTest, SaysWhichFramesAreLostAndEndsWithStatusThreeWhenTheyAreMost) {
  int images = 0;
  const auto covered =
      copyWith<sensor_msgs::Image>("covered.bag", ros_io::topics::kLeftImage, [&](sensor_msgs::Image& image) {
        if (images++ >= 4) std::fill(image.data.begin(), image.data.end(), std::uint8_t(0));
        return true;
      });
  const auto result = evaluate(covered + " --output " + file("covered"));
  EXPECT_EQ(result.status, 3) << result.output;
  EXPECT_NE(result.output.find("8 of 12 frames are lost, more than half"), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("  lost: frames 4 to 11 (0.40 to 1.10 s): "), std::string::npos)
      << result.output;
  EXPECT_TRUE(fs::exists(folder / "covered/report.html"));
}

TEST_F(EvaluateTest, ImagesWithoutDistortionAreRectifiedByTheirRotation) {
  test::FixtureBag fixture;
  fixture.frames = 12;
  fixture.toe_in_rad = 0.01;
  test::writeFixtureBag(file("toe_in.bag"), fixture);
  const auto result = evaluate(file("toe_in.bag") + " --output " + file("toe_in"), "vo.yaml");
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("note: the right camera_info: all coefficients of D are 0"), std::string::npos)
      << result.output;
  const auto summary = nlohmann::json::parse(contentOf(folder / "toe_in/summary.json"));
  EXPECT_LT(summary["end_error_percent"].get<double>(), 2.0) << "of 44 cm; copied images give 20";
}

TEST_F(EvaluateTest, RefusesCalibrationsInOneLine) {
  using sensor_msgs::CameraInfo;
  const auto with = [](const std::string& name, const std::function<void(CameraInfo&)>& change) {
    return copyWith<CameraInfo>(name, ros_io::topics::kRightInfo, [&](CameraInfo& info) {
      change(info);
      return true;
    });
  };
  expectRefusal(with("mm.bag", [](CameraInfo& info) { info.P[3] *= 1000.0; }), "likely in mm (0.12 m)");
  expectRefusal(with("roi.bag",
                     [](CameraInfo& info) {
                       info.roi.x_offset = 160;
                       info.roi.width = info.width;
                       info.roi.height = info.height;
                     }),
                "does not lie in the image of 320x240");
  expectRefusal(with("fisheye.bag", [](CameraInfo& info) { info.distortion_model = "fisheye"; }),
                "distortion_model 'fisheye' is not supported");
  expectRefusal(with("short.bag", [](CameraInfo& info) { info.D = {0.1, 0.1}; }), "D holds 2 coefficients");
  expectRefusal(with("turned.bag", [](CameraInfo& info) { info.R[0] = 2.0; }), "R is no rotation");
}

TEST_F(EvaluateTest, UsesTheFirstCalibrationThatIsNotZero) {
  int infos = 0;
  const auto late = copyWith<sensor_msgs::CameraInfo>("late.bag", ros_io::topics::kLeftInfo,
                                                      [&](sensor_msgs::CameraInfo& info) {
                                                        const std_msgs::Header header = info.header;
                                                        if (infos++ < 3) info = sensor_msgs::CameraInfo();
                                                        info.header = header;
                                                        return true;
                                                      });
  const auto result = evaluate(late + " --output " + file("late"));
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("note: camera/left/camera_info: the first 3 messages are all zero"),
            std::string::npos)
      << result.output;
}

TEST_F(EvaluateTest, TakesARectifiedPairWithoutModelAsItIs) {
  const auto blank = copyWith<sensor_msgs::CameraInfo>("blank.bag", ros_io::topics::kLeftInfo,
                                                       [](sensor_msgs::CameraInfo& info) {
                                                         info.distortion_model.clear();
                                                         info.D.clear();
                                                         return true;
                                                       });
  for (const std::string name : {"blank", "room"}) {
    const auto result = evaluate(file(name + ".bag") + " --output " + file(name));
    EXPECT_EQ(result.status, 0) << result.output;
  }
  EXPECT_EQ(contentOf(folder / "blank/trajectory.tum"), contentOf(folder / "room/trajectory.tum"));
}

/// A drive that turns by 28 degrees, and an IMU with a mistake: the path is that of vision alone, and the
/// mistake is named.
class EvaluateImuTest : public EvaluateTest {
 protected:
  static void SetUpTestSuite() {
    EvaluateTest::SetUpTestSuite();
    test::FixtureBag fixture;
    fixture.frames = 30;
    test::writeFixtureBag(file("turn.bag"), fixture);
    fixture.with_imu = false;
    test::writeFixtureBag(file("vision.bag"), fixture);
  }

  static void expectSetAside(const std::string& name, const std::string& part,
                             const std::function<void(sensor_msgs::Imu&)>& spoil) {
    const auto bag = copyWith<sensor_msgs::Imu>(
        name + ".bag", ros_io::topics::kImu,
        [&spoil](sensor_msgs::Imu& imu) {
          spoil(imu);
          return true;
        },
        "turn.bag");
    const auto result = evaluate(bag + " --output " + file(name), "vo.yaml");
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_NE(result.output.find("note: the IMU is set aside, the path is that of vision alone"),
              std::string::npos)
        << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
    const auto summary = nlohmann::json::parse(contentOf(folder / name / "summary.json"));
    EXPECT_NE(summary["imu_set_aside"].get<std::string>().find(part), std::string::npos) << summary;
    ASSERT_EQ(evaluate(file("vision.bag") + " --output " + file("vision"), "vo.yaml").status, 0);
    EXPECT_EQ(contentOf(folder / name / "trajectory.tum"), contentOf(folder / "vision/trajectory.tum"));
  }
};

TEST_F(EvaluateImuTest, AGoodOneIsUsed) {
  const auto result = evaluate(file("turn.bag") + " --output " + file("turn"), "vo.yaml");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(result.output.find("set aside"), std::string::npos) << result.output;
  EXPECT_EQ(nlohmann::json::parse(contentOf(folder / "turn/summary.json"))["imu_set_aside"], "");
}

TEST_F(EvaluateImuTest, OneWhoseMountingNothingTellsIsSetAside) {
  expectSetAside("no_frame", "have an empty frame_id",
                 [](sensor_msgs::Imu& imu) { imu.header.frame_id.clear(); });
  expectSetAside("other_frame", "no transform from base_link to the IMU's frame 'gyro'",
                 [](sensor_msgs::Imu& imu) { imu.header.frame_id = "gyro"; });
}

TEST_F(EvaluateImuTest, OneWhoseStampsNeverCoverTheImagesIsSetAside) {
  expectSetAside("no_stamp", "the stamps of the IMU are 0",
                 [](sensor_msgs::Imu& imu) { imu.header.stamp = ros::Time(); });
  expectSetAside("an_hour_late", "begin 3597.",
                 [](sensor_msgs::Imu& imu) { imu.header.stamp += ros::Duration(3600.0); });
}

TEST_F(EvaluateImuTest, OneThatContradictsTheImagesIsSetAside) {
  expectSetAside("degrees", "rates are in deg/s", [](sensor_msgs::Imu& imu) {
    imu.orientation_covariance[0] = -1.0;
    for (double* rate : {&imu.angular_velocity.x, &imu.angular_velocity.y, &imu.angular_velocity.z})
      *rate *= 57.29578;
  });
  expectSetAside("dead", "stay the same while it turns", [](sensor_msgs::Imu& imu) {
    imu.orientation = geometry_msgs::Quaternion();
    imu.orientation.w = 1.0;
  });
}

/// The room's cameras and their mounting are exact: the covariances are the larger ones, but not by orders.
TEST_F(EvaluateTest, CovariancesAreAsLargeAsTheErrors) {
  test::FixtureBag fixture;
  fixture.frames = 60;
  test::writeFixtureBag(file("long.bag"), fixture);
  ASSERT_EQ(evaluate(file("long.bag") + " --output " + file("long"), "vo.yaml").status, 0);
  const auto nees = nlohmann::json::parse(contentOf(folder / "long/summary.json"))["nees"];
  for (const char* interval : {"0.2", "1"}) {
    SCOPED_TRACE(interval);
    EXPECT_GT(nees[interval]["pairs"], 4);
    for (const char* part : {"translation", "rotation"}) {
      EXPECT_GT(nees[interval][part].get<double>() / 3.0, 0.05) << part;
      EXPECT_LT(nees[interval][part].get<double>() / 3.0, 1.5) << part;
    }
    EXPECT_GE(nees[interval]["inside_95_percent"].get<double>(), 85.0);
  }
}

TEST_F(EvaluateTest, TheRigFileSaysHowGoodTheCalibrationIs) {
  std::ofstream(file("poor_rig.yaml")) << "uncertainty: {baseline_sigma_share: 0.2}\n";
  const std::string command = file("room.bag") + " --output " + file("poor_rig");
  ASSERT_EQ(evaluate(command, "vo.yaml").status, 0);
  const auto sure = nlohmann::json::parse(contentOf(folder / "poor_rig/summary.json"))["nees"]["0.2"];
  ASSERT_EQ(evaluate(command + " --rig " + file("poor_rig.yaml"), "vo.yaml").status, 0);
  const auto unsure = nlohmann::json::parse(contentOf(folder / "poor_rig/summary.json"))["nees"]["0.2"];
  EXPECT_LT(unsure["translation"].get<double>(), 0.9 * sure["translation"].get<double>());
  std::ofstream(file("wrong_rig.yaml")) << "uncertainty: {baseline_sigma_share: -1}\n";
  const auto result = evaluate(command + " --rig " + file("wrong_rig.yaml"), "vo.yaml");
  EXPECT_EQ(result.status, 2) << result.output;
  EXPECT_NE(result.output.find("baseline_sigma_share"), std::string::npos) << result.output;
}

TEST_F(EvaluateImuTest, OneIsLeftOutOnRequest) {
  for (const std::string bag : {"turn", "vision"}) {
    const auto result = evaluate(file(bag + ".bag") + " --no-imu --output " + file(bag + "_only"), "vo.yaml");
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_EQ(result.output.find("--no-imu was asked for") != std::string::npos, bag == "turn")
        << result.output;
  }
  EXPECT_EQ(contentOf(folder / "turn_only/trajectory.tum"), contentOf(folder / "vision_only/trajectory.tum"));
}

TEST_F(EvaluateTest, RefusesBadArguments) {
  expectRefusal("", "no BAG given");
  expectRefusal(file("room.bag") + " --start -1", "--start");
  expectRefusal(file("room.bag") + " --repeat 0", "--repeat");
  expectRefusal(file("room.bag") + " --rolling-shutter-ms 500", "--rolling-shutter-ms");
  expectRefusal(file("room.bag") + " --frobnicate", "frobnicate");
}

TEST_F(EvaluateTest, RefusesUnreadableInput) {
  expectRefusal(file("nothing.bag"), "nothing.bag");
  fs::copy_file(file("room.bag"), file("cut.bag"));
  fs::resize_file(file("cut.bag"), fs::file_size(file("cut.bag")) / 2);
  expectRefusal(file("cut.bag"), "cut.bag");
}

TEST_F(EvaluateTest, RefusesWhatItWouldMisread) {
  using ros_io::topics::kLeftImage;
  using ros_io::topics::kRightImage;
  using ros_io::topics::kRightInfo;
  expectRefusal(copyWith<sensor_msgs::Image>("right.bag", kRightImage, [](auto&) { return false; }),
                "no topic camera/right/image_raw");
  expectRefusal(copyWith<sensor_msgs::Image>("float.bag", kLeftImage,
                                             [](auto& image) {
                                               image.encoding = "32FC1";
                                               return true;
                                             }),
                "'32FC1' is not supported");
  expectRefusal(copyWith<sensor_msgs::CameraInfo>("mono.bag", kRightInfo,
                                                  [](auto& info) {
                                                    info.P[3] = 0.0;
                                                    return true;
                                                  }),
                "without baseline");
  expectRefusal(copyWith<sensor_msgs::CameraInfo>("nan.bag", kRightInfo,
                                                  [](auto& info) {
                                                    info.K[2] = std::nan("");
                                                    return true;
                                                  }),
                "NaN");
  expectRefusal(copyWith<sensor_msgs::Image>("small.bag", kRightImage,
                                             [](auto& image) {
                                               image.height = 100;
                                               image.data.resize(100 * image.step);
                                               return true;
                                             }),
                "right image is 320x100");
}

TEST_F(EvaluateTest, RefusesGroundTruthThatDoesNotOverlapInTime) {
  std::ofstream(file("later.tum")) << "5000.0 0 0 0 0 0 0 1\n5001.0 1 0 0 0 0 0 1\n";
  expectRefusal(file("room.bag") + " --ground-truth " + file("later.tum"), "ground truth");
  expectRefusal(file("room.bag") + " --ground-truth no/such/topic", "no ground truth topic no/such/topic");
}

TEST_F(EvaluateTest, RefusesAnOutputThatCannotBeWritten) {
  std::ofstream(file("occupied")) << "a file";
  const auto result = evaluate(file("room.bag") + " --output " + file("occupied"));
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
}

}  // namespace
}  // namespace stereo_nav
