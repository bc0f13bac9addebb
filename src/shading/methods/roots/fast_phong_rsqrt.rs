//! Fast Phong shading on today's hardware: D by second differences, with a true root and a division
//! at each pixel.

use crate::reference::Model;
use crate::shading::{Info, Roundings, Stepped};

/// Fast Phong shading for processors with fast roots, for up to `L` lights.
///
/// A pixel takes one addition each for `J = L·N` and `K = V·N`, two for `D = N·N`, and a root and a
/// division for `r = 1/√D`. These start from no other pixel, so a block of pixels can be shaded at
/// a time. The diffuse term is `J r`, the specular term `(2 (J r) (K r) − L·V)^n`.
///
/// Where light and eye are at infinity this is the method
/// [`DuffPhong`](crate::shading::methods::roots::duff_phong::DuffPhong), to the bit. Otherwise L
/// and V are constant over a polygon, as in fast Phong.
pub const FAST_PHONG_RSQRT: Info = Info {
    name: "fast-phong-rsqrt",
    title: "J = L.N, K = V.N by additions, N.N by second differences, 1/sqrt(N.N) at every pixel",
    formula: "J_next = J + dJ;  K_next = K + dK;  D_next = D + dD;  dD_next = dD + 2 dN.dN;  r = 1 / sqrt(D)\n\
              I = Ia ka + Ip kd J r + Ip ks (2 (J r) (K r) - L.V)^n",
    source: "L21 4.2, 4.3, with a root and a division in place of Newton's recurrence",
    model: Model::PhongConstant,
    roundings: Roundings::new(6.0, 2.0, Stepped::Products),
    derivation: "as duff-phong, whose arithmetic it shares where light and eye are at infinity",
    fails: "where normals cancel inside a span, D is a small difference of large sums",
    ..Info::OF_PIXELS
};
