#include "sensors/camera/v4l2_descriptor.h"

namespace stereo_nav::camera {

V4l2Descriptor::V4l2Descriptor(Kernel& kernel, const std::string& path)
    : kernel_(kernel), path_(path), number_(kernel.open(path)) {
  if (number_ < 0) throw explainFailure(Step::kOpen, -number_, path_, "");
}

V4l2Descriptor::~V4l2Descriptor() {
  kernel_.close(number_);
}

int V4l2Descriptor::call(unsigned long request, void* argument) const {
  return kernel_.ioctl(number_, request, argument);
}

void V4l2Descriptor::callOrThrow(unsigned long request, void* argument, Step step,
                                 const std::string& details) const {
  const int result = call(request, argument);
  if (result < 0) throw explainFailure(step, -result, path_, details);
}

}  // namespace stereo_nav::camera
