#include "samples.h"

#include "io/colmap/colmap_model.h"
#include "sample_scene.h"
#include "steps/1_points/arrange.h"
#include "steps/1_points/filter.h"
#include "steps/3_cells/triangulate.h"
#include "steps/4_visibility/trace.h"
#include "steps/5_labels/label_cells.h"
#include "steps/5_labels/max_flow/max_flow.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <map>

namespace vcarve::bench {

namespace {

/// The models of this process. The destructor removes them.
class ModelFolder {
  public:
    ModelFolder() { std::filesystem::create_directories(path_); }
    ~ModelFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ModelFolder(const ModelFolder&) = delete;
    ModelFolder& operator=(const ModelFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_ =
        std::filesystem::temp_directory_path() / fmt::format("vcarve_bench_{}", ::getpid());
};

std::filesystem::path make_folder(std::int64_t points)
{
    static const ModelFolder models;
    if (points == 0) return std::getenv("VCARVE_MODEL");
    const auto count = static_cast<std::size_t>(points);
    std::filesystem::path folder = models.path() / std::to_string(points);
    write_colmap_model(folder, *sample_parts(SampleKind(), count));
    return folder;
}

Scene make_scene(std::int64_t points)
{
    Scene scene = read_colmap_model(sample_folder(points), ModelFormat::binary);
    return spatial_sort(filter_points(center_points(std::move(scene)), FilterOptions()).scene);
}

FlowNetwork make_network(std::int64_t points)
{
    const TetMesh& cells = sample_cells(points);
    Log silent;
    Stage stage(silent, "rays");
    const Scene& scene = sample_scene(points);
    const TraceOptions options;
    VisibilityEnergy energy;
    RayCaster(cells, scene, measure_scales(cells, scene), options)
        .cast(photographs(scene), energy, stage);
    return cut_network(cells, std::move(energy), CutOptions());
}

/// The cached result of `make` for a number of points.
template <typename Make>
const auto& made_once(std::int64_t points, const Make& make)
{
    static std::map<std::int64_t, decltype(make(points))> made;
    const auto found = made.find(points);
    return found != made.end() ? found->second : made.emplace(points, make(points)).first->second;
}

} // namespace

const std::filesystem::path& sample_folder(std::int64_t points)
{
    return made_once(points, make_folder);
}

const Scene& sample_scene(std::int64_t points)
{
    return made_once(points, make_scene);
}

const TetMesh& sample_cells(std::int64_t points)
{
    return made_once(points, [](std::int64_t n) { return triangulate(sample_scene(n)); });
}

const FlowNetwork& sample_network(std::int64_t points)
{
    return made_once(points, make_network);
}

void sample_sizes(benchmark::internal::Benchmark* bench)
{
    bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
    bench->Arg(100'000)->Arg(1'000'000);
    if (std::getenv("VCARVE_MODEL") != nullptr) bench->Arg(0);
}

} // namespace vcarve::bench
