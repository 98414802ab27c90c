#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "sensors/camera/stereo_camera.h"
#include "support/wait.h"

namespace stereo_nav::camera {

/// A stereo camera under test, with all pairs and messages that it delivered.
class StereoRig {
 public:
  StereoRig(Kernel& kernel, DeviceFinder finder) : kernel_(kernel), finder_(std::move(finder)) {}
  ~StereoRig() {
    if (stereo_) stereo_->stop();
  }

  /// `receiver_delay`: how long the receiver is busy with each pair.
  void start(const StereoConfig& config, std::chrono::milliseconds receiver_delay = {}) {
    stereo_ = std::make_unique<StereoCamera>(
        config, kernel_, finder_,
        [this, receiver_delay](StereoImages images) {
          EXPECT_FALSE(receiving_.exchange(true)) << "one pair at a time";
          std::this_thread::sleep_for(receiver_delay);
          receiving_ = false;
          const std::lock_guard<std::mutex> lock(mutex_);
          if (!keep_images_) {
            images.pair.left.image = DecodedImage();
            images.pair.right.image = DecodedImage();
          }
          pairs_.push_back(std::move(images));
        },
        [this](Severity, const std::string& text) {
          const std::lock_guard<std::mutex> lock(mutex_);
          log_ += text + "\n";
        });
    stereo_->start();
  }

  /// Ends capturing and hands over the pairs.
  std::vector<StereoImages> stop() {
    stereo_->stop();
    return std::exchange(pairs_, {});
  }

  /// Whether pairs are kept with their images or with stamps only. To be called before start().
  void keepImages(bool keep) { keep_images_ = keep; }

  StereoCamera& camera() { return *stereo_; }
  CameraStatus left() const { return stereo_->status().left; }
  CameraStatus right() const { return stereo_->status().right; }

  std::size_t pairCount() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return pairs_.size();
  }

  std::string log() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return log_;
  }

  bool pairsCome(std::size_t count) {
    const std::size_t before = pairCount();
    return test::waitUntil([&] { return pairCount() >= before + count; });
  }

 private:
  Kernel& kernel_;
  DeviceFinder finder_;
  bool keep_images_ = true;
  std::atomic<bool> receiving_{false};
  std::mutex mutex_;
  std::vector<StereoImages> pairs_;
  std::string log_;
  std::unique_ptr<StereoCamera> stereo_;
};

/// What must hold for pairs, whatever the cameras do.
inline void expectOrdered(const std::vector<StereoImages>& pairs) {
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    EXPECT_GT(pairs[i].pair.left.time_ns, pairs[i - 1].pair.left.time_ns);
    EXPECT_GT(pairs[i].pair.right.time_ns, pairs[i - 1].pair.right.time_ns);
  }
}

}  // namespace stereo_nav::camera
