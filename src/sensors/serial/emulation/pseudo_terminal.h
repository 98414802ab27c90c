#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stereo_nav::serial {

/// A pseudo-terminal that imitates a plugged-in serial adapter; its destruction unplugs it.
class PseudoTerminal {
 public:
  PseudoTerminal();  ///< throws std::runtime_error
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  /// Path for the program under test, e.g. /dev/pts/3.
  const std::string& path() const { return path_; }
  /// Makes the port reachable under another name, too, until it is unplugged. An existing link is replaced; a
  /// missing folder is made. Throws std::filesystem::filesystem_error.
  void link(const std::string& link_path);
  /// Never blocks. Returns how many bytes were accepted; the others are lost, as in a full adapter.
  std::size_t write(const std::vector<std::uint8_t>& bytes);
  /// What the program at the other end has written since the last call. Never blocks.
  std::vector<std::uint8_t> read();
  /// The baud rate that the program at the other end has set; absent while none has been set.
  std::optional<int> baudRate() const;

 private:
  int fd_ = -1;
  std::string path_;
  std::vector<std::string> links_;
};

}  // namespace stereo_nav::serial
