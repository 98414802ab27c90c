#pragma once

#include <ros/message_traits.h>
#include <rosbag/bag.h>

#include <functional>
#include <memory>
#include <string>

#include "core/atomic_file.h"

namespace stereo_nav::ros_io {

/// A bag that appears under its name only when it is complete. Throws an InputError that names the file when
/// it cannot be written; no partial file is left behind.
class BagFile {
 public:
  explicit BagFile(const std::string& path);
  ~BagFile();
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  void setCompression(rosbag::CompressionType compression) { bag_->setCompression(compression); }

  template <class Message>
  void write(const std::string& topic, const ros::Time& time, const Message& message) {
    guarded([&] { bag_->write(topic, time, message); });
  }

  /// Writes a message as if recorded from a latching publisher: rosbag play gives it to later subscribers,
  /// too.
  template <class Message>
  void writeLatched(const std::string& topic, const ros::Time& time, const Message& message) {
    const auto connection = boost::make_shared<ros::M_string>();
    (*connection)["latching"] = "1";
    (*connection)["topic"] = topic;
    (*connection)["type"] = ros::message_traits::datatype(message);
    (*connection)["md5sum"] = ros::message_traits::md5sum(message);
    (*connection)["message_definition"] = ros::message_traits::definition(message);
    guarded([&] { bag_->write(topic, time, message, connection); });
  }

  void commit();

 private:
  /// Gives rosbag's errors the file's name and a remedy.
  void guarded(const std::function<void()>& action);

  std::string path_;
  AtomicFile file_;
  std::unique_ptr<rosbag::Bag> bag_;
  bool failed_ = false;
};

}  // namespace stereo_nav::ros_io
