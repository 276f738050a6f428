#include "io/images/decoders.h"

#include <tiffio.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <memory>
#include <vector>

namespace vcarve {

namespace {

using Message = std::array<char, 1024>; ///< size required by TIFFRGBAImageBegin()

/// Keeps the first error.
int on_error(TIFF* /*tiff*/, void* handle, const char* /*module*/, const char* format,
             va_list arguments)
{
    Message& message = *static_cast<Message*>(handle);
    if (message[0] == '\0') std::vsnprintf(message.data(), message.size(), format, arguments);
    return 1;
}

int drop_tiff_warning(TIFF* /*tiff*/, void* /*handle*/, const char* /*module*/,
                      const char* /*format*/, va_list /*arguments*/)
{
    return 1;
}

using OpenTiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

OpenTiff open_tiff(const char* path, Message& message)
{
    const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
        TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, &message);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), drop_tiff_warning, &message);
    return {TIFFOpenExt(path, "r", options.get()), TIFFClose};
}

/// Decodes a TIFF. The constructor reads its header.
class TiffReader {
  public:
    explicit TiffReader(const ImageFile& file)
        : file_(file), tiff_(open_tiff(file.path.c_str(), message_))
    {
        if (!tiff_) refuse();
    }

    PhotographSize size() const
    {
        std::uint32_t width_px = 0;
        std::uint32_t height_px = 0;
        TIFFGetField(tiff_.get(), TIFFTAG_IMAGEWIDTH, &width_px);
        TIFFGetField(tiff_.get(), TIFFTAG_IMAGELENGTH, &height_px);
        return checked_size(file_, width_px, height_px);
    }

    Photograph decode()
    {
        Photograph photo = blank_photograph(size());
        const bool has_alpha = keep_from_multiplying_by_alpha();
        TIFFSetField(tiff_.get(), TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT); // rows as stored
        std::vector<std::uint32_t> pixels(photo.rgb.size() / 3);
        if (TIFFReadRGBAImageOriented(tiff_.get(), static_cast<std::uint32_t>(photo.width_px),
                                      static_cast<std::uint32_t>(photo.height_px), pixels.data(),
                                      ORIENTATION_TOPLEFT, 1) == 0) {
            refuse();
        }
        auto to = photo.rgb.begin();
        for (const std::uint32_t pixel : pixels) {
            *to++ = static_cast<std::uint8_t>(TIFFGetR(pixel));
            *to++ = static_cast<std::uint8_t>(TIFFGetG(pixel));
            *to++ = static_cast<std::uint8_t>(TIFFGetB(pixel));
            if (has_alpha) photo.alpha.push_back(static_cast<std::uint8_t>(TIFFGetA(pixel)));
        }
        drop_opaque_alpha(photo);
        return photo;
    }

  private:
    /// Marks all extra channels as premultiplied alpha, so that libtiff does not change colors.
    /// Returns whether the first one is alpha.
    bool keep_from_multiplying_by_alpha()
    {
        std::uint16_t count = 0;
        std::uint16_t* kinds = nullptr;
        TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds);
        const bool has_alpha = count > 0 && kinds[0] != EXTRASAMPLE_UNSPECIFIED;
        std::vector<std::uint16_t> done(count, EXTRASAMPLE_ASSOCALPHA);
        if (count > 0) TIFFSetField(tiff_.get(), TIFFTAG_EXTRASAMPLES, count, done.data());
        return has_alpha;
    }

    [[noreturn]] void refuse() const { refuse_image(file_, "TIFF", message_.data()); }

    const ImageFile& file_;
    Message message_{};
    OpenTiff tiff_;
};

} // namespace

PhotographSize tiff_size(const ImageFile& file)
{
    return TiffReader(file).size();
}

Photograph decode_tiff(const ImageFile& file)
{
    return TiffReader(file).decode();
}

} // namespace vcarve
