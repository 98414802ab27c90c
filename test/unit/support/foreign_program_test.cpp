#include "support/foreign_program.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace stereo_nav::test {
namespace {

constexpr double kLongWait_s = 60.0;  // for a loaded machine; nothing waits this long otherwise

/// Programs that leave a mark at each start, and at the second one a file `up`.
class ForeignProgramTest : public testing::Test {
 protected:
  ForeignProgramTest() {
    if (mkdtemp(folder_) == nullptr) throw std::runtime_error("cannot make a folder in /tmp");
  }
  ~ForeignProgramTest() override { std::filesystem::remove_all(folder_); }

  /// `death` is what it does at its first start; at the second it stays.
  std::string program(const std::string& death) const {
    const std::string folder = folder_;
    return "cd " + folder + "; if mkdir first 2>/dev/null; then echo starting; " + death +
           "; fi; touch up; exec sleep 100";
  }
  bool isUp() const { return std::filesystem::exists(std::string(folder_) + "/up"); }

  char folder_[40] = "/tmp/stereo_nav_foreign_XXXXXX";
};

/// What roslaunch says of a process that has died, and that the launch ends with it.
std::string roslaunchSays(const std::string& exit_code, const std::string& path) {
  return "echo 'REQUIRED process [it-1] has died!'; echo 'process has died [pid 7, exit code " + exit_code +
         ", cmd " + path + " -d x __name:=it].'; exit 0";
}

TEST_F(ForeignProgramTest, DeathOfASignalAtTheStartIsSaidAndForgivenOnce) {
  testing::internal::CaptureStdout();
  ForeignProgram program("fake", this->program("kill -SEGV $$"));
  EXPECT_TRUE(program.comesUp([this] { return isUp(); }, kLongWait_s));
  EXPECT_EQ(program.starts(), 2);
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_NE(said.find("fake, which is not ours, has died of a signal"), std::string::npos) << said;
  EXPECT_NE(said.find("starting"), std::string::npos) << said;
}

TEST_F(ForeignProgramTest, TheSecondDeathIsAFailure) {
  ForeignProgram program("fake", "kill -SEGV $$");
  EXPECT_FALSE(program.comesUp([] { return false; }, kLongWait_s));
  EXPECT_EQ(program.starts(), 2);
}

TEST_F(ForeignProgramTest, AnEndOfItsOwnIsAFailure) {
  ForeignProgram program("fake", this->program("exit 139"));
  EXPECT_FALSE(program.comesUp([this] { return isUp(); }, kLongWait_s));
  EXPECT_EQ(program.starts(), 1);
  EXPECT_EQ(program.command().waitFor(0.0), 139);
}

TEST_F(ForeignProgramTest, DeathUnderRoslaunchIsForgiven) {
  ForeignProgram program("rviz", this->program(roslaunchSays("-11", "/usr/lib/rviz/rviz")));
  EXPECT_TRUE(program.comesUp([this] { return isUp(); }, kLongWait_s));
  EXPECT_EQ(program.starts(), 2);
}

TEST_F(ForeignProgramTest, DeathOfAnotherProgramUnderRoslaunchIsAFailure) {
  ForeignProgram program("rviz", this->program(roslaunchSays("-11", "/somewhere/visual_odometry")));
  EXPECT_FALSE(program.comesUp([this] { return isUp(); }, kLongWait_s));
  EXPECT_EQ(program.starts(), 1);
}

TEST_F(ForeignProgramTest, AnEndOfItsOwnUnderRoslaunchIsAFailure) {
  ForeignProgram program("rviz", this->program(roslaunchSays("1", "/usr/lib/rviz/rviz")));
  EXPECT_FALSE(program.comesUp([this] { return isUp(); }, kLongWait_s));
  EXPECT_EQ(program.starts(), 1);
}

TEST_F(ForeignProgramTest, WhatIsUpIsNotStartedAgain) {
  ForeignProgram program("fake", "exec sleep 100");
  EXPECT_TRUE(program.comesUp([] { return true; }, kLongWait_s));
  kill(program.command().pid(), SIGSEGV);
  EXPECT_EQ(program.command().waitFor(kLongWait_s), 128);
  EXPECT_TRUE(program.command().endedBySignal());
  EXPECT_EQ(program.starts(), 1);
}

}  // namespace
}  // namespace stereo_nav::test
