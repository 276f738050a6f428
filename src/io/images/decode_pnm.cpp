#include "io/images/decoders.h"

#include <fmt/format.h>

#include <cctype>
#include <cstddef>
#include <cstdint>

namespace vcarve {

namespace {

constexpr const char* kPortableMap = "PPM or PGM";

/// Reads the numbers after P5 or P6, between which comments are allowed (netpbm's pgm and ppm).
class PnmHeader {
  public:
    explicit PnmHeader(const ImageFile& file) : file_(file)
    {
        const std::uint64_t width_px = number();
        const std::uint64_t height_px = number();
        size = checked_size(file, width_px, height_px);
        largest = number();
        if (largest < 1 || largest > 0xffff) refuse_image(file, kPortableMap, "no maximum value");
        ++begin; // white space
        samples = std::size_t{1} * size.width_px * size.height_px * (file.bytes[1] == '6' ? 3 : 1);
        const std::size_t needed = samples * (largest > 0xff ? 2 : 1);
        if (begin > file.bytes.size() || file.bytes.size() - begin < needed) {
            refuse_image(file, kPortableMap, fmt::format("fewer than {} bytes of pixels", needed));
        }
    }

    PhotographSize size;
    std::uint64_t largest = 0;
    std::size_t begin = 2; ///< offset of the pixels
    std::size_t samples = 0;

  private:
    std::uint8_t at() const { return begin < file_.bytes.size() ? file_.bytes[begin] : 0; }

    std::uint64_t number()
    {
        while (std::isspace(at()) != 0 || at() == '#') {
            const bool is_comment = at() == '#';
            while (is_comment && at() != '\n' && at() != 0) {
                ++begin;
            }
            ++begin;
        }
        std::uint64_t value = 0;
        if (std::isdigit(at()) == 0) refuse_image(file_, kPortableMap, "no size or maximum value");
        for (; std::isdigit(at()) != 0 && value < (std::uint64_t{1} << 32U); ++begin) {
            value = 10 * value + (at() - '0');
        }
        return value;
    }

    const ImageFile& file_;
};

} // namespace

PhotographSize pnm_size(const ImageFile& file)
{
    return PnmHeader(file).size;
}

Photograph decode_pnm(const ImageFile& file)
{
    const PnmHeader header(file);
    Photograph photograph = blank_photograph(header.size);
    const std::size_t bytes = header.largest > 0xff ? 2 : 1;
    const std::size_t copies = photograph.rgb.size() / header.samples; // 3 for a gray value
    for (std::size_t i = 0; i < header.samples; ++i) {
        const std::uint8_t* const at = file.bytes.data() + header.begin + bytes * i;
        const std::uint64_t value = bytes == 2 ? 256U * at[0] + at[1] : at[0];
        const std::uint64_t scaled = (255 * value + header.largest / 2) / header.largest;
        for (std::size_t k = 0; k < copies; ++k) {
            photograph.rgb[copies * i + k] = static_cast<std::uint8_t>(scaled < 255 ? scaled : 255);
        }
    }
    return photograph;
}

} // namespace vcarve
