#pragma once

#include "cli/mesh_arguments.h"
#include "run/job.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::cli {

/// What the file of a surface says of how it was made: the program, the digest of the scene that
/// was read, and the options that differ from the defaults and count for what was made of it.
/// Neither where files lie nor what leaves the bytes as they are, such as threads: equal runs write
/// equal files.
std::vector<std::string> record_comments(const MeshArguments& arguments, const Digest& scene);

/// What the file of a surface says, as the command that makes it again. Throws InputError where it
/// says nothing; STL has no room for it.
std::string replay_text(const std::filesystem::path& surface);

} // namespace vcarve::cli
