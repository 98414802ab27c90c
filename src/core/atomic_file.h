#pragma once

#include <string>

namespace stereo_nav {

/// A file that appears under its name only when it is complete. Its contents go to `temporaryPath()` in the
/// same folder; commit() renames it; without commit() the destructor removes it.
class AtomicFile {
 public:
  /// Creates the temporary file, and the folder if need be. Throws InputError when either cannot be
  /// written.
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& temporaryPath() const { return temporary_path_; }
  void commit();

 private:
  std::string path_;
  std::string temporary_path_;
  bool committed_ = false;
};

/// Replaces the file by one with this content, or leaves it untouched. Throws InputError.
void writeFileAtomically(const std::string& path, const std::string& content);

}  // namespace stereo_nav
