#include "tools/simulate/simulated_bag.h"

#include <algorithm>
#include <future>
#include <vector>

#include "ros/bag_file.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::tools {
namespace {

namespace topics = ros_io::topics;

/// Writes the messages between pairs in order of arrival.
class BagWriter {
 public:
  BagWriter(ros_io::BagFile& bag, const sim::Simulation& simulation,
            const ros_io::SimulatedMessages& messages)
      : bag_(bag), simulation_(simulation), messages_(messages) {
    bag_.writeLatched(topics::kTfStatic, kBagStart, messages_.staticTransforms());
  }

  void writeUntil(double time_s) {
    const auto& imu = simulation_.imu();
    for (; next_imu_ < imu.size() && imu[next_imu_].time_s <= time_s; ++next_imu_) {
      const ros::Time arrival = messages_.stamp(imu[next_imu_].time_s);
      bag_.write(topics::kImu, arrival, messages_.imu(next_imu_));
      if (messages_.hasAttitude())
        bag_.write(topics::kImuQuaternion, arrival, messages_.imuQuaternion(next_imu_));
    }
    const auto& wheels = simulation_.wheels();
    for (; next_ticks_ < wheels.size() && wheels[next_ticks_].time_s <= time_s; ++next_ticks_) {
      bag_.write(topics::kWheelTicks, messages_.stamp(wheels[next_ticks_].time_s),
                 messages_.wheelTicks(next_ticks_));
    }
    const auto& waypoints = simulation_.trajectory().waypoints();
    for (; next_waypoint_ < waypoints.size() && waypoints[next_waypoint_].time_s <= time_s;
         ++next_waypoint_) {
      bag_.write(topics::kWaypoint, messages_.stamp(waypoints[next_waypoint_].time_s),
                 messages_.waypoint(next_waypoint_));
    }
  }

  void write(const ros_io::PairMessages& pair) {
    writeUntil(pair.available_s);
    const ros::Time arrival = messages_.stamp(pair.available_s);
    ros_io::writePair(pair, arrival, bag_);
    bag_.write(topics::kGroundTruth, arrival, pair.ground_truth);
  }

  void writeTruth(double time_s) {
    writeUntil(time_s);
    bag_.write(topics::kGroundTruth, messages_.stamp(time_s), messages_.groundTruth(time_s));
  }

 private:
  ros_io::BagFile& bag_;
  const sim::Simulation& simulation_;
  const ros_io::SimulatedMessages& messages_;
  std::size_t next_imu_ = 0;
  std::size_t next_ticks_ = 0;
  std::size_t next_waypoint_ = 0;
};

}  // namespace

void writeSimulatedBag(const std::string& path, const sim::Simulation& simulation,
                       const SimulatedBagOptions& options,
                       const std::function<void(std::size_t, std::size_t)>& progress) {
  ros_io::BagFile bag(path);
  bag.setCompression(options.compress ? rosbag::compression::BZ2 : rosbag::compression::Uncompressed);
  const ros_io::SimulatedMessages messages(simulation, kBagStart);
  BagWriter writer(bag, simulation, messages);

  const auto& instants = simulation.pairs();
  const auto pairs = static_cast<std::size_t>(std::count_if(
      instants.begin(), instants.end(), [&](const auto& pair) { return pair.left_s <= options.duration_s; }));
  const auto threads = static_cast<std::size_t>(options.threads);
  for (std::size_t first = 0; first < pairs; first += threads) {
    const std::size_t batch = std::min(threads, pairs - first);
    if (options.images) {
      std::vector<std::future<ros_io::PairMessages>> rendered;
      for (std::size_t i = 0; i < batch; ++i) {
        rendered.push_back(
            std::async(std::launch::async, [&messages, first, i] { return messages.pair(first + i); }));
      }
      for (auto& pair : rendered) writer.write(pair.get());
    } else {
      for (std::size_t i = 0; i < batch; ++i) writer.writeTruth(instants[first + i].left_s);
    }
    progress(first + batch, pairs);
  }
  writer.writeUntil(std::min(simulation.duration_s(), options.duration_s));
  bag.commit();
}

}  // namespace stereo_nav::tools
