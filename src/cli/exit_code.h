#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace vcarve::cli {

/// How a program ended.
struct Ending {
    int exit_code = 0;
    std::string sentence; ///< the error; empty if there is none, or if memory is short
};

/// Calls main() and returns how it ended: 0 success, 1 internal error, 2 wrong usage or output, 3
/// wrong input. Out of memory also ends the program cleanly where no exception may pass.
Ending ending_of(const std::function<void()>& main);

/// Prints an error as one line on stderr, "colmap-vcarve: ...". Returns the exit code.
int report(const Ending& ending);

/// From now on SIGINT, SIGTERM and SIGHUP end the program with exit code 128 + signal, after
/// removing the files and then empty folders in `unfinished`, in that order, if they exist. A
/// second call replaces the list. A crash is reported in a sentence, exit code 1; a mapped input
/// that was shortened, exit code 3. Ignores SIGPIPE and SIGXFSZ: a closed stderr does not end a
/// run, and a file at the size limit fails as on a full disk.
void end_cleanly_on_signals(const std::vector<std::filesystem::path>& unfinished);

/// Removes the files of end_cleanly_on_signals(). Safe in a signal handler.
void remove_unfinished();

/// Opens /dev/null for closed standard streams (`2>&-`): otherwise the next file would get their
/// number, and messages would go into it.
void hold_standard_streams();

} // namespace vcarve::cli
