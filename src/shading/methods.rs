//! The methods of [`METHODS`] as constants: `methods::PHONG_RSQRT.variant()` draws without a name that may be misspelt.
//!
//! [`Entry::info`] says of each what it computes, and where it fails. Those that comparisons show where they are asked for have constants
//! too, which are not listed here: `fastphong list methods --all` names them.

use super::{Entry, METHODS};

/// Flat shading, lit once a polygon by the polygon's own normal.
pub const FLAT: &Entry = named("flat");
/// Flat shading by the mean of the corners' normals.
#[doc(hidden)] // where asked for
pub const FLAT_AVERAGE: &Entry = named("flat-average");
/// Vertex colours, interpolated.
pub const GOURAUD: &Entry = named("gouraud");
/// Vertex colours, interpolated; highlights apart from the rest.
#[doc(hidden)] // where asked for
pub const GOURAUD_SEPARATE: &Entry = named("gouraud-separate");
/// Normals, interpolated and made unit vectors at each pixel.
pub const NAIVE_PHONG: &Entry = named("naive-phong");
/// Fast Phong shading with Newton's root.
pub const FAST_PHONG: &Entry = named("fast-phong");
/// Fast Phong shading with the processor's reciprocal root.
#[doc(hidden)] // where asked for
pub const FAST_PHONG_RSQRT: &Entry = named("fast-phong-rsqrt");
/// Naive Phong shading from scalars, with the processor's reciprocal root: mostly the fastest with naive Phong's picture.
pub const PHONG_RSQRT: &Entry = named("phong-rsqrt");
/// Duff's forward differences.
pub const DUFF_PHONG: &Entry = named("duff-phong");
/// Duff's forward differences with Newton's root.
#[doc(hidden)] // where asked for
pub const DUFF_NEWTON: &Entry = named("duff-newton");
/// Duff's forward differences, with a polynomial in place of the root.
pub const SERIES_PHONG: &Entry = named("series-phong");
/// Products of unit normals as cubics along spans.
#[doc(hidden)] // where asked for
pub const CUBIC_PHONG: &Entry = named("cubic-phong");
/// Highlights by the difference of N and H.
#[doc(hidden)] // where asked for
pub const DIFFERENCE_VECTOR: &Entry = named("difference-vector");
/// Taylor's quadratics over triangles.
#[doc(hidden)] // where asked for
pub const BISHOP_WEIMER: &Entry = named("bishop-weimer");
/// Quadratics through six points of a triangle.
pub const SIX_POINT: &Entry = named("six-point");
/// Normals as quadratics along spans.
#[doc(hidden)] // where asked for
pub const QUADRATIC_NORMALS: &Entry = named("quadratic-normals");
/// Normals as quadratics over triangles that follow inflections of the surface.
#[doc(hidden)] // where asked for
pub const BIQUADRATIC_NORMALS: &Entry = named("biquadratic-normals");
/// Gouraud's diffuse light with Phong's highlights.
#[doc(hidden)] // where asked for
pub const H_TEST: &Entry = named("h-test");
/// For each polygon the cheapest of five ways within a stated error: mostly the fastest of scalar code with Phong's picture.
pub const ADAPTIVE_PHONG: &Entry = named("adaptive-phong");
/// Normals along great circles, as products.
pub const SLERP_PHONG: &Entry = named("slerp-phong");
/// Normals along great circles by Chebyshev's recurrence.
#[doc(hidden)] // where asked for
pub const SLERP_CHEBYSHEV: &Entry = named("slerp-chebyshev");
/// Normals along great circles, as vectors.
#[doc(hidden)] // where asked for
pub const SLERP_PHONG_VECTOR: &Entry = named("slerp-phong-vector");
/// Duff's forward differences with N·H.
#[doc(hidden)] // where asked for
pub const DUFF_HALF: &Entry = named("duff-half");
/// Phong shading in the frame of eye and first light.
#[doc(hidden)] // where asked for
pub const EYE_FRAME_PHONG: &Entry = named("eye-frame-phong");
/// Normals, interpolated and not normalised.
#[doc(hidden)] // an exhibit
#[doc(hidden)] // where asked for
pub const PHONG_UNNORMALISED: &Entry = named("phong-unnormalised");
/// Normals along great circles with N·H, by Chebyshev's recurrence.
#[doc(hidden)] // where asked for
pub const SLERP_HALF: &Entry = named("slerp-half");
/// Normals through a stereographic chart around the eye.
#[doc(hidden)] // where asked for
pub const STEREOGRAPHIC_PHONG: &Entry = named("stereographic-phong");
/// Quaternions that turn the eye's direction into the normal.
#[doc(hidden)] // where asked for
pub const QUATERNION_PHONG: &Entry = named("quaternion-phong");
/// The first normal of a span, reflected in a vector half-way.
#[doc(hidden)] // where asked for
pub const HALF_REFLECTION: &Entry = named("half-reflection");
/// A picture of a lit ball, read at the x and y of the normal.
#[doc(hidden)] // an exhibit
#[doc(hidden)] // where asked for
pub const PHONG_MAP: &Entry = named("phong-map");
/// Angles along great circles, and powers of cosines by parabolas.
#[doc(hidden)] // where asked for
pub const KUIJK_BLAKE: &Entry = named("kuijk-blake");

/// Vertex colours, interpolated in integers.
pub const INTEGER_GOURAUD: &Entry = named("integer-gouraud");
/// Naive Phong shading in integers.
pub const INTEGER_NAIVE: &Entry = named("integer-naive");
/// Fast Phong shading in integers: mostly the fastest with Phong's picture on processors without a floating-point unit.
pub const INTEGER_FAST: &Entry = named("integer-fast");
/// Parabolas along spans in integers.
pub const INTEGER_QUADRATIC: &Entry = named("integer-quadratic");
/// Normals along great circles in integers.
pub const INTEGER_SLERP: &Entry = named("integer-slerp");
/// Naive Phong shading in integers, as the lecture prints it.
#[doc(hidden)] // an exhibit
pub const INTEGER_NAIVE_PRINTED: &Entry = named("integer-naive-printed");
/// Fast Phong shading in integers, as the lecture prints it.
#[doc(hidden)] // an exhibit
pub const INTEGER_FAST_PRINTED: &Entry = named("integer-fast-printed");

/// Returns the row of the table called `name`; a name without a row does not compile.
const fn named(name: &str) -> &'static Entry {
    let mut number = 0;
    while !are_equal(METHODS[number].info.name.as_bytes(), name.as_bytes()) {
        number += 1;
    }
    &METHODS[number]
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

    /// Every method of the table is a constant, whose name is its own in capitals.
    #[test]
    fn constants_are_the_table() {
        let lines = include_str!("methods.rs").lines();
        let constants = lines.filter_map(|line| {
            let (constant, rest) = line
                .strip_prefix("pub const ")?
                .split_once(": &Entry = named(\"")?;
            let name = rest.strip_suffix("\");")?;
            assert_eq!(constant.to_ascii_lowercase().replace('_', "-"), name);
            Some(name)
        });
        let names = METHODS.iter().map(|entry| entry.info.name);
        assert_eq!(constants.collect::<Vec<_>>(), names.collect::<Vec<_>>());
        assert_eq!(PHONG_RSQRT.variant().to_string(), "phong-rsqrt");
    }
}
