#include "identify/step_identification.hpp"

#include "identify/measurement.hpp"
#include "identify/output_files.hpp"
#include "identify/step_picture.hpp"

namespace berm::identify {

namespace {

void fit_all(StepResult& result, const config::MachineFile& machine, const std::vector<StepRun>& runs) {
  for (std::size_t j = 0; j < result.fit.size(); ++j) {
    for (std::size_t d = 0; d < 2; ++d) {
      std::vector<const StepRecord*> records;
      for (const StepRun& run : runs)
        for (const StepRecord& record : run.records)
          if (record.plan.joint == j && (record.plan.direction > 0.0) == (d == 0)) records.push_back(&record);
      result.fit[j][d] = fit_steps(records, j == swing ? result.reach_m.size() : 1, machine.joint[j].velocity_max, machine.joint[j].acceleration_max);
    }
  }
}

// The models have a place in the file, and it can be read with some there: known before hours of tests, not after.
void check_editable(StepResult result) {
  constexpr double kAny_s = 0.1, kAnyRate = 1.0, kAnyPayload_kg = 1000.0;
  result.weighed_kg = kAnyPayload_kg;
  for (std::size_t j = 0; j < result.fit.size(); ++j) {
    StepFit any;
    any.dead_time.value = any.lag.value = any.stop_lag.value = kAny_s;
    any.gain.value = 1.0;
    for (auto* rates : {&any.speeding, &any.slowing}) rates->fill(std::vector<Fitted>(j == swing ? result.reach_m.size() : 1, Fitted{kAnyRate, 0.0}));
    result.fit[j] = {any, any};
  }
  check_readable(step_machine_text(result));
}

}  // namespace

void identify_steps(const Options& options) {
  StepResult result;
  const config::MachineFile machine = begin_measurement(options, result);
  for (const Station& station : step_stations(machine, swing)) result.reach_m.push_back(station.reach_m);

  check_editable(result);

  std::vector<StepRun> runs;
  run_all(options, result, [&](const BenchPlace& place, bool loaded, const run::Interruption& interruption, const Say& say) {
    runs.push_back(run_steps(machine, {place, loaded}, interruption, say));
    return RunTaken{runs.back().weighed_kg, runs.back().simulated_s};
  });
  fit_all(result, machine, runs);
  write_findings(options, result, {step_machine_text(result), step_json_text(result, machine), step_summary_text(result, machine),
                                   [&](const std::string& path) { write_step_picture(path, result, machine, runs); }});
}

}  // namespace berm::identify
