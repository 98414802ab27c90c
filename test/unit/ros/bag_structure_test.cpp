// Damaged bags end in a refusal, never in rosbag's reading what is not its own.
#include "ros/bag_structure.h"

#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

namespace stereo_nav::ros_io {
namespace {

class BagStructureTest : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  /// Returns the bytes of a bag with several chunks.
  std::string record(rosbag::CompressionType compression = rosbag::compression::Uncompressed) {
    {
      rosbag::Bag bag(path_, rosbag::bagmode::Write);
      bag.setCompression(compression);
      bag.setChunkThreshold(600);
      std_msgs::String message;
      for (int i = 0; i < 20; ++i) {
        message.data = std::string(60, static_cast<char>('a' + i));
        bag.write(i % 3 == 0 ? "one" : "two", ros::Time(100.0 + i), message);
      }
    }
    std::ostringstream bytes;
    bytes << std::ifstream(path_, std::ios::binary).rdbuf();
    return bytes.str();
  }

  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

  /// Number of messages that can be read; an exception of rosbag or of a message passes.
  std::size_t readAll() const {
    rosbag::Bag bag;
    openBag(bag, path_);
    std::size_t messages = 0;
    for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
      if (message.instantiate<std_msgs::String>()) ++messages;
    }
    return messages;
  }

  std::string damage() const {
    try {
      checkBagStructure(path_);
    } catch (const rosbag::BagFormatException& error) {
      return error.what();
    }
    return "";
  }

  const std::string path_ =
      (std::filesystem::temp_directory_path() / ("bag_structure_" + std::to_string(getpid()) + ".bag"))
          .string();
};

TEST_F(BagStructureTest, WhatRosbagWritesIsWhole) {
  using rosbag::compression::BZ2, rosbag::compression::LZ4, rosbag::compression::Uncompressed;
  for (const auto compression : {Uncompressed, BZ2, LZ4}) {
    record(compression);
    EXPECT_EQ(damage(), "");
    EXPECT_EQ(readAll(), 20u);
  }
}

TEST_F(BagStructureTest, ALengthBeyondItsRecordIsNamed) {
  std::string bytes = record();
  const std::size_t place = bytes.find("topic=one");
  ASSERT_NE(place, std::string::npos);
  bytes[place - 2] = 1;  // 65536 bytes more
  write(bytes);
  EXPECT_NE(damage().find("damaged at byte "), std::string::npos);
  EXPECT_NE(damage().find("a field that is longer than its header"), std::string::npos) << damage();
}

TEST_F(BagStructureTest, ABagThatIsCutOffIsNamed) {
  const std::string bytes = record();
  write(bytes.substr(0, bytes.size() / 2));
  EXPECT_NE(damage(), "");
}

TEST_F(BagStructureTest, AnotherFormatIsRefused) {
  write("no bag at all");
  EXPECT_NE(damage().find("it does not begin as bags of version 2.0 do"), std::string::npos) << damage();
  // rosbag takes this first line for that of a bag, and reads beyond its memory in what follows.
  std::string bytes = record();
  bytes[bytes.find('\n')] = '=';
  write(bytes);
  EXPECT_NE(damage().find("it does not begin as bags of version 2.0 do"), std::string::npos) << damage();
}

TEST_F(BagStructureTest, NoOverwrittenNumberEndsTheProcess) {
  const std::string bytes = record();
  std::mt19937 random(7);
  int refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string damaged = bytes;
    const std::uint32_t values[] = {0, 1, 0xFFFFFFFF, 0x7FFFFFFF, 4096, static_cast<std::uint32_t>(random())};
    const std::uint32_t value = values[random() % 6];
    std::memcpy(&damaged[random() % (bytes.size() - 4)], &value, sizeof value);
    write(damaged);
    try {
      EXPECT_LE(readAll(), 20u);
    } catch (const std::exception&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace stereo_nav::ros_io
