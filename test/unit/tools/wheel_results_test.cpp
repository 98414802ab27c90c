// The real robot of OptiOdom: one calibration from the odd-numbered runs, judged on the even ones.
#include <cstdlib>
#include <filesystem>
#include <map>

#include "calibration/wheel_calibration.h"
#include "core/planar_motion.h"
#include "import_test_support.h"
#include "tools/import_sequence/wheel_sequence.h"

namespace stereo_nav::tools {
namespace {

/// Runs of one parity, by set.
std::map<std::string, std::vector<WheelSequence>> optiodomRuns(const std::string& folder, int parity) {
  std::map<std::string, std::vector<WheelSequence>> runs;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const std::string name = file.path().stem().string();
    const auto end = name.find("_run-");
    if (end == std::string::npos || std::stoi(name.substr(end + 5)) % 2 != parity) continue;
    runs[name.substr(0, end)].push_back(readOptiodom(file.path().string()));
  }
  return runs;
}

odometry::WheelSample sampleOf(const WheelReading& reading) {
  return {reading.time_s, reading.pulses, {}, {}};
}

/// Error at the end in % of the path.
double endErrorPercent(const WheelSequence& run, const odometry::WheelOdometryParams& params) {
  odometry::WheelOdometry odometry(params);
  odometry::WheelOdometryResult result;
  for (const auto& reading : run.readings) result = odometry.process(sampleOf(reading));
  const Eigen::Isometry2d truth = planarPart(run.ground_truth.front().T_world_body).inverse() *
                                  planarPart(run.ground_truth.back().T_world_body);
  return 100.0 * (result.T_odom_base.translation() - truth.translation()).norm() /
         pathLength(run.ground_truth);
}

double meanEndError(const std::vector<WheelSequence>& runs, const odometry::WheelOdometryParams& params) {
  double sum = 0.0;
  for (const auto& run : runs) sum += endErrorPercent(run, params);
  return sum / static_cast<double>(runs.size());
}

TEST(WheelRecordings, oddRunsCalibrateEvenOnes) {
  const char* data = std::getenv("STEREO_NAV_DATA");
  if (!data) GTEST_SKIP() << "STEREO_NAV_DATA does not name the folder of the recordings";
  const std::string folder = std::string(data) + "/optiodom";
  std::vector<calibration::WheelRun> runs;
  odometry::WheelOdometryParams nominal;
  for (const auto& [set, sequences] : optiodomRuns(folder, 1)) {
    for (const auto& sequence : sequences) {
      nominal.drive = sequence.drive;
      runs.push_back({{}, sequence.ground_truth});
      for (const auto& reading : sequence.readings) runs.back().samples.push_back(sampleOf(reading));
    }
  }
  ASSERT_EQ(runs.size(), 12u);
  const auto found = calibration::calibrateWheels(nominal, runs);
  ASSERT_TRUE(found.usable()) << found.refusal;
  auto even = optiodomRuns(folder, 0);
  EXPECT_LT(meanEndError(even["221220201953"], found.params), 1.6) << "squares";
  EXPECT_LT(meanEndError(even["221220202228"], found.params), 0.6) << "joystick";
  for (const auto& [set, sequences] : even)
    EXPECT_LT(meanEndError(sequences, found.params), meanEndError(sequences, nominal)) << set;
}

}  // namespace
}  // namespace stereo_nav::tools
