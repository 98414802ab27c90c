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

/// The missing folder nearest to the root on the way to this one; empty where none is missing.
std::filesystem::path firstMissing(std::filesystem::path folder) {
  std::filesystem::path missing;
  for (; !folder.empty() && !std::filesystem::exists(folder); folder = folder.parent_path()) missing = folder;
  return missing;
}

/// Folders from `folder` up to `top`, as far as they are empty.
void removeEmpty(std::filesystem::path folder, const std::filesystem::path& top) {
  std::error_code in_use;
  for (; std::filesystem::remove(folder, in_use) && folder != top; folder = folder.parent_path()) {
  }
}

}  // namespace

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path)), temporary_path_(path_ + ".partial-" + std::to_string(::getpid())) {
  if (std::filesystem::is_directory(path_)) cannotWrite(path_, "it is a folder");
  const auto folder = std::filesystem::path(path_).parent_path();
  created_folder_ = firstMissing(folder).string();
  std::error_code error;
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) cannotWrite(path_, error.message());
  if (!std::ofstream(temporary_path_)) cannotWrite(path_, std::strerror(errno));
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  std::remove(temporary_path_.c_str());
  if (!created_folder_.empty()) removeEmpty(std::filesystem::path(path_).parent_path(), created_folder_);
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
