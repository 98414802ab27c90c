#include "tools/simulate/driven_bag.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "ros/bag_file.h"
#include "ros/driven_output.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::tools {
namespace {

/// Writes each message at once, so that the order does not depend on the number of threads.
class BagSink : public ros_io::DrivenOutput<ros_io::BagFile> {
 public:
  BagSink(const ros_io::DrivenMessages& messages, ros_io::BagFile& bag, const SimulatedBagOptions& options)
      : DrivenOutput(messages, bag), options_(options) {}

  void takeShot(sim::StereoShot shot) override {
    if (options_.images) writePair(messages().pair(shot, options_.threads > 1));
  }

 private:
  SimulatedBagOptions options_;
};

}  // namespace

std::vector<TimedVelocity> readVelocities(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError(path + " cannot be read; does it exist?");
  std::vector<TimedVelocity> velocities;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    TimedVelocity velocity;
    if (!(words >> std::ws) || words.eof()) continue;
    std::string rest;
    words >> velocity.time_s >> velocity.twist.x() >> velocity.twist.y() >> velocity.twist.z();
    if (words.fail() || words >> rest || !velocity.twist.allFinite() || !(velocity.time_s >= 0.0)) {
      throw InputError(fmt::format(
          "{}, line {}: '{}' is no command; a line holds time (s), velocity forward, to the left (m/s) and turning "
          "(rad/s), e.g. 0.5 0.3 0 0.1",
          path, number, line));
    }
    if (!velocities.empty() && velocity.time_s < velocities.back().time_s) {
      throw InputError(
          fmt::format("{}, line {}: the time {} s is before that of the line above; sort the lines", path,
                      number, velocity.time_s));
    }
    velocities.push_back(velocity);
  }
  if (velocities.empty()) throw InputError(path + " holds no commands");
  return velocities;
}

void writeDrivenBag(const std::string& path, sim::DrivenSimulation& simulation,
                    const ros_io::DrivenDevices& devices, const Eigen::Isometry3d& T_base_imu,
                    const std::vector<TimedVelocity>& commands, const SimulatedBagOptions& options) {
  ros_io::BagFile bag(path);
  bag.setCompression(options.compress ? rosbag::compression::BZ2 : rosbag::compression::Uncompressed);
  const ros_io::DrivenMessages messages(simulation, devices, T_base_imu, kBagStart);
  bag.writeLatched(ros_io::topics::kTfStatic, kBagStart, messages.staticTransforms());
  BagSink sink(messages, bag, options);
  const double end_s = std::isfinite(options.duration_s) ? options.duration_s : commands.back().time_s;
  for (const TimedVelocity& command : commands) {
    if (command.time_s > end_s) break;
    simulation.advance(command.time_s, sink);
    simulation.command(command.twist);
  }
  simulation.advance(end_s, sink);
  bag.commit();
}

}  // namespace stereo_nav::tools
