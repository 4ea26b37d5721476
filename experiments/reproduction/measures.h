#pragma once

#include <string>
#include <vector>

#include "experiments/reproduction/claim.h"

namespace curvefusion {

/// The median of a figure over the runs with these labels. A run that found nothing counts with 0
/// where it has no value.
Measure MedianOf(const std::string& figure, const Labels& where = {});

/// The least and the greatest value of a figure over the runs with these labels.
Measure LeastOf(const std::string& figure, const Labels& where = {});
Measure MostOf(const std::string& figure, const Labels& where = {});

/// The sum of a figure over that of another, as the paper counts its 95 % of all junctions.
Measure RatioOf(const std::string& part, const std::string& whole, const Labels& where = {});

/// MedianOf(figure, these) - MedianOf(figure, others).
Measure DifferenceOf(const std::string& figure, const Labels& these, const Labels& others);

/// The median of a figure over the runs of a subject less that over the runs of the method beside
/// it (Claim::beside).
Measure LeadOver(const std::string& method, const std::string& figure);

/// The amount of a difference.
Measure AmountOf(const Measure& measure);

/// The median at one value of a numeric label less the greatest median at any value.
Measure BelowBestOf(const std::string& figure, const std::string& label, const std::string& value);

/// The least value of a numeric label down to which, without a gap from the greatest one on, a
/// figure is not zero; infinite where it is zero at the greatest.
Measure LeastLabelWith(const std::string& figure, const std::string& label,
                       const Labels& where = {});

/// How often the least value of a numeric label at which a figure is not zero (LeastLabelWith)
/// falls from one of these labels to the next, less how often it rises.
Measure FallsOfLeastLabel(const std::string& figure, const std::string& label,
                          const std::vector<Labels>& along);

/// The mean over objects of |diameter - true| / true: one diameter of the whole result against the
/// nearest of those that the paper's Table 1 gives for the object. Only objects of that table
/// count.
Measure TableDiameterError();

}  // namespace curvefusion
