#include "measurements.h"

#include "base/process_usage.h"
#include "base/stage_counts.h"
#include "cli/run_record.h"
#include "io/files/mapped_file.h"
#include "pipeline/memory.h"
#include "pipeline/scene_run.h"
#include "vcarve/io.h"
#include "vcarve/reconstruct.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/Triangulation_vertex_base_3.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace vcarve::bench {

namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// CGAL's triangulation as in its manual, without our code.
template <typename Concurrency>
using BareDelaunay = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_3<Kernel>,
                                                 CGAL::Delaunay_triangulation_cell_base_3<Kernel>,
                                                 Concurrency>>;

std::vector<Kernel::Point_3> cgal_points(const std::vector<Eigen::Vector3d>& points)
{
    std::vector<Kernel::Point_3> result;
    result.reserve(points.size());
    for (const Eigen::Vector3d& p : points) {
        result.emplace_back(p.x(), p.y(), p.z());
    }
    return result;
}

/// Time since construction, and the peak of memory above the memory in use at construction.
class Meter {
  public:
    Meter() : base_bytes_(begin_peak()), began_(process_usage()) {}

    std::int64_t base_bytes() const { return base_bytes_; }
    std::int64_t above_base(std::int64_t peak_bytes) const { return peak_bytes - base_bytes_; }

    Json json() const
    {
        const ProcessUsage now = process_usage();
        return {{"seconds", now.seconds - began_.seconds},
                {"cpu_seconds", now.cpu_seconds - began_.cpu_seconds},
                {"peak_bytes", above_base(peak_memory_bytes())}};
    }

  private:
    static std::int64_t begin_peak()
    {
        if (!reset_peak_memory()) {
            throw std::runtime_error("cannot reset the peak of memory: this system does not "
                                     "accept 5 in /proc/self/clear_refs");
        }
        return peak_memory_bytes();
    }

    std::int64_t base_bytes_;
    ProcessUsage began_;
};

std::vector<Vector3d> read_raw_points(const std::filesystem::path& path)
{
    const MappedFile file(path);
    std::vector<Vector3d> points(file.bytes().size() / sizeof(Vector3d));
    std::memcpy(points.data()->data(), file.bytes().data(), points.size() * sizeof(Vector3d));
    return points;
}

void write_raw_points(const std::filesystem::path& path, const std::vector<Vector3d>& points)
{
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(points.data()),
               static_cast<std::streamsize>(points.size() * sizeof(Vector3d)));
    file.close();
    if (!file) throw std::runtime_error("cannot write " + path.string());
}

tbb::global_control limit_of(int threads)
{
    return tbb::global_control(tbb::global_control::max_allowed_parallelism,
                               static_cast<std::size_t>(threads));
}

/// The sizes of a run, and the points that it triangulated.
struct Run {
    RunSize size;
    std::vector<Vector3d> triangulated;
};

Run make_surface(const Sample& sample, int threads, Log& log)
{
    Options options;
    options.threads = threads;
    ReadModel input = read_found_model(find_input(sample.model, {}), log,
                                       {.gather = thin_while_reading(options.thin)});
    RunSize size = size_before_thinning(input.read, options);
    size.thinned = size_of(input.scene);
    Reconstruction made =
        reconstruct_thinned(std::move(input.scene), input.read, {options, RunImages(), log});
    Stage stage(log, "write");
    write_ply(sample.scratch / "surface.ply", made.mesh, {});
    stage.end({{counts::kOutput.faces, size_of(made.mesh.faces.size())}});
    return {size, std::move(made.scene.positions)};
}

/// The recorded stages, with their peaks above the base and the predicted memory.
Json stages_of(const cli::Json& recorded, const Meter& meter, const Run& run, int threads)
{
    Json stages = Json::array();
    const std::vector<StageMemory> predicted = predicted_memory(run.size, threads);
    for (const cli::Json& stage : recorded) {
        stages.push_back({{"name", stage["name"]},
                          {"seconds", stage["seconds"]},
                          {"cpu_seconds", stage["cpu_seconds"]},
                          {"peak_bytes", meter.above_base(stage["peak_memory_bytes"])}});
        const auto found = std::ranges::find_if(
            predicted, [&](const StageMemory& memory) { return stage["name"] == memory.stage; });
        if (found != predicted.end()) stages.back()["predicted_bytes"] = found->bytes;
    }
    return stages;
}

} // namespace

void make_model(const std::filesystem::path& folder, const SampleKind& kind, std::size_t points)
{
    if (std::filesystem::exists(folder)) return;
    write_colmap_model(folder, *sample_parts(kind, points));
}

Json prepare(const Sample& sample)
{
    std::filesystem::create_directories(sample.scratch);
    Log silent;
    const Run run = make_surface(sample, 0, silent);
    write_raw_points(sample.triangulated(), run.triangulated);
    return {{"model", sample.model.filename().string()},
            {"points", run.size.read.points},
            {"triangulated", run.triangulated.size()},
            {"views", run.size.read.views},
            {"rays", run.size.read.rays}};
}

Json measure_sequential_triangulation(const Sample& sample)
{
    const std::vector<Kernel::Point_3> points = cgal_points(read_raw_points(sample.triangulated()));
    const auto limit = limit_of(1);
    const Meter meter;
    const BareDelaunay<CGAL::Sequential_tag> made(points.begin(), points.end());
    return meter.json();
}

Json measure_parallel_triangulation(const Sample& sample, int threads)
{
    const std::vector<Kernel::Point_3> points = cgal_points(read_raw_points(sample.triangulated()));
    CGAL::Bbox_3 box;
    for (const Kernel::Point_3& point : points) {
        box += point.bbox();
    }
    const auto limit = limit_of(threads);
    const Meter meter;
    constexpr int kLockCellsPerAxis = 50; // as in CGAL's manual
    BareDelaunay<CGAL::Parallel_tag>::Lock_data_structure locks(box, kLockCellsPerAxis);
    const BareDelaunay<CGAL::Parallel_tag> made(points.begin(), points.end(), &locks);
    return meter.json();
}

Json measure_run(const Sample& sample, int threads)
{
    const auto limit = limit_of(threads);
    Log silent;
    const Meter meter;
    cli::StageRecorder recorder(silent);
    const Run run = make_surface(sample, threads, recorder);
    Json result = meter.json();
    result["base_bytes"] = meter.base_bytes();
    result["predicted_bytes"] = predicted_peak(run.size, threads);
    // Each stage resets the peak.
    const cli::Json recorded = recorder.json();
    result["peak_bytes"] = meter.above_base(recorded["total"]["peak_memory_bytes"]);
    result["stages"] = stages_of(recorded["stages"], meter, run, threads);
    return result;
}

} // namespace vcarve::bench
