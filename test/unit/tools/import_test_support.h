#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "support/trajectories.h"

namespace stereo_nav::tools {

constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr long long kEurocStart_ns = 1403636584000000000;
constexpr long long kEurocPeriod_ns = 50000000;

/// Frame i is one grey all over, so that a test knows it again.
inline cv::Mat frameOf(int i, int width = kWidth) {
  return cv::Mat(kHeight, width, CV_8UC1, cv::Scalar(10 + 20 * i));
}
inline int indexOf(const std::vector<std::uint8_t>& pixels) {
  return (pixels.front() - 10) / 20;
}

inline void writeImage(const TemporaryFolder& folder, const std::string& name, const cv::Mat& image) {
  folder.write(name, "");
  cv::imwrite(folder / name, image);
}

/// Camera `x_m` to the right of the left one, looking along z of the body, 2 m ahead of it.
inline std::string eurocCamera(double x_m) {
  return "T_BS:\n  data: [1, 0, 0, " + std::to_string(x_m) +
         ", 0, 1, 0, 0, 0, 0, 1, 2, 0, 0, 0, 1]\n"
         "resolution: [64, 48]\ncamera_model: pinhole\nintrinsics: [50, 50, 31.5, 23.5]\n"
         "distortion_model: radial-tangential\ndistortion_coefficients: [0, 0, 0, 0]\n";
}

/// Six pairs at 20 Hz, five IMU samples, three poses of ground truth along the body's z.
inline void writeEuroc(const TemporaryFolder& folder) {
  std::string list = "#timestamp [ns],filename\n";
  for (int i = 0; i < 6; ++i) {
    const std::string stamp = std::to_string(kEurocStart_ns + i * kEurocPeriod_ns);
    list += stamp + "," + stamp + ".png\r\n";
    for (const char* camera : {"cam0", "cam1"}) {
      writeImage(folder, std::string(camera) + "/data/" + stamp + ".png", frameOf(i));
    }
  }
  folder.write("cam0/data.csv", list);
  folder.write("cam1/data.csv", list);
  folder.write("cam0/sensor.yaml", eurocCamera(0.0));
  folder.write("cam1/sensor.yaml", eurocCamera(0.1));
  folder.write("imu0/sensor.yaml",
               "T_BS:\n  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\nrate_hz: 100\n"
               "gyroscope_noise_density: 0.01\n");
  std::string imu;
  std::string truth;
  for (int i = 0; i < 5; ++i) imu += std::to_string(kEurocStart_ns + i * 10000000) + ",0.1,0.2,0.3,1,2,9.8\n";
  for (int i = 0; i < 3; ++i) {
    truth += std::to_string(kEurocStart_ns + i * 100000000) + ",5,6," + std::to_string(i) + ",1,0,0,0\n";
  }
  folder.write("imu0/data.csv", imu);
  folder.write("state_groundtruth_estimate0/data.csv", truth);
}

/// Four pairs of a camera that moves 1 m forward a frame.
inline void writeKitti(const TemporaryFolder& folder) {
  for (int i = 0; i < 4; ++i) {
    for (const char* camera : {"image_0/00000", "image_1/00000"}) {
      writeImage(folder, camera + std::to_string(i) + ".png", frameOf(i));
    }
  }
  folder.write("calib.txt", "P0: 50 0 31.5 0 0 50 23.5 0 0 0 1 0\nP1: 50 0 31.5 -25 0 50 23.5 0 0 0 1 0\n");
  folder.write("times.txt", "0\n0.1\n0.2\n0.3\n");
  folder.write("poses.txt",
               "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n"
               "1 0 0 0 0 1 0 0 0 0 1 2\n1 0 0 0 0 1 0 0 0 0 1 3\n");
}

constexpr const char* kImagesCalibration = "# rectified\nfx 50\nfy 51\ncx 31.5\ncy 23.5\nbaseline 0.09\n";

/// All messages of a topic, in order of time.
template <class Message>
std::vector<Message> readTopic(const std::string& path, const std::string& topic) {
  rosbag::Bag bag(path, rosbag::bagmode::Read);
  std::vector<Message> messages;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    messages.push_back(*instance.instantiate<Message>());
  }
  return messages;
}

}  // namespace stereo_nav::tools
