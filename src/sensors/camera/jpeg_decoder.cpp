#include "sensors/camera/jpeg_decoder.h"

#include <csetjmp>
#include <cstdio>

// jpeglib.h needs cstdio before it, jerror.h needs jpeglib.h.
#include <jerror.h>
#include <jpeglib.h>

namespace stereo_nav::camera::internal {
namespace {

/// libjpeg reports errors by a jump; the jump buffer follows libjpeg's own struct.
struct ErrorManager {
  jpeg_error_mgr base;
  std::jmp_buf jump;
  char problem[JMSG_LENGTH_MAX];
};

[[noreturn]] void onError(j_common_ptr common) {
  auto* errors = reinterpret_cast<ErrorManager*>(common->err);
  common->err->format_message(common, errors->problem);
  std::longjmp(errors->jump, 1);
}

/// Warnings mean damaged image data, except for padding bytes between markers, which many webcams send.
void onMessage(j_common_ptr common, int level) {
  if (level >= 0 || common->err->msg_code == JWRN_EXTRANEOUS_DATA) return;
  auto* errors = reinterpret_cast<ErrorManager*>(common->err);
  if (errors->problem[0] == '\0') common->err->format_message(common, errors->problem);
}

/// Decompresses into `image`, which has its size already. Returns false when libjpeg gave up. The function
/// holds no object whose destructor a jump would skip.
bool decompress(jpeg_decompress_struct& jpeg, ErrorManager& errors, const std::uint8_t* data,
                std::size_t size, DecodedImage& image) {
  if (setjmp(errors.jump) != 0) return false;
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, data, static_cast<unsigned long>(size));
  jpeg_read_header(&jpeg, TRUE);
  if (static_cast<int>(jpeg.image_width) != image.width ||
      static_cast<int>(jpeg.image_height) != image.height) {
    std::snprintf(errors.problem, sizeof(errors.problem),
                  "the JPEG is %u x %u, the camera was set to %d x %d", jpeg.image_width, jpeg.image_height,
                  image.width, image.height);
    return false;
  }
  jpeg.out_color_space = image.encoding == Encoding::kMono8 ? JCS_GRAYSCALE : JCS_EXT_BGR;
  jpeg_start_decompress(&jpeg);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = image.pixels.data() + jpeg.output_scanline * image.step();
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
  return true;
}

}  // namespace

std::string decodeJpeg(const std::uint8_t* data, std::size_t size, const ImageLayout& layout,
                       Encoding encoding, DecodedImage& image) {
  allocate(layout, encoding, image);
  jpeg_decompress_struct jpeg{};
  ErrorManager errors{};
  jpeg.err = jpeg_std_error(&errors.base);
  errors.base.error_exit = onError;
  errors.base.emit_message = onMessage;
  const bool complete = decompress(jpeg, errors, data, size, image);
  jpeg_destroy_decompress(&jpeg);
  if (complete && errors.problem[0] == '\0') return {};
  return std::string("broken JPEG (") + errors.problem + ")";
}

}  // namespace stereo_nav::camera::internal
