#include "nodes/base_bridge/base_control.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kinematics/layouts.h"
#include "ros/device_messages.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::nodes {
namespace {

using base::Mode;
using ros_io::toBatteryState;
using ros_io::toJointState;
using ros_io::toRange;
using ros_io::toWheelTicks;

/// The decisions of base_bridge for a differential drive with a servo, a range finder and a motor.
class BaseControlTest : public testing::Test {
 protected:
  static ros_io::BaseBridgeParams params() {
    ros_io::BaseBridgeParams params;
    params.limits.max_acceleration_m_per_s2 = 5.0;
    params.joints.resize(1);
    params.joints[0].max_deg = 45.0;
    params.ranges.resize(1);
    params.actuators.resize(1);
    return params;
  }

  base::Telemetry telemetry(Mode mode) const {
    base::Telemetry t{};
    t.command_sequence = command_.sequence;
    t.mode = static_cast<std::uint8_t>(mode);
    t.wheels = 2;
    t.joints = t.ranges = t.actuators = 1;
    t.joint_urad[0] = 123456;
    return t;
  }

  void hear(Mode mode) { control_.addTelemetry(telemetry(mode), now_s_); }

  const base::Command& step() {
    if (const auto command = control_.step(now_s_)) command_ = *command;
    return command_;
  }

  /// Telemetry and a command every 20 ms.
  const base::Command& run(double duration_s, Mode mode = Mode::kDriving) {
    for (const double end_s = now_s_ + duration_s - 1e-9; now_s_ < end_s;) {
      now_s_ += 0.02;
      hear(mode);
      step();
    }
    return command_;
  }

  bool refuses(const std::optional<std::string>& answer, const std::string& part) const {
    EXPECT_TRUE(answer.has_value()) << "not refused";
    return answer && answer->find(part) != std::string::npos;
  }

