#pragma once

#include "vcarve/log.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace vcarve {

/// How meshes are measured. No length is in scene units.
struct CompareOptions {
    int samples = 400000;  ///< points sampled on each mesh and on the truth
    int seed = 1;          ///< where the sampling starts
    double spacings = 3.0; ///< how near is near, in point spacings
};

/// A mesh and what to call it: the file's name in tables and messages.
struct NamedMesh {
    std::string name; ///< heads the mesh's column of the table
    TriMesh mesh;     ///< in the frame of the model
};

/// What was measured of meshes.
struct ComparisonReport {
    /// Of each mesh, in the order they were given, its figures by their place in the JSON text:
    /// "/views/hidden_sights", "/size/faces", "/truth/blocked". docs/results.md explains them.
    std::vector<std::map<std::string, double>> figures;
    std::string table; ///< a Markdown table, a row a figure and a column a mesh, and what they mean
    std::string json;  ///< the same as JSON text
};

/// Measures meshes by how they fit the views of a model, and by the true surface where it is known:
/// `truth` may be null. The same input gives the same figures for any number of threads. Runs as
/// the stages "reference", those of reconstruct() for the model's closed surface, and "measure" for
/// each mesh. Throws UsageError where an option is out of its range, InputError where a mesh or the
/// truth has no surface or lies in another frame than the model, or the model has fewer than two
/// points that two views saw, and Cancelled.
ComparisonReport compare(const Scene& model, std::span<const NamedMesh> meshes,
                         const NamedMesh* truth, const CompareOptions& options, Log& log);

} // namespace vcarve
