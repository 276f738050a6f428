#pragma once

#include <string>

namespace vcarve {

/// The versions of this build. Library versions are those at compile time; oneTBB's is that at run
/// time.
struct Versions {
    std::string program;    ///< "0.3.0"
    std::string git;        ///< git describe: "v0.3.0-3-g1a2b3c4"; empty in a tarball
    std::string build_type; ///< "Release"
    std::string compiler;   ///< "GNU 12.2.0"
    std::string cgal;
    std::string openmesh;
    std::string eigen;
    std::string tbb;
};
Versions versions();

/// Returns "0.3.0", or "0.3.0 (v0.3.0-3-g1a2b3c4)" if git's description is known.
std::string program_version();

} // namespace vcarve
