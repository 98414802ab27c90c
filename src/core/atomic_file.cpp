#include "core/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/trajectory.h"

namespace stereo_nav {
namespace {

[[noreturn]] void cannotWrite(const std::string& path, const std::string& why) {
  throw InputError(path + ": cannot be written: " + why + "; choose another output or free the place");
}

}  // namespace

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path)), temporary_path_(path_ + ".partial-" + std::to_string(::getpid())) {
  if (std::filesystem::is_directory(path_)) cannotWrite(path_, "it is a folder");
  const auto folder = std::filesystem::path(path_).parent_path();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) cannotWrite(path_, error.message());
  if (!std::ofstream(temporary_path_)) cannotWrite(path_, std::strerror(errno));
}

AtomicFile::~AtomicFile() {
  if (!committed_) std::remove(temporary_path_.c_str());
}

void AtomicFile::commit() {
  if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0) cannotWrite(path_, std::strerror(errno));
  committed_ = true;
}

void writeFileAtomically(const std::string& path, const std::string& content) {
  AtomicFile file(path);
  std::ofstream stream(file.temporaryPath(), std::ios::binary);
  stream << content;
  stream.close();
  if (!stream) cannotWrite(path, std::strerror(errno));
  file.commit();
}

}  // namespace stereo_nav
