//! All methods as constants.
//!
//! `methods::PHONG_RSQRT.variant()` draws without a name that may be misspelt; [`MethodRow::info`]
//! says what a method computes and where it fails. [`Info::tier`](crate::shading::Info::tier) tells
//! the methods that comparisons show apart from those that they show only on request.
//!
//! ```
//! use fastphong::shading::{Tier, methods};
//!
//! let fast = methods::FAST_PHONG.variant();
//! assert_eq!(fast.info().source, "L21 4.2, 4.3, eq 4.3-4.6");
//! assert_eq!(methods::FAST_PHONG.info.tier, Tier::Default);
//! ```
//!
//! # Inside
//!
//! Each family has a folder and each method a file in it:
//!
//! | folder | the methods | begin with |
//! |---|---|---|
//! | `colours/` | interpolate colours, or have one per polygon | `gouraud.rs` |
//! | `roots/` | interpolate normals or their products, with a root or a quotient per pixel | `naive_phong.rs`, then `fast_phong.rs` |
//! | `series/` | replace the root by a polynomial | `cubic_phong.rs` |
//! | `quadratics/` | step quadratics over a polygon or a span | `quadratic_normals.rs` |
//! | `angles/` | interpolate angles, or on another chart of the sphere | `slerp_phong.rs` |
//! | `highlights/` | have another formula for highlights | `duff_half.rs` |
//! | `hybrids/` | choose among several loops for each polygon | `h_test.rs` |
//! | `integers/` | compute in integers; each also belongs to one of the families above | `mod.rs`, then `fast.rs` |

pub(crate) mod angles;
pub(crate) mod colours;
pub(crate) mod highlights;
pub(crate) mod hybrids;
pub(crate) mod integers;
pub(crate) mod quadratics;
pub(crate) mod roots;
pub(crate) mod series;

use crate::shading::{METHODS, MethodRow};

/// Flat shading, lit once per polygon with the polygon's own normal.
pub const FLAT: &MethodRow = named("flat");
/// Flat shading with the mean of the corners' normals.
pub const FLAT_AVERAGE: &MethodRow = named("flat-average");
/// Vertex colours, interpolated.
pub const GOURAUD: &MethodRow = named("gouraud");
/// Vertex colours, interpolated separately for highlights and for the rest.
pub const GOURAUD_SEPARATE: &MethodRow = named("gouraud-separate");
/// Normals, interpolated and normalised at each pixel.
pub const NAIVE_PHONG: &MethodRow = named("naive-phong");
/// Fast Phong shading with Newton's root.
pub const FAST_PHONG: &MethodRow = named("fast-phong");
/// Fast Phong shading with the processor's reciprocal root.
pub const FAST_PHONG_RSQRT: &MethodRow = named("fast-phong-rsqrt");
/// Naive Phong shading by scalars, with the processor's reciprocal root: usually the fastest with
/// naive Phong's picture.
pub const PHONG_RSQRT: &MethodRow = named("phong-rsqrt");
/// Duff's forward differences.
pub const DUFF_PHONG: &MethodRow = named("duff-phong");
/// Duff's forward differences with Newton's root.
pub const DUFF_NEWTON: &MethodRow = named("duff-newton");
/// Duff's forward differences, with a polynomial in place of the root.
pub const SERIES_PHONG: &MethodRow = named("series-phong");
/// Products of unit normals as cubics along spans.
pub const CUBIC_PHONG: &MethodRow = named("cubic-phong");
/// Highlights from the difference of N and H.
pub const DIFFERENCE_VECTOR: &MethodRow = named("difference-vector");
/// Taylor's quadratics over triangles.
pub const BISHOP_WEIMER: &MethodRow = named("bishop-weimer");
/// Quadratics through six points of a triangle.
pub const SIX_POINT: &MethodRow = named("six-point");
/// Normals as quadratics along spans.
pub const QUADRATIC_NORMALS: &MethodRow = named("quadratic-normals");
/// Normals as quadratics over triangles that follow inflections of the surface.
pub const BIQUADRATIC_NORMALS: &MethodRow = named("biquadratic-normals");
/// Gouraud's diffuse light with Phong's highlights.
pub const H_TEST: &MethodRow = named("h-test");
/// The cheapest of five loops for each polygon, within a stated error: usually the fastest in
/// scalar code with Phong's picture.
pub const ADAPTIVE_PHONG: &MethodRow = named("adaptive-phong");
/// Normals along great circles, as products.
pub const SLERP_PHONG: &MethodRow = named("slerp-phong");
/// Normals along great circles by Chebyshev's recurrence.
pub const SLERP_CHEBYSHEV: &MethodRow = named("slerp-chebyshev");
/// Normals along great circles, as vectors.
pub const SLERP_PHONG_VECTOR: &MethodRow = named("slerp-phong-vector");
/// Duff's forward differences with N·H.
pub const DUFF_HALF: &MethodRow = named("duff-half");
/// Phong shading in the frame of eye and first light.
pub const EYE_FRAME_PHONG: &MethodRow = named("eye-frame-phong");
/// Normals, interpolated and not normalised.
pub const PHONG_UNNORMALISED: &MethodRow = named("phong-unnormalised");
/// Normals along great circles with N·H, by Chebyshev's recurrence.
pub const SLERP_HALF: &MethodRow = named("slerp-half");
/// Normals through a stereographic chart around the eye.
pub const STEREOGRAPHIC_PHONG: &MethodRow = named("stereographic-phong");
/// Quaternions that rotate the eye's direction to the normal.
pub const QUATERNION_PHONG: &MethodRow = named("quaternion-phong");
/// The first normal of a span, reflected in a vector half-way.
pub const HALF_REFLECTION: &MethodRow = named("half-reflection");
/// A picture of a lit ball, read at the x and y of the normal.
pub const PHONG_MAP: &MethodRow = named("phong-map");
/// Angles along great circles, and powers of cosines by parabolas.
pub const KUIJK_BLAKE: &MethodRow = named("kuijk-blake");

