// Embree, started when it is first needed and shared by all threads.
#pragma once

#include <mutex>

namespace tact::narrowphase {

class EmbreeDevice {
 public:
  EmbreeDevice();
  ~EmbreeDevice();  // NOLINT: one of two definitions does nothing, that without Embree
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  // The RTCDevice; null where Embree was left out, and once memory was too short for the first one of the process.
  // Errors: backend_failure, out_of_memory.
  void* get();
  bool started() const;

 private:
  mutable std::mutex mutex_;
  void* device_ = nullptr;
};

}  // namespace tact::narrowphase
