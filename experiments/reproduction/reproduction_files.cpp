#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/csv_cell.h"
#include "experiments/reproduction/reproduction_page.h"
#include "kernel/atomic_file.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kPictures = "images/reproduction";

// JSON has no infinity: a figure without a value is null.
Json Number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json ResultJson(const ClaimResult& result) {
  Json json = {{"of", result.subject},
               {"verdict", VerdictName(result.verdict)},
               {"seeds", result.seeds},
               {"on_every_seed", result.on_every_seed}};
  if (result.figure) {
    json["median"] = Number(result.figure->median);
    json["least"] = Number(result.figure->least);
    json["greatest"] = Number(result.figure->greatest);
  }
  return json;
}

std::string ClaimsJson(const Reproduction& reproduction) {
  Json claims = Json::array();
  for (const JudgedClaim& judged : reproduction.claims) {
    const Claim& claim = *judged.claim;
    Json results = Json::array();
    for (const ClaimResult& result : judged.results) results.push_back(ResultJson(result));
    const auto study = reproduction.studies.find(claim.study);
    const bool is_tested = study != reproduction.studies.end();
    claims.push_back({{"topic", claim.topic},
                      {"claim", claim.words},
                      {"place", claim.place},
                      {"study", claim.study},
                      {"figure", claim.figure},
                      {"planned_runs", is_tested ? study->second.planned : 0},
                      {"finished_runs", is_tested ? study->second.finished.runs.size() : 0},
                      {"results", results}});
  }
  return Json({{"format", "curvefusion-claims"}, {"claims", claims}}).dump(1) + "\n";
}

std::string ClaimsCsv(const Table& table) {
  std::string text;
  const auto add = [&](std::vector<std::string> cells) {
    for (std::string& cell : cells) cell = CsvCell(cell);
    text += fmt::format("{}\n", fmt::join(cells, ","));
  };
  add(table.headings);
  for (const auto& row : table.rows) add(row);
  return text;
}

void CopyPictures(const Reproduction& reproduction, const fs::path& folder) {
  fs::create_directories(folder / kPictures);
  for (const auto& [name, state] : reproduction.studies) {
    for (const std::string& picture : PicturesOf(state.finished)) {
      WriteFileAtomically(folder / kPictures / picture, [&](const fs::path& temporary) {
        fs::copy_file(folder / picture, temporary, fs::copy_options::overwrite_existing);
      });
    }
  }
}

}  // namespace

void WriteReproduction(const StudyRequest& request, const fs::path& folder) {
  const Reproduction reproduction = JudgeClaims(request, folder);
  const Table table = ClaimTable(reproduction);
  CopyPictures(reproduction, folder);
  WriteTable(folder, "reproduction_claims", table);
  WriteBytesAtomically(folder / "reproduction_claims.csv", ClaimsCsv(table));
  WriteBytesAtomically(folder / "reproduction_claims.json", ClaimsJson(reproduction));
  WriteBytesAtomically(folder / "reproduction.md",
                       ReproductionPage(reproduction, request, kPictures));
}

}  // namespace curvefusion
