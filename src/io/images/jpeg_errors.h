#pragma once

// jpeglib.h needs declarations of stdio, and the message codes in jerror.h depend on macros of
// jpeglib.h.
// clang-format off
#include <cstdio>
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include <array>
#include <csetjmp>

namespace vcarve {

/// Receives the errors of libjpeg, which otherwise prints to the standard error and calls exit().
struct JpegErrors {
    jpeg_error_mgr manager{}; ///< must be first, because its address is cast to JpegErrors*
    std::jmp_buf jump{};
    std::array<char, JMSG_LENGTH_MAX> message{};
};

[[noreturn]] inline void jump_on_libjpeg_error(j_common_ptr jpeg)
{
    auto* const errors = reinterpret_cast<JpegErrors*>(jpeg->err);
    jpeg->err->format_message(jpeg, errors->message.data());
    std::longjmp(errors->jump, 1); // NOLINT(cert-err52-cpp): no exception may pass through C
}

/// Treats warnings about missing pixels as errors. Files of many cameras cause other warnings, for
/// example about superfluous bytes.
inline void handle_libjpeg_message(j_common_ptr jpeg, int level)
{
    if (level >= 0) return;
    switch (jpeg->err->msg_code) {
    case JWRN_JPEG_EOF:
    case JWRN_HIT_MARKER:
    case JWRN_HUFF_BAD_CODE:
    case JWRN_ARITH_BAD_CODE:
    case JWRN_MUST_RESYNC:
        jump_on_libjpeg_error(jpeg);
    default:
        return;
    }
}

inline jpeg_error_mgr* manager_of(JpegErrors& errors)
{
    jpeg_std_error(&errors.manager);
    errors.manager.error_exit = jump_on_libjpeg_error;
    errors.manager.emit_message = handle_libjpeg_message;
    return &errors.manager;
}

/// Calls action(), which calls libjpeg. Returns false if libjpeg fails. action() must own nothing,
/// because an error leaves it by longjmp.
template <typename Action>
bool run_libjpeg(JpegErrors& errors, const Action& action)
{
    if (setjmp(errors.jump) != 0) return false; // NOLINT(cert-err52-cpp)
    action();
    return true;
}

} // namespace vcarve
