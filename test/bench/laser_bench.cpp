// Cost of decoding an RPLiDAR's bytes to scans: one second of samples an iteration, in reads as an adapter
// delivers them.
#include <benchmark/benchmark.h>

#include <vector>

#include "sensors/laser/emulation/emulated_scanner.h"
#include "sensors/laser/scan_decoder.h"

namespace stereo_nav::laser {
namespace {

void decodeOneSecond(benchmark::State& state) {
  constexpr double kRead_s = 0.016;
  constexpr int kBaud = 460800;
  ScannerOptions options;
  options.sample_rate_hz = static_cast<double>(state.range(0));
  options.scan_rate_hz = 10.0;
  EmulatedScanner scanner(options);
  scanner.receive({0xA5, 0x20}, 0.0);
  std::vector<std::vector<std::uint8_t>> reads;
  for (double time_s = 0.0; time_s < 1.0; time_s += kRead_s) {
    reads.emplace_back();
    for (const auto& node : scanner.advance(time_s)) {
      reads.back().insert(reads.back().end(), node.bytes.begin(), node.bytes.end());
    }
  }
  ScanParams params;
  params.beams = 800;
  ScanDecoder decoder(params, serial::StampFilterParams(), kBaud, 0.0);
  double now_s = 0.0;
  for (auto _ : state) {
    for (const auto& read : reads) {
      now_s += kRead_s;
      decoder.push(read.data(), read.size(), now_s,
                   [](const Scan& scan) { benchmark::DoNotOptimize(scan.time_s); });
    }
  }
}

BENCHMARK(decodeOneSecond)->Arg(2000)->Arg(8000)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace stereo_nav::laser

BENCHMARK_MAIN();
