#pragma once

#include <string>

#include "experiments/reproduction/reproduction.h"

namespace curvefusion {

/// The result of a claim for one subject in words: "0.96 [0.95, 0.97]: exceeded".
std::string ResultText(const Claim& claim, const ClaimResult& result);

/// All claims as a table, a row a claim and subject.
Table ClaimTable(const Reproduction& reproduction);

/// Pictures of a study's report in its folder: STEM.png and STEM_*.png, by name.
std::vector<std::string> PicturesOf(const StudyResults& results);

/// The whole page in Markdown. Pictures are links below `pictures`, a folder beside the page.
std::string ReproductionPage(const Reproduction& reproduction, const StudyRequest& request,
                             const std::string& pictures);

/// Judges what the folder has and writes folder/reproduction.md with its pictures in
/// folder/images/reproduction/, and the claims as reproduction_claims.csv, .json, .tex and .md.
/// Throws Error(kResource) where a file cannot be written.
void WriteReproduction(const StudyRequest& request, const std::filesystem::path& folder);

}  // namespace curvefusion
