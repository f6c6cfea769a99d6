#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "common/mask.h"
#include "compare/answer_metrics.h"
#include "compare/metric.h"

namespace gnomon::compare {

/// The distances d at which boundary IoU and surface Dice are taken, in the layout's unit.
constexpr std::array<double, 3> boundaryTolerances = {1, 2, 4};

/// How far the contour of a candidate's shadows lies from that of the truth's, and which share of
/// both agree. With the contours C and T (see `Contour`: neither the silhouette nor the image's
/// edge belongs to one), the distance dist(p, S) from a place to the nearest side of S, and |S|,
/// the sum of its sides' lengths:
///
///   assd             (∫_C dist(c, T) + ∫_T dist(t, C)) / (|C| + |T|)
///                    average symmetric surface distance
///   hd95             max(P₉₅ of dist(c, T) over C, P₉₅ of dist(t, C) over T); P₉₅ is the smallest
///                    distance that 95 % of a contour do not exceed: the Hausdorff distance without
///                    the farthest twentieth of either
///   boundary_iou_d   |C_d ∩ T_d| / |C_d ∪ T_d|, C_d the samples that the candidate shadows at most
///                    d from its contour, T_d likewise (Cheng et al. 2021)
///   surface_dice_d   (|{c : dist(c, T) ≤ d}| + |{t : dist(t, C) ≤ d}|) / (|C| + |T|)
///                    (Nikolov et al. 2018)
///
/// each of the last two for d = 1, 2, 4. Distances are straight in the picture, from middle to
/// middle of the sides and from samples' centres, in the layout's unit; they exceed d only by more
/// than a rounding of 1e-9 d. A side has the length that two samples share: a slanted contour is
/// made of steps, and is as long as all of them together. Samples count alike, in an atlas too:
/// there the plane is the texture's.
///
/// All are symmetric in the two masks and do not change when both are mirrored or transposed.
/// All but boundary IoU are the same for shadow and light. assd ≤ hd95 need not hold.
///
/// Undefined where neither mask has a contour, and for
///   assd, hd95       only one of both has: nothing says how far away the other's is. (boundary IoU
///                    and surface Dice are 0 then: nothing agrees)
///   boundary_iou_d   C_d and T_d are empty: samples so far apart that none lies within d
///
/// In an atlas of tiles the nearest side may lie on a neighbouring face, anywhere in the picture.
/// Boundary IoU and surface Dice are therefore taken over the samples and sides at least d from
/// their tile's border, for which only the tile matters, and are undefined without any; assd and
/// hd95 are undefined.
///
/// Only samples for which both masks have an answer are considered. The same input gives the same
/// bits, whatever the number of threads.
/// @return in this order: assd, hd95, boundary_iou_1, _2, _4, surface_dice_1, _2, _4
/// @throws InputError if sizes differ or a step of the layout is not above 0; MemoryError if the
///   contours do not fit in memory
std::vector<Metric> compareBoundaries(const Mask& candidate, const Mask& truth,
                                      const SampleLayout& layout = {});

/// The same for several candidates at once: distances to the truth's contour are prepared once for
/// all of them.
/// @returns one list a candidate
/// @throws likewise
std::vector<std::vector<Metric>> compareBoundaries(std::span<const Mask* const> candidates,
                                                   const Mask& truth, const SampleLayout& layout);

/// All reasons why one of them has no value.
const std::vector<std::string_view>& boundaryReasons();

}  // namespace gnomon::compare
