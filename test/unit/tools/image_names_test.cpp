// Which images belong together, when they were taken, and how their values are to be read.
#include "tools/import_sequence/image_names.h"

#include <algorithm>

#include "import_test_support.h"
#include "stereo_nav/core/input_error.h"
#include "tools/import_sequence/sequence.h"
#include "tools/import_sequence/sixteen_bits.h"

namespace stereo_nav::tools {
namespace {

using Numbers = std::vector<std::size_t>;

void writePairs(const TemporaryFolder& folder, const std::vector<std::string>& left,
                const std::vector<std::string>& right) {
  folder.write("calib.txt", kImagesCalibration);
  for (const auto& name : left) writeImage(folder, "left/" + name + ".png", frameOf(1));
  for (const auto& name : right) writeImage(folder, "right/" + name + ".png", frameOf(1));
}

std::string refusalOf(const TemporaryFolder& folder) {
  return messageOf<InputError>([&] { readImages(folder.path()); });
}

TEST(ImageNames, numbersSortAsNumbers) {
  std::vector<std::string> names = {"10", "9", "a2", "a10", "a1b", "1", "02"};
  std::sort(names.begin(), names.end(), naturalLess);
  EXPECT_EQ(names, (std::vector<std::string>{"1", "02", "9", "10", "a1b", "a2", "a10"}));
}

TEST(ImageNames, thePairsNameIsWithoutSideExtensionAndLeadingZeros) {
  EXPECT_EQ(pairKey("x/left_007.png", Side::kLeft), "7");
  EXPECT_EQ(pairKey("x/007R.jpg", Side::kRight), "7");
  EXPECT_EQ(pairKey("x/L12.jpg", Side::kLeft), "12");
  EXPECT_EQ(pairKey("x/label_1.jpg", Side::kLeft), "label_1");
}

TEST(ImageNames, stampsAreToldByTheirSize) {
  EXPECT_EQ(stampFromText("1403636579763555584")->toNSec(), 1403636579763555584u);
  EXPECT_EQ(stampFromText("1403636579763555")->toNSec(), 1403636579763555000u);
  EXPECT_EQ(stampFromText("1403636579763")->toNSec(), 1403636579763000000u);
  EXPECT_EQ(stampFromText("1403636579.7635")->toNSec(), 1403636579763500000u);
  EXPECT_FALSE(stampFromText("12a"));
  EXPECT_FALSE(stampFromText(""));
  EXPECT_FALSE(stampFromName("left/0000000012.png", Side::kLeft));
  EXPECT_FALSE(stampFromName("left/20230115123456.png", Side::kLeft));
}

TEST(ImageNames, missingNumbersLeaveTheirTimeEmpty) {
  const NamedPairs pairs = pairByName({"l/0.png", "l/2.png", "l/4.png", "l/10.png"},
                                      {"r/0.png", "r/4.png", "r/6.png", "r/10.png"});
  EXPECT_EQ(pairs.index, (Numbers{0, 2, 5}));
  EXPECT_EQ(pairs.unpaired, (std::vector<std::string>{"l/2.png", "r/6.png"}));
  EXPECT_EQ(pairs.absent, 1u);
}

TEST(ImagesByName, areInTheOrderOfTheirNumbers) {
  const TemporaryFolder folder;
  folder.write("calib.txt", kImagesCalibration);
  for (int i = 0; i < 12; ++i) {
    for (const char* side : {"left/", "right/"}) {
      writeImage(folder, side + std::to_string(i) + ".png", frameOf(i));
    }
  }
  const Sequence sequence = readImages(folder.path());
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(sequence.left.frames->read(static_cast<std::size_t>(i)).at<std::uint8_t>(0, 0), 10 + 20 * i);
  }
}

TEST(ImagesByName, thoseWithoutPartnerAreLeftOutAndListed) {
  const TemporaryFolder folder;
  writePairs(folder, {"000", "001", "003", "004"}, {"000", "002", "003", "004"});
  const Sequence sequence = readImages(folder.path());
  ASSERT_EQ(sequence.left.frames->size(), 3u);
  EXPECT_EQ(sequence.left.stamps[1], ros::Time(1000, 300000000));
  EXPECT_EQ(sequence.left.stamps, sequence.right.stamps);
  ASSERT_FALSE(sequence.notes.empty());
  EXPECT_NE(sequence.notes[0].find("left/001.png, right/002.png"), std::string::npos) << sequence.notes[0];
}

TEST(ImagesByName, refusesNamesThatTellNoPairs) {
  const TemporaryFolder folder;
  writePairs(folder, {"a", "b"}, {"c", "d"});
  EXPECT_NE(refusalOf(folder).find("(left/a.png, right/c.png)"), std::string::npos);
  writePairs(folder, {"7", "007"}, {"7"});
  EXPECT_NE(refusalOf(folder).find("same name or number"), std::string::npos);
}

TEST(ImagesByName, datesAreStamps) {
  const TemporaryFolder folder;
  writePairs(folder, {"1403636579763555584", "1403636579813555456"},
             {"1403636579763555584", "1403636579813555456"});
  EXPECT_EQ(readImages(folder.path()).right.stamps[1].toNSec(), 1403636579813555456u);
}

TEST(ImagesByName, datesOfEitherCameraPairByTime) {
  const TemporaryFolder folder;
  writePairs(folder, {"1403636579.70", "1403636579.80"}, {"1403636579.71", "1403636579.81"});
  const Sequence sequence = readImages(folder.path());
  ASSERT_EQ(sequence.right.stamps.size(), 2u);
  EXPECT_EQ(sequence.left.stamps[0], ros::Time(1403636579, 700000000));
  EXPECT_EQ(sequence.right.stamps[1], ros::Time(1403636579, 810000000));
}

TEST(ImagesByName, stampsComeFromAFile) {
  const TemporaryFolder folder;
  writePairs(folder, {"0", "1", "2"}, {"0", "2"});
  folder.write("times.txt", "0.0 0.004\n0.25 0.254\n5e-1 0.504\n");
  const Sequence sequence = readImages(folder.path());
  ASSERT_EQ(sequence.left.stamps.size(), 2u);
  EXPECT_EQ(sequence.left.stamps[1], ros::Time(1000, 500000000));
  EXPECT_EQ(sequence.right.stamps[1], ros::Time(1000, 504000000));
  folder.write("times.txt", "0.0\n0.25\n");
  EXPECT_NE(refusalOf(folder).find("holds 2 stamps for 3 frames"), std::string::npos);
  folder.write("times.txt", "0.0\n0.25\n0.25\n");
  EXPECT_NE(refusalOf(folder).find("times.txt:3: the stamp 0.25 is not later"), std::string::npos);
}

/// Grey ramp up to `largest`, with bytes exchanged if asked.
cv::Mat ramp(int largest, bool swapped = false) {
  cv::Mat image(kHeight, kWidth, CV_16UC1);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const int value = largest * x / (kWidth - 1);
      image.at<std::uint16_t>(y, x) =
          static_cast<std::uint16_t>(swapped ? (value & 0xff) << 8 | value >> 8 : value);
    }
  }
  return image;
}

