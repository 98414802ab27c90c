#include "sensors/serial/emulation/emulated_adapter.h"

#include <iostream>

namespace stereo_nav::serial {
namespace {

/// A pseudo-terminal holds less than the kernel does for a real serial port; this makes up for it.
constexpr std::size_t kKernelBuffer = 65536;
constexpr int kGarbageBytes = 20;

}  // namespace

EmulatedAdapter::EmulatedAdapter(AdapterOptions options)
    : options_(std::move(options)),
      line_(options_.baud_rate, options_.batch_s),
      faults_(options_.corrupt_probability, options_.drop_probability, options_.seed + 1),
      random_(options_.seed + 2) {
  plugIn();
}

void EmulatedAdapter::plugIn() {
  terminal_ = std::make_unique<PseudoTerminal>();
  for (const std::string& link : options_.links) terminal_->link(link);
  std::cout << "port " << terminal_->path() << std::endl;
}

bool EmulatedAdapter::send(const std::vector<std::uint8_t>& bytes, double time_s) {
  std::vector<std::uint8_t> passed;
  const bool intact = faults_.pass(bytes.data(), bytes.size(), passed);
  if (std::uniform_real_distribution<double>()(random_) < options_.garbage_probability) {
    for (int i = 0; i < kGarbageBytes; ++i) passed.push_back(static_cast<std::uint8_t>(random_()));
  }
  line_.send(passed, time_s);
  return intact;
}

void EmulatedAdapter::handOver(double now_s) {
  if (options_.unplug.contains(now_s - start_s_)) {
    terminal_.reset();
  } else if (!terminal_) {
    if (!options_.replug_link.empty() && !options_.links.empty()) options_.links[0] = options_.replug_link;
    plugIn();
  }
  std::vector<std::uint8_t> bytes;
  line_.collect(now_s, bytes);
  if (!terminal_) {
    kernel_buffer_.clear();
    return;
  }
  if (!bytes.empty()) bytes = asReceived(bytes);
  kernel_buffer_.insert(kernel_buffer_.end(), bytes.begin(), bytes.end());
  const std::size_t taken = terminal_->write(kernel_buffer_);
  kernel_buffer_.erase(kernel_buffer_.begin(), kernel_buffer_.begin() + static_cast<std::ptrdiff_t>(taken));
  if (kernel_buffer_.size() > kKernelBuffer) {
    overrun_ += kernel_buffer_.size() - kKernelBuffer;
    kernel_buffer_.resize(kKernelBuffer);
  }
}

std::vector<std::uint8_t> EmulatedAdapter::received() {
  return terminal_ ? terminal_->read() : std::vector<std::uint8_t>();
}

std::vector<std::uint8_t> EmulatedAdapter::asReceived(const std::vector<std::uint8_t>& bytes) {
  const int reader_baud = terminal_->baudRate().value_or(options_.baud_rate);
  if (reader_baud == options_.baud_rate) return bytes;
  if (!receiver_ || receiver_baud_ != reader_baud) {
    receiver_ = std::make_unique<MismatchedReceiver>(options_.baud_rate, reader_baud);
    receiver_baud_ = reader_baud;
  }
  std::vector<std::uint8_t> received;
  receiver_->receive(bytes, received);
  return received;
}

}  // namespace stereo_nav::serial
