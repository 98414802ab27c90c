// Lists the connected cameras for the user to choose from: list_cameras [--controls]
#include <cstring>
#include <iostream>

#include "tools/list_cameras/camera_listing.h"

int main(int argc, char** argv) {
  const bool with_controls = argc == 2 && std::strcmp(argv[1], "--controls") == 0;
  if (argc > 1 && !with_controls) {
    std::cerr
        << "usage: list_cameras [--controls]\n"
           "Lists the connected cameras with their stable names, formats and, if asked for, controls.\n";
    return std::strcmp(argv[1], "--help") == 0 ? 0 : 2;
  }
  auto& kernel = stereo_nav::camera::linuxKernel();
  stereo_nav::tools::listCameras(kernel, stereo_nav::camera::DeviceFinder(kernel), with_controls, std::cout);
  return 0;
}
