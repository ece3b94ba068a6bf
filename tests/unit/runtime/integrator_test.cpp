// Time integration: order, conservation, damping, stability limits, prescribed motion, restart.
#include "runtime/integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "runtime/error.h"
#include "runtime/loads.h"
#include "runtime/newton.h"
#include "runtime/stable_step.h"
#include "tests/unit/runtime/test_meshes.h"

namespace elastogen::test {
namespace {

constexpr IntegrationScheme implicit = IntegrationScheme::implicit_euler;
constexpr IntegrationScheme symplectic = IntegrationScheme::symplectic_euler;
constexpr IntegrationScheme central = IntegrationScheme::central_differences;

/// A short bar, E = 1e5 Pa, 1000 kg/m^3, with whatever holds it.
class Body {
 public:
  explicit Body(bool clamped)
      : mesh(bar_mesh("hexa8", {3, 1, 1}, {3, 1, 1})),
        table(ReferenceKernels<Hexa8, 8, false>::table()),
        model(mesh, one_part(mesh, table), {.threads = 1}),
        constraints(clamped ? clamp_left(mesh) : Constraints(mesh.num_nodes(), 3)),
        motion(constraints),
        load(Vector::Zero(static_cast<Eigen::Index>(model.num_dofs()))),
        start(start_of_motion(model, std::array{0.0, 0.0, 0.0})) {}

  [[nodiscard]] std::unique_ptr<Integrator> integrate(const IntegratorOptions& options) {
    return make_integrator(model, constraints, motion, load, options, start);
  }
  /// The state after `steps` steps that take `duration` together.
  [[nodiscard]] MotionState after(double duration, int steps, IntegratorOptions options) {
    options.step = duration / steps;
    const auto integrator = integrate(options);
    for (int i = 0; i < steps; ++i) integrator->step();
    return integrator->state();
  }

