#pragma once

#include <stdexcept>
#include <string>

namespace vcarve {

/// Anything the user can mend. The message is one sentence that names the file, the place, what was
/// found and what was expected; the program prints it and exits with the class's code.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The command line, an option or the output path is wrong: exit code 2.
class UsageError : public Error {
  public:
    using Error::Error;
};

/// An input file is missing, broken, or holds too little for a surface: exit code 3.
class InputError : public Error {
  public:
    using Error::Error;
};

/// The run was stopped because its Log wanted so (Log::wants_stop). It has written nothing, and
/// everything it allocated is freed. Not an Error: there is nothing to mend.
class Cancelled : public std::runtime_error {
  public:
    /// The stage that was running.
    explicit Cancelled(const std::string& stage)
        : std::runtime_error("stopped in stage " + stage + ", as was asked for")
    {
    }
};

} // namespace vcarve
