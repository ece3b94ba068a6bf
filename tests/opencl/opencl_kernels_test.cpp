// Emitted OpenCL kernels on small mixed meshes, with the sum over nodes, against the C++ kernels of
// the same associations; on the first device that OpenCL names.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "bars.h"
#include "element_samples.h"
#include "opencl/device.h"
#include "opencl/slots.h"
#include "runtime/error.h"
#include "selector/commands/evaluation.h"
#include "selector/support/files.h"
#include "symgen/quadrature/quadrature.h"
#include "tested_kernels.h"

namespace elastogen::test {
namespace {

using opencl::Precision;
using symgen::AssociationId;

constexpr double young = 1000.0, poisson = 0.3;

/// A bar whose sections have one association each. The C++ kernels are unsplit: splits agree to
/// rounding.
struct Case {
  std::string name;
  std::vector<std::string> associations;  ///< of the OpenCL kernels
  std::vector<std::string> reference;     ///< of the C++ kernels, compiled for the tests
  bool box = false;                       ///< straight, so that hexahedra are boxes
  std::string profile = "gpu";            ///< of the OpenCL kernels
};

std::vector<std::string> on_every_element(const std::string& law, const std::string& split) {
  std::vector<std::string> associations;
  for (const char* rule : {"hexa8-q8", "pyramid5-q5", "prism6-q6", "tet4-q4"}) {
    associations.push_back(law + "-" + rule + "-" + split);
  }
  return associations;
}

std::vector<Case> cases() {
  std::vector<Case> result;
  for (const char* law : {"hooke", "stvk", "neo_hookean"}) {
    const std::vector<std::string> unsplit = on_every_element(law, "none");
    result.push_back({law, unsplit, unsplit});
  }
  result.push_back({"split", on_every_element("stvk", "lg"), on_every_element("stvk", "none")});
  const std::vector<std::string> mixed = {"neo_hookean-hexa8-q8-none", "stvk-pyramid5-q5-none",
                                          "hooke-prism6-q6-none", "neo_hookean-tet4-q1-none"};
  result.push_back({"mixed_laws_box", mixed, mixed, true});
  // Hexa20 passes, too, but takes PoCL 15 s to compile.
  const std::vector<std::string> quadratic = {"neo_hookean-tet10-q4-none"};
  result.push_back({"quadratic", quadratic, quadratic});
  // Loops over points, with constants and with what is recomputed from positions.
  result.push_back({"loops", mixed, mixed, false, "x86-cache"});
  result.push_back({"loops_box", mixed, mixed, true, "x86-cache"});
  result.push_back({"loops_from_positions", mixed, mixed, false, "x86-dram"});
  result.push_back({"loops_from_positions_box", mixed, mixed, true, "x86-dram"});
  return result;
}

Mesh mesh_of(const Case& each) {
  Mesh mesh = make_bar_mesh({4.0, 1.0, 1.0}, {4, 2, 2}, each.reference);
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> shift(-0.05, 0.05);
  for (double& x : mesh.positions) x += each.box ? 0.0 : shift(generator);
  return mesh;
}

/// Nodal vectors of a case: displacement and direction, as floats where the kernels get floats.
std::vector<double> nodal_vector(std::size_t size, double largest, std::uint32_t seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-largest, largest);
  std::vector<double> values(size);
  for (double& value : values) value = static_cast<float>(uniform(generator));
  return values;
}

ConstVectorRef as_vector(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
}

template <class Value>
cl::Buffer upload(const opencl::Device& device, std::vector<Value> values) {
  return cl::Buffer(device.context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR,
                    values.size() * sizeof(Value), values.data());
}

template <class Value>
std::vector<Value> download(const opencl::Device& device, const cl::Buffer& buffer,
                            std::size_t count) {
  std::vector<Value> values(count);
  device.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, count * sizeof(Value), values.data());
  return values;
}

/// One block of the mesh on the device, in the layout of opencl/prelude.cl.
template <class Real>
class DeviceBlock {
 public:
  /// Buffers that all blocks share.
  struct Nodal {
    cl::Buffer positions, displacement, direction, partial;
    std::uint32_t stride = 0;
  };

