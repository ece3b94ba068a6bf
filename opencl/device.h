// An OpenCL device and the programs that are built for it.
#pragma once

#include <string>
#include <vector>

#include "opencl/headers.h"

namespace elastogen::opencl {

/// A device with a context and a queue of its own; commands run in their order.
struct Device {
  explicit Device(const cl::Device& found);

  cl::Device device;
  cl::Context context;
  cl::CommandQueue queue;

  [[nodiscard]] std::string name() const;  ///< "NVIDIA H200 (NVIDIA CUDA)"
  [[nodiscard]] bool has_double() const;   ///< cl_khr_fp64
};

/// Devices of all platforms, in the order in which OpenCL names them; empty without OpenCL driver.
[[nodiscard]] std::vector<cl::Device> find_devices();

enum class Precision { single, double_ };

/// A program and what its compiler said, which is nothing for sources without warnings.
struct Program {
  cl::Program program;
  std::string log;
};

/// Builds one source that may include "opencl/prelude.cl", found below `include_folder`.
/// @param options      for the device's compiler, beside what the source needs
/// @throws InputError  double on a device that has none
/// @throws WorkError   the source does not compile; has the compiler's log
[[nodiscard]] Program build_program(const Device& device, const std::string& source,
                                    Precision precision, const std::string& include_folder,
                                    const std::string& options = "");

}  // namespace elastogen::opencl