  kinematics::DriveParams drive_ = kinematics::differentialDrive(0.4, 0.05);
  BaseControl control_{params(), drive_};
  base::Command command_{};
  double now_s_ = 100.0;
};

TEST_F(BaseControlTest, SendsNothingBeforeItKnowsTheController) {
  EXPECT_FALSE(control_.step(now_s_).has_value());
  EXPECT_TRUE(refuses(control_.setVelocity({0.5, 0, 0}, now_s_), "no telemetry"));
  EXPECT_TRUE(refuses(control_.setJoint(0, 0.1, now_s_), "no telemetry"));
  hear(Mode::kWaiting);
  ASSERT_TRUE(control_.step(now_s_).has_value());
  EXPECT_EQ(step().joint_urad[0], 123456) << "servos stay where they are";
  EXPECT_EQ(control_.velocitiesRefused(), 1U);
}

TEST_F(BaseControlTest, AVelocityBecomesWheelSpeedsWithWhatIsLeftOfItsTime) {
  run(0.02);
  ASSERT_FALSE(control_.setVelocity({0.5, 0.0, 1.0}, now_s_));
  const double given_s = now_s_;
  run(0.28);
  EXPECT_EQ(command_.speed_mm_per_s[0], 300);
  EXPECT_EQ(command_.speed_mm_per_s[1], 700);
  EXPECT_EQ(command_.flags, 0);
  EXPECT_NEAR(command_.valid_ms, 1e3 * (given_s + 0.3 - now_s_), 1.0);
  EXPECT_TRUE(control_.drives());
}

TEST_F(BaseControlTest, RepeatedCommandsDoNotOutliveTheVelocity) {
  run(0.02);
  ASSERT_FALSE(control_.setVelocity({0.5, 0.0, 0.0}, now_s_));
  const double given_s = now_s_;
  while (now_s_ < given_s + 1.0) {
    now_s_ += 0.02;
    hear(Mode::kDriving);
    step();
    ASSERT_LE(now_s_ + 1e-3 * command_.valid_ms, std::max(given_s + 0.3 + 1e-6, now_s_));
    if (now_s_ >= given_s + 0.3) {
      ASSERT_EQ(command_.speed_mm_per_s[0], 0);
      ASSERT_EQ(command_.valid_ms, 0);
    }
  }
  EXPECT_EQ(control_.velocitiesTimedOut(), 1U);
}

TEST_F(BaseControlTest, AfterAPauseOfTheProgramNeitherOldNorWaitingVelocitiesDrive) {
  const auto runTicking = [&](double duration_s) {
    for (const double end_s = now_s_ + duration_s - 1e-9; now_s_ < end_s;) {
      control_.tick(now_s_ + 0.02);
      run(0.02);
    }
  };
  runTicking(0.04);
  ASSERT_FALSE(control_.setVelocity({0.5, 0, 0}, now_s_));
  runTicking(0.06);
  EXPECT_GT(command_.valid_ms, 0);

  now_s_ += 0.15;  // shorter than the velocity's own time
  hear(Mode::kDriving);
  EXPECT_TRUE(refuses(control_.setVelocity({0.5, 0, 0}, now_s_), "stood still")) << "before the loop goes on";
  control_.tick(now_s_);
  EXPECT_EQ(step().valid_ms, 0);
  EXPECT_TRUE(refuses(control_.setVelocity({0.5, 0, 0}, now_s_ + 0.05), "stood still"));
  EXPECT_TRUE(refuses(control_.setActuator(0, 0.5, now_s_ + 0.05), "stood still"));
  runTicking(0.08);
  EXPECT_EQ(command_.valid_ms, 0);
  EXPECT_EQ(command_.speed_mm_per_s[0], 0);
  runTicking(0.04);
  EXPECT_FALSE(control_.setVelocity({1.0, 0, 0}, now_s_));
  runTicking(0.02);
  EXPECT_EQ(command_.speed_mm_per_s[0], 100) << "it accelerates from rest";
  EXPECT_EQ(control_.pauses(), 1U);
}

TEST_F(BaseControlTest, AStopHoldsUntilItIsReleasedAndTheOldVelocityIsForgotten) {
  run(0.02);
  control_.setVelocity({0.5, 0, 0}, now_s_);
  run(0.1);
  control_.setActuator(0, 0.7, now_s_);
  control_.stop();
  EXPECT_FALSE(control_.confirmed(now_s_));
  step();
  EXPECT_EQ(command_.flags, base::kStop);
  EXPECT_EQ(command_.speed_mm_per_s[0], 0);
  EXPECT_EQ(command_.actuator_permille[0], 0);
  hear(Mode::kStopped);
  EXPECT_TRUE(control_.confirmed(now_s_));
  EXPECT_TRUE(refuses(control_.setVelocity({0.5, 0, 0}, now_s_), "base/release"));

  control_.release();
  hear(Mode::kStopped);  // was on its way
  EXPECT_FALSE(control_.confirmed(now_s_));
  EXPECT_TRUE(refuses(control_.setVelocity({0.5, 0, 0}, now_s_), "not confirmed"));
  step();
  EXPECT_EQ(command_.flags, base::kRelease);
  hear(Mode::kTimedOut);
  EXPECT_TRUE(control_.confirmed(now_s_));
  EXPECT_FALSE(control_.stopped());
  run(0.04, Mode::kTimedOut);
  EXPECT_EQ(command_.flags, 0);
  EXPECT_EQ(command_.valid_ms, 0) << "what was commanded before the stop is not taken up again";
  EXPECT_FALSE(control_.setVelocity({0.5, 0, 0}, now_s_));
}

TEST_F(BaseControlTest, NothingThatWasOrderedInAStopMovesWhenItIsReleased) {
  run(0.02);
  ASSERT_FALSE(control_.setActuator(0, 0.7, now_s_));
  ASSERT_FALSE(control_.setJoint(0, 0.6, now_s_));  // the stop comes before the servo has moved
  control_.stop();
  run(0.1, Mode::kStopped);
  EXPECT_TRUE(refuses(control_.setActuator(0, 0.8, now_s_), "base/release"));
  EXPECT_TRUE(refuses(control_.setJoint(0, 0.3, now_s_), "base/release"));
  EXPECT_EQ(control_.devicesRefused(), 2U);
  control_.release();
  EXPECT_TRUE(refuses(control_.setActuator(0, 0.8, now_s_), "not confirmed"));
  run(0.04, Mode::kStopped);
  EXPECT_EQ(command_.flags, base::kRelease);
  EXPECT_EQ(command_.actuator_permille[0], 0);
  EXPECT_EQ(command_.joint_urad[0], 123456);
  run(0.1, Mode::kTimedOut);
  EXPECT_EQ(command_.actuator_permille[0], 0);
  EXPECT_EQ(command_.joint_urad[0], 123456);
  EXPECT_FALSE(control_.setActuator(0, 0.8, now_s_));
  EXPECT_FALSE(control_.setJoint(0, 0.3, now_s_));
  EXPECT_EQ(run(0.02).actuator_permille[0], 800);
  EXPECT_EQ(command_.joint_urad[0], 300000);
}

TEST_F(BaseControlTest, NothingStartsByItselfWhenTheLineComesBack) {
  run(0.02);
  ASSERT_FALSE(control_.setActuator(0, 0.7, now_s_));
  EXPECT_EQ(run(0.02).actuator_permille[0], 700);
  now_s_ += 0.31;
  EXPECT_EQ(step().actuator_permille[0], 0);
  EXPECT_TRUE(refuses(control_.setActuator(0, 0.9, now_s_), "no telemetry"));
  EXPECT_TRUE(refuses(control_.setJoint(0, 0.3, now_s_), "no telemetry"));
  run(0.1);
  EXPECT_EQ(command_.actuator_permille[0], 0);
  EXPECT_EQ(command_.joint_urad[0], 123456);

  ASSERT_FALSE(control_.setActuator(0, 0.7, now_s_));
  run(0.02);
  now_s_ += 0.31;  // and no command was made meanwhile
  EXPECT_EQ(run(0.02).actuator_permille[0], 0);
}

TEST_F(BaseControlTest, TelemetryOfBeforeTheReleaseDoesNotConfirmIt) {
  run(0.02);
  control_.stop();
  step();
  base::Telemetry before = telemetry(Mode::kDriving);
  before.command_sequence = static_cast<std::uint16_t>(command_.sequence - 1);
  control_.release();
  step();
  control_.addTelemetry(before, now_s_);
  EXPECT_TRUE(control_.stopped());
  EXPECT_EQ(step().flags, base::kRelease);
}

TEST_F(BaseControlTest, OrdersAreConfirmedAfterALongOutage) {
  for (const bool release : {false, true}) {
    run(0.02, Mode::kStopped);
    control_.stop();
    run(0.04, Mode::kStopped);
    if (release) control_.release();
    for (int i = 0; i < 40000; ++i) {  // more than half of the numbers: 13 minutes
      now_s_ += 0.02;
      step();
    }
    EXPECT_FALSE(control_.confirmed(now_s_));
    EXPECT_TRUE(control_.stopped());
    const auto sequence = command_.sequence;
    hear(Mode::kStopped);
    step();
    EXPECT_EQ(command_.flags, release ? base::kRelease : base::kStop) << sequence;
    now_s_ += 0.02;
    hear(release ? Mode::kTimedOut : Mode::kStopped);
    EXPECT_TRUE(control_.confirmed(now_s_));
    EXPECT_EQ(control_.stopped(), !release);
  }
}

TEST_F(BaseControlTest, AStopWorksWithoutTelemetry) {
  control_.stop();
  const auto command = control_.step(now_s_);
  ASSERT_TRUE(command.has_value());
  EXPECT_EQ(command->flags, base::kStop);
}

TEST_F(BaseControlTest, TakesOverTheStopOfTheControllerAndOfTheNodeBefore) {
  hear(Mode::kStopped);
  EXPECT_TRUE(control_.stopped());
  EXPECT_EQ(step().flags, base::kStop);
  EXPECT_TRUE(refuses(control_.setVelocity({0.5, 0, 0}, now_s_), "base/release"));
}

TEST_F(BaseControlTest, WithoutTelemetryItStopsAndRefuses) {
  run(0.02);
  control_.setVelocity({0.5, 0, 0}, now_s_);
  run(0.02);
  EXPECT_GT(command_.valid_ms, 0);
  now_s_ += 0.31;
  EXPECT_TRUE(refuses(control_.setVelocity({0.5, 0, 0}, now_s_), "no telemetry"));
  EXPECT_EQ(step().valid_ms, 0);
}

TEST_F(BaseControlTest, AnotherRobotsControllerIsNamedAndNotDriven) {
  base::Telemetry other = telemetry(Mode::kWaiting);
  other.wheels = 4;
  control_.addTelemetry(other, now_s_);
  EXPECT_FALSE(control_.fits(other));
  EXPECT_FALSE(control_.step(now_s_).has_value());
  EXPECT_TRUE(refuses(control_.setVelocity({0.5, 0, 0}, now_s_), "4 wheels, 1 joints"));
}

TEST_F(BaseControlTest, NumbersThatAreNoneStopTheBase) {
  const double bad = std::numeric_limits<double>::quiet_NaN();
  run(0.02);
  control_.setVelocity({0.5, 0, 0}, now_s_);
  EXPECT_TRUE(refuses(control_.setVelocity({0.5, bad, 0}, now_s_), "no number"));
  EXPECT_EQ(run(0.02).valid_ms, 0);
  EXPECT_TRUE(refuses(control_.setJoint(0, bad, now_s_), "no number"));
  EXPECT_TRUE(refuses(control_.setActuator(0, bad, now_s_), "no number"));
}

TEST_F(BaseControlTest, LimitsAcceleratesAndBeginsAtRestAfterAStop) {
  run(0.02);
  const auto firstSpeed = [&] {
    control_.setVelocity({1.0, 0, 0}, now_s_);
    return run(0.02).speed_mm_per_s[0];
  };
  EXPECT_EQ(firstSpeed(), 100);
  for (int i = 0; i < 20; ++i) firstSpeed();
  EXPECT_EQ(command_.speed_mm_per_s[0], 1000);
  run(0.4);
  EXPECT_EQ(command_.speed_mm_per_s[0], 0);
  EXPECT_EQ(firstSpeed(), 100);
}

TEST_F(BaseControlTest, ServosAndActuatorsStayWithinWhatTheyCanDo) {
  run(0.02);
  control_.setJoint(0, 2.0, now_s_);
  control_.setActuator(0, -3.0, now_s_);
  EXPECT_NEAR(run(0.02).joint_urad[0], 1e6 * M_PI / 4, 1.0);
  EXPECT_EQ(command_.actuator_permille[0], -1000);
}

TEST_F(BaseControlTest, ItsFarewellStopsAndLatchesNothing) {
  run(0.02);
  control_.setVelocity({1.0, 0, 0}, now_s_);
  run(0.1);
  const auto last = control_.farewell();
  ASSERT_TRUE(last.has_value());
  EXPECT_EQ(last->valid_ms, 0);
  EXPECT_EQ(last->flags, 0);
  EXPECT_EQ(last->joints, 1);
  EXPECT_EQ(last->joint_urad[0], command_.joint_urad[0]);
}

TEST_F(BaseControlTest, WhoDoesNotKnowTheServosDoesNotMoveThem) {
  EXPECT_FALSE(control_.farewell().has_value());
  control_.stop();
  for (const auto& command : {control_.step(now_s_), control_.farewell()}) {
    ASSERT_TRUE(command.has_value());
    EXPECT_EQ(command->flags, base::kStop);
    EXPECT_EQ(command->joints, 0);
  }
}

TEST(BaseMessages, AreThoseOfTheTelemetry) {
  base::Telemetry t{};
  t.pulses[0] = -2048;
  t.pulses[1] = 1024;
  t.steering_urad[0] = 250000;
  t.joint_urad[0] = -500000;
  auto drive = kinematics::differentialDrive(0.4, 0.05);
  drive.wheels[1].encoder_reversed = true;
  ros_io::BaseBridgeParams params;
  params.joints.resize(1);
  params.joints[0].name = "camera";
  const ros::Time stamp(12.5);
  EXPECT_TRUE(toWheelTicks(t, drive, "base_link", stamp).steering_rad.empty());
  drive.wheels[0].kind = kinematics::WheelKind::kSteered;
  const WheelTicks ticks = toWheelTicks(t, drive, "base_link", stamp);
  EXPECT_EQ(ticks.names, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(ticks.pulses, (std::vector<std::int64_t>{-2048, 1024}));
  EXPECT_EQ(ticks.steering_rad, (std::vector<double>{0.25, 0.0}));
  const auto joints = toJointState(t, drive, params, stamp);
  EXPECT_EQ(joints.name, (std::vector<std::string>{"left_steering", "left_wheel", "right_wheel", "camera"}));
  EXPECT_NEAR(joints.position[1], -4.0 * M_PI, 1e-9);
  EXPECT_NEAR(joints.position[2], -2.0 * M_PI, 1e-9) << "the wheel rolls against its encoder";
  EXPECT_NEAR(joints.position[3], -0.5, 1e-12);
}

TEST(BaseMessages, RangesFollowRep117) {
  ros_io::BaseRangeParams finder;
  finder.name = "front";
  const auto range = [&](std::uint16_t range_mm) { return toRange(range_mm, finder, ros::Time(1)).range; };
  EXPECT_NEAR(range(1500), 1.5, 1e-6);
  for (const std::uint16_t near : {base::kRangeTooNear, std::uint16_t{99}}) {
    EXPECT_TRUE(std::isinf(range(near)) && range(near) < 0.0F) << near;
  }
  for (const std::uint16_t far : {base::kRangeNothing, std::uint16_t{12001}}) {
    EXPECT_TRUE(std::isinf(range(far)) && range(far) > 0.0F) << far;
  }
  EXPECT_TRUE(std::isnan(range(base::kRangeUnknown)));
  EXPECT_EQ(toRange(1500, finder, ros::Time(1)).header.frame_id, "range_front");
}

TEST(BaseMessages, ThePercentageOfTheBatteryIsUnknownWithoutItsVoltages) {
  ros_io::BaseBridgeParams params;
  EXPECT_TRUE(std::isnan(toBatteryState(12000, params, ros::Time(1)).percentage));
  params.battery_empty_V = 11.0;
  params.battery_full_V = 12.6;
  EXPECT_NEAR(toBatteryState(11800, params, ros::Time(1)).percentage, 0.5, 1e-6);
}

TEST(BaseBridgeParamsTest, ReadsListsAndRefusesNamesThatNoTopicCanHave) {
  ros_io::BaseBridgeParams params;
  readParameters(
      parseYaml("{joints: 1, joint_1: {name: tilt}, ranges: 2, range_1: {name: a}, range_2: {name: b}}", "x"),
      "x", params);
  EXPECT_EQ(params.joints[0].name, "tilt");
  EXPECT_NO_THROW(params.checkNames());
  params.ranges[1].name = "a";
  EXPECT_THROW(params.checkNames(), ParameterError);
  params.ranges[1].name = "b c";
  EXPECT_THROW(params.checkNames(), ParameterError);
}

}  // namespace
}  // namespace stereo_nav::nodes