  DeviceBlock(const opencl::Device& device, const std::string& association,
              const std::string& geometry, const std::string& profile, const ElementBlock& block,
              const std::vector<std::int32_t>& slots, const Nodal& nodal)
      : device_(device), nodal_(nodal), num_elements_(block.num_elements()) {
    const AssociationId id = AssociationId::parse(association);
    const symgen::Law law = law_named(id.law);
    symgen::GenerateOptions options;
    options.profile = profile;
    const auto generated = symgen::generate_association(id, law, options);
    for (const symgen::VariantReport& variant : generated.variants) {
      if (variant.geometry != geometry) continue;
      num_constants_ = static_cast<std::size_t>(variant.num_constants);
      num_state_ = static_cast<std::size_t>(variant.num_state);
    }
    prefix_ = id.identifier() + "_" + geometry + "_";
    constexpr Precision precision =
        sizeof(Real) == sizeof(double) ? Precision::double_ : Precision::single;
    // What is tested is the text. Optimised as by users, long kernels take PoCL four times as long.
    const std::string how = id.element == "tet4" ? "" : "-cl-opt-disable";
    program_ = build_program(device, generated.opencl, precision, ELASTOGEN_SOURCE_DIR, how);
    EXPECT_EQ(program_.log, "") << association;

    stride_ = num_elements_ + 3;  // rows need not be full
    nodes_ = upload(device, rows(block.nodes, block.nodes_per_element));
    slots_ = upload(device, rows(slots, block.nodes_per_element));
    const std::vector<double> parameters =
        symgen::parameters_from_young_poisson(law, young, poisson);
    parameters_ = upload(device, std::vector<Real>(parameters.begin(), parameters.end()));
    constants_ =
        upload(device, std::vector<Real>(std::max<std::size_t>(num_constants_ * stride_, 1)));
    state_ = upload(device, std::vector<Real>(std::max<std::size_t>(num_state_ * stride_, 1)));
    energy_ = upload(device, std::vector<Real>(stride_));
    const int num_points = symgen::find_quadrature(id.element, id.quadrature).num_points();
    num_stress_ = static_cast<std::size_t>(stress_numbers * num_points);
    stress_ = upload(device, std::vector<Real>(num_stress_ * stride_));
    status_ = upload(device, std::vector<std::uint32_t>(num_elements_));
    run("constants", constants_);
  }

  void run(const std::string& operation, const cl::Buffer& output) {
    cl::Kernel kernel(program_.program, (prefix_ + operation).c_str());
    cl_uint at = 0;
    for (const std::size_t number :
         {num_elements_, stride_, static_cast<std::size_t>(nodal_.stride)}) {
      kernel.setArg(at++, static_cast<cl_uint>(number));
    }
    for (const cl::Buffer& buffer :
         {nodes_, slots_, nodal_.positions, parameters_, constants_, nodal_.displacement,
          nodal_.direction, state_, output, status_}) {
      kernel.setArg(at++, buffer);
    }
    constexpr std::size_t local = 8;  // the last group has idle items
    const std::size_t global = (num_elements_ + local - 1) / local * local;
    device_.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(global),
                                       cl::NDRange(local));
  }
  void run_into_slots(const std::string& operation) { run(operation, nodal_.partial); }
  void linearize() { run("linearize", state_); }

  std::vector<Real> energies() {
    run("energy", energy_);
    return download<Real>(device_, energy_, num_elements_);
  }
  /// Numbers of the operation `stress`, element after element.
  std::vector<double> stresses() {
    run("stress", stress_);
    const auto rows = download<Real>(device_, stress_, num_stress_ * stride_);
    std::vector<double> all;
    for (std::size_t e = 0; e < num_elements_; ++e) {
      for (std::size_t k = 0; k < num_stress_; ++k) all.push_back(rows[k * stride_ + e]);
    }
    return all;
  }
  std::vector<std::uint32_t> status() {
    return download<std::uint32_t>(device_, status_, num_elements_);
  }

 private:
  /// rows[a * stride + e] of values[e * nodes_per_element + a]
  [[nodiscard]] std::vector<std::int32_t> rows(const std::vector<std::int32_t>& values,
                                               int nodes_per_element) const {
    const std::size_t n = static_cast<std::size_t>(nodes_per_element);
    std::vector<std::int32_t> result(n * stride_);
    for (std::size_t e = 0; e < num_elements_; ++e) {
      for (std::size_t a = 0; a < n; ++a) result[a * stride_ + e] = values[e * n + a];
    }
    return result;
  }

  const opencl::Device& device_;
  const Nodal& nodal_;
  std::size_t num_elements_, num_constants_ = 0, num_state_ = 0, num_stress_ = 0, stride_ = 0;
  std::string prefix_;
  opencl::Program program_;
  cl::Buffer nodes_, slots_, parameters_, constants_, state_, energy_, stress_, status_;
};

