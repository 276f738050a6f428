#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace vcarve {

/// 24310 -> "24,310"
inline std::string grouped_digits(std::int64_t number)
{
    const std::string digits = std::to_string(number);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        const bool begins_group = (digits.size() - i) % 3 == 0;
        if (begins_group && i > 0 && digits[i - 1] != '-') text.push_back(',');
        text.push_back(digits[i]);
    }
    return text;
}

} // namespace vcarve
