#pragma once

#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "vcarve/scene.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <filesystem>

namespace vcarve::bench {

/// Intermediate results of a run, computed on first use and cached, for a surface sampled with
/// `points` points. If `points` is 0, they are those of the binary COLMAP model in the environment
/// variable VCARVE_MODEL.
const std::filesystem::path& sample_folder(std::int64_t points); ///< the model on disk
const Scene& sample_scene(std::int64_t points);                  ///< filtered
const TetMesh& sample_cells(std::int64_t points);
const FlowNetwork& sample_network(std::int64_t points);

/// Sets the sizes of a benchmark. CPU time is that of all threads, because it is more stable than
/// elapsed time on a busy machine. Rates use CPU time unless the benchmark sets UseRealTime.
void sample_sizes(benchmark::internal::Benchmark* bench);

} // namespace vcarve::bench
