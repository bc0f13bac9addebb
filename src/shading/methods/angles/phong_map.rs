//! Phong maps: a picture of a lit ball, read at the x and y of the normal, as demos did it.

use crate::frame::{Frame, Polygon};
use crate::number::{Num, Vec3};
use crate::reference::Model;
use crate::shading::bounds::polygon_ranges::Extent;
use crate::shading::light::eye_frame;
use crate::shading::methods::angles::chart_errors::{FromEye, of_angle};
use crate::shading::{
    Approximation, Carried, Carries, Family, Info, LightAt, Linear, Needs, Perspective, Pixel,
    Roundings, Shader, Span, Stepped, Tier,
};

/// A Phong map of unlimited resolution. N_x and N_y are interpolated in the frame whose z points to
/// the eye. A pixel has the colour of the ball's picture there, which is the colour of
///
/// ```text
/// N = (N_x, N_y, √max(0, 1 − N_x² − N_y²))
/// ```
///
/// A demo reads this colour from a table. Here a root takes its place, so that the picture has no
/// errors of a table. [`FromEye::angle_of_map`] derives the distance of the normal from Phong's.
#[derive(Clone, Copy, Debug, Default)]
pub struct PhongMap;

/// Returns a bound of the error of a map on a polygon. At the ball's rim roundings of N_x and N_y
/// count for more: two per step, and 16 before.
fn approximation(frame: &Frame, polygon: &Polygon) -> Approximation {
    let extent = Extent::of(frame, polygon);
    let rounding = (16.0 + 2.0 * extent.steps) * extent.weights / (1u64 << 24) as f64;
    of_angle(FromEye::of(frame, polygon).angle_of_map(rounding))
}

impl Shader for PhongMap {
    const INFO: Info = Info {
        name: "phong-map",
        ids: &["M18"],
        family: Family::Angles,
        tier: Tier::Exhibit,
        title: "x and y of the normal, interpolated, as a place on the picture of a lit ball",
        formula: "Nx_next = Nx + dNx;  Ny_next = Ny + dNy, z toward the eye;  Nz = sqrt(max(0, 1 - Nx^2 - Ny^2));  eq 2.1",
        source: "Elias; Hammersley 1997, with a root in place of the table",
        model: Model::PhongConstant,
        roundings: Roundings::new(24.0, 2.5, Stepped::Cosines),
        derivation: "a turned normal takes 4 roundings, z, J and K 9; each step rounds both values by half of 2^-24, and under perspective \
                     the weight; roundings that grow at the rim of the ball are part of the error by design",
        approximation: |frame, polygon, _| approximation(frame, polygon),
        fails: "back faces are lit like front faces; between corners that are far apart, normals are turned toward the eye",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        perspective: Perspective::Divides,
        scalar_only: Some(
            "phong-map saves no root, and a block of pixels is no faster without the third component",
        ),
        ..Needs::PIXELS_BY_POLYGON
    };
    type Constants<F: Num> = ();
    type Carries = Self;
    type Walk<F: Num> = Linear<(F, F)>;
    const VALUES: &'static [&'static str] = &["Nx", "Ny"];

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Linear<(F, F)> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, lit: &LightAt<'_, F>, (x, y): Pixel<Self, F>) -> Vec3<F> {
        let square = x.mul_add(x, y * y);
        // Rounding may put the point outside of the ball.
        let z = (-square + 1.0).max(0.0).sqrt();
        let n = Vec3 { x, y, z };
        let mut colour = lit.ambient();
        for light in lit.lights() {
            let l_n = eye_frame::product(&light, n); // J = L · N
            colour = lit.add(colour, &light, l_n, lit.highlight(&light, l_n, z));
        }
        colour
    }
}

impl Carries for PhongMap {
    const FROM: Carried = Carried::Turned;
    type Varying<F: Num> = (F, F);
    const NAMES: &'static [&'static str] = &["Nx", "Ny"];

    #[inline(always)]
    fn vertex<F: Num>(_: &LightAt<'_, F>, n: Vec3<F>) -> (F, F) {
        (n.x, n.y)
    }
}
