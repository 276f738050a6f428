#include "report/definitions.h"

#include <fmt/format.h>

#include <utility>

namespace vcarve {
namespace {

constexpr const char* kCostDefinition = "seconds, CPU seconds (all threads), peak memory: of the "
                                        "whole program that made the mesh, from "
                                        "its start to its end, on this machine.";

std::vector<std::string> evidence_definitions(const Reference& reference)
{
    const double k = reference.options.spacings;
    return {
        fmt::format("Measured against {} points with at least 2 views and {} views; spacing of a "
                    "point = distance to its 6th nearest point.",
                    reference.scene.num_points(), reference.scene.views.size()),
        fmt::format(
            "hidden sights: share of lines from a point to a view that saw it which meet the "
            "mesh farther than {} spacings from the point.",
            k),
        fmt::format("missed points: share of points farther than {} spacings from the mesh.", k),
        "unsupported area: share of the mesh's area that no view sees from its front (within the "
        "image, nothing of the mesh between).",
        "seen boundary edges: edges of one face whose middle some view sees (within the image, "
        "nothing of the mesh between).",
        fmt::format("back faces seen: share of {} rays, a regular grid in every image, that first "
                    "meet the mesh from its back.",
                    reference.rays.size()),
        reference.closed_hits
            ? "nothing seen: share of these rays that meet no face where the closed surface (what "
              "--closed makes of the model) has one."
            : "nothing seen: not known, for no closed surface was made of the model.",
        "genus: handles of a closed manifold surface; open where it is not one.",
    };
}

std::string line_definition(const Truth& truth)
{
    return fmt::format(
        "seen right, torn, open: shares of lines from a view on through a sample of the truth that "
        "it sees within its image (one a sample, at random; {} of {} samples have one): first meet "
        "the mesh from its front, at most 0.5 % of the diagonal before or behind the sample; first "
        "meet it from its back; do not meet it.",
        truth.image_samples(), truth.samples.size());
}

std::vector<std::string> truth_definitions(const Reference& reference)
{
    std::vector<std::string> lines;
    lines.push_back(fmt::format("truth: {} samples by area of what at least 3 views see (nothing "
                                "of the truth between, under 80 degrees from the normal, wherever "
                                "its image ends; {:.1f} % of its area), seed {}; "
                                "diagonal = of their box = {:.6g}.",
                                reference.truth->samples.size(),
                                100.0 * reference.truth->seen_share, reference.options.seed,
                                reference.truth->diagonal));
    lines.push_back(fmt::format(
        "precision: share of {} samples by area of the whole mesh within that part of the diagonal "
        "of the truth; recall: of the truth's samples, of the mesh; F: harmonic mean.",
        reference.options.samples));
    lines.emplace_back(
        "accuracy, completeness: mean distance of the mesh's samples to the truth and back, "
        "in % of the diagonal.");
    lines.emplace_back(
        "blocked: share of the truth's samples whose line to a view that sees them (one a "
        "sample, at random) meets the mesh farther than 1 % of the diagonal from the sample.");
    lines.push_back(line_definition(*reference.truth));
    return lines;
}

} // namespace

std::vector<std::string> definitions(const Reference& reference, bool with_costs)
{
    std::vector<std::string> lines = evidence_definitions(reference);
    if (reference.truth) {
        for (std::string& line : truth_definitions(reference)) {
            lines.push_back(std::move(line));
        }
    }
    if (with_costs) lines.emplace_back(kCostDefinition);
    return lines;
}

} // namespace vcarve
