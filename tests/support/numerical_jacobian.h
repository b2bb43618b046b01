// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Numerical derivatives of functions, to test analytic ones.
#include <Eigen/Core>
#include <type_traits>

namespace edgevo::test {

/// The Jacobian of `f` at zero, R x N: `f` takes an Eigen::Matrix<double, N, 1> and returns a number (R = 1)
/// or a fixed column vector of R doubles. Central differences with one Richardson step, whose error is
/// O(step^4); `f` is called four times for each column.
template <int N, class F>
auto numerical_jacobian(const F& f, double step = 1e-4) {
  using Input = Eigen::Matrix<double, N, 1>;
  using Output = std::decay_t<decltype(f(Input()))>;
  const auto difference = [&](int k, double h) {
    const Input move = h * Input::Unit(k);
    if constexpr (std::is_arithmetic_v<Output>)
      return Eigen::Matrix<double, 1, 1>((f(move) - f(-move)) / (2 * h));
    else
      return typename Output::PlainObject((f(move) - f(-move)) / (2 * h));
  };
  using Column = decltype(difference(0, step));
  Eigen::Matrix<double, Column::RowsAtCompileTime, N> J;
  for (int k = 0; k < N; ++k) J.col(k) = (4 * difference(k, step / 2) - difference(k, step)) / 3;
  return J;
}

/// The derivative of `f` at `x`, both numbers.
template <class F>
double numerical_derivative(const F& f, double x, double step = 1e-4) {
  return numerical_jacobian<1>([&](const Eigen::Matrix<double, 1, 1>& move) { return f(x + move[0]); }, step)(
      0, 0);
}

}  // namespace edgevo::test
