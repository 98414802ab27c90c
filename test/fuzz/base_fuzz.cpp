#include "fuzz/base_fuzz.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "sensors/base/controller/base_controller.h"
#include "sensors/base/controller/frame_parser.h"
#include "sensors/base/crc32.h"

namespace stereo_nav::base {
namespace {

using Bytes = std::vector<std::uint8_t>;

void require(bool condition) {
  if (!condition) std::abort();
}

/// Payloads of a length that the data name, made into frames.
template <class Message>
Bytes framed(const std::uint8_t* data, std::size_t size) {
  Bytes stream;
  for (std::size_t i = 0; i < size;) {
    const std::size_t length = std::min<std::size_t>(data[i], size - i - 1);
    ++i;
    Bytes frame = {kSync0, kSync1, Message::kType, static_cast<std::uint8_t>(length)};
    frame.insert(frame.end(), data + i, data + i + length);
    const std::uint32_t crc = Crc32::of(frame.data() + 2, frame.size() - 2);
    for (int byte = 0; byte < 4; ++byte) frame.push_back(static_cast<std::uint8_t>(crc >> (8 * byte)));
    stream.insert(stream.end(), frame.begin(), frame.end());
    i += length;
  }
  return stream;
}

template <class Message>
void parse(const Bytes& stream) {
  FrameParser<Message, Crc32> parser;
  Message message{};
  std::size_t in_frames = 0;
  Bytes again(maxFrameBytes<Message>());
  for (const std::uint8_t byte : stream) {
    if (!parser.push(byte, message)) continue;
    require(countsFit(message));
    const std::size_t length = encode<Crc32>(message, again.data());
    in_frames += length;
    const auto end = stream.begin() + (&byte - stream.data()) + 1;
    require(std::search(stream.begin(), end, again.begin(), again.begin() + static_cast<long>(length)) !=
            end);
  }
  const ParserCounters& c = parser.counters();
  require(c.bytes == stream.size());
  require(c.bytes_skipped + in_frames + parser.pending() <= c.bytes);
  require(c.impossible + c.stale > 0 || c.bytes_skipped + in_frames + parser.pending() == c.bytes);
}

/// Whatever comes, the wheels hold no speed unless a command says so.
void control(const Bytes& stream) {
  ControllerSetup setup{};
  setup.wheels = 2;
  setup.is_steered[0] = true;
  setup.steering_gains = {15.0F, 8.0F, 0.008F, {0.1F, 0.05F, 0.1F, 2.0F, 10.0F}};
  BaseController controller(setup);
  std::uint32_t now_ms = 0;
  for (const std::uint8_t byte : stream) {
    controller.receive(byte, now_ms);
    const ControllerOutputs& outputs = controller.step(ControllerInputs{}, ++now_ms, 0.001F);
    require(std::abs(outputs.duty[0]) <= 1.0F && std::abs(outputs.steering_duty[0]) <= 1.0F);
    require(controller.mode() == Mode::kDriving || controller.heldSpeed_mm_per_s(0) == 0);
  }
}

}  // namespace

void parseFuzzInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return;
  const bool repaired = data[0] % 2 == 1;
  const Bytes plain(data + 1, data + size);
  parse<Telemetry>(repaired ? framed<Telemetry>(data + 1, size - 1) : plain);
  const Bytes commands = repaired ? framed<Command>(data + 1, size - 1) : plain;
  parse<Command>(commands);
  control(commands);
}

}  // namespace stereo_nav::base
