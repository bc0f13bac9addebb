//! The illumination model (L21 2.1) as it is printed, with the clamps that the text leaves out.

use super::power::powered;
use crate::scene::{Falloff, LightTerm, Lighting, Place, Power, SpecularGate, SpecularModel};
use glam::DVec3;

/// Converts a direction or colour of the frame to double precision.
pub(crate) fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from_array(v.map(f64::from))
}

/// Returns the unit vector from `from` toward `place`, and the distance. The vector is zero if they
/// are equal.
fn toward(place: Place<[f32; 3]>, from: DVec3) -> (DVec3, f64) {
    match place {
        Place::Infinite(direction) => (wide(direction), f64::INFINITY),
        Place::Local(position) => {
            let vector = wide(position) - from;
            (vector.normalize_or_zero(), vector.length())
        }
    }
}

/// Returns the strength of a light at the distance `r`:
/// ```text
/// 1 / (1 + k r²)      (CS171 2, Attenuation)        1 / r²,  1 / r      (L5, Light Falloff)
/// ```
/// Distances below 1e-15 count as 1e-15.
fn strength(falloff: Falloff, r: f64) -> f64 {
    let r = r.max(1e-15);
    match falloff {
        Falloff::None => 1.0,
        Falloff::Attenuation(k) => 1.0 / (1.0 + f64::from(k) * r * r),
        Falloff::InverseSquare => 1.0 / (r * r),
        Falloff::Inverse => 1.0 / r,
    }
}

/// Returns the strongest channel of any light's highlight, with each light at its nearest.
fn strongest_highlight(lighting: &Lighting) -> f64 {
    let of_light = |light: &LightTerm| {
        let strength = match light.place {
            Place::Local(_) => strength(light.falloff, 0.0),
            Place::Infinite(_) => 1.0,
        };
        wide(light.specular).max_element() * strength
    };
    lighting.lights.iter().map(of_light).fold(0.0, f64::max)
}

/// Returns the unit vector halfway between two others, or zero if they are opposite to within
/// [`SpecularModel::LEAST_SUM`].
fn halfway(l: DVec3, v: DVec3) -> DVec3 {
    let sum = l + v;
    let is_sum = sum.length_squared() > f64::from(SpecularModel::LEAST_SUM);
    if is_sum {
        sum / sum.length()
    } else {
        DVec3::ZERO
    }
}

/// A point of a surface, with what the illumination model needs.
#[derive(Clone, Copy)]
pub(crate) struct Point {
    /// The unit normal N.
    pub normal: DVec3,
    pub position: DVec3,
    /// The vertex colour c. Only some materials read it ([`Lighting::vertex_colours`]).
    pub colour: DVec3,
}

