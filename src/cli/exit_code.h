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
/// wrong input. Lack of memory also ends the program cleanly where exceptions cannot propagate.
Ending ending_of(const std::function<void()>& main);

/// Prints an error as one line on stderr, "colmap-vcarve: ...". Returns the exit code.
int report(const Ending& ending);

/// Makes SIGINT, SIGTERM and SIGHUP end the program with exit code 128 + signal, after removing the
/// files in `unfinished`, and the folders with their files, if they exist. A second call replaces
/// the list. A crash prints one sentence and exits with 1, or with 3 if a mapped input was
/// truncated. Ignores SIGPIPE and SIGXFSZ: a closed stderr does not end a run, and a file at the
/// size limit fails as on a full disk.
void end_cleanly_on_signals(const std::vector<std::filesystem::path>& unfinished);

/// Removes the files of end_cleanly_on_signals(). Async-signal-safe.
void remove_unfinished();

/// Opens /dev/null for closed standard streams (`2>&-`). Otherwise the next opened file would get
/// their descriptor, and messages would be written to it.
void open_standard_streams();

/// Limits the threads of the process, until it ends; 0 allows all.
void limit_threads(int threads);

} // namespace vcarve::cli
