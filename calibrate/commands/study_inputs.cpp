#include "calibrate/commands/study_inputs.hpp"

#include "calibrate/measurements/read_table.hpp"

namespace taylorcal::calibrate {

StudyInputs::StudyInputs(const InputPaths& paths)
    : settings(read_settings(paths.settings)),
      set(make_data_set(read_measurements(paths.measurements), settings.fit_sizes)),
      space(settings.parameters, set.lots),
      predictor(emulator::Emulator::from_file(paths.emulator), settings) {
    predictor.check_ranges(set);
}

}  // namespace taylorcal::calibrate
