#pragma once

#include <memory>
#include <thread>

namespace stereo_nav::ros_io {

/// Detects that the ROS master has gone, which roscpp does not do: the node would run on, and nodes that
/// start later could not find it. Logs this and shuts ROS down, so that `respawn` or a service manager starts
/// the node again, which then waits for the next master.
///
/// The master has gone if its port refuses connections for three seconds, if it answers but does not know
/// this node (a new master), or if it cannot be reached for half a minute; shorter interruptions of a
/// wireless link have no effect. One object per process is enough; more do no harm.
class MasterWatch {
 public:
  /// A node handle must exist already, so that the node is registered.
  MasterWatch();
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

  /// The exit status for main(): 0, or 3 when the master has gone.
  int exitStatus() const;

 private:
  struct Shared;
  static void watch(const std::shared_ptr<Shared>& shared);

  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace stereo_nav::ros_io
