#include "steps/4_labels/label_cells.h"

#include "steps/3_visibility/trace.h"
#include "steps/3_visibility/virtual_views.h"
#include "steps/4_labels/bridging_facets.h"
#include "steps/4_labels/cut.h"
#include "steps/4_labels/needles.h"
#include "steps/4_labels/strict_carving.h"

#include <optional>
#include <utility>

namespace vcarve {

namespace {

VirtualSights place_virtual_views(const Labelling& labelling, const Scene& scene,
                                  const VirtualViewOptions& options, Log& log)
{
    Stage stage(log, "virtual");
    VirtualSights sights =
        find_virtual_sights(labelling.cells(), scene, labelling.labels(), options, stage);
    stage.end({{"views", size_of(sights.centers.size())},
               {"sights", size_of(sights.tracks.views.size())}});
    return sights;
}

/// Labels by the photographs and, where virtual views are asked for, once more with these.
/// `cast(source, progress)` adds what a source knows, `label(is_last)` labels by all that was
/// added.
template <typename Cast, typename Label>
Labelling label_by_sources(const Scene& scene, const VirtualViewOptions& options, Log& log,
                           const Cast& cast, const Label& label)
{
    const auto add = [&](const RaySource& source) {
        Stage stage(log, "sights");
        cast(source, stage);
        stage.end({{"sights", size_of(source.rays->views.size())}});
    };
    add(photographs(scene));
    const bool is_last = options.count == 0;
    Labelling first = label(is_last);
    if (is_last) return first;
    const VirtualSights more = place_virtual_views(first, scene, options, log);
    add(more.source(options.weight));
    return label(true);
}

Labelling carve(const TetMesh& cells, const Scene& scene, const LabelOptions& options, Log& log)
{
    Crossings crossings;
    const auto cast = [&](const RaySource& source, const Progress& progress) {
        cast_rays(cells, source, crossings, progress);
    };
    const auto label = [&](bool /*is_last*/) {
        Stage stage(log, "carve");
        Labelling carved(cells, carve(cells, crossings, options.min_crossings));
        stage.end({{"inside", carved.num_inside()}});
        return carved;
    };
    return label_by_sources(scene, options.virtual_views, log, cast, label);
}

Labelling cut(const TetMesh& cells, const Scene& scene, VisibilityEnergy energy,
              const LabelOptions& options, Log& log)
{
    Stage stage(log, "cut");
    const std::int32_t one_sight = energy.unit;
    const Progress progress(stage);
    MinimumCut minimum = cut(cells, std::move(energy), options.cut, progress.part(0.0, 0.6));
    DoubtedLabels doubted = doubt_bridging_facets(
        cells, scene, minimum, {options.bridging, one_sight}, progress.part(0.6, 0.9));
    const std::int64_t needles = take_back_needles(scene, options.needles, doubted.labelling);
    stage.end({{"inside", doubted.labelling.num_inside()},
               {"bridging facets doubted", doubted.doubts},
               {"cells taken back", doubted.taken_back},
               {"needles", needles}});
    return std::move(doubted.labelling);
}

Labelling cut(const TetMesh& cells, const Scene& scene, const LabelOptions& options, Log& log)
{
    VisibilityEnergy energy;
    std::optional<Scales> scales; // measured once, as a part of the first stage
    const auto cast = [&](const RaySource& source, const Progress& progress) {
        if (!scales) scales = measure_scales(cells, scene);
        RayCaster(cells, scene, *scales, options.trace).cast(source, energy, progress);
    };
    const auto label = [&](bool is_last) {
        return cut(cells, scene, is_last ? std::move(energy) : energy, options, log);
    };
    return label_by_sources(scene, options.virtual_views, log, cast, label);
}

} // namespace

Labelling label_cells(const TetMesh& cells, const Scene& scene, const LabelOptions& options,
                      Log& log)
{
    return options.method == Method::strict ? carve(cells, scene, options, log)
                                            : cut(cells, scene, options, log);
}

} // namespace vcarve
