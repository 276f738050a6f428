#pragma once

#include <string>

namespace vcarve {

/// What this build was made from. Libraries are those it was compiled with, oneTBB the one that
/// runs.
struct Versions {
    std::string program;    ///< "0.3.0"
    std::string git;        ///< state of the source tree: "v0.3.0-3-g1a2b3c4"; empty in a tarball
    std::string build_type; ///< "Release"
    std::string compiler;   ///< "GNU 12.2.0"
    std::string cgal;
    std::string openmesh;
    std::string eigen;
    std::string tbb;
};
Versions versions();

/// "0.3.0", or "0.3.0 (v0.3.0-3-g1a2b3c4)" where the state of the source tree is known.
std::string program_version();

} // namespace vcarve
