#include "core/atomic_file.h"

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/trajectory.h"
#include "support/trajectories.h"

namespace stereo_nav {
namespace {

TEST(AtomicFile, appearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder / "deep/er/result.txt");
    std::ofstream(file.temporaryPath()) << "complete";
    EXPECT_FALSE(std::filesystem::exists(folder / "deep/er/result.txt"));
    file.commit();
  }
  EXPECT_EQ(folder.read("deep/er/result.txt"), "complete");
}

TEST(AtomicFile, leavesNothingWithoutCommit) {
  const TemporaryFolder folder;
  { const AtomicFile file(folder / "result.txt"); }
  EXPECT_EQ(folder.countFiles(), 0u);
  { const AtomicFile file(folder / "deep/er/result.txt"); }
  EXPECT_FALSE(std::filesystem::exists(folder / "deep"));
}

TEST(AtomicFile, leavesFoldersThatOthersUse) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "there");
  { const AtomicFile file(folder / "there/result.txt"); }
  EXPECT_TRUE(std::filesystem::exists(folder / "there"));
  {
    const AtomicFile file(folder / "new/er/result.txt");
    folder.write("new/of_another.txt", "");
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "new/of_another.txt"));
  EXPECT_FALSE(std::filesystem::exists(folder / "new/er"));
}

TEST(AtomicFile, replacesAnOlderFile) {
  const TemporaryFolder folder;
  const auto path = folder.write("result.txt", "old and longer");
  writeFileAtomically(path, "new");
  EXPECT_EQ(folder.read("result.txt"), "new");
  EXPECT_EQ(folder.countFiles(), 1u);
}

TEST(AtomicFile, saysWhyItCannotWrite) {
  const TemporaryFolder folder;
  folder.write("file", "");
  const auto messageFor = [](const std::string& path) {
    return messageOf<InputError>([&path] { writeFileAtomically(path, "x"); });
  };
  EXPECT_NE(messageFor(folder / "file/result.txt").find("cannot be written"), std::string::npos);
  EXPECT_NE(messageFor(folder.path()).find("it is a folder"), std::string::npos);
  EXPECT_EQ(folder.countFiles(), 1u);
}

}  // namespace
}  // namespace stereo_nav
