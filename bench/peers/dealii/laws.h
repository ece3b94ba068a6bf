// First Piola-Kirchhoff stress of displacement gradients, and its change in a direction.
#pragma once

#include <deal.II/base/tensor.h>

#include <cmath>

namespace elastogen::peers {

template <class Number>
using Tensor = dealii::Tensor<2, 3, Number>;

template <class Number>
Tensor<Number> plus_diagonal(Tensor<Number> tensor, const Number& number) {
  for (unsigned int i = 0; i < 3; ++i) tensor[i][i] += number;
  return tensor;
}

struct Hooke {
  static constexpr bool is_linear = true;
  double lambda, mu;

  template <class Number>
  [[nodiscard]] Tensor<Number> stress(const Tensor<Number>& gradient) const {
    return plus_diagonal<Number>(Number(mu) * (gradient + transpose(gradient)),
                                 lambda * trace(gradient));
  }
};

struct Stvk {
  static constexpr bool is_linear = false;
  double lambda, mu;

  template <class Number>
  [[nodiscard]] Tensor<Number> stress(const Tensor<Number>& gradient) const {
    const Tensor<Number> F = plus_diagonal<Number>(gradient, Number(1));
    return F * second_stress(F);
  }

  template <class Number>
  [[nodiscard]] Tensor<Number> stress_change(const Tensor<Number>& gradient,
                                             const Tensor<Number>& direction) const {
    const Tensor<Number> F = plus_diagonal<Number>(gradient, Number(1));
    const Tensor<Number> half = transpose(F) * direction;
    const Tensor<Number> change =
        plus_diagonal<Number>(Number(mu) * (half + transpose(half)), lambda * trace(half));
    return direction * second_stress(F) + F * change;
  }

 private:
  template <class Number>
  [[nodiscard]] Tensor<Number> second_stress(const Tensor<Number>& F) const {
    const Tensor<Number> twice_strain = plus_diagonal<Number>(transpose(F) * F, Number(-1));
    return plus_diagonal<Number>(Number(mu) * twice_strain, lambda / 2 * trace(twice_strain));
  }
};

struct NeoHookean {
  static constexpr bool is_linear = false;
  double lambda, mu;

  template <class Number>
  [[nodiscard]] Tensor<Number> stress(const Tensor<Number>& gradient) const {
    const Tensor<Number> F = plus_diagonal<Number>(gradient, Number(1));
    return Number(mu) * F + inverse_factor(F) * transpose(invert(F));
  }

  template <class Number>
  [[nodiscard]] Tensor<Number> stress_change(const Tensor<Number>& gradient,
                                             const Tensor<Number>& direction) const {
    const Tensor<Number> F = plus_diagonal<Number>(gradient, Number(1));
    const Tensor<Number> inverse = invert(F);
    const Tensor<Number> relative = inverse * direction;
    return Number(mu) * direction + lambda * trace(relative) * transpose(inverse) -
           inverse_factor(F) * transpose(relative * inverse);
  }

 private:
  template <class Number>
  [[nodiscard]] Number inverse_factor(const Tensor<Number>& F) const {
    return lambda * std::log(determinant(F)) - Number(mu);
  }
};

}  // namespace elastogen::peers
