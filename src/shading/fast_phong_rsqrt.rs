//! Fast Phong shading in the terms of today's hardware: the reciprocal root that processors have, D by second differences.

use super::{Info, Roundings, Stepped};
use crate::reference::Model;

/// Fast Phong shading for processors that have a reciprocal square root, for up to `L` lights: `J = L·N` and `K = V·N` by one
/// addition each, `D = N·N` by two, and `r = 1/√D` by the processor's estimate and one step of Newton's, which starts from no
/// other pixel: neighbouring pixels are independent, and a block of them is shaded at a time.
///
/// The diffuse term is `J r`, the specular term `(2 (J r) (K r) − L·V)^n`. Without such an estimate the root is a root and a
/// division, and the method [`DuffPhong`](super::duff_phong::DuffPhong) where light and eye are at infinity.
pub const FAST_PHONG_RSQRT: Info = Info {
    name: "fast-phong-rsqrt",
    title: "J = L.N, K = V.N by additions, N.N by second differences, the reciprocal root by the hardware",
    formula: "J_next = J + dJ;  K_next = K + dK;  D_next = D + dD;  dD_next = dD + 2 dN.dN;  r = rsqrt(D)\n\
              I = Ia ka + Ip kd J r + Ip ks (2 (J r) (K r) - L.V)^n",
    source: "L21 4.2, 4.3, with the root that processors have had since 1999 (SSE rsqrtps)",
    model: Model::PhongConstant,
    roundings: Roundings::new(10.4, 2.0, Stepped::Products),
    derivation: "as duff-phong; the estimate of the root and its step are off by 6.4 roundings, where a root and a quotient \
                 are off by 2",
    fails: "where normals cancel inside a span, D is a small difference of large sums",
    ..Info::OF_PIXELS
};