/// Whether a block of a case has elements of the box variant.
bool is_box(const Case& each, const ElementBlock& block) {
  return each.box && block.element == "hexa8";
}

/// A mesh on the device, one block per association.
template <class Real>
class DeviceModel {
 public:
  DeviceModel(const opencl::Device& device, const Mesh& mesh, const Case& each,
              const std::vector<double>& displacement, const std::vector<double>& direction)
      : device_(device), slots_(opencl::number_slots(mesh)), num_nodes_(mesh.num_nodes()) {
    nodal_.stride = static_cast<std::uint32_t>(num_nodes_ + 5);
    nodal_.positions = nodal(mesh.positions);
    nodal_.displacement = nodal(displacement);
    nodal_.direction = nodal(direction);
    // Slots that no element writes are never read: what is there must not matter.
    const auto nan = std::numeric_limits<Real>::quiet_NaN();
    nodal_.partial = upload(
        device_,
        std::vector<Real>(static_cast<std::size_t>(slots_.max_slots) * 3 * nodal_.stride, nan));
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
      const bool box = is_box(each, mesh.blocks[b]);
      blocks_.emplace_back(device, each.associations[b], box ? "box" : "general", each.profile,
                           mesh.blocks[b], slots_.of_elements[b], nodal_);
    }
    const std::string folder = ELASTOGEN_SOURCE_DIR;
    sum_ = build_program(device, selector::read_text_file(folder + "/opencl/node_sum.cl", "OpenCL"),
                         sizeof(Real) == sizeof(double) ? Precision::double_ : Precision::single,
                         folder);
    EXPECT_EQ(sum_.log, "");
  }

  /// start + scale * the operation's sum over elements
  std::vector<double> summed(const std::string& operation, double scale, double start) {
    for (auto& block : blocks_) block.run_into_slots(operation);
    cl::Buffer result =
        upload(device_, std::vector<Real>(3 * num_nodes_, static_cast<Real>(start)));
    cl::Buffer num_slots = upload(device_, slots_.num_slots);
    cl::Kernel kernel(sum_.program, "elastogen_node_sum");
    kernel.setArg(0, static_cast<cl_uint>(num_nodes_));
    kernel.setArg(1, static_cast<cl_uint>(nodal_.stride));
    kernel.setArg(2, static_cast<cl_uint>(3));
    kernel.setArg(3, static_cast<Real>(scale));
    kernel.setArg(4, num_slots);
    kernel.setArg(5, nodal_.partial);
    kernel.setArg(6, result);
    device_.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(num_nodes_ + 3));
    const auto values = download<Real>(device_, result, 3 * num_nodes_);
    return {values.begin(), values.end()};
  }
  void linearize() {
    for (auto& block : blocks_) block.linearize();
  }
  std::vector<double> energies() {
    std::vector<double> all;
    for (auto& block : blocks_) {
      for (const Real energy : block.energies()) all.push_back(energy);
    }
    return all;
  }
  /// Of each block.
  std::vector<std::vector<double>> stresses() {
    std::vector<std::vector<double>> all;
    for (auto& block : blocks_) all.push_back(block.stresses());
    return all;
  }
  /// Of the elements in mesh order, of all operations so far.
  std::vector<std::uint32_t> status() {
    std::vector<std::uint32_t> all;
    for (auto& block : blocks_) {
      for (const std::uint32_t bits : block.status()) all.push_back(bits);
    }
    return all;
  }

 private:
  [[nodiscard]] cl::Buffer nodal(const std::vector<double>& values) const {
    return upload(device_, std::vector<Real>(values.begin(), values.end()));
  }

  const opencl::Device& device_;
  opencl::Slots slots_;
  std::size_t num_nodes_;
  typename DeviceBlock<Real>::Nodal nodal_;
  std::vector<DeviceBlock<Real>> blocks_;
  opencl::Program sum_;
};

