//! Gouraud's diffuse light everywhere, and Phong's highlights where a polygon may have one
//! (Harrison, Mitchell, Watt 1988).

use crate::frame::{Frame, Polygon};
use crate::number::{Num, Real, Vec3, vec3};
use crate::reference::Model;
use crate::scene::{Place, SpecularGate, SpecularModel};
use crate::shading::bounds::polygon_ranges::{Extent, for_each_end, wide};
use crate::shading::light::magnitude;
use crate::shading::methods::quadratics::over_triangle::plain;
use crate::shading::{
    Approximation, Carries, Chosen, Corners, Family, Fit, Info, LightAt, Linear, Method, Needs, On,
    OneOf, Perspective, Pixel, Roundings, Shader, Span, Stepped,
};
use glam::DVec3;

/// The H-test. Ambient and diffuse light is interpolated between vertices, as in Gouraud shading,
/// so that there are no seams. Only polygons on which a highlight may exceed half a grey level step
/// their normals, and only highlights are computed from these.
///
/// The test never misses a highlight. All normals of a polygon lie in the cone of half-angle w
/// about the mean direction m of its corners' normals, cos w = min N_i·m. A highlight of at least
/// T^n, `T = (½ level / k_s)^(1/n)`, needs
///
/// ```text
/// N·H ≥ T      or      R·V = 2 (L·N)(V·N) − L·V ≥ T,  so that  (N·H)² ≥ (T + L·V)/(1 + L·V)   as  (L·N)(V·N) ≤ (N·H |L + V|/2)²
/// ```
/// A polygon is dull if the angle between m and H exceeds w + acos of that bound; or, unless
/// highlights are ungated, if the light is behind all of its corners. Ungated, a surface shines as
/// well if both light and eye are behind it: for R·V, −H counts there too.
///
/// **Its error.** Let a light have J of at most p and at least −q at the corners. Where it is in
/// front, the interpolated diffuse term is too dark by J (1/|N| − 1) ≤ p (1/ℓ − 1), with ℓ the
/// least length. The chord of max(0, J) is at most p q/(p + q) above it.
#[derive(Clone, Copy, Debug, Default)]
pub struct HTest;

/// The largest highlight that is left out, in grey levels of 255.
const FAINT: f32 = 0.5;

/// True if a highlight may be seen on a polygon whose normals lie between these.
fn may_shine<F: Num>(
    lit: &LightAt<'_, F>,
    normals: impl Iterator<Item = Vec3<f32>> + Clone,
) -> bool {
    const ROUNDINGS: f32 = 1e-5;
    let exponent = lit.model.exponent;
    let sum = normals.clone().fold(vec3([0.0; 3]), |sum, n| sum + n);
    let mean = sum.unit();
    let cosine = normals.clone().map(|n| n.dot(mean)).fold(1.0, f32::min) - ROUNDINGS;
    let Place::Infinite(view) = lit.model.eye else {
        return true;
    };
    lit.stored.iter().any(|light| {
        let Place::Infinite(to) = light.place else {
            return true;
        };
        let k_s = magnitude(light.specular) * (255.0 / lit.model.scale);
        let is_gated = lit.model.gate != SpecularGate::Ungated;
        if k_s <= FAINT || is_gated && normals.clone().all(|n| n.dot(to) <= 0.0) {
            return false;
        }
        let n = lit.model.shininess;
        // No bound is known: the power is not tⁿ, normals nearly cancel, or light and eye are
        // opposite.
        if !exponent.is_power() || cosine.is_nan() || cosine <= 0.0 || light.half == 0.0 {
            return true;
        }
        let least = libm::powf(FAINT / k_s, 1.0 / n);
        let (is_halfway, l_v) = (lit.model.specular == SpecularModel::Blinn, light.l_v);
        let bound = if is_halfway {
            least
        } else {
            Num::sqrt(f32::max(0.0, (least + l_v) / (1.0 + l_v)))
        };
        let bound = (bound - ROUNDINGS).clamp(0.0, 1.0);
        // cos (w + acos bound), by the addition theorem: both angles are at most a right angle, so
        // both sines are positive.
        let sines = (1.0 - cosine * cosine) * (1.0 - bound * bound);
        let farthest = cosine * bound - Num::sqrt(sines);
        let h = (to + view) * light.half;
        let toward = mean.dot(h);
        // With light and eye both behind, R·V has the value that it has in front, because (N·H)²
        // has no sign.
        let toward = if is_gated || is_halfway {
            toward
        } else {
            toward.abs()
        };
        toward >= farthest - ROUNDINGS
    })
}

