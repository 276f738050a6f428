#pragma once

#include "render/photo_scene.h"

namespace vcarve::render {

inline Eigen::Quaterniond turned(double angle_rad, const Eigen::Vector3d& axis)
{
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis.normalized()));
}

PhotoScene fixture_scene(); ///< fixtures/scene: the still life from two rows of views
PhotoScene panels();        ///< thin free-standing boards, some with windows
PhotoScene clutter();       ///< a heap on a table, seen from all around
PhotoScene facade();        ///< the front of a house, seen from the street
PhotoScene organic();       ///< a bumpy ball and a knot, seen from all around
PhotoScene low_texture();   ///< half of the parts have nearly no texture
PhotoScene noisy();         ///< images with strong noise and some blur
PhotoScene few_views();     ///< the still life in eight views
PhotoScene room();          ///< an interior, seen from inside
PhotoScene city();          ///< houses with plain walls, seen from the air
PhotoScene hall();          ///< a high hall without a ceiling, in noisy images from inside
PhotoScene cubicles();      ///< thin partitions, some plain, with desks and chairs
PhotoScene smooth();        ///< a round figure and a vase with little texture

} // namespace vcarve::render
