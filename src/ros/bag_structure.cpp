#include "ros/bag_structure.h"

#include <fmt/format.h>
#include <rosbag/constants.h>
#include <rosbag/exceptions.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::ros_io {
namespace {

[[noreturn]] void damaged(std::uint64_t place, const std::string& what) {
  throw rosbag::BagFormatException(fmt::format("damaged at byte {}: {}", place, what));
}

/// Bytes of the file, read in small pieces around what is asked for.
class FileBytes {
 public:
  explicit FileBytes(const std::string& path)
      : file_(path, std::ios::binary), size_(std::filesystem::file_size(path)) {
    file_.rdbuf()->pubsetbuf(nullptr, 0);
  }

  std::uint64_t size() const { return size_; }

  std::string read(std::uint64_t place, std::uint64_t count) {
    if (place > size_ || count > size_ - place) damaged(place, "the file ends within a record");
    if (place < begin_ || place + count > begin_ + piece_.size()) {
      constexpr std::uint64_t kPiece = 4096;
      begin_ = place;
      piece_.resize(std::min(std::max(count, kPiece), size_ - place));
      file_.seekg(static_cast<std::streamoff>(place));
      if (!file_.read(piece_.data(), static_cast<std::streamsize>(piece_.size())))
        damaged(place, "the file cannot be read");
    }
    return piece_.substr(place - begin_, count);
  }

  std::uint32_t readLength(std::uint64_t place) {
    const std::string bytes = read(place, 4);
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data(), sizeof length);
    return length;
  }

 private:
  std::ifstream file_;
  std::uint64_t size_;
  std::uint64_t begin_ = 0;
  std::string piece_;
};

/// Fields `name=value` of a record's header; the data of a connection has the same form.
class Fields {
 public:
  Fields(const std::string& bytes, std::uint64_t place) {
    for (std::size_t at = 0; at < bytes.size();) {
      std::uint32_t length = 0;
      if (bytes.size() - at < sizeof length) damaged(place + at, "a field without length");
      std::memcpy(&length, bytes.data() + at, sizeof length);
      at += sizeof length;
      if (length > bytes.size() - at) damaged(place + at, "a field that is longer than its header");
      const std::string field = bytes.substr(at, length);
      const std::size_t sign = field.find('=');
      if (sign == std::string::npos) damaged(place + at, "a field without '='");
      values_[field.substr(0, sign)] = field.substr(sign + 1);
      at += length;
    }
  }

  std::string text(const std::string& name) const {
    const auto value = values_.find(name);
    return value == values_.end() ? "" : value->second;
  }

  /// A number of that many bytes; 0 where the field is missing or has another size, which rosbag refuses.
  template <class Number>
  Number number(const std::string& name) const {
    Number number = 0;
    const std::string value = text(name);
    if (value.size() == sizeof number) std::memcpy(&number, value.data(), sizeof number);
    return number;
  }

 private:
  std::map<std::string, std::string> values_;
};

struct Record {
  Fields fields;
  std::uint64_t data, end;  ///< where its data begin and end

  int op() const { return fields.number<std::uint8_t>(rosbag::OP_FIELD_NAME); }
};

class BagWalk {
 public:
  explicit BagWalk(const std::string& path) : file_(path) {}

  void check() {
    const std::string version = "#ROSBAG V2.0\n";
    if (file_.size() < version.size() || file_.read(0, version.size()) != version)
      throw rosbag::BagFormatException("it does not begin as bags of version 2.0 do");
    std::uint64_t place = version.size();
    const Record header = record(place, file_.size());
    const auto index = header.fields.number<std::uint64_t>(rosbag::INDEX_POS_FIELD_NAME);
    if (header.op() != rosbag::OP_FILE_HEADER || index == 0) return;
    bool has_index = index == file_.size();
    for (place = header.end; place < file_.size();) {
      has_index = has_index || place == index;
      const Record next = record(place, file_.size());
      checkRecord(next, place);
      place = next.end;
    }
    if (!has_index) damaged(index, "no record begins where the index should");
  }

 private:
  Record record(std::uint64_t place, std::uint64_t limit) {
    const std::uint32_t header = length(place, limit);
    Fields fields(file_.read(place + 4, header), place + 4);
    const std::uint64_t data = place + 8 + header;
    return {std::move(fields), data, data + length(data - 4, limit)};
  }