fn approximation(frame: &Frame, polygon: &Polygon) -> Approximation {
    let lighting = &frame.lightings()[polygon.material as usize];
    let least = Extent::of(frame, polygon).cosine.max(0.0);
    let mut colours = [0.0; 3];
    for light in &lighting.lights {
        let Place::Infinite(to) = light.place.map(wide) else {
            continue; // the method refuses it
        };
        let (mut p, mut q) = (0.0, 0.0);
        for_each_end(frame, frame.corners(polygon), &mut |v| {
            let j = DVec3::dot(to, wide(frame.normal(v)));
            (p, q) = (f64::max(p, j), f64::max(q, -j));
        });
        let over = if p + q > 0.0 { p * q / (p + q) } else { 0.0 };
        let diffuse = f64::min(1.0, f64::max(p * (1.0 / least - 1.0), over));
        for (c, colour) in colours.iter_mut().enumerate() {
            let faint = f64::min(f64::from(light.specular[c]), f64::from(FAINT) / 255.0);
            *colour += f64::from(light.diffuse[c]) * diffuse + faint;
        }
    }
    Approximation {
        colour: colours.into_iter().fold(0.0, f64::max),
        ..Approximation::NONE
    }
}

impl Method for HTest {
    const INFO: Info = Info {
        name: "h-test",
        ids: &["M20"],
        family: Family::Hybrids,
        title: "Gouraud's diffuse light, and Phong's highlights on polygons that may have one",
        formula: "Id = Ia ka + Ip kd max(0, L.Ni) at vertices;  Id_next = Id + dId;  I = Id + Ip ks (R.V)^n of N / |N| where the cone of \
                  normals reaches a highlight",
        source: "Harrison, Mitchell, Watt 1988; the cone: ours",
        model: Model::Phong,
        roundings: Roundings::new(14.0, 1.9, Stepped::Cosines),
        derivation: "as naive-phong in highlights; colours are stepped beside normals, and take as many roundings",
        approximation: |frame, polygon, _| approximation(frame, polygon),
        fails: "diffuse light is Gouraud's: too dark in the middle of polygons, and with Mach bands",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        perspective: Perspective::Divides,
        ..Needs::PIXELS
    };
    type Kinds = (Dull, Shining);

    fn on(on: On<'_>) -> Fit {
        let reason = "it finds highlights only of lights at infinity, for an eye at infinity";
        on.each(|lighting, _| lighting.is_local().then_some(reason))
    }
    #[inline(always)]
    fn polygon<R: Real>(self, lit: &LightAt<'_, R>, polygon: &Corners<'_, R>) -> Chosen<Self, R> {
        let normals = polygon.whole.iter().map(|n| plain(*n));
        if may_shine(lit, normals) {
            OneOf::Second(())
        } else {
            OneOf::First(())
        }
    }
}

/// The kind of polygons without a highlight: only the colour is stepped.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dull;

impl Shader for Dull {
    const INFO: Info = Info::of_kind("dull");
    type Constants<F: Num> = ();
    type Carries = HTest;
    type Walk<F: Num> = Linear<Vec3<F>>;
    const VALUES: &'static [&'static str] = &["Ir", "Ig", "Ib"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        let Linear { at, step } = span.linear();
        Linear {
            at: at.0,
            step: step.0,
        }
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, colour: Vec3<F>) -> Vec3<F> {
        lit.times_albedo(colour)
    }
}

/// The kind of polygons that may have a highlight: the colour and N are stepped.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shining;

impl Shader for Shining {
    const INFO: Info = Info::of_kind("shining");
    type Constants<F: Num> = ();
    type Carries = HTest;
    type Walk<F: Num> = Linear<(Vec3<F>, Vec3<F>)>;
    const VALUES: &'static [&'static str] = &["Ir", "Ig", "Ib", "Nx", "Ny", "Nz"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, (colour, n): Pixel<Self, F>) -> Vec3<F> {
        let mut colour = lit.times_albedo(colour);
        let n = n.unit();
        let v_n = n.dot(lit.view()); // K = V · N
        for light in lit.lights() {
            let l_n = n.dot(light.to); // J = L · N
            let cosine = lit.highlight(&light, l_n, v_n);
            colour = lit.add_highlight(colour, &light, l_n.max(0.0), cosine);
        }
        colour
    }
}

impl Carries for HTest {
    type Varying<F: Num> = (Vec3<F>, Vec3<F>);
    const NAMES: &'static [&'static str] = &["Ir", "Ig", "Ib", "Nx", "Ny", "Nz"];

    #[inline(always)]
    fn vertex<F: Num>(lit: &LightAt<'_, F>, n: Vec3<F>) -> Self::Varying<F> {
        // Pixels multiply by the vertex colour, as the reference does.
        let lit = &lit.with_albedo(vec3([n.x.broadcast(1.0); 3]));
        let mut colour = lit.ambient();
        for light in lit.lights() {
            colour = lit.add_diffuse(colour, &light, n.dot(light.to).max(0.0));
        }
        (colour, n)
    }
}
