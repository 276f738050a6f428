#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <exception>
#include <span>
#include <string>

namespace vcarve {

/// The body of main() of a lab program. Calls `work` with the arguments, if there are `least` to
/// `most` of them; else prints the usage, which begins with the program's name. Prints the message
/// of an exception.
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