  /// The length at `place` of what follows it and ends before the limit.
  std::uint32_t length(std::uint64_t place, std::uint64_t limit) {
    if (place + 4 > limit) damaged(place, "a record that is cut off");
    const std::uint32_t length = file_.readLength(place);
    if (length > limit - place - 4) damaged(place, "a record that is longer than what holds it");
    return length;
  }

  void checkRecord(const Record& record, std::uint64_t place) {
    switch (record.op()) {
      case rosbag::OP_CHUNK:
        chunks_.push_back(place);
        return checkChunk(record);
      case rosbag::OP_INDEX_DATA:
        return checkIndex(record);
      case rosbag::OP_CONNECTION:
        return checkConnection(record);
      case rosbag::OP_CHUNK_INFO:
        return checkChunkInfo(record);
      default:
        damaged(place, "a record of unknown kind");
    }
  }

  void checkChunk(const Record& chunk) {
    starts_.clear();
    is_compressed_ = chunk.fields.text(rosbag::COMPRESSION_FIELD_NAME) != rosbag::COMPRESSION_NONE;
    size_ = chunk.fields.number<std::uint32_t>(rosbag::SIZE_FIELD_NAME);
    if (is_compressed_) return;
    if (size_ != chunk.end - chunk.data) damaged(chunk.data, "a chunk of another size than its header says");
    for (std::uint64_t place = chunk.data; place < chunk.end;) {
      const Record next = record(place, chunk.end);
      starts_.push_back(place - chunk.data);
      if (next.op() == rosbag::OP_CONNECTION) checkConnection(next);
      place = next.end;
    }
  }

  void checkConnection(const Record& connection) {
    Fields(file_.read(connection.data, connection.end - connection.data), connection.data);
  }

  /// Seconds, nanoseconds and place of each message within the chunk before.
  void checkIndex(const Record& index) {
    constexpr std::uint64_t kEntry = 12;
    const auto count = index.fields.number<std::uint32_t>(rosbag::COUNT_FIELD_NAME);
    if (count * kEntry != index.end - index.data) damaged(index.data, "an index of another size");
    for (std::uint64_t place = index.data; place < index.end; place += kEntry) {
      const std::uint64_t start = file_.readLength(place + 8);
      const bool is_there =
          is_compressed_ ? start < size_ : std::binary_search(starts_.begin(), starts_.end(), start);
      if (!is_there) damaged(place, "an index that points between messages");
    }
  }

  void checkChunkInfo(const Record& info) {
    constexpr std::uint64_t kEntry = 8;
    const auto count = info.fields.number<std::uint32_t>(rosbag::COUNT_FIELD_NAME);
    if (count * kEntry != info.end - info.data) damaged(info.data, "a chunk's list of another size");
    const auto chunk = info.fields.number<std::uint64_t>(rosbag::CHUNK_POS_FIELD_NAME);
    if (!std::binary_search(chunks_.begin(), chunks_.end(), chunk))
      damaged(info.data, "a chunk's place at which no chunk begins");
  }

  FileBytes file_;
  std::vector<std::uint64_t> chunks_;  ///< places of all chunks so far
  std::vector<std::uint64_t> starts_;  ///< of the records in the last chunk, from its data on
  bool is_compressed_ = false;         ///< the last chunk
  std::uint64_t size_ = 0;             ///< of the last chunk, uncompressed
};

}  // namespace

void checkBagStructure(const std::string& path) {
  BagWalk(path).check();
}

void openBag(rosbag::Bag& bag, const std::string& path) {
  if (std::filesystem::is_regular_file(path)) checkBagStructure(path);
  bag.open(path, rosbag::bagmode::Read);
}

void readBag(const std::string& path, const std::function<void()>& read) {
  try {
    read();
  } catch (const rosbag::BagUnindexedException&) {
    throw InputError(path + ": the recording was cut off (it has no index); `rosbag reindex " + path +
                     "` repairs it and keeps the original as *.orig.bag");
  } catch (const rosbag::BagException& error) {
    throw InputError(
        path + ": cannot be read as a bag (" + error.what() +
        "); where the file was cut off, e.g. while it was copied, copy it again or repair it: `rosbag "
        "reindex " +
        path + "`");
  } catch (const ros::Exception& error) {
    throw InputError(path + ": damaged message: " + error.what());
  }
}

}  // namespace stereo_nav::ros_io
