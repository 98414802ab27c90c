// An odometry of one's own behind the package's interface.
#include <stereo_nav/odometry/common/odometry.h>

#include "expect.h"

namespace {

using stereo_nav::odometry::FrameResult;

/// Drives 0.1 m ahead with every frame, whatever the images show.
class Metronome : public stereo_nav::odometry::Odometry {
 public:
  void addImu(const stereo_nav::ImuSample&) override {}
  FrameResult process(const stereo_nav::odometry::StereoFrame&) override {
    FrameResult result;
    result.state = stereo_nav::odometry::State::kTracking;
    result.T_start_camera.translation().z() = 0.1 * frames_++;
    return result;
  }
  void reset() override { frames_ = 0; }

 private:
  int frames_ = 0;
};

}  // namespace

int main() {
  Metronome metronome;
  stereo_nav::odometry::Odometry& odometry = metronome;
  odometry.process({});
  expect(odometry.process({}).T_start_camera.translation().z() == 0.1, "the second frame is 0.1 m ahead");
  odometry.reset();
  expect(odometry.process({}).T_start_camera.translation().norm() == 0.0, "a reset starts anew");
}
