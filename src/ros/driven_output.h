#pragma once

#include <tf2_eigen/tf2_eigen.h>

#include <string>
#include <vector>

#include "ros/driven_messages.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::ros_io {

/// Hands the messages of a driven robot's sensors to `Out`, which has `write(topic, time, message)` for each
/// type; `time` is when the message would be published. What becomes of stereo pairs is left to who derives
/// from it.
template <class Out>
class DrivenOutput : public sim::DrivenSink {
 public:
  /// Both must outlive this object.
  DrivenOutput(const DrivenMessages& messages, Out& out) : messages_(messages), out_(out) {}

  void takeTicks(const sim::SimulatedTicks& ticks, const sim::BaseState& truth) override {
    write(topics::kWheelTicks, messages_.wheelTicks(ticks));
    write(topics::kJointStates, messages_.jointState(ticks));
    write(topics::kGroundTruth, messages_.groundTruth(truth, ticks.time_s));
  }
  void takeImu(const ImuSample& sample) override {
    write(topics::kImu, messages_.imu(sample));
    if (sample.q_world_imu)
      out_.write(topics::kImuQuaternion, messages_.stamp(sample.time_s), tf2::toMsg(*sample.q_world_imu));
  }
  void takeScan(const laser::Scan& scan) override {
    out_.write(topics::kScan, messages_.stamp(scan.time_s + scan.scan_time_s), messages_.scan(scan));
  }
  void takeRange(std::size_t finder, double time_s, double range_m) override {
    write(messages_.rangeTopic(finder), messages_.range(finder, time_s, range_m));
  }
  void takeContacts(double time_s, const std::vector<std::string>& names) override {
    write(kContactsTopic, messages_.contacts(time_s, names));
  }

 protected:
  void writePair(const PairMessages& pair) {
    ros_io::writePair(pair, messages_.stamp(pair.available_s), out_);
  }
  const DrivenMessages& messages() const { return messages_; }

 private:
  template <class Message>
  void write(const std::string& topic, const Message& message) {
    out_.write(topic, message.header.stamp, message);
  }

  const DrivenMessages& messages_;
  Out& out_;
};

}  // namespace stereo_nav::ros_io
