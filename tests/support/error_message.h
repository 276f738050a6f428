#pragma once

#include "base/error.h"

#include <gtest/gtest.h>

#include <string>

namespace vcarve {

/// The message of the InputError that `action` throws; anything else fails the test.
template <typename Action>
std::string input_error(const Action& action)
{
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << "no InputError was thrown";
    return {};
}

} // namespace vcarve