  Mesh mesh;
  KernelTable<double> table;
  Model model;
  Constraints constraints;
  PrescribedMotion motion;
  Vector load;
  MotionState start;
};

IntegratorOptions options_of(IntegrationScheme scheme, double step = 1e-3, double damping = 0) {
  IntegratorOptions options;
  options.scheme = scheme;
  options.step = step;
  options.damping = damping;
  options.linear_tolerance = 1e-12;
  return options;
}

/// The unit square as one quadrilateral.
Mesh plane_square() {
  Mesh mesh;
  mesh.dim = 2;
  mesh.positions = {0, 0, 1, 0, 1, 1, 0, 1};
  return mesh;
}

std::string scheme_test_name(const testing::TestParamInfo<IntegrationScheme>& info) {
  return std::string(scheme_name(info.param));
}

class Scheme : public testing::TestWithParam<IntegrationScheme> {};

TEST_P(Scheme, HasItsOrderOfAccuracy) {
  for (const double damping : {0.0, 2.0}) {
    Body body(true);
    add_gravity(body.model, std::array{0.3, 0.0, -0.3}, body.load);
    const double duration = 0.4;
    const IntegratorOptions options = options_of(GetParam(), 1, damping);
    const MotionState exact = body.after(duration, 6400, options_of(central, 1, damping));
    const double coarse = (body.after(duration, 100, options).u - exact.u).norm();
    const double fine = (body.after(duration, 200, options).u - exact.u).norm();
    const double order = GetParam() == central ? 2 : 1;
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.15) << "damping " << damping;
  }
}

TEST_P(Scheme, FreeFlightKeepsMomentumAndFallsAsGalileiSays) {
  Body body(false);
  body.start = start_of_motion(body.model, std::array{1.0, 0.0, 2.0});
  add_gravity(body.model, std::array{0.0, 0.0, -10.0}, body.load);
  const MotionState end = body.after(0.5, 500, options_of(GetParam()));
  const double exact = 2.0 * 0.5 - 0.5 * 10 * 0.5 * 0.5;
  // First order: h g t / 2 off.
  const double error = GetParam() == central ? 1e-10 : 10 * 0.5 * 1e-3 / 2 * 1.01;
  for (Eigen::Index k = 0; k < end.u.size(); k += 3) {
    EXPECT_NEAR(end.u[k], 0.5, 1e-10);
    EXPECT_NEAR(end.u[k + 2], exact, error);
    EXPECT_NEAR(end.v[k], 1, 1e-10);
    EXPECT_NEAR(end.v[k + 2], 2 - 10 * 0.5, 1e-9);
  }
}

TEST_P(Scheme, MomentaOfADeformingFreeBodyStay) {
  Body body(false);
  body.start.v = random_vector(body.model.num_dofs(), 0.05, 11);
  const auto integrator = body.integrate(options_of(GetParam()));
  const auto momentum = [&] {
    Vector3 p = Vector3::Zero();
    for (Eigen::Index k = 0; k < body.start.v.size(); ++k) {
      p[k % 3] +=
          body.model.lumped_mass()[static_cast<std::size_t>(k / 3)] * integrator->state().v[k];
    }
    return p;
  };
  const Vector3 before = momentum();
  for (int i = 0; i < 200; ++i) integrator->step();
  EXPECT_LT((momentum() - before).norm(), 1e-8 * before.norm());
}

TEST_P(Scheme, DampingStopsAFreeBody) {
  Body body(false);
  body.start = start_of_motion(body.model, std::array{1.0, 0.0, 0.0});
  const double alpha = 3;
  const MotionState end = body.after(0.5, 2000, options_of(GetParam(), 1, alpha));
  EXPECT_NEAR(end.v[0], std::exp(-alpha * 0.5), GetParam() == central ? 1e-6 : 1e-3);
}

TEST_P(Scheme, ComesToRestAtTheStaticSolution) {
  Body body(true);
  add_gravity(body.model, std::array{0.0, 0.0, -0.05}, body.load);
  Vector rest = body.start.u;
  NewtonOptions tight;
  tight.tolerance = 1e-10;
  ASSERT_EQ(solve_static(body.model, body.constraints, body.load, tight, rest).status,
            NewtonStatus::converged);
  const auto integrator = body.integrate(options_of(GetParam(), 0.02, 2));
  for (int i = 0; i < 1250; ++i) integrator->step();
  EXPECT_LT((integrator->state().u - rest).norm(), 1e-7 * rest.norm());
  EXPECT_LT(integrator->kinetic_energy(), 1e-12);
  double reaction = 0;
  const Vector reactions = integrator->reactions();
  for (Eigen::Index k = 2; k < reactions.size(); k += 3) reaction += reactions[k];
  EXPECT_NEAR(reaction, 3 * 1000 * 0.05, 1e-4);
}

TEST_P(Scheme, GoesOnFromAStateToTheSameBits) {
  Body body(true);
  add_gravity(body.model, std::array{0.0, 0.0, -1.0}, body.load);
  const IntegratorOptions options = options_of(GetParam());
  const auto whole = body.integrate(options);
  for (int i = 0; i < 40; ++i) whole->step();
  const auto first = body.integrate(options);
  for (int i = 0; i < 17; ++i) first->step();
  (void)first->reactions();  // asking for results changes nothing
  Body again(true);
  add_gravity(again.model, std::array{0.0, 0.0, -1.0}, again.load);
  again.start = first->state();
  const auto second = again.integrate(options);
  for (int i = 17; i < 40; ++i) second->step();
  EXPECT_EQ(second->state().step, 40);
  EXPECT_EQ((second->state().u - whole->state().u).norm(), 0.0);
  EXPECT_EQ((second->state().v - whole->state().v).norm(), 0.0);
  EXPECT_EQ((second->state().a - whole->state().a).norm(), 0.0);
}

TEST_P(Scheme, FollowsAPrescribedMotion) {
  Body body(true);
  std::vector<std::size_t> driven;
  for (std::size_t node = 0; node < body.mesh.num_nodes(); ++node) {
    if (body.mesh.positions[3 * node] < 2.999) continue;
    body.constraints.fix(node, 0);
    driven.push_back(node);
  }
  body.motion = PrescribedMotion(body.constraints);
  for (const std::size_t node : driven) body.motion.translate(node, 0, 0.1, History::sine(1));
  const auto integrator = body.integrate(options_of(GetParam()));
  for (int i = 0; i < 125; ++i) integrator->step();
  const double angle = 2 * std::numbers::pi * 0.125;
  const auto dof = static_cast<Eigen::Index>(3 * driven.front());
  EXPECT_NEAR(integrator->state().u[dof], 0.1 * std::sin(angle), 1e-15);
  EXPECT_NEAR(integrator->state().v[dof], 0.1 * 2 * std::numbers::pi * std::cos(angle),
              GetParam() == central ? 1e-5 : 3e-3);
  EXPECT_GT(integrator->state().u.head(dof).cwiseAbs().maxCoeff(), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(All, Scheme, testing::Values(implicit, symplectic, central),
                         scheme_test_name);

TEST(Integrators, CentralDifferencesAreThoseOfChecoury) {
  // Three steps by eq. 3.3 as it stands, from u(-h) = u - h v + h^2/2 (a - alpha v).
  Body body(true);
  body.start.v = random_vector(body.model.num_dofs(), 0.1, 5);
  body.constraints.project(body.start.v);
  const double h = 2e-3, alpha = 3;
  const auto integrator = body.integrate(options_of(central, h, alpha));
  Vector mass(body.start.u.size());
  for (Eigen::Index k = 0; k < mass.size(); ++k) {
    mass[k] = body.model.lumped_mass()[static_cast<std::size_t>(k / 3)];
  }
  Vector now = body.start.u;
  Vector before = now - h * body.start.v - h * h / 2 * alpha * body.start.v;
  for (int i = 0; i < 3; ++i) {
    Vector force = Vector::Zero(now.size());
    body.model.forces(now, force);
    const Vector m = mass / (h * h), c = alpha * mass / (2 * h);
    Vector next =
        (force + 2 * m.cwiseProduct(now) - (m - c).cwiseProduct(before)).cwiseQuotient(m + c);
    body.constraints.impose(next);
    before = now;
    now = next;
    integrator->step();
    EXPECT_LT((integrator->state().u - now).norm(), 1e-13 * now.norm()) << i;
  }
}

TEST(Integrators, ExplicitEnergyDoesNotDrift) {
  for (const IntegrationScheme scheme : {symplectic, central}) {
    Body body(true);
    body.start.v = random_vector(body.model.num_dofs(), 0.05, 7);
    body.constraints.project(body.start.v);
    const auto integrator = body.integrate(options_of(scheme, 2e-3));
    const double start = integrator->kinetic_energy();
    double lowest = start, highest = start;
    for (int i = 0; i < 4000; ++i) {
      integrator->step();
      const double energy = integrator->kinetic_energy() + body.model.energy(integrator->state().u);
      lowest = std::min(lowest, energy);
      highest = std::max(highest, energy);
    }
    EXPECT_GT(lowest, 0.9 * start) << scheme_name(scheme);
    EXPECT_LT(highest, 1.1 * start) << scheme_name(scheme);
  }
}

TEST(Integrators, NewtonSolvesTheNonlinearStep) {
  Body body(true);
  add_gravity(body.model, std::array{0.0, 0.0, -1.0}, body.load);
  IntegratorOptions options = options_of(implicit, 0.05);
  options.newton_iterations = 20;
  options.newton_tolerance = 1e-10;
  const auto integrator = body.integrate(options);
  for (int i = 0; i < 10; ++i) {
    const MotionState before = integrator->state();
    integrator->step();
    const MotionState& after = integrator->state();
    Vector residual = integrator->internal_forces() + body.load;
    for (Eigen::Index k = 0; k < residual.size(); ++k) {
      residual[k] -= body.model.lumped_mass()[static_cast<std::size_t>(k / 3)] *
                     (after.v[k] - before.v[k]) / options.step;
    }
    body.constraints.project(residual);
    EXPECT_LT(residual.norm(), 1e-8 * body.load.norm());
  }
  EXPECT_EQ(integrator->halvings(), 0);
}

TEST(Integrators, LinearSolversAgree) {
  Body body(true);
  add_gravity(body.model, std::array{0.0, 0.0, -1.0}, body.load);
  IntegratorOptions options = options_of(implicit);
  const MotionState cg = body.after(0.2, 10, options);
  for (const auto kind : {LinearSolverKind::cholesky, LinearSolverKind::cholesky_cg,
                          LinearSolverKind::incomplete_cg}) {
    options.linear_solver.kind = kind;
    const MotionState other = body.after(0.2, 10, options);
    EXPECT_LT((cg.u - other.u).norm(), 1e-8 * cg.u.norm()) << solver_name(kind);
  }
}

TEST(Integrators, GoOnByTheMethodThatTheyFellBackTo) {
  Body body(true);
  add_gravity(body.model, std::array{0.0, 0.0, -1.0}, body.load);
  IntegratorOptions options = options_of(implicit);
  options.linear_solver.fall_back_after = 1;
  const auto first = body.integrate(options);
  EXPECT_FALSE(first->state().fell_back);
  first->step();
  EXPECT_TRUE(first->state().fell_back);
  EXPECT_EQ(first->method(), LinearSolverKind::cholesky_cg);
  body.start = first->state();
  EXPECT_EQ(body.integrate(options)->method(), LinearSolverKind::cholesky_cg);
}

TEST(StableStep, DividesStableFromUnstable) {
  for (const IntegrationScheme scheme : {symplectic, central}) {
    Body body(true);
    const double limit = critical_step(body.model, body.constraints, body.start.u);
    body.start.v = random_vector(body.model.num_dofs(), 1e-6, 3);
    body.constraints.project(body.start.v);
    const auto growth = [&](double step) {
      const auto integrator = body.integrate(options_of(scheme, step));
      try {
        for (int i = 0; i < 400; ++i) integrator->step();
      } catch (const WorkError&) {
        return 1e300;  // so far that elements were turned inside out
      }
      return integrator->state().u.norm() / body.start.v.norm();
    };
    EXPECT_LT(growth(0.97 * limit), 1);
    EXPECT_GT(growth(1.01 * limit), 100);
  }
}

TEST(Integrators, NameTheElementThatLeavesItsDomain) {
  Body body(true);
  body.start.v = random_vector(body.model.num_dofs(), 100, 3);
  body.constraints.project(body.start.v);
  const auto integrator = body.integrate(options_of(central, 1e-2));
  try {
    for (int i = 0; i < 100; ++i) integrator->step();
    FAIL() << "no error";
  } catch (const WorkError& error) {
    EXPECT_NE(std::string(error.what()).find("element "), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("central_differences"), std::string::npos);
  }
  // The last complete step is still there.
  EXPECT_TRUE(integrator->state().u.allFinite());
}

TEST(Integrators, RefuseWrongOptions) {
  Body body(true);
  EXPECT_THROW((void)body.integrate(options_of(central, 0)), InputError);
  EXPECT_THROW((void)body.integrate(options_of(central, NAN)), InputError);
  EXPECT_THROW((void)body.integrate(options_of(central, 1, -1)), InputError);
  IntegratorOptions options = options_of(implicit);
  options.newton_iterations = 0;
  EXPECT_THROW((void)body.integrate(options), InputError);
  body.start.v.resize(3);
  EXPECT_THROW((void)body.integrate(options_of(central)), InternalError);
}

TEST(Integrators, RefuseAFreeBodyWithoutMass) {
  const Mesh mesh = bar_mesh("hexa8", {1, 1, 1}, {1, 1, 1});
  const KernelTable<double> table = ReferenceKernels<Hexa8, 8, false>::table();
  Model model(mesh, one_part(mesh, table, 0), {.threads = 1});
  const Constraints constraints(mesh.num_nodes(), 3);
  const PrescribedMotion motion(constraints);
  const MotionState start = start_of_motion(model, std::array{0.0, 0.0, 0.0});
  EXPECT_THROW(
      (void)make_integrator(model, constraints, motion, start.u, options_of(central), start),
      InputError);
}

TEST(PrescribedMotions, HistoriesInterpolateAndHold) {
  const History history = History::table({{1, 2}, {2, 4}, {4, 0}});
  EXPECT_EQ(history(0), 2);
  EXPECT_EQ(history(1.5), 3);
  EXPECT_EQ(history(2), 4);
  EXPECT_EQ(history(3), 2);
  EXPECT_EQ(history(9), 0);
  EXPECT_EQ(History()(0.3), 0.3);
  EXPECT_THROW((void)History::table({}), InputError);
  EXPECT_THROW((void)History::table({{1, 0}, {1, 2}}), InputError);
  EXPECT_THROW((void)History::sine(0), InputError);
}

TEST(PrescribedMotions, RotationKeepsDistancesFromTheAxis) {
  const Mesh mesh = bar_mesh("hexa8", {1, 1, 1}, {1, 1, 1});
  Constraints constraints(mesh.num_nodes(), 3);
  std::vector<std::int32_t> nodes;
  for (std::size_t node = 4; node < 8; ++node) {
    constraints.fix(node);
    nodes.push_back(static_cast<std::int32_t>(node));
  }
  PrescribedMotion motion(constraints);
  motion.rotate(mesh, nodes, {{0, 0.5, 0.5}, {2, 0, 0}, std::numbers::pi}, History());
  Vector u = Vector::Zero(24);
  motion.impose(0.5, u);
  // A quarter turn about x takes y to z: node (1, 0, 0) goes to (1, 1, 0).
  EXPECT_NEAR(u[12], 0, 1e-15);
  EXPECT_NEAR(u[13], 1, 1e-15);
  EXPECT_NEAR(u[14], 0, 1e-15);
  EXPECT_EQ(u.head(12).norm(), 0);
  EXPECT_THROW(motion.rotate(mesh, nodes, {{0, 0, 0}, {0, 0, 0}, 1}, History()), InputError);
}

TEST(PrescribedMotions, RotationInThePlane) {
  const Mesh mesh = plane_square();
  Constraints constraints(mesh.num_nodes(), 2);
  for (std::size_t node = 0; node < 4; ++node) constraints.fix(node);
  PrescribedMotion motion(constraints);
  const std::vector<std::int32_t> nodes = {0, 1, 2, 3};
  motion.rotate(mesh, nodes, {{0, 0, 0}, {0, 0, 1}, std::numbers::pi}, History());
  Vector u = Vector::Zero(8);
  motion.impose(0.5, u);
  // A quarter turn: node 2 goes from (1, 1) to (-1, 1).
  EXPECT_NEAR(u[4], -2, 1e-15);
  EXPECT_NEAR(u[5], 0, 1e-15);
  EXPECT_THROW(motion.rotate(mesh, nodes, {{0, 0, 0}, {1, 0, 0}, 1}, History()), InputError);
}

TEST(PrescribedMotions, GrowByTheLoadFactor) {
  Constraints constraints(2, 3);
  constraints.fix(0);
  constraints.prescribe(1, 2, 0.4);
  const PrescribedMotion motion = PrescribedMotion::growing(constraints);
  Vector u = Vector::Constant(6, 7);
  motion.impose(0.25, u);
  EXPECT_EQ(u, (Vector(6) << 0, 0, 0, 7, 7, 0.1).finished());
  EXPECT_FALSE(motion.empty());
  EXPECT_TRUE(PrescribedMotion::growing(Constraints(2, 3)).empty());
}

}  // namespace
}  // namespace elastogen::test
