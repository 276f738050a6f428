#pragma once

// jpeglib.h needs what stdio declares, and the numbers in jerror.h depend on what jpeglib.h
// defines.
// clang-format off
#include <cstdio>
#include <jpeglib.h>
#include <jerror.h>
// clang-format on

#include <array>
#include <csetjmp>

namespace vcarve {

/// Where libjpeg goes with what it has to say, instead of the standard error and exit().
struct JpegErrors {
    jpeg_error_mgr manager{}; ///< first, so that libjpeg's pointer to it is one to this
    std::jmp_buf jump{};
    std::array<char, JMSG_LENGTH_MAX> message{};
};

[[noreturn]] inline void leave_libjpeg(j_common_ptr jpeg)
{
    auto* const errors = reinterpret_cast<JpegErrors*>(jpeg->err);
    jpeg->err->format_message(jpeg, errors->message.data());
    std::longjmp(errors->jump, 1); // NOLINT(cert-err52-cpp): no exception may pass through C
}

/// A warning counts as an error where pixels are missing. Others, such as bytes that nobody needs,
/// are found in files of many cameras.
inline void hear_libjpeg(j_common_ptr jpeg, int level)
{
    if (level >= 0) return;
    switch (jpeg->err->msg_code) {
    case JWRN_JPEG_EOF:
    case JWRN_HIT_MARKER:
    case JWRN_HUFF_BAD_CODE:
    case JWRN_ARITH_BAD_CODE:
    case JWRN_MUST_RESYNC:
        leave_libjpeg(jpeg);
    default:
        return;
    }
}

inline jpeg_error_mgr* manager_of(JpegErrors& errors)
{
    jpeg_std_error(&errors.manager);
    errors.manager.error_exit = leave_libjpeg;
    errors.manager.emit_message = hear_libjpeg;
    return &errors.manager;
}

/// Calls action(), which calls libjpeg and owns nothing, for it is left by a jump where libjpeg
/// fails: then the result is false.
template <typename Action>
bool libjpeg_does(JpegErrors& errors, const Action& action)
{
    if (setjmp(errors.jump) != 0) return false; // NOLINT(cert-err52-cpp)
    action();
    return true;
}

} // namespace vcarve
