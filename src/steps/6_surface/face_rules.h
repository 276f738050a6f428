#pragma once

#include "mesh/vertices.h"
#include "region/region.h"
#include "steps/6_surface/carve_surface.h"
#include "steps/6_surface/face_evidence.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

// The rules that select the mesh's faces from the boundary between inside and outside cells.
//
// The cut closes everything. So the boundary has faces that no view could see, behind walls and
// under floors. It also has visible but unsupported faces, which span regions without points: a
// hall without a ceiling, the surroundings of the ground, or the space between far objects.
//
// clang-format off
//
//  | term          | meaning for a face                                                        |
//  |---------------|---------------------------------------------------------------------------|
//  | sample        | one of 7 positions on the face, 10 on a thin one. It is visible if the    |
//  |               | line to some view meets no kept face                                      |
//  | seen          | each corner is seen from the front by a view of its point, or some view   |
//  |               | sees a sample                                                             |
//  | long          | its longest edge is at least closing_length() [max_closing]               |
//  | small         | its longest edge is at most [beside_edge] times the median edge around,   |
//  |               | and [beside_length] times the median longest edge of kept faces           |
//  | hardly seen   | views see less than the fraction [hardly_seen] of its samples             |
//  | half seen     | views see at least the fraction [half_seen] of its samples                |
//  | bends away    | its dihedral angle to the surface is above 26 degrees at each corner      |
//  | rim face      | it is on the convex hull, or shares an edge with a dropped face           |
//
// Thresholds in brackets are in FaceRules (options.h). The first row that applies decides:
//
//  | row | condition                                                                 | face is |
//  |-----|---------------------------------------------------------------------------|---------|
//  |  1  | a corner is outside the region                                            | dropped |
//  |  2  | not seen (exception: small, and shares an edge with a kept face)          | dropped |
//  |  3  | removing it would expose the back of a kept face                          | kept    |
//  |  4  | rim face, hardly seen                                                     | dropped |
//  |  5  | long, hardly seen                                                         | dropped |
//  |  6  | long, bends away, not half seen                                           | dropped |
//  |  7  | rim face, bends away, longest edge >= [rim_closing] closing_length()      | dropped |
//  |  8  | all others                                                                | kept    |
//
// clang-format on
//
// Rows 3 to 7 run in rounds over long faces and the faces around dropped ones. Each dropped face
// makes its neighbors rim faces and unblocks views, so unsupported faces vanish from the rim
// inwards. The exception of row 2 comes last and is one layer deep. So a surface that bends out of
// view continues one face beyond the bend, and gaps of one or two faces close. Row 3 precedes
// others because views must not see the inside of an object. Large kept faces are trimmed
// afterwards (trim.h).
//
// By default, hardly seen means none of 7 samples, or at most one of 10. If a corner projects into
// the image of none of the views that saw it, lens or poses are wrong. Then the face counts as half
// seen. FaceEvidence has the tests.

/// Returns the seen faces (row 2). Either each corner was seen from the front by some view of its
/// point, or some view sees a sample of the face, not at a grazing angle, through outside cells. So
/// a plain wall with points only along its outline is seen. Cost: O(faces + rays), and walks
/// through the cells (FaceVisibility::is_seen) for faces with unseen corners; in parallel.
FaceFlags seen_faces(const Boundary& boundary);

/// Returns the length from which the longest edge makes a face long: `max_closing` times the
/// diameter of the region of interest, and 0.115 of it for kAutoClosing. Cost: see
/// region_of_interest().
double closing_length(const Scene& scene, const FaceRules& rules, UsualValues* usual = nullptr);

/// Clears the flags of unsupported faces by rows 3 to 7, and returns their number. Does nothing if
/// `max_closing` is 0. Cost: O(faces), and some walks per view for each long face and each
/// face around dropped ones; mostly in parallel.
std::int64_t drop_unsupported(const Boundary& boundary, const FaceRules& rules, FaceFlags& keep);

/// The kept faces before trimming, and the numbers of dropped ones.
struct ChosenFaces {
    FaceFlags keep;
    FaceFlags seen;                 ///< seen faces; empty for a closed surface
    std::int64_t unseen = 0;        ///< number dropped by row 2
    std::int64_t closing = 0;       ///< number dropped by rows 4 to 7
    std::int64_t out_of_region = 0; ///< number dropped by row 1
};

/// Applies all rules. `region` is null for all of space. For a closed surface only row 1 applies.
/// Cost: that of seen_faces() and drop_unsupported().
ChosenFaces choose_faces(const Boundary& boundary, const Region* region,
                         const SurfaceOptions& options, Removals& removals);

/// Returns the mesh with only the flagged faces, and all vertices.
TriMesh with_faces(TriMesh mesh, const FaceFlags& keep);

} // namespace vcarve
