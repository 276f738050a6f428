#pragma once

#include <filesystem>
#include <vector>

namespace vcarve::cli {

/// From now on SIGINT, SIGTERM and SIGHUP end the program at once with exit code 128 + signal,
/// after removing the files, and the folders that are empty by then, in `unfinished`, whether they
/// exist or not, in that order. A second call replaces the list. A crash is reported
/// in a sentence, exit code 1; one by a mapped file that can be read no more names it, exit code 3:
/// somebody shortened it. Also ignores SIGPIPE: a reader
/// that leaves stderr does not end a run; and SIGXFSZ: a file that reaches the limit of its size
/// fails to be written as where the disk is full.
void end_cleanly_on_signals(const std::vector<std::filesystem::path>& unfinished);

/// Removes what end_cleanly_on_signals() was told of. Safe in a handler.
void remove_unfinished();

/// Holds the places of standard streams that are closed, as `2>&-` leaves them: else the next file
/// that is opened takes the place, and what is printed goes into it.
void hold_standard_streams();

} // namespace vcarve::cli
