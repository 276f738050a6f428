#include "steps/5_labels/label_cells.h"

#include "steps/4_visibility/count_crossings.h"
#include "steps/4_visibility/shared_sights.h"
#include "steps/4_visibility/trace.h"
#include "steps/4_visibility/virtual_views.h"
#include "steps/5_labels/cut.h"
#include "steps/5_labels/hull_faces.h"
#include "steps/5_labels/strict_carving.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

namespace vcarve {

namespace {

std::int64_t num_inside(const Labels& labels)
{
    return std::ranges::count(labels, Label::inside);
}

// The stages that are kept.
constexpr std::string_view kSights = "sights";
constexpr std::string_view kVirtualSights = "virtual-sights";

VirtualSights place_virtual_views(const TetMesh& cells, const Labels& labels, const Scene& scene,
                                  const VirtualViewOptions& options, Log& log)
{
    Stage stage(log, "virtual");
    VirtualSights sights = find_virtual_sights(cells, scene, labels, options, stage);
    stage.end({{"views", size_of(sights.centers.size())},
               {"sights", size_of(sights.tracks.views.size())}});
    return sights;
}

/// Labels by the photographs and, where virtual views are asked for, once more with these.
/// `cast(source, stage, said, progress)` adds what a source knows to all that was said, as a part
/// of that stage, `label(said)` labels by that.
template <typename Said, typename Cast, typename Label>
Labels label_by_sources(const TetMesh& cells, const Scene& scene, const VirtualViewOptions& options,
                        StageKeeper& work, const Cast& cast, const Label& label)
{
    const auto with = [&](const RaySource& source, std::string_view name, Said said) {
        Stage stage(work.log(), "sights");
        cast(source, name, said, stage);
        stage.end({{"sights", size_of(source.rays->views.size())}});
        return said;
    };
    const auto by_photographs = [&] {
        return work.stage(kSights, [&] { return with(photographs(scene), kSights, Said()); });
    };
    if (options.count == 0) return label(by_photographs());
    return label(work.stage(kVirtualSights, [&] {
        Said said = by_photographs();
        const VirtualSights more =
            place_virtual_views(cells, label(said), scene, options, work.log());
        return with(more.source(options.weight), kVirtualSights, std::move(said));
    }));
}

Labels carve(const TetMesh& cells, const Scene& scene, const LabelOptions& options,
             StageKeeper& work)
{
    const CrossingCounter counter(cells);
    const auto cast = [&](const RaySource& source, std::string_view stage, Crossings& crossings,
                          const Progress& progress) {
        CasterOfRanks(counter, work).cast(source, {stage, {}}, crossings, progress);
    };
    const auto label = [&](const Crossings& crossings) {
        Stage stage(work.log(), "carve");
        Labels carved = carve(cells, crossings, options.min_crossings);
        stage.end({{"inside", num_inside(carved)}, {"of", size_of(cells.cells.size())}});
        return carved;
    };
    return label_by_sources<Crossings>(cells, scene, options.virtual_views, work, cast, label);
}

Labels cut(const TetMesh& cells, const Scene& scene, VisibilityEnergy energy,
           const LabelOptions& options, Log& log)
{
    Stage stage(log, "cut");
    const std::vector<Index> uncrossed = uncrossed_hull_cells(cells, energy.network);
    Labels labels = cut(cells, std::move(energy), options.cut, stage);
    const std::int64_t inside = num_inside(labels);
    const std::int64_t on_hull = go_on_along_hull(cells, scene, uncrossed, options.hull, labels);
    stage.end(
        {{"inside", inside}, {"of", size_of(cells.cells.size())}, {"faces of the hull", on_hull}});
    return labels;
}

Labels cut(const TetMesh& cells, const Scene& scene, const LabelOptions& options, StageKeeper& work)
{
    std::optional<Scales> scales; // measured once, as a part of the first stage
    const auto cast = [&](const RaySource& source, std::string_view stage, VisibilityEnergy& energy,
                          const Progress& progress) {
        if (!scales) scales = measure_scales(cells, scene);
        const RayCaster caster(cells, scene, *scales, options.trace);
        CasterOfRanks(caster, work).cast(source, {stage, *scales}, energy, progress);
    };
    const auto label = [&](VisibilityEnergy energy) {
        return cut(cells, scene, std::move(energy), options, work.log());
    };
    return label_by_sources<VisibilityEnergy>(cells, scene, options.virtual_views, work, cast,
                                              label);
}

} // namespace

Labels label_cells(const TetMesh& cells, const Scene& scene, const LabelOptions& options,
                   StageKeeper& work)
{
    const auto label = [&] {
        return options.method == Method::strict ? carve(cells, scene, options, work)
                                                : cut(cells, scene, options, work);
    };
    return work.keeps() ? work.stage("labels", label) : label();
}

} // namespace vcarve
