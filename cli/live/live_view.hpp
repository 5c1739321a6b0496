// pulvis run --live: the process that watches the run of this one.
#pragma once

#include <sys/types.h>

#include <filesystem>

#include "engine/files/file_descriptor.hpp"

namespace pulvis {

class LiveView {
 public:
  // The folder already has the run's results. Whatever goes wrong is only told: the run goes on without a view.
  LiveView(const std::filesystem::path& folder, int port);
  // Waits until the open pages have the end of the run, some seconds at most.
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView& operator=(const LiveView&) = delete;

 private:
  FileDescriptor alive_;  // the view ends after this is closed, however that happens
  pid_t child_ = -1;
};

}  // namespace pulvis
