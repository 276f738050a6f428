#pragma once

#include "vcarve/log.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace vcarve {

/// Options of compare(). No length is in scene units.
struct CompareOptions {
    int samples = 400000;  ///< number of points sampled on each mesh and on the truth
    int seed = 1;          ///< seed of the sampling
    double spacings = 3.0; ///< distance tolerance, in point spacings
};

/// A mesh with a name for tables and messages, usually the file name.
struct NamedMesh {
    std::string name; ///< column heading of the table
    TriMesh mesh;     ///< in the frame of the model
};

/// The measurements of meshes.
struct ComparisonReport {
    /// The figures of each mesh, in the order of the arguments. Keys are JSON pointers, such as
    /// "/views/hidden_rays", "/size/faces", "/truth/blocked". docs/results.md explains them.
    std::vector<std::map<std::string, double>> figures;
    std::string table; ///< Markdown: one row per figure, one column per mesh, and a legend
    std::string json;  ///< the same as JSON text
};

/// Compares meshes with the views of a model, and with the true surface unless `truth` is null. The
/// figures are the same for any thread count. The stages are "reference", those of reconstruct()
/// for the model's closed surface, and "measure" for each mesh. Throws UsageError if an option is
/// out of range. Throws InputError if a mesh or the truth has no surface or is in another frame
/// than the model, or if the model has fewer than two points with two views. Throws Cancelled.
ComparisonReport compare(const Scene& model, std::span<const NamedMesh> meshes,
                         const NamedMesh* truth, const CompareOptions& options, Log& log);

} // namespace vcarve
