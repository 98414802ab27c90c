// Does the odometry's memory grow? Feeds it 10^5 frames, or as many as asked for, and prints what the process
// holds:
//   build/devel/lib/stereo_nav/vo_endurance_test [FRAMES]
// The camera pans over a wall and back, is covered for 6 frames in every 500, and is reset in every 20000.
// Ends with 1 when the process holds more at the end than after the first 1000 frames.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "odometry/stereo/stereo_odometry.h"
#include "panned_wall.h"

namespace {

using namespace stereo_nav;

/// Resident memory of this process, kB.
long residentMemory_kB() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    if (word != "VmRSS:") continue;
    long kilobytes = 0;
    status >> kilobytes;
    return kilobytes;
  }
  return -1;
}

}  // namespace

int main(int argc, char** argv) {
  constexpr long kSettled = 1000;  // frames after which every buffer has been filled
  const long frames = std::max(2 * kSettled, argc > 1 ? std::atol(argv[1]) : 100000);
  cv::setNumThreads(1);
  const vision::StereoCalibration calibration = bench::wallCamera({320, 240});
  odometry::StereoOdometry odometry(odometry::StereoParams(), calibration, Eigen::Matrix3d::Identity());
  bench::PannedWall wall(calibration);
  long tracked = 0;
  long settled_kB = 0;
  std::printf("| frames | resident kB | tracked |\n|---|---|---|\n");
  for (long i = 1; i <= frames; ++i) {
    odometry::StereoFrame frame = wall.next();
    if (i % 500 < 6) {
      frame.left.setTo(0);
      frame.right.setTo(0);
    }
    if (i % 20000 == 0) odometry.reset();
    if (odometry.process(frame).state == odometry::State::kTracking) ++tracked;
    if (i == kSettled) settled_kB = residentMemory_kB();
    if (i % (frames / 10) == 0 || i == kSettled) {
      std::printf("| %ld | %ld | %ld |\n", i, residentMemory_kB(), tracked);
      std::fflush(stdout);
    }
  }
  constexpr long kPages_kB = 128;  // what the allocator may round up
  const long growth_kB = residentMemory_kB() - settled_kB;
  if (growth_kB <= kPages_kB) return 0;
  std::printf("memory has grown by %ld kB in %ld frames\n", growth_kB, frames - kSettled);
  return 1;
}
