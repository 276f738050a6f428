#include "io/images/decoders.h"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstring>
#include <vector>

namespace vcarve {

namespace {

/// The state of libpng calls: unread bytes, and the jump target and message of an error.
struct PngState {
    std::span<const std::uint8_t> rest;
    std::jmp_buf jump{};
    std::array<char, 128> message{};
};

[[noreturn]] void leave_libpng(png_structp png, png_const_charp message)
{
    auto* const state = static_cast<PngState*>(png_get_error_ptr(png));
    std::strncpy(state->message.data(), message, state->message.size() - 1);
    std::longjmp(state->jump, 1); // NOLINT(cert-err52-cpp): no exception may pass through C
}

void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

void give_bytes(png_structp png, png_bytep to, std::size_t count)
{
    auto* const state = static_cast<PngState*>(png_get_io_ptr(png));
    if (count > state->rest.size()) leave_libpng(png, "the file is truncated");
    std::memcpy(to, state->rest.data(), count);
    state->rest = state->rest.subspan(count);
}

/// Decodes a PNG. The constructor reads its header.
class PngReader {
  public:
    explicit PngReader(const ImageFile& file)
        : file_(file),
          png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &state_, leave_libpng, ignore_warning))
    {
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) throw std::bad_alloc();
        state_.rest = file.bytes;
        png_set_read_fn(png_, &state_, give_bytes);
        if (libpng_does([&] { png_read_info(png_, info_); })) return;
        destroy();
        refuse_image(file_, "PNG", state_.message.data());
    }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { destroy(); }

    PhotographSize size() const
    {
        return checked_size(file_, png_get_image_width(png_, info_),
                            png_get_image_height(png_, info_));
    }

    Photograph decode()
    {
        Photograph photo = blank_photograph(size());
        const bool has_alpha = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0 ||
                               png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
        const std::size_t row_bytes = std::size_t{has_alpha ? 4U : 3U} * photo.width_px;
        std::vector<std::uint8_t> pixels(has_alpha ? row_bytes * photo.height_px : 0);
        std::uint8_t* const rows = has_alpha ? pixels.data() : photo.rgb.data();
        const bool is_whole = libpng_does([&] {
            png_set_expand(png_);
            png_set_scale_16(png_);
            png_set_gray_to_rgb(png_);
            const int passes = png_set_interlace_handling(png_);
            png_read_update_info(png_, info_);
            for (int pass = 0; pass < passes; ++pass) {
                for (int y = 0; y < photo.height_px; ++y) {
                    png_read_row(png_, rows + y * row_bytes, nullptr);
                }
            }
            png_read_end(png_, nullptr);
        });
        if (!is_whole) refuse_image(file_, "PNG", state_.message.data());
        if (has_alpha) split_alpha(pixels.data(), photo);
        return photo;
    }

  private:
    /// Calls action(), which calls libpng. Returns false if libpng fails. action() must own
    /// nothing, because an error leaves it by longjmp.
    template <typename Action>
    bool libpng_does(const Action& action)
    {
        if (setjmp(state_.jump) != 0) return false; // NOLINT(cert-err52-cpp)
        action();
        return true;
    }

    void destroy() { png_destroy_read_struct(&png_, &info_, nullptr); }

    const ImageFile& file_;
    PngState state_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

} // namespace

PhotographSize png_size(const ImageFile& file)
{
    return PngReader(file).size();
}

Photograph decode_png(const ImageFile& file)
{
    return PngReader(file).decode();
}

} // namespace vcarve
