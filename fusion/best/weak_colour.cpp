#include "fusion/best/weak_colour.h"

#include "capture/content/colour_survey.h"

namespace curvefusion {

namespace {

constexpr int kSurveyFrames = 8;  // chosen: one dark frame among them must not decide

void SwitchOffColour(BestOptions& options) {
  options.segmentation.gate.frames = 0;
  options.segmentation.max_array_spacing = 0;
  options.segmentation.ghosts.verified_share = 0;
  options.colour_adjustment.enabled = false;
  options.silhouettes.max_frames = 0;
}

}  // namespace

std::string SwitchOffUselessColour(const Sequence& sequence, BestOptions& options) {
  const ColourSurvey survey = SurveyColour(sequence, kSurveyFrames);
  if (survey.IsFeatureless()) {
    SwitchOffColour(options);
    return "the colour images show nothing; depth alone was used: no diameters, and more false "
           "curves than with colour";
  }
  // Measured on a simulated cage of 60 frames turned grey: F(5 mm) is 0 with all checks, .87 with
  // the silhouettes, which a grey wire before grey things does not have, and .94 without.
  if (survey.IsGrey()) {
    options.silhouettes.max_frames = 0;
    return "the colour images are grey; curves were kept also where they show no wire";
  }
  return {};
}

}  // namespace curvefusion
