//! Algorithm 3: the lighting model.

use crate::scene::{Falloff, Lighting, Place, SpecularGate, SpecularModel};
use glam::DVec3;

/// Returns the colour of the point `p` with the normal `n` (CS171 2, Algorithm 3, with its
/// Attenuation):
/// ```text
/// c = min(1, c_a + c_d Σ l_c max(0, n · l) + c_s Σ l_c max(0, n · (e + l) / |e + l|)^p),    l_c ∝ 1 / (1 + k d²)
/// ```
///
/// `n` is used unchanged, unit vector or not. `light` has the products of light and material, and
/// what the text does not have: lights and eye at infinity, highlights by R·V, and their gate.
/// CS171's own model is [`SpecularModel::Blinn`] with [`SpecularGate::Ungated`]. If e + l vanishes,
/// there is no h, and n · h counts as 0.
pub fn lighting(p: DVec3, n: DVec3, light: &Lighting) -> DVec3 {
    let wide = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    let mut sum = wide(light.ambient);
    let e_direction = match light.view {
        Place::Local(e) => (wide(e) - p).normalize_or_zero(),
        Place::Infinite(direction) => wide(direction),
    };
    for l in &light.lights {
        let (l_direction, attenuation) = match l.place {
            Place::Local(l_p) => {
                // Measure the distance before the vector is normalised.
                let vector = wide(l_p) - p;
                (
                    vector.normalize_or_zero(),
                    attenuation(l.falloff, vector.length()),
                )
            }
            Place::Infinite(direction) => (wide(direction), 1.0),
        };
        let n_l = n.dot(l_direction);
        let diffuse = n_l.max(0.0);
        let cosine = match light.specular {
            SpecularModel::Blinn => {
                let sum = e_direction + l_direction;
                // Opposite vectors have no vector halfway between them.
                let is_sum = sum.length_squared() > f64::from(SpecularModel::LEAST_SUM);
                if is_sum { n.dot(sum.normalize()) } else { 0.0 }
            }
            SpecularModel::Phong => e_direction.dot(2.0 * n_l * n - l_direction),
        };
        let power = libm::pow(cosine.max(0.0), f64::from(light.shininess));
        let specular = match light.gate {
            SpecularGate::Ungated => power,
            SpecularGate::Gated => power * f64::from(u8::from(n_l > 0.0)),
            SpecularGate::Weighted => power * diffuse,
        };
        sum += attenuation * (diffuse * wide(l.diffuse) + specular * wide(l.specular));
    }
    sum.min(DVec3::ONE) // cwise_min
}

/// Returns the strength of a light at the distance d (CS171 2, Attenuation; the other two laws are
/// L5's). Distances below 1e-15 count as 1e-15.
fn attenuation(falloff: Falloff, d: f64) -> f64 {
    let d = d.max(1e-15);
    match falloff {
        Falloff::None => 1.0,
        Falloff::Attenuation(k) => 1.0 / (1.0 + f64::from(k) * (d * d)),
        Falloff::InverseSquare => 1.0 / (d * d),
        Falloff::Inverse => 1.0 / d,
    }
}
