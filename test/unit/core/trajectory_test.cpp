#include "stereo_nav/core/trajectory.h"

#include "stereo_nav/core/input_error.h"
#include "support/trajectories.h"

namespace stereo_nav {
namespace {

TEST(Tum, readsTabsCarriageReturnsAndComments) {
  const TemporaryFolder folder;
  const auto path = folder.write("t.tum",
                                 "# t tx ty tz qx qy qz qw\r\n\r\n"
                                 "1.5\t1 2 3\t0 0 0 1\r\n"
                                 "  2.5 4  5 6 0 0 0.7071068 0.7071068   # a quarter turn\n");
  const auto trajectory = readTum(path);
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[0].time_s, 1.5);
  EXPECT_TRUE(trajectory[0].T_world_body.isApprox(pose(1, 2, 3)));
  EXPECT_EQ(trajectory[1].time_s, 2.5);
  EXPECT_TRUE(trajectory[1].T_world_body.isApprox(pose(4, 5, 6, 90.0), 1e-6));
}

TEST(Tum, namesTheLineThatIsWrong) {
  const TemporaryFolder folder;
  const auto messageFor = [&folder](const std::string& content) {
    const auto path = folder.write("bad.tum", content);
    return messageOf<InputError>([&path] { readTum(path); });
  };
  const std::string good = "1 0 0 0 0 0 0 1\n";
  EXPECT_NE(messageFor(good + "2 0 0 0 0 0 1\n").find("bad.tum:2: 7 columns instead of 8"),
            std::string::npos);
  EXPECT_NE(messageFor(good + "2 x 0 0 0 0 0 1\n").find("bad.tum:2: 'x' is not a finite number"),
            std::string::npos);
  EXPECT_NE(messageFor(good + "2 nan 0 0 0 0 0 1\n").find("not a finite number"), std::string::npos);
  EXPECT_NE(messageFor(good + good).find("bad.tum:2: the stamp 1 is not later"), std::string::npos);
  EXPECT_NE(messageFor("1 0 0 0 0 0 0 2\n").find("quaternion has norm 2"), std::string::npos);
  EXPECT_NE(messageFor("# nothing\n").find("holds no line of data"), std::string::npos);
  EXPECT_NE(messageOf<InputError>([&] { readTum(folder / "absent"); }).find("No such file"),
            std::string::npos);
  EXPECT_NE(messageOf<InputError>([&] { readTum(folder.path()); }).find("folder"), std::string::npos);
}

TEST(Tum, writesWhatItReads) {
  const TemporaryFolder folder;
  const Trajectory trajectory = {{1403636584.763555584, pose(4.688319, -1.786938, 0.783338, 35.0)},
                                 {1403636584.813555456, pose(-1e-6, 0.0, 12345.678901234, -170.0)}};
  const auto read = readTum(folder.write("t.tum", toTum(trajectory)));
  ASSERT_EQ(read.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(read[i].time_s, trajectory[i].time_s, 1e-6);
    EXPECT_TRUE(read[i].T_world_body.isApprox(trajectory[i].T_world_body, 1e-8));
  }
}

TEST(Tum, writesOneSignOfTheQuaternion) {
  const std::string text = toTum({{0.5, pose(1.0, 2.0, 3.0, 180.0 + 90.0)}});
  EXPECT_NE(text.find("0.500000000 1.000000000 2.000000000 3.000000000 0.000000000 0.000000000 -0.707106781 "
                      "0.707106781\n"),
            std::string::npos)
      << text;
}

TEST(Kitti, readsAndWritesMatrices) {
  const TemporaryFolder folder;
  const auto poses = folder.write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\r\n0 -1 0 7 1 0 0 8 0 0 1 9\n");
  const auto times = folder.write("times.txt", "0.000000e+00\n1.037360e-01\n");
  const auto trajectory = readKitti(poses, readKittiTimes(times));
  ASSERT_EQ(trajectory.size(), 2u);
  EXPECT_EQ(trajectory[1].time_s, 0.103736);
  EXPECT_TRUE(trajectory[1].T_world_body.isApprox(pose(7, 8, 9, 90.0)));
  const auto again = readKitti(folder.write("again.txt", toKitti(trajectory)), readKittiTimes(times));
  EXPECT_TRUE(again[1].T_world_body.isApprox(trajectory[1].T_world_body));
}

TEST(Kitti, refusesWhatIsNoTrajectory) {
  const TemporaryFolder folder;
  const auto stretched = folder.write("stretched.txt", "2 0 0 0 0 1 0 0 0 0 1 0\n");
  const auto mirrored = folder.write("mirrored.txt", "-1 0 0 0 0 1 0 0 0 0 1 0\n");
  const auto good = folder.write("good.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  const auto messageFor = [](const std::string& path, const std::vector<double>& times_s) {
    return messageOf<InputError>([&] { readKitti(path, times_s); });
  };
  EXPECT_NE(messageFor(stretched, {0.0}).find("stretched.txt:1: the left 3x3 part is not a rotation"),
            std::string::npos);
  EXPECT_NE(messageFor(mirrored, {0.0}).find("not a rotation"), std::string::npos);
  EXPECT_NE(messageFor(good, {0.0, 0.1}).find("1 poses for 2 stamps"), std::string::npos);
}

TEST(Trajectory, lengthAndOtherBody) {
  const Trajectory trajectory = {{0.0, pose(0, 0, 0)}, {1.0, pose(3, 4, 0, 90.0)}, {2.0, pose(3, 4, 12)}};
  EXPECT_DOUBLE_EQ(pathLength(trajectory), 5.0 + 12.0);
  EXPECT_DOUBLE_EQ(pathLength(Trajectory{}), 0.0);
  // One metre ahead of a body that looks along y is one metre further along y.
  const auto ahead = ofOtherBody(trajectory, pose(1, 0, 0));
  EXPECT_TRUE(ahead[1].T_world_body.translation().isApprox(Eigen::Vector3d(3, 5, 0)));
}

}  // namespace
}  // namespace stereo_nav
