#pragma once

#include <cstdint>

namespace vcarve {

/// What std::lround gives for numbers from 0 to 2^31 - 1, without its call.
inline std::int32_t round_half_up(double number)
{
    const auto whole = static_cast<std::int32_t>(number);
    return whole + (number - whole >= 0.5 ? 1 : 0);
}

} // namespace vcarve
