#pragma once

#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "vcarve/scene.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <filesystem>

namespace vcarve::bench {

/// What the passes of a run hand on to one another, made when first asked for and kept: for a
/// surface sampled with so many points, or where that is 0 for the binary COLMAP model that the
/// environment's VCARVE_MODEL names.
const std::filesystem::path& sample_folder(std::int64_t points); ///< the model on disk
const Scene& sample_scene(std::int64_t points);                  ///< filtered
const TetMesh& sample_cells(std::int64_t points);
const FlowNetwork& sample_network(std::int64_t points);

/// The sizes that every benchmark is run with. CPU time is that of all threads: on a busy machine
/// it compares better than the time on the wall. Rates count it, unless the benchmark says
/// UseRealTime.
void sample_sizes(benchmark::internal::Benchmark* bench);

} // namespace vcarve::bench
