#pragma once

#include <string>

namespace stereo_nav::serial {

/// Remembers under which persistent name (/dev/serial/by-id/...) a port was reached, so that an adapter that
/// comes back as ttyUSB1 instead of ttyUSB0 is found again.
class PortFinder {
 public:
  explicit PortFinder(std::string port, std::string by_id_directory = "/dev/serial/by-id")
      : port_(std::move(port)), by_id_directory_(std::move(by_id_directory)) {}

  /// The path to open now: the persistent name if it is known and present, otherwise the port as given.
  std::string locate() const;
  /// To be called after the path that `locate()` returned was opened.
  void remember();

 private:
  std::string port_;
  std::string by_id_directory_;
  std::string persistent_name_;
};

}  // namespace stereo_nav::serial
