// What a party of the plane benchmark did over all sweeps of one density, and the rows that compare two of them.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planes_sweep.hpp"

namespace berm::bench {

struct PlaneTally {
  std::string name;
  std::vector<double> ms, normals_ms;  // of each sweep
  std::vector<FaceError> faces;        // of all sweeps, in the same order for every party
  std::size_t planes = 0;              // found, of walls or not

  [[nodiscard]] std::size_t matched() const;
  [[nodiscard]] double recall() const;
};

struct CommonErrors {
  std::size_t faces = 0;                // that both matched
  std::vector<double> angle_deg[2], offset_m[2], bare_offset_m[2];
};
CommonErrors common_errors(const PlaneTally& a, const PlaneTally& b);

void print_tally(const PlaneTally& tally);

// Rows of speed, recall and errors: stage is what of ours is compared. reference: of speed the returns of a sweep, of errors the faces that both
// matched, of recall all faces. Ratio of recall: of counts plus one. No rows of errors where no face was matched by both.
void add_rows(nlohmann::json& rows, const std::string& stage, int samples, double returns, const PlaneTally& ours, const PlaneTally& peer,
              const std::string& name);
// How many times longer a dense sweep takes than the usual one of the same scene; reference: how many times more returns it has.
void add_scaling_row(nlohmann::json& rows, const std::string& stage, const std::array<PlaneTally, 2>& ours,
                     const std::array<PlaneTally, 2>& peer, double returns, const std::string& name);

}  // namespace berm::bench
