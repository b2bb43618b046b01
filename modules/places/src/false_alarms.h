// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Expected numbers of false alarms, decimal logarithms.

namespace edgevo {

/// Proved is what happens by chance once in a million pairs of views.
inline constexpr double kLogProof = -6;

/// Of poses by three of `pairs` pairs of corners that `agreeing` of them, the three included, agree with,
/// where one agrees by chance with the probability `chance`: (n - 3) C(n, k) C(k, 3) chance^(k - 3).
double log_alarms_of_corners(int pairs, int agreeing, double chance);

/// Of `edges` independent edges of which a share agrees, or more, where each agrees by chance with the
/// probability `chance`: Hoeffding's bound of the binomial tail. 0 if the share is not above chance.
double log_alarms_of_share(int edges, double share, double chance);

}  // namespace edgevo