/// What the C++ kernels say of the stress in a block, element after element.
std::vector<double> expected_stresses(const Case& each, const Mesh& mesh, std::size_t b,
                                      const std::vector<double>& displacement) {
  const ElementBlock& block = mesh.blocks[b];
  const AssociationId id = AssociationId::parse(each.reference[b]);
  const KernelTable<double>& table = *kernels_of(each.reference[b]).double_table();
  symgen::ElementCase input;
  input.parameters = symgen::parameters_from_young_poisson(law_named(id.law), young, poisson);
  std::vector<double> all;
  const auto n = static_cast<std::size_t>(block.nodes_per_element);
  for (std::size_t e = 0; e < block.num_elements(); ++e) {
    input.rest_positions.clear();
    input.displacement.clear();
    for (std::size_t a = 0; a < n; ++a) {
      const auto node = static_cast<std::size_t>(block.nodes[e * n + a]);
      for (std::size_t i = 0; i < 3; ++i) {
        input.rest_positions.push_back(mesh.positions[3 * node + i]);
        input.displacement.push_back(displacement[3 * node + i]);
      }
    }
    const std::vector<double> found =
        selector::evaluate_kernels(table, is_box(each, block) ? "box" : "general", input).stress;
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

void expect_near(const std::vector<double>& found, const Vector& expected, double tolerance) {
  ASSERT_EQ(found.size(), static_cast<std::size_t>(expected.size()));
  const double scale = expected.cwiseAbs().maxCoeff();
  ASSERT_GT(scale, 0.0);
  double worst = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const double error = std::abs(found[k] - expected[static_cast<Eigen::Index>(k)]) / scale;
    ASSERT_TRUE(std::isfinite(error)) << k;
    worst = std::max(worst, error);
  }
  EXPECT_LT(worst, tolerance);
}

class OpenclKernels : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const std::vector<cl::Device> devices = opencl::find_devices();
    if (devices.empty()) {
      GTEST_SKIP() << "no OpenCL device (Debian: pocl-opencl-icd); the OpenCL kernels are not run";
    }
    device_.emplace(devices[0]);
    RecordProperty("device", device_->name());
  }

  template <class Real>
  void expect_agreement(double tolerance) {
    const Case& each = GetParam();
    Mesh mesh = mesh_of(each);
    for (double& x : mesh.positions) x = static_cast<float>(x);
    const std::vector<double> u = nodal_vector(mesh.positions.size(), 0.02, 1);
    const std::vector<double> v = nodal_vector(mesh.positions.size(), 1.0, 2);
    Model model(mesh, parts_of(mesh, each.reference, young, poisson, 0.0));
    DeviceModel<Real> device(*device_, mesh, each, u, v);

    Vector forces = Vector::Constant(static_cast<Eigen::Index>(u.size()), 0.25);
    model.forces(as_vector(u), forces);
    expect_near(device.summed("forces", 1.0, 0.25), forces, tolerance);

    std::vector<double> energies;
    model.element_energies(as_vector(u), energies);
    const std::vector<double> found = device.energies();
    ASSERT_EQ(found.size(), energies.size());
    for (std::size_t e = 0; e < found.size(); ++e) {
      EXPECT_NEAR(found[e], energies[e], tolerance * largest(energies)) << "element " << e;
    }

    const std::vector<std::vector<double>> stresses = device.stresses();
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
      const std::vector<double> expected = expected_stresses(each, mesh, b, u);
      ASSERT_EQ(stresses[b].size(), expected.size());
      // Gradients, stresses, energy densities and volumes have a size each.
      const auto quantity_of = [](std::size_t k) -> std::size_t {
        const std::size_t number = k % stress_numbers;
        return number < 9 ? 0 : number < 18 ? 1 : number - 16;
      };
      std::array<double, 4> size{};
      for (std::size_t k = 0; k < expected.size(); ++k) {
        double& most = size[quantity_of(k)];
        most = std::max(most, std::abs(expected[k]));
      }
      for (std::size_t k = 0; k < expected.size(); ++k) {
        ASSERT_NEAR(stresses[b][k], expected[k], tolerance * size[quantity_of(k)]) << k;
      }
    }

    model.linearize(as_vector(u));
    Vector product = Vector::Constant(static_cast<Eigen::Index>(u.size()), 3.0);
    model.product(as_vector(v), -0.5, product);
    expect_near(device.summed("product", -0.5, 3.0), product, tolerance);
    device.linearize();
    expect_near(device.summed("apply", -0.5, 3.0), product, tolerance);

    for (const std::uint32_t bits : device.status()) EXPECT_EQ(bits, status_ok);
  }

  std::optional<opencl::Device> device_;
};

