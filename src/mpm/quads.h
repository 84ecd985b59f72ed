#pragma once
/// Four numbers in one register: a vector's three components and one more beside them.

namespace sluice {

template <class Real>
struct QuadOf {
  typedef Real type __attribute__((vector_size(4 * sizeof(Real))));  // the attribute needs the typedef form
};
template <class Real>
using Quad = typename QuadOf<Real>::type;

/// q's first three numbers, then `fourth`.
template <class Q, class Real>
Q with_fourth(Q q, Real fourth) {
  q[3] = fourth;
  return q;
}

/// Sum of the products of the first three numbers.
template <class Q>
auto dot3(Q a, Q b) {
  const Q product = a * b;
  return product[0] + product[1] + product[2];
}

}  // namespace sluice
