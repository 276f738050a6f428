#pragma once

#include "support/places.h"
#include "support/subprocess.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace vcarve {

/// The command line of colmap-vcarve with these arguments.
inline std::vector<std::string> program_with(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), built_program());
    return arguments;
}

inline Outcome run_program(const std::vector<std::string>& arguments)
{
    return Subprocess(program_with(arguments)).wait();
}

/// Expects this exit code and nothing on stdout. Returns the error message.
inline std::string sentence_of_run(int exit_code, const Outcome& outcome)
{
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_THAT(outcome.out, ::testing::IsEmpty());
    return outcome.err;
}

/// Runs the program, and does the same.
inline std::string sentence_of(int exit_code, const std::vector<std::string>& arguments)
{
    return sentence_of_run(exit_code, run_program(arguments));
}

} // namespace vcarve
