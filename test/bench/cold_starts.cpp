// How honest is the odometry just after it has been switched on? Runs simulated cold starts
// (test/support/cold_start.h), 100 or as many as asked for, and prints those that were wrong at any time,
// then a table of all kinds:
//   build/devel/lib/stereo_nav/vo_cold_starts_test [STARTS]
// Ends with 1 where more than 0.5 % of the frames called TRACKING lie outside the 99.73 % ellipsoid of their
// covariance, or any one beyond a Mahalanobis distance of 6 or wrong by more than the larger of 5 cm and 2 %.
#include <array>
#include <cstdio>
#include <cstdlib>

#include "support/cold_start.h"

int main(int argc, char** argv) {
  using stereo_nav::test::ColdStart;
  using stereo_nav::test::ColdStartCounts;
  const int starts = argc > 1 ? std::atoi(argv[1]) : 100;
  std::array<ColdStartCounts, ColdStart::kKinds + 1> sums;
  std::array<int, ColdStart::kKinds + 1> numbers{};
  for (int number = 0; number < starts; ++number) {
    const ColdStart start(number);
    const ColdStartCounts counts = start.run();
    for (const std::size_t row : {static_cast<std::size_t>(start.kind()), sums.size() - 1}) {
      sums[row] += counts;
      ++numbers[row];
    }
    if (counts.outside + counts.wrong > 0 || counts.begun == 0)
      std::printf("%s: %d tracking, %d outside, %d wrong, at most %.1f\n", start.text().c_str(),
                  counts.tracking, counts.outside, counts.wrong, counts.worst);
    std::fflush(stdout);
  }
  const char* const names[] = {"turning", "fast", "blurred", "half covered", "all"};
  std::printf(
      "| starts | number | begun | frames | TRACKING | outside 99.73 %% | beyond 6 | wrong | worst |\n");
  std::printf("|---|---|---|---|---|---|---|---|---|\n");
  for (std::size_t row = 0; row < sums.size(); ++row) {
    const ColdStartCounts& sum = sums[row];
    std::printf("| %s | %d | %d | %d | %d | %d | %d | %d | %.1f |\n", names[row], numbers[row], sum.begun,
                sum.frames, sum.tracking, sum.outside, sum.beyond, sum.wrong, sum.worst);
  }
  const ColdStartCounts& all = sums.back();
  return all.begun > 0 && 200 * all.outside <= all.tracking && all.beyond == 0 && all.wrong == 0 ? 0 : 1;
}