/// Vertex colours, interpolated in integers.
pub const INTEGER_GOURAUD: &MethodRow = named("integer-gouraud");
/// Naive Phong shading in integers.
pub const INTEGER_NAIVE: &MethodRow = named("integer-naive");
/// Fast Phong shading in integers: usually the fastest with Phong's picture on processors without a
/// floating-point unit.
pub const INTEGER_FAST: &MethodRow = named("integer-fast");
/// Parabolas along spans in integers.
pub const INTEGER_QUADRATIC: &MethodRow = named("integer-quadratic");
/// Normals along great circles in integers.
pub const INTEGER_SLERP: &MethodRow = named("integer-slerp");
/// Naive Phong shading in integers, as the lecture prints it.
pub const INTEGER_NAIVE_PRINTED: &MethodRow = named("integer-naive-printed");
/// Fast Phong shading in integers, as the lecture prints it.
pub const INTEGER_FAST_PRINTED: &MethodRow = named("integer-fast-printed");

/// Returns the row of the method called `name`. It runs at compile time: a name without a row does
/// not compile.
const fn named(name: &str) -> &'static MethodRow {
    let mut index = 0;
    while !are_equal(METHODS[index].info.name.as_bytes(), name.as_bytes()) {
        index += 1;
    }
    &METHODS[index]
}

const fn are_equal(a: &[u8], b: &[u8]) -> bool {
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString;
    use alloc::vec::Vec;

    /// Every method of the table has a constant, whose name is the method's in capitals.
    #[test]
    fn constants_are_the_table() {
        let lines = include_str!("mod.rs").lines();
        let constants = lines.filter_map(|line| {
            let (constant, rest) = line
                .strip_prefix("pub const ")?
                .split_once(": &MethodRow = named(\"")?;
            let name = rest.strip_suffix("\");")?;
            assert_eq!(constant.to_ascii_lowercase().replace('_', "-"), name);
            Some(name)
        });
        let names = METHODS.iter().map(|row| row.info.name);
        assert_eq!(constants.collect::<Vec<_>>(), names.collect::<Vec<_>>());
        assert_eq!(PHONG_RSQRT.variant().to_string(), "phong-rsqrt");
    }
}
