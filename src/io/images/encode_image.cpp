#include "io/images/encode_image.h"

#include "io/images/jpeg_errors.h"

#include <fmt/format.h>
#include <png.h>

#include <cstdlib>
#include <stdexcept>

namespace vcarve {

namespace {

class JpegWriter {
  public:
    JpegWriter() = default;
    JpegWriter(const JpegWriter&) = delete;
    JpegWriter& operator=(const JpegWriter&) = delete;
    ~JpegWriter()
    {
        jpeg_destroy_compress(&jpeg_);
        std::free(bytes_);
    }

    std::vector<std::uint8_t> encode(const Photograph& photo, int quality)
    {
        jpeg_.err = manager_of(errors_);
        const bool is_made = run_libjpeg(errors_, [&] {
            jpeg_create_compress(&jpeg_);
            jpeg_mem_dest(&jpeg_, &bytes_, &size_);
            declare(photo, quality);
            jpeg_start_compress(&jpeg_, TRUE);
            while (jpeg_.next_scanline < jpeg_.image_height) {
                const std::size_t begin = std::size_t{3} * photo.width_px * jpeg_.next_scanline;
                auto* row = const_cast<std::uint8_t*>(photo.rgb.data() + begin); // only read
                jpeg_write_scanlines(&jpeg_, &row, 1);
            }
            jpeg_finish_compress(&jpeg_);
        });
        if (!is_made) {
            throw std::runtime_error(
                fmt::format("libjpeg cannot write a JPEG: {}", errors_.message.data()));
        }
        return {bytes_, bytes_ + size_};
    }

  private:
    void declare(const Photograph& photo, int quality)
    {
        jpeg_.image_width = static_cast<JDIMENSION>(photo.width_px);
        jpeg_.image_height = static_cast<JDIMENSION>(photo.height_px);
        jpeg_.input_components = 3;
        jpeg_.in_color_space = JCS_RGB;
        jpeg_set_defaults(&jpeg_);
        jpeg_set_quality(&jpeg_, quality, TRUE);
        jpeg_.comp_info[0].h_samp_factor = 1;
        jpeg_.comp_info[0].v_samp_factor = 1;
    }

    JpegErrors errors_;
    jpeg_compress_struct jpeg_{};
    unsigned char* bytes_ = nullptr;
    unsigned long size_ = 0;
};

} // namespace

std::vector<std::uint8_t> encode_jpeg(const Photograph& photo, int quality)
{
    return JpegWriter().encode(photo, quality);
}

std::vector<std::uint8_t> encode_png(const Photograph& photo)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(photo.width_px);
    image.height = static_cast<png_uint_32>(photo.height_px);
    image.format = PNG_FORMAT_RGB;
    image.flags = PNG_IMAGE_FLAG_FAST;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::uint8_t> file(size);
    if (png_image_write_to_memory(&image, file.data(), &size, 0, photo.rgb.data(), 0, nullptr) ==
        0) {
        throw std::runtime_error(fmt::format("libpng cannot write a PNG: {}", image.message));
    }
    file.resize(size);
    return file;
}

} // namespace vcarve
