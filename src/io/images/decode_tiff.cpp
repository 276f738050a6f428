#include "io/images/decoders.h"

#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>

namespace vcarve {

namespace {

/// A file in memory as libtiff reads it, and the first thing that it complains of.
struct TiffState {
    std::span<const std::uint8_t> bytes;
    std::size_t at = 0;
    std::array<char, 1024> message{}; ///< as long as TIFFRGBAImageBegin() wants it
};

TiffState& state_of(thandle_t handle)
{
    return *static_cast<TiffState*>(handle);
}

tmsize_t read_bytes(thandle_t handle, void* to, tmsize_t count)
{
    TiffState& state = state_of(handle);
    const std::size_t rest = state.bytes.size() - std::min(state.at, state.bytes.size());
    const std::size_t given = std::min(static_cast<std::size_t>(count), rest);
    if (given > 0) std::memcpy(to, state.bytes.data() + state.at, given);
    state.at += given;
    return static_cast<tmsize_t>(given);
}

tmsize_t write_nothing(thandle_t /*handle*/, void* /*from*/, tmsize_t /*count*/)
{
    return -1;
}

toff_t seek(thandle_t handle, toff_t offset, int whence)
{
    TiffState& state = state_of(handle);
    const std::size_t begin = whence == SEEK_CUR   ? state.at
                              : whence == SEEK_END ? state.bytes.size()
                                                   : 0;
    return state.at = begin + offset;
}

int close(thandle_t /*handle*/)
{
    return 0;
}

toff_t size_of(thandle_t handle)
{
    return state_of(handle).bytes.size();
}

int give_all(thandle_t handle, void** begin, toff_t* size)
{
    *begin = const_cast<std::uint8_t*>(state_of(handle).bytes.data()); // it only reads
    *size = size_of(handle);
    return 1;
}

void forget_all(thandle_t /*handle*/, void* /*begin*/, toff_t /*size*/) {}

int hear_error(TIFF* /*tiff*/, void* handle, const char* /*module*/, const char* format,
               va_list arguments)
{
    auto& message = state_of(handle).message;
    if (message[0] == '\0') std::vsnprintf(message.data(), message.size(), format, arguments);
    return 1;
}

int ignore_warning(TIFF* /*tiff*/, void* /*handle*/, const char* /*module*/, const char* /*format*/,
                   va_list /*arguments*/)
{
    return 1;
}

using OpenTiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

OpenTiff open_tiff(TiffState& state)
{
    const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(
        TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), hear_error, &state);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignore_warning, &state);
    return {TIFFClientOpenExt("", "r", &state, read_bytes, write_nothing, seek, close, size_of,
                              give_all, forget_all, options.get()),
            TIFFClose};
}

/// A TIFF whose header is read.
class TiffReader {
  public:
    explicit TiffReader(const ImageFile& file)
        : file_(file), state_{file.bytes}, tiff_(open_tiff(state_))
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
        const PhotographSize expected = size();
        keep_from_multiplying_by_alpha();
        TIFFRGBAImage image{};
        if (TIFFRGBAImageOK(tiff_.get(), state_.message.data()) == 0 ||
            TIFFRGBAImageBegin(&image, tiff_.get(), 1, state_.message.data()) == 0) {
            refuse();
        }
        const std::unique_ptr<TIFFRGBAImage, decltype(&TIFFRGBAImageEnd)> end(&image,
                                                                              TIFFRGBAImageEnd);
        image.orientation = image.req_orientation = ORIENTATION_TOPLEFT; // as rows are stored
        Photograph photo = blank_photograph(expected);
        const int band_px = std::min(rows_at_once(), photo.height_px);
        std::vector<std::uint32_t> band(static_cast<std::size_t>(band_px) * photo.width_px);
        for (int y = 0; y < photo.height_px; y += band_px) {
            const int height_px = std::min(band_px, photo.height_px - y);
            image.row_offset = y;
            if (TIFFRGBAImageGet(&image, band.data(), static_cast<std::uint32_t>(photo.width_px),
                                 static_cast<std::uint32_t>(height_px)) == 0) {
                refuse();
            }
            put({band.data(), static_cast<std::size_t>(height_px) * photo.width_px},
                photo.rgb.data() + std::size_t{3} * y * photo.width_px);
        }
        return photo;
    }

  private:
    static void put(std::span<const std::uint32_t> pixels, std::uint8_t* to)
    {
        for (const std::uint32_t pixel : pixels) {
            *to++ = static_cast<std::uint8_t>(TIFFGetR(pixel));
            *to++ = static_cast<std::uint8_t>(TIFFGetG(pixel));
            *to++ = static_cast<std::uint8_t>(TIFFGetB(pixel));
        }
    }

    /// Says of channels beside the colours that these are multiplied by them already.
    void keep_from_multiplying_by_alpha()
    {
        std::uint16_t count = 0;
        std::uint16_t* kinds = nullptr;
        TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds);
        std::vector<std::uint16_t> done(count, EXTRASAMPLE_ASSOCALPHA);
        if (count > 0) TIFFSetField(tiff_.get(), TIFFTAG_EXTRASAMPLES, count, done.data());
    }

    /// Whole strips or tiles, some 64 rows, since no strip is decoded in parts.
    int rows_at_once() const
    {
        std::uint32_t rows = 0;
        TIFFGetFieldDefaulted(
            tiff_.get(), TIFFIsTiled(tiff_.get()) != 0 ? TIFFTAG_TILELENGTH : TIFFTAG_ROWSPERSTRIP,
            &rows);
        constexpr std::uint32_t kMost = std::numeric_limits<int>::max();
        rows = std::clamp(rows, 1U, kMost);
        return static_cast<int>(rows < 64 ? 64 / rows * rows : rows);
    }

    [[noreturn]] void refuse() const { refuse_image(file_, "TIFF", state_.message.data()); }

    const ImageFile& file_;
    TiffState state_;
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
