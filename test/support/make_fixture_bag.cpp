// Writes the fixture recording that the tests of the graph play: make_fixture_bag OUTPUT [FRAMES
// [RIGHT_LAG_S [TOE_IN_RAD [RIG]]]]: the images of a RIG are compressed Bayer images, and every fifth
// has a camera_info
#include <cstdio>
#include <cstdlib>

#include "support/fixture_bag.h"

int main(int argc, char** argv) {
  if (argc < 2 || argc > 6) {
    std::fprintf(stderr, "usage: make_fixture_bag OUTPUT [FRAMES [RIGHT_LAG_S [TOE_IN_RAD [RIG]]]]\n");
    return 2;
  }
  stereo_nav::test::FixtureBag fixture;
  if (argc > 2) fixture.frames = std::atoi(argv[2]);
  if (argc > 3) fixture.right_lag_s = std::atof(argv[3]);
  if (argc > 4) fixture.toe_in_rad = std::atof(argv[4]);
  if (argc > 5) {
    fixture.rig = argv[5];
    fixture.compressed_bayer = true;
    fixture.info_every = 5;
  }
  stereo_nav::test::writeFixtureBag(argv[1], fixture);
  return 0;
}
