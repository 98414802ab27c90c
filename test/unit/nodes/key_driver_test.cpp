#include "nodes/teleop/key_driver.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stereo_nav::nodes {
namespace {

using kinematics::Twist;

Twist velocityOf(char key) {
  KeyDriver driver((TeleopParams()));
  driver.press(key, 1.0);
  return driver.velocity(1.0).value_or(Twist(9, 9, 9));
}

TEST(KeyDriverTest, HasTheKeysOfTeleopTwistKeyboard) {
  EXPECT_EQ(velocityOf('i'), Twist(0.5, 0, 0));
  EXPECT_EQ(velocityOf('o'), Twist(0.5, 0, -1));
  EXPECT_EQ(velocityOf('j'), Twist(0, 0, 1));
  EXPECT_EQ(velocityOf(','), Twist(-0.5, 0, 0));
  EXPECT_EQ(velocityOf('m'), Twist(-0.5, 0, -1));
  EXPECT_EQ(velocityOf('U'), Twist(0.5, 0.5, 0));
  EXPECT_EQ(velocityOf('L'), Twist(0, -0.5, 0));
}

TEST(KeyDriverTest, DrivesOnlyWhileAKeyIsHeld) {
  KeyDriver driver((TeleopParams()));
  EXPECT_FALSE(driver.velocity(0.0).has_value());
  driver.press('i', 0.0);
  EXPECT_EQ(driver.velocity(0.59), Twist(0.5, 0, 0)) << "until the terminal begins to repeat";
  for (double t_s = 0.5; t_s < 2.0; t_s += 0.033) driver.press('i', t_s);
  EXPECT_EQ(driver.velocity(2.1), Twist(0.5, 0, 0));
  EXPECT_EQ(driver.velocity(2.25), Twist(0, 0, 0)) << "let go";
  EXPECT_FALSE(driver.velocity(2.3).has_value()) << "others may have the word";
}

TEST(KeyDriverTest, AnyOtherKeyStopsAtOnce) {
  for (const char key : {'k', ' ', '5'}) {
    KeyDriver driver((TeleopParams()));
    driver.press('i', 0.0);
    driver.press(key, 0.1);
    EXPECT_EQ(driver.velocity(0.1), Twist(0, 0, 0));
  }
}

TEST(KeyDriverTest, ChangesItsSpeeds) {
  KeyDriver driver((TeleopParams()));
  EXPECT_TRUE(driver.press('q', 0.0).has_value());
  driver.press('x', 0.0);
  driver.press('e', 0.0);
  driver.press('u', 0.0);
  const Twist twist = driver.velocity(0.0).value_or(Twist::Zero());
  EXPECT_NEAR(twist.x(), 0.5 * 1.1 * 0.9, 1e-9);
  EXPECT_NEAR(twist.z(), 1.1 * 1.1, 1e-9);
}

TEST(KeyDriverTest, FieldCentricDrivingTurnsWithTheHeadingAndStopsWithoutIt) {
  KeyDriver driver((TeleopParams()));
  driver.press('f', 0.0);
  driver.press('i', 0.0);
  EXPECT_EQ(driver.velocity(0.1), Twist(0, 0, 0));
  EXPECT_TRUE(driver.lacksHeading(0.1));
  driver.setHeading(M_PI / 2, 0.1);
  const Twist twist = driver.velocity(0.2).value_or(Twist::Zero());
  EXPECT_NEAR(twist.x(), 0.0, 1e-9);
  EXPECT_NEAR(twist.y(), -0.5, 1e-9) << "the robot looks left: forward in the field is to its right";
  for (double t_s = 0.2; t_s < 0.8; t_s += 0.05) driver.press('i', t_s);
  EXPECT_EQ(driver.velocity(0.8), Twist(0, 0, 0)) << "the heading is old";
  driver.press('f', 0.8);
  driver.press('i', 0.8);
  EXPECT_EQ(driver.velocity(0.8), Twist(0.5, 0, 0));
}

}  // namespace
}  // namespace stereo_nav::nodes
