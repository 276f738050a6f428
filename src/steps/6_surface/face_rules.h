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

// The rule book: which faces of the boundary between inside and outside are surface.
//
// The cut closes whatever it is given. So the boundary has faces that no view could have seen,
// behind walls and under floors, and faces that views do see though nothing is there: they close
// what was looked at where no points were found, as a lid over a hall without a ceiling, skirts
// around the ground, sheets between far things. The first row that applies to a face decides.
// FaceEvidence answers what is asked, `FaceRules` (options.h) has the thresholds, named in
// brackets.
//
// clang-format off
//
//  | row | what is known of a face                                                   | it is   |
//  |-----|---------------------------------------------------------------------------|---------|
//  |  1  | a corner lies outside the region that is wanted                           | dropped |
//  |  2  | no view sees it: but small ones beside a kept face stay [beside_*]        | dropped |
//  |  3  | were it away, a view would look onto the back of a kept face              | kept    |
//  |  4  | the surface ends at it, and it is hardly seen [hardly_seen]               | dropped |
//  |  5  | it is long [max_closing], and hardly seen                                 | dropped |
//  |  6  | it is long, turns off the surface around, and is not half seen [half_seen]| dropped |
//  |  7  | it is `vast` times as long, turns off, and the surface ends at it         | dropped |
//  |  8  | else                                                                      | kept    |
//
// clang-format on
//
// Rows 3 to 7 are asked in rounds of faces that are long or lie at a face that was dropped: each
// that is dropped makes new ends of the surface and lets views see farther, so a lid goes from its
// rim inwards. Row 2 spares small faces last, one layer deep, so that a surface that bends out of
// sight ends behind its bend, not in view, and gaps a face or two wide close. Row 3 comes before
// all others but 2 since nothing may come to light that is plainly wrong: the inside of a thing.
// What is kept and large is then trimmed to what views see of it (trim.h).
//
// How much of a face is seen is asked at 7 places on it, 10 on a thin one, by walks to all views
// through what is kept; hardly seen is none of 7 or one of 10. Where images do not tell, since they
// do not even show the corners that their views saw, no face is hardly or half seen.

/// Which faces a view sees (row 2): each corner was seen from the front by some view of its point,
/// or some view sees a place on the face by more than a graze, through outside cells; so a plain
/// wall without points of its own is seen. Cost: O(faces + sights), and walks
/// (FaceVisibility::is_seen) for the faces whose corners were not all seen; in parallel.
FaceFlags seen_faces(const Boundary& boundary);

/// The longest edge from which on a face is long: `max_closing` times the diameter of the region of
/// interest. Cost: as region_of_interest().
double closing_length(const Scene& scene, const FaceRules& rules);

/// Takes the flags off faces that close what was looked at without support: rows 3 to 7. None where
/// `max_closing` is 0. Returns how many there are. Cost: O(faces), and some walks a view for each
/// long face and each at an end of the surface; mostly in parallel.
std::int64_t drop_unsupported(const Boundary& boundary, const FaceRules& rules, FaceFlags& keep);

/// The faces that are kept before large ones are trimmed.
struct ChosenFaces {
    FaceFlags keep;
    FaceFlags seen;                 ///< every face that a view sees; empty where all are kept
    std::int64_t unseen = 0;        ///< how many were dropped for not being seen
    std::int64_t closing = 0;       ///< for closing something without support
    std::int64_t out_of_region = 0; ///< with a corner there
};

/// Goes through all faces by the rules above. `region` is null for all of space. Where the surface
/// is to be closed, only what lies outside the region is dropped. Cost: that of seen_faces() and
/// drop_unsupported().
ChosenFaces choose_faces(const Boundary& boundary, const Region* region,
                         const SurfaceOptions& options, Removals& removals);

/// The faces with a flag; vertices stay.
TriMesh with_faces(TriMesh mesh, const FaceFlags& keep);

} // namespace vcarve
