#include "sensors/camera/capture_error.h"

#include <dirent.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <vector>

namespace stereo_nav::camera {
namespace {

std::string actionText(Step step) {
  switch (step) {
    case Step::kFind:
      return "finding the camera";
    case Step::kOpen:
      return "opening the camera";
    case Step::kQuery:
      return "asking for its capabilities";
    case Step::kSetFormat:
      return "setting the image format";
    case Step::kSetRate:
      return "setting the frame rate";
    case Step::kGetBuffers:
      return "getting image buffers from the driver";
    case Step::kStreamOn:
      return "starting the stream";
    case Step::kWait:
      return "waiting for an image";
    case Step::kDequeue:
      return "taking an image from the driver";
    case Step::kQueue:
      return "giving a buffer back to the driver";
    case Step::kControl:
      return "setting a control";
  }
  return "using the camera";
}

std::string busyAdvice(const std::string& path) {
  const std::string users = processesUsing(path);
  if (users.empty()) {
    return "another program uses the camera (run `fuser -v " + path + "` as root to see which); close it";
  }
  return "it is in use by " + users + "; close that program";
}

std::string streamOnAdvice(int error_number, const std::string& path) {
  if (error_number == ENOSPC) {
    return "the USB bus has no bandwidth left, as with two uncompressed cameras on one controller; use the "
           "format mjpg, a lower rate or a smaller image, or plug one camera into a port of another "
           "controller (`rosrun stereo_nav list_cameras` shows which share one)";
  }
  if (error_number == EBUSY) return busyAdvice(path);
  return "the camera refused to start; plug it in again, or try another format or rate";
}

std::string adviceFor(Step step, int error_number, const std::string& path) {
  if (error_number == ENODEV || error_number == ENXIO) {
    return "the camera was unplugged or its driver has gone; check cable, hub and power";
  }
  if (step == Step::kStreamOn) return streamOnAdvice(error_number, path);
  switch (error_number) {
    case EACCES:
    case EPERM:
      return "this user may not use it; cameras belong to the group `video`: `sudo usermod -aG video $USER`, "
             "then log in again";
    case ENOENT:
      return "there is no such device now; is the camera plugged in? `rosrun stereo_nav list_cameras` shows "
             "what is connected";
    case EBUSY:
      return busyAdvice(path);
    case EIO:
      return "the USB transfer failed; check cable, hub and power";
    case EINVAL:
    case ENOTTY:
      return "the device does not support this; `rosrun stereo_nav list_cameras` shows what it can do";
    case ENOMEM:
      return "the system has no memory left for image buffers; close programs or use a smaller image";
    default:
      return "plug the camera in again; if that does not help, `dmesg` shows what the driver says";
  }
}

/// The files that a process has open, as links in /proc.
bool hasOpen(const std::string& descriptor_folder, const std::string& target) {
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir(descriptor_folder.c_str()), closedir);
  if (!folder) return false;
  while (const dirent* entry = readdir(folder.get())) {
    std::array<char, PATH_MAX> link{};
    const std::string path = descriptor_folder + "/" + entry->d_name;
    if (readlink(path.c_str(), link.data(), link.size() - 1) > 0 && target == link.data()) return true;
  }
  return false;
}

}  // namespace

CaptureError explainFailure(Step step, int error_number, const std::string& path,
                            const std::string& details) {
  std::string message =
      path + ": " + actionText(step) + (details.empty() ? "" : " (" + details + ")") + " failed";
  if (error_number != 0) message += std::string(" (") + std::strerror(error_number) + ")";
  return {step, error_number, message + ": " + adviceFor(step, error_number, path)};
}

std::string processesUsing(const std::string& path) {
  const std::unique_ptr<char, void (*)(void*)> real(realpath(path.c_str(), nullptr), std::free);
  const std::string target = real ? real.get() : path;
  const std::unique_ptr<DIR, int (*)(DIR*)> processes(opendir("/proc"), closedir);
  std::string users;
  while (const dirent* entry = processes ? readdir(processes.get()) : nullptr) {
    if (std::isdigit(static_cast<unsigned char>(entry->d_name[0])) == 0) continue;
    const std::string process = std::string("/proc/") + entry->d_name;
    if (!hasOpen(process + "/fd", target)) continue;
    std::string name;
    std::getline(std::ifstream(process + "/comm"), name);
    users += (users.empty() ? "" : ", ") + name + " (pid " + entry->d_name + ")";
  }
  return users;
}

}  // namespace stereo_nav::camera
