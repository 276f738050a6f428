#pragma once

#include <functional>
#include <string>

namespace vcarve::cli {

/// How a program ended.
struct Ending {
    int exit_code = 0;
    std::string sentence; ///< what went wrong; empty where nothing did, or memory is short
};

/// Calls main() and tells how it ended: 0 done, 1 internal error, 2 wrong usage or output, 3 wrong
/// input. From then on memory that is short where no exception may pass ends the program as
/// elsewhere.
Ending ending_of(const std::function<void()>& main);

/// Prints what went wrong as one line of stderr, "colmap-vcarve: ...", if anything did; returns the
/// exit code.
int report(const Ending& ending);

} // namespace vcarve::cli
