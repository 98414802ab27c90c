#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stereo_nav::imu {

/// A pseudo-terminal that stands for a plugged-in serial adapter; unplugged by destruction.
class PseudoTerminal {
 public:
  PseudoTerminal();  ///< throws std::runtime_error
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  /// Path for the program under test, e.g. /dev/pts/3.
  const std::string& path() const { return path_; }
  /// Makes the port reachable under another name, too, until it is unplugged; replaces a link there and makes
  /// its folder. Throws std::filesystem::filesystem_error.
  void link(const std::string& link_path);
  /// Never blocks. Returns how many bytes were taken; the rest is lost, as in a full adapter.
  std::size_t write(const std::vector<std::uint8_t>& bytes);
  /// The baud rate that the program at the other end has set; nothing while none has.
  std::optional<int> baudRate() const;

 private:
  int fd_ = -1;
  std::string path_;
  std::vector<std::string> links_;
};

}  // namespace stereo_nav::imu
