#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace stereo_nav::odometry {

/// The symmetric 0/1 matrix M over features: M(i, j) says that i and j moved as one rigid body. One bit per
/// pair; rows are sequences of 64-bit words, so that sets of candidates intersect a word at a time.
class ConsistencyGraph {
 public:
  explicit ConsistencyGraph(std::size_t size)
      : size_(size), words_((size + 63) / 64), bits_(size * words_, 0) {}

  std::size_t size() const { return size_; }
  std::size_t words() const { return words_; }
  const std::uint64_t* row(std::size_t i) const { return bits_.data() + i * words_; }

  void connect(std::size_t i, std::size_t j) {
    bits_[i * words_ + j / 64] |= std::uint64_t{1} << (j % 64);
    bits_[j * words_ + i / 64] |= std::uint64_t{1} << (i % 64);
  }
  bool connected(std::size_t i, std::size_t j) const { return (row(i)[j / 64] >> (j % 64) & 1U) != 0; }

 private:
  std::size_t size_;
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

}  // namespace stereo_nav::odometry
