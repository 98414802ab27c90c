#pragma once

#include <termios.h>

#include <vector>

namespace stereo_nav::nodes {

/// The keys that are pressed in a terminal, one by one and without echo; the terminal is restored at the end.
class TerminalKeys {
 public:
  /// Throws std::runtime_error where `fd` is no terminal.
  explicit TerminalKeys(int fd);
  ~TerminalKeys();
  TerminalKeys(const TerminalKeys&) = delete;
  TerminalKeys& operator=(const TerminalKeys&) = delete;

  /// Waits for keys for at most `timeout_s` and returns those that were pressed.
  std::vector<char> read(double timeout_s);
  /// Whether the terminal has been closed.
  bool closed() const { return closed_; }

 private:
  int fd_;
  termios before_{};
  bool closed_ = false;
};

}  // namespace stereo_nav::nodes