TEST(SixteenBits, theRangeAndTheByteOrderAreFound) {
  for (const auto& [largest, bits, swapped] : {std::tuple(1000, 10, false), std::tuple(4000, 12, false),
                                               std::tuple(4000, 12, true), std::tuple(60000, 16, true)}) {
    const TemporaryFolder folder;
    writePairs(folder, {}, {});
    writeImage(folder, "left/0.png", ramp(largest, swapped));
    writeImage(folder, "right/0.png", ramp(largest / 2, swapped));
    Sequence sequence = readImages(folder.path());
    useFullRange(sequence);
    const cv::Mat image = sequence.left.frames->read(0);
    ASSERT_EQ(image.type(), CV_16UC1);
    EXPECT_EQ(image.at<std::uint16_t>(0, kWidth - 1), largest << (16 - bits)) << largest;
    EXPECT_EQ(sequence.right.frames->read(0).at<std::uint16_t>(0, kWidth - 1), (largest / 2) << (16 - bits));
    EXPECT_NE(sequence.notes.back().find(std::to_string(bits) + "-bit"), std::string::npos);
  }
}

TEST(SixteenBits, fullRangeAndEightBitsStayAsTheyAre) {
  const TemporaryFolder folder;
  writePairs(folder, {}, {});
  writeImage(folder, "left/0.png", ramp(60000));
  writeImage(folder, "right/0.png", frameOf(3));
  Sequence sequence = readImages(folder.path());
  const std::size_t notes = sequence.notes.size();
  useFullRange(sequence);
  EXPECT_EQ(sequence.notes.size(), notes);
  EXPECT_EQ(sequence.left.frames->read(0).at<std::uint16_t>(0, kWidth - 1), 60000);
  EXPECT_EQ(sequence.right.frames->read(0).type(), CV_8UC1);
}

}  // namespace
}  // namespace stereo_nav::tools