/// Returns the colour of a point of a surface under all lights, not clamped:
/// ```text
/// I = I_a k_a c + Σ (I_p k_d c (L·N) + I_p k_s (R·V)ⁿ)      (L21 2.1; c = 1 where materials have one colour)
/// R = 2 (L·N) N − L                                     or N·H, H = (L + V) / |L + V|      (CS171 2)
/// ```
/// A light behind the surface (L·N ≤ 0) adds nothing, and no highlight either unless the scene asks
/// for it. R·V and N·H are clamped at 0 from below. 0⁰ is 1. For the zero vector, which has no
/// direction, only ambient light is left. `power` may replace the power by another function.
pub(crate) fn sum(lighting: &Lighting, power: Power, point: Point) -> DVec3 {
    let (n, p) = (point.normal, point.position);
    let c = if lighting.vertex_colours {
        point.colour
    } else {
        DVec3::ONE
    };
    let (v, _) = toward(lighting.view, p);
    let mut intensity = wide(lighting.ambient) * c;
    for light in &lighting.lights {
        let (l, r) = toward(light.place, p);
        let l_n = l.dot(n);
        let cosine = match lighting.specular {
            SpecularModel::Phong => (2.0 * l_n * n - l).dot(v), // R = 2 (L·N) N − L
            SpecularModel::Blinn => n.dot(halfway(l, v)),       // h = (e + l) / |e + l|
        };
        let highlight = powered(power, lighting.shininess.into(), cosine.max(0.0), || {
            strongest_highlight(lighting)
        });
        let highlight = match lighting.gate {
            SpecularGate::Gated if l_n > 0.0 => highlight,
            SpecularGate::Gated => 0.0,
            SpecularGate::Ungated => highlight,
            SpecularGate::Weighted => highlight * l_n.max(0.0),
        };
        let falloff = if light.place.is_local() {
            strength(light.falloff, r)
        } else {
            1.0
        };
        intensity +=
            (wide(light.diffuse) * c * l_n.max(0.0) + wide(light.specular) * highlight) * falloff; // 2.1
    }
    intensity
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;
    use alloc::vec::Vec;

    const Z: [f32; 3] = [0.0, 0.0, 1.0];

    fn lit(lighting: &Lighting, normal: DVec3, position: DVec3) -> DVec3 {
        let point = Point {
            normal,
            position,
            colour: DVec3::new(0.5, 2.0, 0.0),
        };
        sum(lighting, Power::Squaring, point).clamp(DVec3::ZERO, DVec3::ONE)
    }

    fn lighting(lights: Vec<LightTerm>, view: [f32; 3], shininess: f32) -> Lighting {
        Lighting {
            ambient: [0.125, 0.0, 0.25],
            lights,
            view: Place::Infinite(view),
            shininess,
            specular: SpecularModel::Phong,
            gate: SpecularGate::Gated,
            vertex_colours: false,
        }
    }

    fn white(direction: [f32; 3], diffuse: f32, specular: f32) -> LightTerm {
        LightTerm {
            place: Place::Infinite(direction),
            diffuse: [diffuse; 3],
            specular: [specular; 3],
            falloff: Falloff::None,
        }
    }

    #[test]
    fn light_from_the_front_adds_both_terms_per_channel() {
        let light = LightTerm {
            diffuse: [0.5, 0.25, 0.0],
            specular: [0.0, 0.5, 0.5],
            ..white(Z, 0.0, 0.0)
        };
        // L = V = N: L·N = R·V = 1.
        assert_eq!(
            lit(&lighting(vec![light], Z, 7.0), DVec3::Z, DVec3::ZERO),
            DVec3::new(0.625, 0.75, 0.75)
        );
    }

    #[test]
    fn a_vertex_colour_multiplies_ambient_and_diffuse_light_where_the_material_asks_for_it() {
        let light = LightTerm {
            diffuse: [0.5, 0.25, 0.75],
            specular: [0.0, 0.25, 0.5],
            ..white(Z, 0.0, 0.0)
        };
        let mut lighting = lighting(vec![light], Z, 7.0);
        let plain = lit(&lighting, DVec3::Z, DVec3::ZERO);
        assert_eq!(plain, DVec3::new(0.625, 0.5, 1.0));
        lighting.vertex_colours = true;
        // (0.125 + 0.5) / 2, 2 · 0.25 + 0.25, and only the highlight.
        let coloured = lit(&lighting, DVec3::Z, DVec3::ZERO);
        assert_eq!(coloured, DVec3::new(0.3125, 0.75, 0.5));
    }

    #[test]
    fn the_highlight_is_a_power_of_the_reflected_ray() {
        // L = (0.6, 0, 0.8) about N = z gives R = (−0.6, 0, 0.8): R·V = 0.8 for V = z, cubed 0.512.
        // L·N = 0.8.
        let i = lit(
            &lighting(vec![white([0.6, 0.0, 0.8], 0.25, 0.5)], Z, 3.0),
            DVec3::Z,
            DVec3::ZERO,
        )
        .y;
        // 0.8 and 0.6 are rounded to f32, by 2⁻²⁵ each: (0.25 + 3 · 0.64 · 0.5) · 2⁻²⁵ < 2⁻²⁴.
        assert!((i - (0.2 + 0.256)).abs() < 6e-8, "{i}");
        // Seen along L, R·V = 0.64 − 0.36 = 0.28.
        let along = lighting(vec![white([0.6, 0.0, 0.8], 0.0, 1.0)], [0.6, 0.0, 0.8], 1.0);
        // R·V moves by 2 · (0.6 + 0.8) · 2⁻²⁵, and l_n, which appears in it twice, by as much
        // again: below 2⁻²².
        assert!((lit(&along, DVec3::Z, DVec3::ZERO).y - 0.28).abs() < 2.4e-7);
    }

    #[test]
    fn a_light_behind_the_surface_leaves_ambient_light() {
        let ambient = DVec3::new(0.125, 0.0, 0.25);
        assert_eq!(
            lit(
                &lighting(vec![white([0.0, 0.0, -1.0], 1.0, 0.0)], Z, 2.0),
                DVec3::Z,
                DVec3::ZERO
            ),
            ambient
        );
        // R·V = 1 here: without the gate a specular term would light the back.
        let back = lighting(
            vec![white([0.0, 0.0, -1.0], 0.0, 1.0)],
            [0.0, 0.0, -1.0],
            2.0,
        );
        assert_eq!(lit(&back, DVec3::Z, DVec3::ZERO), ambient);
        // A grazing light, L·N = 0, counts as behind. With n = 0 it would add k_s.
        let grazing = lighting(vec![white([1.0, 0.0, 0.0], 1.0, 1.0)], Z, 0.0);
        assert_eq!(lit(&grazing, DVec3::Z, DVec3::ZERO), ambient);
    }

    #[test]
    fn the_far_side_of_the_highlight_is_dark_even_for_even_exponents() {
        // R = z, V = −z: R·V = −1, squared 1.
        let i = lit(
            &lighting(vec![white(Z, 0.0, 1.0)], [0.0, 0.0, -1.0], 2.0),
            DVec3::Z,
            DVec3::ZERO,
        );
        assert_eq!(i, DVec3::new(0.125, 0.0, 0.25));
    }

    #[test]
    fn zero_to_the_power_of_zero_is_one() {
        let i = lit(
            &lighting(vec![white(Z, 0.0, 0.5)], [0.0, 0.0, -1.0], 0.0),
            DVec3::Z,
            DVec3::ZERO,
        );
        assert_eq!(i, DVec3::new(0.625, 0.5, 0.75));
    }

    #[test]
    fn lights_are_summed_then_clamped() {
        let two = lighting(vec![white(Z, 0.25, 0.0), white(Z, 0.5, 0.0)], Z, 1.0);
        assert_eq!(
            lit(&two, DVec3::Z, DVec3::ZERO),
            DVec3::new(0.875, 0.75, 1.0)
        );
        let bright = lighting(vec![white(Z, 0.75, 0.0), white(Z, 0.75, 0.0)], Z, 1.0);
        assert_eq!(lit(&bright, DVec3::Z, DVec3::ZERO), DVec3::ONE);
    }

    #[test]
    fn no_direction_no_light() {
        let i = lit(
            &lighting(vec![white(Z, 1.0, 1.0)], Z, 0.0),
            DVec3::ZERO,
            DVec3::ZERO,
        );
        assert_eq!(i, DVec3::new(0.125, 0.0, 0.25));
    }
}
