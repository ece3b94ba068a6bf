#include "opencl/device.h"

#include <fmt/format.h>

#include "runtime/error.h"

namespace elastogen::opencl {
namespace {

/// OpenCL ends some of its texts with a zero or blanks.
std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\0' || text.back() == ' ' || text.back() == '\n')) {
    text.pop_back();
  }
  return text;
}

}  // namespace

Device::Device(const cl::Device& found) : device(found), context(found), queue(context, found) {}

std::string Device::name() const {
  const cl::Platform platform(device.getInfo<CL_DEVICE_PLATFORM>());
  return fmt::format("{} ({})", trimmed(device.getInfo<CL_DEVICE_NAME>()),
                     trimmed(platform.getInfo<CL_PLATFORM_NAME>()));
}

bool Device::has_double() const { return device.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>() != 0; }

std::vector<cl::Device> find_devices() {
  std::vector<cl::Platform> platforms;
  try {
    cl::Platform::get(&platforms);
  } catch (const cl::Error&) {  // the loader has found no driver
    return {};
  }
  std::vector<cl::Device> all;
  for (const cl::Platform& platform : platforms) {
    std::vector<cl::Device> devices;
    try {
      platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    } catch (const cl::Error& error) {
      if (error.err() != CL_DEVICE_NOT_FOUND) throw;
    }
    all.insert(all.end(), devices.begin(), devices.end());
  }
  return all;
}

Program build_program(const Device& device, const std::string& source, Precision precision,
                      const std::string& include_folder, const std::string& options) {
  if (precision == Precision::double_ && !device.has_double()) {
    throw InputError(fmt::format(
        "OpenCL device '{}' has no double precision (cl_khr_fp64); use float", device.name()));
  }
  Program result{cl::Program(device.context, source), ""};
  std::string all_options = fmt::format("-cl-std=CL1.2 -I {} {}", include_folder, options);
  if (precision == Precision::double_) all_options += " -D ELASTOGEN_DOUBLE";
  try {
    result.program.build({device.device}, all_options.c_str());
  } catch (const cl::Error& error) {
    throw WorkError(fmt::format(
        "OpenCL device '{}' cannot build a program (error {}):\n{}", device.name(), error.err(),
        trimmed(result.program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.device))));
  }
  result.log = trimmed(result.program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.device));
  return result;
}

}  // namespace elastogen::opencl
