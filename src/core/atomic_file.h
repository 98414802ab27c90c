#pragma once

#include <string>

namespace stereo_nav {

/// A file that appears under its name only when it is complete. Its content is written to `temporaryPath()`
/// in the same folder, and commit() renames that file. Without commit() the destructor removes it,
/// and the folders that were made for it.
class AtomicFile {
 public:
  /// Creates the temporary file, and its folder where that does not exist. Throws InputError when either
  /// cannot be created.
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& temporaryPath() const { return temporary_path_; }
  void commit();

 private:
  std::string path_;
  std::string temporary_path_;
  std::string created_folder_;  ///< the first of those that were made; empty if none
  bool committed_ = false;
};

/// Replaces the file by one with this content. On failure throws InputError and leaves the file untouched.
void writeFileAtomically(const std::string& path, const std::string& content);

}  // namespace stereo_nav
