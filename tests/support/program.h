#pragma once

#include "support/places.h"
#include "support/subprocess.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace vcarve {

/// The words that run colmap-vcarve with these arguments.
inline std::vector<std::string> program_with(std::vector<std::string> arguments)
{
    arguments.insert(arguments.begin(), built_program());
    return arguments;
}

inline Outcome run_program(const std::vector<std::string>& arguments)
{
    return Subprocess(program_with(arguments)).wait();
}

/// Expects that a run failed with this code and nothing on stdout, and gives its sentence.
inline std::string sentence_of_run(int exit_code, const Outcome& outcome)
{
    EXPECT_EQ(outcome.exit_code, exit_code);
    EXPECT_THAT(outcome.out, ::testing::IsEmpty());
    return outcome.err;
}

/// The same of a run of the program.
inline std::string sentence_of(int exit_code, const std::vector<std::string>& arguments)
{
    return sentence_of_run(exit_code, run_program(arguments));
}

} // namespace vcarve
