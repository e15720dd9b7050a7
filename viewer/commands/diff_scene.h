// SPDX-License-Identifier: MIT
// "Is my renderer right?": somebody's picture of a scene against ours. Where it is off, the ledger may say why:
//   traced = R - shadow + reflection + refraction     (R: the z-buffer's colour),
// and a pixel that equals ours with one of these terms left out, or put in, tells what the other renderer
// does not do, or does too much. Only numbers speak: a pixel that no such sum gives stays without a reason.
#pragma once

#include <string>
#include <vector>

#include "viewer/commands/job.h"
#include "viewer/commands/picture_pair.h"
#include "viewer/commands/result_json.h"

namespace sidelight {

// Both of our pictures of the scene, of the size and part that somebody's picture shows.
struct OurPictures {
  Job job;
  Frame rastered, traced;
  bool raster = false;  // the one to be compared with is the z-buffer's

  const Frame& chosen() const { return raster ? rastered : traced; }
  Picture picture() const;
};
// flags.size and flags.crop are taken from the picture. Throws InputError, UsageError, NumericalFault.
OurPictures render_ours(const JobFlags& flags, const Picture& theirs, bool raster);

// A sum of terms that gives the colour of some pixels that are over.
struct Reason {
  std::string text;  // "ours without the shadow"
  std::uint64_t pixels = 0;
};

struct WorstPixel {
  std::size_t index = 0;
  std::string equals;   // as Reason::text; empty where no sum fits
  std::string explain;  // the command that shows our colour's making
};

struct Account {
  double rms_raster = 0, rms_raytrace = 0;  // of theirs against each of ours
  std::vector<Reason> reasons;              // of all pixels that are over, the most frequent first
  std::uint64_t without_reason = 0;
  std::vector<WorstPixel> worst;  // at most five, not all from one spot
};
// `pair`: theirs, then ours.picture(). Pixels are over as `fail` says.
Account account_for(const OurPictures& ours, const PicturePair& pair, double fail);

// For a person.
std::string account_text(const Account& account, const OurPictures& ours, const PicturePair& pair);
// {renderer, nearer, rms: {raster, raytrace}, reasons: [{equals, pixels}], without_reason, worst: [{x, y, picture,
// ours, off, primitive, object, line, material, shadow, reflection, refraction, equals, explain}]}. nearer is null
// where both are equally near. picture, ours and off are in the values compared (picture_pair.h; the key "values" of the
// findings), the terms always linear; off is null where not finite, equals where no sum fits.
Json account_json(const Account& account, const OurPictures& ours, const PicturePair& pair);

}  // namespace sidelight
