#pragma once

#include "compare/evidence.h"
#include "compare/reference.h"
#include "compare/truth.h"
#include "mesh/check.h"

#include <cstdint>
#include <optional>
#include <string>

namespace vcarve {

/// The resources that a program used to make a mesh, from start to end.
struct RunCost {
    double seconds = 0.0;
    double cpu_seconds = 0.0; ///< all threads, user and system
    std::int64_t peak_memory_bytes = 0;
};

/// The measurements of one mesh.
struct Comparison {
    std::string name;
    std::string failure;         ///< why there is no mesh; then other members are invalid
    std::optional<RunCost> cost; ///< if the mesh was made for the comparison
    MeshCheck size;
    std::optional<std::int64_t> genus; ///< see genus()
    EvidenceFigures evidence;
    std::optional<TruthFigures> truth; ///< if the reference has a truth
};

/// The number of handles, summed over connected components. Nothing if the surface is not closed,
/// manifold and consistently oriented, or has degenerate faces.
std::optional<std::int64_t> genus(const MeshCheck& check);

/// Calls make_reference() and add_closed_surface(), in the stages "reference" and "closed".
Reference complete_reference(Scene model, const NamedMesh* truth, const CompareOptions& options,
                             Log& log);

/// Measures a mesh, in the stage "measure". The figures are the same for any thread count. Throws
/// InputError if the mesh has no surface or is in another frame (see place_mesh()).
Comparison compare_mesh(const NamedMesh& named, const Reference& reference, Log& log);

} // namespace vcarve
