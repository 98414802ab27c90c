#include "ros/bag_file.h"

#include <rosbag/view.h>
#include <sensor_msgs/Image.h>
#include <std_msgs/String.h>
#include <sys/resource.h>

#include <csignal>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"
#include "support/trajectories.h"

namespace stereo_nav::ros_io {
namespace {

std_msgs::String text(const std::string& data) {
  std_msgs::String message;
  message.data = data;
  return message;
}

TEST(BagFile, appearsWhenCommitted) {
  const TemporaryFolder folder;
  {
    BagFile bag(folder / "out.bag");
    bag.writeLatched("latched", ros::Time(5), text("a"));
    bag.write("plain", ros::Time(6), text("b"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.bag"));
    bag.commit();
  }
  rosbag::Bag bag(folder / "out.bag");
  rosbag::View view(bag);
  ASSERT_EQ(view.size(), 2u);
  for (const rosbag::MessageInstance& message : view) {
    const bool latched = message.getConnectionHeader()->count("latching") != 0;
    EXPECT_EQ(latched, message.getTopic() == "latched");
    EXPECT_EQ(message.instantiate<std_msgs::String>()->data, latched ? "a" : "b");
  }
}

TEST(BagFile, leavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  { BagFile(folder / "out.bag").write("topic", ros::Time(5), text("a")); }
  EXPECT_EQ(folder.countFiles(), 0u);
}

/// Simulates a full disk: while it exists, files of this process cannot grow beyond some bytes.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  sighandler_t handler_;
};

TEST(BagFile, aFullDiskIsAnErrorAndLeavesNothing) {
  const TemporaryFolder folder;
  const FullDisk disk(1000000);
  sensor_msgs::Image image;
  image.data.assign(400000, 7);
  const auto message = messageOf<InputError>([&] {
    BagFile bag(folder / "out.bag");
    for (unsigned i = 1; i < 10; ++i) bag.write("image", ros::Time(i), image);
    bag.commit();
  });
  EXPECT_NE(message.find("out.bag: cannot be written"), std::string::npos) << message;
  EXPECT_NE(message.find("space on the disk"), std::string::npos);
  EXPECT_EQ(folder.countFiles(), 0u);
}

}  // namespace
}  // namespace stereo_nav::ros_io
