//! Phong shading through the stereographic chart around the eye: unit normals without a root.

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::methods::angles::chart_errors::{Chart, FromEye, of_angle};
use crate::shading::{
    Carried, Carries, Family, Info, LightAt, Linear, Needs, Perspective, Pixel, Roundings, Shader,
    Span, Stepped,
};

/// Stereographic Phong shading. In the frame whose z points to the eye, a normal has the point u =
/// x/(1 + z), v = y/(1 + z), and these two values are interpolated. Mapped back, they give a unit
/// vector,
///
/// ```text
/// N = (2 u, 2 v, 1 − u² − v²) / (1 + u² + v²) = (u, v, 1) w − (0, 0, 1),      w = 2 / (1 + u² + v²)
/// K = V·N = w − 1,      J = L·N = w (L_x u + L_y v + L_z) − L_z
/// ```
///
/// with one division and no root. One chart serves the whole picture, so neighbours agree at their
/// edge. Two values are linear, so the picture of a triangle does not depend on how it lies.
/// [`FromEye::angle`] derives its distance from Phong's.
#[derive(Clone, Copy, Debug, Default)]
pub struct StereographicPhong;

impl Shader for StereographicPhong {
    const INFO: Info = Info {
        name: "stereographic-phong",
        ids: &["M15"],
        family: Family::Angles,
        title: "normals through a stereographic chart around the eye: unit length without a root",
        formula: "u = Nx / (1 + Nz), v = Ny / (1 + Nz), z toward the eye;  u_next = u + du;  v_next = v + dv;  w = 2 / (1 + u^2 + v^2)\n\
                  K = w - 1;  J = w (Lx u + Ly v + Lz) - Lz;  I = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
        source: "ours",
        model: Model::PhongConstant,
        roundings: Roundings::new(24.0, 2.5, Stepped::Cosines),
        derivation: "a turned normal takes 4 roundings, its point 3 more; w, J and K take 9; N moves at most twice as far as its point, \
                     and each step rounds both coordinates of that by half of 2^-24, and under perspective the weight",
        approximation: |frame, polygon, _| {
            of_angle(FromEye::of(frame, polygon).angle(Chart::Stereographic))
        },
        fails: "where normals face away from the eye: a normal opposite to it has no point on the chart",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        perspective: Perspective::Divides,
        scalar_only: Some(
            "stereographic-phong divides at each pixel, and a block of pixels takes a root for less",
        ),
        ..Needs::PIXELS_BY_POLYGON
    };
    type Constants<F: Num> = ();
    type Carries = Self;
    type Walk<F: Num> = Linear<(F, F)>;
    const VALUES: &'static [&'static str] = &["u", "v"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Linear<(F, F)> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, (u, v): Pixel<Self, F>) -> Vec3<F> {
        let w = u.broadcast(2.0) / (u.mul_add(u, v * v) + 1.0);
        let v_n = w - 1.0; // K = V · N
        let mut colour = lit.ambient();
        for light in lit.lights() {
            let to = light.to;
            let along = u.mul_add(to.x, v.mul_add(to.y, to.z));
            let l_n = along.mul_add(w, -to.z); // J = L · N
            colour = lit.add(colour, &light, l_n, lit.highlight(&light, l_n, v_n));
        }
        colour
    }
}

impl Carries for StereographicPhong {
    const FROM: Carried = Carried::Turned;
    type Varying<F: Num> = (F, F);
    const NAMES: &'static [&'static str] = &["u", "v"];

    #[inline(always)]
    fn vertex<F: Num>(_: &LightAt<'_, F>, n: Vec3<F>) -> (F, F) {
        let scale = n.z.broadcast(1.0) / (n.z + 1.0);
        (n.x * scale, n.y * scale)
    }
}
