//! Phong shading in fixed point, for processors without a floating-point unit.
//!
//! It needs no allocator, computes with no float and never panics.
//!
//! Lecture 21 made Phong shading fast on machines where a root and a division are expensive. They
//! still are on Cortex-M0, RV32IMC and soft cores, and there the lecture's order still holds:
//! Gouraud's method ([`gouraud`]) is the cheapest, then [`Span::quadratic`], [`Span::fast`] and
//! [`Span::naive`]. `docs/small.md` has measurements.
//!
//! ```
//! use fastphong::integer::{Light, Material, Reflection, Rgb565, Span, unit};
//! use fastphong::fixed::types::U16F16;
//!
//! // A material in the colour of its light. The compiler computes its tables, which stay in
//! // read-only memory.
//! const fn grey(x: &str) -> [U16F16; 3] {
//!     [U16F16::lit(x); 3]
//! }
//! static CLAY: Material<Rgb565> = Material::new(grey("0.1"), grey("0.6"), grey("0.3"), 32);
//!
//! // Unit vectors: toward the light, toward the eye.
//! let light = Light::new(unit([1, 2, 3]), unit([0, 0, 1]), &CLAY);
//! // 32 pixels between two normals. The second normal belongs to the pixel after the last.
//! let mut line = [Rgb565(0); 32];
//! let span = Span::new(unit([0, 0, 1]), unit([1, 0, 3]));
//! span.fast::<_, Reflection, false, 1>(&mut line, &[light]);
//! assert_ne!(line[0], line[31]);
//! ```
//!
//! # Parts
//!
//! - [`Pixel`] is a pixel format: [`Rgb565`], [`Rgb565Be`], [`Rgb888`] or your own.
//! - [`Material`] holds two tables of 512 colours. [`Light`] joins it to the directions of light
//!   and eye.
//! - [`Span`] shades a line of pixels between two normals, by any method. [`gouraud`] shades a line
//!   between two colours, which [`colour`] computes.
//! - [`Canvas`] draws triangles and convex polygons, with 16 bits of depth if you like.
//!
//! Methods have up to three type parameters: `H`, the kind of highlight ([`Reflection`],
//! [`Halfway`] or [`NoHighlight`]); `REFINED`, true if a step of Newton's method refines 1/√D after
//! its table; and `L`, how many lights there are, at least one.
//!
//! # Number formats
//!
//! Q15 means a signed number with 15 fractional bits: its bits divided by 2¹⁵.
//!
//! | quantity | format | type | range | why it cannot overflow |
//! |---|---|---|---|---|
//! | vectors ([`Vector`]) | Q15 | `I17F15` | length ≤ 1 + 2⁻¹⁴ | a dot product is at most 2³⁰ in 32 bits; `Vector` shortens longer vectors |
//! | J, K, N, D and their steps | Q30 | `I2F30` | −1 to 1 | between its ends, or convex; drift < 2⁻¹¹ over [`Span::MAX`] pixels |
//! | 1/√D | Q15 | `i32` | 1 to 2 | the table ends at 2; J/√D ≤ 255/256 as \|J\| ≤ √D 255/256 |
//! | 1/n | 15 bits and a shift | | n ≤ 256 | times a Q14 difference below 4: below 2³¹ |
//! | coordinates ([`Vertex`]) | Q8 | `I24F8` | ±1,024 pixels | products of two sides use 64 bits, or 13 bits a side |
//! | colours | fields of 9 or 10 bits and a guard | `u32` | 0 to 1 | two sums stay below 2, then they are clamped |
//!
//! The loops add with the types of [`fixed`], but multiply their bits: the types' own products go
//! through 64 bits, which takes four times as long on a Cortex-M0.
//!
//! # Limits
//!
//! Lights and eye are at infinity. Normals are interpolated on the screen, as in the lecture:
//! [`Canvas`] says how large the error of perspective is. Neighbouring normals must lie within 120°
//! of one another, for [`Span::quadratic`] within about 15° and for [`Span::slerp`] within 90°.
//! Beyond that colours are wrong, but nothing overflows or panics. Lines may have any length and
//! vectors any components: see [`Span::MAX`] and [`Vector`].

mod as_printed;
#[cfg(feature = "alloc")]
mod bound;
mod canvas;
mod fast;
mod gouraud;
mod gradients;
mod light;
mod material;
mod naive;
mod pixel;
mod quadratic;
mod ramp;
mod reciprocal;
mod reciprocal_root;
mod scan;
mod six_point;
mod slerp;
mod sliver;
mod span;
#[cfg(test)]
mod tests;
mod triangle;
mod vector;

#[cfg(feature = "alloc")]
pub(crate) use bound::ErrorBound;
pub use canvas::{Canvas, Vertex};
pub use gouraud::gouraud;
pub use light::{Halfway, Highlight, Light, NoHighlight, Reflection};
pub use material::Material;
pub use naive::colour;
pub use pixel::{Pixel, Rgb565, Rgb565Be, Rgb888};
pub use span::Span;
pub use vector::{Vector, unit};
