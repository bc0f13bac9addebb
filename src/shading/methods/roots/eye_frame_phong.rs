//! Phong shading in the frame of the eye and the first light, where V·N is a component and L·N
//! takes two products.

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::light::eye_frame;
use crate::shading::{
    Info, LightAt, Linear, Needs, Pixel, Roundings, Shader, Span, Stepped, TurnedNormal,
};

/// Phong shading as in [`PhongRsqrt`](crate::shading::methods::roots::phong_rsqrt::PhongRsqrt),
/// with normals that each vertex turns into a frame where V = (0, 0, 1) and L of the first light is
/// (x, 0, z). Lengths and products are equal in all frames:
///
/// ```text
/// K = N_z,   J = L_x N_x + L_z N_z,   D = N·N,   r = 1/√D
/// ```
///
/// A pixel saves V·N, and one product and one sum of the first light. A vertex pays three dot
/// products.
#[derive(Clone, Copy, Debug, Default)]
pub struct EyeFramePhong;

impl Shader for EyeFramePhong {
    const INFO: Info = Info {
        name: "eye-frame-phong",
        title: "normals in the frame of eye and first light, where V.N is a component and L.N takes two products",
        formula: "V = (0, 0, 1), L = (Lx, 0, Lz);  N_next = N + dN;  K = Nz;  J = Lx Nx + Lz Nz;  r = 1 / sqrt(N.N)\n\
                  I = Ia ka + Ip kd J r + Ip ks (2 (J r) (K r) - L.V)^n",
        source: "ours; L21 4.1-4.3, eq 4.5",
        model: Model::PhongConstant,
        roundings: Roundings::new(10.5, 0.9, Stepped::Cosines),
        derivation: "as naive-phong at a step; each coordinate of a turned normal takes 2 roundings, 3.5 in all, and L 1; J takes 1.5; D takes 3, \
                     of which its root has half; the root and the quotient take 1 each, the products with r and R.V half each",
        fails: "as naive-phong; with lights or eye at positions the corners must be turned again for each polygon",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        scalar_only: Some(
            "eye-frame-phong saves products, and a block of pixels is no faster without them",
        ),
        ..Needs::PIXELS_BY_POLYGON
    };
    type Constants<F: Num> = ();
    type Carries = TurnedNormal;
    type Walk<F: Num> = Linear<Vec3<F>>;
    const VALUES: &'static [&'static str] = &["Nx", "Ny", "Nz"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Linear<Vec3<F>> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, n: Pixel<Self, F>) -> Vec3<F> {
        let r = n.dot(n).rsqrt(); // D = N · N
        let v_n = n.z * r; // K = V · N
        let mut colour = lit.ambient();
        for light in lit.lights() {
            let l_n = eye_frame::product(&light, n) * r; // J = L · N
            colour = lit.add(colour, &light, l_n, lit.highlight(&light, l_n, v_n));
        }
        colour
    }
}
