#include "support/virtual_screen.h"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "support/command.h"
#include "support/wait.h"

namespace stereo_nav::test {
namespace {

constexpr const char* kServer = "/usr/bin/Xvfb";
constexpr const char* kHand = "/usr/bin/xdotool";

/// A number of the header of an X window dump, which is big endian.
std::size_t headerField(const std::vector<char>& dump, std::size_t index) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(dump.at(4 * index + i));
  return value;
}

/// The number of an earlier server would lead to somebody else's screen.
std::string withoutOldNumber(const std::string& folder) {
  std::filesystem::remove(folder + "/display");
  return folder;
}

}  // namespace

bool VirtualScreen::available() {
  return std::filesystem::exists(kServer) && std::filesystem::exists(kHand);
}

VirtualScreen::VirtualScreen(const std::string& folder)
    : folder_(withoutOldNumber(folder)),
      server_({"/bin/bash", "-c",
               std::string("exec ") + kServer +
                   " -displayfd 1 -screen 0 1280x1024x24 -nolisten tcp -fbdir '" + folder + "' >'" + folder +
                   "/display' 2>'" + folder + "/xvfb.log'"}) {
  std::string number;
  const auto hasNumber = [&] {
    std::ifstream file(folder + "/display");
    return std::getline(file, number) && !number.empty() && !file.eof();
  };
  if (!waitUntil(hasNumber)) throw std::runtime_error("Xvfb did not start; see " + folder + "/xvfb.log");
  setenv("DISPLAY", (":" + number).c_str(), 1);
}

cv::Mat VirtualScreen::pixels() const {
  std::ifstream file(folder_ + "/Xvfb_screen0", std::ios::binary);
  const std::vector<char> dump{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  // XWDFile.h: header size, version, format, depth, width, height, ..., bytes of a line (12), ..., colours
  // (19).
  const std::size_t width = headerField(dump, 4), height = headerField(dump, 5), line = headerField(dump, 12);
  const std::size_t start = headerField(dump, 0) + 12 * headerField(dump, 19);
  if (headerField(dump, 11) != 32 || dump.size() < start + line * height) {
    throw std::runtime_error("the screen's frame buffer is not as expected");
  }
  cv::Mat image(static_cast<int>(height), static_cast<int>(width), CV_8UC4);
  for (std::size_t row = 0; row < height; ++row) {
    std::memcpy(image.ptr(static_cast<int>(row)), dump.data() + start + row * line, 4 * width);
  }
  return image;
}

void VirtualScreen::click(int x, int y) const {
  runCommand(std::string(kHand) + " mousemove " + std::to_string(x) + " " + std::to_string(y) + " click 1");
}

}  // namespace stereo_nav::test
