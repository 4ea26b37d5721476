// What the paper says of other methods, and of its own limits.
#include "experiments/reproduction/claim.h"
#include "experiments/reproduction/measures.h"

namespace curvefusion {

namespace {

constexpr Bound kReconstructed = {.value = 0.9};
constexpr const char* kNineTenths = "chosen: nine tenths, within 2 mm";

// "Smoother and more complete", held against Tabb 2013 with the scan's images and, as the paper had
// it, with views from all around.
std::vector<Claim> OfTabb(const std::string& method, const std::string& given) {
  const auto claim = [&](const std::string& words, const std::string& figure, const char* measured,
                         const Bound& bound) {
    return Claim{.topic = "Comparisons",
                 .words = words + " than Tabb 2013 " + given,
                 .place = "5, Comparisons; Fig. 13",
                 .study = "comparisons",
                 .figure = figure + " less that of Tabb 2013",
                 .measure = LeadOver(method, measured),
                 .bound = bound,
                 .origin = "as the paper says: the better of the two",
                 .beside = method,
                 .cause = "baselines.md#tabb-2013"};
  };
  return {claim("\"smoother and more complete\": more complete", "recall at 5 mm of its surface",
                "surface.recall", {}),
          claim("more complete and no less precise (ours)", "F at 2 mm of its surface",
                "surface.F2", {}),
          claim("\"smoother and more complete\": smoother",
                "mean angle between its surface and the true one, degrees,", "normal_error_deg",
                {.at_most = true})};
}

std::vector<Claim> OfOtherMethods() {
  const char* topic = "Comparisons";
  const char* fails =
      "\"fail to reconstruct the thin structures entirely or provide only a noisy "
      "and partial reconstruction\": ";
  const auto surface = [&](const std::string& words, const std::vector<std::string>& subjects) {
    return Claim{.topic = topic,
                 .words = fails + words,
                 .place = "5, Comparisons; Fig. 2",
                 .kind = ClaimKind::kOthersFail,
                 .study = "comparisons",
                 .figure = "F at 2 mm of its surface",
                 .measure = MedianOf("F2"),
                 .bound = kReconstructed,
                 .origin = kNineTenths,
                 .subjects = subjects};
  };
  const auto curves = [&](const char* words, const char* place, const char* subject) {
    return Claim{.topic = topic,
                 .words = words,
                 .place = place,
                 .kind = ClaimKind::kOthersFail,
                 .study = "comparisons",
                 .figure = "F at 2 mm of its curves",
                 .measure = MedianOf("F2"),
                 .bound = kReconstructed,
                 .origin = kNineTenths,
                 .subjects = {subject}};
  };
  return {
      surface("volumetric TSDF", {"VolumeFusion 2 mm", "VolumeFusion 4 mm", "VolumeFusion 5 mm"}),
      surface("KinectFusion", {"KinectFusion"}),
      surface("BundleFusion", {"BundleFusion poses"}),
      curves("the L1 axis of \"the aligned depth data of the whole RGBD sequence ... yields poor "
             "reconstruction\"",
             "Fig. 2; 3", "L1 of all frames"),
      curves("\"simply lifting all the detected RGB edges to 3D would produce an extremely noisy "
             "point set\"",
             "4.1; Fig. 2", "colour edges"),
      {.topic = topic,
       .words = "\"our approach detects and accumulates ... skeletons\" instead",
       .place = "5, Comparisons",
       .study = "comparisons",
       .figure = "F at 2 mm of the same scans",
       .measure = MedianOf("F2"),
       .bound = kReconstructed,
       .origin = kNineTenths,
       .cause = "paper_profile.md#what-it-gives"},
      {.topic = topic,
       .words = "\"the original method of Huang et al. leads to spurious junctions\", explicit "
                "junctions do not",
       .place = "4.2; Fig. 5",
       .study = "comparisons",
       .figure = "spurious junctions less those of Huang's branches, same samples of a bundle",
       .measure = LeadOver("Huang 2013 branches", "spurious_junctions"),
       .bound = {.value = -1, .at_most = true},
       .origin = "chosen: at least one junction fewer",
       .decimals = 0,
       .subjects = {"L1 of a bundle"},
       .beside = "Huang 2013 branches",
       .cause = "baselines.md#huang-2013"},
      {.topic = topic,
       .words = "structures over 10 mm \"can be reconstructed with reasonable quality using the "
                "conventional KinectFusion pipeline\"",
       .place = "4, assumption (iv)",
       .study = "comparisons",
       .figure = "F at 5 mm of its surface, wires of 15 mm",
       .measure = MedianOf("F5"),
       .bound = kReconstructed,
       .origin = "chosen: nine tenths, within 5 mm, a voxel",
       .subjects = {"KinectFusion, 15 mm"}}};
}

std::vector<Claim> OfLiu() {
  const auto claim = [](const char* words, const char* figure, const char* measured,
                        const char* origin) {
    return Claim{.topic = "Comparisons",
                 .words = words,
                 .place = "5, Comparisons; Fig. 14",
                 .kind = ClaimKind::kOthersFail,
                 .study = "comparisons",
                 .figure = figure,
                 .measure = MedianOf(measured),
                 .bound = kReconstructed,
                 .origin = origin,
                 .subjects = {"Liu 2017", "Liu 2017 strict"},
                 .cause = "baselines.md#liu-2017"};
  };
  return {claim("Liu et al. 2017 \"results in many spurious 3D curves\"",
                "precision at 5 mm of the candidates that the third view supports",
                "candidate_precision", "chosen: nine tenths of them are true"),
          claim("they are \"hard to disambiguate in later stages of the algorithm\"",
                "F at 2 mm of the curves that it selects", "F2", kNineTenths)};
}

std::vector<Claim> OfLimitations() {
  const char* topic = "Limitations";
  const char* place = "5, Limitations";
  const auto of = [](const char* limit) { return Labels{{"limit", limit}}; };
  return {
      {.topic = topic,
       .words = "\"close to a wall or lies on a table ... it will be missing\"",
       .place = place,
       .kind = ClaimKind::kFails,
       .study = "limitations",
       .figure = "recall of wire with its axis at most 5 mm above the table",
       .measure = MedianOf("recall_at.2.5", of("surface")),
       .bound = {.value = 0.9},
       .origin = "chosen: nine tenths of the curves"},
      {.topic = topic,
       .words = "\"sufficiently separated (~2-5 cm depending on depth)\" they can be scanned",
       .place = "4, assumption (i)",
       .study = "limitations",
       .figure = "recall of wire 50 to 60 mm above the table",
       .measure = MedianOf("recall_at.55", of("surface")),
       .bound = {.value = 0.9},
       .origin = "chosen: nine tenths of the curves"},
      {.topic = topic,
       .words = "\"very thin structures below 2 mm ... CurveFusion will fail\"",
       .place = place,
       .kind = ClaimKind::kFails,
       .study = "limitations",
       .figure = "recall of a wire of 1.5 mm",
       .measure = MedianOf("recall_at.1.5", of("thickness")),
       .bound = {.value = 0.9},
       .origin = "chosen: nine tenths of the curves"},
      {.topic = topic,
       .words = "\"a junction of valence 6 may instead be interpreted as two ... of valence 3\"",
       .place = place,
       .kind = ClaimKind::kFails,
       .study = "limitations",
       .figure = "one junction of valence 6 found (1) or not (0)",
       .measure = MedianOf("whole_at.6", of("valence")),
       .bound = {.value = 0.5},
       .origin = "on most seeds"},
      {.topic = topic,
       .words = "\"our radius estimation assumes ... a constant radius for all its parts\"",
       .place = place + std::string("; 4.3"),
       .kind = ClaimKind::kFails,
       .study = "limitations",
       .figure = "relative error of diameters of 3 to 12 mm in one object",
       .measure = MedianOf("aligned.diameter.relative_error", of("radius")),
       .bound = {.value = 0.1, .at_most = true},
       .origin = "chosen: as good as the paper's estimates of one diameter"}};
}

}  // namespace

std::vector<Claim> ClaimsOfComparisons() {
  std::vector<Claim> claims = OfOtherMethods();
  for (const std::vector<Claim>& more :
       {OfTabb("Tabb 2013", "with the images of the same scan"),
        OfTabb("Tabb 2013 studio", "with true silhouettes from all around"), OfLiu(),
        OfLimitations()}) {
    claims.insert(claims.end(), more.begin(), more.end());
  }
  return claims;
}

}  // namespace curvefusion
