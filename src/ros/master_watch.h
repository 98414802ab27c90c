#pragma once

#include <memory>
#include <thread>

namespace stereo_nav::ros_io {

/// Notices when the ROS master has gone, which roscpp does not: the node would run on, and nobody who starts
/// later could find it. Says so and shuts ROS down, so that whoever started the node (`respawn`, a service
/// manager) starts it again, where it waits for the next master.
///
/// Gone is a master whose port refuses connections for three seconds, one that answers but does not know this
/// node (it is a new one), and one that cannot be reached for half a minute: a wireless link that is cut for
/// less disturbs nothing. One a process is enough; more do no harm.
class MasterWatch {
 public:
  /// The node must have been registered by a first node handle.
  MasterWatch();
  ~MasterWatch();
  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

  /// For main() to return: 0, or 3 when the master has gone.
  int exitStatus() const;

 private:
  struct Shared;
  static void watch(const std::shared_ptr<Shared>& shared);

  std::shared_ptr<Shared> shared_;
  std::thread thread_;
};

}  // namespace stereo_nav::ros_io
