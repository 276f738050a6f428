#include "steps/4_labels/label_cells.h"

#include "steps/4_labels/strict_carving.h"

#include <algorithm>
#include <utility>

namespace vcarve {

namespace {

VirtualSights place_virtual_views(const TetMesh& cells, const Scene& scene, const Labels& labels,
                                  const LabelOptions& options, Log& log)
{
    Stage stage(log, "virtual");
    VirtualSights sights = find_virtual_sights(cells, scene, labels, options.virtual_views, stage);
    stage.end({{"views", size_of(sights.centers.size())},
               {"sights", size_of(sights.tracks.views.size())}});
    return sights;
}

Labels carve(const TetMesh& cells, const Crossings& crossings, const LabelOptions& options,
             Log& log)
{
    Stage stage(log, "carve");
    Labels labels = carve(cells, crossings, options.min_crossings);
    stage.end({{"inside", std::count(labels.begin(), labels.end(), Label::inside)}});
    return labels;
}

Labels carve(const TetMesh& cells, const Scene& scene, const LabelOptions& options, Log& log)
{
    Stage trace(log, "sights");
    Crossings crossings;
    cast_rays(cells, photographs(scene), crossings, trace);
    trace.end({{"sights", size_of(scene.num_sights())}});
    Labels labels = carve(cells, crossings, options, log);
    if (options.virtual_views.count == 0) {
        return labels;
    }
    const VirtualSights more = place_virtual_views(cells, scene, labels, options, log);
    Stage trace_more(log, "sights");
    cast_rays(cells, more.source(options.virtual_views.weight), crossings, trace_more);
    trace_more.end({{"sights", size_of(more.tracks.views.size())}});
    return carve(cells, crossings, options, log);
}

Labels cut(const TetMesh& cells, const Scene& scene, VisibilityEnergy energy,
           const LabelOptions& options, Log& log)
{
    Stage label(log, "cut");
    const std::int32_t one_sight = energy.unit;
    const Progress progress(label);
    MinimumCut minimum = cut(cells, std::move(energy), options.cut, progress.part(0.0, 0.6));
    DoubtedLabels doubted = doubt_bridging_facets(cells, scene, minimum, one_sight,
                                                  options.bridging, progress.part(0.6, 0.9));
    Labels& labels = doubted.labels;
    const std::int64_t needles = take_back_needles(cells, scene, options.needles, labels);
    label.end({{"inside", std::count(labels.begin(), labels.end(), Label::inside)},
               {"bridging facets doubted", doubted.doubts},
               {"cells taken back", doubted.taken_back},
               {"needles", needles}});
    return std::move(labels);
}

Labels cut(const TetMesh& cells, const Scene& scene, const LabelOptions& options, Log& log)
{
    Stage trace(log, "sights");
    const RayCaster caster(cells, scene, measure_scales(cells, scene), options.trace);
    VisibilityEnergy energy;
    caster.cast(photographs(scene), energy, trace);
    trace.end({{"sights", size_of(scene.num_sights())}});
    if (options.virtual_views.count == 0) {
        return cut(cells, scene, std::move(energy), options, log);
    }
    const Labels first = cut(cells, scene, energy, options, log);
    const VirtualSights more = place_virtual_views(cells, scene, first, options, log);
    Stage trace_more(log, "sights");
    caster.cast(more.source(options.virtual_views.weight), energy, trace_more);
    trace_more.end({{"sights", size_of(more.tracks.views.size())}});
    return cut(cells, scene, std::move(energy), options, log);
}

} // namespace

Labels label_cells(const TetMesh& cells, const Scene& scene, const LabelOptions& options, Log& log)
{
    return options.method == Method::strict ? carve(cells, scene, options, log)
                                            : cut(cells, scene, options, log);
}

} // namespace vcarve
