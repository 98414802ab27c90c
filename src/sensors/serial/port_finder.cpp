#include "sensors/serial/port_finder.h"

#include <filesystem>
#include <system_error>

namespace stereo_nav::serial {

namespace fs = std::filesystem;

std::string PortFinder::locate() const {
  std::error_code error;
  return !persistent_name_.empty() && fs::exists(persistent_name_, error) ? persistent_name_ : port_;
}

void PortFinder::remember() {
  if (!persistent_name_.empty()) return;
  std::error_code error;
  const fs::path device = fs::canonical(port_, error);
  if (error) return;
  for (fs::directory_iterator entry(by_id_directory_, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code broken_link;
    if (fs::canonical(entry->path(), broken_link) == device && !broken_link) {
      persistent_name_ = entry->path().string();
      return;
    }
  }
}

}  // namespace stereo_nav::serial
