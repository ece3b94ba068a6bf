#include "symgen/mechanics/invariants.h"

#include <algorithm>

#include "runtime/error.h"

namespace elastogen::symgen {
namespace {

using GiNaC::ex;

std::string indexed_name(const std::string& name, int i, int j) {
  return name + std::to_string(i) + std::to_string(j);
}

ex define(const std::string& name, const ex& value, std::vector<Definition>& definitions) {
  definitions.push_back({GiNaC::symbol(name), value});
  return definitions.back().symbol;
}

void define_invariant(const std::string& name, const ex& value,
                      std::vector<Definition>& definitions) {
  definitions.push_back({find_invariant(name).symbol, value});
}

std::size_t at(int dim, int i, int j) { return static_cast<std::size_t>(i * dim + j); }

ex trace(int dim, const std::vector<ex>& m) {
  ex sum = 0;
  for (int i = 0; i < dim; ++i) sum += m[at(dim, i, i)];
  return sum;
}

/// tr(S^2) of a symmetric matrix.
ex trace_of_square(int dim, const std::vector<ex>& s) {
  ex sum = 0;
  for (int i = 0; i < dim; ++i) {
    sum += GiNaC::pow(s[at(dim, i, i)], 2);
    for (int j = i + 1; j < dim; ++j) sum += 2 * GiNaC::pow(s[at(dim, i, j)], 2);
  }
  return sum;
}

/// log(j^a) -> a log(j) for j > 0, which GiNaC leaves alone.
struct ResolveLogarithms : public GiNaC::map_function {
  ex operator()(const ex& expression) override {
    const ex mapped = expression.map(*this);
    if (GiNaC::is_the_function<GiNaC::log_SERIAL>(mapped) &&
        GiNaC::is_a<GiNaC::power>(mapped.op(0)) &&
        mapped.op(0).op(0).info(GiNaC::info_flags::positive)) {
      return mapped.op(0).op(1) * GiNaC::log(mapped.op(0).op(0));
    }
    return mapped;
  }
};

}  // namespace

const std::vector<Invariant>& invariants() {
  static const std::vector<Invariant> all = [] {
    std::vector<Invariant> result;
    const auto add = [&](const char* name, const char* formula, const char* meaning) {
      result.push_back({name, formula, meaning, GiNaC::symbol(name)});
    };
    add("trE", "tr E", "trace of the Green-Lagrange strain");
    add("trE2", "tr E^2", "squared norm of the Green-Lagrange strain, E:E");
    add("tr_eps", "tr eps", "trace of the small strain");
    add("tr_eps2", "tr eps^2", "squared norm of the small strain, eps:eps");
    add("I1", "tr C", "first invariant of C; 3 at rest");
    add("I2", "(I1^2 - tr C^2)/2", "second invariant of C; 3 at rest");
    add("I3", "det C", "third invariant of C, J^2; 1 at rest");
    add("J", "det F", "ratio of deformed to rest volume; 1 at rest");
    return result;
  }();
  return all;
}

std::vector<std::string> invariant_names() {
  std::vector<std::string> names;
  for (const Invariant& invariant : invariants()) names.push_back(invariant.name);
  return names;
}

const Invariant& find_invariant(const std::string& name) {
  for (const Invariant& invariant : invariants()) {
    if (invariant.name == name) return invariant;
  }
  throw InternalError("no invariant '" + name + "'");
}

const std::vector<GiNaC::symbol>& displacement_gradient(int dim) {
  const auto make = [](int d) {
    std::vector<GiNaC::symbol> gradient;
    for (int i = 0; i < d; ++i) {
      for (int j = 0; j < d; ++j) gradient.emplace_back(indexed_name("H", i, j));
    }
    return gradient;
  };
  static const std::vector<GiNaC::symbol> plane = make(2);
  static const std::vector<GiNaC::symbol> space = make(3);
  if (dim != 2 && dim != 3) throw InternalError("dimension must be 2 or 3");
  return dim == 2 ? plane : space;
}

ex determinant(int dim, const std::vector<ex>& entries) {
  const std::vector<ex>& m = entries;
  if (dim == 2) return m[0] * m[3] - m[1] * m[2];
  return m[0] * (m[4] * m[8] - m[5] * m[7]) + m[1] * (m[5] * m[6] - m[3] * m[8]) +
         m[2] * (m[3] * m[7] - m[4] * m[6]);
}

std::vector<ex> define_green_lagrange(int dim, std::vector<Definition>& definitions) {
  const std::vector<GiNaC::symbol>& h = displacement_gradient(dim);
  std::vector<ex> strain(h.size());
  for (int i = 0; i < dim; ++i) {
    for (int j = i; j < dim; ++j) {
      ex product = 0;
      for (int k = 0; k < dim; ++k) product += h[at(dim, k, i)] * h[at(dim, k, j)];
      const ex value = (h[at(dim, i, j)] + h[at(dim, j, i)] + product) / 2;
      strain[at(dim, i, j)] = define(indexed_name("E", i, j), value, definitions);
      strain[at(dim, j, i)] = strain[at(dim, i, j)];
    }
  }
  return strain;
}

void define_strain_invariants(int dim, const std::vector<ex>& green_lagrange,
                              std::vector<Definition>& definitions) {
  define_invariant("trE", trace(dim, green_lagrange), definitions);
  define_invariant("trE2", trace_of_square(dim, green_lagrange), definitions);
  const std::vector<GiNaC::symbol>& h = displacement_gradient(dim);
  std::vector<ex> small(h.size());
  for (int i = 0; i < dim; ++i) {
    small[at(dim, i, i)] = h[at(dim, i, i)];
    for (int j = i + 1; j < dim; ++j) {
      small[at(dim, i, j)] = (h[at(dim, i, j)] + h[at(dim, j, i)]) / 2;
    }
  }
  define_invariant("tr_eps", trace(dim, small), definitions);
  define_invariant("tr_eps2", trace_of_square(dim, small), definitions);
}

std::vector<Definition> textbook_definitions(int dim) {
  std::vector<Definition> definitions;
  define_strain_invariants(dim, define_green_lagrange(dim, definitions), definitions);
  const std::vector<GiNaC::symbol>& h = displacement_gradient(dim);
  std::vector<ex> f(h.size()), c(h.size());
  for (int i = 0; i < dim; ++i) {
    for (int j = 0; j < dim; ++j) {
      f[at(dim, i, j)] =
          define(indexed_name("F", i, j), h[at(dim, i, j)] + (i == j ? 1 : 0), definitions);
    }
  }
  for (int i = 0; i < dim; ++i) {
    for (int j = i; j < dim; ++j) {
      ex product = 0;
      for (int k = 0; k < dim; ++k) product += f[at(dim, k, i)] * f[at(dim, k, j)];
      c[at(dim, i, j)] = define(indexed_name("C", i, j), product, definitions);
    }
  }
  // In plane strain the stretch out of the plane is 1.
  const int out_of_plane = 3 - dim;
  define_invariant("I1", trace(dim, c) + out_of_plane, definitions);
  const ex i1 = find_invariant("I1").symbol;
  define_invariant("I2", (GiNaC::pow(i1, 2) - trace_of_square(dim, c) - out_of_plane) / 2,
                   definitions);
  define_invariant("J", determinant(dim, f), definitions);
  define_invariant("I3", GiNaC::pow(find_invariant("J").symbol, 2), definitions);
  return definitions;
}

ex substitute_definitions(const ex& expression, const std::vector<Definition>& definitions) {
  ex result = expression;
  for (auto it = definitions.rbegin(); it != definitions.rend(); ++it) {
    result = result.subs(it->symbol == it->value);
  }
  return result;
}

std::vector<Definition> needed_definitions(const std::vector<ex>& expressions,
                                           const std::vector<Definition>& definitions) {
  std::vector<ex> users = expressions;
  std::vector<Definition> needed;
  for (auto it = definitions.rbegin(); it != definitions.rend(); ++it) {
    if (std::any_of(users.begin(), users.end(),
                    [&](const ex& user) { return user.has(it->symbol); })) {
      users.push_back(it->value);
      needed.push_back(*it);
    }
  }
  std::reverse(needed.begin(), needed.end());
  return needed;
}

ex resolve_powers_of_j(const ex& expression, const GiNaC::possymbol& j) {
  const GiNaC::exmap by_volume_ratio = {{find_invariant("I3").symbol, GiNaC::pow(j, 2)},
                                        {find_invariant("J").symbol, j}};
  ResolveLogarithms resolve;
  return resolve(expression.subs(by_volume_ratio));
}

}  // namespace elastogen::symgen
