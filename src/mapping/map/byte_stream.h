#pragma once

#include <Eigen/Geometry>
#include <boost/endian/conversion.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::mapping {

/// Appends numbers to a string, least significant byte first.
class ByteWriter {
 public:
  template <class Integer>
  void integer(Integer value) {
    boost::endian::native_to_little_inplace(value);
    append(&value, sizeof value);
  }
  void real(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    integer(bits);
  }
  /// In single precision.
  void single(double value) {
    const auto rounded = static_cast<float>(value);
    std::uint32_t bits = 0;
    std::memcpy(&bits, &rounded, sizeof bits);
    integer(bits);
  }
  /// Column by column.
  template <class Derived>
  void matrix(const Eigen::MatrixBase<Derived>& matrix) {
    for (Eigen::Index c = 0; c < matrix.cols(); ++c)
      for (Eigen::Index r = 0; r < matrix.rows(); ++r) real(matrix(r, c));
  }
  void pose(const Eigen::Isometry3d& T) { matrix(T.matrix().topRows<3>()); }

  const std::string& bytes() const { return bytes_; }

 private:
  void append(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }

  std::string bytes_;
};

/// Reads them back. Throws InputError that begins with `name` where the bytes end too early.
class ByteReader {
 public:
  ByteReader(const char* data, std::size_t size, std::string name)
      : data_(data), size_(size), name_(std::move(name)) {}

  template <class Integer>
  Integer integer() {
    Integer value;
    std::memcpy(&value, take(sizeof value), sizeof value);
    return boost::endian::little_to_native(value);
  }
  double real() {
    const auto bits = integer<std::uint64_t>();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof value);
    return finite(value);
  }
  double single() {
    const auto bits = integer<std::uint32_t>();
    float value = 0.0F;
    std::memcpy(&value, &bits, sizeof value);
    return finite(static_cast<double>(value));
  }
  template <class Matrix>
  Matrix matrix() {
    Matrix result;
    for (Eigen::Index c = 0; c < result.cols(); ++c)
      for (Eigen::Index r = 0; r < result.rows(); ++r) result(r, c) = real();
    return result;
  }
  Eigen::Isometry3d pose() {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.matrix().topRows<3>() = matrix<Eigen::Matrix<double, 3, 4>>();
    if (!(T.linear().transpose() * T.linear()).isIdentity(1e-6) || T.linear().determinant() < 0.0)
      fail("a pose whose axes are not at right angles");
    return T;
  }
  bool flag() {
    const auto value = integer<std::uint8_t>();
    if (value > 1) fail("a flag that is neither 0 nor 1");
    return value == 1;
  }
  /// A number of things of at least `least_bytes` each, which must fit into what is left.
  std::size_t count(std::size_t least_bytes) {
    const auto value = integer<std::uint64_t>();
    if (value > (size_ - position_) / least_bytes) fail("a count of more than the section can hold");
    return static_cast<std::size_t>(value);
  }
  void requireEnd() const {
    if (position_ != size_) fail(std::to_string(size_ - position_) + " bytes too many");
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(
        name_ + ": " + what +
        "; the file is damaged or was written by another program: use a copy, or make the map anew");
  }

  const char* take(std::size_t size) {
    if (size > size_ - position_) fail("it ends too early");
    position_ += size;
    return data_ + position_ - size;
  }
  std::size_t left() const { return size_ - position_; }

 private:
  double finite(double value) const {
    if (!std::isfinite(value)) fail("a number that is not finite");
    return value;
  }

  const char* data_;
  std::size_t size_, position_ = 0;
  std::string name_;
};

}  // namespace stereo_nav::mapping
