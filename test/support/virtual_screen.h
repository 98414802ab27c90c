#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "support/node_process.h"

namespace stereo_nav::test {

/// An X server without a screen (Xvfb) on an unused display, whose image can be read and whose mouse can be
/// moved (xdotool).
class VirtualScreen {
 public:
  /// Whether both programs are installed.
  static bool available();

  /// `folder` is for the server's files. Sets DISPLAY for programs that are started later. Throws
  /// std::runtime_error when the server does not come up.
  explicit VirtualScreen(const std::string& folder);

  /// What is on the screen now, CV_8UC4 (blue, green, red, unused).
  cv::Mat pixels() const;

  void click(int x, int y) const;

 private:
  std::string folder_;
  NodeProcess server_;
};

}  // namespace stereo_nav::test
