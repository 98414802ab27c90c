#include "sensors/camera/offered_formats.h"

#include <linux/videodev2.h>

namespace stereo_nav::camera {
namespace {

double rateOf(const v4l2_fract& interval) {
  return interval.numerator == 0 ? 0.0 : static_cast<double>(interval.denominator) / interval.numerator;
}

std::vector<double> offeredRates(const V4l2Descriptor& device, std::uint32_t fourcc, int width, int height) {
  std::vector<double> rates;
  v4l2_frmivalenum interval{};
  interval.pixel_format = fourcc;
  interval.width = static_cast<std::uint32_t>(width);
  interval.height = static_cast<std::uint32_t>(height);
  for (; device.call(VIDIOC_ENUM_FRAMEINTERVALS, &interval) == 0; ++interval.index) {
    if (interval.type == V4L2_FRMIVAL_TYPE_DISCRETE) {
      rates.push_back(rateOf(interval.discrete));
    } else {
      rates.push_back(rateOf(interval.stepwise.max));
      rates.push_back(rateOf(interval.stepwise.min));
      break;
    }
  }
  return rates;
}

}  // namespace

std::vector<OfferedFormat> offeredFormats(const V4l2Descriptor& device) {
  std::vector<OfferedFormat> formats;
  v4l2_fmtdesc description{};
  description.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  for (; device.call(VIDIOC_ENUM_FMT, &description) == 0; ++description.index) {
    OfferedFormat format;
    format.fourcc = description.pixelformat;
    format.description = reinterpret_cast<const char*>(description.description);
    v4l2_frmsizeenum size{};
    size.pixel_format = description.pixelformat;
    for (; device.call(VIDIOC_ENUM_FRAMESIZES, &size) == 0; ++size.index) {
      const bool discrete = size.type == V4L2_FRMSIZE_TYPE_DISCRETE;
      format.width = static_cast<int>(discrete ? size.discrete.width : size.stepwise.max_width);
      format.height = static_cast<int>(discrete ? size.discrete.height : size.stepwise.max_height);
      format.rates_hz = offeredRates(device, format.fourcc, format.width, format.height);
      formats.push_back(format);
      if (!discrete) break;
    }
  }
  return formats;
}

}  // namespace stereo_nav::camera
