#pragma once

#include <stdexcept>
#include <string>

namespace vcarve {

/// An error that the user can fix. The message is one sentence with the file, the place, the found
/// and the expected value. The program prints it and exits with the code of the class.
class Error : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The command line, an option or the output path is wrong. Exit code 2.
class UsageError : public Error {
  public:
    using Error::Error;
};

/// An input file is missing or broken, or has too little data for a surface. Exit code 3.
class InputError : public Error {
  public:
    using Error::Error;
};

/// The run stopped because Log::should_stop() returned true. It wrote nothing and freed all that it
/// allocated. Not an Error, because the user has nothing to fix.
class Cancelled : public std::runtime_error {
  public:
    /// `stage` is the running stage.
    explicit Cancelled(const std::string& stage)
        : std::runtime_error("stopped in stage " + stage + ", as requested")
    {
    }
};

} // namespace vcarve
