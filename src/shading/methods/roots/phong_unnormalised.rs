//! Phong shading without normalising, as CS171 prints it. It shows what goes wrong.

use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::bounds::polygon_ranges::Extent;
use crate::shading::{
    Approximation, Info, LightAt, Linear, Needs, Normal, Perspective, Pixel, Roundings, Shader,
    Span, Stepped, Tier,
};

/// Phong shading that lights interpolated normals without normalising them (CS171 3, Algorithm 7).
/// Between corners they are shorter than 1:
///
/// ```text
/// |N(t)|² = 1 − 4 t (1 − t) sin² φ/2        between unit normals at the angle φ
/// ```
///
/// In the middle, diffuse light is darker by the factor cos φ/2, and highlights by the n-th power
/// of it.
///
/// **Its error.** `J = |N| J_unit` has a relative error of 1 − |N|, which is at most 1 − c: any
/// convex combination N of unit normals N_i has
/// |N| ≥ N·m ≥ c, with m their mean direction and c the least N_i·m.
#[derive(Clone, Copy, Debug, Default)]
pub struct PhongUnnormalised;

impl Shader for PhongUnnormalised {
    const INFO: Info = Info {
        name: "phong-unnormalised",
        ids: &["M16"],
        tier: Tier::Exhibit,
        title: "normals, interpolated and not normalised",
        formula: "N_next = N + dN;  J = L.N;  K = V.N;  I = Ia ka + Ip kd J + Ip ks (2 J K - L.V)^n",
        source: "CS171 3, Algorithm 7, as printed",
        model: Model::Phong,
        roundings: Roundings::new(12.0, 1.8, Stepped::Cosines),
        derivation: "as naive-phong; J and K take 3 roundings each, and under perspective a weight is stepped too, by which N is divided",
        approximation: |frame, polygon, _| Approximation {
            length: 1.0 - Extent::of(frame, polygon).cosine.max(0.0),
            ..Approximation::NONE
        },
        fails: "everywhere between corners: light fades there, and highlights vanish",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        perspective: Perspective::Divides,
        scalar_only: Some(
            "phong-unnormalised saves roots, which cost a block of pixels almost nothing",
        ),
        ..Needs::PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = Normal;
    type Walk<F: Num> = Linear<Vec3<F>>;
    const VALUES: &'static [&'static str] = &["Nx", "Ny", "Nz"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Linear<Vec3<F>> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, n: Pixel<Self, F>) -> Vec3<F> {
        let v_n = n.dot(lit.view()); // K = V · N
        let mut colour = lit.ambient();
        for light in lit.lights() {
            let l_n = n.dot(light.to); // J = L · N
            colour = lit.add(colour, &light, l_n, lit.highlight(&light, l_n, v_n));
        }
        colour
    }
}

#[cfg(test)]
mod tests {
    use crate::number::test_random::Random;
    use glam::DVec3;

    /// No combination of unit normals is shorter than the least cosine with their mean direction,
    /// and some are nearly as short.
    #[test]
    fn no_normal_is_shorter_than_stated() {
        let mut random = Random::new(16);
        let mut nearest = 0.0f64;
        for _ in 0..2000 {
            let count = 2 + (random.signed().abs() * 5.0) as usize;
            let mut value = || f64::from(random.signed());
            let normals: std::vec::Vec<DVec3> = (0..count)
                .map(|_| DVec3::new(value(), value(), 0.5 + value().abs()).normalize())
                .collect();
            let mean = normals.iter().sum::<DVec3>().normalize();
            let least = normals.iter().map(|n| n.dot(mean)).fold(1.0, f64::min);
            for _ in 0..20 {
                let mut all = DVec3::ZERO;
                let mut weights = 0.0;
                for n in &normals {
                    let weight = value().abs();
                    (all, weights) = (all + weight * *n, weights + weight);
                }
                let length = (all / weights).length();
                assert!(length >= least - 1e-12, "{normals:?}: {length} {least}");
                nearest = nearest.max((1.0 - length) / (1.0 - least));
            }
        }
        assert!(nearest > 0.9, "{nearest}");
    }
}
