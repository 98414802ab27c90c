// A recording read without a master. usage: use_ros BAG
#include <stereo_nav/ros/recording.h>
#include <stereo_nav/ros/topics.h>

#include "expect.h"

int main(int argc, char** argv) {
  namespace ros_io = stereo_nav::ros_io;
  expect(argc == 2, "there is one argument");
  const ros_io::Recording recording(argv[1], {});
  expect(recording.pairs() > 0, "the recording has pairs");
  ros_io::toCalibration(recording.leftInfo(), recording.rightInfo()).validate();
  expect(!recording.groundTruth(ros_io::topics::kGroundTruth, true).trajectory.empty(),
         "it has a ground truth");
  std::size_t pairs = 0;
  recording.forEachPair([&pairs](const ros_io::RawPair& pair) { pairs += pair.left.empty() ? 0 : 1; });
  expect(pairs == recording.pairs(), "every pair is read");
}
