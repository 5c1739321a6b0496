#include "cli/campaigns/study/study_folder.hpp"

#include "cli/campaigns/study/declare_study.hpp"
#include "cli/campaigns/study/saved_settings.hpp"
#include "cli/campaigns/study/study_runner.hpp"
#include "cli/slurm/slurm_queue.hpp"
#include "cli/slurm/slurm_script.hpp"
#include "engine/files/own_files.hpp"
#include "scenes/whole_settings.hpp"

namespace pulvis {

namespace fs = std::filesystem;

void require_own_study(const fs::path& folder, const fs::path& study) {
  for (const char* const name :
       {"study.toml", "study.csv", "variations.csv", "effects.csv", "fits.csv", "strengths.csv",
        "sensitivities.csv", "summary.json", "curves.json", "report.html", slurm_arrays_file,
        slurm_script_file}) {
    require_another(study, folder / name);
    require_own_or_none(folder / name, role::study);
  }
  std::error_code ignored;
  if (fs::exists(folder / "run.h5", ignored))
    throw RunFolderTaken(folder, "run a study here",
                         "it holds a run; allowed: a folder of its own");
}

FolderLock lock_study(const fs::path& folder) {
  make_folder(folder);
  return FolderLock(folder, "another study is running in it");
}

void save_study(const fs::path& folder, const Study& study) {
  save_settings(folder / "study.toml", role::study,
                whole_settings({study.text, study.file, schema::study_language(), study.files,
                                study.overrides}));
}

std::map<std::string, std::string> runs_elsewhere(const fs::path& folder, const Study& study,
                                                  std::map<std::string, std::string> known) {
  for (const StudyRun& run : study.runs)
    if (!known.contains(run.name) && is_locked(folder / run.name))
      known[run.name] = "under way: another run is writing into its folder";
  return known;
}

}  // namespace pulvis