TEST_P(OpenclKernels, AgreeWithTheCppKernelsInDouble) {
  if (!device_->has_double()) GTEST_SKIP() << device_->name() << " has no double precision";
  expect_agreement<double>(1e-13);
}

TEST_P(OpenclKernels, AgreeWithTheCppKernelsInFloat) { expect_agreement<float>(1e-5); }

TEST_P(OpenclKernels, ReportWhatIsWrongWithAnElement) {
  const Case& each = GetParam();
  const Mesh mesh = mesh_of(each);
  std::vector<double> u(mesh.positions.size(), 0.0);
  const std::vector<double> v = nodal_vector(u.size(), 1.0, 2);
  const std::int32_t node = mesh.blocks[0].nodes[0];
  u[static_cast<std::size_t>(3 * node)] = std::numeric_limits<double>::quiet_NaN();
  DeviceModel<float> not_finite(*device_, mesh, each, u, v);
  (void)not_finite.energies();
  const std::vector<std::uint32_t> status = not_finite.status();
  EXPECT_NE(status[0] & status_not_finite, 0U);
  EXPECT_EQ(status.back(), status_ok);

  if (each.name != "neo_hookean") return;
  // Mirrored, det F = -1 everywhere; forces say so without the logarithm's own result.
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = k % 3 == 0 ? -2 * mesh.positions[k] : 0.0;
  DeviceModel<float> mirrored(*device_, mesh, each, u, v);
  (void)mirrored.summed("forces", 1.0, 0.0);
  for (const std::uint32_t bits : mirrored.status()) EXPECT_NE(bits & status_outside_domain, 0U);
}

INSTANTIATE_TEST_SUITE_P(Meshes, OpenclKernels, ::testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

TEST(OpenclProgram, RefusesASourceThatDoesNotCompile) {
  const std::vector<cl::Device> devices = opencl::find_devices();
  if (devices.empty()) GTEST_SKIP() << "no OpenCL device";
  const opencl::Device device(devices[0]);
  EXPECT_THROW((void)build_program(device, "__kernel void f(", Precision::single, "."), WorkError);
}

TEST(OpenclSource, SameInputGivesSameBytes) {
  for (const char* text : {"stvk-hexa8-q8-none", "neo_hookean-prism6-q6-lg"}) {
    const AssociationId id = AssociationId::parse(text);
    const auto first = symgen::generate_association(id, law_named(id.law), {});
    EXPECT_EQ(first.opencl, symgen::generate_association(id, law_named(id.law), {}).opencl);
    EXPECT_EQ(first.opencl.find(ELASTOGEN_SOURCE_DIR), std::string::npos);
  }
}

}  // namespace
}  // namespace elastogen::test
