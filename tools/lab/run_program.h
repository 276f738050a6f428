#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <exception>
#include <span>
#include <string>

namespace vcarve {

/// What main() of a lab program does: `work` gets the words after the program's name, of which
/// there must be from `least` to `most`. Prints the usage, which begins with the program's name, or
/// the message of an exception.
template <typename Work>
int run_program(std::span<char*> words, const std::string& usage, std::size_t least,
                std::size_t most, const Work& work)
{
    const std::span<char*> given = words.subspan(1);
    if (given.size() < least || given.size() > most) {
        fmt::print(stderr, "usage: {}\n", usage);
        return 2;
    }
    try {
        work(given);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", usage.substr(0, usage.find(' ')), error.what());
        return 1;
    }
}

} // namespace vcarve
