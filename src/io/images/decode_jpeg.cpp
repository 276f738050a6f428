#include "io/images/decoders.h"
#include "io/images/jpeg_errors.h"

namespace vcarve {

namespace {

/// Decodes a JPEG. The constructor reads its header.
class JpegReader {
  public:
    explicit JpegReader(const ImageFile& file) : file_(file)
    {
        jpeg_.err = manager_of(errors_);
        const bool is_read = run_libjpeg(errors_, [&] {
            jpeg_create_decompress(&jpeg_);
            jpeg_mem_src(&jpeg_, file_.bytes.data(), file_.bytes.size());
            jpeg_read_header(&jpeg_, TRUE);
        });
        if (is_read) return;
        jpeg_destroy_decompress(&jpeg_);
        refuse_image(file_, "JPEG", errors_.message.data());
    }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;
    ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }

    PhotographSize size() const
    {
        return checked_size(file_, jpeg_.image_width, jpeg_.image_height);
    }

    Photograph decode()
    {
        Photograph photo = blank_photograph(size());
        const bool has_inks =
            jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK;
        jpeg_.out_color_space = has_inks ? JCS_CMYK : JCS_RGB;
        const std::size_t row_bytes = std::size_t{3} * photo.width_px;
        std::vector<std::uint8_t> inks(has_inks ? std::size_t{4} * photo.width_px : 0);
        const bool is_whole = run_libjpeg(errors_, [&] {
            jpeg_start_decompress(&jpeg_);
            while (jpeg_.output_scanline < jpeg_.output_height) {
                std::uint8_t* const row = photo.rgb.data() + jpeg_.output_scanline * row_bytes;
                std::uint8_t* read = has_inks ? inks.data() : row;
                jpeg_read_scanlines(&jpeg_, &read, 1);
                if (has_inks) mix(inks, row);
            }
        });
        if (!is_whole) refuse_image(file_, "JPEG", errors_.message.data());
        return photo;
    }

  private:
    /// Converts a row of CMYK to RGB. Adobe's programs write a marker and store inverted values.
    void mix(const std::vector<std::uint8_t>& inks, std::uint8_t* row) const
    {
        const int full = jpeg_.saw_Adobe_marker != 0 ? 0 : 255;
        const auto light = [&](std::size_t i) { return std::abs(full - inks[i]); };
        for (std::size_t i = 0; i < inks.size(); i += 4) {
            for (std::size_t k = 0; k < 3; ++k) {
                *row++ = static_cast<std::uint8_t>((light(i + k) * light(i + 3) + 127) / 255);
            }
        }
    }

    const ImageFile& file_;
    JpegErrors errors_;
    jpeg_decompress_struct jpeg_{};
};

} // namespace

PhotographSize jpeg_size(const ImageFile& file)
{
    return JpegReader(file).size();
}

Photograph decode_jpeg(const ImageFile& file)
{
    return JpegReader(file).decode();
}

} // namespace vcarve
