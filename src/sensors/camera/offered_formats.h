#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sensors/camera/v4l2_descriptor.h"

namespace stereo_nav::camera {

/// One size of one format, with the rates it can have.
struct OfferedFormat {
  std::uint32_t fourcc = 0;
  std::string description;
  int width = 0;
  int height = 0;
  std::vector<double> rates_hz;
};

/// All that the driver offers. Where it offers a range of sizes or rates, its ends.
std::vector<OfferedFormat> offeredFormats(const V4l2Descriptor& device);

}  // namespace stereo_nav::camera
