//! Phong shading by quaternions: each vertex has a rotation from the eye's direction to its normal,
//! and these are interpolated (Hast 2005).

use crate::number::{Num, Vec3, vec3};
use crate::reference::Model;
use crate::shading::light::eye_frame;
use crate::shading::methods::angles::chart_errors::{Chart, FromEye, of_angle};
use crate::shading::{
    Carried, Carries, Family, Info, LightAt, Linear, Needs, Pixel, Roundings, Shader, Span, Stepped,
};

/// Quaternion shading. The least rotation from the eye's direction (0, 0, 1) to a normal N is the
/// unit quaternion
///
/// ```text
/// q = (cos θ/2; −m_y, m_x, 0),      m = (N + (0, 0, 1)) / |N + (0, 0, 1)|,   m_z = cos θ/2
/// ```
///
/// with θ the angle between both. Its three values are thus the components of the vector m half-way
/// between them. They are interpolated, and q rotates (0, 0, 1) to a unit vector whatever the
/// length of q:
///
/// ```text
/// N = (2 m_x m_z, 2 m_y m_z, m_z² − m_x² − m_y²) / |q|² = w m − (0, 0, 1),      w = 2 m_z / m·m
/// K = V·N = w m_z − 1,      J = L·N = w L·m − L_z
/// ```
///
/// with one division and no root. q and −q are the same rotation, and neighbours must use the same
/// one: here all have m_z ≥ 0. Because of the half angles it is nearer to great circles than linear
/// normals are. [`FromEye::angle`] derives its distance from Phong's.
#[derive(Clone, Copy, Debug, Default)]
pub struct QuaternionPhong;

impl Shader for QuaternionPhong {
    const INFO: Info = Info {
        name: "quaternion-phong",
        ids: &["M26"],
        family: Family::Angles,
        title: "quaternions that turn the eye's direction into the normal, interpolated: unit length without a root",
        formula: "q = (mz; -my, mx, 0), m = (N + V) / |N + V|, z toward the eye;  m_next = m + dm;  w = 2 mz / m.m\n\
                  K = w mz - 1;  J = w L.m - Lz;  I = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
        source: "Hast 2005",
        model: Model::PhongConstant,
        roundings: Roundings::new(28.0, 3.6, Stepped::Cosines),
        derivation: "a turned normal takes 4 roundings, m 4 more; w, J and K take 11; N turns by twice the angle of m, whose three values \
                     a step rounds by 0.87 * 2^-24, and as much again for a length below 1",
        approximation: |frame, polygon, _| {
            of_angle(FromEye::of(frame, polygon).angle(Chart::HalfVectors))
        },
        fails: "where normals face away from the eye: to a normal opposite to it there is no least rotation",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        scalar_only: Some(
            "quaternion-phong divides at each pixel, and a block of pixels takes a root for less",
        ),
        ..Needs::PIXELS_BY_POLYGON
    };
    type Constants<F: Num> = ();
    type Carries = Self;
    type Walk<F: Num> = Linear<Vec3<F>>;
    const VALUES: &'static [&'static str] = &["mx", "my", "mz"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Linear<Vec3<F>> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, m: Pixel<Self, F>) -> Vec3<F> {
        let w = (m.z + m.z) / m.dot(m);
        let v_n = w * m.z - 1.0; // K = V · N
        let mut colour = lit.ambient();
        for light in lit.lights() {
            let l_n = eye_frame::product(&light, m).mul_add(w, -light.l_v); // J = L · N
            colour = lit.add(colour, &light, l_n, lit.highlight(&light, l_n, v_n));
        }
        colour
    }
}

impl Carries for QuaternionPhong {
    const FROM: Carried = Carried::Turned;
    type Varying<F: Num> = Vec3<F>;
    const NAMES: &'static [&'static str] = &["mx", "my", "mz"];

    #[inline(always)]
    fn vertex<F: Num>(_: &LightAt<'_, F>, n: Vec3<F>) -> Vec3<F> {
        vec3([n.x, n.y, n.z + 1.0]).unit()
    }
}
