#include "steps/6_surface/face_rules.h"

#include "base/arrays.h"
#include "base/parallel.h"
#include "model/extent.h"
#include "steps/4_visibility/face_visibility.h"

#include <algorithm>
#include <iterator>

namespace vcarve {

namespace {

using FaceNumbers = std::vector<std::uint32_t>; ///< ascending

FaceNumbers faces_with(std::uint8_t flag, const FaceFlags& flags)
{
    return parallel_collect<std::uint32_t>(flags.size(), [&](std::size_t face, auto& found) {
        if (flags[face] == flag) found.push_back(static_cast<std::uint32_t>(face));
    });
}

/// The faces for which ask(face) is true.
template <typename Ask>
FaceNumbers filter_faces(const FaceNumbers& faces, const Ask& ask)
{
    return parallel_collect<std::uint32_t>(
        faces.size(),
        [&](std::size_t i, auto& found) {
            if (ask(faces[i])) found.push_back(faces[i]);
        },
        16);
}

/// Whether a face is unsupported: rows 4 to 7.
bool is_unsupported(std::uint32_t face, const FaceEvidence& evidence, double closing,
                    const FaceRules& rules)
{
    const double length = evidence.length(face);
    const bool is_at_rim = evidence.is_at_rim(face);
    if (length < closing && !is_at_rim) return false;
    if (evidence.is_seen_less_than(rules.hardly_seen, face)) return true;
    if (length < closing || evidence.continues_surface(face)) return false;
    return evidence.is_seen_less_than(rules.half_seen, face) ||
           (is_at_rim && length >= rules.rim_closing * closing);
}

/// drop_unsupported() with given evidence.
std::int64_t drop_by(const FaceEvidence& evidence, const Boundary& boundary, const FaceRules& rules,
                     FaceFlags& keep)
{
    const auto& faces = boundary.surface.faces;
    const double closing = closing_length(boundary.visibility.scene(), rules, boundary.usual);
    const FaceNumbers large = filter_faces(
        faces_with(1, keep), [&](std::uint32_t face) { return evidence.length(face) >= closing; });
    std::int64_t count = 0;
    FaceNumbers dropped = faces_with(0, keep);
    do {
        FaceNumbers asked = large;
        for (const std::uint32_t face : dropped) {
            for (const std::uint32_t corner : faces[face]) {
                std::ranges::copy(evidence.faces_at()[corner], std::back_inserter(asked));
            }
        }
        sort_unique(asked);
        dropped = filter_faces(asked, [&](std::uint32_t face) {
            return keep[face] != 0 && is_unsupported(face, evidence, closing, rules) &&
                   !evidence.hides_back(face);
        });
        for (const std::uint32_t face : dropped) {
            keep[face] = 0;
        }
        count += static_cast<std::int64_t>(dropped.size());
    } while (!dropped.empty());
    return count;
}

/// The faces of `may_return` that are small and beside a kept face.
FaceNumbers small_faces_beside(const FaceFlags& keep, const FaceFlags& may_return,
                               const FaceEvidence& evidence, const FaceRules& rules)
{
    const double most = rules.beside_length * evidence.usual_length();
    return filter_faces(faces_with(1, may_return), [&](std::uint32_t face) {
        return keep[face] == 0 && evidence.length(face) <= most &&
               evidence.relative_size(face) <= rules.beside_edge && evidence.is_beside_kept(face);
    });
}

/// The faces with all corners inside a region.
FaceFlags faces_within(const Region& region, const TriMesh& surface)
{
    std::vector<std::uint8_t> is_inside(surface.positions.size());
    parallel_for(is_inside.size(), [&](std::size_t vertex) {
        is_inside[vertex] = region.contains(surface.positions[vertex]) ? 1 : 0;
    });
    FaceFlags within(surface.faces.size());
    parallel_for(within.size(), [&](std::size_t face) {
        const auto& [a, b, c] = surface.faces[face];
        within[face] = is_inside[a] & is_inside[b] & is_inside[c];
    });
    return within;
}

} // namespace

FaceFlags seen_faces(const Boundary& boundary)
{
    FaceFlags seen = faces_seen_at_corners(boundary.surface, boundary.visibility.scene());
    parallel_for(
        seen.size(),
        [&](std::size_t face) {
            if (seen[face] == 0 && boundary.visibility.is_seen(boundary.facets[face]))
                seen[face] = 1;
        },
        64);
    return seen;
}

double closing_length(const Scene& scene, const FaceRules& rules, UsualValues* usual)
{
    constexpr double kClosing = 0.115;
    const bool is_auto = rules.max_closing == FaceRules::kAutoClosing;
    return (is_auto ? kClosing : rules.max_closing) * 2.0 *
           usual_value(usual, &UsualValues::radius,
                       [&] { return region_of_interest(scene).radius; });
}

std::int64_t drop_unsupported(const Boundary& boundary, const FaceRules& rules, FaceFlags& keep)
{
    if (rules.max_closing == 0.0) return 0;
    return drop_by(FaceEvidence(boundary, keep), boundary, rules, keep);
}

ChosenFaces choose_faces(const Boundary& boundary, const Region* region,
                         const SurfaceOptions& options, Removals& removals)
{
    ChosenFaces chosen;
    FaceFlags& keep = chosen.keep;
    keep.assign(boundary.surface.faces.size(), 1);
    if (region != nullptr) keep = faces_within(*region, boundary.surface);
    chosen.out_of_region = std::ranges::count(keep, 0);
    removals.note(keep, Removal::outside_region);
    if (options.closed) return chosen;

    chosen.seen = seen_faces(boundary);
    FaceFlags may_return(keep.size());
    parallel_for(keep.size(), [&](std::size_t face) {
        may_return[face] = keep[face] != 0 && chosen.seen[face] == 0 ? 1 : 0;
        keep[face] &= chosen.seen[face];
    });
    removals.note(keep, Removal::unseen);

    const FaceRules& rules = options.rules;
    const FaceEvidence evidence(boundary, keep);
    if (rules.max_closing != 0.0) chosen.closing = drop_by(evidence, boundary, rules, keep);
    removals.note(keep, Removal::closing);
    for (const std::uint32_t face : small_faces_beside(keep, may_return, evidence, rules)) {
        keep[face] = 1;
    }
    removals.note(keep, Removal::unseen);
    chosen.unseen = std::ranges::count(keep, 0) - chosen.closing - chosen.out_of_region;
    return chosen;
}

TriMesh with_faces(TriMesh mesh, const FaceFlags& keep)
{
    mesh.faces = parallel_collect<Face>(keep.size(), [&](std::size_t face, auto& faces) {
        if (keep[face] != 0) faces.push_back(mesh.faces[face]);
    });
    return mesh;
}

} // namespace vcarve
